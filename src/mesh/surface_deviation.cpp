#include "surface_deviation.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "graspd/mesh/surface_distance.hpp"

namespace graspd::mesh_detail {
namespace {

constexpr std::size_t kMostMeasured = 20000;

}  // namespace

Finding measure_deviation(const std::vector<Eigen::Vector3d>& points, const TriangleMesh& mesh,
                          const std::vector<std::int32_t>& vertex_of_point) {
    std::vector<char> is_corner(mesh.vertices.size(), 0);
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) is_corner[vertex] = 1;
    }
    std::size_t counted = 0;
    std::vector<std::size_t> beside;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (vertex_of_point[i] < 0) continue;
        ++counted;
        const auto vertex = static_cast<std::size_t>(vertex_of_point[i]);
        if (!is_corner[vertex] || mesh.vertices[vertex] != points[i]) beside.push_back(i);
    }
    double farthest_m = 0.0, sum_m = 0.0;
    const std::size_t stride = 1 + beside.size() / kMostMeasured;
    std::size_t measured = 0;
    if (!beside.empty()) {
        const SurfaceDistance surface(mesh);
        for (std::size_t k = 0; k < beside.size(); k += stride, ++measured) {
            const double distance_m =
                surface.to(points[beside[k]], std::numeric_limits<double>::infinity());
            farthest_m = std::max(farthest_m, distance_m);
            sum_m += distance_m;
        }
    }
    std::ostringstream text;
    text << farthest_m << " m is the greatest distance of the " << counted
         << " points that count from the surface; " << beside.size() << " are no corner of it";
    if (measured < beside.size()) text << ", " << measured << " of them measured";
    if (measured > 0) text << ", on average " << sum_m / static_cast<double>(measured) << " m off";
    return {"surface_deviation", farthest_m, text.str()};
}

}  // namespace graspd::mesh_detail
