#pragma once

#include <string>

#include "command_line/command_tree.hpp"

namespace graspd::server {

/// The manual page of graspd: its options, and what they do not say.
std::string daemon_man_page(const command_line::CommandEntry& program);

}  // namespace graspd::server
