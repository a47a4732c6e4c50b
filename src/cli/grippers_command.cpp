#include "commands.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "write_table.hpp"

namespace graspd::cli {

int run_grippers(const OutputArguments& output) {
    const auto profiles = find_profiles();
    if (!profiles.ok()) return fail(profiles.error());
    const auto grippers = load_grippers(profiles.value() / "grippers");
    if (!grippers.ok()) return fail(grippers.error());
    const std::string text =
        output.format == "json" ? write_json(grippers.value()) : write_table(grippers.value());
    if (auto error = write_output(text, output.out)) return fail(*error);
    return 0;
}

}  // namespace graspd::cli
