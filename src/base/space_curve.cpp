#include "graspd/base/space_curve.hpp"

#include <array>
#include <limits>

#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

constexpr int kAxisBits = CurvePlace::kBits / 3;

/// The cell at a place along an axis. What is too far for a float has no place, a NaN: cell 0.
std::uint32_t cell_at(float place) {
    constexpr auto kPlaces = static_cast<float>(1 << kAxisBits);
    return place >= 0.0F && place < kPlaces ? static_cast<std::uint32_t>(place) : 0u;
}

/// Puts two zeros before each of the lowest ten bits.
std::uint32_t spread_to_every_third(std::uint32_t x) {
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
}

/// By code, equal ones as they are: ten bits a pass, from below.
void sort_by_code(std::vector<CurvePlace>& places) {
    constexpr std::uint32_t kDigits = 1u << kAxisBits;
    std::vector<CurvePlace> sorted(places.size());
    for (int shift = 0; shift < CurvePlace::kBits; shift += kAxisBits) {
        stop_point();
        std::array<std::uint32_t, kDigits + 1> slot{};
        const auto digit = [&](const CurvePlace& place) {
            return (place.code >> shift) & (kDigits - 1);
        };
        for (const CurvePlace& place : places) ++slot[digit(place) + 1];
        for (std::uint32_t d = 0; d < kDigits; ++d) slot[d + 1] += slot[d];
        for (const CurvePlace& place : places) sorted[slot[digit(place)]++] = place;
        places.swap(sorted);
    }
}

}  // namespace

std::vector<CurvePlace> order_on_curve(const std::vector<Eigen::Array4f>& points) {
    Eigen::Array4f low = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Array4f high = -low;
    for (const Eigen::Array4f& point : points) {
        low = low.min(point);
        high = high.max(point);
    }
    // One scale for all axes, so that the cells are cubes.
    const float width = (high - low).head<3>().maxCoeff();
    const float factor = width > 0.0F ? static_cast<float>((1 << kAxisBits) - 1) / width : 0.0F;
    stop_point();
    std::vector<CurvePlace> places(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Eigen::Array4f cell = (points[i] - low) * factor;
        std::uint32_t code = 0;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            code = code << 1 | spread_to_every_third(cell_at(cell[axis]));
        }
        places[i] = {code, i};
    }
    sort_by_code(places);
    return places;
}

}  // namespace graspd
