#include "support/vases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "support/shape_builders.hpp"

namespace graspd::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLipRadius = 0.006;  // [m] of the arc
constexpr double kLipRing = 0.026;    // [m] radius of the arc's centre
constexpr double kLipHeight = 0.115;  // [m] of the arc's centre
constexpr double kOuterFrom = -60.0;  // [deg] where the arc starts outside, from +r
constexpr double kInnerTo = 250.0;    // [deg] where it ends inside

/// Pieces of a quarter of the lip: as fine as the mesh, but round at every size.
int lip_parts(std::size_t faces) {
    return std::max(4, static_cast<int>(std::lround(std::sqrt(static_cast<double>(faces)) / 24)));
}

/// Sides of a twisted vase's rings: more than an even mesh would have, as the bracket's width falls
/// with their square.
int twisted_sides(std::size_t faces) {
    return std::max(40, static_cast<int>(std::lround(std::sqrt(3.0 * static_cast<double>(faces)))));
}

void add_lip(std::vector<Vector2d>& line, double from_deg, double to_deg, int parts) {
    const int count =
        std::max(1, static_cast<int>(std::ceil(std::abs(to_deg - from_deg) / 90.0 * parts)));
    for (int i = 0; i <= count; ++i) {
        const double angle =
            (from_deg + (to_deg - from_deg) * i / count) * std::numbers::pi / 180.0;
        line.emplace_back(kLipRing + kLipRadius * std::cos(angle),
                          kLipHeight + kLipRadius * std::sin(angle));
    }
}

Vector2d meridian(const Vector3d& p) {
    return {std::hypot(p.x(), p.y()), p.z()};
}

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

double distance_m(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
    const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - share * (b - a)).norm();
}

}  // namespace

MeridianWays::MeridianWays(std::vector<Vector2d> wall) : wall_(std::move(wall)) {
    value_m_.resize(wall_.size(), 0.0);
    for (std::size_t i = wall_.size() - 1; i-- > 0;) value_m_[i] = value_by_m(wall_[i], i + 1);
}

double MeridianWays::value_m(const Vector2d& point) const {
    std::size_t above = 0;
    while (above < wall_.size() && wall_[above].y() <= point.y()) ++above;
    return value_by_m(point, above);
}

/// Straight up, or by a corner that is higher.
double MeridianWays::value_by_m(const Vector2d& point, std::size_t first_corner) const {
    const double top = wall_.back().y();
    double best = std::numeric_limits<double>::infinity();
    if (is_free(point, {point.x(), top})) best = top - point.y();
    for (std::size_t i = first_corner; i < wall_.size(); ++i) {
        const double by = (wall_[i] - point).norm() + value_m_[i];
        if (by < best && is_free(point, wall_[i])) best = by;
    }
    return best;
}

/// Between two heights both the segment and the wall are straight from corner to corner, so it is
/// enough to compare them at the corners.
bool MeridianWays::is_free(const Vector2d& low, const Vector2d& high) const {
    constexpr double kRounding = 1e-15;  // [m] a segment along the wall is free
    return std::ranges::all_of(wall_, [&](const Vector2d& corner) {
        if (corner.y() <= low.y() || corner.y() > high.y()) return true;
        const double share = (corner.y() - low.y()) / (high.y() - low.y());
        return low.x() + share * (high.x() - low.x()) <= corner.x() + kRounding;
    });
}

VaseProfile::VaseProfile(int parts) {
    outer = {{0.0, 0.0}, {0.03, 0.0}, {0.045, 0.022}, {0.05, 0.04}, {0.045, 0.06}, {0.03, 0.095}};
    add_lip(outer, kOuterFrom, 90.0, parts);
    add_lip(inner, 90.0, kInnerTo, parts);
    const std::vector<Vector2d> below{{0.026, 0.095}, {0.041, 0.06},  {0.046, 0.04},
                                      {0.041, 0.022}, {0.026, 0.004}, {0.0, 0.004}};
    inner.insert(inner.end(), below.begin(), below.end());
    inner.front() = outer.back();
}

std::vector<Vector2d> VaseProfile::outline() const {
    std::vector<Vector2d> line = outer;
    line.insert(line.end(), inner.begin() + 1, inner.end());
    return line;
}

std::vector<Vector2d> VaseProfile::wall(double factor) const {
    std::vector<Vector2d> corners;
    for (std::size_t i = inner.size() - 1; i-- > 0;) {
        corners.emplace_back(factor * inner[i].x(), inner[i].y());
    }
    return corners;
}

TriangleMesh vase(std::size_t faces) {
    return lathe(VaseProfile(lip_parts(faces)).outline(), false, faces);
}

TriangleMesh twisted_vase(std::size_t faces, std::uint64_t seed) {
    return twisted_lathe(VaseProfile(lip_parts(faces)).outline(), twisted_sides(faces), faces,
                         seed);
}

VaseAnswer vase_answer(std::size_t faces) {
    const VaseProfile profile(lip_parts(faces));
    return {lip_parts(faces), lathe_sides(profile.outline(), false, faces), false};
}

VaseAnswer twisted_vase_answer(std::size_t faces) {
    return {lip_parts(faces), twisted_sides(faces), true};
}

VaseAnswer::VaseAnswer(int parts, int sides, bool twisted)
    : profile_(parts),
      factor_(twisted ? std::cos(1.5 * std::numbers::pi / sides) : 1.0),
      side_factor_(twisted ? 1.0 : std::cos(std::numbers::pi / sides)),
      twisted_(twisted),
      full_(profile_.wall(1.0)),
      small_(profile_.wall(factor_)) {}

double VaseAnswer::lowest_m(const Vector3d& vertex) const {
    const Vector2d p = meridian(vertex);
    if (!is_outside(p)) return full_.value_m(p);
    return outside_m(p, side_factor_, twisted_ ? factor_ : side_factor_);
}

double VaseAnswer::highest_m(const Vector3d& vertex) const {
    const Vector2d p = meridian(vertex);
    if (is_outside(p)) return outside_m(p, side_factor_, side_factor_);
    return (1.0 - factor_) * p.x() + small_.value_m({factor_ * p.x(), p.y()});
}

bool VaseAnswer::is_outside(const Vector2d& point) const {
    for (std::size_t i = 0; i + 1 < profile_.outer.size(); ++i) {
        if (distance_m(point, profile_.outer[i], profile_.outer[i + 1]) < kNear) return true;
    }
    return false;
}

/// Distance to the convex hull of the profile, radii times the factors; 0 beyond it.
double VaseAnswer::outside_m(Vector2d point, double point_factor, double hull_factor) const {
    point.x() *= point_factor;
    std::vector<Vector2d> hull;  // from the axis below round the outside to the axis above
    std::vector<Vector2d> corners = profile_.outer;
    corners.emplace_back(0.0, corners.back().y());
    for (Vector2d corner : corners) {
        corner.x() *= hull_factor;
        while (hull.size() > 1 &&
               cross(hull.back() - hull[hull.size() - 2], corner - hull.back()) <= 0.0) {
            hull.pop_back();
        }
        hull.push_back(corner);
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
        const Vector2d along = (hull[i + 1] - hull[i]).normalized();
        nearest = std::min(nearest, cross(along, point - hull[i]));
    }
    return std::max(0.0, nearest);
}

}  // namespace graspd::test
