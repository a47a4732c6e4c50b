#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "graspd/base/result.hpp"

namespace graspd::bench {

/// What a program cannot go on without: the value, or the error on stderr and exit code 1.
template <class T>
T value_of(Result<T> result) {
    if (result.ok()) return std::move(result).value();
    std::fprintf(stderr, "%s\n", result.error().detail.c_str());
    std::exit(1);
}

}  // namespace graspd::bench
