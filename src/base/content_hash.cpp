#include "graspd/base/content_hash.hpp"

#define XXH_INLINE_ALL  // part of this file: nobody who links us needs the library
#include <xxhash.h>

#include "graspd/base/fnv1a.hpp"

namespace graspd {

std::uint64_t content_hash(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::string content_key(std::initializer_list<std::span<const std::byte>> blocks) {
    XXH3_state_t state;
    XXH3_128bits_reset(&state);
    for (const auto& block : blocks) {
        const std::uint64_t size = block.size();
        XXH3_128bits_update(&state, &size, sizeof size);
        XXH3_128bits_update(&state, block.data(), block.size());
    }
    const XXH128_hash_t hash = XXH3_128bits_digest(&state);
    return to_hex(hash.high64) + to_hex(hash.low64);
}

}  // namespace graspd
