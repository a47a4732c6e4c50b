#include <benchmark/benchmark.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "bench_main.hpp"
#include "bench_meshes.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "support/shapes.hpp"

// How long mesh conditioning takes, for clean and damaged shapes of 5k to 300k faces and for the
// object files that are named behind the options:
//     conditioning_bench [--benchmark_filter=REGEX] [FILE...]

namespace {

using namespace graspd;

void condition(benchmark::State& state, const TriangleMesh& soup) {
    for (auto _ : state) {
        const auto result = condition_mesh(soup, {});
        if (!result.ok()) {
            state.SkipWithError(result.error().detail.c_str());
            break;
        }
        benchmark::DoNotOptimize(result.value().volume_m3);
    }
    const double faces = static_cast<double>(soup.faces.size());
    state.counters["faces"] = faces;
    state.counters["s_per_face"] = benchmark::Counter(
        faces, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Every kind of repair at once, in a share of the faces that is the same at every size.
TriangleMesh damaged(TriangleMesh mesh) {
    const std::size_t faces = mesh.faces.size();
    mesh = test::with_flipped(std::move(mesh), test::choose_faces(mesh, faces * 3 / 10, 1));
    mesh = test::with_duplicates(std::move(mesh), test::choose_faces(mesh, faces / 100, 2));
    mesh = test::shuffled(mesh, 3);
    mesh.faces.resize(mesh.faces.size() - faces / 50);
    return mesh;
}

void add(const std::string& name, TriangleMesh mesh) {
    benchmark::RegisterBenchmark(name.c_str(), [mesh = std::move(mesh)](benchmark::State& state) {
        condition(state, mesh);
    })->Unit(benchmark::kMillisecond);
}

void add_shapes() {
    for (const std::size_t faces : {5000u, 16000u, 70000u, 300000u}) {
        const std::string size = "/" + std::to_string(faces / 1000) + "k";
        const TriangleMesh cup = test::cup(0.04, 0.09, 0.004, faces);
        add("cup" + size, cup);
        add("torus" + size, test::torus(0.06, 0.02, faces));
        add("shuffled_cup" + size, test::shuffled(cup, 1));
        add("soup_of_a_cup" + size, test::to_soup(cup));
        add("damaged_cup" + size, damaged(cup));
    }
}

bool add_file(const std::string& path) {
    auto mesh = bench::bench_mesh(path);
    if (!mesh.ok()) {
        std::fprintf(stderr, "%s\n", mesh.error().detail.c_str());
        return false;
    }
    add(std::filesystem::path(path).filename().string(), std::move(mesh).value());
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    return bench::run_benchmarks(count, arguments, add_file, [](bool) { add_shapes(); });
}
