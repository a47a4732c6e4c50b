#include <gtest/gtest.h>

#include "graspd/config/load_config.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/planner/planner_config.hpp"
#include "negative/verdict.hpp"

// Gripper profiles and planner.yaml with one mistake: the error names file, key and value.

namespace graspd::test {
namespace {

constexpr auto kInvalid = PlanErrorCode::kInvalidInput;

const std::string kHand =
    "name: hand\nmax_width: 0.1\nfinger_length: 0.05\nfinger_width: 0.02\n"
    "finger_thickness: 0.01\ntip_offset: 0.012\npalm_width: 0.13\npalm_height: 0.06\n"
    "palm_depth: 0.09\n";

/// The profile without a line, and with another in its place.
std::string hand(const std::string& key, const std::string& line = "") {
    const std::size_t at = kHand.find("\n" + key + ":") + 1;
    std::string text = kHand;
    return text.replace(at, text.find('\n', at) + 1 - at, line.empty() ? "" : line + "\n");
}

BadFile missing(const std::string& key) {
    return {"No_" + key, "a.yaml", hand(key), refused(kInvalid, {"a.yaml", key + " is missing"})};
}
BadFile wrong(const std::string& name, const std::string& key, const std::string& value,
              const std::string& says) {
    return {name, "a.yaml", hand(key, key + ": " + value),
            refused(kInvalid, {"a.yaml", key, says})};
}

const BadFile kGrippers[] = {
    missing("max_width"),
    missing("finger_length"),
    missing("finger_width"),
    missing("finger_thickness"),
    missing("tip_offset"),
    missing("palm_width"),
    missing("palm_height"),
    missing("palm_depth"),
    wrong("WidthZero", "max_width", "0", "max_width = 0 "),
    wrong("WidthNegative", "max_width", "-0.1", "max_width = -0.1"),
    wrong("WidthInMillimetres", "max_width", "85", "max_width = 85 "),
    wrong("WidthWithUnit", "max_width", "85mm", "max_width = 85mm must be a number"),
    wrong("WidthWithComma", "max_width", "0,085", "max_width = 0,085 must be a number"),
    wrong("WidthQuoted", "max_width", "\"0.1\"", "must be a number"),
    wrong("WidthAList", "max_width", "[0.1]", "(a list)"),
    wrong("WidthAGroup", "max_width", "{m: 0.1}", "(a group of keys)"),
    wrong("WidthNothing", "max_width", "", "max_width"),
    wrong("LengthNan", "finger_length", ".nan", "finger_length"),
    wrong("LengthInfinite", "finger_length", "1e999", "finger_length"),
    wrong("TipBehindTheFinger", "tip_offset", "0.06", "tip_offset = 0.06"),
    wrong("PalmNegative", "palm_depth", "-0.09", "palm_depth = -0.09"),
    {"Empty", "a.yaml", "", refused(kInvalid, {"name is missing"})},
    {"NoName", "a.yaml", kHand.substr(11), refused(kInvalid, {"name is missing"})},
    {"NameOfTwoWords", "a.yaml", "name: two words\n" + kHand.substr(11),
     refused(kInvalid, {"name = two words must be"})},
    {"NameTooLong", "a.yaml", "name: " + std::string(65, 'x') + "\n" + kHand.substr(11),
     refused(kInvalid, {"must be 1 to 64"})},
    {"NameNotAscii", "a.yaml", "name: m\xc3\xa4nd\n" + kHand.substr(11),
     refused(kInvalid, {"must be 1 to 64"})},
    {"UnknownKey", "a.yaml", kHand + "colour: red\n",
     refused(kInvalid, {"a.yaml:10: unknown key colour"})},
    {"KeyTwice", "a.yaml", kHand + "palm_depth: 0.1\n",
     refused(kInvalid, {"palm_depth is given twice"})},
    {"AList", "a.yaml", "- 1\n- 2\n", refused(kInvalid, {"the file = (a list)"})},
    {"NotYaml", "a.yaml", "name: [\n", unreadable({"a.yaml", "not YAML"})},
    {"Tab", "a.yaml", "name: hand\n\tmax_width: 0.1\n", unreadable({"a.yaml", "not YAML"})},
    {"TravelNoList", "a.yaml", kHand + "pad_travel: 5\n",
     refused(kInvalid, {"pad_travel = 5 must be a list"})},
    {"TravelHalfARow", "a.yaml", kHand + "pad_travel: [{opening: 0.1}]\n",
     refused(kInvalid, {"pad_travel row"})},
    {"TravelFalls", "a.yaml",
     kHand + "pad_travel: [{opening: 0.1, pad_z: 0.1}, {opening: 0.05, pad_z: 0.1}]\n",
     refused(kInvalid, {"pad_travel row 1", "0.05"})},
    {"PartOfNoMember", "a.yaml", kHand + "convex_parts: [{member: thumb, points: [[0, 0, 0]]}]\n",
     refused(kInvalid, {"convex_parts[0].member = thumb"})},
};

class Grippers : public testing::TestWithParam<BadFile> {};

TEST_P(Grippers, AreRefused) {
    const ScratchFolder folder;
    const auto loaded = load_gripper(folder.write(GetParam().file, GetParam().bytes));
    expect_verdict({loaded.ok() ? std::nullopt : std::optional(loaded.error()), {}},
                   GetParam().verdict);
}

BadFile setting(const std::string& name, const std::string& text,
                const std::vector<std::string>& says) {
    return {name, "planner.yaml", text, refused(kInvalid, says)};
}

const BadFile kSettings[] = {
    setting("UnknownGroup", "conditioning:\n  weld_tolerance: 0\n", {"unknown key conditioning"}),
    setting("UnknownKey", "condition_mesh:\n  weld: 0\n",
            {"planner.yaml:2", "condition_mesh.weld"}),
    setting("GroupAList", "condition_mesh: [1]\n", {"condition_mesh = (a list)"}),
    setting("GroupANumber", "condition_mesh: 1\n", {"condition_mesh = 1 must be a group"}),
    setting("GroupTwice", "condition_mesh: {}\ncondition_mesh: {}\n",
            {"condition_mesh is given twice"}),
    setting("ToleranceOutOfRange", "condition_mesh: {weld_tolerance: 1}\n",
            {"condition_mesh.weld_tolerance = 1 is outside [0, 0.001]"}),
    setting("ToleranceNan", "condition_mesh: {weld_tolerance: nan}\n", {"weld_tolerance = nan"}),
    setting("CountNegative", "condition_mesh: {max_faces: -4}\n", {"max_faces = -4"}),
    setting("CountAFraction", "condition_mesh: {max_faces: 4.5}\n", {"max_faces = 4.5"}),
    setting("CountTooLarge", "triangulate_cloud: {max_points: 99999999999}\n",
            {"max_points = 99999999999"}),
    setting("SwitchANumber", "condition_mesh: {alpha_wrap: 1}\n", {"alpha_wrap = 1"}),
    setting("SwitchAWord", "guess_units: {refuse: no}\n", {"guess_units.refuse = no"}),
    setting("UnknownMethod", "vertex_concavity: {method: guess}\n",
            {"vertex_concavity.method = guess"}),
    setting("UnitsBelowOne", "guess_units: {refuse_above: 0.5}\n",
            {"guess_units.refuse_above = 0.5"}),
    setting("OutliersNegative", "triangulate_cloud: {outlier_spacings: -1}\n",
            {"outlier_spacings = -1"}),
    setting("NoOneSide", "face_sensor: {one_sided_from: 0}\n", {"face_sensor.one_sided_from = 0"}),
    setting("AWord", "hello\n", {"planner.yaml", "hello"}),
    {"SettingsNotYaml", "planner.yaml", "a: b: c\n", unreadable({"planner.yaml", "not YAML"})},
    setting("Bytes", std::string("\x00\x01\x02\xff", 4), {"must be a group of keys"}),
};

class SettingFiles : public testing::TestWithParam<BadFile> {};

TEST_P(SettingFiles, AreRefused) {
    const ScratchFolder folder;
    const auto file = folder.write(GetParam().file, GetParam().bytes);
    const auto loaded = load_config<PlannerConfig>(file, {}, {"server", "ros"});
    expect_verdict({loaded.ok() ? std::nullopt : std::optional(loaded.error()), {}},
                   GetParam().verdict);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Grippers, testing::ValuesIn(kGrippers), kName);
INSTANTIATE_TEST_SUITE_P(Settings, SettingFiles, testing::ValuesIn(kSettings), kName);

TEST(Profiles, AFolderIsNoProfile) {
    const ScratchFolder folder;
    for (const auto& path : {folder.path(), folder.path() / "none.yaml"}) {
        EXPECT_EQ(load_gripper(path).error().code, PlanErrorCode::kUnreadableFile);
        EXPECT_EQ(load_config<PlannerConfig>(path, {}, {}).error().code,
                  PlanErrorCode::kUnreadableFile);
    }
}

}  // namespace
}  // namespace graspd::test
