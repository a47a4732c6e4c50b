#include "refine_grasps.hpp"

#include <algorithm>
#include <optional>
#include <span>

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

/// One round of all grasps, all of their moves side by side. Notes what was improved.
void refine(std::span<GradedGrasp> grasps, double shift_m, double turn_rad,
            const Judgement& judgement, std::vector<char>& improved) {
    std::vector<std::vector<Eigen::Isometry3d>> poses;
    for (const GradedGrasp& grasp : grasps) {
        poses.push_back(neighbours(grasp.X_PG, shift_m, turn_rad));
    }
    const std::size_t moves = poses.front().size();
    std::vector<std::optional<GradedGrasp>> moved(grasps.size() * moves);
    for_blocks(moved.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            moved[i] =
                evaluate_beside(poses[i / moves][i % moves], grasps[i / moves].width_m, judgement);
        }
    });
    for (std::size_t k = 0; k < grasps.size(); ++k) {
        GradedGrasp* best = nullptr;
        for (std::size_t move = k * moves; move < (k + 1) * moves; ++move) {
            const double least = (best ? best : &grasps[k])->score.score;
            if (moved[move] && moved[move]->score.score > least + kLeastGain) best = &*moved[move];
        }
        if (!best) continue;
        best->axis = grasps[k].axis;
        grasps[k] = std::move(*best);
        improved[k] = 1;
    }
}

}  // namespace

void refine_grasps(std::vector<GradedGrasp>& grasps, const Judgement& judgement, StageLog& log) {
    constexpr const char* kRefine = "planner/refine_grasps";
    const SearchConfig& search = judgement.config.search;
    if (grasps.empty() || search.refined == 0) return;
    std::vector<RankedEntry> entries;
    for (const GradedGrasp& grasp : grasps) entries.push_back(entry_of(grasp));
    const auto ranking = rank_grasps(entries, search.refined, judgement.config.rank_grasps);
    if (!ranking || ranking.value().order.empty()) return;
    const std::vector<std::size_t>& chosen = ranking.value().order;
    std::vector<GradedGrasp> moved;  // all of them or, when this is stopped, none is taken
    for (const std::size_t i : chosen) moved.push_back(grasps[i]);
    std::vector<char> improved(chosen.size());
    log.run(kRefine, chosen.size(), [&] {
        double shift_m = search.refine_shift_m, turn_rad = search.refine_turn_rad;
        for (std::uint32_t round = 0; round < search.refine_rounds; ++round) {
            refine(moved, shift_m, turn_rad, judgement, improved);
            shift_m *= 0.5;
            turn_rad *= 0.5;
        }
        return 0;
    });
    for (std::size_t k = 0; k < chosen.size(); ++k) grasps[chosen[k]] = std::move(moved[k]);
    log.out(kRefine, static_cast<std::uint64_t>(std::ranges::count(improved, 1)));
}

}  // namespace graspd::planner_detail
