#include "graspd/grasp/force_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include <Eigen/Geometry>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

constexpr double kLeastSpread_m = 1e-9;    // below a nanometre points of an object coincide
constexpr double kLeastElongation = 1e-9;  // relative; less is rounding, not a direction

struct FittedLine {
    double lean_rad = 0.0;  ///< from Gy towards +Gx, in (-pi/2, pi/2]
    double rms_m = 0.0;
};

PlanError degenerate(const char* name, const char* what, double value, const char* unit) {
    std::ostringstream text;
    text << "force_balance: " << name << " " << what << " " << value << " " << unit;
    return PlanError{PlanErrorCode::kDegenerate, text.str()};
}

/// Total least squares: the line through the mean along the direction of greatest spread.
Result<FittedLine> fit_line(const char* name, std::span<const Eigen::Vector2d> side,
                            double max_rms_m) {
    const auto count = static_cast<double>(side.size());
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& point : side) mean += point / count;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Eigen::Vector2d& point : side) {
        const Eigen::Vector2d offset = point - mean;
        xx += offset.x() * offset.x();
        xy += offset.x() * offset.y();
        yy += offset.y() * offset.y();
    }
    const double spread_m = std::sqrt((xx + yy) / count);
    if (spread_m < kLeastSpread_m) return degenerate(name, "coincides within", spread_m, "m");
    const double elongation = std::hypot(yy - xx, 2.0 * xy) / (xx + yy);
    if (elongation < kLeastElongation) {
        return degenerate(name, "has no direction: its relative elongation is", elongation, "");
    }
    // Measured from Y towards X, the direction of greatest spread is half the angle of this vector.
    double lean_rad = 0.5 * std::atan2(2.0 * xy, yy - xx);
    if (lean_rad <= -0.5 * std::numbers::pi) lean_rad = 0.5 * std::numbers::pi;

    const Eigen::Vector2d normal(std::cos(lean_rad), -std::sin(lean_rad));
    double squares = 0.0;
    for (const Eigen::Vector2d& point : side) squares += std::pow(normal.dot(point - mean), 2);
    const double rms_m = std::sqrt(squares / count);
    if (rms_m > max_rms_m) return degenerate(name, "is no line: its fit has an rms of", rms_m, "m");
    return FittedLine{lean_rad, rms_m};
}

std::optional<PlanError> check_side(const char* name, std::span<const Eigen::Vector2d> side) {
    const std::string full_name = std::string("force_balance: ") + name;
    if (side.size() < 2) {
        return PlanError{
            PlanErrorCode::kInvalidInput,
            full_name + " has " + std::to_string(side.size()) + " points, a line needs 2"};
    }
    return check_finite(full_name.c_str(), side);
}

/// tan of the angle between two vectors of any length; infinite from 90 degrees on.
double tan_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const double cosine = a.dot(b);
    if (!(cosine > 0.0) || !std::isfinite(cosine)) return std::numeric_limits<double>::infinity();
    return a.cross(b).norm() / cosine;
}

}  // namespace

Result<ForceBalance> evaluate_force_balance(std::span<const Eigen::Vector2d> left_G,
                                            std::span<const Eigen::Vector2d> right_G,
                                            const ForceBalanceConfig& config) {
    if (auto bad = validate(config, "force_balance.")) return *bad;
    if (auto bad = check_side("left_G", left_G)) return *bad;
    if (auto bad = check_side("right_G", right_G)) return *bad;
    const auto left = fit_line("left_G", left_G, config.max_rms_m);
    if (!left) return left.error();
    const auto right = fit_line("right_G", right_G, config.max_rms_m);
    if (!right) return right.error();

    ForceBalance balance;
    balance.lean_left_rad = -left.value().lean_rad;  // outward is -Gx on the left
    balance.lean_right_rad = right.value().lean_rad;
    balance.beta_rad = std::abs(balance.lean_left_rad + balance.lean_right_rad);
    balance.rms_m = std::max(left.value().rms_m, right.value().rms_m);
    return balance;
}

double min_friction(const Eigen::Vector3d& contact_left_G,
                    const Eigen::Vector3d& outward_normal_left_G,
                    const Eigen::Vector3d& contact_right_G,
                    const Eigen::Vector3d& outward_normal_right_G) {
    const Eigen::Vector3d left_to_right = contact_right_G - contact_left_G;
    return std::max(tan_between(left_to_right, -outward_normal_left_G),
                    tan_between(-left_to_right, -outward_normal_right_G));
}

}  // namespace graspd
