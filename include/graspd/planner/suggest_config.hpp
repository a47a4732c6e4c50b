#pragma once

#include <cstdint>

namespace graspd {

/// How a suggestion is looked for. All loops are bounded by these counts, never by the clock.
struct SuggestConfig {
    std::uint32_t bisections = 6;    ///< plans by which the least relaxation of a limit is narrowed
    double greatest_friction = 1.5;  ///< [1] no more is suggested; rubber on rough surfaces
    double least_gain = 0.01;        ///< [1] of the best score, for a plan that has grasps already

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("bisections", self.bisections, 0u, 50u);
        visit("greatest_friction", self.greatest_friction, 1e-3, 10.0);
        visit("least_gain", self.least_gain, 1e-6, 1.0);
    }
};

}  // namespace graspd
