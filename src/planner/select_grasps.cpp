#include "select_grasps.hpp"

#include <algorithm>

namespace graspd::planner_detail {
namespace {

constexpr const char* kRank = "grasp/rank_grasps";
// With a demand on clearance so many grasps at least are measured, since the best may not meet it.
constexpr std::uint32_t kLeastChoice = 64;
constexpr const char* kClearance = "collision/gripper_collision";

/// Ranks and keeps the best, in their order.
Result<std::vector<GradedGrasp>> best_of(const std::vector<GradedGrasp>& grasps, std::uint32_t most,
                                         const PlannerConfig& config, Rejections& rejections,
                                         StageLog& log) {
    std::vector<RankedEntry> entries;
    entries.reserve(grasps.size());
    for (const GradedGrasp& grasp : grasps) {
        entries.push_back(
            {grasp.score.score, grasp.X_PG, grasp.gripper->finger_width_m, grasp.axis.concavity});
    }
    const auto ranking = log.run(kRank, entries.size(),
                                 [&] { return rank_grasps(entries, most, config.rank_grasps); });
    if (!ranking) return ranking.error();
    rejections.add("duplicate", ranking.value().duplicates);
    rejections.add("surplus", ranking.value().surplus);
    std::vector<GradedGrasp> kept;
    for (const std::size_t i : ranking.value().order) kept.push_back(grasps[i]);
    log.out(kRank, kept.size());
    return kept;
}

/// Measures the clearance, and the score anew. @return whether the request is content with it
bool measure_clearance(GradedGrasp& grasp, const CollisionWorld& world_P,
                       const PlanRequest& request, const PlannerConfig& config,
                       Rejections& rejections) {
    const auto boxes = swept_approach(*grasp.gripper, grasp.X_PG, grasp.width_m, grasp.open_width_m,
                                      config.manipulability.approach_distance_m);
    const Clearance clearance = find_clearance(world_P, boxes, config.search.most_clearance_m);
    grasp.evidence.clearance_m = clearance.distance_m;
    grasp.score = score_grasp(grasp.evidence, config.score_grasp);
    const double lacking_m = request.options.min_clearance_m - clearance.distance_m;
    if (lacking_m <= 0.0) return true;
    rejections.add_miss("clearance", grasp.X_PG, lacking_m, "m", config.search.most_clearance_m);
    return false;
}

Contact placed(const Contact& contact_P, const Eigen::Isometry3d& X_FP) {
    return {X_FP * contact_P.point_F, X_FP.linear() * contact_P.normal_F};
}

Grasp in_frame_F(const GradedGrasp& graded, const PlanRequest& request, const PlannerConfig& config,
                 const Eigen::Isometry3d& X_FP) {
    Grasp grasp;
    grasp.X_FG = X_FP * graded.X_PG;
    const Eigen::Vector3d approach_F = grasp.X_FG.linear().col(2);
    const double distance_m = config.manipulability.approach_distance_m;
    grasp.X_FG_pregrasp = grasp.X_FG;
    grasp.X_FG_pregrasp.translation() -= distance_m * approach_F;
    grasp.X_FH = grasp.X_FG * grasp_in_hand(*graded.gripper, graded.width_m).inverse();
    grasp.approach = {approach_F, distance_m};
    grasp.retreat = {
        request.support_plane ? request.support_plane->normal_F : Eigen::Vector3d(-approach_F),
        distance_m};
    grasp.width_m = graded.width_m;
    grasp.open_width_m = graded.open_width_m;
    grasp.contacts = {placed(graded.contacts_P[0], X_FP), placed(graded.contacts_P[1], X_FP)};
    grasp.gripper_name = graded.gripper->name;
    grasp.source = graded.axis.source;
    grasp.concavity_index = graded.axis.concavity;
    grasp.concavity_depth_m = graded.axis.depth_m;
    grasp.clearance_m = graded.evidence.clearance_m;
    grasp.beta_rad = graded.evidence.beta_rad;
    grasp.min_friction = graded.evidence.min_friction;
    grasp.min_force_N = min_grip_force_N(graded.evidence.mass_kg, graded.evidence.friction,
                                         graded.evidence.min_friction);
    grasp.score = graded.score.score;
    grasp.terms = graded.score.terms;
    return grasp;
}

}  // namespace

Result<std::vector<Grasp>> select_grasps(std::vector<GradedGrasp> grasps,
                                         const CollisionWorld& world_P, const PlanRequest& request,
                                         const PlannerConfig& config, const Eigen::Isometry3d& X_FP,
                                         Rejections& rejections, StageLog& log) {
    const std::uint32_t wanted = request.options.max_grasps;
    const std::uint32_t least = request.options.min_clearance_m > 0.0 ? kLeastChoice : 0;
    auto shortlist = best_of(grasps, std::max(2 * wanted, least), config, rejections, log);
    if (!shortlist) return shortlist.error();
    std::vector<GradedGrasp> clear;
    const int done = log.run(kClearance, shortlist.value().size(), [&] {
        for (GradedGrasp& grasp : shortlist.value()) {
            if (measure_clearance(grasp, world_P, request, config, rejections)) {
                clear.push_back(std::move(grasp));
            }
        }
        return 0;
    });
    static_cast<void>(done);
    log.out(kClearance, clear.size());
    const auto best = best_of(clear, wanted, config, rejections, log);
    if (!best) return best.error();
    std::vector<Grasp> result;
    for (const GradedGrasp& grasp : best.value()) {
        result.push_back(in_frame_F(grasp, request, config, X_FP));
    }
    return result;
}

}  // namespace graspd::planner_detail
