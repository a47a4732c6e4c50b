#include "boundary_axes.hpp"

#include <algorithm>
#include <optional>

#include "graspd/base/point_grid.hpp"
#include "graspd/contour/order_boundary.hpp"
#include "graspd/contour/project_points.hpp"

namespace graspd::planner_detail {
namespace {

std::vector<Eigen::Vector3d> points_of(const SurfaceSamples& surface,
                                       const std::vector<std::uint32_t>& indices) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(indices.size());
    for (const std::uint32_t i : indices) points.push_back(surface.samples[i].point);
    return points;
}

/// A concavity's samples in one working frame.
struct WorkingPlane {
    const Eigen::Isometry3d& X_PW;
    std::vector<Eigen::Vector3d> enlarged_P;
    std::vector<Eigen::Vector2d> cluster_W, enlarged_W;
    double spacing_m = 0.0;
};

/// Section II-D: the ordered boundary points, none where the outlines are degenerate.
std::vector<Eigen::Vector2d> ordered_boundary(const WorkingPlane& plane,
                                              const PlannerConfig& config, StageLog& log) {
    constexpr const char* kHull = "contour/concave_hull";
    const auto outline = [&](const std::vector<Eigen::Vector2d>& points) {
        const auto hull = log.run(kHull, points.size(), [&] {
            return concave_hull(points, plane.spacing_m, config.concave_hull);
        });
        if (!hull) return std::vector<Eigen::Vector2d>{};
        log.out(kHull, hull.value().outline.size());
        return hull.value().outline;
    };
    const auto cluster_outline = outline(plane.cluster_W);
    const auto enlarged_outline = outline(plane.enlarged_W);
    if (cluster_outline.empty() || enlarged_outline.empty()) return {};
    const auto boundary = log.run("contour/boundary_points", cluster_outline.size(), [&] {
        return boundary_points(cluster_outline, enlarged_outline, plane.spacing_m,
                               config.boundary_points);
    });
    if (!boundary) return {};
    log.out("contour/boundary_points", boundary.value().size());
    auto ordered = log.run("contour/order_boundary", boundary.value().size(),
                           [&] { return order_boundary(boundary.value()); });
    log.out("contour/order_boundary", ordered.size());
    return ordered;
}

/// Section II-E: step points and the candidates that start from them.
struct BoundaryWalk {
    std::vector<StepPoint> steps;
    std::vector<GraspCandidate> candidates;
};
BoundaryWalk walk_along(const std::vector<Eigen::Vector2d>& boundary, double spacing_m,
                        const Gripper& gripper, const PlannerConfig& config, StageLog& log) {
    if (boundary.size() < 2) return {};
    const double step_m = config.step_points.step_finger_widths * gripper.finger_width_m;
    const double max_gap_m = config.step_points.max_gap_spacings * spacing_m;
    const double least_width_m = std::max(gripper.min_width_m, step_m);
    auto steps = log.run("grasp/step_points", boundary.size(),
                         [&] { return step_points(boundary, step_m, least_width_m, max_gap_m); });
    if (!steps) return {};
    log.out("grasp/step_points", steps.value().size());
    auto candidates = log.run("grasp/grasp_candidates", steps.value().size(), [&] {
        return grasp_candidates(boundary, steps.value(), gripper.max_width_m, max_gap_m,
                                config.grasp_candidates);
    });
    if (!candidates) return {std::move(steps).value(), {}};
    log.out("grasp/grasp_candidates", candidates.value().size());
    return {std::move(steps).value(), std::move(candidates).value()};
}

/// Heights of a concavity's samples over its working plane, asked for by their places in it.
class HeightMap {
public:
    explicit HeightMap(const WorkingPlane& plane)
        : within_m_(2.0 * plane.spacing_m),
          places_(in_plane(plane.enlarged_W)),
          grid_(places_, within_m_) {
        const Eigen::Vector3d normal = plane.X_PW.linear().col(2);
        heights_.reserve(places_.size());
        for (const Eigen::Vector3d& point : plane.enlarged_P) {
            heights_.push_back(normal.dot(point - plane.X_PW.translation()));
        }
    }
    /// Mean of the samples within two spacings of a place; the nearest one's when there is none.
    double at(const Eigen::Vector2d& place) const {
        const Eigen::Vector3d here(place.x(), place.y(), 0.0);
        double sum = 0.0, count = 0.0;
        grid_.each_within(here, within_m_, [&](std::uint32_t i) {
            sum += heights_[i];
            count += 1.0;
            return true;
        });
        if (count > 0.0) return sum / count;
        const auto nearest = std::ranges::min_element(
            places_, {}, [&](const Eigen::Vector3d& p) { return (p - here).squaredNorm(); });
        return heights_[static_cast<std::size_t>(nearest - places_.begin())];
    }

private:
    static std::vector<Eigen::Vector3d> in_plane(const std::vector<Eigen::Vector2d>& places) {
        std::vector<Eigen::Vector3d> flat;
        flat.reserve(places.size());
        for (const Eigen::Vector2d& place : places) flat.emplace_back(place.x(), place.y(), 0.0);
        return flat;
    }

    double within_m_;
    std::vector<Eigen::Vector3d> places_;
    PointGrid grid_;
    std::vector<double> heights_;
};

Eigen::Vector3d lifted(const WorkingPlane& plane, const HeightMap& heights,
                       const Eigen::Vector2d& place) {
    return plane.X_PW * Eigen::Vector3d(place.x(), place.y(), heights.at(place));
}

TracedBoundary traced(const WorkingPlane& plane, const HeightMap& heights,
                      const std::vector<Eigen::Vector2d>& boundary,
                      const std::vector<StepPoint>& steps) {
    TracedBoundary trace;
    trace.X_PW = plane.X_PW;
    for (const auto& place : boundary) trace.ordered_P.push_back(lifted(plane, heights, place));
    for (const auto& step : steps) trace.steps_P.push_back(lifted(plane, heights, step.point));
    return trace;
}

ClosingAxis lifted(const WorkingPlane& plane, const HeightMap& heights,
                   const GraspCandidate& candidate) {
    const double height = 0.5 * (heights.at(candidate.left_W) + heights.at(candidate.right_W));
    const auto lift = [&](const Eigen::Vector2d& place) {
        return Eigen::Vector3d(plane.X_PW * Eigen::Vector3d(place.x(), place.y(), height));
    };
    ClosingAxis axis;
    axis.left_P = lift(candidate.left_W);
    axis.right_P = lift(candidate.right_W);
    const Eigen::Vector3d closing = (axis.right_P - axis.left_P).normalized();
    axis.reference_P = plane.X_PW.linear().col(2).cross(closing);  // Z in the plane (Fig. 16)
    return axis;
}

/// Sections II-D and II-E on one working plane.
std::vector<ClosingAxis> axes_on(const WorkingPlane& plane, const Gripper& gripper,
                                 const PlannerConfig& config, StageLog& log,
                                 TracedBoundary* trace) {
    const auto boundary = ordered_boundary(plane, config, log);
    const auto [steps, candidates] = walk_along(boundary, plane.spacing_m, gripper, config, log);
    if (candidates.empty() && (trace == nullptr || boundary.size() < 2)) return {};
    const HeightMap heights(plane);
    if (trace != nullptr) *trace = traced(plane, heights, boundary, steps);
    std::vector<ClosingAxis> axes;
    axes.reserve(candidates.size());
    for (const GraspCandidate& candidate : candidates) {
        axes.push_back(lifted(plane, heights, candidate));
    }
    return axes;
}

}  // namespace

std::vector<ClosingAxis> boundary_axes(const Concavity& concavity, std::int32_t index,
                                       const SurfaceSamples& surface, const PreparedObject& object,
                                       const Gripper& gripper, const PlannerConfig& config,
                                       StageLog& log, std::vector<TracedBoundary>* trace) {
    constexpr const char* kFrame = "regions/concavity_frame";
    const auto salient_P = points_of(surface, concavity.salient);
    const auto frame = log.run(kFrame, salient_P.size(), [&] {
        return concavity_frame(salient_P, *object.tree_P, gripper.finger_length_m,
                               config.concavity_frame);
    });
    if (!frame) return {};
    log.out(kFrame, config.search.planes);

    const auto enlarged_P = points_of(surface, concavity.enlarged);
    std::vector<std::vector<ClosingAxis>> axes(config.search.planes);
    std::vector<TracedBoundary> traces(config.search.planes);
    each_logged(axes.size(), log, [&](std::size_t i, StageLog& part) {
        const Eigen::Isometry3d& X_PW = frame.value().planes[i].X_OW;
        const WorkingPlane plane{X_PW, enlarged_P, project_points(salient_P, X_PW),
                                 project_points(enlarged_P, X_PW), surface.spacing_m};
        axes[i] = axes_on(plane, gripper, config, part, trace == nullptr ? nullptr : &traces[i]);
    });
    for (TracedBoundary& boundary : traces) {
        if (boundary.ordered_P.size() < 2) continue;
        boundary.concavity = index;
        trace->push_back(std::move(boundary));
    }
    std::vector<ClosingAxis> all;
    for (const auto& of_plane : axes) {
        for (ClosingAxis axis : of_plane) {
            axis.source = kBoundary;
            axis.concavity = index;
            axis.depth_m = concavity.depth_m;
            all.push_back(axis);
        }
    }
    return all;
}

}  // namespace graspd::planner_detail
