#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

/// Which places count as opposite.
struct OppositeCandidatesConfig {
    double max_lean_rad = 0.7;  ///< [rad] greatest angle between the line and an inward normal
    std::uint32_t turns = 1;    ///< how often the line is turned towards both normals

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("max_lean_rad", self.max_lean_rad, 0.01, 1.5);
        visit("turns", self.turns, 0u, 10u);
    }
};

/// Two places of the surface that a hand can close on, with solid or a wall between them.
struct OppositeCandidate {
    Eigen::Vector3d left_O = Eigen::Vector3d::Zero();   ///< [m] the sample; Gx runs to `right_O`
    Eigen::Vector3d right_O = Eigen::Vector3d::Zero();  ///< [m] where the line leaves the object
    double lean_rad = 0.0;         ///< [rad] the worse angle between the line and an inward normal
    std::uint32_t sample = 0;      ///< index of the sample
    std::uint32_t right_face = 0;  ///< face of the mesh at `right_O`
};

/// Pairs samples of the surface with the places where a line through the solid leaves it: across
/// the whole object where it is convex, across a wall where the line ends in a concavity.
///
/// Source: none in the paper, which has no answer for objects without concavity (III).
///
/// @param samples    of the object, the fewer the cheaper
/// @param mesh_O     the object, same frame; @param tree_O  over it
/// @param opening_m  [m] > 0
/// @return at most one candidate a sample, in the order of samples: both normals lean by at most
///         max_lean_rad and the width is at most the opening; kInvalidInput for a length or
///         parameter out of range
/// Complexity O(N log F). Pure, so safe to call from any thread.
Result<std::vector<OppositeCandidate>> opposite_candidates(std::span<const SurfaceSample> samples,
                                                           const TriangleMesh& mesh_O,
                                                           const TriangleBvh& tree_O,
                                                           double opening_m,
                                                           const OppositeCandidatesConfig& config);

}  // namespace graspd
