#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::concavity_detail {

/// A mesh whose faces are cut into pieces at the middles of edges; it stays the same surface, and
/// its pieces fit at their edges as the faces did.
class SplitSurface {
public:
    explicit SplitSurface(std::vector<Triangle> faces) : pieces_(std::move(faces)) {}

    const std::vector<Triangle>& pieces() const { return pieces_; }

    /// Turns edges between pieces that lie in one plane to the other diagonal of their two pieces.
    /// @param which     pieces to look at, by index
    /// @param has_edge  edges that it gives false for are turned, if it gives true for the other
    /// one
    /// @param points    about 1 in extent
    /// @return how many were turned
    std::size_t flip_flat(const std::vector<std::size_t>& which,
                          const std::function<bool(std::uint32_t, std::uint32_t)>& has_edge,
                          const std::vector<Eigen::Vector3d>& points);

    /// Marks the edge between two points for the next split(); marking it again changes nothing.
    void mark(std::uint32_t a, std::uint32_t b);
    /// Marks the longest edge of a piece.
    void mark_longest(const Triangle& piece, const std::vector<Eigen::Vector3d>& points);

    /// Splits what is marked, pieces with several marked edges at the longest first. The new points
    /// go to the end of `points`, in the order of marking.
    void split(std::vector<Eigen::Vector3d>& points);

    /// Splits edges until none is longer than `longest`. Gives up when there are more pieces than
    /// `most`. @return whether it came to the end
    bool split_long_edges(double longest, std::size_t most, std::vector<Eigen::Vector3d>& points);

private:
    struct MarkedEdge {
        std::uint32_t a, b;
    };
    struct PiecesAtEdge {
        std::array<std::size_t, 2> piece{};
        std::size_t count = 0;
    };
    std::unordered_map<std::uint64_t, PiecesAtEdge> pieces_at_edges() const;
    void cut(const Triangle& piece, const std::vector<Eigen::Vector3d>& points,
             std::vector<Triangle>& to) const;

    std::vector<Triangle> pieces_;
    std::vector<MarkedEdge> marked_;
    std::unordered_map<std::uint64_t, std::uint32_t> middle_;  ///< of a marked edge, once split
};

}  // namespace graspd::concavity_detail
