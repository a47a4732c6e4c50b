#pragma once

namespace graspd {

inline constexpr double kGravity_m_s2 = 9.81;  ///< [m/s2] that weights are reckoned with

}  // namespace graspd
