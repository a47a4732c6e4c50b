#include "opposite_axes.hpp"

#include <algorithm>
#include <limits>

#include "graspd/base/point_grid.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::planner_detail {
namespace {

/// Tells which concavity a place of the surface belongs to.
class RegionIndex {
public:
    RegionIndex(const std::vector<Concavity>& regions, const SurfaceSamples& surface,
                double least_depth_m)
        : reach_m_(2.0 * surface.spacing_m),
          least_depth_m_(least_depth_m),
          places_(salient_places(regions, surface)),
          grid_(places_.points, reach_m_) {
        for (const Concavity& region : regions) {
            Eigen::AlignedBox3d box;
            for (const std::uint32_t i : region.salient) box.extend(surface.samples[i].point);
            const Eigen::Vector3d pad = Eigen::Vector3d::Constant(reach_m_);
            boxes_.emplace_back(box.min() - pad, box.max() + pad);
        }
    }
    /// Index of the concavity to which a place of the given concavity belongs: the deepest with a
    /// salient sample within reach; else, where the place is deep enough to count, the nearest.
    /// -1 when there is none.
    std::int32_t of(const Eigen::Vector3d& place, double concavity_m) const {
        const std::int32_t within = at(place);
        return within < 0 && concavity_m >= least_depth_m_ ? nearest(place) : within;
    }

private:
    /// The salient samples, each with the deepest of its regions.
    struct SalientPlaces {
        std::vector<Eigen::Vector3d> points;
        std::vector<std::int32_t> region;
    };
    static SalientPlaces salient_places(const std::vector<Concavity>& regions,
                                        const SurfaceSamples& surface) {
        std::vector<std::int32_t> deepest(surface.samples.size(), -1);
        for (std::size_t r = regions.size(); r-- > 0;) {
            for (const std::uint32_t i : regions[r].salient) {
                deepest[i] = static_cast<std::int32_t>(r);
            }
        }
        SalientPlaces places;
        for (std::size_t i = 0; i < deepest.size(); ++i) {
            if (deepest[i] < 0) continue;
            places.points.push_back(surface.samples[i].point);
            places.region.push_back(deepest[i]);
        }
        return places;
    }
    std::int32_t at(const Eigen::Vector3d& place) const {
        std::int32_t deepest = -1;
        grid_.each_within(place, reach_m_, [&](std::uint32_t i) {
            const std::int32_t region = places_.region[i];
            if (deepest < 0 || region < deepest) deepest = region;
            return deepest != 0;
        });
        return deepest;
    }
    std::int32_t nearest(const Eigen::Vector3d& place) const {
        std::int32_t best = -1;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t r = 0; r < boxes_.size(); ++r) {
            const double distance = boxes_[r].squaredExteriorDistance(place);
            if (distance >= least) continue;
            least = distance;
            best = static_cast<std::int32_t>(r);
        }
        return best;
    }

    double reach_m_, least_depth_m_;
    SalientPlaces places_;
    PointGrid grid_;
    std::vector<Eigen::AlignedBox3d> boxes_;
};

/// Mean concavity of a face's corners [m].
double concavity_at(const PreparedObject& object, std::uint32_t face) {
    double sum = 0.0;
    for (const std::uint32_t vertex : object.mesh_P.faces[face]) {
        sum += object.field.value_m[vertex];
    }
    return sum / 3.0;
}

/// A unit vector at right angles to `closing` that points towards the origin of P, or along the
/// axis of P that is least parallel to it when the line runs through the origin.
Eigen::Vector3d inward_direction(const Eigen::Vector3d& middle, const Eigen::Vector3d& closing) {
    constexpr double kThrough_m = 1e-4;
    const Eigen::Vector3d across = -(middle - closing * closing.dot(middle));
    if (across.norm() > kThrough_m) return across.normalized();
    Eigen::Index least = 0;
    closing.cwiseAbs().minCoeff(&least);
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(least);
    return (axis - closing * closing.dot(axis)).normalized();
}

}  // namespace

std::vector<ClosingAxis> opposite_axes(const SeenSurface& seen, const PreparedObject& object,
                                       const Gripper& gripper, const PlannerConfig& config) {
    if (!seen.across) return {};
    const std::vector<Concavity>& regions = seen.concavities;
    const RegionIndex index(
        regions, seen.surface,
        config.extract_concave_areas.min_depth_finger_thicknesses * gripper.finger_thickness_m);
    std::vector<ClosingAxis> axes;
    for (const OppositeCandidate& candidate : seen.across->candidates) {
        stop_point(axes.size());
        ClosingAxis axis;
        axis.left_P = candidate.left_O;
        axis.right_P = candidate.right_O;
        const Eigen::Vector3d closing = (axis.right_P - axis.left_P).normalized();
        axis.reference_P = inward_direction(0.5 * (axis.left_P + axis.right_P), closing);
        axis.concavity =
            index.of(axis.left_P, seen.across->probes.samples[candidate.sample].concavity_m);
        if (axis.concavity < 0) {
            axis.concavity = index.of(axis.right_P, concavity_at(object, candidate.right_face));
        }
        axis.source = axis.concavity < 0 ? kWholeObject : kWall;
        if (axis.concavity >= 0) axis.depth_m = regions[axis.concavity].depth_m;
        axes.push_back(axis);
    }
    return axes;
}

}  // namespace graspd::planner_detail
