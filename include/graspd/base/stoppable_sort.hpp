#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "graspd/base/stop.hpp"

namespace graspd {

/// std::sort for millions of items, with stop points some milliseconds apart. `less` must leave no
/// two different items equal, for then there is one order, however it comes about.
template <class Item, class Less = std::less<>>
void stoppable_sort(std::vector<Item>& items, Less less = {}) {
    constexpr std::size_t kAtATime = 1 << 15;
    const auto at = [&](std::size_t i) {
        return items.begin() + static_cast<std::ptrdiff_t>(std::min(i, items.size()));
    };
    for (std::size_t first = 0; first < items.size(); first += kAtATime) {
        stop_point();
        std::sort(at(first), at(first + kAtATime), less);
    }
    for (std::size_t run = kAtATime; run < items.size(); run *= 2) {
        for (std::size_t first = 0; first + run < items.size(); first += 2 * run) {
            stop_point();
            std::inplace_merge(at(first), at(first + run), at(first + 2 * run), less);
        }
    }
}

}  // namespace graspd
