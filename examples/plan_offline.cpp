// Plans grasps inside a program of your own: graspd::core alone, no DDS, no daemon.
//
//     plan_offline mug.stl parallel_85

#include <cstdio>
#include <iostream>

#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/mesh/read_object.hpp"
#include "graspd/planner/planner.hpp"

namespace {

int fail(const graspd::PlanError& error) {
    std::cerr << "plan_offline: " << error.detail << '\n';
    return 2;
}

void print(const graspd::PlanReply& reply) {
    std::printf("%s %s\n", graspd::to_string(reply.status), reply.message.c_str());
    for (const graspd::Grasp& grasp : reply.grasps) {
        const Eigen::Vector3d tcp_mm = 1e3 * grasp.X_FG.translation();
        const Eigen::Vector3d approach = grasp.X_FG.linear().col(2);  // Gz
        std::printf(
            "score %.3f  width %5.1f mm  TCP %7.1f %7.1f %7.1f mm  approach %5.2f %5.2f %5.2f\n",
            grasp.score, 1e3 * grasp.width_m, tcp_mm.x(), tcp_mm.y(), tcp_mm.z(), approach.x(),
            approach.y(), approach.z());
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::cerr << "usage: plan_offline FILE [GRIPPER]\n";
        return 2;
    }
    const auto object = graspd::read_object(argv[1]);
    if (!object.ok()) return fail(object.error());
    const auto profiles = graspd::find_profiles();
    if (!profiles.ok()) return fail(profiles.error());
    const auto gripper =
        graspd::find_gripper(argc > 2 ? argv[2] : "parallel_85", profiles.value() / "grippers");
    if (!gripper.ok()) return fail(gripper.error());

    graspd::PlanRequest request;
    request.request_id = "offline";
    request.frame_id = "object";
    request.object_O = object.value().object;  // [m]
    request.grippers = {gripper.value()};
    request.options.max_grasps = 5;
    const graspd::PlanReply reply = graspd::plan(request, graspd::PlannerConfig{});
    print(reply);
    return reply.grasps.empty() ? 3 : 0;
}
