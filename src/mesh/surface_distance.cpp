#include "graspd/mesh/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graspd {
namespace {

// Single precision of coordinates below 1, three roundings; taken off a box's distance.
constexpr float kFacePad = 1e-6F;

double squared_to_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& to) {
    const Eigen::Vector3d way = to - from;
    const double length = way.squaredNorm();
    const double share = length > 0.0 ? std::clamp((point - from).dot(way) / length, 0.0, 1.0) : 0;
    return (point - from - share * way).squaredNorm();
}

/// Whether the point's foot in the triangle's plane lies within all three edges.
bool stands_over(const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& corner,
                 const Eigen::Vector3d& normal) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d edge = corner[(k + 1) % 3] - corner[k];
        if (normal.dot(edge.cross(point - corner[k])) < 0.0) return false;
    }
    return true;
}

double squared_to_triangle(const Eigen::Vector3d& point,
                           const std::array<Eigen::Vector3d, 3>& corner) {
    const Eigen::Vector3d normal =
        (corner[1] - corner[0]).cross(corner[2] - corner[0]).stableNormalized();
    if (!normal.isZero(0.0) && stands_over(point, corner, normal)) {
        const double height = normal.dot(point - corner[0]);
        return height * height;
    }
    return std::min({squared_to_segment(point, corner[0], corner[1]),
                     squared_to_segment(point, corner[1], corner[2]),
                     squared_to_segment(point, corner[2], corner[0])});
}

/// A child that is still to be looked at.
struct WaitingFace {
    float squared;  ///< [units^2] from the point to its box, at least
    std::uint32_t child;
};

}  // namespace

double distance_to_triangle_m(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return std::sqrt(squared_to_triangle(point, {a, b, c}));
}

SurfaceDistance::SurfaceDistance(const TriangleMesh& mesh) : vertices_(mesh.vertices) {
    Eigen::AlignedBox3d bounds;
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) bounds.extend(mesh.vertices[vertex]);
    }
    if (bounds.isEmpty()) return;
    middle_ = bounds.center();
    const double diagonal_m = bounds.diagonal().norm();
    if (diagonal_m > 0.0) units_per_m_ = 1.0 / diagonal_m;
    std::vector<Box4f> boxes(mesh.faces.size());
    for (std::size_t f = 0; f < boxes.size(); ++f) {
        for (const std::uint32_t vertex : mesh.faces[f]) {
            Eigen::Array4f at = Eigen::Array4f::Zero();
            at.head<3>() = ((mesh.vertices[vertex] - middle_) * units_per_m_).cast<float>();
            boxes[f].extend({at - kFacePad, at + kFacePad});
        }
    }
    tree_ = build_box_tree(boxes);
    faces_.reserve(mesh.faces.size());
    for (const std::uint32_t face : tree_.order) faces_.push_back(mesh.faces[face]);
}

double SurfaceDistance::to(const Eigen::Vector3d& point, double at_most_m) const {
    // A point far off loses digits in single precision: its box distances shrink by as much.
    const Eigen::Vector3f place = ((point - middle_) * units_per_m_).cast<float>();
    const float pad = kFacePad * (1.0F + place.cwiseAbs().maxCoeff());
    double best = at_most_m * at_most_m;
    const auto limit = [&] {
        const float units = static_cast<float>(std::sqrt(best) * units_per_m_) * (1.0F + 1e-5F);
        return units * units + 1e-30F;
    };
    std::array<WaitingFace, BoxTree::kStackDepth> stack;
    std::size_t waiting = 0;
    if (!faces_.empty()) stack[waiting++] = {0.0F, tree_.root};
    float reach = limit();
    while (waiting > 0) {
        const WaitingFace next = stack[--waiting];
        if (next.squared > reach) continue;
        if (BoxTree::is_leaf(next.child)) {
            const std::uint32_t first = BoxTree::leaf_first(next.child);
            for (std::uint32_t i = first; i < first + BoxTree::leaf_count(next.child); ++i) {
                const Triangle& t = faces_[i];
                best = std::min(best, squared_to_triangle(point, {vertices_[t[0]], vertices_[t[1]],
                                                                  vertices_[t[2]]}));
            }
            reach = limit();
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[next.child];
        Eigen::Array4f squared = Eigen::Array4f::Zero();
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const auto& bound = node.bound[static_cast<std::size_t>(axis)];
            const Eigen::Array4f beyond =
                (bound[0] - place[axis]).max(place[axis] - bound[1]).max(pad) - pad;
            squared += beyond.square();
        }
        const std::size_t before = waiting;  // the nearest child is to come off first
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const float distance = squared[static_cast<Eigen::Index>(lane)];
            if (distance <= reach) stack[waiting++] = {distance, node.child[lane]};
        }
        std::sort(stack.begin() + static_cast<std::ptrdiff_t>(before),
                  stack.begin() + static_cast<std::ptrdiff_t>(waiting),
                  [](const WaitingFace& a, const WaitingFace& b) { return a.squared > b.squared; });
    }
    return std::sqrt(best);
}

}  // namespace graspd
