#include "edge_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd::simulate_detail {
namespace {

using Eigen::Vector3d;

// A direction that leans less than this out of a face belongs to the face (its sine).
constexpr double kFaceLean = 0.01;

/// Nearest points of two segments (a, a + u) and (c, c + v); Ericson, Real-Time Collision
/// Detection, 5.1.9.
NearestPoints nearest_of_segments(const Vector3d& a, const Vector3d& u, const Vector3d& c,
                                  const Vector3d& v) {
    const Vector3d r = a - c;
    const double uu = u.squaredNorm(), vv = v.squaredNorm();
    const double ur = u.dot(r), vr = v.dot(r), uv = u.dot(v);
    double s = 0.0, t = 0.0;
    if (uu > 0.0 && vv > 0.0) {
        const double parallel = uu * vv - uv * uv;
        if (parallel > 1e-12 * uu * vv) s = std::clamp((uv * vr - ur * vv) / parallel, 0.0, 1.0);
        t = std::clamp((uv * s + vr) / vv, 0.0, 1.0);
        s = std::clamp((uv * t - ur) / uu, 0.0, 1.0);
    } else if (vv > 0.0) {
        t = std::clamp(vr / vv, 0.0, 1.0);
    } else if (uu > 0.0) {
        s = std::clamp(-ur / uu, 0.0, 1.0);
    }
    return {a + s * u, c + t * v};
}

bool above(const Corners& triangle, const Vector3d& normal, const Vector3d& point) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d side = triangle[(i + 1) % 3] - triangle[i];
        if (normal.dot(side.cross(point - triangle[i])) < 0.0) return false;
    }
    return true;
}

}  // namespace

NearestPoints nearest_points(const Vector3d& a, const Vector3d& b, const Corners& triangle) {
    NearestPoints best;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const NearestPoints& pair) {
        const double square = (pair.on_segment - pair.on_triangle).squaredNorm();
        if (square < least) {
            least = square;
            best = pair;
        }
    };
    for (std::size_t i = 0; i < 3; ++i) {
        consider(nearest_of_segments(a, b - a, triangle[i], triangle[(i + 1) % 3] - triangle[i]));
    }
    const Vector3d normal =
        (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
    if (normal.isZero()) return best;
    const double at_a = normal.dot(a - triangle[0]), at_b = normal.dot(b - triangle[0]);
    for (const auto& [point, height] : {std::pair{a, at_a}, std::pair{b, at_b}}) {
        const Vector3d foot = point - height * normal;
        if (above(triangle, normal, foot)) consider({point, foot});
    }
    if ((at_a < 0.0) != (at_b < 0.0)) {
        const Vector3d cut = a + (b - a) * (at_a / (at_a - at_b));
        if (above(triangle, normal, cut)) consider({cut, cut});
    }
    return best;
}

EdgeContacts::EdgeContacts(const Vector3d& core, double rounding_m, double cell_m)
    : core_(core), rounding_m_(rounding_m) {
    std::size_t at = 0;
    for (const Eigen::Index axis : {0, 1, 2}) {
        const auto cells =
            static_cast<std::size_t>(std::clamp(2.0 * core[axis] / cell_m, 1.0, 8.0));
        for (const double first : {-1.0, 1.0}) {
            for (const double second : {-1.0, 1.0}) {
                Vector3d middle = Vector3d::Zero();
                middle[(axis + 1) % 3] = first * core[(axis + 1) % 3];
                middle[(axis + 2) % 3] = second * core[(axis + 2) % 3];
                edges_[at++] = {axis, middle, std::vector<BoxContact>(cells)};
            }
        }
    }
}

void EdgeContacts::add(const Corners& triangle, const Vector3d& normal) {
    const Vector3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
    const Vector3d high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
    for (Edge& edge : edges_) {
        Vector3d reach = Vector3d::Constant(rounding_m_);
        reach[edge.axis] += core_[edge.axis];
        const bool near = ((low - edge.middle).array() < reach.array()).all() &&
                          ((high - edge.middle).array() > -reach.array()).all();
        if (near) meet(edge, triangle, normal);
    }
}

void EdgeContacts::meet(Edge& edge, const Corners& triangle, const Vector3d& normal) const {
    const Vector3d along = core_[edge.axis] * Vector3d::Unit(edge.axis);
    const auto pair = nearest_points(edge.middle - along, edge.middle + along, triangle);
    const Vector3d way = pair.on_triangle - pair.on_segment;
    const double distance = way.norm();
    if (!(distance < rounding_m_)) return;
    const Vector3d out = distance > 1e-9 ? Vector3d(way / distance) : Vector3d::Zero();
    if (normal.dot(out) > 0.0) return;
    const double share = 0.5 + 0.5 * pair.on_segment[edge.axis] / core_[edge.axis];
    const auto count = edge.cells.size();
    const auto cell = std::min(count - 1, static_cast<std::size_t>(share * double(count)));
    BoxContact& deepest = edge.cells[cell];
    if (rounding_m_ - distance > deepest.depth_m) {
        deepest = {pair.on_triangle, out, rounding_m_ - distance};
    }
}

/// A piece of an edge has a contact if the nearest point of the whole surface lies off the edge.
/// Where it lies before a face, or on the core, the faces have it; and a triangle beside that point
/// has an own nearest point, which must not count: hence the choice first, the question afterwards.
bool EdgeContacts::belongs(const Edge& edge, const Vector3d& out) {
    // A corner ends three edges; the first axis' edge speaks for it.
    if (std::abs(out[edge.axis]) >= kFaceLean && edge.axis != 0) return false;
    for (const Eigen::Index across : {(edge.axis + 1) % 3, (edge.axis + 2) % 3}) {
        if (out[across] * std::copysign(1.0, edge.middle[across]) < kFaceLean) return false;
    }
    return true;
}

void EdgeContacts::take(std::vector<BoxContact>& contacts) const {
    for (const Edge& edge : edges_) {
        for (const BoxContact& contact : edge.cells) {
            if (contact.depth_m > 0.0 && belongs(edge, contact.normal)) contacts.push_back(contact);
        }
    }
}

}  // namespace graspd::simulate_detail
