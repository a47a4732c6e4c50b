#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace graspd::cli {

/// What graspctl writes: members in the order in which they are given.
using Json = nlohmann::ordered_json;

/// [x, y, z].
inline Json json_of(const Eigen::Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

}  // namespace graspd::cli
