#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/global_control.h>

#include "graspd/planner/planner.hpp"
#include "plan_input.hpp"

namespace graspd::fuzz {
namespace {

using Eigen::Vector3d;

/// @param object  as of an earlier plan of this request, or null; comes back prepared
PlanReply plan_once(const PlanInput& input, PreparedObjectPtr& object) {
    std::atomic<unsigned> asked = 0;  // by several threads at a time
    return plan(input.request, object, input.config, [&] { return asked++ >= input.stop_after; });
}

/// One thread asks in the same order every time.
PlanReply plan_on_one_thread(const PlanInput& input, PreparedObjectPtr& object) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    return plan_once(input, object);
}

void require_pose(const Eigen::Isometry3d& pose, const char* which) {
    require(pose.matrix().allFinite(), std::string(which) + " is finite");
    const double length = Eigen::Quaterniond(pose.linear()).norm();
    require(std::abs(length - 1.0) < 1e-6, std::string(which) + " has a unit quaternion");
    const Eigen::Matrix3d R = pose.linear();
    require((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-6,
            std::string(which) + " is a rotation");
}

void require_unit(const Vector3d& direction, const char* which) {
    require(std::abs(direction.norm() - 1.0) < 1e-6, std::string(which) + " is of unit length");
}

void check_score(const Grasp& grasp) {
    require(grasp.score >= 0.0 && grasp.score <= 1.0, "a score is in [0, 1]");
    double sum = 0.0;
    for (const ScoreTerm& term : grasp.terms) {
        require(std::isfinite(term.value), "term " + term.name + " is finite");
        sum += term.value;
    }
    const double logit = std::log(grasp.score / (1.0 - grasp.score));
    // Near 0 and 1 the score has fewer digits than its logit.
    const bool in_doubt = std::abs(sum) > 15.0;
    require(in_doubt || std::abs(sum - logit) < 1e-6, "terms add up to logit(score)");
    require(std::abs(1.0 / (1.0 + std::exp(-sum)) - grasp.score) < 1e-9, "score is of its terms");
}

void check_grasp(const Grasp& grasp, const PlanInput& input) {
    require_pose(grasp.X_FG, "a grasp");
    require_pose(grasp.X_FG_pregrasp, "a pre-grasp");
    require_pose(grasp.X_FH, "a hand's pose");
    require_unit(grasp.approach.direction_F, "an approach");
    require_unit(grasp.retreat.direction_F, "a retreat");
    for (const Contact& contact : grasp.contacts) {
        require(contact.point_F.allFinite(), "a contact is finite");
        require_unit(contact.normal_F, "a contact's normal");
    }
    for (const double number : {grasp.approach.distance_m, grasp.retreat.distance_m, grasp.width_m,
                                grasp.open_width_m, grasp.concavity_depth_m, grasp.clearance_m,
                                grasp.beta_rad, grasp.min_friction, grasp.min_force_N}) {
        require(std::isfinite(number) && number >= 0.0,
                "a grasp's numbers are finite, not below 0");
    }
    if (grasp.tolerance) {
        require(grasp.tolerance->shift_m >= 0.0 && grasp.tolerance->turn_rad >= 0.0 &&
                    std::isfinite(grasp.tolerance->shift_m + grasp.tolerance->turn_rad),
                "a tolerance is finite");
    }
    const auto gripper =
        std::ranges::find(input.request.grippers, grasp.gripper_name, &Gripper::name);
    require(gripper != input.request.grippers.end(), "a grasp is for a gripper that was asked for");
    require(grasp.open_width_m >= grasp.width_m, "fingers close");
    require(grasp.open_width_m <= gripper->max_width_m + 1e-9, "fingers open as far as they can");
    require(grasp.clearance_m >= input.request.options.min_clearance_m, "the clearance is kept");
    require(grasp.min_friction <= input.request.options.friction + 1e-9, "friction holds a grasp");
    check_score(grasp);
}

void check_reply(const PlanReply& reply, const PlanInput& input) {
    require(std::string(to_string(reply.status)) != "UNKNOWN", "a status is terminal");
    require(reply.status != PlanStatus::kInternalError, "no input is our fault: " + reply.message);
    const bool ok = reply.status == PlanStatus::kOk;
    const bool partial = reply.status == PlanStatus::kPartial;
    require(ok == reply.message.empty(), "a message says why not OK, and nothing else");
    require(ok ? !reply.grasps.empty() : partial || reply.grasps.empty(), "grasps are for OK");
    require(reply.grasps.size() <= input.request.options.max_grasps, "no more than asked for");
    require(reply.report.near_misses.size() <= 3, "three near misses at most");
    require(!partial || input.stop_after < std::numeric_limits<unsigned>::max(),
            "only who is told to stop stops");
    double last = 1.0;
    for (const Grasp& grasp : reply.grasps) {
        check_grasp(grasp, input);
        require(grasp.score <= last, "grasps are ranked");
        last = grasp.score;
    }
    for (const NearMiss& miss : reply.report.near_misses) {
        require_pose(miss.X_FG, "a near miss");
        require(std::isfinite(miss.margin), "a margin is finite");
    }
    for (const Finding& finding : reply.report.findings) {
        require(std::isfinite(finding.value), "finding " + finding.code + " has a finite value");
    }
}

/// Everything of a reply but the stages' times, bit for bit.
class Print {
public:
    explicit Print(const PlanReply& reply) {
        add(reply.object_key);
        add(to_string(reply.status));
        add(reply.message);
        add(reply.strategy);
        for (const Grasp& grasp : reply.grasps) add(grasp);
        for (const StageReport& stage : reply.report.stages) {
            add(stage.name + ' ' + std::to_string(stage.in) + ' ' + std::to_string(stage.out));
        }
        for (const RejectionCount& row : reply.report.rejections) {
            add(row.reason + ' ' + std::to_string(row.count));
        }
        for (const NearMiss& miss : reply.report.near_misses) {
            add(miss.X_FG);
            add(miss.reason + miss.unit);
            add(miss.margin);
        }
        for (const Finding& finding : reply.report.findings) {
            add(finding.code + finding.detail);
            add(finding.value);
        }
        add(reply.report.suggestion);
    }
    friend bool operator==(const Print&, const Print&) = default;

private:
    void add(const std::string& text) { text_ += text + '\n'; }
    void add(double number) { add(std::to_string(std::bit_cast<std::uint64_t>(number))); }
    void add(const Vector3d& vector) {
        for (const double value : vector) add(value);
    }
    void add(const Eigen::Isometry3d& pose) {
        for (const double value : pose.matrix().reshaped()) add(value);
    }
    void add(const Grasp& grasp) {
        for (const auto& pose : {grasp.X_FG, grasp.X_FG_pregrasp, grasp.X_FH}) add(pose);
        for (const LinearMotion& motion : {grasp.approach, grasp.retreat}) {
            add(motion.direction_F);
            add(motion.distance_m);
        }
        for (const Contact& contact : grasp.contacts) {
            add(contact.point_F);
            add(contact.normal_F);
        }
        for (const double number :
             {grasp.width_m, grasp.open_width_m, grasp.concavity_depth_m, grasp.clearance_m,
              grasp.beta_rad, grasp.min_friction, grasp.min_force_N, grasp.score}) {
            add(number);
        }
        add(grasp.gripper_name + ' ' + std::to_string(grasp.concavity_index) +
            to_string(grasp.source));
        for (const ScoreTerm& term : grasp.terms) {
            add(term.name);
            add(term.value);
        }
        if (!grasp.tolerance) return;
        add(grasp.tolerance->shift_m);
        add(grasp.tolerance->turn_rad);
    }

    std::string text_;
};

}  // namespace

bool fuzz_plan(Bytes bytes) {
    const PlanInput input = make_plan_input(bytes);
    PreparedObjectPtr object;
    const PlanReply alone = plan_on_one_thread(input, object);
    check_reply(alone, input);
    if (input.twice) {
        // Who is stopped after a count is stopped elsewhere by several threads, or when the object
        // is there already.
        const bool may_stop = input.stop_after < std::numeric_limits<unsigned>::max();
        PreparedObjectPtr none;
        const PlanReply again =
            may_stop ? plan_on_one_thread(input, none) : plan_once(input, object);
        require(Print(again) == Print(alone), "the same request gives the same reply");
    }
    return !alone.object_key.empty() && alone.status != PlanStatus::kInvalidRequest;
}

}  // namespace graspd::fuzz
