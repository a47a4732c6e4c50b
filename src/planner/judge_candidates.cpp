#include "judge_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "graspd/base/parallel.hpp"

namespace graspd::planner_detail {
namespace {

constexpr int kMostSteps = 8;        // until pads that travel forward meet where they stand
constexpr double kSettled_m = 1e-6;  // of the width
// Of the widest opening: from where the pads close, the first at which they begin outside.
constexpr std::array kReaches = {1.0, 0.75, 0.5, 0.35, 0.25};
constexpr std::size_t kBlock = 8;  // candidates that are kept or dropped together by a stop

/// Closes the pads of a hand that stands still, the grasp frame where they touch at this width.
Result<LocalCloud> close_at(const Eigen::Isometry3d& X_PG, const Judgement& judgement) {
    const Eigen::Vector2d pad = pad_half_size_m(judgement.gripper);
    for (std::size_t i = 0;; ++i) {
        const PadFootprint footprint{pad.x(), pad.y(),
                                     0.5 * kReaches[i] * judgement.gripper.max_width_m};
        auto cloud = local_cloud(judgement.object.mesh_P, *judgement.object.tree_P, X_PG, footprint,
                                 judgement.config.local_cloud);
        if (cloud.ok() || i + 1 == kReaches.size()) return cloud;
    }
}

/// The hand of a candidate, for a trace.
TracedCandidate traced(const Eigen::Isometry3d& X_PG, double width_m, const Judgement& judgement) {
    TracedCandidate candidate;
    candidate.X_PG = X_PG;
    candidate.width_m = width_m;
    candidate.gripper_name = judgement.gripper.name;
    candidate.source = kCandidate;
    return candidate;
}

/// The line that a hand closes along; a linkage's pads stand the further forward the narrower.
/// @return nothing when there is none: the reason has been counted
std::optional<ClosingAxis> closing_axis(const Eigen::Isometry3d& X_PH, const Judgement& judgement,
                                        Rejections& rejections) {
    double width_m = judgement.gripper.max_width_m;
    for (int step = 0;; ++step) {
        Eigen::Isometry3d X_PG = X_PH * grasp_in_hand(judgement.gripper, width_m);
        const auto cloud = close_at(X_PG, judgement);
        if (!cloud.ok()) {
            rejections.add("no_contact", [&] { return traced(X_PG, width_m, judgement); });
            return std::nullopt;
        }
        const double left_m = cloud.value().left.x_G, right_m = cloud.value().right.x_G;
        const double met_m = right_m - left_m;
        if (met_m <= judgement.gripper.min_width_m) {
            rejections.add("too_thin", [&] { return traced(X_PG, met_m, judgement); });
            return std::nullopt;
        }
        const bool settled = std::abs(met_m - width_m) < kSettled_m || step == kMostSteps;
        width_m = met_m;
        if (!settled) continue;
        X_PG.translation() += 0.5 * (left_m + right_m) * X_PG.linear().col(0);
        return axis_through(X_PG, width_m);
    }
}

bool is_allowed(const Eigen::Isometry3d& X_FH, const PlanRequest& request) {
    const auto& cones = request.approach_cones;
    return cones.empty() || std::ranges::any_of(cones, [&](const ApproachCone& cone) {
               return angle_between_rad(X_FH.linear().col(2), cone.axis_F) <= cone.half_angle_rad;
           });
}

struct CandidateAttempt {
    std::optional<GradedGrasp> grasp;
    Rejections rejections;
    StageLog log;
};

void judge(std::size_t index, const Judgement& judgement, CandidateAttempt& attempt) {
    const Eigen::Isometry3d& X_FH = judgement.request.candidates_FH[index];
    const Eigen::Isometry3d X_PH = judgement.X_FP.inverse() * X_FH;
    const double widest_m = judgement.gripper.max_width_m;
    if (!is_allowed(X_FH, judgement.request)) {
        attempt.rejections.add("outside_approach_cones", [&] {
            return traced(X_PH * grasp_in_hand(judgement.gripper, widest_m), widest_m, judgement);
        });
        return;
    }
    auto axis = closing_axis(X_PH, judgement, attempt.rejections);
    if (!axis) return;
    axis->source = kCandidate;
    axis->candidate = static_cast<std::int32_t>(index);
    attempt.grasp = evaluate_pose(*axis, {}, judgement, attempt.rejections, attempt.log);
}

void judge_blocks(const Judgement& judgement, StageLog& log, SearchResult& result) {
    constexpr const char* kStage = "planner/judge_candidates";
    const std::size_t count = judgement.request.candidates_FH.size();
    for (std::size_t start = 0; start < count; start += kBlock) {
        const CandidateAttempt untried{{}, Rejections(judgement.traced), {}};
        std::vector<CandidateAttempt> attempts(std::min(kBlock, count - start), untried);
        log.run(kStage, attempts.size(), [&] {
            for_blocks(attempts.size(), 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) judge(start + i, judgement, attempts[i]);
            });
            return 0;
        });
        for (CandidateAttempt& attempt : attempts) {
            log.merge(attempt.log);
            result.rejections.merge(attempt.rejections);
            if (!attempt.grasp) continue;
            log.out(kStage, 1);
            result.grasps.push_back(std::move(*attempt.grasp));
        }
    }
}

}  // namespace

SearchResult judge_candidates(const Judgement& judgement, StageLog& log) {
    SearchResult result{{}, Rejections(judgement.traced), {}, {}};
    try {
        judge_blocks(judgement, log, result);
    } catch (const Stopped& stopped) {
        result.stopped = stopped;
    }
    return result;
}

}  // namespace graspd::planner_detail
