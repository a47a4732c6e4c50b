#pragma once

#include "commands.hpp"
#include "graspd/base/result.hpp"
#include "graspd/dds/dds_settings.hpp"

namespace graspd::cli {

/// Domain, profile and topics as arguments and environment say (docs/operations.md).
/// @return an error that names the argument or the variable
Result<DdsSettings> dds_settings_of(const DdsArguments& arguments);

}  // namespace graspd::cli
