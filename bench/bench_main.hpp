#pragma once

#include <functional>
#include <string>

namespace graspd::bench {

/// What main() of a program of Google Benchmark does: reads the options, adds what is named behind
/// them, then what the program has of its own, and runs all of it.
/// @param add      a benchmark of what is named; false, after a message, where there is none
/// @param add_own  told whether anything was named
/// @return the exit code: 1 where a name was refused or something threw
int run_benchmarks(int count, char** arguments,
                   const std::function<bool(const std::string& name)>& add,
                   const std::function<void(bool any_named)>& add_own);

}  // namespace graspd::bench
