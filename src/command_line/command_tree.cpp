#include "command_tree.hpp"

#include <CLI/CLI.hpp>

namespace graspd::command_line {
namespace {

/// What stands between the braces of "TEXT:{mm,cm,m}", which is how CLI11 tells of IsMember.
std::vector<std::string> choices_in(const std::string& type) {
    const std::size_t open = type.find('{'), close = type.find('}');
    if (open == std::string::npos || close == std::string::npos || close < open) return {};
    return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

OptionEntry read_option(const CLI::Option& option) {
    OptionEntry entry;
    entry.positional = option.get_positional() && !option.nonpositional();
    if (entry.positional) {
        entry.names.push_back(option.get_name(true));
    } else {
        for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
    }
    const std::string type = option.get_type_name();
    if (option.get_type_size_max() > 0) {
        entry.value = type.substr(0, type.find(':'));
        entry.choices = choices_in(type);
    }
    entry.description = option.get_description();
    entry.required = option.get_required();
    return entry;
}

}  // namespace

CommandEntry read_command_tree(const CLI::App& app, const std::string& name) {
    CommandEntry entry{name, app.get_description(), app.get_footer(), {}, {}};
    const auto is_shown = [](const auto* part) { return !part->get_group().empty(); };
    for (const CLI::Option* option : app.get_options(is_shown)) {
        entry.options.push_back(read_option(*option));
    }
    for (const CLI::App* command : app.get_subcommands(is_shown)) {
        entry.subcommands.push_back(read_command_tree(*command, command->get_name()));
    }
    return entry;
}

}  // namespace graspd::command_line
