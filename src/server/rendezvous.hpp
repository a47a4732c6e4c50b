#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "graspd/dds/planner_port.hpp"

namespace graspd::server {

/// Who of several planners a request falls to: the one whose hash with the request's key is the
/// greatest (rendezvous hashing, Thaler and Ravishankar 1998). All who know the same planners come
/// to the same answer, in whatever order they know them; each planner gets an equal share, and when
/// one leaves only its own requests fall to others. Cost: linear in the planners, some 20 ns each.
///
/// @return null when there are no planners
const GuidBytes* rendezvous_owner(std::string_view key, std::span<const GuidBytes> planners);

/// What a request falls to a planner by: its writer and its request_id, so that a retry falls to
/// the same one.
std::string rendezvous_key(const RequestIdentity& identity);

}  // namespace graspd::server
