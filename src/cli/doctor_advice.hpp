#pragma once

#include <string>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::cli {

/// What would help against the findings and the refusal: one sentence each, none twice.
std::vector<std::string> advice_for(const std::vector<Finding>& findings,
                                    const std::string& refusal);

}  // namespace graspd::cli
