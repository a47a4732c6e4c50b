#pragma once

#include <span>
#include <string>

#include "command_tree.hpp"

namespace graspd::command_line {

/// An option whose values only the machine knows.
struct ListedValues {
    std::string option;   ///< such as "--gripper"
    std::string command;  ///< for the shell; prints the values, one a line
};

/// A script that completes subcommands, options and their values in bash. Where any value will do
/// it leaves the word to the shell, which completes files.
std::string write_bash_completion(const CommandEntry& program,
                                  std::span<const ListedValues> listed);

/// The same for zsh, for a file `_NAME` in its fpath or to be sourced.
std::string write_zsh_completion(const CommandEntry& program, std::span<const ListedValues> listed);

}  // namespace graspd::command_line
