#include "convert_collision_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "graspd/base/solid_meshes.hpp"

namespace graspd::dds {
namespace {

namespace operation = moveit_msgs::msg::dds_::CollisionObject__Constants;
namespace primitive = shape_msgs::msg::dds_::SolidPrimitive__Constants;
using moveit_msgs::msg::dds_::CollisionObject_;
using shape_msgs::msg::dds_::SolidPrimitive_;
using Poses = std::vector<geometry_msgs::msg::dds_::Pose_>;

constexpr NumberRange kLength_m{0.0, 100.0, true};  // of a primitive

void check_operation(const CollisionObject_& object, const std::string& path, FirstError& errors) {
    if (object.operation() == operation::ADD_ || object.operation() == operation::APPEND_) return;
    errors.invalid(path + ".operation = " + std::to_string(object.operation()) +
                   " must be ADD (0) or APPEND (2): graspd keeps no planning scene");
}

/// One pose a part; those that are missing are the identity.
std::vector<Eigen::Isometry3d> read_poses(const Poses& poses, std::size_t parts,
                                          const std::string& path, FirstError& errors) {
    if (poses.size() > parts) {
        errors.invalid(path + " has " + std::to_string(poses.size()) + " elements for " +
                       std::to_string(parts) + " parts");
    }
    std::vector<Eigen::Isometry3d> out(parts, Eigen::Isometry3d::Identity());
    for (std::size_t i = 0; i < std::min(poses.size(), parts) && !errors.any(); ++i) {
        out[i] = read_pose(poses[i], element(path, i), errors);
    }
    return out;
}

/// The mesh as it stands, with indices and coordinates checked: several of them become one object,
/// in which a wrong index would be another part's right one.
TriangleMesh read_part(const shape_msgs::msg::dds_::Mesh_& mesh, const std::string& path,
                       FirstError& errors) {
    TriangleMesh out = read_mesh(mesh);
    if (out.faces.empty()) errors.invalid(path + " has no triangles");
    for (std::size_t i = 0; i < out.vertices.size() && !errors.any(); ++i) {
        if (out.vertices[i].allFinite()) continue;
        errors.invalid(element(path + ".vertices", i) + " is not finite");
    }
    for (std::size_t i = 0; i < out.faces.size() && !errors.any(); ++i) {
        const std::uint32_t highest = *std::ranges::max_element(out.faces[i]);
        if (highest < out.vertices.size()) continue;
        errors.invalid(element(path + ".triangles", i) + " uses vertex " + std::to_string(highest) +
                       " of " + std::to_string(out.vertices.size()));
    }
    return out;
}

struct PrimitiveKind {
    std::uint8_t type;
    const char* name;
    std::size_t dimensions;
};

TriangleMesh read_primitive(const SolidPrimitive_& in, const std::string& path,
                            FirstError& errors) {
    static constexpr std::array kKinds = {PrimitiveKind{primitive::BOX_, "BOX", 3},
                                          PrimitiveKind{primitive::SPHERE_, "SPHERE", 1},
                                          PrimitiveKind{primitive::CYLINDER_, "CYLINDER", 2},
                                          PrimitiveKind{primitive::CONE_, "CONE", 2}};
    const auto kind = std::ranges::find(kKinds, in.type(), &PrimitiveKind::type);
    if (kind == kKinds.end()) {
        errors.invalid(path + ".type = " + std::to_string(in.type()) +
                       " must be BOX (1), SPHERE (2), CYLINDER (3) or CONE (4); send any other "
                       "shape as a mesh");
        return {};
    }
    const auto& size = in.dimensions();
    if (size.size() != kind->dimensions) {
        errors.invalid(path + ".dimensions has " + std::to_string(size.size()) + " elements, a " +
                       kind->name + " has " + std::to_string(kind->dimensions));
        return {};
    }
    for (std::size_t i = 0; i < size.size(); ++i) {
        read_number(size[i], element(path + ".dimensions", i), kLength_m, errors);
    }
    if (errors.any()) return {};
    switch (in.type()) {
        case primitive::BOX_: return box_mesh({size[0], size[1], size[2]});
        case primitive::SPHERE_: return sphere_mesh(size[0]);
        case primitive::CYLINDER_: return cylinder_mesh(size[0], size[1]);
        default: return cone_mesh(size[0], size[1]);
    }
}

void place(TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = pose * vertex;
}

void read_solids(const CollisionObject_& in, const std::string& path, CollisionParts& out,
                 FirstError& errors) {
    const auto mesh_poses =
        read_poses(in.mesh_poses(), in.meshes().size(), path + ".mesh_poses", errors);
    for (std::size_t i = 0; i < in.meshes().size() && !errors.any(); ++i) {
        out.solids_O.push_back(read_part(in.meshes()[i], element(path + ".meshes", i), errors));
        place(out.solids_O.back(), mesh_poses[i]);
    }
    const auto poses =
        read_poses(in.primitive_poses(), in.primitives().size(), path + ".primitive_poses", errors);
    for (std::size_t i = 0; i < in.primitives().size() && !errors.any(); ++i) {
        out.solids_O.push_back(
            read_primitive(in.primitives()[i], element(path + ".primitives", i), errors));
        place(out.solids_O.back(), poses[i]);
    }
}

void read_planes(const CollisionObject_& in, const std::string& path, CollisionParts& out,
                 FirstError& errors) {
    const auto poses =
        read_poses(in.plane_poses(), in.planes().size(), path + ".plane_poses", errors);
    for (std::size_t i = 0; i < in.planes().size() && !errors.any(); ++i) {
        const auto& [a, b, c, d] = in.planes()[i].coef();
        const Eigen::Vector3d normal(a, b, c);
        const double length = normal.norm();
        if (!(length > 1e-9) || !std::isfinite(length) || !std::isfinite(d)) {
            errors.invalid(element(path + ".planes", i) + ".coef = (" + shown(a) + ", " + shown(b) +
                           ", " + shown(c) + ", " + shown(d) + ") is no plane");
            return;
        }
        const Eigen::Isometry3d X_FPlane = out.X_FO * poses[i];
        const Eigen::Vector3d normal_F = X_FPlane.linear() * normal / length;
        out.planes_F.push_back({normal_F, -d / length + normal_F.dot(X_FPlane.translation())});
    }
}

}  // namespace

void check_frame(const std::string& frame, const std::string& path, const std::string& frame_id,
                 FirstError& errors) {
    if (frame.empty() || frame == frame_id) return;
    errors.invalid(path + ".header.frame_id = " + shown(frame) + " must be that of the target, " +
                   shown(frame_id) + ": graspd transforms nothing");
}

CollisionParts read_collision_object(const CollisionObject_& object, const std::string& path,
                                     const std::string& frame_id, FirstError& errors) {
    CollisionParts out;
    check_operation(object, path, errors);
    check_frame(object.header().frame_id(), path, frame_id, errors);
    const std::size_t solids = object.meshes().size() + object.primitives().size();
    check_count(solids, kMostParts, path + ": meshes and primitives", errors);
    check_count(object.planes().size(), kMostParts, path + ".planes", errors);
    if (errors.any()) return out;
    out.X_FO = read_pose(object.pose(), path + ".pose", errors);
    read_solids(object, path, out, errors);
    read_planes(object, path, out, errors);
    return out;
}

}  // namespace graspd::dds
