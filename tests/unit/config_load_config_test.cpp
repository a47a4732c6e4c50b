#include "graspd/config/load_config.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <numbers>

#include "graspd/planner/planner_config.hpp"

namespace graspd {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Inner {
    double ratio = 0.25;
    std::uint32_t count = 7;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("ratio", self.ratio, 0.0, 1.0);
        visit("count", self.count, 1u, 4000000000u);
    }
};

struct Outer {
    bool fast = false;
    std::int32_t shift = -3;
    std::uint64_t seed = 0;
    std::string label = "plain";
    Inner inner;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("fast", self.fast);
        visit("shift", self.shift, -10, 10);
        visit("seed", self.seed, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
        visit("label", self.label);
        visit("inner", self.inner);
    }
};

class LoadConfig : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(file_); }

    std::filesystem::path write(const std::string& text) {
        std::ofstream(file_) << text;
        return file_;
    }
    /// The detail of the error that a file of this text gives.
    std::string error_of(const std::string& text) {
        const auto loaded = load_config<Outer>(write(text));
        EXPECT_FALSE(loaded.ok()) << text;
        if (loaded.ok()) return "";
        EXPECT_EQ(loaded.error().code, PlanErrorCode::kInvalidInput);
        return loaded.error().detail;
    }

private:
    const std::filesystem::path file_ = std::filesystem::path(testing::TempDir()) /
                                        ("graspd_config_" + std::to_string(getpid()) + ".yaml");
};

// Every type at a value that its neighbours could not hold: 2^64 - 1 fits no signed integer, 3.9e9
// no signed 32 bit one, and 0.1 + 0.2 needs all 17 digits.
TEST_F(LoadConfig, ReadsEveryTypeExactly) {
    const auto loaded = load_config<Outer>(
        write("fast: true\nshift: -10\nseed: 18446744073709551615\nlabel: 'a: b'\n"
              "inner: {ratio: 0.30000000000000004, count: 3900000000}\n"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    EXPECT_TRUE(loaded.value().fast);
    EXPECT_EQ(loaded.value().shift, -10);
    EXPECT_EQ(loaded.value().seed, 18446744073709551615u);
    EXPECT_EQ(loaded.value().label, "a: b");
    EXPECT_EQ(loaded.value().inner.ratio, 0.1 + 0.2);
    EXPECT_EQ(loaded.value().inner.count, 3900000000u);
}

TEST_F(LoadConfig, AbsentKeysAndEmptyGroupsKeepTheDefaults) {
    for (const char* text : {"", "inner:\n", "fast: false\n", "inner: {}\n"}) {
        const auto loaded = load_config<Outer>(write(text));
        ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
        EXPECT_EQ(print_config(loaded.value()), print_config(Outer{})) << text;
    }
    Outer other;
    other.inner.count = 9;
    const auto loaded = load_config(write("fast: true\n"), other);
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(loaded.value().inner.count, 9u);
}

TEST_F(LoadConfig, AnUnknownKeyIsNamedWithItsFileLineAndPath) {
    EXPECT_THAT(error_of("fast: true\ninner:\n  ratoi: 0.5\n"),
                AllOf(HasSubstr(".yaml:3: "), HasSubstr("inner.ratoi"),
                      HasSubstr("known here: ratio, count")));
    EXPECT_THAT(error_of("slow: true\n"), AllOf(HasSubstr("unknown key slow"), HasSubstr("inner")));
}

TEST_F(LoadConfig, AWrongTypeIsNamedWithKeyValueAndRange) {
    EXPECT_THAT(error_of("inner: {ratio: much}\n"),
                AllOf(HasSubstr("inner.ratio = much"), HasSubstr("a number in [0, 1]")));
    EXPECT_THAT(error_of("inner: {count: 2.5}\n"),
                AllOf(HasSubstr("inner.count = 2.5"), HasSubstr("an integer in [1, 4000000000]")));
    EXPECT_THAT(error_of("inner: {count: -1}\n"), HasSubstr("inner.count = -1 must be an integer"));
    EXPECT_THAT(error_of("inner: {count: 4294967297}\n"), HasSubstr("count = 4294967297 must"));
    EXPECT_THAT(error_of("inner: {ratio: 0.5 m}\n"), HasSubstr("inner.ratio = 0.5 m must"));
    EXPECT_THAT(error_of("inner: {ratio: '0.5'}\n"), HasSubstr("inner.ratio = \"0.5\" must"));
    EXPECT_THAT(error_of("inner: {ratio: }\n"), HasSubstr("inner.ratio = (nothing) must"));
    EXPECT_THAT(error_of("fast: yes\n"), HasSubstr("fast = yes must be true or false"));
    EXPECT_THAT(error_of("label: [a]\n"), HasSubstr("label = (a list) must be a text"));
    EXPECT_THAT(error_of("inner: 5\n"), HasSubstr("inner = 5 must be a group"));
    EXPECT_THAT(error_of("- 5\n"), HasSubstr("the file = (a list) must be a group"));
}

TEST_F(LoadConfig, AValueOutOfRangeIsNamedWithFileKeyValueAndRange) {
    EXPECT_THAT(error_of("inner: {ratio: 1.5}\n"),
                AllOf(HasSubstr(".yaml: "), HasSubstr("inner.ratio = 1.5 is outside [0, 1]")));
    EXPECT_THAT(error_of("inner: {ratio: nan}\n"), HasSubstr("inner.ratio = nan is outside"));
    EXPECT_THAT(error_of("shift: 11\n"), HasSubstr("shift = 11 is outside [-10, 10]"));
}

// A parameter with named values takes these and no other, and says which they are.
TEST_F(LoadConfig, AChoiceIsOneOfItsNames) {
    const auto chosen =
        load_config<PlannerConfig>(write("vertex_concavity: {method: tetrahedral}\n"));
    ASSERT_TRUE(chosen.ok()) << chosen.error().detail;
    EXPECT_EQ(chosen.value().vertex_concavity.method, "tetrahedral");
    const auto method_error = [&](const std::string& text) {
        const auto loaded = load_config<PlannerConfig>(write(text));
        return loaded.ok() ? "" : loaded.error().detail;
    };
    EXPECT_THAT(method_error("vertex_concavity: {method: fast}\n"),
                HasSubstr("vertex_concavity.method = fast is none of any_angle, tetrahedral"));
    EXPECT_THAT(method_error("vertex_concavity: {method: [fast]}\n"),
                HasSubstr("must be a text in [any_angle, tetrahedral]"));
}

TEST_F(LoadConfig, ARepeatedKeyIsRefused) {
    EXPECT_THAT(error_of("inner: {ratio: 0.5, ratio: 0.6}\n"), HasSubstr("inner.ratio is given"));
}

TEST_F(LoadConfig, AFileThatIsMissingOrNoYamlIsUnreadable) {
    const std::filesystem::path files[] = {"/nowhere/planner.yaml", testing::TempDir(),
                                           write("inner: {ratio: 0.5\n")};
    for (const auto& file : files) {
        const auto loaded = load_config<Outer>(file);
        ASSERT_FALSE(loaded.ok()) << file;
        EXPECT_EQ(loaded.error().code, PlanErrorCode::kUnreadableFile);
        EXPECT_THAT(loaded.error().detail, HasSubstr(file.string()));
    }
}

TEST_F(LoadConfig, AForeignGroupIsSkippedButOnlyAtTheTop) {
    const auto loaded =
        load_config<Outer>(write("server: {port: 1}\nfast: true\n"), {}, {"server"});
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    EXPECT_TRUE(loaded.value().fast);
    const auto nested = load_config<Outer>(write("inner: {server: 1}\n"), {}, {"server"});
    EXPECT_FALSE(nested.ok());
}

TEST_F(LoadConfig, WhatIsPrintedReadsBackTheSame) {
    Outer settings{true, 4, 1u << 20, "quote \" and\nnewline", {std::numbers::pi / 7, 12}};
    const std::string printed = print_config(settings);
    const auto loaded = load_config<Outer>(write(printed));
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    EXPECT_EQ(loaded.value().inner.ratio, settings.inner.ratio);
    EXPECT_EQ(loaded.value().label, settings.label);
    EXPECT_EQ(print_config(loaded.value()), printed);
}

TEST_F(LoadConfig, PrintsOneKeyALineNestedByTwoSpaces) {
    EXPECT_EQ(print_config(Outer{}),
              "fast: false\nshift: -3\nseed: 0\nlabel: \"plain\"\ninner:\n  ratio: 0.25\n"
              "  count: 7\n");
}

// The three published test vectors of 64 bit FNV-1a (Fowler, Noll, Vo).
TEST_F(LoadConfig, HashIsFnv1a) {
    EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325u);
    EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(config_hash_of("foobar"), "85944171f73967e8");
}

TEST_F(LoadConfig, HashChangesWithEveryValue) {
    Outer changed;
    changed.inner.ratio = std::nextafter(0.25, 1.0);
    EXPECT_EQ(config_hash(Outer{}), config_hash(Outer{}));
    EXPECT_NE(config_hash(Outer{}), config_hash(changed));
}

}  // namespace
}  // namespace graspd
