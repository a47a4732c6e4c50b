// Executes one grasp of a cube of 40 mm; prints the verdict.
#include <graspd/simulate/simulate_grasp.hpp>
#include <iostream>

int main() {
    graspd::TriangleMesh cube;
    for (const double z : {-0.02, 0.02}) {
        for (const double y : {-0.02, 0.02}) {
            for (const double x : {-0.02, 0.02}) cube.vertices.emplace_back(x, y, z);
        }
    }
    cube.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    graspd::Grasp grasp;
    grasp.X_FG.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();  // from above, closing along x
    grasp.approach = {-Eigen::Vector3d::UnitZ(), 0.1};
    grasp.width_m = 0.04;
    grasp.open_width_m = 0.06;
    const auto result = graspd::simulate_grasp(cube, {}, grasp, std::nullopt, {});
    if (!result.ok()) return 1;
    std::cout << to_string(result.value().verdict) << '\n';
}
