#include <fstream>
#include <iostream>
#include <iterator>

#include "commands.hpp"
#include "exit_code.hpp"
#include "graspd/config/profile_directory.hpp"
#include "write_exports.hpp"

namespace graspd::cli {
namespace {

PlanError invalid(const std::string& detail) {
    return {PlanErrorCode::kInvalidInput, detail};
}

Result<std::string> read_text(const std::string& file) {
    if (file == "-") {
        return std::string(std::istreambuf_iterator<char>(std::cin), {});
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (stream.is_open() && !stream.bad() && !text.empty()) return text;
    return PlanError{PlanErrorCode::kUnreadableFile, file + " cannot be read"};
}

/// An option that the format would pass over in silence is a mistake of whoever gave it.
std::optional<PlanError> check_options(const ExportArguments& arguments) {
    const std::string& format = arguments.format;
    const bool link = format == "moveit" || format == "isaac_grasp";
    const bool scale = format == "isaac_grasp" || format == "graspgen";
    const auto unused = [&](const char* option) {
        return invalid(std::string(option) + " does not go with --format " + format);
    };
    if (!arguments.link.empty() && !link) return unused("--link");
    if (!arguments.eef_transform.empty() && !link) return unused("--eef-transform");
    if (!arguments.object.empty() && !link && !scale) return unused("--object");
    if (arguments.object_scale && !scale) return unused("--object-scale");
    if (arguments.hand_depth_m && format != "gpd") return unused("--hand-depth");
    return std::nullopt;
}

Result<ExportOptions> options_of(const ExportArguments& arguments) {
    if (auto error = check_options(arguments)) return *std::move(error);
    ExportOptions options;
    options.object = arguments.object;
    options.link = arguments.link;
    options.object_scale = arguments.object_scale.value_or(1.0);
    options.hand_depth_m = arguments.hand_depth_m;
    if (arguments.eef_transform.empty()) return options;
    const auto X_HL = parse_pose("--eef-transform", arguments.eef_transform);
    if (!X_HL.ok()) return X_HL.error();
    options.X_HL = X_HL.value();
    return options;
}

/// Leaves the grasp of one rank.
std::optional<PlanError> keep_rank(GraspFile& file, std::uint32_t rank) {
    if (rank == 0) return std::nullopt;
    for (std::size_t i = 0; i < file.grasps.size(); ++i) {
        if (file.ranks[i] != rank) continue;
        file.grasps = {file.grasps[i]};
        file.ranks = {rank};
        return std::nullopt;
    }
    return invalid("--rank = " + std::to_string(rank) + ", but there are " +
                   std::to_string(file.grasps.size()) + " grasps");
}

/// The hands whose dimensions, link and joints the format needs.
Result<std::vector<ExportHand>> hands_for(const std::string& format, const GraspFile& file,
                                          const std::vector<ExportHand>& given) {
    if (!given.empty()) {
        for (std::size_t i = 0; i < file.grasps.size(); ++i) {
            const auto hand = hand_of(file, i, given);
            if (!hand.ok()) return hand.error();
        }
        return given;
    }
    if (format == "moveit" || format == "isaac_grasp") {
        const auto profiles = find_profiles();
        if (!profiles.ok()) return profiles.error();
        return find_hands(file, profiles.value() / "grippers");
    }
    if (format != "gpd") return given;
    if (file.gripper.ok()) return std::vector{ExportHand{file.gripper.value(), {}}};
    return invalid(file.gripper.error().detail + "; say the gripper by --gripper NAME|FILE");
}

Result<std::string> write_format(const std::string& format, const GraspFile& file,
                                 const std::vector<ExportHand>& hands,
                                 const ExportOptions& options) {
    if (format == "moveit") return write_moveit_yaml(file, hands, options);
    if (format == "isaac_grasp") return write_isaac_grasp(file, hands, options);
    if (format == "csv") return write_grasp_csv(file);
    if (format == "gpd") return write_gpd_yaml(file, hands, options);
    if (format == "graspgen") return write_graspgen_json(file, options);
    return invalid("--format = " + format + " is not known");
}

Result<std::vector<ExportHand>> given_hand(const std::string& name_or_file) {
    if (name_or_file.empty()) return std::vector<ExportHand>{};
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    auto hand = find_hand(name_or_file, profiles.value() / "grippers");
    if (!hand.ok()) return hand.error();
    return std::vector{std::move(hand).value()};
}

/// An error in the file, with the file's name.
PlanError in_file(const ExportArguments& arguments, const PlanError& error) {
    const std::string name = arguments.file == "-" ? "standard input" : arguments.file;
    return {error.code, name + ": " + error.detail};
}

}  // namespace

int run_export(const ExportArguments& arguments, const OutputArguments& output) {
    const auto options = options_of(arguments);
    if (!options.ok()) return fail(options.error());
    const auto given = given_hand(arguments.gripper);
    if (!given.ok()) return fail(given.error());
    const auto text = read_text(arguments.file);
    if (!text.ok()) return fail(text.error());
    const Gripper* gripper = given.value().empty() ? nullptr : &given.value().front().gripper;
    auto file = read_grasps(text.value(), gripper);
    if (!file.ok()) return fail(in_file(arguments, file.error()));
    if (file.value().grasps.empty()) {
        const GraspFile& reply = file.value();
        std::cerr << "graspctl: " << arguments.file << ": status " << reply.status
                  << ", no grasps to export" << (reply.message.empty() ? "" : ": ") << reply.message
                  << '\n';
        return kExitNoGrasp;
    }
    if (auto error = keep_rank(file.value(), arguments.rank)) return fail(*error);
    const auto hands = hands_for(arguments.format, file.value(), given.value());
    if (!hands.ok()) return fail(in_file(arguments, hands.error()));
    const auto result =
        write_format(arguments.format, file.value(), hands.value(), options.value());
    if (!result.ok()) return fail(in_file(arguments, result.error()));
    if (auto error = write_output(result.value(), output.out)) return fail(*error);
    return kExitOk;
}

}  // namespace graspd::cli
