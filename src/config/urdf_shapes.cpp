#include "urdf_shapes.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "graspd/base/hull_points.hpp"
#include "graspd/mesh/read_object.hpp"

namespace graspd::config_detail {
namespace {

using Eigen::Vector3d;

constexpr int kSides = 24;  // of what stands for a circle
const double kHalfSide_rad = std::numbers::pi / kSides;

std::vector<Vector3d> box_corners(const urdf::Box& box) {
    std::vector<Vector3d> corners;
    for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
            for (const double z : {-0.5, 0.5}) {
                corners.emplace_back(x * box.dim.x, y * box.dim.y, z * box.dim.z);
            }
        }
    }
    return corners;
}

/// A regular polygon about z whose sides touch the circle of that radius.
void add_polygon(double radius_m, double z_m, std::vector<Vector3d>& corners) {
    const double outer_m = radius_m / std::cos(kHalfSide_rad);
    for (int i = 0; i < kSides; ++i) {
        const double angle = 2.0 * kHalfSide_rad * i;
        corners.emplace_back(outer_m * std::cos(angle), outer_m * std::sin(angle), z_m);
    }
}

/// Rings of such polygons; between two rings their hull comes as near as half a step's cosine.
std::vector<Vector3d> sphere_corners(double radius_m) {
    const double outer_m = radius_m / std::cos(kHalfSide_rad);
    std::vector<Vector3d> corners = {{0, 0, outer_m}, {0, 0, -outer_m}};
    for (int ring = 1; ring < kSides / 2; ++ring) {
        const double angle = 2.0 * kHalfSide_rad * ring;
        add_polygon(outer_m * std::sin(angle), outer_m * std::cos(angle), corners);
    }
    return corners;
}

/// Where a mesh is: package://NAME/PATH in a folder NAME above the URDF, else beside it.
std::optional<std::filesystem::path> find_mesh(const std::string& name,
                                               const std::filesystem::path& urdf) {
    constexpr std::string_view kPackage = "package://", kFile = "file://";
    const auto folder = std::filesystem::absolute(urdf).parent_path();
    std::filesystem::path path;
    if (name.starts_with(kPackage)) {
        const std::filesystem::path inner = name.substr(kPackage.size());
        const std::string package = inner.begin()->string();
        auto parent = folder;
        while (parent.has_relative_path() && parent.filename() != package) {
            parent = parent.parent_path();
        }
        path = parent.parent_path() / inner;
    } else {
        path = folder / (name.starts_with(kFile) ? name.substr(kFile.size()) : name);
    }
    return std::filesystem::is_regular_file(path) ? std::optional(path) : std::nullopt;
}

Result<std::vector<Vector3d>> mesh_corners(const urdf::Mesh& mesh,
                                           const std::filesystem::path& file) {
    const auto path = find_mesh(mesh.filename, file);
    if (!path) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         file.string() + ": mesh filename = " + mesh.filename + " is not found"};
    }
    const auto read = read_object(*path);
    if (!read.ok()) return read.error();
    const auto* triangles = std::get_if<TriangleMesh>(&read.value().object);
    if (triangles == nullptr) {
        return PlanError{PlanErrorCode::kInvalidInput, path->string() + " has no faces"};
    }
    std::vector<Vector3d> corners;
    const Vector3d scale(mesh.scale.x, mesh.scale.y, mesh.scale.z);
    for (const Vector3d& vertex : triangles->vertices) {
        corners.push_back(vertex.cwiseProduct(scale));
    }
    auto hull = hull_points(corners);
    if (!hull.ok())
        return PlanError{hull.error().code, path->string() + ": " + hull.error().detail};
    return hull;
}

}  // namespace

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    const auto& q = pose.rotation;
    X.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    X.translation() << pose.position.x, pose.position.y, pose.position.z;
    return X;
}

Result<std::vector<Vector3d>> corners_of(const urdf::Geometry& geometry,
                                         const std::filesystem::path& file) {
    switch (geometry.type) {
        case urdf::Geometry::BOX: return box_corners(static_cast<const urdf::Box&>(geometry));
        case urdf::Geometry::SPHERE:
            return sphere_corners(static_cast<const urdf::Sphere&>(geometry).radius);
        case urdf::Geometry::CYLINDER: {
            const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
            std::vector<Vector3d> corners;
            for (const double side : {-0.5, 0.5}) {
                add_polygon(cylinder.radius, side * cylinder.length, corners);
            }
            return corners;
        }
        case urdf::Geometry::MESH:
            return mesh_corners(static_cast<const urdf::Mesh&>(geometry), file);
    }
    return PlanError{PlanErrorCode::kInvalidInput, file.string() + ": an unknown geometry"};
}

}  // namespace graspd::config_detail
