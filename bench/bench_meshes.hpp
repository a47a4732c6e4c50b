#pragma once

#include <string>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "support/concavity_answers.hpp"

namespace graspd::bench {

/// The mesh of a file, or of a shape given as NAME/FACES such as cup/5000 (see answer_names()).
Result<TriangleMesh> bench_mesh(const std::string& name);

}  // namespace graspd::bench
