#include "graspd/regions/concavity_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include <Eigen/Eigenvalues>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

constexpr double kTie = 1e-9;  // relative; lengths, areas and components nearer are equal
// Points whose spread across is a millionth of that along lie on a line.
constexpr double kLeastSpread = 1e-12;
// Standardised third moment below which a set counts as symmetric; rounding leaves about 1e-14.
constexpr double kLeastSkew = 1e-6;
// A face narrower than this share of the box is a line: nothing can be outlined on it.
constexpr double kLeastFace = 1e-6;

PlanError degenerate(const std::string& detail) {
    return {PlanErrorCode::kDegenerate, "concavity_frame: " + detail};
}

std::optional<PlanError> check_input(std::span<const Eigen::Vector3d> points_O,
                                     double finger_length_m, const ConcavityFrameConfig& config) {
    if (auto bad = validate(config, "concavity_frame.")) return bad;
    if (auto bad = check_positive("concavity_frame: finger_length_m", finger_length_m)) return bad;
    for (std::size_t i = 0; i < points_O.size(); ++i) {
        if (points_O[i].allFinite()) continue;
        std::ostringstream text;
        text << "concavity_frame: points_O[" << i << "] = (" << points_O[i].transpose()
             << ") is not finite";
        return PlanError{PlanErrorCode::kInvalidInput, text.str()};
    }
    if (points_O.size() < 4) {
        return degenerate(std::to_string(points_O.size()) + " points, at least 4 are needed");
    }
    return std::nullopt;
}

/// In lexicographic order, so that no sum depends on the order of the input.
std::vector<Eigen::Vector3d> sorted(std::span<const Eigen::Vector3d> points) {
    std::vector<Eigen::Vector3d> copy(points.begin(), points.end());
    std::ranges::sort(copy, [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    });
    return copy;
}

/// The axis or its opposite: by third moment, else by its largest component.
Eigen::Vector3d with_sign(const Eigen::Vector3d& axis, std::span<const Eigen::Vector3d> offsets) {
    double second = 0.0;
    double third = 0.0;
    for (const Eigen::Vector3d& offset : offsets) {
        const double x = axis.dot(offset);
        second += x * x;
        third += x * x * x;
    }
    const auto count = static_cast<double>(offsets.size());
    const double skew = third / count / std::pow(second / count, 1.5);
    if (std::abs(skew) > kLeastSkew) return skew > 0.0 ? axis : Eigen::Vector3d(-axis);
    int largest = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(axis[k]) > (1.0 + kTie) * std::abs(axis[largest])) largest = k;
    }
    return axis[largest] > 0.0 ? axis : Eigen::Vector3d(-axis);
}

/// Pose and half extents of the box; the planes are left open.
Result<ConcavityFrame> fit_box(std::span<const Eigen::Vector3d> points_O) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points_O) mean += point;
    mean /= static_cast<double>(points_O.size());
    std::vector<Eigen::Vector3d> offsets;
    offsets.reserve(points_O.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& point : points_O) {
        offsets.push_back(point - mean);
        covariance += offsets.back() * offsets.back().transpose();
    }
    // The axes of least inertia are those of greatest spread; Eigen puts the least spread first.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const Eigen::Vector3d& spread = solver.eigenvalues();
    if (solver.info() != Eigen::Success || !(spread[1] > kLeastSpread * spread[2])) {
        return degenerate("the points lie on a line or coincide");
    }
    Eigen::Matrix3d axes;
    axes.col(0) = with_sign(solver.eigenvectors().col(2).normalized(), offsets);
    axes.col(1) = with_sign(solver.eigenvectors().col(1).normalized(), offsets);
    axes.col(2) = axes.col(0).cross(axes.col(1)).normalized();

    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& offset : offsets) box.extend(axes.transpose() * offset);
    ConcavityFrame frame;
    frame.X_OC.linear() = axes;
    frame.X_OC.translation() = mean + axes * box.center();
    frame.half_extent_m = 0.5 * box.sizes();
    return frame;
}

/// Length of object along the first `length_m` of a line [m].
double solid_length_m(const TriangleBvh& object_O, const Eigen::Vector3d& from,
                      const Eigen::Vector3d& direction, double length_m) {
    const auto hits = object_O.all_hits(from, direction, std::numeric_limits<double>::infinity());
    // What leaves more often than it enters was inside from the start.
    int depth = 0;
    int start_depth = 0;
    for (const TriangleBvh::Hit& hit : hits) {
        depth += hit.from_outside ? 1 : -1;
        start_depth = std::max(start_depth, -depth);
    }
    depth = start_depth;
    double at_m = 0.0;
    double solid_m = 0.0;
    for (const TriangleBvh::Hit& hit : hits) {
        const double to_m = std::min(hit.distance_m, length_m);
        if (depth > 0) solid_m += to_m - at_m;
        depth += hit.from_outside ? 1 : -1;
        at_m = to_m;
    }
    return solid_m;
}

PlanePair make_plane(const ConcavityFrame& frame, int axis) {
    PlanePair plane;
    plane.axis = axis;
    const Eigen::Matrix3d axes = frame.X_OC.linear();
    const int lower = axis == 0 ? 1 : 0;
    const int higher = axis == 2 ? 1 : 2;
    const bool lower_first =
        frame.half_extent_m[lower] >= (1.0 - kTie) * frame.half_extent_m[higher];
    plane.X_OW = frame.X_OC;
    plane.X_OW.linear().col(2) = axes.col(axis);
    plane.X_OW.linear().col(0) = axes.col(lower_first ? lower : higher);
    plane.X_OW.linear().col(1) = axes.col(axis).cross(plane.X_OW.linear().col(0));
    plane.face_area_m2 = 4.0 * frame.half_extent_m[lower] * frame.half_extent_m[higher];
    return plane;
}

/// Volume of object before both faces of the pair, by a grid of lines [m^3].
double blocked_volume_m3(const ConcavityFrame& frame, const PlanePair& plane,
                         const TriangleBvh& object_O, double finger_length_m, int lines) {
    const int first = plane.axis == 0 ? 1 : 0;
    const int second = plane.axis == 2 ? 1 : 2;
    double solid_m = 0.0;
    for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector3d outward = side * frame.X_OC.linear().col(plane.axis);
        for (int i = 0; i < lines; ++i) {
            for (int j = 0; j < lines; ++j) {
                Eigen::Vector3d from_C = frame.half_extent_m;
                from_C[plane.axis] *= side;
                from_C[first] *= (2.0 * i + 1.0) / lines - 1.0;
                from_C[second] *= (2.0 * j + 1.0) / lines - 1.0;
                solid_m += solid_length_m(object_O, frame.X_OC * from_C, outward, finger_length_m);
            }
        }
    }
    return solid_m * plane.face_area_m2 / (static_cast<double>(lines) * lines);
}

bool is_line(const ConcavityFrame& frame, const PlanePair& plane) {
    const double longest = frame.half_extent_m.maxCoeff();
    for (int axis = 0; axis < 3; ++axis) {
        if (axis != plane.axis && frame.half_extent_m[axis] < kLeastFace * longest) return true;
    }
    return false;
}

/// Whether `a` is worth trying before `b`. Blocked volumes nearer than `tie_m3` are equal.
bool comes_before(const ConcavityFrame& frame, const PlanePair& a, const PlanePair& b,
                  double tie_m3) {
    const bool line_a = is_line(frame, a);
    if (line_a != is_line(frame, b)) return !line_a;
    if (std::abs(a.blocked_m3 - b.blocked_m3) > tie_m3) return a.blocked_m3 < b.blocked_m3;
    const double tie_m2 = kTie * std::max(a.face_area_m2, b.face_area_m2);
    if (std::abs(a.face_area_m2 - b.face_area_m2) > tie_m2) return a.face_area_m2 > b.face_area_m2;
    return a.axis > b.axis;
}

}  // namespace

Result<ConcavityFrame> concavity_frame(std::span<const Eigen::Vector3d> points_O,
                                       const TriangleBvh& object_O, double finger_length_m,
                                       const ConcavityFrameConfig& config) {
    if (auto bad = check_input(points_O, finger_length_m, config)) return *bad;
    auto fitted = fit_box(sorted(points_O));
    if (!fitted) return fitted;
    ConcavityFrame& frame = fitted.value();
    for (int axis = 0; axis < 3; ++axis) {
        PlanePair& plane = frame.planes[axis];
        plane = make_plane(frame, axis);
        plane.blocked_m3 = blocked_volume_m3(frame, plane, object_O, finger_length_m,
                                             static_cast<int>(config.lines_per_side));
    }
    // Equality within a tolerance is no strict order, so each place is filled by its best.
    const double tie_m3 = kTie * 8.0 * frame.half_extent_m.prod();
    for (std::size_t place = 0; place < 2; ++place) {
        for (std::size_t other = place + 1; other < 3; ++other) {
            if (comes_before(frame, frame.planes[other], frame.planes[place], tie_m3)) {
                std::swap(frame.planes[other], frame.planes[place]);
            }
        }
    }
    return fitted;
}

}  // namespace graspd
