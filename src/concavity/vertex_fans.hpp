#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::concavity_detail {

/// Vertex neighbours in compressed rows, each row rising and without repetition.
class VertexNeighbours {
public:
    explicit VertexNeighbours(const TriangleMesh& mesh);

    std::span<const std::uint32_t> of(std::uint32_t vertex) const {
        return std::span(neighbour_).subspan(start_[vertex], start_[vertex + 1] - start_[vertex]);
    }

private:
    std::vector<std::uint32_t> start_, neighbour_;
};

/// Per vertex the unit mean of its faces' normals, each weighted by its angle there (Baerentzen and
/// Aanaes 2005: points outward however the faces are cut); zero for an unreferenced vertex.
std::vector<Eigen::Vector3d> angle_weighted_normals(const TriangleMesh& mesh);

}  // namespace graspd::concavity_detail
