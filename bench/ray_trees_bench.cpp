#include <benchmark/benchmark.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <tbb/global_control.h>

#include "bench_main.hpp"
#include "bench_meshes.hpp"
#include "graspd/base/space_curve.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "ray_trees.hpp"

// Our tree of triangles beside those of CGAL, FCL and Embree (where installed), on one thread: how
// long it takes to build one (`build`) and to ask it about the segments that the concavity stage
// casts first (`near`), and about the same 1000 diagonals from the origin (`far`). Counters: time
// of one segment, how many are blocked, and how many of them only here (`more`) or only by our tree
// near the origin (`less`).
//     ray_trees_bench [--benchmark_filter=REGEX] [FILE|SHAPE/FACES...]

namespace {

using namespace graspd;
using bench::RayTree;
using bench::RayTreePtr;

constexpr double kFar = 1000.0;  // diagonals

struct Segment {
    Eigen::Vector3d from, to;  ///< [m]
};

/// A mesh with its segments, and which of them our tree calls blocked.
struct Scene {
    TriangleMesh mesh;
    double tolerance_m = 0.0;
    std::vector<Segment> segments;
    std::vector<char> blocked;
};

class OwnTree final : public RayTree {
public:
    explicit OwnTree(const Scene& scene) : tree_(scene.mesh, scene.tolerance_m) {}
    bool blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const override {
        return tree_.segment_blocked(a, b);
    }

private:
    TriangleBvh tree_;
};

struct TreeKind {
    const char* name;
    std::function<RayTreePtr(const Scene& scene)> build;
};

std::vector<TreeKind> tree_kinds() {
    return {
        {"own", [](const Scene& scene) { return std::make_unique<OwnTree>(scene); }},
        {"cgal", [](const Scene& scene) { return bench::cgal_tree(scene.mesh); }},
        {"fcl_capsule",
         [](const Scene& scene) { return bench::fcl_capsule_tree(scene.mesh, scene.tolerance_m); }},
        {"fcl_triangle", [](const Scene& scene) { return bench::fcl_triangle_tree(scene.mesh); }},
#ifdef GRASPD_BENCH_EMBREE
        {"embree", [](const Scene& scene) { return bench::embree_fast_tree(scene.mesh); }},
        {"embree_robust", [](const Scene& scene) { return bench::embree_robust_tree(scene.mesh); }},
        {"embree_sse42", [](const Scene& scene) { return bench::embree_sse42_tree(scene.mesh); }},
#endif
    };
}

/// The vertices in the order in which the concavity stage takes them.
std::vector<CurvePlace> vertex_order(const TriangleMesh& mesh, double diagonal_m) {
    std::vector<Eigen::Array4f> units(mesh.vertices.size(), Eigen::Array4f::Zero());
    const Eigen::Vector3d& base = mesh.vertices[mesh.faces.front()[0]];
    for (std::size_t v = 0; v < units.size(); ++v) {
        units[v].head<3>() = ((mesh.vertices[v] - base) / diagonal_m).cast<float>();
    }
    return order_on_curve(units);
}

/// From every lifted vertex that is not on the hull to one lift beyond the nearest plane of it.
std::vector<Segment> first_segments(const TriangleMesh& mesh, const MeasuredConcavity& measured) {
    const double diagonal_m = mesh_diagonal_m(mesh);
    const double lift_m = diagonal_m * ConcavityConfig().start_offset;
    const HullPlaneTree planes(measured.hull);
    std::vector<Segment> segments;
    std::uint32_t hint = 0;
    for (const CurvePlace& place : vertex_order(mesh, diagonal_m)) {
        if (measured.field.flag[place.number] == ConcavityFlag::kUnreferenced) continue;
        const auto nearest = planes.nearest(mesh.vertices[place.number], hint);
        hint = nearest.facet;
        if (nearest.distance_m <= lift_m / kOffsetOverRayTolerance) continue;
        const HullFacet& facet = planes.facet(nearest.facet);
        const Eigen::Vector3d& from = measured.field.lifted[place.number];
        const double length_m = facet.offset_m - facet.normal.dot(from) + lift_m;
        segments.push_back({from, from + length_m * facet.normal});
    }
    return segments;
}

Result<Scene> near_scene(const std::string& name) {
    const auto soup = bench::bench_mesh(name);
    if (!soup.ok()) return soup.error();
    auto closed = condition_mesh(soup.value(), {});
    if (!closed.ok()) return closed.error();
    const auto measured = measure_concavity(closed.value().mesh, {});
    if (!measured.ok()) return measured.error();
    Scene scene;
    scene.mesh = std::move(closed.value().mesh);
    scene.tolerance_m = ray_tolerance_m(scene.mesh, {});
    scene.segments = first_segments(scene.mesh, measured.value());
    for (const Segment& segment : scene.segments) {
        scene.blocked.push_back(measured.value().tree->segment_blocked(segment.from, segment.to));
    }
    return scene;
}

Scene far_scene(Scene scene) {
    const Eigen::Vector3d shift =
        kFar * mesh_diagonal_m(scene.mesh) * Eigen::Vector3d(0.36, 0.48, 0.8);
    for (Eigen::Vector3d& vertex : scene.mesh.vertices) vertex += shift;
    for (Segment& segment : scene.segments) {
        segment.from += shift;
        segment.to += shift;
    }
    return scene;
}

void build(benchmark::State& state, const Scene& scene, const TreeKind& kind) {
    for (auto _ : state) benchmark::DoNotOptimize(kind.build(scene).get());
    state.counters["faces"] = static_cast<double>(scene.mesh.faces.size());
}

void ask(benchmark::State& state, const Scene& scene, const TreeKind& kind) {
    const RayTreePtr tree = kind.build(scene);
    std::vector<char> blocked(scene.segments.size(), 0);
    for (auto _ : state) {
        for (std::size_t i = 0; i < blocked.size(); ++i) {
            blocked[i] = tree->blocked(scene.segments[i].from, scene.segments[i].to);
        }
        benchmark::DoNotOptimize(blocked.data());
    }
    double all = 0.0, more = 0.0, less = 0.0;
    for (std::size_t i = 0; i < blocked.size(); ++i) {
        all += blocked[i];
        more += blocked[i] > scene.blocked[i];
        less += blocked[i] < scene.blocked[i];
    }
    state.counters["segments"] = static_cast<double>(blocked.size());
    state.counters["segment"] = benchmark::Counter(
        static_cast<double>(blocked.size()),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["blocked"] = all;
    state.counters["more"] = more;
    state.counters["less"] = less;
}

using Work = void (*)(benchmark::State&, const Scene&, const TreeKind&);

bool add(const std::string& name) {
    auto made = near_scene(name);
    if (!made.ok()) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), made.error().detail.c_str());
        return false;
    }
    const auto near = std::make_shared<const Scene>(std::move(made).value());
    const auto far = std::make_shared<const Scene>(far_scene(*near));
    const std::string stem =
        name.find('.') == std::string::npos ? name : std::filesystem::path(name).stem().string();
    const auto put = [&](const std::string& what, const TreeKind& kind,
                         const std::shared_ptr<const Scene>& scene, Work work) {
        const std::string title = stem + "/" + kind.name + "/" + what;
        benchmark::RegisterBenchmark(title.c_str(),
                                     [=](benchmark::State& state) { work(state, *scene, kind); })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime();
    };
    for (const TreeKind& kind : tree_kinds()) {
        put("build", kind, near, build);
        put("near", kind, near, ask);
        put("far", kind, far, ask);
    }
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    return bench::run_benchmarks(count, arguments, add, [](bool any_named) {
        if (any_named) return;
        for (const char* shape : {"cup/5000", "cup/70000"}) add(shape);
    });
}
