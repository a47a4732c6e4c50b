#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

/// A shape of shapes.hpp and the concavity that geometry gives for each of its vertices [m].
struct ConcavityAnswer {
    std::string name;
    TriangleMesh mesh;
    std::function<double(const Eigen::Vector3d& vertex)> value_m;
};

/// Shapes out of whose hollows every shortest way is one straight line.
std::vector<ConcavityAnswer> straight_answers(std::size_t faces);

/// Shapes with bent ways: an undercut channel (one bend) and a labyrinth (three).
std::vector<ConcavityAnswer> bent_answers(std::size_t faces);

}  // namespace graspd::test
