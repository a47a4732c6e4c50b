// What the planner knows of given grasps, for calibrating the score (bench/fit_score).
//
//   grasp_evidence MESH PLAN.json [FRICTION [MASS_KG [PLANNER.yaml]]]
//
// PLAN.json is what `graspctl plan --format json` wrote. One line a grasp: its index and the
// features that the score weighs, or its index alone where the planner would reject the pose.
#include <cstdio>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "evaluate_pose.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/mesh/read_object.hpp"
#include "value_of.hpp"

namespace {

using namespace graspd;
using namespace graspd::planner_detail;
using bench::value_of;

Eigen::Isometry3d pose_of(const nlohmann::json& grasp) {
    Eigen::Isometry3d X_OG = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i) {
        X_OG.translation()[i] = grasp["position"][i];
        for (int j = 0; j < 3; ++j) X_OG.linear()(i, j) = grasp["rotation"][3 * i + j];
    }
    return X_OG;
}

ClosingAxis axis_of(const nlohmann::json& grasp, const Eigen::Isometry3d& X_PO) {
    return axis_through(X_PO * pose_of(grasp), grasp["width"].get<double>());
}

double mass_of(const char* text, const PreparedObject& object) {
    return text && *text ? std::atof(text) : std::clamp(500.0 * object.volume_m3, 0.02, 0.5);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::cerr << "usage: grasp_evidence MESH PLAN.json [FRICTION [MASS_KG [PLANNER.yaml]]]\n";
        return 2;
    }
    PlannerConfig config;
    if (argc > 5) config = value_of(load_config<PlannerConfig>(argv[5]));
    StageLog log;
    const auto plan = nlohmann::json::parse(std::ifstream(argv[2]));
    PlanRequest request;
    request.options.friction = argc > 3 ? std::atof(argv[3]) : 0.6;
    const Gripper gripper =
        value_of(find_gripper(plan["gripper"]["name"], value_of(find_profiles()) / "grippers"));
    const PreparedObject object =
        value_of(prepare_object(value_of(read_object(argv[1])).object, config, log));
    const Surroundings surroundings(request, object, object.X_OP.inverse());
    const Judgement judgement{request,
                              object,
                              surroundings.world(),
                              gripper,
                              config,
                              object.X_OP,
                              object.center_of_mass_P,
                              mass_of(argc > 4 ? argv[4] : nullptr, object),
                              Eigen::Vector3d(-object.X_OP.linear().row(2).transpose())};
    int index = 0;
    for (const auto& grasp : plan["grasps"]) {
        Rejections rejections;
        const auto graded =
            evaluate_pose(axis_of(grasp, object.X_OP.inverse()), {}, judgement, rejections, log);
        std::printf("%d", index++);
        if (graded) {
            const GraspEvidence& e = graded->evidence;
            std::printf(" %.6g %.6g %.6g %.6g %.6g %.6g %.6g", e.min_friction, e.friction,
                        e.beta_rad, e.loads.slip, e.loads.torsion, e.loads.tilt, e.contact_share);
        }
        std::printf("\n");
    }
}
