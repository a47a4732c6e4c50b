#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

namespace graspd {

// XXH3 over contents of any size, some ten bytes a nanosecond. No cryptographic hash: equal hashes
// of different contents do not happen by chance, but whoever wants to can make some. So a hash is
// no proof that contents are equal; where that matters, compare them.

/// 64 bits. Among n contents two collide by chance with a probability of n^2 / 3.7e19.
std::uint64_t content_hash(std::span<const std::byte> bytes);

/// 128 bits of several blocks, as 32 hexadecimal digits; the blocks' lengths count too, so that
/// bytes cannot wander from one block into the next. Among n contents two collide by chance with a
/// probability of n^2 / 6.8e38.
std::string content_key(std::initializer_list<std::span<const std::byte>> blocks);

}  // namespace graspd
