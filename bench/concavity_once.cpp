#include <sys/resource.h>

#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include <tbb/global_control.h>

#include "bench_meshes.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/mesh/condition_mesh.hpp"

// One conditioning and one concavity of a mesh, for counting instructions and memory:
//     valgrind --tool=callgrind --toggle-collect='*concavity_of_soup*' concavity_once cup/5000 1

namespace {

using namespace graspd;

double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Apart, so that callgrind can count what happens in here alone.
[[gnu::noinline]] Result<MeasuredConcavity> concavity_of_soup(const TriangleMesh& soup) {
    const auto closed = condition_mesh(soup, {});
    if (!closed.ok()) return closed.error();
    return measure_concavity(closed.value().mesh, {});
}

int run(const std::string& name, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto soup = bench::bench_mesh(name);
    if (!soup.ok()) {
        std::fprintf(stderr, "%s\n", soup.error().detail.c_str());
        return 1;
    }
    const double before_mb = peak_mb();
    const auto measured = concavity_of_soup(soup.value());
    if (!measured.ok()) {
        std::fprintf(stderr, "%s\n", measured.error().detail.c_str());
        return 1;
    }
    std::printf("%s: %zu faces, largest %.9g m, %.1f MB more at the peak\n", name.c_str(),
                soup.value().faces.size(), measured.value().field.largest_m, peak_mb() - before_mb);
    for (const StepTime& time : measured.value().times) {
        std::printf("  %-10s %8.3f ms\n", time.step, time.ms);
    }
    return 0;
}

}  // namespace

int main(int count, char** arguments) {
    std::size_t threads = 0;
    if (count == 3) {
        std::from_chars(arguments[2], arguments[2] + std::strlen(arguments[2]), threads);
    }
    if (threads == 0) {
        std::fprintf(stderr, "usage: concavity_once FILE|SHAPE/FACES THREADS\n");
        return 2;
    }
    try {
        return run(arguments[1], threads);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}
