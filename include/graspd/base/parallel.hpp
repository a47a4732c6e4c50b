#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace graspd {

/// Calls work(first, last) for [0, count) cut into blocks of `block` (the last may be shorter), on
/// as many threads as there are. The blocks do not depend on the number of threads, so work that
/// writes to its own block alone gives the same bytes for one and many. Every block begins with a
/// stop_point(). Throws what a block throws, once no block is under way.
void for_blocks(std::size_t count, std::size_t block,
                const std::function<void(std::size_t first, std::size_t last)>& work);

/// Runs pieces of work side by side, as many at a time as there are threads, and returns when all
/// are done. Stops and throws as for_blocks().
void run_together(const std::vector<std::function<void()>>& work);

}  // namespace graspd
