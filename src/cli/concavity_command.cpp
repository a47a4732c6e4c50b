#include <iostream>

#include "commands.hpp"
#include "graspd/mesh/read_object.hpp"
#include "object_concavity.hpp"
#include "planner_settings.hpp"

namespace graspd::cli {

int run_concavity(const ObjectArguments& arguments, const std::string& method,
                  const std::string& config_file, const OutputArguments& output) {
    const auto config = planner_settings(config_file, method);
    if (!config.ok()) return fail(config.error());
    const auto object = read_object(arguments.file, arguments.scale);
    if (!object.ok()) return fail(object.error());
    const auto concavity = object_concavity(object.value(), config.value());
    if (!concavity.ok()) {
        return fail({concavity.error().code, arguments.file + ": " + concavity.error().detail});
    }
    for (const Finding& finding : concavity.value().findings) {
        std::cerr << "graspctl: finding: " << finding.code << ": " << finding.detail << '\n';
    }
    if (auto error = write_output(write_concavity(concavity.value()), output.out)) {
        return fail(*error);
    }
    return 0;
}

}  // namespace graspd::cli
