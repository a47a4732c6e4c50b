#pragma once

#include <span>
#include <string>

#include "plan_arguments.hpp"
#include "write_json.hpp"

namespace graspd::cli {

/// Writes a result to standard output, or to the file of --out.
/// @return nothing, or kInternal naming the file that could not be written
std::optional<PlanError> write_output(const std::string& text, const std::string& file);

/// Writes the files of --report, if that is given: reply.json, reply.txt.
/// @return nothing, or kInternal naming the file that could not be written
std::optional<PlanError> write_report(const std::string& json, const std::string& table,
                                      const std::string& directory);

/// Prints an error to standard error. @return its exit code
int fail(const PlanError& error);

/// Prints a reply as the arguments ask, and the report directory if they ask for one: reply.json,
/// reply.txt. @return the exit code
int finish(const PlanReply& reply, std::span<const Gripper> grippers, const ResultOrigin& origin,
           const OutputArguments& arguments);

}  // namespace graspd::cli
