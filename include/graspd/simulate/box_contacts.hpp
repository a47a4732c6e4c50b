#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

/// One place where a box presses on a surface.
struct BoxContact {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< [m] on the surface, within the box
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the box
    double depth_m = 0.0;                              ///< [m] > 0
};

/// How a box is rounded and how finely a patch is divided.
struct BoxContactConfig {
    double rounding_m = 0.001;  ///< [m] of edges and corners; at most half the least half extent
    double cell_m = 0.006;      ///< [m] one contact for each cell of a face
    std::size_t most = 48;      ///< the deepest ones are kept
};

/// Contacts of a box with the triangles themselves, whatever cavities they enclose.
///
/// On a face of the box the depth is integrated over the area of what lies below it, cell by cell:
/// a contact stands at a cell's centre of pressure, has the depth that the pressure has there in
/// the mean, and does not depend on how the surface is cut into triangles. Along its edges the box
/// is rounded, so that an edge against a flat side has that side's normal. Only triangles that
/// face the box count, so that a box behind a thin wall is not drawn through it. Depths up to twice
/// the rounding are seen: far more than a few newtons press in.
///
/// @param mesh  closed, outward oriented [m]; `bvh` is its tree
/// @param box   in the mesh's frame
/// @return at most config.most, face by face, then edge by edge
/// Complexity O(triangles near the box). Pure, so safe to call from any thread.
std::vector<BoxContact> box_contacts(const TriangleMesh& mesh, const TriangleBvh& bvh,
                                     const OrientedBox& box, const BoxContactConfig& config = {});

}  // namespace graspd
