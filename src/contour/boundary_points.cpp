#include "graspd/contour/boundary_points.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

std::optional<PlanError> check_loop(const char* name, std::span<const Eigen::Vector2d> loop) {
    if (auto bad = check_finite(name, loop)) return bad;
    if (loop.size() >= 3) return std::nullopt;
    return PlanError{
        PlanErrorCode::kDegenerate,
        std::string(name) + " has " + std::to_string(loop.size()) + " points, a loop has 3"};
}

/// A loop's edges, asked for feet of perpendiculars.
class Edges {
public:
    Edges(std::span<const Eigen::Vector2d> loop, double within_m) : within_m_(within_m) {
        edges_.reserve(loop.size());
        for (std::size_t m = 0; m < loop.size(); ++m) {
            const Eigen::Vector2d edge = loop[(m + 1) % loop.size()] - loop[m];
            const double reach_m = within_m + edge.norm();
            edges_.push_back({loop[m], edge, kReachTie * reach_m * reach_m});
        }
    }
    /// Whether a foot of a perpendicular from `n` lies nearer than `within_m`.
    bool is_near(const Eigen::Vector2d& n) const {
        return std::ranges::any_of(edges_, [&](const Edge& e) {
            const Eigen::Vector2d arm = n - e.start;
            if (arm.squaredNorm() > e.reach_m2) return false;
            const double length_m2 = e.edge.squaredNorm();
            const double t = length_m2 > 0.0 ? arm.dot(e.edge) / length_m2 : 0.0;
            if (t < 0.0 || t > 1.0) return false;
            return (e.start + t * e.edge - n).norm() < within_m_;
        });
    }

private:
    static constexpr double kReachTie = 1.0 + 1e-6;  // rounding leaves no foot out

    struct Edge {
        Eigen::Vector2d start, edge;
        double reach_m2;  ///< square of the farthest from `start` that a point with a near foot is
    };
    std::vector<Edge> edges_;
    double within_m_;
};

}  // namespace

Result<std::vector<Eigen::Vector2d>> boundary_points(
    std::span<const Eigen::Vector2d> cluster_outline,
    std::span<const Eigen::Vector2d> enlarged_outline, double spacing_m,
    const BoundaryPointsConfig& config) {
    if (auto bad = validate(config, "boundary_points.")) return *bad;
    if (auto bad = check_positive("boundary_points: spacing_m", spacing_m)) return *bad;
    if (auto bad = check_loop("boundary_points: cluster_outline", cluster_outline)) return *bad;
    if (auto bad = check_loop("boundary_points: enlarged_outline", enlarged_outline)) return *bad;
    const Edges enlarged(enlarged_outline, config.d_threshold_spacings * spacing_m);
    std::vector<Eigen::Vector2d> boundary;
    std::ranges::copy_if(cluster_outline, std::back_inserter(boundary),
                         [&](const Eigen::Vector2d& n) { return enlarged.is_near(n); });
    return boundary;
}

}  // namespace graspd
