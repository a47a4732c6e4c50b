#pragma once

#include <bit>
#include <cstdint>

#include <Eigen/Core>

namespace graspd {

/// Bit k is set where lane k has no sign: where it is zero or more.
inline unsigned lanes_not_negative(const Eigen::Array4f& lanes) {
#if defined(EIGEN_VECTORIZE_SSE)  // Eigen brings the intrinsics along
    return ~static_cast<unsigned>(_mm_movemask_ps(_mm_loadu_ps(lanes.data()))) & 0xfu;
#else
    unsigned mask = 0;
    for (unsigned k = 0; k < 4; ++k) {
        mask |= (1u - (std::bit_cast<std::uint32_t>(lanes[static_cast<Eigen::Index>(k)]) >> 31))
                << k;
    }
    return mask;
#endif
}

/// Each lane turned where `sign` has one: times 1 or -1.
inline Eigen::Array4f lanes_turned(const Eigen::Array4f& lanes, const Eigen::Array4f& sign) {
#if defined(EIGEN_VECTORIZE_SSE)
    const __m128 bit = _mm_and_ps(_mm_loadu_ps(sign.data()), _mm_set1_ps(-0.0F));
    Eigen::Array4f turned;
    _mm_storeu_ps(turned.data(), _mm_xor_ps(_mm_loadu_ps(lanes.data()), bit));
    return turned;
#else
    return (sign < 0.0F).select(-lanes, lanes);
#endif
}

/// Takes the lowest lane out of a mask that is not zero.
inline unsigned take_lane(unsigned& mask) {
    const auto lane = static_cast<unsigned>(std::countr_zero(mask));
    mask &= mask - 1;
    return lane;
}

}  // namespace graspd
