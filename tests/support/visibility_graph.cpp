#include "support/visibility_graph.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "graspd/concavity/shortest_path_concavity.hpp"
#include "support/lifted_vertices.hpp"

namespace graspd::test {
namespace {

using Eigen::Vector3d;

constexpr double kGain = 1.0 - 1e-9;  // what shortens by rounding alone is no gain

class Graph {
public:
    Graph(const TriangleMesh& mesh, const OuterHull& hull, const ExactSurface& surface)
        : mesh_(mesh),
          hull_(hull),
          surface_(surface),
          lift_m_(ConcavityConfig{}.start_offset * mesh_diagonal_m(mesh)),
          start_(lifted_vertices(mesh, lift_m_)),
          value_m_(mesh.vertices.size(), std::numeric_limits<double>::infinity()) {}

    /// Farther planes matter only where bends gave nothing shorter, so they are tried after a first
    /// Dijkstra; what they shorten is spread by further ones until nothing changes.
    std::vector<double> solve() {
        use_nearest_planes();
        do spread();
        while (use_farther_planes());
        return std::move(value_m_);
    }

private:
    double to_plane_m(std::size_t facet, const Vector3d& p) const {
        return std::max(0.0, hull_.facets[facet].offset_m - hull_.facets[facet].normal.dot(p));
    }
    void set(std::uint32_t v, double value_m) {
        value_m_[v] = value_m;
        queue_.emplace(value_m, v);
    }
    /// The last lift is left out: the object's own sides may lie in the hull's plane.
    bool sees_plane(std::uint32_t v, std::size_t facet) const {
        const double gap_m = to_plane_m(facet, start_[v]) - lift_m_;
        return gap_m <= 0.0 ||
               !surface_.blocks(start_[v], start_[v] + gap_m * hull_.facets[facet].normal);
    }
    void use_nearest_planes() {
        std::vector<char> used(mesh_.vertices.size(), 0);
        for (const Triangle& face : mesh_.faces) {
            for (const std::uint32_t v : face) used[v] = 1;
        }
        for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
            std::size_t nearest = 0;
            for (std::size_t f = 1; f < hull_.facets.size(); ++f) {
                if (to_plane_m(f, mesh_.vertices[v]) < to_plane_m(nearest, mesh_.vertices[v])) {
                    nearest = f;
                }
            }
            if (!used[v]) continue;
            if (sees_plane(v, nearest)) {
                set(v, to_plane_m(nearest, mesh_.vertices[v]));
            } else {
                open_.push_back(v);
            }
        }
    }
    void spread() {
        while (!queue_.empty()) {
            const auto [value_m, u] = queue_.top();
            queue_.pop();
            if (value_m > value_m_[u]) continue;
            for (const std::uint32_t v : open_) {
                const double by_u = value_m + (mesh_.vertices[v] - mesh_.vertices[u]).norm();
                if (by_u < value_m_[v] * kGain && !surface_.blocks(start_[v], start_[u])) {
                    set(v, by_u);
                }
            }
        }
    }
    bool use_farther_planes() {
        bool any = false;
        std::vector<std::pair<double, std::size_t>> nearer;
        for (const std::uint32_t v : open_) {
            nearer.clear();
            for (std::size_t f = 0; f < hull_.facets.size(); ++f) {
                const double distance_m = to_plane_m(f, mesh_.vertices[v]);
                if (distance_m < value_m_[v] * kGain) nearer.emplace_back(distance_m, f);
            }
            std::ranges::sort(nearer);
            for (const auto& [distance_m, facet] : nearer) {
                if (!sees_plane(v, facet)) continue;
                set(v, distance_m);
                any = true;
                break;
            }
        }
        return any;
    }

    const TriangleMesh& mesh_;
    const OuterHull& hull_;
    const ExactSurface& surface_;
    double lift_m_ = 0.0;
    std::vector<Vector3d> start_;
    std::vector<double> value_m_;
    std::vector<std::uint32_t> open_;  ///< whose nearest plane is hidden
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<double> visibility_graph_m(const TriangleMesh& mesh, const OuterHull& hull,
                                       const ExactSurface& surface) {
    return Graph(mesh, hull, surface).solve();
}

}  // namespace graspd::test
