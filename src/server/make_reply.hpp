#pragma once

#include <chrono>
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
/// The time budget was over before planning began.
PlanReply budget_spent(const IncomingRequest& to, const PlanOptions& options);
/// Something was thrown.
PlanReply internal_error(const IncomingRequest& to, const std::string& what);
/// The request could not be converted.
PlanReply refused(const IncomingRequest& to, const PlanError& error);

/// When the time budget, counted from receipt, is over.
std::chrono::steady_clock::time_point deadline_of(const IncomingRequest& request,
                                                  const PlanOptions& options);

/// Vertices of a mesh or points of a cloud.
std::size_t point_count(const std::variant<TriangleMesh, PointCloud>& object);

}  // namespace graspd::server
