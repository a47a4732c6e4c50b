#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "bench_main.hpp"
#include "bench_meshes.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/mesh/condition_mesh.hpp"

// How long it takes from a mesh in memory to its concavity, conditioning included, and each step
// (counters, mean milliseconds), for shapes of 5k to 300k faces or for what is named behind the
// options:
//     concavity_bench [--benchmark_filter=REGEX] [FILE|SHAPE/FACES...]

namespace {

using namespace graspd;

void concavity(benchmark::State& state, const TriangleMesh& soup) {
    std::map<std::string, double> sums;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        const auto closed = condition_mesh(soup, {});
        if (!closed.ok()) return state.SkipWithError(closed.error().detail.c_str());
        sums["condition"] +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count();
        const auto measured = measure_concavity(closed.value().mesh, {});
        if (!measured.ok()) return state.SkipWithError(measured.error().detail.c_str());
        for (const StepTime& time : measured.value().times) sums[time.step] += time.ms;
        benchmark::DoNotOptimize(measured.value().field.largest_m);
    }
    state.counters["faces"] = static_cast<double>(soup.faces.size());
    for (const auto& [step, ms] : sums) {
        state.counters[step] = benchmark::Counter(ms, benchmark::Counter::kAvgIterations);
    }
}

bool add(const std::string& name) {
    auto mesh = bench::bench_mesh(name);
    if (!mesh.ok()) {
        std::fprintf(stderr, "%s\n", mesh.error().detail.c_str());
        return false;
    }
    const auto run = [mesh = std::move(mesh).value()](benchmark::State& state) {
        concavity(state, mesh);
    };
    benchmark::RegisterBenchmark(std::filesystem::path(name).c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    return bench::run_benchmarks(count, arguments, add, [](bool any_named) {
        if (any_named) return;
        for (const std::string size : {"/5000", "/16000", "/70000", "/300000"}) {
            for (const std::string shape :
                 {"cup", "channel", "tunnel_3d", "twisted vase", "torus"}) {
                add(shape + size);
            }
        }
    });
}
