#pragma once

#include <string>

namespace graspd::server {

/// The network interfaces that the transports of a Fast DDS profile are limited to: the entries of
/// every interfaceWhiteList in the text of the file, separated by commas; "all" when there is no
/// such list. For the log alone: the middleware reads the file itself.
std::string profile_interfaces(const std::string& xml);

/// The same of a file; "unknown" when it cannot be read.
std::string profile_file_interfaces(const std::string& file);

}  // namespace graspd::server
