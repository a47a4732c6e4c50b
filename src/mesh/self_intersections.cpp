#include "graspd/mesh/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

namespace graspd {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

/// Ends the walk over the boxes.
struct TooMany {};

Point to_point(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

/// The corners of two faces, common ones first.
struct FacePair {
    std::array<Point, 3> a, b;
    int common = 0;

    FacePair(const TriangleMesh& mesh, Triangle first, Triangle second) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(common);
            const auto same = std::find(second.begin() + common, second.end(), first[i]);
            if (same == second.end()) continue;
            std::swap(first[k], first[i]);
            std::swap(second[k], *same);
            ++common;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            a[i] = to_point(mesh.vertices[first[i]]);
            b[i] = to_point(mesh.vertices[second[i]]);
        }
    }
};

bool cross(const FacePair& pair) {
    const Kernel::Triangle_3 a(pair.a[0], pair.a[1], pair.a[2]);
    const Kernel::Triangle_3 b(pair.b[0], pair.b[1], pair.b[2]);
    switch (pair.common) {
        case 0: return CGAL::do_intersect(a, b);
        case 1:  // beyond the common corner the side opposite to it must cross the other face
            return CGAL::do_intersect(Kernel::Segment_3(pair.a[1], pair.a[2]), b) ||
                   CGAL::do_intersect(Kernel::Segment_3(pair.b[1], pair.b[2]), a);
        case 2:  // only when folded flat onto each other
            return CGAL::coplanar(pair.a[0], pair.a[1], pair.a[2], pair.b[2]) &&
                   CGAL::coplanar_orientation(pair.a[0], pair.a[1], pair.a[2], pair.b[2]) ==
                       CGAL::POSITIVE;
        default: return true;
    }
}

std::vector<Box> boxes_of(const TriangleMesh& mesh) {
    std::vector<Box> boxes;
    boxes.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& t = mesh.faces[f];
        const Point a = to_point(mesh.vertices[t[0]]), b = to_point(mesh.vertices[t[1]]),
                    c = to_point(mesh.vertices[t[2]]);
        if (!CGAL::collinear(a, b, c)) boxes.emplace_back(a.bbox() + b.bbox() + c.bbox(), f);
    }
    return boxes;
}

}  // namespace

std::optional<SelfIntersections> count_self_intersections(const TriangleMesh& mesh,
                                                          std::uint64_t most_tests) {
    std::vector<Box> boxes = boxes_of(mesh);
    std::vector<char> hit(mesh.faces.size(), 0);
    SelfIntersections found;
    std::uint64_t tests = 0;
    const auto look = [&](const Box& first, const Box& second) {
        if (++tests > most_tests) throw TooMany{};
        const std::uint32_t a = first.info(), b = second.info();
        if (!cross(FacePair(mesh, mesh.faces[a], mesh.faces[b]))) return;
        ++found.pairs;
        hit[a] = hit[b] = 1;
    };
    try {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), look);
    } catch (const TooMany&) {
        return std::nullopt;
    }
    found.faces = static_cast<std::uint64_t>(std::ranges::count(hit, 1));
    return found;
}

}  // namespace graspd
