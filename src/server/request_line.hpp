#pragma once

#include <string>

#include "planner_service.hpp"

namespace graspd::server {

/// A text as the value of a key=value pair: in quotes when it is empty or holds anything but
/// letters, digits and ._-:/ with ? for what cannot be printed, so that a line stays a line and a
/// pair a pair whatever a client sends.
std::string log_value(const std::string& text);

/// One line of key=value pairs about an answered request: who, what came of it, how large it was
/// and where the milliseconds went.
std::string request_line(const Answer& answer);

}  // namespace graspd::server
