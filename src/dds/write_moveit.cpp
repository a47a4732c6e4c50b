#include <algorithm>

#include "convert_moveit.hpp"
#include "graspd/base/moveit_motion.hpp"

namespace graspd::dds {
namespace {

namespace codes = moveit::MoveItErrorCodes__Constants;

std_msgs::msg::dds_::Header_ header_of(const MoveItCall& call, const std::string& frame_id) {
    std_msgs::msg::dds_::Header_ header;
    header.stamp(call.target().header().stamp());
    header.frame_id(frame_id);
    return header;
}

/// One point for the joints of a hand; without joints nothing.
trajectory_msgs::msg::dds_::JointTrajectory_ posture(const MoveItHand& hand, const MoveItCall& call,
                                                     double opening_m, bool grips) {
    trajectory_msgs::msg::dds_::JointTrajectory_ out;
    out.header(header_of(call, ""));
    if (hand.joints.empty()) return out;
    auto& point = out.points().emplace_back();
    for (const MoveItJoint& joint : hand.joints) {
        out.joint_names().push_back(joint.name);
        point.positions().push_back(position_at(joint, opening_m));
    }
    // The force on a finger is a joint's effort only where the joint is the finger.
    if (grips && std::ranges::all_of(hand.joints, &MoveItJoint::slides)) {
        point.effort().assign(hand.joints.size(), PlanOptions{}.grip_force_N);
    }
    return out;
}

moveit::GripperTranslation_ translation(const std_msgs::msg::dds_::Header_& header,
                                        const LinearMotion& motion) {
    moveit::GripperTranslation_ out;
    out.direction().header(header);
    out.direction().vector(write_vector(motion.direction_F));
    out.desired_distance(static_cast<float>(motion.distance_m));
    out.min_distance(static_cast<float>(kMoveItLeastShare * motion.distance_m));
    return out;
}

/// After the object was put down the hand goes back along its own approach, wherever that is.
moveit::GripperTranslation_ release(const Grasp& grasp, const MoveItHand& hand,
                                    const MoveItCall& call) {
    if (hand.parent_link.empty()) {
        return translation(header_of(call, call.target().header().frame_id()),
                           {-grasp.approach.direction_F, grasp.approach.distance_m});
    }
    return translation(header_of(call, hand.parent_link),
                       {-approach_in_link(hand), grasp.approach.distance_m});
}

std::string id_of(const Grasp& grasp, std::size_t rank, const MoveItCall& call) {
    if (grasp.candidate >= 0) {
        const auto index = static_cast<std::size_t>(grasp.candidate);
        const auto& candidates = call.candidate_grasps();
        if (index < candidates.size() && !candidates[index].id().empty()) {
            return candidates[index].id();
        }
    }
    return "grasp_" + std::to_string(rank);
}

std::int32_t code_of(const PlanReply& reply, const MoveItCall& call) {
    switch (reply.status) {
        case PlanStatus::kOk: return codes::SUCCESS_;
        case PlanStatus::kNoGrasp: return codes::PLANNING_FAILED_;
        case PlanStatus::kPartial:
            return reply.grasps.empty() ? codes::TIMED_OUT_ : codes::SUCCESS_;
        case PlanStatus::kInvalidRequest:
            return has_one_frame(call) ? codes::INVALID_OBJECT_NAME_
                                       : codes::FRAME_TRANSFORM_FAILURE_;
        case PlanStatus::kUnknownGripper: return codes::INVALID_GROUP_NAME_;
        case PlanStatus::kCancelled: return codes::PREEMPTED_;
        default: return codes::FAILURE_;
    }
}

}  // namespace

MoveItVerdict moveit_verdict(const PlanReply& reply, const MoveItCall& call) {
    MoveItVerdict verdict{code_of(reply, call), reply.message};
    if (verdict.val == codes::SUCCESS_ && reply.grasps.empty()) verdict.val = codes::FAILURE_;
    if (!reply.report.suggestion.empty()) {
        verdict.message += (verdict.message.empty() ? "" : "; ") + reply.report.suggestion;
    }
    return verdict;
}

std::vector<moveit::Grasp_> write_moveit_grasps(const PlanReply& reply, const MoveItCall& call,
                                                std::span<const MoveItHand> hands) {
    std::vector<moveit::Grasp_> out;
    const std::string& frame_id = call.target().header().frame_id();
    const std_msgs::msg::dds_::Header_ header = header_of(call, frame_id);
    for (const Grasp& grasp : reply.grasps) {
        const auto found = std::ranges::find(hands, grasp.gripper_name, &MoveItHand::gripper);
        const MoveItHand hand = found == hands.end() ? MoveItHand{} : *found;
        moveit::Grasp_& entry = out.emplace_back();
        entry.id(id_of(grasp, out.size(), call));
        entry.pre_grasp_posture(posture(hand, call, grasp.open_width_m, false));
        entry.grasp_posture(posture(hand, call, grasp.width_m, true));
        entry.grasp_pose().header(header);
        entry.grasp_pose().pose(write_pose(grasp.X_FH * hand.X_HP));
        entry.grasp_quality(grasp.score);
        entry.pre_grasp_approach(translation(header, grasp.approach));
        entry.post_grasp_retreat(translation(header, grasp.retreat));
        entry.post_place_retreat(release(grasp, hand, call));
        entry.max_contact_force(static_cast<float>(PlanOptions{}.grip_force_N));
        entry.allowed_touch_objects().push_back(call.target().id());
    }
    return out;
}

}  // namespace graspd::dds
