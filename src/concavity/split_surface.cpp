#include "split_surface.hpp"

#include <algorithm>
#include <utility>

#include "fast_marching.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::concavity_detail {
namespace {

using Eigen::Vector3d;

constexpr double kFlat = 1e-7;        // in units of the extent: the rounding of float coordinates
constexpr double kLeastShare = 1e-9;  // of the pieces' area that a turned piece has to have

/// Longer, or as long with the greater key: both pieces at an edge must agree.
bool longer(const Triangle& piece, std::size_t i, std::size_t j,
            const std::vector<Vector3d>& points) {
    const auto rank = [&](std::size_t k) {
        const std::uint32_t a = piece[k], b = piece[(k + 1) % 3];
        return std::pair((points[a] - points[b]).squaredNorm(), edge_key(a, b));
    };
    return rank(i) > rank(j);
}

std::uint32_t opposite(const Triangle& piece, std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t corner : piece) {
        if (corner != a && corner != b) return corner;
    }
    return a;  // a piece has three corners
}

/// A piece as {from, to, opposite corner}, from its edge k on.
Triangle from_edge(const Triangle& piece, std::size_t k) {
    return {piece[k], piece[(k + 1) % 3], piece[(k + 2) % 3]};
}

/// Whether the pieces (a, b, c) and (b, a, d) lie in one plane and (a, d, c), (d, b, c) do not
/// fold.
bool is_flat_and_convex(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                        const Vector3d& d) {
    const Vector3d twice_area = (b - a).cross(c - a) + (a - b).cross(d - b);
    const Vector3d normal = twice_area.stableNormalized();
    const Eigen::Vector4d height(normal.dot(a), normal.dot(b), normal.dot(c), normal.dot(d));
    if (height.maxCoeff() - height.minCoeff() > kFlat) return false;
    const double least = kLeastShare * twice_area.norm();
    return normal.dot((d - a).cross(c - a)) > least && normal.dot((b - d).cross(c - d)) > least;
}

}  // namespace

std::unordered_map<std::uint64_t, SplitSurface::PiecesAtEdge> SplitSurface::pieces_at_edges()
    const {
    std::unordered_map<std::uint64_t, PiecesAtEdge> pieces;
    pieces.reserve(2 * pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            PiecesAtEdge& at = pieces[edge_key(pieces_[i][k], pieces_[i][(k + 1) % 3])];
            if (at.count < 2) at.piece[at.count] = i;
            ++at.count;
        }
    }
    return pieces;
}

std::size_t SplitSurface::flip_flat(
    const std::vector<std::size_t>& which,
    const std::function<bool(std::uint32_t, std::uint32_t)>& has_edge,
    const std::vector<Vector3d>& points) {
    const auto pieces = pieces_at_edges();
    std::vector<char> touched(pieces_.size(), 0);  // for these `pieces` no longer holds
    std::size_t flips = 0;
    std::size_t step = 0;
    for (const std::size_t i : which) {
        stop_point(step++);
        for (std::size_t k = 0; k < 3 && !touched[i]; ++k) {
            const auto [a, b, c] = from_edge(pieces_[i], k);
            const PiecesAtEdge& at = pieces.at(edge_key(a, b));
            const std::size_t other = at.piece[0] == i ? at.piece[1] : at.piece[0];
            if (at.count != 2 || touched[other] || has_edge(a, b)) continue;
            const std::uint32_t d = opposite(pieces_[other], a, b);
            if (!is_flat_and_convex(points[a], points[b], points[c], points[d]) ||
                !has_edge(c, d) || pieces.contains(edge_key(c, d))) {
                continue;
            }
            pieces_[i] = {a, d, c};
            pieces_[other] = {d, b, c};
            touched[i] = touched[other] = 1;
            ++flips;
        }
    }
    return flips;
}

void SplitSurface::mark(std::uint32_t a, std::uint32_t b) {
    if (middle_.try_emplace(edge_key(a, b), 0u).second) marked_.push_back({a, b});
}

void SplitSurface::mark_longest(const Triangle& piece, const std::vector<Vector3d>& points) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (longer(piece, k, longest, points)) longest = k;
    }
    mark(piece[longest], piece[(longest + 1) % 3]);
}

void SplitSurface::cut(const Triangle& piece, const std::vector<Vector3d>& points,
                       std::vector<Triangle>& to) const {
    std::size_t at = 3;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!middle_.contains(edge_key(piece[k], piece[(k + 1) % 3]))) continue;
        if (at == 3 || longer(piece, k, at, points)) at = k;
    }
    if (at == 3) {
        to.push_back(piece);
        return;
    }
    const std::uint32_t a = piece[at], b = piece[(at + 1) % 3], c = piece[(at + 2) % 3];
    const std::uint32_t middle = middle_.at(edge_key(a, b));
    cut({a, middle, c}, points, to);
    cut({middle, b, c}, points, to);
}

void SplitSurface::split(std::vector<Vector3d>& points) {
    for (const MarkedEdge& edge : marked_) {
        middle_.at(edge_key(edge.a, edge.b)) = static_cast<std::uint32_t>(points.size());
        points.push_back(0.5 * (points[edge.a] + points[edge.b]));
    }
    std::vector<Triangle> pieces;
    pieces.reserve(pieces_.size() + 2 * marked_.size());
    std::size_t step = 0;
    for (const Triangle& piece : pieces_) {
        stop_point(step++);
        cut(piece, points, pieces);
    }
    pieces_ = std::move(pieces);
    marked_.clear();
    middle_.clear();
}

bool SplitSurface::split_long_edges(double longest, std::size_t most,
                                    std::vector<Vector3d>& points) {
    while (pieces_.size() <= most) {
        std::size_t step = 0;
        for (const Triangle& piece : pieces_) {
            stop_point(step++);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = piece[k], b = piece[(k + 1) % 3];
                if ((points[a] - points[b]).norm() > longest) mark(a, b);
            }
        }
        if (marked_.empty()) return true;
        split(points);
    }
    return false;
}

}  // namespace graspd::concavity_detail
