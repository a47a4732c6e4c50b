#include "graspd/grasp/opposite_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "graspd/base/parallel.hpp"
#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

// The line begins this far inside the surface, so that it does not meet the sample's own face.
constexpr double kSkin_m = 1e-6;

struct Exit {
    Eigen::Vector3d point_O, normal_O;
    std::uint32_t face = 0;
};

std::optional<Exit> leave(const TriangleMesh& mesh, const TriangleBvh& tree,
                          const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                          double opening_m) {
    const auto hit = tree.first_hit(from + kSkin_m * direction, direction, opening_m);
    if (!hit || hit->from_outside) return std::nullopt;
    return Exit{from + (hit->distance_m + kSkin_m) * direction, face_normal(mesh, hit->face),
                hit->face};
}

std::optional<OppositeCandidate> opposite_of(const SurfaceSample& sample, const TriangleMesh& mesh,
                                             const TriangleBvh& tree, double opening_m,
                                             const OppositeCandidatesConfig& config) {
    std::optional<OppositeCandidate> best;
    Eigen::Vector3d direction = -sample.normal;
    for (std::uint32_t turn = 0; turn <= config.turns; ++turn) {
        const auto exit = leave(mesh, tree, sample.point, direction, opening_m);
        if (!exit) break;
        const double lean = std::max(angle_between_rad(direction, -sample.normal),
                                     angle_between_rad(direction, exit->normal_O));
        if (!best || lean < best->lean_rad) {
            best = OppositeCandidate{sample.point, exit->point_O, lean, 0, exit->face};
        }
        direction = (exit->normal_O - sample.normal).stableNormalized();
        if (direction.dot(-sample.normal) <= 0.0) break;
    }
    if (best && best->lean_rad > config.max_lean_rad) return std::nullopt;
    return best;
}

}  // namespace

Result<std::vector<OppositeCandidate>> opposite_candidates(std::span<const SurfaceSample> samples,
                                                           const TriangleMesh& mesh_O,
                                                           const TriangleBvh& tree_O,
                                                           double opening_m,
                                                           const OppositeCandidatesConfig& config) {
    if (auto bad = validate(config, "opposite_candidates.")) return *bad;
    if (auto bad = check_positive("opposite_candidates: opening_m", opening_m)) return *bad;
    constexpr std::size_t kSamplesAtATime = 64;
    std::vector<std::optional<OppositeCandidate>> of_sample(samples.size());
    for_blocks(samples.size(), kSamplesAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (!std::isfinite(samples[i].concavity_m)) continue;  // no hand gets there
            of_sample[i] = opposite_of(samples[i], mesh_O, tree_O, opening_m, config);
        }
    });
    std::vector<OppositeCandidate> candidates;
    for (std::uint32_t i = 0; i < of_sample.size(); ++i) {
        if (!of_sample[i]) continue;
        of_sample[i]->sample = i;
        candidates.push_back(*of_sample[i]);
    }
    return candidates;
}

}  // namespace graspd
