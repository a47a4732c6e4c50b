#pragma once

#include <map>
#include <string>

#include "graspd/planner/planner.hpp"

namespace graspd::test {

/// Requests about generated shapes by name: concave and convex, meshes and a cloud, several
/// grippers, a table with an obstacle, a suggestion, none found, refused.
std::map<std::string, PlanRequest> digest_requests();

/// Hash of a reply's bytes on the wire without its id, with the stages' times set to zero.
std::string digest_of(PlanReply reply);

/// One hash of several by their names.
std::string digest_of(const std::map<std::string, std::string>& digests);

/// The digest of each of digest_requests() planned by itself.
std::map<std::string, std::string> cold_digests();

}  // namespace graspd::test
