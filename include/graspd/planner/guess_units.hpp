#pragma once

#include <optional>
#include <span>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// Which sizes are no metres, in openings of the widest gripper of a request.
struct GuessUnitsConfig {
    double suspect_above = 10.0;  ///< [1] longest side: a plank or a car door, or centimetres
    double refuse_above = 100.0;  ///< [1] longest side, when the middle one is over suspect_above
    double suspect_below = 0.02;  ///< [1] longest side: a bead of 1.7 mm for 85 mm
    double refuse_below = 0.002;  ///< [1] longest side: metres that were scaled by 0.001
    bool refuse = true;           ///< false: only report

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("suspect_above", self.suspect_above, 1.0, 1e9);
        visit("refuse_above", self.refuse_above, 1.0, 1e9);
        visit("suspect_below", self.suspect_below, 0.0, 1.0);
        visit("refuse_below", self.refuse_below, 0.0, 1.0);
        visit("refuse", self.refuse);
    }
};

/// Guesses from an object's size whether its numbers are metres, as the contract says.
///
/// A size that is possible but odd is reported: a finding units_suspected, whose value is the
/// factor (0.001, 0.01, 100 or 1000) that brings the longest side nearest to the opening. A size
/// that no such gripper could be meant for is refused with that factor. A pole or a wire, long but
/// of a section that the gripper may hold, is never refused for its length.
///
/// Source: none in the paper, whose objects come in metres.
/// @param size_m    (3) the object's extents along its own axes, in any order [m], finite, >= 0
/// @param grippers  at least one, with max_width_m > 0; the widest counts
/// @return nothing when the size is as usual; kInvalidInput with size, factor and what would help
/// Pure.
Result<std::optional<Finding>> guess_units(const Eigen::Vector3d& size_m,
                                           std::span<const Gripper> grippers,
                                           const GuessUnitsConfig& config);

}  // namespace graspd
