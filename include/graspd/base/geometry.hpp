#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace graspd {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh as received or as conditioned; the frame is named by the variable that holds it.
struct TriangleMesh {
    std::vector<Eigen::Vector3d> vertices;  ///< [m]
    std::vector<Triangle> faces;            ///< indices into `vertices`
};

/// An unordered point cloud.
struct PointCloud {
    std::vector<Eigen::Vector3d> points;           ///< [m], same frame as the object; may hold NaN
    std::optional<Eigen::Vector3d> sensor_origin;  ///< [m] where the sensor stood, same frame
};

/// A box with axes of its own: `pose` takes box coordinates to the outer frame, the box spans
/// [-half_extent, +half_extent] around the pose's origin.
struct OrientedBox {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::Vector3d half_extent = Eigen::Vector3d::Zero();  ///< [m]
};

/// A point of the surface with what the later stages need to know about it.
struct SurfaceSample {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< [m]
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward unit normal
    double area_m2 = 0.0;      ///< [m^2] share of the surface that the sample stands for
    double concavity_m = 0.0;  ///< [m] interpolated concavity; infinite where enclosed
};

/// Something noticed about the input: what, how much, and what was done about it.
struct Finding {
    std::string code;    ///< stable machine-readable name, such as "holes_filled"
    double value = 0.0;  ///< the measured count or length [m]
    std::string detail;  ///< one sentence for people
};

/// Outward unit normal of a face; zero for one without area.
inline Eigen::Vector3d face_normal(const TriangleMesh& mesh, std::uint32_t face) {
    const Triangle& t = mesh.faces[face];
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).stableNormalized();
}

/// Angle between two vectors of any length [rad], in [0, pi].
inline double angle_between_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace graspd
