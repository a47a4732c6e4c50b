#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "compare_replies.hpp"
#include "exit_code.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/dds/payloads.hpp"
#include "graspd/planner/planner.hpp"
#include "planner_settings.hpp"

namespace graspd::cli {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

Result<Bytes> read_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(stream), {}};
    if (stream.is_open() && !stream.bad()) return bytes;
    return PlanError{PlanErrorCode::kUnreadableFile, file.string() + " cannot be read"};
}

PlanError in_file(const fs::path& file, const PlanError& error) {
    return {PlanErrorCode::kUnreadableFile, file.string() + ": " + error.detail};
}

/// reply-000001.cdr or object-000001.cdr beside request-000001.cdr.
fs::path beside(const fs::path& request, const std::string& kind) {
    constexpr std::string_view kRequest = "request";
    std::string name = request.filename().string();
    if (name.starts_with(kRequest)) name.replace(0, kRequest.size(), kind);
    return request.parent_path() / name;
}

/// The object that a request names, from the file beside it.
std::optional<PlanError> fill_in_object(const fs::path& file, std::span<const Gripper> known,
                                        PlanRequest& request) {
    const fs::path object_file = beside(file, "object");
    const auto bytes = read_file(object_file);
    if (!bytes.ok()) return bytes.error();
    auto object = read_request_payload(bytes.value());
    if (!object.ok()) return in_file(object_file, object.error());
    auto converted = object.value()->convert(known);
    if (!converted.ok()) return in_file(object_file, converted.error());
    request.object_O = std::move(converted.value().object_O);
    return std::nullopt;
}

PlanReply refusal(const IncomingRequest& request, const PlanError& error) {
    PlanReply reply;
    reply.request_id = request.identity().request_id;
    reply.frame_id = request.frame_id();
    reply.status = status_of(error.code);
    reply.message = error.detail;
    return reply;
}

/// Plans a recorded request again; without its time budget, whose end is no property of it.
Result<PlanReply> plan_again(const fs::path& file, const PlannerConfig& config) {
    const auto bytes = read_file(file);
    if (!bytes.ok()) return bytes.error();
    const auto request = read_request_payload(bytes.value());
    if (!request.ok()) return in_file(file, request.error());
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    const auto grippers = load_grippers(profiles.value() / "grippers");
    if (!grippers.ok()) return grippers.error();
    auto problem = request.value()->convert(grippers.value());
    if (!problem.ok()) return refusal(*request.value(), problem.error());
    if (!request.value()->object_key().empty()) {
        if (auto bad = fill_in_object(file, grippers.value(), problem.value())) return *bad;
    }
    return plan(problem.value(), config);
}

std::string as_json(const std::vector<ReplyDifference>& differences) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& [what, recorded, replayed] : differences) {
        rows.push_back({{"what", what}, {"recorded", recorded}, {"replayed", replayed}});
    }
    const nlohmann::ordered_json all = {
        {"schema", "graspd/1"}, {"same", differences.empty()}, {"differences", rows}};
    return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string as_table(const std::vector<ReplyDifference>& differences) {
    if (differences.empty()) return "the same reply\n";
    std::string text;
    for (const auto& [what, recorded, replayed] : differences) {
        text.append(what).append("\n    recorded: ").append(recorded);
        text.append("\n    replayed: ").append(replayed).append("\n");
    }
    return text;
}

}  // namespace

int run_replay(const std::string& file, const std::string& config_file,
               const OutputArguments& output) {
    const auto config = planner_settings(config_file, "");
    if (!config.ok()) return fail(config.error());
    const auto reply = plan_again(file, config.value());
    if (!reply.ok()) return fail(reply.error());
    const fs::path reply_file = beside(file, "reply");
    const auto bytes = read_file(reply_file);
    if (!bytes.ok()) return fail(bytes.error());
    const auto recorded = read_reply_payload(bytes.value());
    if (!recorded.ok()) return fail(in_file(reply_file, recorded.error()));
    // Over the wire as the recorded one went: quaternions round.
    const auto replayed = read_reply_payload(reply_payload(reply.value()));
    if (!replayed.ok()) return fail(replayed.error());
    const auto differences = compare_replies(recorded.value(), replayed.value());
    const bool json = output.format == "json";
    const auto bad = write_output(json ? as_json(differences) : as_table(differences), output.out);
    if (bad) return fail(*bad);
    return differences.empty() ? kExitOk : kExitNoGrasp;
}

}  // namespace graspd::cli
