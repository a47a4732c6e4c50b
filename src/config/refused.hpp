#pragma once

#include <string>

#include "graspd/base/result.hpp"

namespace graspd {

/// The error of a value from outside: what it is, what it was, and why that will not do.
inline PlanError refused(const std::string& what, const std::string& value,
                         const std::string& reason) {
    return {PlanErrorCode::kInvalidInput, what + " = " + value + " " + reason};
}

}  // namespace graspd
