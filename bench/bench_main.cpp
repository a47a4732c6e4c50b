#include "bench_main.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

namespace graspd::bench {

int run_benchmarks(int count, char** arguments,
                   const std::function<bool(const std::string& name)>& add,
                   const std::function<void(bool any_named)>& add_own) {
    try {
        benchmark::Initialize(&count, arguments);
        bool all_there = true;
        for (int i = 1; i < count; ++i) all_there = add(arguments[i]) && all_there;
        if (!all_there) return 1;
        add_own(count > 1);
        benchmark::RunSpecifiedBenchmarks();
        benchmark::Shutdown();
        return 0;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}

}  // namespace graspd::bench
