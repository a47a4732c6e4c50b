#include "output.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

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

std::optional<PlanError> write_report(const ReportFiles& files, const std::string& directory) {
    if (directory.empty()) return std::nullopt;
    const std::filesystem::path place = directory;
    std::error_code ignored;  // a directory that is not there shows when the file is written
    std::filesystem::create_directories(place, ignored);
    const std::pair<const char*, const std::string&> named[] = {
        {"reply.json", files.json}, {"reply.txt", files.table}, {"report.html", files.page}};
    for (const auto& [name, text] : named) {
        if (text.empty()) continue;
        if (auto error = write_file(place / name, text)) return error;
    }
    return std::nullopt;
}

int fail(const PlanError& error) {
    std::cerr << "graspctl: " << error.detail << '\n';
    return exit_code(error);
}

int finish(const PlanReply& reply, std::span<const Gripper> grippers, const ResultOrigin& origin,
           const OutputArguments& arguments, std::string page) {
    const std::string json = write_json(reply, grippers, origin);
    const std::string table = write_table(reply, grippers, origin);
    if (auto error = write_report({json, table, std::move(page)}, arguments.report)) {
        return fail(*error);
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
