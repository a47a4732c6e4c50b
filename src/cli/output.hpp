#pragma once

#include <span>
#include <string>

#include "plan_arguments.hpp"
#include "write_json.hpp"

namespace graspd::cli {

/// Writes a result to standard output, or to the file of --out.
/// @return nothing, or kInternal naming the file that could not be written
std::optional<PlanError> write_output(const std::string& text, const std::string& file);

/// What --report writes; an empty text is not written.
struct ReportFiles {
    std::string json;   ///< reply.json
    std::string table;  ///< reply.txt
    std::string page;   ///< report.html
};
/// Writes the files of --report, if that is given.
/// @return nothing, or kInternal naming the file that could not be written
std::optional<PlanError> write_report(const ReportFiles& files, const std::string& directory);

/// Prints an error to standard error. @return its exit code
int fail(const PlanError& error);

/// Prints a reply as the arguments ask, and the report directory if they ask for one: reply.json,
/// reply.txt and, if there is one, the page. @return the exit code
int finish(const PlanReply& reply, std::span<const Gripper> grippers, const ResultOrigin& origin,
           const OutputArguments& arguments, std::string page = {});

}  // namespace graspd::cli
