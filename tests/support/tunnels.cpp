#include "support/tunnels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/shape_builders.hpp"

namespace graspd::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWidth = 0.02;     // [m] of the tunnel
constexpr double kCeiling = 0.035;  // [m] depth of the ceiling of the leg along x (3-D: at y = 0)
constexpr double kFloor = kCeiling + kWidth;  // [m] depth of its floor
constexpr double kTurn = 0.06;                // [m] x of the last leg's near wall
constexpr double kEnd = kTurn + kWidth;       // [m] x of its far wall
constexpr double kWall = 0.02;                // [m]

constexpr double kDeadEnd = 0.09;    // [m] 2-D: depth of the dead end
constexpr double kFar = 0.08;        // [m] 3-D: y of the dead end
constexpr double kSlope = -0.25;     // 3-D: rise of floor and ceiling along y
constexpr double kUnderside = 0.12;  // [m] 3-D: depth of the block

/// The lip over which the 3-D tunnel turns up into its mouth.
Vector3d on_E1(double y) {
    return {kWidth, y, -kCeiling + kSlope * y};
}

/// Shortest way within the lower legs from a vertex to a point of E1. Out of the last leg it either
/// is straight or bends at the upright edge E2, at x = kTurn and y = kWidth; unfolded about E2 it
/// is straight, which gives the height; the length is convex in that height, so the legs' floor and
/// ceiling may be minded afterwards.
double to_lip_m(const Vector3d& p, const Vector3d& lip) {
    if (p.y() <= kWidth + kNear) return (p - lip).norm();
    const double share = (p.y() - kWidth) / (p.y() - lip.y());
    if (p.x() + share * (lip.x() - p.x()) >= kTurn) return (p - lip).norm();
    const double before = std::hypot(p.x() - kTurn, p.y() - kWidth);
    const double after = std::hypot(lip.x() - kTurn, lip.y() - kWidth);
    const double ceiling = -kCeiling + kSlope * kWidth;
    const double height = std::clamp((p.z() * after + lip.z() * before) / (before + after),
                                     ceiling - kWidth, ceiling);
    const Vector3d bend(kTurn, kWidth, height);
    return (p - bend).norm() + (bend - lip).norm();
}

/// The least value of a convex function on [low, high].
template <class Function>
double least_value(const Function& f, double low, double high) {
    constexpr double kShare = 1.0 / std::numbers::phi;
    double a = high - kShare * (high - low), b = low + kShare * (high - low);
    double f_a = f(a), f_b = f(b);
    double best = std::min({f(low), f(high), f_a, f_b});
    for (int i = 0; i < 45; ++i) {  // narrows to 1e-9 of the interval; the value to its square
        if (f_a < f_b) {
            high = b;
            b = a;
            f_b = f_a;
            f_a = f(a = high - kShare * (high - low));
        } else {
            low = a;
            a = b;
            f_a = f_b;
            f_b = f(b = low + kShare * (high - low));
        }
        best = std::min({best, f_a, f_b});
    }
    return best;
}

}  // namespace

TriangleMesh tunnel_2d(std::size_t faces) {
    const double half = 0.5 * kWidth;
    return grid_solid(
        {std::vector<double>{-kWall, 0.0, kWidth, kTurn, kEnd, kEnd + kWall},
         {-half - kWall, -half, half, half + kWall},
         {-kDeadEnd - kWall, -kDeadEnd, -kFloor, -kCeiling, 0.0}},
        [](int i, int j, int k) {
            const bool mouth = i == 1 && k >= 2, leg = i >= 1 && i <= 3 && k == 2;
            const bool last = i == 3 && k == 1;
            return j != 1 || !(mouth || leg || last);
        },
        faces);
}

double tunnel_2d_concavity_m(const Vector3d& vertex) {
    const Vector2d p(vertex.x(), vertex.z());
    const bool in_tunnel = std::abs(vertex.y()) < 0.5 * kWidth + kNear && p.x() > -kNear &&
                           p.x() < kEnd + kNear && p.y() > -kDeadEnd - kNear;
    if (!in_tunnel || p.x() < kWidth + kNear) return in_tunnel ? -p.y() : 0.0;
    const Vector2d lip(kWidth, -kCeiling), sill(kTurn, -kFloor);
    if (p.y() > -kCeiling + kNear) return 0.0;  // the block's top
    const double share = (sill.y() - p.y()) / (lip.y() - p.y());
    const bool sees_lip = p.y() >= sill.y() - kNear || p.x() + share * (lip.x() - p.x()) >= kTurn;
    const double to_lip = sees_lip ? (p - lip).norm() : (p - sill).norm() + (sill - lip).norm();
    return to_lip + kCeiling;
}

TriangleMesh tunnel_3d(std::size_t faces) {
    TriangleMesh mesh = grid_solid(
        {std::vector<double>{-kWall, 0.0, kWidth, kTurn, kEnd, kEnd + kWall},
         {-kWall, 0.0, kWidth, kFar, kFar + kWall},
         {-kUnderside, -kFloor, -kCeiling, 0.0}},
        [](int i, int j, int k) {
            const bool mouth = i == 1 && j == 1 && k >= 1, leg = i >= 1 && i <= 3 && j == 1;
            const bool last = i == 3 && (j == 1 || j == 2);
            return !(mouth || (k == 1 && (leg || last)));
        },
        faces);
    // Between floor and ceiling a shear; from there to the top and the underside it fades, so that
    // the block stays one. Planes of constant x or y stay planes.
    for (Vector3d& p : mesh.vertices) {
        const double above = -p.z() / kCeiling;
        const double below = (p.z() + kUnderside) / (kUnderside - kFloor);
        p.z() += kSlope * p.y() * std::min({1.0, above, below});
    }
    return mesh;
}

double tunnel_3d_concavity_m(const Vector3d& p) {
    constexpr double kDeepest = kFloor - kSlope * kFar;
    const bool in_tunnel = p.x() > -kNear && p.x() < kEnd + kNear && p.y() > -kNear &&
                           p.y() < kFar + kNear && p.z() < -kNear && p.z() > -kDeepest - kNear;
    if (!in_tunnel) return 0.0;
    if (p.x() < kWidth + kNear) return -p.z();
    return least_value([&](double y) { return to_lip_m(p, on_E1(y)) - on_E1(y).z(); }, 0.0, kWidth);
}

double tunnel_3d_way_m(const Vector3d& vertex, double z_on_E2_m, double y_on_E1_m) {
    const Vector3d second(kTurn, kWidth, z_on_E2_m), first = on_E1(y_on_E1_m);
    return (vertex - second).norm() + (second - first).norm() - first.z();
}

}  // namespace graspd::test
