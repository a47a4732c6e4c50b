#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace graspd {

/// A point's place on a curve that visits space cube by cube (Morton 1966): ten bits an axis,
/// interleaved, the highest first.
struct CurvePlace {
    std::uint32_t code = 0;
    std::uint32_t number = 0;  ///< of the point

    static constexpr int kBits = 30;
};

/// The points in the order of the curve; in one cube in their own. The fourth lane is idle.
/// Complexity O(N).
std::vector<CurvePlace> order_on_curve(const std::vector<Eigen::Array4f>& points);

}  // namespace graspd
