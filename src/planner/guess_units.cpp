#include "graspd/planner/guess_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace graspd {
namespace {

/// A slip of the unit, and how to undo it at the shell.
struct Slip {
    double factor;
    const char* guess;
    const char* remedy;
};
constexpr std::array<Slip, 2> kTooLarge = {
    Slip{1e-3, "its numbers look like millimetres", "--units mm"},
    Slip{1e-2, "its numbers look like centimetres", "--units cm"}};
constexpr std::array<Slip, 2> kTooSmall = {
    Slip{1e3, "its numbers look like metres scaled by 0.001", "--scale 1000"},
    Slip{1e2, "its numbers look like metres scaled by 0.01", "--scale 100"}};

/// The slip that brings a length nearest to the opening, as a ratio.
const Slip& nearest_slip(const std::array<Slip, 2>& slips, double openings) {
    return *std::ranges::min_element(
        slips, {}, [&](const Slip& slip) { return std::abs(std::log(slip.factor * openings)); });
}

/// "115 x 105 x 82 mm"; below a metre in millimetres.
std::string size_text(const Eigen::Vector3d& size_m) {
    const bool small = size_m.maxCoeff() < 1.0;
    const Eigen::Vector3d size = size_m * (small ? 1e3 : 1.0);
    std::ostringstream text;
    text.precision(3);
    text << size[0] << " x " << size[1] << " x " << size[2] << (small ? " mm" : " m");
    return text.str();
}

}  // namespace

Result<std::optional<Finding>> guess_units(const Eigen::Vector3d& size_m,
                                           std::span<const Gripper> grippers,
                                           const GuessUnitsConfig& config) {
    std::array<double, 3> sides{size_m[0], size_m[1], size_m[2]};
    std::ranges::sort(sides, std::ranges::greater());
    const Gripper& widest = *std::ranges::max_element(grippers, {}, &Gripper::max_width_m);
    const double openings = sides[0] / widest.max_width_m;
    const double middle_openings = sides[1] / widest.max_width_m;
    const bool large = openings >= config.suspect_above;
    if (!large && openings > config.suspect_below) return std::optional<Finding>();

    const Slip& slip = nearest_slip(large ? kTooLarge : kTooSmall, openings);
    const Eigen::Vector3d sorted(sides[0], sides[1], sides[2]);
    std::ostringstream text;
    text.precision(4);
    text << "object of " << size_text(sorted) << ": its longest side is " << openings
         << " times the opening " << widest.max_width_m << " m of " << widest.name << "; "
         << slip.guess << ", factor " << slip.factor << " makes " << size_text(sorted * slip.factor)
         << " (" << slip.remedy << ")";
    const bool too_large =
        openings >= config.refuse_above && middle_openings >= config.suspect_above;
    if (config.refuse && (too_large || openings <= config.refuse_below)) {
        text << "; if it has this size, set guess_units.refuse: false";
        return PlanError{PlanErrorCode::kInvalidInput, text.str()};
    }
    text << "; taken as it is";
    return std::optional<Finding>({"units_suspected", slip.factor, text.str()});
}

}  // namespace graspd
