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
    /// Where geometry gives a bracket alone: its upper end; value_m is the lower one.
    std::function<double(const Eigen::Vector3d& vertex)> highest_m = nullptr;
};

/// Shapes out of whose hollows every shortest way is one straight line.
std::vector<ConcavityAnswer> straight_answers(std::size_t faces);

/// Shapes with bent ways: an undercut channel (one bend) and a labyrinth (three).
std::vector<ConcavityAnswer> bent_answers(std::size_t faces);

/// The names of all shapes: those above, tunnels that turn twice in a plane and out of it, and
/// vases with a rounded lip whose rings are aligned or turned at random.
std::vector<std::string> answer_names();

/// One of them by its name. Precondition: the name is one of answer_names().
ConcavityAnswer concavity_answer(const std::string& name, std::size_t faces);

}  // namespace graspd::test
