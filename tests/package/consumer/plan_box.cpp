// Plans grasps on a box of 40 x 60 x 80 mm with the installed library.
#include <iostream>

#include "graspd/config/load_gripper.hpp"
#include "graspd/planner/planner.hpp"

namespace {

graspd::TriangleMesh box(const Eigen::Vector3d& half_extent) {
    graspd::TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d sign((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
        mesh.vertices.emplace_back(sign.cwiseProduct(half_extent));
    }
    mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto gripper = graspd::load_gripper(argv[1]);
    if (!gripper.ok()) {
        std::cerr << gripper.error().detail << '\n';
        return 2;
    }
    graspd::PlanRequest request;
    request.request_id = "box";
    request.object_O = box({0.02, 0.03, 0.04});
    request.grippers = {gripper.value()};
    const graspd::PlanReply reply = graspd::plan(request, {});
    std::cout << graspd::to_string(reply.status) << ' ' << reply.grasps.size() << '\n';
}
