#include <iostream>

#include "commands.hpp"
#include "exit_code.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "planner_settings.hpp"
#include "write_doctor.hpp"

namespace graspd::cli {

int run_doctor(const ObjectArguments& object, const std::string& gripper_name,
               const std::string& config_file, const OutputArguments& output) {
    const auto profiles = find_profiles();
    if (!profiles.ok()) return fail(profiles.error());
    const auto gripper = find_gripper(gripper_name, profiles.value() / "grippers");
    if (!gripper.ok()) return fail(gripper.error());
    const auto config = planner_settings(config_file, "");
    if (!config.ok()) return fail(config.error());
    const auto file = read_object_file(object);
    if (!file.ok() && file.error().code != PlanErrorCode::kUnreadableFile) {
        return fail(file.error());
    }
    Diagnosis diagnosis;
    if (file.ok()) {
        diagnosis = diagnose_object(file.value(), gripper.value(), config.value());
    } else {
        diagnosis.kind = "unreadable";
        diagnosis.refusal = file.error().detail;
    }
    diagnosis.file = object.file;
    const bool as_json = output.format == "json";
    const std::string text = as_json ? write_doctor_json(diagnosis) : write_doctor_table(diagnosis);
    if (auto error = write_output(text, output.out)) return fail(*error);
    if (diagnosis.usable()) return kExitOk;
    std::cerr << "graspctl: refused: " << diagnosis.refusal << '\n';
    return kExitUsage;
}

}  // namespace graspd::cli
