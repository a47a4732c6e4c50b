#include "graspd/simulate/box_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "edge_contact.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using simulate_detail::Corners;

constexpr std::size_t kMostCells = 24;    // of one face
constexpr double kLeastPressure = 1e-18;  // [m^3] a micrometre of depth on a square micrometre

/// A convex polygon with at most as many corners as a triangle that seven planes have cut.
struct Polygon {
    std::array<Vector3d, 10> corner;
    std::size_t count = 0;

    void add(const Vector3d& point) { corner[count++] = point; }
};

/// The part where sign * p[axis] <= limit.
Polygon clipped(const Polygon& polygon, Eigen::Index axis, double sign, double limit) {
    Polygon part;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vector3d& from = polygon.corner[i];
        const Vector3d& to = polygon.corner[(i + 1) % polygon.count];
        const double a = sign * from[axis] - limit, b = sign * to[axis] - limit;
        if (a <= 0.0) part.add(from);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) {
            part.add(from + (to - from) * (a / (a - b)));
        }
    }
    return part;
}

Polygon clipped(Polygon polygon, Eigen::Index axis, const std::array<double, 2>& range) {
    polygon = clipped(polygon, axis, -1.0, -range[0]);
    return polygon.count > 2 ? clipped(polygon, axis, 1.0, range[1]) : Polygon{};
}

/// Depth integrated over an area.
struct Pressure {
    double sum = 0.0;                    ///< [m^3] of depth
    double square = 0.0;                 ///< [m^4] of its square
    Vector3d moment = Vector3d::Zero();  ///< [m^4] of depth times place

    /// Adds a triangle of `area` whose corners have these depths, all linear in between.
    void add(const Corners& at, const std::array<double, 3>& depth, double area) {
        const double total = depth[0] + depth[1] + depth[2];
        sum += area / 3.0 * total;
        for (std::size_t i = 0; i < 3; ++i) {
            square += area / 12.0 * depth[i] * (total + depth[i]);
            moment += area / 12.0 * (total + depth[i]) * at[i];
        }
    }
};

/// One face of the box: the prism that stands on it, divided into cells.
class Face {
public:
    Face(Eigen::Index axis, double sign, const Vector3d& core, const BoxContactConfig& config)
        : axis_(axis), sign_(sign), core_(core), rounding_m_(config.rounding_m) {
        const Vector3d size = 2.0 * core;
        const double area = size[u()] * size[v()];
        const double cell = std::max(config.cell_m, std::sqrt(area / double(kMostCells)));
        for (const std::size_t k : {0u, 1u}) {
            const double length = size[k == 0 ? u() : v()];
            cells_[k] = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(length / cell));
            step_[k] = length / static_cast<double>(cells_[k]);
        }
        pressure_.resize(static_cast<std::size_t>(cells_[0] * cells_[1]));
    }

    /// @param normal  of the triangle, any length
    void add(const Corners& triangle, const Vector3d& normal) {
        if (normal[axis_] * sign_ >= 0.0) return;  // it turns its back on this face
        Polygon polygon;
        for (const Vector3d& corner : triangle) polygon.add(corner);
        const double middle = core_[axis_];
        polygon = clipped(polygon, axis_, -sign_, rounding_m_ - middle);
        if (polygon.count > 2) polygon = clipped(polygon, axis_, sign_, middle + rounding_m_);
        if (polygon.count > 2) polygon = clipped(polygon, u(), {-core_[u()], core_[u()]});
        if (polygon.count > 2) polygon = clipped(polygon, v(), {-core_[v()], core_[v()]});
        if (polygon.count > 2) share_out(polygon);
    }

    void take(std::vector<BoxContact>& contacts) const {
        for (const Pressure& cell : pressure_) {
            if (cell.sum < kLeastPressure) continue;
            contacts.push_back(
                {cell.moment / cell.sum, sign_ * Vector3d::Unit(axis_), cell.square / cell.sum});
        }
    }

private:
    Eigen::Index u() const { return (axis_ + 1) % 3; }
    Eigen::Index v() const { return (axis_ + 2) % 3; }
    Eigen::Index cell_of(double place, std::size_t k) const {
        const double half = core_[k == 0 ? u() : v()];
        const auto cell = static_cast<Eigen::Index>((place + half) / step_[k]);
        return std::clamp<Eigen::Index>(cell, 0, cells_[k] - 1);
    }
    std::array<double, 2> range(Eigen::Index cell, std::size_t k) const {
        const double low = -core_[k == 0 ? u() : v()], begin = static_cast<double>(cell);
        return {low + begin * step_[k], low + (begin + 1.0) * step_[k]};
    }

    void share_out(const Polygon& polygon) {
        Vector3d low = polygon.corner[0], high = low;
        for (std::size_t i = 1; i < polygon.count; ++i) {
            low = low.cwiseMin(polygon.corner[i]);
            high = high.cwiseMax(polygon.corner[i]);
        }
        const Eigen::Index first[] = {cell_of(low[u()], 0), cell_of(low[v()], 1)};
        const Eigen::Index last[] = {cell_of(high[u()], 0), cell_of(high[v()], 1)};
        for (Eigen::Index i = first[0]; i <= last[0]; ++i) {
            const Polygon row = first[0] == last[0] ? polygon : clipped(polygon, u(), range(i, 0));
            for (Eigen::Index j = first[1]; j <= last[1] && row.count > 2; ++j) {
                const Polygon cell = first[1] == last[1] ? row : clipped(row, v(), range(j, 1));
                if (cell.count > 2)
                    press(pressure_[static_cast<std::size_t>(i * cells_[1] + j)], cell);
            }
        }
    }

    void press(Pressure& cell, const Polygon& polygon) const {
        const auto depth = [&](const Vector3d& p) {
            return std::max(0.0, core_[axis_] + rounding_m_ - sign_ * p[axis_]);
        };
        const Vector3d& a = polygon.corner[0];
        for (std::size_t i = 1; i + 1 < polygon.count; ++i) {
            const Vector3d &b = polygon.corner[i], &c = polygon.corner[i + 1];
            const double area = 0.5 * std::abs((b - a).cross(c - a)[axis_]);
            cell.add({a, b, c}, {depth(a), depth(b), depth(c)}, area);
        }
    }

    Eigen::Index axis_;
    double sign_;
    Vector3d core_;
    double rounding_m_;
    std::array<Eigen::Index, 2> cells_{};
    std::array<double, 2> step_{};
    std::vector<Pressure> pressure_;
};

}  // namespace

std::vector<BoxContact> box_contacts(const TriangleMesh& mesh, const TriangleBvh& bvh,
                                     const OrientedBox& box, const BoxContactConfig& config) {
    BoxContactConfig used = config;
    used.rounding_m = std::min(config.rounding_m, 0.5 * box.half_extent.minCoeff());
    const Vector3d core = box.half_extent.array() - used.rounding_m;
    const Vector3d reach = box.half_extent;
    std::vector<Face> faces;
    for (const Eigen::Index axis : {0, 1, 2}) {
        for (const double sign : {-1.0, 1.0}) faces.emplace_back(axis, sign, core, used);
    }
    simulate_detail::EdgeContacts edges(core, used.rounding_m, used.cell_m);
    const Eigen::Isometry3d to_box = box.pose.inverse(Eigen::Isometry);
    for (const std::uint32_t number : bvh.faces_near({box.pose, core}, used.rounding_m)) {
        const Triangle& t = mesh.faces[number];
        const Corners triangle{to_box * mesh.vertices[t[0]], to_box * mesh.vertices[t[1]],
                               to_box * mesh.vertices[t[2]]};
        const Vector3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
        const Vector3d high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
        if ((low.array() > reach.array()).any() || (high.array() < -reach.array()).any()) continue;
        const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        for (Face& face : faces) face.add(triangle, normal);
        edges.add(triangle, normal);
    }
    std::vector<BoxContact> contacts;
    for (const Face& face : faces) face.take(contacts);
    edges.take(contacts);
    if (contacts.size() > used.most) {
        std::ranges::stable_sort(contacts, std::greater{}, &BoxContact::depth_m);
        contacts.resize(used.most);
    }
    for (BoxContact& contact : contacts) {
        contact.point = box.pose * contact.point;
        contact.normal = box.pose.linear() * contact.normal;
    }
    return contacts;
}

}  // namespace graspd
