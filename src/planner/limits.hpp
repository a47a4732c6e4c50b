#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graspd/planner/plan_types.hpp"
#include "rejections.hpp"

namespace graspd::planner_detail {

/// What a request limits and a suggestion may relax.
enum class LimitKind : std::uint8_t { kMinClearance, kHalfAngle, kMaxWidth, kFriction, kSources };

/// One limit of a request, from what it asks for to where relaxing it further changes nothing or is
/// no longer believable.
struct Limit {
    LimitKind kind = LimitKind::kMaxWidth;
    double asked = 0.0;          ///< [m, rad, 1 or bits] as in the request
    double loosest = 0.0;        ///< same unit
    bool felled = false;         ///< whether a candidate fell by it
    std::optional<double> hint;  ///< what the nearest miss by it needs, on the grid
    std::string of;              ///< kMaxWidth: name of the gripper
};

/// How far limits may be relaxed.
struct LimitRange {
    double widest_m = 0.0;           ///< [m] opening into which the object fits any way
    double greatest_friction = 1.5;  ///< [1]
};

/// The limits of a request that can be relaxed at all, in the order of LimitKind.
///
/// kMaxWidth is that of the gripper that opens widest, the first of equals; kHalfAngle that of the
/// narrowest approach cone.
std::vector<Limit> limits_of(const PlanRequest& request, const Rejections& rejections,
                             const LimitRange& range);

/// The next looser value with at most four decimals (friction and angles: three), by at least 1e-9
/// looser, so that it reads the same in text and survives rounding; never beyond `loosest`.
double loosened(const Limit& limit, double value);

/// Sets a limit of a request. kHalfAngle: every cone that is narrower becomes that wide; from pi on
/// the cones are dropped.
void relax(PlanRequest& request, const Limit& limit, double value);

/// What a grasp of a plan needs of a limit of the request: `asked`, or a looser value on the grid.
double needed(const Limit& limit, const PlanRequest& request, const Grasp& grasp);

/// How much a value relaxes a limit, as a share of what was asked for; 1 for sources.
double share_of(const Limit& limit, double value);

/// "friction 0.365", "max_width 0.1051 m", "no approach_cones", "all sources".
std::string value_text(const Limit& limit, double value);

/// "friction 0.365 instead of 0.3", with the gripper's name or "approach_cones" in parentheses.
std::string change_text(const Limit& limit, double value);

}  // namespace graspd::planner_detail
