#include "graspd/grasp/rank_grasps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

bool same(const RankedEntry& a, const RankedEntry& b, const RankGraspsConfig& config) {
    const double near_m =
        config.same_distance_finger_widths * std::max(a.finger_width_m, b.finger_width_m);
    return (a.X_WG.translation() - b.X_WG.translation()).norm() <= near_m &&
           grasp_angle_rad(a.X_WG.linear(), b.X_WG.linear()) <= config.same_angle_rad;
}

std::optional<PlanError> check(std::span<const RankedEntry> entries, std::uint32_t max_grasps) {
    if (max_grasps == 0) {
        return PlanError{PlanErrorCode::kInvalidInput, "rank_grasps: max_grasps = 0"};
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (std::isfinite(entries[i].score)) continue;
        return PlanError{PlanErrorCode::kInvalidInput,
                         "rank_grasps: score[" + std::to_string(i) +
                             "] = " + std::to_string(entries[i].score) + " is not finite"};
    }
    return std::nullopt;
}

/// The first max_grasps of an order, but with the likely best of every concavity among them.
std::vector<std::size_t> cut(const std::vector<std::size_t>& order,
                             std::span<const RankedEntry> entries, std::size_t max_grasps,
                             double likely_score) {
    if (order.size() <= max_grasps) return order;
    std::vector<std::size_t> kept;
    std::set<std::int32_t> seen;
    for (const std::size_t i : order) {  // the best of each concavity
        if (kept.size() == max_grasps) break;
        if (entries[i].concavity < 0 || entries[i].score < likely_score) continue;
        if (seen.insert(entries[i].concavity).second) kept.push_back(i);
    }
    for (const std::size_t i : order) {  // then simply the best
        if (kept.size() == max_grasps) break;
        if (std::ranges::find(kept, i) == kept.end()) kept.push_back(i);
    }
    std::vector<std::size_t> result;
    std::ranges::copy_if(order, std::back_inserter(result),
                         [&](std::size_t i) { return std::ranges::find(kept, i) != kept.end(); });
    return result;
}

}  // namespace

double grasp_angle_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    const Eigen::Matrix3d turn = a.transpose() * b;
    // Half a turn about z negates the first two columns of the relative rotation.
    const double trace = std::abs(turn(0, 0) + turn(1, 1)) + turn(2, 2);
    return std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0));
}

Result<Ranking> rank_grasps(std::span<const RankedEntry> entries, std::uint32_t max_grasps,
                            const RankGraspsConfig& config) {
    if (auto bad = validate(config, "rank_grasps.")) return *bad;
    if (auto bad = check(entries, max_grasps)) return *bad;
    std::vector<std::size_t> by_score(entries.size());
    std::iota(by_score.begin(), by_score.end(), std::size_t{0});
    std::ranges::stable_sort(by_score, [&](std::size_t a, std::size_t b) {
        return entries[a].score > entries[b].score;
    });
    Ranking ranking;
    std::vector<std::size_t> distinct;
    for (const std::size_t i : by_score) {
        const bool known = std::ranges::any_of(distinct, [&](std::size_t better) {
            return same(entries[i], entries[better], config);
        });
        if (known) {
            ranking.duplicates.push_back(i);
        } else {
            distinct.push_back(i);
        }
    }
    ranking.order = cut(distinct, entries, max_grasps, config.likely_score);
    auto kept = ranking.order.begin();  // a part of `distinct`, in its order
    for (const std::size_t i : distinct) {
        if (kept != ranking.order.end() && *kept == i) {
            ++kept;
        } else {
            ranking.surplus.push_back(i);
        }
    }
    return ranking;
}

}  // namespace graspd
