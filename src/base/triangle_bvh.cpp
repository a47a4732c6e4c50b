#include "graspd/base/triangle_bvh.hpp"

#include "graspd/base/heap_bytes.hpp"
#include "graspd/base/stop.hpp"
#include "triangle_bvh_ray.hpp"

// Building the tree; what it answers is in triangle_bvh_rays.cpp and triangle_bvh_box.cpp.

namespace graspd {
namespace {

// Single precision rounds by 6e-8; coordinates stay below 1, so three roundings fit in here.
constexpr float kRayPad = 5e-7F;

bool has_area(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    return edge1.cross(edge2).squaredNorm() > 0.0;
}

}  // namespace

TriangleBvh::TriangleBvh(const TriangleMesh& mesh, double tolerance_m)
    : tolerance_m_(tolerance_m), vertices_(mesh.vertices) {
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) bounds_.extend(mesh.vertices[vertex]);
    }
    if (bounds_.isEmpty()) return;
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(tolerance_m);
    bounds_ = Eigen::AlignedBox3d(bounds_.min() - pad, bounds_.max() + pad);
    diagonal_m_ = bounds_.diagonal().norm();
    units_per_m_ = 1.0 / diagonal_m_;
    middle_ = bounds_.center();
    const float pad_units = static_cast<float>(tolerance_m / diagonal_m_) + kRayPad;
    margin_ = static_cast<float>(tolerance_m / diagonal_m_) + kRounding;
    stop_point();
    std::vector<Eigen::Array4f> units(mesh.vertices.size(), Eigen::Array4f::Zero());
    for (std::size_t v = 0; v < units.size(); ++v) {
        units[v].head<3>() = ((mesh.vertices[v] - middle_) * units_per_m_).cast<float>();
    }
    std::vector<Box4f> boxes;
    boxes.reserve(mesh.faces.size());
    std::vector<std::uint32_t> solid;  // faces with an area
    solid.reserve(mesh.faces.size());
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        stop_point(face);
        const Triangle& t = mesh.faces[face];
        const Eigen::Vector3d& origin = mesh.vertices[t[0]];
        if (!has_area(mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin)) continue;
        const Eigen::Array4f &a = units[t[0]], &b = units[t[1]], &c = units[t[2]];
        boxes.push_back({a.min(b).min(c) - pad_units, a.max(b).max(c) + pad_units});
        solid.push_back(face);
    }
    tree_ = build_box_tree(boxes);
    number_.reserve(solid.size());
    faces_.reserve(solid.size());
    for (const std::uint32_t place : tree_.order) {
        stop_point(number_.size());
        number_.push_back(solid[place]);
        faces_.push_back(mesh.faces[solid[place]]);
    }
    packs_.reserve(tree_.nodes.size() * 3 + 1);
    if (BoxTree::is_leaf(tree_.root)) add_pack(tree_.root);
    std::size_t step = 0;
    for (BoxTree::Node& node : tree_.nodes) {
        stop_point(step++);
        for (std::uint32_t& child : node.child) {
            if (BoxTree::is_leaf(child)) add_pack(child);
        }
    }
}

/// Lays a leaf's triangles side by side and lets the leaf name the pack.
void TriangleBvh::add_pack(std::uint32_t& leaf) {
    Pack pack;
    pack.first = BoxTree::leaf_first(leaf);
    pack.count = BoxTree::leaf_count(leaf);
    if (pack.count == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        pack.origin[axis] = pack.edge1[axis] = pack.edge2[axis] = pack.normal[axis] =
            Eigen::Array4f::Zero();
    }
    pack.longest = Eigen::Array4f::Constant(-1.0F);
    for (std::uint32_t k = 0; k < pack.count; ++k) {
        const Triangle& t = faces_[pack.first + k];
        const Eigen::Vector3d& corner = vertices_[t[0]];
        const Eigen::Vector3d origin = (corner - middle_) * units_per_m_;
        const Eigen::Vector3d edge1 = (vertices_[t[1]] - corner) * units_per_m_;
        const Eigen::Vector3d edge2 = (vertices_[t[2]] - corner) * units_per_m_;
        const Eigen::Vector3d normal = edge2.cross(edge1);
        const auto lane = static_cast<Eigen::Index>(k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            pack.origin[axis][lane] = static_cast<float>(origin[a]);
            pack.edge1[axis][lane] = static_cast<float>(edge1[a]);
            pack.edge2[axis][lane] = static_cast<float>(edge2[a]);
            pack.normal[axis][lane] = static_cast<float>(normal[a]);
        }
        pack.longest[lane] = static_cast<float>(longest_edge(edge1, edge2));
    }
    leaf = BoxTree::kLeafBit | static_cast<std::uint32_t>(packs_.size()) << 3 | pack.count;
    packs_.push_back(pack);
}

std::uint64_t TriangleBvh::bytes() const {
    return sizeof *this + heap_bytes(tree_.nodes) + heap_bytes(tree_.order) +
           heap_bytes(vertices_) + heap_bytes(faces_) + heap_bytes(number_) + heap_bytes(packs_);
}

}  // namespace graspd
