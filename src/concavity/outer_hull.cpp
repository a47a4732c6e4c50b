#include "graspd/concavity/outer_hull.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace graspd {
namespace {

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

/// @param middle  what was subtracted from the points
HullFacet read_facet(const facetT& facet, const Eigen::Vector3d& middle) {
    HullFacet out;
    out.normal = Eigen::Map<const Eigen::Vector3d>(facet.normal);
    out.offset_m = out.normal.dot(middle) - facet.offset;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet.vertices) {
        out.box.extend(Eigen::Map<const Eigen::Vector3d>(vertex->point) + middle);
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
    // qhull's tolerances grow with the coordinates, so they are centred first.
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) box.extend(point);
    const Eigen::Vector3d middle = box.center();
    for (const Eigen::Vector3d& point : points) {
        const Eigen::Vector3d p = point - middle;
        coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
    }

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
        hull.facets.push_back(read_facet(*facet, middle));
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

}  // namespace graspd
