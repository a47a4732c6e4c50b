#include "opposite_axes.hpp"

#include <algorithm>
#include <limits>

#include "graspd/base/stop.hpp"

namespace graspd::planner_detail {
namespace {

/// Tells which concavity a place of the surface belongs to.
class RegionIndex {
public:
    RegionIndex(const std::vector<Concavity>& regions, const SurfaceSamples& surface,
                double least_depth_m)
        : regions_(regions),
          surface_(surface),
          reach_m_(2.0 * surface.spacing_m),
          least_depth_m_(least_depth_m) {
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
    std::int32_t at(const Eigen::Vector3d& place) const {
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            if (!boxes_[r].contains(place)) continue;
            const bool near = std::ranges::any_of(regions_[r].salient, [&](std::uint32_t i) {
                return (surface_.samples[i].point - place).squaredNorm() <= reach_m_ * reach_m_;
            });
            if (near) return static_cast<std::int32_t>(r);
        }
        return -1;
    }
    std::int32_t nearest(const Eigen::Vector3d& place) const {
        std::int32_t best = -1;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            const double distance = boxes_[r].squaredExteriorDistance(place);
            if (distance >= least) continue;
            least = distance;
            best = static_cast<std::int32_t>(r);
        }
        return best;
    }

    const std::vector<Concavity>& regions_;
    const SurfaceSamples& surface_;
    double reach_m_, least_depth_m_;
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

std::vector<ClosingAxis> opposite_axes(const std::vector<Concavity>& regions,
                                       const SurfaceSamples& surface, const PreparedObject& object,
                                       const Gripper& gripper, const PlannerConfig& config,
                                       StageLog& log) {
    constexpr const char* kOpposite = "grasp/opposite_candidates";
    SampleSurfaceConfig coarse = config.sample_surface;
    coarse.max_samples = config.search.probe_samples;
    const auto probes =
        sample_surface(object.mesh_P, object.field.value_m, gripper.finger_width_m, coarse);
    if (!probes) return {};
    const auto candidates = log.run(kOpposite, probes.value().samples.size(), [&] {
        // Beyond the opening too, so that what is too wide is counted as such later.
        return opposite_candidates(probes.value().samples, object.mesh_P, *object.tree_P,
                                   std::max(gripper.max_width_m, mesh_diagonal_m(object.mesh_P)),
                                   config.opposite_candidates);
    });
    if (!candidates) return {};
    log.out(kOpposite, candidates.value().size());

    const RegionIndex index(
        regions, surface,
        config.extract_concave_areas.min_depth_finger_thicknesses * gripper.finger_thickness_m);
    std::vector<ClosingAxis> axes;
    for (const OppositeCandidate& candidate : candidates.value()) {
        stop_point(axes.size());
        ClosingAxis axis;
        axis.left_P = candidate.left_O;
        axis.right_P = candidate.right_O;
        const Eigen::Vector3d closing = (axis.right_P - axis.left_P).normalized();
        axis.reference_P = inward_direction(0.5 * (axis.left_P + axis.right_P), closing);
        axis.concavity =
            index.of(axis.left_P, probes.value().samples[candidate.sample].concavity_m);
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
