#include "graspd/planner/guess_units.hpp"

#include <gmock/gmock.h>

#include "graspd/base/settings.hpp"
#include "graspd/planner/planner.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

/// With the default opening of 85 mm the limits are 0.85 m, 8.5 m, 1.7 mm and 0.17 mm.
std::vector<Gripper> grippers() {
    Gripper gripper;
    gripper.name = "hand";
    return {gripper};
}

struct Case {
    const char* name;
    Eigen::Vector3d size_m;
    char verdict;  ///< '-' nothing, 's' suspected, 'r' refused
    double factor;
};
void PrintTo(const Case& row, std::ostream* out) {
    *out << row.name;
}

class UnitTable : public testing::TestWithParam<Case> {};

TEST_P(UnitTable, GivesTheVerdict) {
    const Case& row = GetParam();
    const auto guess = guess_units(row.size_m, grippers(), {});
    ASSERT_EQ(guess.ok(), row.verdict != 'r');
    if (row.verdict == 'r') {
        EXPECT_EQ(guess.error().code, PlanErrorCode::kInvalidInput);
        std::ostringstream factor;
        factor << "factor " << row.factor << " makes";
        EXPECT_THAT(guess.error().detail, HasSubstr(factor.str()));
        return;
    }
    ASSERT_EQ(guess.value().has_value(), row.verdict == 's');
    if (row.verdict != 's') return;
    EXPECT_EQ(guess.value()->code, "units_suspected");
    EXPECT_EQ(guess.value()->value, row.factor);
}

// The factor is the one whose product with longest / 0.085 has the smaller |log|: a door's 14.1
// openings are 0.141 in cm (|log10| 0.85) and 0.0141 in mm (1.85).
const Case kCases[] = {
    {"Mug", {0.12, 0.08, 0.1}, '-', 0},
    {"Bead", {0.002, 0.002, 0.002}, '-', 0},
    {"BroomHead", {0.3, 0.1, 0.84}, '-', 0},
    {"Plank", {2.0, 0.1, 0.02}, 's', 0.01},
    {"CarDoor", {1.2, 1.0, 0.15}, 's', 0.01},
    {"Pole", {12.0, 0.03, 0.03}, 's', 0.01},    // long, but of a section that fits
    {"Container", {6.1, 2.4, 2.6}, 's', 0.01},  // 72 openings
    {"MugInMillimetres", {120, 80, 100}, 'r', 0.001},
    {"ScrewInMillimetres", {20, 5, 5}, 'r', 0.01},  // 2.35 openings in cm, 0.235 in mm
    {"RulerInMillimetres", {300, 30, 1}, 'r', 0.001},
    {"MugInCentimetres", {12, 8, 10}, 'r', 0.01},
    {"BowlInCentimetres", {8.4, 8.4, 4}, 's', 0.01},  // 98.8 openings: just not refused
    {"Speck", {0.0016, 0.001, 0.001}, 's', 100},
    {"MugScaledTwice", {0.00012, 0.00008, 0.0001}, 'r', 1000},
    {"Nothing", {0, 0, 0}, 'r', 1000},
};
INSTANTIATE_TEST_SUITE_P(GuessUnits, UnitTable, testing::ValuesIn(kCases),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(GuessUnits, SaysSizeFactorAndWhatHelps) {
    const auto guess = guess_units({80, 120, 100}, grippers(), {});
    ASSERT_FALSE(guess.ok());
    for (const char* part :
         {"120 x 100 x 80 m", "1412 times the opening 0.085 m of hand",
          "factor 0.001 makes 120 x 100 x 80 mm", "--units mm", "guess_units.refuse: false"}) {
        EXPECT_THAT(guess.error().detail, HasSubstr(part));
    }
}

TEST(GuessUnits, TheWidestGripperCounts) {
    std::vector<Gripper> two = grippers();
    two.push_back(two.front());
    two.back().max_width_m = 0.85;
    EXPECT_FALSE(guess_units({2.0, 0.1, 0.02}, two, {}).value().has_value());
}

TEST(GuessUnits, OnlyReportsWhenToldSo) {
    GuessUnitsConfig config;
    config.refuse = false;
    const auto guess = guess_units({120, 80, 100}, grippers(), config);
    ASSERT_TRUE(guess.ok());
    EXPECT_EQ(guess.value()->value, 0.001);
}

TEST(GuessUnits, LimitsHaveRanges) {
    GuessUnitsConfig config;
    config.refuse_above = 0.5;
    EXPECT_THAT(validate(config, "guess_units.")->detail,
                HasSubstr("guess_units.refuse_above = 0.5"));
}

// The same verdicts from a whole plan: a turned box, whose own axes count and not the frame's.
TEST(GuessUnits, PlansAreRefusedOrSayWhatIsOdd) {
    PlanRequest request;
    request.grippers = grippers();
    const Eigen::Isometry3d pose = test::random_pose(5);
    request.object_O = test::moved(test::box({100.0, 60.0, 40.0}), pose);
    const PlanReply refused = plan(request, {});
    EXPECT_EQ(refused.status, PlanStatus::kInvalidRequest);
    EXPECT_THAT(refused.message, HasSubstr("object of 100 x 60 x 40 m"));
    request.object_O = test::moved(test::box({2.0, 0.1, 0.02}), pose);
    const PlanReply plank = plan(request, {});
    EXPECT_EQ(plank.status, PlanStatus::kOk) << plank.message;
    EXPECT_EQ(std::ranges::count(plank.report.findings, "units_suspected", &Finding::code), 1);
}

}  // namespace
}  // namespace graspd
