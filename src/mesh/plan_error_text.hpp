#pragma once

#include <sstream>

#include "graspd/base/result.hpp"

namespace graspd::mesh_detail {

/// An error whose text is its parts, one after the other.
template <class... Parts>
PlanError error(PlanErrorCode code, const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return PlanError{code, text.str()};
}

}  // namespace graspd::mesh_detail
