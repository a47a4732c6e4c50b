#include "export_hand.hpp"

#include <algorithm>

#include "graspd/config/load_gripper.hpp"
#include "graspd/config/load_moveit_hand.hpp"

namespace graspd::cli {
namespace {

using std::filesystem::path;

bool is_file(const std::string& name_or_file) {
    return name_or_file.ends_with(".yaml") || name_or_file.ends_with(".urdf");
}

std::string gripper_member(std::size_t index) {
    return "grasps[" + std::to_string(index) + "].gripper";
}

}  // namespace

Result<ExportHand> find_hand(const std::string& name_or_file, const path& grippers) {
    auto gripper = find_gripper(name_or_file, grippers);
    if (!gripper.ok()) return gripper.error();
    if (is_file(name_or_file)) {
        const path profile = path(name_or_file).replace_extension(".yaml");
        auto moveit = load_moveit_hand(profile, gripper.value());
        if (!moveit.ok()) return moveit.error();
        return ExportHand{std::move(gripper).value(), std::move(moveit).value()};
    }
    const auto all = load_moveit_hands(grippers);
    if (!all.ok()) return all.error();
    const auto named = std::ranges::find(all.value(), name_or_file, &MoveItHand::gripper);
    ExportHand hand{std::move(gripper).value(), {}};
    if (named != all.value().end()) hand.moveit = *named;
    return hand;
}

Result<std::vector<ExportHand>> find_hands(const GraspFile& file, const path& grippers) {
    std::vector<ExportHand> hands;
    for (std::size_t i = 0; i < file.grasps.size(); ++i) {
        const std::string& name = file.grasps[i].gripper_name;
        const auto same = [&](const ExportHand& hand) { return hand.gripper.name == name; };
        if (std::ranges::any_of(hands, same)) continue;
        // A name from a file must not be taken for a path.
        const PlanError unknown = {PlanErrorCode::kUnknownGripper,
                                   "gripper = " + name + " is no profile's name"};
        auto hand = is_file(name) ? Result<ExportHand>(unknown) : find_hand(name, grippers);
        if (!hand.ok()) {
            return PlanError{hand.error().code, "grasps[" + std::to_string(i) +
                                                    "]: " + hand.error().detail +
                                                    "; say which by --gripper NAME|FILE"};
        }
        hands.push_back(std::move(hand).value());
    }
    return hands;
}

Result<ExportHand> hand_of(const GraspFile& file, std::size_t index,
                           std::span<const ExportHand> hands) {
    const std::string& name = file.grasps[index].gripper_name;
    std::string known;
    for (const ExportHand& hand : hands) {
        if (hand.gripper.name == name) return hand;
        known += (known.empty() ? "" : ", ") + hand.gripper.name;
    }
    return PlanError{PlanErrorCode::kUnknownGripper,
                     gripper_member(index) + " = " + name + ", but what is known is " + known};
}

std::optional<PlanError> check_one_gripper(const GraspFile& file, const std::string& format) {
    for (std::size_t i = 1; i < file.grasps.size(); ++i) {
        if (file.grasps[i].gripper_name == file.grasps[0].gripper_name) continue;
        return PlanError{PlanErrorCode::kInvalidInput,
                         gripper_member(i) + " = " + file.grasps[i].gripper_name + ", but format " +
                             format + " is about one gripper, here " + file.grasps[0].gripper_name};
    }
    return std::nullopt;
}

}  // namespace graspd::cli
