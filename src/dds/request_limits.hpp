#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "graspd/base/result.hpp"
#include "graspd/dds/dds_settings.hpp"
#include "graspd/dds/planner_port.hpp"

namespace graspd::dds {

/// What the sequences of a request's payload hold, counted before any of it is read.
class RequestCounts {
public:
    /// @param member  of GraspRequest_ that the sequence lies in, or that it is
    /// @param name    of the sequence
    /// @param most    its bound in the IDL; 0: none
    void see(const std::string& member, const std::string& name, std::uint64_t count,
             std::uint32_t most);

    RequestSize size() const;

    /// kTooLarge naming the first field that is over its limit, its count and the limit.
    std::optional<PlanError> over(const RequestLimits& limits) const;

private:
    std::uint64_t count_of(const char* member, const char* name) const;

    std::map<std::pair<std::string, std::string>, std::uint64_t> counts_;
    std::optional<PlanError> unbounded_;  ///< over a bound of the IDL
};

/// "cloud.width x cloud.height" when it is over its limit.
std::optional<PlanError> too_many_points(std::uint64_t points, const RequestLimits& limits);

/// "a payload of N bytes" when it is over its limit.
std::optional<PlanError> too_many_bytes(std::uint64_t bytes, std::uint32_t limit);

}  // namespace graspd::dds
