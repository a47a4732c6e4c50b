#pragma once

#include <string>

struct mjModel_;

namespace graspd::simulate_detail {

/// Makes a MuJoCo model of its XML text, without any file. From then on MuJoCo's errors are thrown
/// as std::runtime_error, and its warnings, which it would write to a file, are only counted.
/// @return the caller's to delete
mjModel_* load_model(const std::string& text);

}  // namespace graspd::simulate_detail
