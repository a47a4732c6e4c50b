#include "output.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "exit_code.hpp"
#include "write_table.hpp"

namespace graspd::cli {
namespace {

std::optional<PlanError> write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (stream) return std::nullopt;
    return PlanError{PlanErrorCode::kInternal, file.string() + " cannot be written"};
}

}  // namespace

std::optional<PlanError> write_output(const std::string& text, const std::string& file) {
    if (!file.empty()) return write_file(file, text);
    std::cout << text << std::flush;
    if (std::cout) return std::nullopt;
    return PlanError{PlanErrorCode::kInternal, "standard output cannot be written"};
}

int fail(const PlanError& error) {
    std::cerr << "graspctl: " << error.detail << '\n';
    return exit_code(error);
}

int finish(const PlanReply& reply, std::span<const Gripper> grippers, const ResultOrigin& origin,
           const OutputArguments& arguments) {
    const std::string json = write_json(reply, grippers, origin);
    const std::string table = write_table(reply, grippers, origin);
    if (!arguments.report.empty()) {
        const std::filesystem::path directory = arguments.report;
        std::error_code ignored;  // a directory that is not there shows when the file is written
        std::filesystem::create_directories(directory, ignored);
        if (auto error = write_file(directory / "reply.json", json)) return fail(*error);
        if (auto error = write_file(directory / "reply.txt", table)) return fail(*error);
    }
    const bool as_json = arguments.format == "json";
    if (auto error = write_output(as_json ? json : table, arguments.out)) return fail(*error);
    if (exit_code(reply) != kExitOk) {
        std::cerr << "graspctl: " << to_string(reply.status) << (reply.message.empty() ? "" : ": ")
                  << reply.message << '\n';
    }
    return exit_code(reply);
}

}  // namespace graspd::cli
