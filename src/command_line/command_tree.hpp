#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace graspd::command_line {

/// One option or positional argument of a program.
struct OptionEntry {
    std::vector<std::string> names;  ///< as typed, such as "-h" and "--help"; that of a positional
    std::string value;               ///< kind of its value, such as "TEXT"; empty for a flag
    std::string description;
    std::vector<std::string> choices;  ///< the only values that it takes; empty: any
    bool positional = false;
    bool required = false;
};

/// A program or one of its subcommands.
struct CommandEntry {
    std::string name;
    std::string description;
    std::string footer;
    std::vector<OptionEntry> options;  ///< in the order of --help
    std::vector<CommandEntry> subcommands;
};

/// Reads a program's own description of its command line, so that what is written from it
/// (completion scripts, manual pages) cannot say anything else. Options and subcommands of the
/// group "" are left out, as --help leaves them out.
CommandEntry read_command_tree(const CLI::App& app, const std::string& name);

}  // namespace graspd::command_line
