#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "graspd/dds/dds_settings.hpp"
#include "planner_service.hpp"

namespace graspd::server {

// The daemon's log: a line `event=NAME key=value ...` on standard error for each thing that
// happens.

/// What is said of a daemon that is ready. Refers to all of it.
struct DaemonStart {
    const DdsSettings& dds;
    const ServerConfig& server;
    const std::string& network_why;  ///< what chose the profile file
    std::span<const Gripper> grippers;
    std::uint32_t restarts = 0;  ///< by the supervisor
};

/// To be called before anything is logged. @param level  of spdlog, such as "info"
void open_log(const std::string& level);

void log_ready(const DaemonStart& start);
void log_received(const RequestIdentity& identity);  ///< at level debug
void log_cancel(const CancelOrder& order, std::size_t cancelled);
/// @param calls  open ones of a caller that has left
void log_dropped(std::size_t calls);
/// A request that another planner should have answered.
void log_taken_over(const RequestIdentity& identity);
/// This planner shares requests with so many others from now on.
void log_takes_part(std::size_t peers);
/// Another planner has begun or ceased to serve.
void log_peer(const GuidBytes& peer, bool serves);
/// @param requests  open ones that other planners answer
void log_handed_over(std::size_t requests);
void log_answer(const Answer& answer);
void log_drawn(const Answer& answer, const PlanPicture& picture, double ms);  ///< at level debug
void log_not_drawn(const Answer& answer, const std::string& what);
void log_end(const ServiceCounters& counters, std::uint64_t rejected_payloads);

}  // namespace graspd::server
