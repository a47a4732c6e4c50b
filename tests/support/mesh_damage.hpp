#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

// Changes of a mesh whose effect a test knows. All random choices come from the seed alone.

/// Rotated, then translated.
TriangleMesh moved(TriangleMesh mesh, const Eigen::Isometry3d& X_new_old);
/// A rotation about a skew axis, and a shift by tens of centimetres, chosen by the seed.
Eigen::Isometry3d random_pose(std::uint64_t seed);
TriangleMesh scaled(TriangleMesh mesh, double factor);

/// Every vertex moved along each axis by up to a share of the bounding box's diagonal either way.
TriangleMesh noisy(TriangleMesh mesh, double share_of_diagonal, std::uint64_t seed);

/// Vertices and faces in another order, faces starting at another corner; the same surface.
/// @param new_of_old  where each vertex went, when wanted
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed,
                      std::vector<std::uint32_t>* new_of_old = nullptr);

/// `count` distinct faces, chosen by the seed, in rising order.
std::vector<std::size_t> choose_faces(const TriangleMesh& mesh, std::size_t count,
                                      std::uint64_t seed);
/// The faces given wound the other way.
TriangleMesh with_flipped(TriangleMesh mesh, const std::vector<std::size_t>& faces);
/// Without the faces given; vertices stay.
TriangleMesh without(const TriangleMesh& mesh, const std::vector<std::size_t>& faces);
/// With the faces given once more, at the end.
TriangleMesh with_duplicates(TriangleMesh mesh, const std::vector<std::size_t>& faces);
/// Three vertices of its own for every face, as STL files have: vertex 3f + k is corner k of face
/// f.
TriangleMesh to_soup(const TriangleMesh& mesh);
/// Both meshes in one, the second's vertices after the first's.
TriangleMesh joined(const TriangleMesh& first, const TriangleMesh& second);
/// Every face wound the other way.
TriangleMesh inside_out(TriangleMesh mesh);

}  // namespace graspd::test
