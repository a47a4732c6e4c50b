#include "grasp_conventions.hpp"
#include "json_values.hpp"
#include "write_exports.hpp"

namespace graspd::cli {
namespace {

/// Row by row.
Json matrix(const Eigen::Isometry3d& pose) {
    Json rows = Json::array();
    for (Eigen::Index row = 0; row < 4; ++row) {
        Json entries = Json::array();
        for (Eigen::Index column = 0; column < 4; ++column) {
            entries.push_back(pose.matrix()(row, column));
        }
        rows.push_back(std::move(entries));
    }
    return rows;
}

}  // namespace

Result<std::string> write_graspgen_json(const GraspFile& file, const ExportOptions& options) {
    if (options.object.empty()) {
        return PlanError{
            PlanErrorCode::kInvalidInput,
            "format graspgen needs --object FILE, the mesh's path in GraspGen's object "
            "data set"};
    }
    if (auto error = check_one_gripper(file, "graspgen")) return *std::move(error);
    Json transforms = Json::array(), held = Json::array(), scores = Json::array();
    for (const Grasp& grasp : file.grasps) {
        const double depth_m = (grasp.X_FH.inverse() * grasp.X_FG).translation().z();
        transforms.push_back(matrix(tcp_to_graspgen(grasp.X_FG, depth_m)));
        held.push_back(true);
        scores.push_back(grasp.score);
    }
    const std::string gripper = file.grasps.empty() ? "" : file.grasps[0].gripper_name;
    const Json json = {{"object", {{"file", options.object}, {"scale", options.object_scale}}},
                       {"gripper", {{"name", gripper}}},
                       {"grasps",
                        {{"transforms", std::move(transforms)},
                         {"object_in_gripper", std::move(held)},
                         {"score", std::move(scores)}}}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace graspd::cli
