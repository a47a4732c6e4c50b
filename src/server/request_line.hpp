#pragma once

#include <string>

#include "planner_service.hpp"

namespace graspd::server {

/// One line of key=value pairs about an answered request: who, what came of it, how large it was
/// and where the milliseconds went. Values that a client chose are quoted when they hold anything
/// but letters, digits and ._-:/ so that a line stays a line and a pair a pair.
std::string request_line(const Answer& answer);

}  // namespace graspd::server
