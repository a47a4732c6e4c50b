#pragma once

#include <span>
#include <string>

#include "graspd/planner/plan_types.hpp"

namespace graspd::cli {

/// What a result says about the program that made it.
struct ResultOrigin {
    std::string version;      ///< of graspd
    std::string config_hash;  ///< of the effective planner configuration; empty when unknown
    double total_ms = 0.0;    ///< [ms] wall time from request to reply
};

/// A reply as one JSON object, schema graspd/1: metres, radians, poses in the request's frame F,
/// rotations row-major with the columns Gx Gy Gz, quaternions x y z w with w >= 0. Numbers read
/// back as the same double; an infinite or undefined one is null.
///
/// @param grippers  the request's; member `gripper` is the best grasp's, or the first without
/// grasps
std::string write_json(const PlanReply& reply, std::span<const Gripper> grippers,
                       const ResultOrigin& origin);

/// Grippers as one JSON object {"schema": "graspd/1", "grippers": [...]}.
std::string write_json(std::span<const Gripper> grippers);

}  // namespace graspd::cli
