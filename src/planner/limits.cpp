#include "limits.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace graspd::planner_detail {
namespace {

constexpr double kSlack = 1e-9;    // what another machine's rounding may take away
constexpr double kWidest_m = 2.0;  // the range of a gripper's max_width

double steps_per_unit(const Limit& limit) {
    const bool length =
        limit.kind == LimitKind::kMinClearance || limit.kind == LimitKind::kMaxWidth;
    return length ? 1e4 : 1e3;
}

bool falls(const Limit& limit) {
    return limit.kind == LimitKind::kMinClearance;  // the others are relaxed by raising them
}

bool any_direction(const Limit& limit, double value) {
    return limit.kind == LimitKind::kHalfAngle && value >= std::numbers::pi;
}

/// The gripper that opens widest, the first of equals.
std::size_t widest_of(const std::vector<Gripper>& grippers) {
    const auto widest = std::ranges::max_element(grippers, {}, &Gripper::max_width_m);
    return static_cast<std::size_t>(widest - grippers.begin());
}

/// Notes which typed reasons tell that a limit felled candidates, and what the nearest one needs.
Limit judged(Limit limit, const Rejections& rejections,
             std::initializer_list<const char*> reasons) {
    for (const char* reason : reasons) {
        limit.felled = limit.felled || rejections.count(reason) > 0;
        const auto margin = rejections.least_margin(reason);
        if (!margin) continue;
        const double need = loosened(limit, limit.asked + (falls(limit) ? -*margin : *margin));
        const bool nearer = !limit.hint || share_of(limit, need) < share_of(limit, *limit.hint);
        if (nearer) limit.hint = need;
    }
    return limit;
}

std::string number_text(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string sources_text(double bits) {
    std::string text;
    for (const GraspSource source : {kBoundary, kWall, kWholeObject}) {
        if ((static_cast<unsigned>(bits) & source) == 0U) continue;
        text += (text.empty() ? "" : ",") + std::string(to_string(source));
    }
    return text;
}

/// A value of a limit with its unit.
std::string measure_text(const Limit& limit, double value) {
    switch (limit.kind) {
        case LimitKind::kMinClearance:
        case LimitKind::kMaxWidth: return number_text(value) + " m";
        case LimitKind::kHalfAngle: return number_text(value) + " rad";
        case LimitKind::kFriction: return number_text(value);
        case LimitKind::kSources: return sources_text(value);
    }
    return "";
}

const char* name_of(LimitKind kind) {
    switch (kind) {
        case LimitKind::kMinClearance: return "min_clearance";
        case LimitKind::kHalfAngle: return "half_angle";
        case LimitKind::kMaxWidth: return "max_width";
        case LimitKind::kFriction: return "friction";
        case LimitKind::kSources: return "sources";
    }
    return "";
}

}  // namespace

std::vector<Limit> limits_of(const PlanRequest& request, const Rejections& rejections,
                             const LimitRange& range) {
    std::vector<Limit> limits;
    const PlanOptions& options = request.options;
    if (options.min_clearance_m > 0.0) {
        const Limit limit{LimitKind::kMinClearance, options.min_clearance_m, 0.0, false, {}, ""};
        limits.push_back(judged(limit, rejections, {"clearance"}));
    }
    if (!request.approach_cones.empty()) {
        const auto& cones = request.approach_cones;
        const double narrowest =
            std::ranges::min_element(cones, {}, &ApproachCone::half_angle_rad)->half_angle_rad;
        const Limit limit{LimitKind::kHalfAngle, narrowest, std::numbers::pi, false, {}, ""};
        if (narrowest < limit.loosest) {
            limits.push_back(judged(limit, rejections, {"outside_approach_cones"}));
        }
    }
    const Gripper& gripper = request.grippers[widest_of(request.grippers)];
    Limit opening{LimitKind::kMaxWidth, gripper.max_width_m, kWidest_m, false, {}, gripper.name};
    opening.loosest = loosened(opening, range.widest_m);
    if (opening.asked < opening.loosest) {
        limits.push_back(judged(opening, rejections, {"axis_too_wide", "too_wide"}));
    }
    const Limit friction{
        LimitKind::kFriction, options.friction, range.greatest_friction, false, {}, ""};
    if (friction.asked < friction.loosest) {
        limits.push_back(judged(friction, rejections, {"slips"}));
    }
    if (options.sources != 0 && options.sources != kAllSources) {
        Limit limit{LimitKind::kSources, 1.0 * options.sources, kAllSources, true, {}, ""};
        limits.push_back(limit);
    }
    return limits;
}

double loosened(const Limit& limit, double value) {
    if (limit.kind == LimitKind::kSources) return limit.loosest;
    const double steps = steps_per_unit(limit);
    if (falls(limit)) return std::max(std::floor((value - kSlack) * steps) / steps, limit.loosest);
    return std::min(std::ceil((value + kSlack) * steps) / steps, limit.loosest);
}

void relax(PlanRequest& request, const Limit& limit, double value) {
    switch (limit.kind) {
        case LimitKind::kMinClearance: request.options.min_clearance_m = value; break;
        case LimitKind::kFriction: request.options.friction = value; break;
        case LimitKind::kSources: request.options.sources = static_cast<std::uint8_t>(value); break;
        case LimitKind::kMaxWidth:
            request.grippers[widest_of(request.grippers)].max_width_m = value;
            break;
        case LimitKind::kHalfAngle:
            if (any_direction(limit, value)) request.approach_cones.clear();
            for (ApproachCone& cone : request.approach_cones) {
                cone.half_angle_rad = std::max(cone.half_angle_rad, value);
            }
    }
}

double needed(const Limit& limit, const PlanRequest& request, const Grasp& grasp) {
    const auto clamped = [&](double value) {
        const double need = loosened(limit, value);
        return falls(limit) ? std::min(need, limit.asked) : std::max(need, limit.asked);
    };
    switch (limit.kind) {
        case LimitKind::kMinClearance: return clamped(grasp.clearance_m);
        case LimitKind::kFriction: return clamped(grasp.min_friction);
        case LimitKind::kMaxWidth: return clamped(grasp.open_width_m);
        case LimitKind::kSources: return limit.loosest;
        case LimitKind::kHalfAngle: break;
    }
    double least_rad = std::numeric_limits<double>::max();
    for (const ApproachCone& cone : request.approach_cones) {
        const double cosine = grasp.approach.direction_F.dot(cone.axis_F);
        least_rad = std::min(least_rad, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    return clamped(least_rad);
}

double share_of(const Limit& limit, double value) {
    if (limit.kind == LimitKind::kSources) return 1.0;
    return std::abs(value - limit.asked) / limit.asked;
}

std::string value_text(const Limit& limit, double value) {
    if (any_direction(limit, value)) return "no approach_cones";
    if (limit.kind == LimitKind::kSources) return "all sources";
    return std::string(name_of(limit.kind)) + " " + measure_text(limit, value);
}

std::string change_text(const Limit& limit, double value) {
    if (any_direction(limit, value)) return value_text(limit, value);
    std::string text = std::string(name_of(limit.kind)) + " " + measure_text(limit, value) +
                       " instead of " + measure_text(limit, limit.asked);
    if (limit.kind == LimitKind::kMaxWidth) text += " (" + limit.of + ")";
    if (limit.kind == LimitKind::kHalfAngle) text += " (approach_cones)";
    return text;
}

}  // namespace graspd::planner_detail
