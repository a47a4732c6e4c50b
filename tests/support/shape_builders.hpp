#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

inline constexpr double kNear = 1e-9;  ///< [m] rounding of vertices that lie on a given surface

/// Solid of cells in a grid with planes at lines[0..2]: cell (i, j, k) spans
/// lines[0][i]..lines[0][i + 1] and so on. Its surface is cut into about `faces` right triangles,
/// conforming, closed and outward oriented. Cells may not touch in an edge or corner alone.
TriangleMesh grid_solid(const std::array<std::vector<double>, 3>& lines,
                        const std::function<bool(int i, int j, int k)>& filled, std::size_t faces);

/// Solid of revolution about z: `profile` holds (radius, z) corners of the outline in the half
/// plane, either from axis to axis (first and last radius 0) or, with `closed`, round a ring.
/// Rings are regular polygons whose corners lie on the true circles, so planar sides lie inside the
/// true surface by up to R (1 - cos(pi / sides)). About `faces` triangles, closed, outward.
TriangleMesh lathe(const std::vector<Eigen::Vector2d>& profile, bool closed, std::size_t faces);

/// How many sides lathe's rings have.
int lathe_sides(const std::vector<Eigen::Vector2d>& profile, bool closed, std::size_t faces);

/// The same from axis to axis with the number of sides given, every ring turned by a random angle
/// that the seed chooses. Each triangle's corners lie within 3 pi / sides about the axis.
TriangleMesh twisted_lathe(const std::vector<Eigen::Vector2d>& profile, int sides,
                           std::size_t faces, std::uint64_t seed);

/// Volume by the divergence theorem [m^3]; positive when outward oriented.
double signed_volume_m3(const TriangleMesh& mesh);

/// Whether every directed half-edge has exactly one opposite.
bool is_closed_manifold(const TriangleMesh& mesh);

/// Whether on every undirected edge as many half-edges run one way as the other.
bool is_balanced(const TriangleMesh& mesh);

}  // namespace graspd::test
