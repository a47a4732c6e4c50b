#include "graspd/concavity/shortest_path_concavity.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "graspd/base/parallel.hpp"
#include "graspd/base/stop.hpp"
#include "path_ground.hpp"
#include "path_search.hpp"

namespace graspd {
namespace {

using concavity_detail::PathGround;
using concavity_detail::PathSearch;

constexpr const char* kStage = "concavity/shortest_path_concavity";

/// Runs steps and notes how long they took.
class StepTimer {
public:
    explicit StepTimer(std::vector<StepTime>& times) : times_(times) {}

    template <class Work>
    void run(const char* step, Work&& work) {
        const double ms = time_of(kStage, work);
        times_.push_back({step, ms});
    }
    template <class Work>
    static double time_of(const char* stage, Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        as_stage(stage, work);
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count();
    }

private:
    std::vector<StepTime>& times_;
};

ConcavityField search_ways(const PathGround& ground, const HullPlaneTree& planes,
                           const TriangleBvh& bvh, const ConcavityConfig& config,
                           StepTimer& timer) {
    PathSearch search(ground, planes, bvh, config);
    timer.run("direct", [&] { search.prove_direct(); });
    timer.run("propagate", [&] { search.propagate_inwards(); });
    timer.run("reach", [&] { search.reach_what_no_edge_reaches(); });
    if (config.across_the_void) timer.run("shorten", [&] { search.shorten_across_the_void(); });
    if (config.slide) timer.run("slide", [&] { search.slide_bends(); });
    return search.take();
}

PlanError no_faces(std::size_t faces, std::size_t facets) {
    return PlanError{PlanErrorCode::kInvalidInput,
                     "concavity needs a mesh with faces and its hull, got " +
                         std::to_string(faces) + " faces and " + std::to_string(facets) +
                         " hull facets"};
}

/// The points of a way: `at_vertex` and `at_bend` choose which of their places.
template <class AtVertex, class AtBend>
std::vector<Eigen::Vector3d> points_of_way(const ConcavityField& field, std::uint32_t vertex,
                                           AtVertex&& at_vertex, AtBend&& at_bend,
                                           std::int32_t& end) {
    std::vector<Eigen::Vector3d> path;
    end = ConcavityField::kNoParent;
    if (!std::isfinite(field.value_m[vertex])) return path;
    if (field.parent[vertex] == ConcavityField::kNoParent) return path;  // a value without a way
    const auto vertices = static_cast<std::int32_t>(field.value_m.size());
    const std::size_t most = field.value_m.size() + field.edge_bends.size();
    std::int32_t at = static_cast<std::int32_t>(vertex);
    while (at >= 0 && path.size() <= most) {
        if (at < vertices) {
            path.push_back(at_vertex(static_cast<std::size_t>(at)));
            at = field.parent[static_cast<std::size_t>(at)];
        } else {
            const EdgeBend& bend = field.edge_bends[static_cast<std::size_t>(at - vertices)];
            path.push_back(at_bend(bend));
            at = bend.parent;
        }
    }
    end = at;
    return path;
}

}  // namespace

const char* to_string(ConcavityFlag flag) {
    switch (flag) {
        case ConcavityFlag::kExact: return "exact";
        case ConcavityFlag::kPath: return "path";
        case ConcavityFlag::kEnclosed: return "enclosed";
        case ConcavityFlag::kUnreferenced: return "unreferenced";
    }
    return "unknown";
}

double mesh_diagonal_m(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.faces) {
        for (const std::uint32_t v : t) box.extend(mesh.vertices[v]);
    }
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

double ray_tolerance_m(const TriangleMesh& mesh, const ConcavityConfig& config) {
    return mesh_diagonal_m(mesh) * config.start_offset / kOffsetOverRayTolerance;
}

Result<ConcavityField> shortest_path_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                               const TriangleBvh& bvh,
                                               const ConcavityConfig& config) {
    if (mesh.faces.empty() || hull.facets.empty()) {
        return no_faces(mesh.faces.size(), hull.facets.size());
    }
    std::vector<StepTime> times;
    StepTimer timer(times);
    return search_ways(PathGround(mesh, config), HullPlaneTree(hull), bvh, config, timer);
}

Result<MeasuredConcavity> measure_concavity(const TriangleMesh& mesh,
                                            const ConcavityConfig& config) {
    if (mesh.faces.empty()) return no_faces(0, 0);
    MeasuredConcavity measured;
    std::optional<Result<OuterHull>> hull;
    std::optional<HullPlaneTree> planes;
    std::optional<PathGround> ground;
    double hull_ms = 0.0, planes_ms = 0.0, tree_ms = 0.0, ground_ms = 0.0;
    const auto outside = [&] {
        hull_ms = StepTimer::time_of("concavity/outer_hull",
                                     [&] { hull.emplace(outer_hull(mesh.vertices)); });
        if (!hull->ok()) return;
        planes_ms = StepTimer::time_of(kStage, [&] { planes.emplace(hull->value()); });
    };
    const auto rays = [&] {
        tree_ms = StepTimer::time_of("base/triangle_bvh", [&] {
            measured.tree =
                std::make_shared<const TriangleBvh>(mesh, ray_tolerance_m(mesh, config));
        });
    };
    const auto surface = [&] {
        ground_ms = StepTimer::time_of(kStage, [&] { ground.emplace(mesh, config); });
    };
    run_together({outside, rays, surface});
    if (!hull->ok()) return hull->error();
    measured.times = {
        {"hull", hull_ms}, {"planes", planes_ms}, {"tree", tree_ms}, {"ground", ground_ms}};
    measured.hull = std::move(*hull).value();
    StepTimer timer(measured.times);
    measured.field = search_ways(*ground, *planes, *measured.tree, config, timer);
    return measured;
}

std::vector<Eigen::Vector3d> escape_path(const TriangleMesh& mesh, const OuterHull& hull,
                                         const ConcavityField& field, std::uint32_t vertex) {
    std::int32_t end = 0;
    auto path = points_of_way(
        field, vertex, [&](std::size_t v) { return mesh.vertices[v]; },
        [](const EdgeBend& bend) { return bend.point; }, end);
    if (end != ConcavityField::kNoParent) {
        const HullFacet& facet = hull.facets[static_cast<std::size_t>(-1 - end)];
        const double gap = facet.offset_m - facet.normal.dot(path.back());
        path.push_back(path.back() + gap * facet.normal);
    }
    return path;
}

std::vector<Eigen::Vector3d> tested_path(const TriangleMesh& mesh, const OuterHull& hull,
                                         const ConcavityField& field, std::uint32_t vertex) {
    std::int32_t end = 0;
    auto path = points_of_way(
        field, vertex, [&](std::size_t v) { return field.lifted[v]; },
        [](const EdgeBend& bend) { return bend.lifted; }, end);
    if (end != ConcavityField::kNoParent) {
        const HullFacet& facet = hull.facets[static_cast<std::size_t>(-1 - end)];
        const double lift_m = (field.lifted[vertex] - mesh.vertices[vertex]).norm();
        const double gap = facet.offset_m - facet.normal.dot(path.back()) - lift_m;
        path.push_back(path.back() + std::max(0.0, gap) * facet.normal);
    }
    return path;
}

}  // namespace graspd
