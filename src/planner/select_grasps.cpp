#include "select_grasps.hpp"

#include <algorithm>

#include "graspd/base/parallel.hpp"

namespace graspd::planner_detail {
namespace {

constexpr const char* kRank = "grasp/rank_grasps";
constexpr const char* kClearance = "collision/gripper_collision";

/// Ranks and keeps the best, in their order.
Result<std::vector<GradedGrasp>> best_of(const std::vector<GradedGrasp>& grasps, std::uint32_t most,
                                         const RankGraspsConfig& config, Rejections& rejections,
                                         StageLog& log) {
    std::vector<RankedEntry> entries;
    entries.reserve(grasps.size());
    for (const GradedGrasp& grasp : grasps) entries.push_back(entry_of(grasp));
    const auto ranking =
        log.run(kRank, entries.size(), [&] { return rank_grasps(entries, most, config); });
    if (!ranking) return ranking.error();
    for (const std::size_t i : ranking.value().duplicates) {
        rejections.add("duplicate", [&] { return traced(grasps[i]); });
    }
    for (const std::size_t i : ranking.value().surplus) {
        rejections.add("surplus", [&] { return traced(grasps[i]); });
    }
    std::vector<GradedGrasp> kept;
    for (const std::size_t i : ranking.value().order) kept.push_back(grasps[i]);
    log.out(kRank, kept.size());
    return kept;
}

/// [m] up to most_m, one a grasp.
std::vector<double> clearances_m(const std::vector<GradedGrasp>& grasps,
                                 const CollisionWorld& world_P, double most_m,
                                 const PlannerConfig& config) {
    std::vector<double> clear_m(grasps.size());
    for_blocks(grasps.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const GradedGrasp& grasp = grasps[i];
            const ApproachShape shape{grasp.width_m, grasp.open_width_m,
                                      config.manipulability.approach_distance_m};
            clear_m[i] =
                approach_clearance(world_P, *grasp.gripper, grasp.X_PG, shape, most_m).distance_m;
        }
    });
    return clear_m;
}

/// Drops the grasps that come nearer to anything than the request allows. All of them are asked,
/// before likes fall: one that is clear may stand far down in the ranking.
void drop_nearer(std::vector<GradedGrasp>& grasps, const CollisionWorld& world_P, double least_m,
                 const PlannerConfig& config, Rejections& rejections) {
    if (!(least_m > 0.0)) return;
    const auto clear_m = clearances_m(grasps, world_P, least_m, config);
    std::vector<GradedGrasp> clear;
    for (std::size_t i = 0; i < grasps.size(); ++i) {
        const double lacking_m = least_m - clear_m[i];
        if (lacking_m <= 0.0) {
            clear.push_back(std::move(grasps[i]));
        } else {
            rejections.add_miss({grasps[i].X_PG, "clearance", lacking_m, "m"},
                                config.search.most_clearance_m, [&] { return traced(grasps[i]); });
        }
    }
    grasps = std::move(clear);
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
    // A normal may be off unit length by rounding.
    grasp.retreat = {request.support_plane ? request.support_plane->normal_F.normalized()
                                           : Eigen::Vector3d(-approach_F),
                     distance_m};
    grasp.width_m = graded.width_m;
    grasp.open_width_m = graded.open_width_m;
    grasp.contacts = {placed(graded.contacts_P[0], X_FP), placed(graded.contacts_P[1], X_FP)};
    grasp.gripper_name = graded.gripper->name;
    grasp.source = graded.axis.source;
    grasp.candidate = graded.axis.candidate;
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
    RankGraspsConfig ranking = config.rank_grasps;
    if (!request.candidates_FH.empty()) {  // who asks about each wants to know of each
        ranking.same_distance_finger_widths = ranking.same_angle_rad = 0.0;
    }
    const std::size_t found = grasps.size();
    log.run(kClearance, found, [&] {
        drop_nearer(grasps, world_P, request.options.min_clearance_m, config, rejections);
        return 0;
    });
    log.out(kClearance, grasps.size());
    auto shortlist = best_of(grasps, 2 * wanted, ranking, rejections, log);
    if (!shortlist) return shortlist.error();
    const double most_m = std::max(config.search.most_clearance_m, request.options.min_clearance_m);
    log.run(kClearance, 0, [&] {
        const auto clear_m = clearances_m(shortlist.value(), world_P, most_m, config);
        for (std::size_t i = 0; i < clear_m.size(); ++i) {
            GradedGrasp& grasp = shortlist.value()[i];
            grasp.evidence.clearance_m = clear_m[i];
            grasp.score = score_grasp(grasp.evidence, config.score_grasp);
        }
        return 0;
    });
    const auto best = best_of(shortlist.value(), wanted, ranking, rejections, log);
    if (!best) return best.error();
    std::vector<Grasp> result;
    for (const GradedGrasp& grasp : best.value()) {
        result.push_back(in_frame_F(grasp, request, config, X_FP));
        rejections.trace([&] { return traced(grasp); });
    }
    return result;
}

}  // namespace graspd::planner_detail
