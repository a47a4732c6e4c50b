#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::concavity_detail {

/// Vertex neighbours in compressed rows, in the order of the faces.
class VertexNeighbours {
public:
    VertexNeighbours() = default;  ///< of no vertex
    /// @param mesh  on each edge as many faces run one way as the other, as conditioning leaves it:
    ///              a vertex's outgoing half-edges then name every neighbour, once on a manifold
    explicit VertexNeighbours(const TriangleMesh& mesh);

    std::span<const std::uint32_t> of(std::uint32_t vertex) const {
        return {neighbour_.data() + start_[vertex], start_[vertex + 1] - start_[vertex]};
    }

    /// The face on the left of each outgoing half-edge, in the order of `of`.
    std::span<const std::uint32_t> faces_of(std::uint32_t vertex) const {
        return {face_.data() + start_[vertex], start_[vertex + 1] - start_[vertex]};
    }

private:
    std::vector<std::uint32_t> start_, neighbour_, face_;
};

/// What a face is to the fans of its corners.
struct FaceCorners {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();     ///< unit; zero for a face without area
    Eigen::Vector3d angle_rad = Eigen::Vector3d::Zero();  ///< at the face's first, second, third
};
/// One per face. The angles are good to 3e-5 rad (Abramowitz and Stegun 1964, 4.4.49).
std::vector<FaceCorners> corners_of_faces(const TriangleMesh& mesh);

/// The unit mean of the normals of a vertex's faces, each weighted by its angle there (Baerentzen
/// and Aanaes 2005: points outward however the faces are cut); zero for an unreferenced vertex.
Eigen::Vector3d angle_weighted_normal(const TriangleMesh& mesh, std::uint32_t vertex,
                                      std::span<const std::uint32_t> faces_of_vertex,
                                      std::span<const FaceCorners> corners);

}  // namespace graspd::concavity_detail
