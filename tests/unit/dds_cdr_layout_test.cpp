#include "cdr_layout.hpp"

#include <gmock/gmock.h>

namespace graspd::dds {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;

constexpr const char* kIdl = R"(
// a comment with struct Nothing_ { in it
module m {
module Word_Constants { const octet A_ = 1; ///< };
};
@final
struct Pair_ { long a; unsigned long b; };
@final
struct Mixed_ {
    octet tag;
    double value[2];
    sequence<m::Pair_, 4> pairs;
    string<8> name;
    sequence<string> words;
    sequence<boolean> flags;
    long long big;
};
};
)";

const CdrLayouts& layouts() {
    static const CdrLayouts parsed = CdrLayouts::parse(kIdl).value();
    return parsed;
}

/// Mixed_ in little-endian CDR, byte by byte as the OMG specification lays it out: alignment counts
/// from behind the 4 bytes of encapsulation.
Bytes mixed() {
    return {0, 1, 0, 0,                                                      // CDR_LE
            7, 0, 0, 0, 0,   0,   0, 0,                                      // tag, padded to 8
            0, 0, 0, 0, 0,   0,   0, 0, 0, 0, 0, 0, 0, 0, 0, 0,              // value
            2, 0, 0, 0, 1,   0,   0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0,  // two pairs
            3, 0, 0, 0, 'h', 'i', 0, 0,                                      // name, padded to 4
            1, 0, 0, 0, 1,   0,   0, 0, 0, 0, 0, 0,  // one empty word, padded to 4
            2, 0, 0, 0, 1,   0,   0, 0,              // two flags, padded to 8
            9, 0, 0, 0, 0,   0,   0, 0};             // big, at 72
}

TEST(CdrLayout, ParsesWhatTheWireUses) {
    const CdrStruct* pair = layouts().find("m::Pair_");
    ASSERT_NE(pair, nullptr);
    EXPECT_EQ(pair->least_bytes, 8u);
    EXPECT_EQ(pair->uniform_bytes, 4u);
    const CdrStruct* type = layouts().find("m::Mixed_");
    ASSERT_NE(type, nullptr);
    EXPECT_EQ(type->members.size(), 7u);
    EXPECT_EQ(type->least_bytes, 1u + 16 + 4 + 4 + 4 + 4 + 8);
    EXPECT_EQ(type->uniform_bytes, 0u);
    EXPECT_EQ(layouts().find("m::Nothing_"), nullptr);
}

TEST(CdrLayout, NamesTheWordItCannotRead) {
    const auto unknown = CdrLayouts::parse("module m { @final struct A_ { m::B_ b; }; };");
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(unknown.error().detail, HasSubstr("m::B_"));
    EXPECT_THAT(CdrLayouts::parse("module m { union U {}; };").error().detail, HasSubstr("union"));
    EXPECT_THAT(CdrLayouts::parse("module m {").error().detail, HasSubstr("end of file"));
    EXPECT_FALSE(CdrLayouts::parse("module m { @final struct A_ { long a[0]; }; };").ok());
}

TEST(CdrLayout, AcceptsTheSampleAndNothingShorter) {
    const CdrStruct& type = *layouts().find("m::Mixed_");
    const Bytes bytes = mixed();
    ASSERT_TRUE(is_well_formed(bytes, type));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_FALSE(is_well_formed(std::span(bytes).first(length), type)) << length;
    }
}

TEST(CdrLayout, AcceptsPaddingUpToThreeBytes) {
    const CdrStruct& type = *layouts().find("m::Mixed_");
    Bytes bytes = mixed();
    for (std::size_t extra = 1; extra <= 3; ++extra) {
        bytes.push_back(0);
        EXPECT_TRUE(is_well_formed(bytes, type)) << extra;
    }
    bytes.push_back(0);
    EXPECT_FALSE(is_well_formed(bytes, type));
}

TEST(CdrLayout, RefusesOtherEncapsulations) {
    const CdrStruct& type = *layouts().find("m::Mixed_");
    for (unsigned id = 0; id < 256; ++id) {
        Bytes bytes = mixed();
        bytes[1] = static_cast<std::uint8_t>(id);  // 0 reads the counts in the other order
        EXPECT_EQ(is_well_formed(bytes, type), id == 1) << id;
    }
    Bytes bytes = mixed();
    bytes[0] = 0x80;
    EXPECT_FALSE(is_well_formed(bytes, type));
}

TEST(CdrLayout, ReadsBigEndianCounts) {
    Bytes bytes = mixed();
    bytes[1] = 0;
    for (const std::size_t at : {28u, 48u, 56u, 60u, 68u}) std::swap(bytes[at], bytes[at + 3]);
    EXPECT_TRUE(is_well_formed(bytes, *layouts().find("m::Mixed_")));
}

// Each count and length, raised by one, by much, and to where a product would wrap.
TEST(CdrLayout, RefusesCountsThatDoNotFit) {
    const CdrStruct& type = *layouts().find("m::Mixed_");
    for (const std::size_t at : {28u, 48u, 56u, 60u, 68u}) {
        for (const std::uint32_t count : {100u, 0x20000001u, 0x80000000u, 0xffffffffu}) {
            Bytes bytes = mixed();
            for (std::size_t i = 0; i < 4; ++i) {
                bytes[at + i] = static_cast<std::uint8_t>(count >> (8 * i));
            }
            EXPECT_FALSE(is_well_formed(bytes, type)) << at << ' ' << count;
        }
    }
}

TEST(CdrLayout, RefusesABooleanOfTwo) {
    Bytes bytes = mixed();
    bytes[72] = 2;
    EXPECT_FALSE(is_well_formed(bytes, *layouts().find("m::Mixed_")));
}

}  // namespace
}  // namespace graspd::dds
