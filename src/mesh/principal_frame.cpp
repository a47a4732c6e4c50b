#include "graspd/mesh/principal_frame.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

constexpr double kVanishing = 1e-9;  // rounding of the third moment, relative to the spread's cube

/// Faces with what every moment of the surface needs of them.
class Faces {
public:
    explicit Faces(const TriangleMesh& mesh) : mesh_(mesh) {
        twice_area_.reserve(mesh.faces.size());
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            stop_point(f);
            const Triangle& t = mesh.faces[f];
            const Eigen::Vector3d& a = mesh.vertices[t[0]];
            twice_area_.push_back((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm());
        }
    }
    /// Calls visit(twice the area, corner, corner, corner) for every face.
    template <class Visit>
    void each(Visit&& visit) const {
        for (std::size_t f = 0; f < twice_area_.size(); ++f) {
            stop_point(f);
            const Triangle& t = mesh_.faces[f];
            visit(twice_area_[f], mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
        }
    }

private:
    const TriangleMesh& mesh_;
    std::vector<double> twice_area_;  ///< [m2]
};

/// Integrals of (direction . (x - center))^3 over the surface, for two directions: area / 10 times
/// the complete homogeneous polynomial of degree 3 in the corners' coordinates.
Eigen::Array2d third_moments(const Faces& faces, const Eigen::Vector3d& center,
                             const Eigen::Matrix<double, 3, 2>& directions) {
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    faces.each([&](double twice_area, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   const Eigen::Vector3d& c) {
        const Eigen::Array2d p = directions.transpose() * (a - center);
        const Eigen::Array2d q = directions.transpose() * (b - center);
        const Eigen::Array2d r = directions.transpose() * (c - center);
        sum += twice_area / 20.0 *
               (p * p * (p + q + r) + q * q * (q + r + p) + r * r * (r + p + q) + p * q * r);
    });
    return sum;
}

Eigen::Vector3d with_sign(const Eigen::Vector3d& axis, double moment, double scale) {
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
    const Faces faces(mesh_O);
    faces.each([&](double area2, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
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
    faces.each([&](double area2, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
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
    Eigen::Matrix<double, 3, 2> axes;
    axes << solver.eigenvectors().col(2), solver.eigenvectors().col(1);
    const Eigen::Array2d moments = third_moments(faces, center, axes);
    for (Eigen::Index i = 0; i < 2; ++i) {
        X_OP.linear().col(i) = with_sign(axes.col(i), moments[i], scale);
    }
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
