#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "bench_meshes.hpp"
#include "graspd/base/freed_memory.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "meter.hpp"

// Conditioning and concavity of a mesh, so many times (1): median milliseconds of each step and in
// all, and the memory of the first time. Once, for counting instructions:
//     concavity_once FILE|SHAPE/FACES THREADS [TIMES]
//     valgrind --tool=callgrind --toggle-collect='*concavity_of_soup*' concavity_once cup/5000 1

namespace {

using namespace graspd;
using bench::ms_since;
using bench::peak_mb;
using Clock = std::chrono::steady_clock;

/// Apart, so that callgrind can count what happens in here alone. The first step is conditioning.
[[gnu::noinline]] Result<MeasuredConcavity> concavity_of_soup(const TriangleMesh& soup) {
    const auto start = Clock::now();
    const auto closed = condition_mesh(soup, {});
    if (!closed.ok()) return closed.error();
    const double condition_ms = ms_since(start);
    auto measured = measure_concavity(closed.value().mesh, {});
    if (measured.ok()) {
        measured.value().times.insert(measured.value().times.begin(), {"condition", condition_ms});
    }
    return measured;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

int run(const std::string& name, std::size_t threads, std::size_t times) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto soup = bench::bench_mesh(name);
    if (!soup.ok()) {
        std::fprintf(stderr, "%s\n", soup.error().detail.c_str());
        return 1;
    }
    const double before_mb = peak_mb();
    double more_mb = 0.0;
    std::vector<std::string> steps;
    std::map<std::string, std::vector<double>> ms;
    for (std::size_t i = 0; i < times; ++i) {
        const auto start = Clock::now();
        const auto measured = concavity_of_soup(soup.value());
        if (!measured.ok()) {
            std::fprintf(stderr, "%s\n", measured.error().detail.c_str());
            return 1;
        }
        ms["total"].push_back(ms_since(start));
        if (i == 0) more_mb = peak_mb() - before_mb;
        steps.clear();
        for (const StepTime& time : measured.value().times) {
            steps.emplace_back(time.step);
            ms[time.step].push_back(time.ms);
        }
    }
    std::printf("%s: %zu faces, %.1f MB more at the peak\n", name.c_str(),
                soup.value().faces.size(), more_mb);
    steps.emplace_back("total");
    for (const std::string& step : steps) {
        std::printf("  %-10s %8.3f ms\n", step.c_str(), median(ms[step]));
    }
    return 0;
}

/// 0 where the text is no number.
std::size_t number(const char* text) {
    std::size_t value = 0;
    const char* end = text + std::strlen(text);
    const auto read = std::from_chars(text, end, value);
    return read.ec == std::errc() && read.ptr == end ? value : 0;
}

}  // namespace

int main(int count, char** arguments) {
    graspd::keep_freed_memory(graspd::kFreedMemory_bytes);  // as the daemon does
    const std::size_t threads = count >= 3 ? number(arguments[2]) : 0;
    const std::size_t times = count == 4 ? number(arguments[3]) : 1;
    if (count > 4 || threads == 0 || times == 0) {
        std::fprintf(stderr, "usage: concavity_once FILE|SHAPE/FACES THREADS [TIMES]\n");
        return 2;
    }
    try {
        return run(arguments[1], threads, times);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}
