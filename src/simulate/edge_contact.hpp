#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "graspd/simulate/box_contacts.hpp"

namespace graspd::simulate_detail {

/// Corners of a triangle, in any frame.
using Corners = std::array<Eigen::Vector3d, 3>;

/// The nearest points of a segment and a triangle.
struct NearestPoints {
    Eigen::Vector3d on_segment = Eigen::Vector3d::Zero();
    Eigen::Vector3d on_triangle = Eigen::Vector3d::Zero();
};
/// Where they meet both are the same; a triangle without area counts as its edges.
NearestPoints nearest_points(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Corners& triangle);

/// Contacts at the rounded edges and corners of a box about the origin, the deepest for each piece
/// of an edge.
class EdgeContacts {
public:
    /// @param core  [m] half extents of the box without its rounding
    EdgeContacts(const Eigen::Vector3d& core, double rounding_m, double cell_m);

    /// @param normal  of the triangle, any length
    void add(const Corners& triangle, const Eigen::Vector3d& normal);

    /// Appends them in the box's frame, edge by edge.
    void take(std::vector<BoxContact>& contacts) const;

private:
    struct Edge {
        Eigen::Index axis = 0;
        Eigen::Vector3d middle;         ///< the two signs across `axis` are the edge's side
        std::vector<BoxContact> cells;  ///< depth 0: none
    };
    static bool belongs(const Edge& edge, const Eigen::Vector3d& out);
    void meet(Edge& edge, const Corners& triangle, const Eigen::Vector3d& normal) const;

    Eigen::Vector3d core_;
    double rounding_m_;
    std::array<Edge, 12> edges_;
};

}  // namespace graspd::simulate_detail
