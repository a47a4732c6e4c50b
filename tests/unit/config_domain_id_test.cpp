#include "graspd/config/domain_id.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

namespace graspd {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ChooseDomain : public testing::Test {
protected:
    void SetUp() override { ::unsetenv("ROS_DOMAIN_ID"); }
    void TearDown() override { ::unsetenv("ROS_DOMAIN_ID"); }
    static void set_environment(const char* value) { ::setenv("ROS_DOMAIN_ID", value, 1); }
};

TEST_F(ChooseDomain, TheOptionGoesBeforeTheEnvironmentBeforeZero) {
    EXPECT_EQ(choose_domain(std::nullopt).value(), 0u);
    set_environment("");
    EXPECT_EQ(choose_domain(std::nullopt).value(), 0u);
    set_environment("42");
    EXPECT_EQ(choose_domain(std::nullopt).value(), 42u);
    EXPECT_EQ(choose_domain("7").value(), 7u);
    set_environment("broken");  // not asked, so not judged
    EXPECT_EQ(choose_domain("232").value(), 232u);
}

TEST_F(ChooseDomain, ABadOneIsNamedWithItsValueAndRange) {
    for (const char* bad : {"233", "-1", "4294967296", "1.5", "7 ", "x"}) {
        const auto chosen = choose_domain(bad);
        ASSERT_FALSE(chosen.ok()) << bad;
        EXPECT_THAT(chosen.error().detail,
                    AllOf(HasSubstr(std::string("--domain = ") + bad), HasSubstr("[0, 232]")));
    }
    EXPECT_FALSE(choose_domain("").ok());
    set_environment("300");
    const auto chosen = choose_domain(std::nullopt);
    ASSERT_FALSE(chosen.ok());
    EXPECT_EQ(chosen.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(chosen.error().detail, HasSubstr("ROS_DOMAIN_ID = 300 must be"));
}

}  // namespace
}  // namespace graspd
