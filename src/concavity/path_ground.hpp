#pragma once

#include <cstdint>
#include <vector>

#include "graspd/concavity/shortest_path_concavity.hpp"
#include "vertex_fans.hpp"

namespace graspd::concavity_detail {

/// What ways out run over: the mesh with its neighbourhoods, and where rays start. Independent of
/// the hull and of the tree.
struct PathGround {
    PathGround(const TriangleMesh& mesh, const ConcavityConfig& config);

    const TriangleMesh& mesh;
    double diagonal_m, offset_m;  ///< [m] the lift is offset_m
    double mean_edge_m;           ///< [m] of the mesh's edges
    VertexNeighbours neighbours;
    std::vector<FaceCorners> corners;      ///< by face
    std::vector<Eigen::Vector3d> normals;  ///< by vertex
    std::vector<Eigen::Vector3d> lifted;   ///< [m] vertices off the surface: where rays start
    std::vector<float> spread;             ///< sine of the widest angle of a face to the normal; 1
                                           ///< from a right angle on
    std::vector<char> can_bend;            ///< whether some mesh edge falls away from the vertex:
                                           ///< else, flat or hollow, no string is taut over it
    std::vector<std::uint32_t> order;      ///< vertices so that the next is often near

private:
    void look_around(std::uint32_t vertex);
};

/// Where a ray from a lifted point straight to a hull facet's plane has to end: one lift beyond it.
/// The object's own sides often lie in the plane, and a way out of the inside, through the solid,
/// ends on one of them.
inline Eigen::Vector3d beyond_plane(const HullFacet& facet, const Eigen::Vector3d& from,
                                    double offset_m) {
    return from + (facet.offset_m - facet.normal.dot(from) + offset_m) * facet.normal;
}

}  // namespace graspd::concavity_detail
