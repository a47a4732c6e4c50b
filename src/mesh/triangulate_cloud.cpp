#include "graspd/mesh/triangulate_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <Eigen/Eigenvalues>

#include "cloud_surface.hpp"
#include "drop_outliers.hpp"
#include "graspd/base/settings.hpp"
#include "plan_error_text.hpp"
#include "surface_deviation.hpp"
#include "thin_cloud.hpp"

namespace graspd {
namespace {

using mesh_detail::error;

using namespace mesh_detail;

constexpr std::size_t kLeastPoints = 10;
// Thinner clouds are flat up to the rounding of float coordinates [1] of the diagonal.
constexpr double kLeastThickness = 1e-6;
constexpr double kLeastReach = 4e-6;  // [1] of the diagonal: a grid's cell

std::vector<Finding> findings_of(const ThinnedCloud& cloud) {
    std::vector<Finding> findings;
    const auto add = [&](const char* code, std::size_t count, const std::string& detail) {
        if (count == 0) return;
        findings.push_back({code, static_cast<double>(count), std::to_string(count) + detail});
    };
    add("points_not_finite", cloud.not_finite, " points were not finite and dropped");
    add("points_duplicate", cloud.duplicate, " points stood where an earlier one stands");
    std::ostringstream cubes;
    cubes << " points stand behind another one of their cube of " << cloud.cube_m << " m";
    add("points_thinned", cloud.thinned, cubes.str());
    return findings;
}

/// Standard deviation across the thinnest direction.
double thickness(const std::vector<Eigen::Vector3d>& points) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) mean += point;
    mean /= static_cast<double>(points.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& point : points) {
        scatter += (point - mean) * (point - mean).transpose();
    }
    // The singular vector's own residuals: the eigenvalue itself is lost in rounding near zero.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    double sum = 0.0;
    for (const Eigen::Vector3d& point : points) {
        const double height = normal.dot(point - mean);
        sum += height * height;
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Centred and divided by the diagonal: PCL works in float, CGAL's constructions round.
std::vector<Eigen::Vector3d> to_unit(const std::vector<Eigen::Vector3d>& points,
                                     const Eigen::AlignedBox3d& box) {
    const Eigen::Vector3d center = box.center();
    const double diagonal_m = box.diagonal().norm();
    std::vector<Eigen::Vector3d> unit;
    unit.reserve(points.size());
    for (const Eigen::Vector3d& point : points) unit.push_back((point - center) / diagonal_m);
    return unit;
}

/// Vertices that no triangle uses: outliers, mostly.
std::size_t count_unused(const TriangleMesh& mesh) {
    std::vector<char> used(mesh.vertices.size(), 0);
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) used[vertex] = 1;
    }
    return static_cast<std::size_t>(std::ranges::count(used, 0));
}

/// Points of about unit size, and what undoes it.
struct UnitCloud {
    std::vector<Eigen::Vector3d> points;
    double diagonal_m = 0.0;
    double spacing = 0.0;  ///< [1] median, in diagonals
};

Result<UnitCloud> to_unit_cloud(const std::vector<Eigen::Vector3d>& points) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) box.extend(point);
    UnitCloud unit{to_unit(points, box), box.diagonal().norm(), 0.0};
    const double thick = thickness(unit.points);
    if (thick < kLeastThickness) {
        return error(PlanErrorCode::kDegenerate, "cloud of ", points.size(),
                     " points is flat: its thickness over its diagonal ", unit.diagonal_m, " m is ",
                     thick, ", least ", kLeastThickness);
    }
    const Result<double> spacing = median_spacing(unit.points);
    if (!spacing) return spacing.error();
    unit.spacing = spacing.value();
    return unit;
}

/// Drops what the sensor left in the air. @return the unit cloud of what is left
Result<UnitCloud> drop_outliers(ThinnedCloud& cloud, UnitCloud unit,
                                const TriangulateCloudConfig& config,
                                std::vector<Finding>& findings) {
    if (config.outlier_spacings <= 0.0) return unit;
    const double reach = std::max(config.outlier_spacings * unit.spacing, kLeastReach);
    const Outliers outliers = find_outliers(unit.points, reach, config.outlier_group);
    if (outliers.count == 0) return unit;
    keep_points(outliers.keep, cloud);
    if (cloud.points.size() < kLeastPoints) {
        return error(PlanErrorCode::kInvalidInput, "cloud has ", cloud.points.size(),
                     " points that hang together, at least ", kLeastPoints, " are needed");
    }
    std::ostringstream text;
    text << outliers.count << " points in groups of fewer than " << config.outlier_group
         << " that keep " << reach * unit.diagonal_m << " m from all others were dropped";
    findings.push_back({"outliers_removed", static_cast<double>(outliers.count), text.str()});
    return to_unit_cloud(cloud.points);
}

Result<TriangulatedCloud> triangulate(ThinnedCloud cloud, const TriangulateCloudConfig& config) {
    TriangulatedCloud result;
    result.findings = findings_of(cloud);
    auto whole = to_unit_cloud(cloud.points);
    if (!whole) return whole.error();
    const auto unit = drop_outliers(cloud, std::move(whole).value(), config, result.findings);
    if (!unit) return unit.error();
    const std::vector<Eigen::Vector3d>& points = unit.value().points;
    auto faces = config.greedy_projection ? project_greedily(points, unit.value().spacing, config)
                                          : advance_front(points);
    if (!faces) return faces.error();
    if (faces.value().empty()) {
        return error(PlanErrorCode::kDegenerate, "no triangle came of the cloud's ", points.size(),
                     " points");
    }
    result.mesh = {std::move(cloud.points), std::move(faces).value()};
    result.vertex_of_point = std::move(cloud.kept_of_input);
    result.spacing_m = unit.value().spacing * unit.value().diagonal_m;
    if (const std::size_t unused = count_unused(result.mesh)) {
        result.findings.push_back({"points_unused", static_cast<double>(unused),
                                   std::to_string(unused) + " points belong to no triangle"});
    }
    return result;
}

}  // namespace

Result<TriangulatedCloud> triangulate_cloud(const PointCloud& cloud,
                                            const TriangulateCloudConfig& config) {
    if (auto bad = validate(config, "triangulate_cloud.")) return *bad;
    if (cloud.points.empty()) return error(PlanErrorCode::kInvalidInput, "cloud is empty");
    if (cloud.points.size() > config.limit_points) {
        return error(PlanErrorCode::kTooLarge, "cloud has ", cloud.points.size(),
                     " points, limit limit_points = ", config.limit_points);
    }
    ThinnedCloud thinned = thin_cloud(cloud.points, config.max_points);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : thinned.points) box.extend(point);
    if (!box.isEmpty() && !std::isfinite(box.diagonal().squaredNorm())) {
        return error(PlanErrorCode::kInvalidInput, "cloud extent ", box.sizes().maxCoeff(),
                     " m: its bounding box is too large to measure");
    }
    if (thinned.points.size() < kLeastPoints) {
        return error(PlanErrorCode::kInvalidInput, "cloud has ", thinned.points.size(),
                     " finite distinct points of ", cloud.points.size(), ", at least ",
                     kLeastPoints, " are needed");
    }
    auto surface = triangulate(std::move(thinned), config);
    if (!surface) return surface.error();
    surface.value().findings.push_back(
        measure_deviation(cloud.points, surface.value().mesh, surface.value().vertex_of_point));
    return surface;
}

}  // namespace graspd
