#include "graspd/concavity/outer_hull.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace graspd {
namespace {

constexpr std::uint32_t kLeafSize = 4;

/// qhull's state with its error stream, freed on every way out.
struct QhullSession {
    qhT state{};
    char* text = nullptr;
    std::size_t text_size = 0;
    FILE* errors = open_memstream(&text, &text_size);

    QhullSession() { qh_zero(&state, errors); }
    QhullSession(const QhullSession&) = delete;
    QhullSession& operator=(const QhullSession&) = delete;
    ~QhullSession() {
        qh_freeqhull(&state, !qh_ALL);
        int remaining = 0, total = 0;
        qh_memfreeshort(&state, &remaining, &total);
        if (errors != nullptr) std::fclose(errors);
        std::free(text);
    }
    std::string first_error_line() {
        std::fflush(errors);
        const std::string all(text, text_size);
        return all.substr(0, all.find('\n'));
    }
};

HullFacet read_facet(const facetT& facet) {
    HullFacet out;
    out.normal = Eigen::Map<const Eigen::Vector3d>(facet.normal);
    out.offset_m = -facet.offset;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet.vertices) {
        out.box.extend(Eigen::Map<const Eigen::Vector3d>(vertex->point));
    }
    return out;
}

}  // namespace

Result<OuterHull> outer_hull(std::span<const Eigen::Vector3d> points) {
    if (points.size() < 4) {
        return PlanError{PlanErrorCode::kDegenerate,
                         "a hull needs 4 points, got " + std::to_string(points.size())};
    }
    std::vector<coordT> coordinates;
    coordinates.reserve(3 * points.size());
    for (const Eigen::Vector3d& p : points)
        coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});

    QhullSession session;
    if (session.errors == nullptr) {
        return PlanError{PlanErrorCode::kInternal, "no memory for qhull's error stream"};
    }
    qhT* qh = &session.state;
    std::string command = "qhull Pp";  // Pp: no precision warnings; facets merged by default
    const int failed = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(),
                                    False, command.data(), nullptr, session.errors);
    if (failed != 0) {
        return PlanError{PlanErrorCode::kDegenerate, "no convex hull of " +
                                                         std::to_string(points.size()) +
                                                         " points: " + session.first_error_line()};
    }
    OuterHull hull;
    facetT* facet = nullptr;
    FORALLfacets {
        hull.facets.push_back(read_facet(*facet));
    }
    vertexT* vertex = nullptr;
    FORALLvertices {
        hull.vertices.push_back(static_cast<std::uint32_t>(qh_pointid(qh, vertex->point)));
    }
    std::ranges::sort(hull.vertices);
    qh_getarea(qh, qh->facet_list);
    hull.volume_m3 = qh->totvol;
    return hull;
}

HullPlaneTree::HullPlaneTree(const OuterHull& hull) : facets_(hull.facets), order_(facets_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(2 * facets_.size());
    build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t HullPlaneTree::build(std::uint32_t first, std::uint32_t last) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Eigen::AlignedBox3d box, centers;
    for (std::uint32_t i = first; i < last; ++i) {
        box.extend(facets_[order_[i]].box);
        centers.extend(facets_[order_[i]].box.center());
    }
    nodes_[index].box = box;
    if (last - first <= kLeafSize) {
        nodes_[index].first = first;
        nodes_[index].count = last - first;
        return index;
    }
    int axis = 0;
    centers.sizes().maxCoeff(&axis);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double ca = facets_[a].box.center()[axis];
                         const double cb = facets_[b].box.center()[axis];
                         return ca != cb ? ca < cb : a < b;
                     });
    build(first, middle);
    const std::uint32_t right = build(middle, last);
    nodes_[index].first = right;
    return index;
}

HullPlaneTree::Nearest HullPlaneTree::nearest(const Eigen::Vector3d& point) const {
    Nearest best{std::numeric_limits<double>::infinity(), 0};
    std::array<std::uint32_t, 96> stack;  // the tree is balanced: depth <= 32
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const std::uint32_t index = stack[--top];
        const Node& node = nodes_[index];
        // The nearest plane's foot lies on its facet, hence in the facet's box.
        if (node.box.squaredExteriorDistance(point) > best.distance_m * best.distance_m) continue;
        if (node.count == 0) {
            const std::uint32_t left = index + 1, right = node.first;
            const bool left_first = nodes_[left].box.squaredExteriorDistance(point) <=
                                    nodes_[right].box.squaredExteriorDistance(point);
            stack[top++] = left_first ? right : left;
            stack[top++] = left_first ? left : right;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const std::uint32_t facet = order_[i];
            const double distance =
                std::max(0.0, facets_[facet].offset_m - facets_[facet].normal.dot(point));
            if (distance < best.distance_m || (distance == best.distance_m && facet < best.facet)) {
                best = {distance, facet};
            }
        }
    }
    return best;
}

}  // namespace graspd
