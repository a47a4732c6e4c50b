#include "refine_grasps.hpp"

#include <algorithm>
#include <optional>

#include "graspd/base/parallel.hpp"

namespace graspd::planner_detail {
namespace {

constexpr double kLeastGain = 1e-3;  // of the score: what a move must be worth

/// The poses one step away.
std::vector<Eigen::Isometry3d> neighbours(const Eigen::Isometry3d& X_PG, double shift_m,
                                          double turn_rad) {
    std::vector<Eigen::Isometry3d> poses;
    for (const double side : {-1.0, 1.0}) {
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
            if (axis != 0) poses.push_back(X_PG * Eigen::Translation3d(side * shift_m * along));
            poses.push_back(X_PG * Eigen::AngleAxisd(side * turn_rad, along));
        }
    }
    return poses;
}

/// @return whether it was improved
bool refine(GradedGrasp& grasp, const Judgement& judgement) {
    const SearchConfig& search = judgement.config.search;
    double shift_m = search.refine_shift_m, turn_rad = search.refine_turn_rad;
    bool improved = false;
    for (std::uint32_t round = 0; round < search.refine_rounds; ++round) {
        std::optional<GradedGrasp> best;
        for (const Eigen::Isometry3d& X_PG : neighbours(grasp.X_PG, shift_m, turn_rad)) {
            Rejections unused;
            StageLog untold;
            auto moved =
                evaluate_pose(axis_through(X_PG, grasp.width_m), {}, judgement, unused, untold);
            const double least = best ? best->score.score : grasp.score.score;
            if (moved && moved->score.score > least + kLeastGain) best = std::move(moved);
        }
        if (best) {
            best->axis = grasp.axis;
            grasp = std::move(*best);
            improved = true;
        }
        shift_m *= 0.5;
        turn_rad *= 0.5;
    }
    return improved;
}

}  // namespace

void refine_grasps(std::vector<GradedGrasp>& grasps, const Judgement& judgement, StageLog& log) {
    constexpr const char* kRefine = "planner/refine_grasps";
    if (grasps.empty() || judgement.config.search.refined == 0) return;
    std::vector<RankedEntry> entries;
    for (const GradedGrasp& grasp : grasps) entries.push_back(entry_of(grasp));
    const auto ranking =
        rank_grasps(entries, judgement.config.search.refined, judgement.config.rank_grasps);
    if (!ranking) return;
    const std::vector<std::size_t>& chosen = ranking.value().order;
    std::vector<GradedGrasp> moved;  // all of them or, when this is stopped, none is taken
    for (const std::size_t i : chosen) moved.push_back(grasps[i]);
    std::vector<char> improved(chosen.size());
    log.run(kRefine, chosen.size(), [&] {
        for_blocks(chosen.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) improved[k] = refine(moved[k], judgement);
        });
        return 0;
    });
    for (std::size_t k = 0; k < chosen.size(); ++k) grasps[chosen[k]] = std::move(moved[k]);
    log.out(kRefine, static_cast<std::uint64_t>(std::ranges::count(improved, 1)));
}

}  // namespace graspd::planner_detail
