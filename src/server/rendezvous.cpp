#include "rendezvous.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "graspd/base/content_hash.hpp"

namespace graspd::server {

const GuidBytes* rendezvous_owner(std::string_view key, std::span<const GuidBytes> planners) {
    const auto key_bytes = std::as_bytes(std::span(key));
    std::vector<std::byte> block(std::tuple_size_v<GuidBytes> + key_bytes.size());
    std::ranges::copy(key_bytes, block.begin() + std::tuple_size_v<GuidBytes>);
    const GuidBytes* owner = nullptr;
    std::uint64_t greatest = 0;
    for (const GuidBytes& planner : planners) {
        std::ranges::copy(std::as_bytes(std::span(planner)), block.begin());
        const std::uint64_t hash = content_hash(block);
        // Equal hashes of two planners do not happen by chance; the GUID decides all the same.
        if (owner == nullptr || std::tie(hash, planner) > std::tie(greatest, *owner)) {
            owner = &planner;
            greatest = hash;
        }
    }
    return owner;
}

std::string rendezvous_key(const RequestIdentity& identity) {
    return std::string(identity.writer.begin(), identity.writer.end()) + identity.request_id;
}

}  // namespace graspd::server
