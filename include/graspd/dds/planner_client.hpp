#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "graspd/base/result.hpp"
#include "graspd/dds/dds_settings.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd {

/// A client's end: writes requests and waits for the terminal reply. To be used from one thread.
class PlannerClient {
public:
    /// Joins the domain. `client_id` (1..64 printable characters) should differ from that of every
    /// other client: replies are told apart by it and by the request's id.
    /// @return as PlannerPort::open
    static Result<std::unique_ptr<PlannerClient>> open(const DdsSettings& settings,
                                                       std::string client_id);
    virtual ~PlannerClient() = default;

    /// Waits until a planner's reader and writer are both matched (a first match can take 3 s).
    virtual bool wait_for_planner(std::chrono::milliseconds timeout) = 0;

    /// Sends the request, with its grippers inline, and returns the first terminal reply with this
    /// client's id and the request's.
    ///
    /// @param timeout  for each attempt
    /// @param retries  how often it is sent again, under the same id, on silence or OVERLOADED; the
    ///                 last OVERLOADED is returned as it is
    /// @return kNoReply after silence to every attempt; kInvalidInput when the request's id or a
    ///         count does not fit the wire; kInternal when the middleware cannot send
    virtual Result<PlanReply> request(const PlanRequest& request, std::chrono::milliseconds timeout,
                                      std::uint32_t retries) = 0;
};

}  // namespace graspd
