#include "check_request.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace graspd::planner_detail {
namespace {

constexpr double kUnit = 1e-3;  // how far a rotation or a unit vector may be off by rounding

template <class... Parts>
PlanError invalid(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return PlanError{PlanErrorCode::kInvalidInput, text.str()};
}

std::optional<PlanError> check_range(const char* field, double value, double least,
                                     double greatest) {
    if (value >= least && value <= greatest) return std::nullopt;
    return invalid(field, " = ", value, " is outside [", least, ", ", greatest, "]");
}

std::optional<PlanError> check_pose(const std::string& field, const Eigen::Isometry3d& pose) {
    const Eigen::Matrix3d rotation = pose.linear();
    const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm();
    const bool proper = off <= kUnit && rotation.determinant() > 0.0;
    if (pose.translation().allFinite() && proper) return std::nullopt;
    return invalid(field, " is no pose: position (", pose.translation().transpose(),
                   "), rotation off by ", off);
}

std::optional<PlanError> check_unit(const std::string& field, const Eigen::Vector3d& vector) {
    if (std::abs(vector.norm() - 1.0) <= kUnit) return std::nullopt;
    return invalid(field, " = (", vector.transpose(), ") is not of unit length");
}

std::optional<PlanError> check_options(const PlanOptions& options) {
    const double infinity = std::numeric_limits<double>::max();
    if (auto bad = check_range("options.max_grasps", options.max_grasps, 1, 1e6)) return bad;
    if (auto bad = check_range("options.time_budget", options.time_budget_s, 1e-6, infinity))
        return bad;
    if (auto bad = check_range("options.friction", options.friction, 1e-3, 100.0)) return bad;
    if (auto bad = check_range("options.min_clearance", options.min_clearance_m, 0.0, 1.0))
        return bad;
    if (auto bad = check_range("options.mass", options.mass_kg.value_or(1.0), 1e-6, 1e4))
        return bad;
    if (auto bad = check_range("options.grip_force", options.grip_force_N, 1e-3, 1e5)) return bad;
    if (auto bad = check_range("options.sources", options.sources, 0, kAllSources)) return bad;
    if (options.center_of_mass_O && !options.center_of_mass_O->allFinite()) {
        return invalid("options.center_of_mass = (", options.center_of_mass_O->transpose(),
                       ") is not finite");
    }
    if (options.gravity_F && !(std::abs(options.gravity_F->norm() - 1.0) < 1e-3)) {
        return invalid("options.gravity = (", options.gravity_F->transpose(),
                       ") is not of unit length");
    }
    return std::nullopt;
}

std::optional<PlanError> check_obstacle(const Obstacle& obstacle, std::size_t index) {
    const std::string field = "obstacles[" + std::to_string(index) + "]";
    if (auto bad = check_pose(field + ".pose", obstacle.X_FO)) return bad;
    for (std::size_t i = 0; i < obstacle.mesh.vertices.size(); ++i) {
        const Eigen::Vector3d& vertex = obstacle.mesh.vertices[i];
        if (vertex.allFinite()) continue;
        return invalid(field, ".mesh vertex ", i, " = (", vertex.transpose(), ") is not finite");
    }
    for (std::size_t i = 0; i < obstacle.mesh.faces.size(); ++i) {
        for (const std::uint32_t v : obstacle.mesh.faces[i]) {
            if (v < obstacle.mesh.vertices.size()) continue;
            return invalid(field, ".mesh face ", i, " uses vertex ", v, " of ",
                           obstacle.mesh.vertices.size());
        }
    }
    return std::nullopt;
}

std::optional<PlanError> check_surroundings(const PlanRequest& request) {
    if (request.support_plane) {
        if (auto bad = check_unit("support_plane.normal", request.support_plane->normal_F))
            return bad;
        if (!std::isfinite(request.support_plane->offset_m)) {
            return invalid("support_plane.offset = ", request.support_plane->offset_m,
                           " is not finite");
        }
    }
    for (std::size_t i = 0; i < request.obstacles.size(); ++i) {
        if (auto bad = check_obstacle(request.obstacles[i], i)) return bad;
    }
    for (std::size_t i = 0; i < request.approach_cones.size(); ++i) {
        const std::string field = "approach_cones[" + std::to_string(i) + "]";
        const ApproachCone& cone = request.approach_cones[i];
        if (auto bad = check_unit(field + ".axis", cone.axis_F)) return bad;
        const double angle = cone.half_angle_rad;
        if (!(angle > 0.0 && angle <= std::numbers::pi)) {
            return invalid(field, ".half_angle = ", angle, " is outside (0, pi]");
        }
    }
    for (std::size_t i = 0; i < request.keep_out_F.size(); ++i) {
        const std::string field = "keep_out[" + std::to_string(i) + "]";
        if (auto bad = check_pose(field + ".pose", request.keep_out_F[i].pose)) return bad;
        const Eigen::Vector3d& half = request.keep_out_F[i].half_extent;
        if (!half.allFinite() || half.minCoeff() <= 0.0) {
            return invalid(field, ".half_extent = (", half.transpose(), ") is not above 0");
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<PlanError> check_request(const PlanRequest& request) {
    if (request.grippers.empty()) return invalid("grippers is empty: at least one is needed");
    for (std::size_t i = 0; i < request.grippers.size(); ++i) {
        if (auto bad = validate(request.grippers[i])) return bad;
        const std::string& name = request.grippers[i].name;
        for (std::size_t j = 0; j < i; ++j) {
            if (request.grippers[j].name != name) continue;
            return invalid("grippers[", i, "].name = \"", name, "\" is also that of grippers[", j,
                           "]: a grasp tells its gripper by name");
        }
    }
    if (auto bad = check_pose("object_pose", request.X_FO)) return bad;
    for (std::size_t i = 0; i < request.candidates_FH.size(); ++i) {
        const std::string field = "candidates[" + std::to_string(i) + "]";
        if (auto bad = check_pose(field, request.candidates_FH[i])) return bad;
    }
    if (auto bad = check_options(request.options)) return bad;
    return check_surroundings(request);
}

}  // namespace graspd::planner_detail
