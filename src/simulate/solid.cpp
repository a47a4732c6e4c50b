#include "solid.hpp"

namespace graspd::simulate_detail {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Solid solid_of(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d bounds;
    for (const Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
    Solid solid{0.0, Vector3d::Zero(), Matrix3d::Zero()};
    if (bounds.isEmpty()) return solid;
    const Vector3d middle = bounds.center();
    Vector3d first = Vector3d::Zero();  // moments about the middle
    Matrix3d second = Matrix3d::Zero();
    for (const Triangle& face : mesh.faces) {
        const Vector3d a = mesh.vertices[face[0]] - middle, b = mesh.vertices[face[1]] - middle,
                       c = mesh.vertices[face[2]] - middle;
        const double volume = a.dot(b.cross(c)) / 6.0;
        const Vector3d sum = a + b + c;
        solid.volume_m3 += volume;
        first += volume / 4.0 * sum;
        // Of a tetrahedron with a corner at the origin: V/20 (sum of p p^T + s s^T).
        second +=
            volume / 20.0 *
            (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    if (solid.volume_m3 == 0.0) return solid;
    const Vector3d offset = first / solid.volume_m3;
    const Matrix3d spread = second / solid.volume_m3 - offset * offset.transpose();
    solid.center = middle + offset;
    solid.inertia_m2 = spread.trace() * Matrix3d::Identity() - spread;
    return solid;
}

}  // namespace graspd::simulate_detail
