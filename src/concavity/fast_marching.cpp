#include "fast_marching.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/LU>

#include "graspd/base/stop.hpp"

namespace graspd::concavity_detail {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Square of a tetrahedron's volume (a triangle's area) over its edges' lengths from the corner;
// flatter ones are left to their faces: their direction would be lost in rounding.
constexpr double kLeastFlatness = 1e-8;

/// Value at the origin of a plane front that has `value` at the ends of K edges.
/// @return +infinity when the front does not come through their span's inside or is not causal
template <int K>
double plane_front(const Eigen::Matrix<double, 3, K>& edges,
                   const Eigen::Matrix<double, K, 1>& value) {
    using Square = Eigen::Matrix<double, K, K>;
    using Column = Eigen::Matrix<double, K, 1>;
    const Square gram = edges.transpose() * edges;
    if (!(gram.determinant() > kLeastFlatness * gram.diagonal().prod())) return kInfinity;
    const Square inverse = gram.inverse();
    // |gradient| = 1 with gradient . edge_i = value_i - d: a quadratic equation for d, from the
    // least value on to keep digits.
    const double least = value.minCoeff();
    const Column rise = value - Column::Constant(least);
    const Column one = Column::Ones();
    const double a = one.dot(inverse * one);
    const double b = one.dot(inverse * rise);
    const double c = rise.dot(inverse * rise) - 1.0;
    const double root = b * b - a * c;
    if (root < 0.0) return kInfinity;
    const double d = (b + std::sqrt(root)) / a;
    const Column share = inverse * (d * one - rise);
    if (share.minCoeff() < 0.0 || d < rise.maxCoeff()) return kInfinity;
    return least + d;
}

class Front {
public:
    Front(const Tetrahedra& space, const FrontSources& sources);
    std::vector<double> march();

private:
    using QueueItem = std::pair<double, std::uint32_t>;

    void pass_on(std::uint32_t from, const std::array<std::uint32_t, 4>& cell);
    bool is_chord(std::uint32_t a, std::uint32_t b) const;
    double value_at(std::uint32_t to, std::uint32_t from,
                    const std::array<std::uint32_t, 4>& cell) const;

    const Tetrahedra& space_;
    const FrontSources& sources_;
    std::vector<std::uint32_t> start_, cell_;  ///< cells of each point, in compressed rows
    std::vector<double> value_;
    std::vector<char> final_;
    std::priority_queue<QueueItem, std::vector<QueueItem>, std::greater<>> queue_;
};

Front::Front(const Tetrahedra& space, const FrontSources& sources)
    : space_(space),
      sources_(sources),
      start_(space.points.size() + 1, 0),
      cell_(4 * space.cells.size()),
      value_(space.points.size(), kInfinity),
      final_(space.points.size(), 0) {
    for (const auto& cell : space.cells) {
        for (const std::uint32_t p : cell) ++start_[p + 1];
    }
    for (std::size_t p = 0; p < space.points.size(); ++p) start_[p + 1] += start_[p];
    std::vector<std::uint32_t> end(start_.begin(), start_.end() - 1);
    for (std::uint32_t c = 0; c < space.cells.size(); ++c) {
        for (const std::uint32_t p : space.cells[c]) cell_[end[p]++] = c;
    }
    for (std::uint32_t p = 0; p < space.points.size(); ++p) {
        if (!sources.is_source[p]) continue;
        value_[p] = 0.0;
        queue_.emplace(0.0, p);
    }
}

bool Front::is_chord(std::uint32_t a, std::uint32_t b) const {
    return sources_.is_source[a] && sources_.is_source[b] &&
           sources_.chords.contains(edge_key(a, b));
}

/// The least value that `to` gets through a corner, an edge or the face of the cell that holds
/// `from` and other final points.
double Front::value_at(std::uint32_t to, std::uint32_t from,
                       const std::array<std::uint32_t, 4>& cell) const {
    const Vector3d& origin = space_.points[to];
    Eigen::Matrix3d edges;
    Vector3d value;
    edges.col(0) = space_.points[from] - origin;
    value[0] = value_[from];
    Eigen::Index count = 1;
    std::array<std::uint32_t, 2> other{};
    for (const std::uint32_t p : cell) {
        if (p == to || p == from || !final_[p] || is_chord(from, p)) continue;
        edges.col(count) = space_.points[p] - origin;
        other[static_cast<std::size_t>(count - 1)] = p;
        value[count++] = value_[p];
    }
    if (count == 3 && !is_chord(other[0], other[1])) {
        const double through_face = plane_front<3>(edges, value);
        if (through_face < kInfinity) return through_face;  // no border of it is shorter
    }
    double least = value[0] + edges.col(0).norm();
    for (Eigen::Index k = 1; k < count; ++k) {
        Eigen::Matrix<double, 3, 2> pair;
        pair << edges.col(0), edges.col(k);
        least = std::min(least, plane_front<2>(pair, {value[0], value[k]}));
    }
    return least;
}

void Front::pass_on(std::uint32_t from, const std::array<std::uint32_t, 4>& cell) {
    for (const std::uint32_t to : cell) {
        if (final_[to]) continue;
        const double value = value_at(to, from, cell);
        if (value >= value_[to]) continue;
        value_[to] = value;
        queue_.emplace(value, to);
    }
}

std::vector<double> Front::march() {
    std::size_t step = 0;
    while (!queue_.empty()) {
        stop_point(step++);
        const auto [value, point] = queue_.top();
        queue_.pop();
        if (final_[point]) continue;
        final_[point] = 1;
        for (std::uint32_t i = start_[point]; i < start_[point + 1]; ++i) {
            pass_on(point, space_.cells[cell_[i]]);
        }
    }
    return std::move(value_);
}

}  // namespace

std::vector<double> march_front(const Tetrahedra& space, const FrontSources& sources) {
    return Front(space, sources).march();
}

}  // namespace graspd::concavity_detail
