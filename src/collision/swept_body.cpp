#include "swept_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graspd::collision_detail {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t face, const Vector3d& shift) {
    const Triangle& t = mesh.faces[face];
    return {mesh.vertices[t[0]] + shift, mesh.vertices[t[1]] + shift, mesh.vertices[t[2]] + shift};
}

/// Two triangles, the first of which moves along a way.
struct Pair {
    const Corners& moving;
    const Corners& standing;
    const Vector3d& way;

    bool parted_by(const Vector3d& axis) const {
        const double m[] = {moving[0].dot(axis), moving[1].dot(axis), moving[2].dot(axis)};
        const double s[] = {standing[0].dot(axis), standing[1].dot(axis), standing[2].dot(axis)};
        const double along = way.dot(axis);
        return *std::ranges::min_element(m) + std::min(0.0, along) > *std::ranges::max_element(s) ||
               *std::ranges::max_element(m) + std::max(0.0, along) < *std::ranges::min_element(s);
    }
};

// The difference of both is a polytope whose edges run along those of the triangles and along the
// way; two of them span each of its faces. Where all lie in one plane, the axes in it decide.
bool sweep_meets(const Pair& pair) {
    std::array<Vector3d, 7> edges;
    for (std::size_t i = 0; i < 3; ++i) {
        edges[i] = pair.moving[(i + 1) % 3] - pair.moving[i];
        edges[i + 3] = pair.standing[(i + 1) % 3] - pair.standing[i];
    }
    edges[6] = pair.way;
    const Vector3d normal = edges[3].cross(edges[4]);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (pair.parted_by(normal.cross(edges[i]))) return false;
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            if (pair.parted_by(edges[i].cross(edges[j]))) return false;
        }
    }
    return true;
}

/// A box around corners and what they pass, with an axis along the way.
OrientedBox box_around(const Eigen::Matrix3Xd& corners, const Vector3d& way) {
    OrientedBox box;
    box.pose.linear() =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), way).toRotationMatrix();
    const Eigen::Matrix3Xd local = box.pose.linear().transpose() * corners;
    const Vector3d low = local.rowwise().minCoeff();
    Vector3d high = local.rowwise().maxCoeff();
    high.z() += way.norm();
    box.pose.translation() = box.pose.linear() * (0.5 * (low + high));
    box.half_extent = 0.5 * (high - low);
    return box;
}
OrientedBox box_around(const Corners& corners, const Vector3d& way) {
    Eigen::Matrix3Xd points(3, 3);
    for (Eigen::Index i = 0; i < 3; ++i) points.col(i) = corners[static_cast<std::size_t>(i)];
    return box_around(points, way);
}
OrientedBox box_around(const Eigen::AlignedBox3d& bounds, const Vector3d& shift,
                       const Vector3d& way) {
    Eigen::Matrix3Xd points(3, 8);
    for (int i = 0; i < 8; ++i) {
        points.col(i) = bounds.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)) + shift;
    }
    return box_around(points, way);
}

/// Whether one of these faces of the first body meets a face of the second while it moves.
bool any_meets(const CollisionBody& first, const std::vector<std::uint32_t>& faces,
               const Vector3d& shift, const Vector3d& way, const CollisionBody& second) {
    return std::ranges::any_of(faces, [&](std::uint32_t face) {
        const Corners corners = corners_of(*first.mesh, face, shift);
        const auto near = second.bvh->faces_near(box_around(corners, way), 0.0);
        return std::ranges::any_of(near, [&](std::uint32_t other) {
            return sweep_meets({corners, corners_of(*second.mesh, other, Vector3d::Zero()), way});
        });
    });
}

}  // namespace

bool sweep_meets(const CollisionBody& moving, const Vector3d& from_W, const Vector3d& way_W,
                 const CollisionBody& standing) {
    if (moving.bvh->bounds().isEmpty() || standing.bvh->bounds().isEmpty()) return false;
    // Seen from the moving body the other one moves the opposite way.
    const auto mine =
        moving.bvh->faces_near(box_around(standing.bvh->bounds(), -from_W, -way_W), 0.0);
    const auto theirs =
        standing.bvh->faces_near(box_around(moving.bvh->bounds(), from_W, way_W), 0.0);
    const bool meets = mine.size() <= theirs.size()
                           ? any_meets(moving, mine, from_W, way_W, standing)
                           : any_meets(standing, theirs, -from_W, -way_W, moving);
    if (meets) return true;
    const auto holds_a_corner = [](const CollisionBody& outer, const CollisionBody& inner,
                                   const Vector3d& shift) {
        return outer.bvh->contains(inner.mesh->vertices[inner.mesh->faces.front()[0]] + shift);
    };
    return holds_a_corner(standing, moving, from_W) || holds_a_corner(moving, standing, -from_W);
}

}  // namespace graspd::collision_detail
