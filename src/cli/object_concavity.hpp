#pragma once

#include <string>
#include <vector>

#include "graspd/mesh/read_object.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// Concavity of an object's vertices or points as its file stores them.
struct ObjectConcavity {
    std::vector<double> value_m;      ///< [m] one for each record; welded ones repeat the value
    std::vector<ConcavityFlag> flag;  ///< kUnreferenced (value NaN) where no kept face uses it
    std::vector<Finding> findings;    ///< of reading, triangulating and conditioning
};

/// Triangulates a cloud, closes the mesh and computes its concavity.
/// @return the first error of these stages
Result<ObjectConcavity> object_concavity(const ObjectFile& object, const PlannerConfig& config);

/// One line a record: "index value_m flag". Values read back bit for bit; "inf" and "nan" stand for
/// enclosed and unreferenced ones.
std::string write_concavity(const ObjectConcavity& concavity);

}  // namespace graspd::cli
