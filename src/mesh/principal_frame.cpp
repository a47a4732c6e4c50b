#include "graspd/mesh/principal_frame.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

constexpr double kVanishing = 1e-9;  // rounding of the third moment, relative to the spread's cube

/// Calls visit(twice the area, corner, corner, corner) for every face.
template <class Visit>
void for_each_face(const TriangleMesh& mesh, Visit&& visit) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        stop_point(f);
        const Triangle& t = mesh.faces[f];
        const Eigen::Vector3d& a = mesh.vertices[t[0]];
        const Eigen::Vector3d& b = mesh.vertices[t[1]];
        const Eigen::Vector3d& c = mesh.vertices[t[2]];
        visit((b - a).cross(c - a).norm(), a, b, c);
    }
}

/// Integral of (direction . (x - center))^3 over the surface: area / 10 times the complete
/// homogeneous polynomial of degree 3 in the corners' coordinates.
double third_moment(const TriangleMesh& mesh, const Eigen::Vector3d& center,
                    const Eigen::Vector3d& direction) {
    double sum = 0.0;
    for_each_face(mesh, [&](double twice_area, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
        const double p = direction.dot(a - center);
        const double q = direction.dot(b - center);
        const double r = direction.dot(c - center);
        const double homogeneous =
            p * p * (p + q + r) + q * q * (q + r + p) + r * r * (r + p + q) + p * q * r;
        sum += twice_area / 20.0 * homogeneous;
    });
    return sum;
}

Eigen::Vector3d with_sign(const TriangleMesh& mesh, const Eigen::Vector3d& center,
                          const Eigen::Vector3d& axis, double scale) {
    const double moment = third_moment(mesh, center, axis);
    if (std::abs(moment) > kVanishing * scale) return moment < 0.0 ? Eigen::Vector3d(-axis) : axis;
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

}  // namespace

Result<Eigen::Isometry3d> principal_frame(const TriangleMesh& mesh_O) {
    double twice_area = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Eigen::Vector3d anchor =
        mesh_O.vertices.empty() ? Eigen::Vector3d(0, 0, 0) : mesh_O.vertices.front();
    for_each_face(mesh_O, [&](double area2, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c) {
        twice_area += area2;
        sum += area2 / 3.0 * ((a - anchor) + (b - anchor) + (c - anchor));
    });
    if (!(twice_area > 0.0) || !std::isfinite(twice_area) || !sum.allFinite()) {
        return PlanError{PlanErrorCode::kDegenerate,
                         "the surface has an area of " + std::to_string(0.5 * twice_area) + " m2"};
    }
    const Eigen::Vector3d center = anchor + sum / twice_area;

    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for_each_face(mesh_O, [&](double area2, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c) {
        const Eigen::Vector3d p = a - center, q = b - center, r = c - center, s = p + q + r;
        spread += area2 / 24.0 *
                  (s * s.transpose() + p * p.transpose() + q * q.transpose() + r * r.transpose());
    });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    if (solver.info() != Eigen::Success) {
        return PlanError{PlanErrorCode::kDegenerate, "the surface's spread has no axes"};
    }
    const double scale = 0.5 * twice_area * std::pow(2.0 * spread.trace() / twice_area, 1.5);
    Eigen::Isometry3d X_OP = Eigen::Isometry3d::Identity();
    X_OP.linear().col(0) = with_sign(mesh_O, center, solver.eigenvectors().col(2), scale);
    X_OP.linear().col(1) = with_sign(mesh_O, center, solver.eigenvectors().col(1), scale);
    X_OP.linear().col(2) = X_OP.linear().col(0).cross(X_OP.linear().col(1));
    X_OP.translation() = center;
    return X_OP;
}

TriangleMesh transformed(const Eigen::Isometry3d& X_new_old, const TriangleMesh& mesh_old) {
    TriangleMesh mesh{{}, mesh_old.faces};
    mesh.vertices.reserve(mesh_old.vertices.size());
    for (const Eigen::Vector3d& vertex : mesh_old.vertices) {
        mesh.vertices.push_back(X_new_old * vertex);
    }
    return mesh;
}

}  // namespace graspd
