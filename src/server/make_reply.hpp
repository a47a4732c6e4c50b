#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "graspd/dds/planner_port.hpp"

namespace graspd::server {

// The replies that the service gives without the planner; ids and frame as in the request.

/// The queue is full.
PlanReply overloaded(const IncomingRequest& to);
/// Its client has cancelled it.
PlanReply cancelled(const IncomingRequest& to);
/// The daemon is stopping.
PlanReply stopped(const IncomingRequest& to);
/// The writer has used this request_id for another request.
PlanReply id_clash(const IncomingRequest& to);
/// The object_key names nothing that is kept.
PlanReply unknown_object(const IncomingRequest& to);
/// "time_budget = 0.5 s".
std::string budget_text(const IncomingRequest& request);
/// It asks for a picture, and the settings say never.
PlanReply no_markers(const IncomingRequest& to);
/// The time budget was over before planning began.
PlanReply budget_spent(const IncomingRequest& to);
/// The time budget is over, and the planner has not stopped.
PlanReply overran(const IncomingRequest& to);
/// Planning it would take more memory than it may [bytes].
PlanReply too_large(const IncomingRequest& to, std::uint64_t needed, std::uint64_t limit);
/// Something was thrown.
PlanReply internal_error(const IncomingRequest& to, const std::string& what);
/// The request could not be converted.
PlanReply refused(const IncomingRequest& to, const PlanError& error);

/// When the time budget, counted from receipt, is over.
std::chrono::steady_clock::time_point deadline_of(const IncomingRequest& request);

/// Memory that planning takes at its peak, beside the payload [bytes]: an upper estimate from the
/// counts (docs/operations.md, Limits).
std::uint64_t needed_bytes(const RequestSize& size);

/// Vertices of a mesh or points of a cloud.
std::size_t point_count(const std::variant<TriangleMesh, PointCloud>& object);

}  // namespace graspd::server
