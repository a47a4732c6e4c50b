#include "graspd/base/triangle_bvh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

// Single precision rounds by 6e-8; coordinates stay below 1, so three roundings fit in here.
constexpr float kPad = 5e-7F;
constexpr float kSlack = 1.0F + 1e-6F;
constexpr float kNever = std::numeric_limits<float>::infinity();

/// Twice the area over the longest edge; zero for a degenerate triangle.
double least_height(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    const double longest = std::sqrt(
        std::max({edge1.squaredNorm(), edge2.squaredNorm(), (edge2 - edge1).squaredNorm()}));
    return longest > 0.0 ? edge1.cross(edge2).norm() / longest : 0.0;
}

/// Squared distance from a point to a segment that starts at the origin.
double squared_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& segment) {
    const double share = std::clamp(point.dot(segment) / segment.squaredNorm(), 0.0, 1.0);
    return (point - share * segment).squaredNorm();
}

}  // namespace

/// A ray in double precision for the triangles and in the boxes' own units for them.
struct TriangleBvh::Ray {
    Eigen::Vector3d origin, direction;
    std::array<float, 3> start{}, inverse{};
    std::array<std::size_t, 3> near_side{};  ///< of a box along each axis: 0 low, 1 high
    double skipped = 0.0;  ///< the boxes' ray starts so far along, where it enters the bounds
    bool meets_bounds = false;

    Ray(const Eigen::Vector3d& from, const Eigen::Vector3d& along, const TriangleBvh& bvh)
        : origin(from), direction(along) {
        if (bvh.corners_.empty()) return;
        // Directions as good as zero count as a huge finite inverse: infinity times 0 is no number.
        constexpr double kLeast = 1e-30;
        double enter = 0.0, leave = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double slope = along[axis] / bvh.diagonal_m_;
            const double inverted = std::abs(slope) > kLeast ? 1.0 / slope : 1.0 / kLeast;
            const double low = (bvh.bounds_.min()[axis] - from[axis]) / bvh.diagonal_m_ * inverted;
            const double high = (bvh.bounds_.max()[axis] - from[axis]) / bvh.diagonal_m_ * inverted;
            enter = std::max(enter, std::min(low, high));
            leave = std::min(leave, std::max(low, high));
            const auto a = static_cast<std::size_t>(axis);
            inverse[a] = static_cast<float>(inverted);
            near_side[a] = inverted < 0.0;
        }
        meets_bounds = enter <= leave * (1.0 + 1e-12);
        if (!meets_bounds) return;
        skipped = enter;
        const Eigen::Vector3d entry =
            (from + enter * along - bvh.bounds_.center()) / bvh.diagonal_m_;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start[axis] = static_cast<float>(entry[static_cast<Eigen::Index>(axis)]);
        }
    }

    /// Where the ray enters the children's boxes; infinity where it does not within `reach`.
    Eigen::Array4f enters(const BoxTree::Node& node, float reach) const {
        Eigen::Array4f enter = Eigen::Array4f::Zero();
        Eigen::Array4f leave = Eigen::Array4f::Constant(reach);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& bound = node.bound[axis];
            enter = enter.max((bound[near_side[axis]] - start[axis]) * inverse[axis]);
            leave = leave.min((bound[1 - near_side[axis]] - start[axis]) * inverse[axis]);
        }
        return (enter <= leave * kSlack).select(enter, kNever);
    }

    /// Moller-Trumbore; a hit beside the triangle counts within `tolerance_m` of its edges.
    bool meets(const Corner& c, double tolerance_m, double reach, Hit& hit) const {
        const Eigen::Vector3d p = direction.cross(c.edge2);
        const double determinant = c.edge1.dot(p);
        if (determinant == 0.0) return false;
        const double scale = 1.0 / determinant;
        const Eigen::Vector3d s = origin - c.origin;
        const double u = s.dot(p) * scale;
        if (!(u >= -c.tolerance && u <= 1.0 + c.tolerance)) return false;
        const Eigen::Vector3d q = s.cross(c.edge1);
        const double v = direction.dot(q) * scale;
        if (!(v >= -c.tolerance && u + v <= 1.0 + c.tolerance)) return false;
        const double t = c.edge2.dot(q) * scale;
        if (!(t >= 0.0 && t <= reach)) return false;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) {
            // A needle's barycentric tolerance alone would reach far beyond its ends.
            const Eigen::Vector3d place = u * c.edge1 + v * c.edge2;
            const double nearest =
                std::min({squared_distance(place, c.edge1), squared_distance(place, c.edge2),
                          squared_distance(place - c.edge1, c.edge2 - c.edge1)});
            if (nearest > tolerance_m * tolerance_m) return false;
        }
        hit = {t, c.face, determinant > 0.0};
        return true;
    }
};

TriangleBvh::TriangleBvh(const TriangleMesh& mesh, double tolerance_m) : tolerance_m_(tolerance_m) {
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) bounds_.extend(mesh.vertices[vertex]);
    }
    if (bounds_.isEmpty()) return;
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(tolerance_m);
    bounds_ = Eigen::AlignedBox3d(bounds_.min() - pad, bounds_.max() + pad);
    diagonal_m_ = bounds_.diagonal().norm();
    const Eigen::Vector3d middle = bounds_.center();
    const float pad_units = static_cast<float>(tolerance_m / diagonal_m_) + kPad;
    std::vector<Box4f> boxes;
    std::vector<Corner> corners;
    boxes.reserve(mesh.faces.size());
    corners.reserve(mesh.faces.size());
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        const Triangle& t = mesh.faces[face];
        const Eigen::Vector3d& origin = mesh.vertices[t[0]];
        const Eigen::Vector3d edge1 = mesh.vertices[t[1]] - origin;
        const Eigen::Vector3d edge2 = mesh.vertices[t[2]] - origin;
        const double height = least_height(edge1, edge2);
        if (!(height > 0.0)) continue;
        Box4f box;
        for (const std::uint32_t vertex : t) {
            Eigen::Array4f unit = Eigen::Array4f::Zero();
            unit.head<3>() = ((mesh.vertices[vertex] - middle) / diagonal_m_).cast<float>();
            box.extend({unit - pad_units, unit + pad_units});
        }
        boxes.push_back(box);
        corners.push_back({origin, edge1, edge2, tolerance_m / height, face});
    }
    tree_ = build_box_tree(boxes);
    corners_.reserve(corners.size());
    for (const std::uint32_t place : tree_.order) corners_.push_back(corners[place]);
}

template <class Visit>
void TriangleBvh::traverse(const Ray& ray, double& reach, Visit&& visit) const {
    if (!ray.meets_bounds) return;
    struct Waiting {
        std::uint32_t child;
        float enter;
    };
    std::array<Waiting, BoxTree::kStackDepth> stack;
    std::size_t top = 0;
    stack[top++] = {tree_.root, 0.0F};
    while (top > 0) {
        const Waiting item = stack[--top];
        const float left = static_cast<float>(reach - ray.skipped) * kSlack;
        if (item.enter > left) continue;
        if (BoxTree::is_leaf(item.child)) {
            const std::uint32_t first = BoxTree::leaf_first(item.child);
            for (std::uint32_t i = first; i < first + BoxTree::leaf_count(item.child); ++i) {
                Hit hit;
                if (ray.meets(corners_[i], tolerance_m_, reach, hit) && visit(hit)) return;
            }
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        const Eigen::Array4f enter = ray.enters(node, left);
        assert(top + 4 <= stack.size());
        const std::size_t bottom = top;
        for (std::size_t k = 0; k < 4; ++k) {
            const float here = enter[static_cast<Eigen::Index>(k)];
            if (here == kNever) continue;
            // The nearest child comes last onto the stack, so it is the next one.
            std::size_t place = top++;
            for (; place > bottom && stack[place - 1].enter < here; --place) {
                stack[place] = stack[place - 1];
            }
            stack[place] = {node.child[k], here};
        }
    }
}

bool TriangleBvh::segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    bool blocked = false;
    double reach = 1.0;  // the direction is not normalised, so the segment ends at t = 1
    traverse(Ray(a, b - a, *this), reach, [&](const Hit&) { return blocked = true; });
    return blocked;
}

std::optional<TriangleBvh::Hit> TriangleBvh::first_hit(const Eigen::Vector3d& origin,
                                                       const Eigen::Vector3d& direction,
                                                       double max_distance_m) const {
    std::optional<Hit> nearest;
    double reach = max_distance_m;
    traverse(Ray(origin, direction, *this), reach, [&](const Hit& hit) {
        const bool nearer = !nearest || hit.distance_m < nearest->distance_m ||
                            (hit.distance_m == nearest->distance_m && hit.face < nearest->face);
        if (nearer) {
            nearest = hit;
            reach = hit.distance_m;
        }
        return false;
    });
    return nearest;
}

std::vector<TriangleBvh::Hit> TriangleBvh::all_hits(const Eigen::Vector3d& origin,
                                                    const Eigen::Vector3d& direction,
                                                    double max_distance_m) const {
    std::vector<Hit> hits;
    double reach = max_distance_m;
    traverse(Ray(origin, direction, *this), reach, [&](const Hit& hit) {
        hits.push_back(hit);
        return false;
    });
    std::ranges::sort(hits, [](const Hit& a, const Hit& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.face < b.face;
    });
    const auto same = [&](const Hit& a, const Hit& b) {
        return a.from_outside == b.from_outside &&
               b.distance_m - a.distance_m <= 2.0 * tolerance_m_;
    };
    hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
    return hits;
}

/// A box of any direction in the tree's own units, grown by the distance that counts as near.
struct TriangleBvh::Vicinity {
    Eigen::Matrix3f axes, spread;
    Eigen::Vector3f center, half, reach;  ///< half along its own axes, reach along the world's

    Vicinity(const OrientedBox& box, double within_m, const TriangleBvh& bvh) {
        // Rounding in single precision must not lose a face that touches.
        const double pad = within_m / bvh.diagonal_m_ + 4.0 * static_cast<double>(kPad);
        axes = box.pose.linear().cast<float>();
        spread = axes.cwiseAbs();
        center = ((box.pose.translation() - bvh.bounds_.center()) / bvh.diagonal_m_).cast<float>();
        half = ((box.half_extent / bvh.diagonal_m_).array() + pad).matrix().cast<float>();
        reach = (box.pose.linear().cwiseAbs() * (box.half_extent / bvh.diagonal_m_)).cast<float>();
        reach.array() += static_cast<float>(pad);
    }

    /// Per child: how far the boxes lie apart along the axis on which they do so most; an absent
    /// child gives no number.
    Eigen::Array4f gaps(const BoxTree::Node& node) const {
        std::array<Eigen::Array4f, 3> offset, size;
        Eigen::Array4f gap = Eigen::Array4f::Constant(-kNever);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            offset[axis] = 0.5F * (node.bound[axis][0] + node.bound[axis][1]) - center[a];
            size[axis] = 0.5F * (node.bound[axis][1] - node.bound[axis][0]);
            gap = gap.max(offset[axis].abs() - size[axis] - reach[a]);
        }
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Eigen::Array4f along =
                offset[0] * axes(0, k) + offset[1] * axes(1, k) + offset[2] * axes(2, k);
            const Eigen::Array4f wide =
                size[0] * spread(0, k) + size[1] * spread(1, k) + size[2] * spread(2, k);
            gap = gap.max(along.abs() - wide - half[k]);
        }
        return gap;
    }
};

std::vector<std::uint32_t> TriangleBvh::faces_near(const OrientedBox& box, double within_m) const {
    std::vector<std::uint32_t> faces;
    if (corners_.empty()) return faces;
    const Vicinity vicinity(box, within_m, *this);
    std::array<std::uint32_t, BoxTree::kStackDepth> stack;
    std::size_t top = 0;
    stack[top++] = tree_.root;
    while (top > 0) {
        const std::uint32_t child = stack[--top];
        if (BoxTree::is_leaf(child)) {
            const std::uint32_t first = BoxTree::leaf_first(child);
            for (std::uint32_t i = first; i < first + BoxTree::leaf_count(child); ++i) {
                faces.push_back(corners_[i].face);
            }
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[child];
        const Eigen::Array4f gap = vicinity.gaps(node);
        assert(top + 4 <= stack.size());
        for (std::size_t k = 0; k < 4; ++k) {
            const auto lane = static_cast<Eigen::Index>(k);
            const bool is_there = node.bound[0][0][lane] <= node.bound[0][1][lane];
            if (is_there && gap[lane] <= 0.0F) stack[top++] = node.child[k];
        }
    }
    std::ranges::sort(faces);
    return faces;
}

bool TriangleBvh::contains(const Eigen::Vector3d& point) const {
    if (!bounds_.contains(point)) return false;
    // Directions without zeros or equal components, so that they are parallel to no edge of a
    // boxy object.
    static const std::array<Eigen::Vector3d, 3> kDirections = {
        Eigen::Vector3d(0.6131, 0.7223, 0.3201).normalized(),
        Eigen::Vector3d(-0.5417, 0.2939, 0.7875).normalized(),
        Eigen::Vector3d(0.2113, -0.8341, -0.5095).normalized()};
    int inside = 0;
    for (const Eigen::Vector3d& direction : kDirections) {
        const auto hit = first_hit(point, direction, diagonal_m_);
        inside += hit && !hit->from_outside;
    }
    return inside >= 2;
}

}  // namespace graspd
