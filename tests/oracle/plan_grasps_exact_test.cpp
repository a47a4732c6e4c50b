// The hand of every grasp that a plan returns, on its way and while it closes, against CGAL's exact
// predicates over every triangle.

#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <string>
#include <vector>

#include "graspd/planner/planner.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Eigen::Vector3d;

constexpr double kSkin_m = 2e-6;  // what FCL and the tree's tolerance may miss

/// A part of parallel_85 in G.
struct Part {
    Vector3d low, high;
};
std::vector<Part> hand(double opening_m) {
    const double inner = 0.5 * opening_m, outer = inner + 0.01;
    return {{{-0.06, -0.02, -0.115}, {0.06, 0.02, -0.035}},
            {{-outer, -0.01, -0.035}, {-inner, 0.01, 0.01}},
            {{inner, -0.01, -0.035}, {outer, 0.01, 0.01}}};
}

Kernel::Point_3 point(const Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

/// Whether the hand, moved back by `back_m` from the grasp, meets a face.
bool meets(const TriangleMesh& mesh_G, double opening_m, double back_m) {
    const Vector3d back(0, 0, back_m), skin = Vector3d::Constant(kSkin_m);
    for (const Part& part : hand(opening_m)) {
        const Kernel::Iso_cuboid_3 box(point(part.low - back + skin),
                                       point(part.high - back - skin));
        for (const Triangle& t : mesh_G.faces) {
            const Kernel::Triangle_3 face(point(mesh_G.vertices[t[0]]),
                                          point(mesh_G.vertices[t[1]]),
                                          point(mesh_G.vertices[t[2]]));
            if (CGAL::do_intersect(box, face)) return true;
        }
    }
    return false;
}

struct Shape {
    std::string name;
    TriangleMesh mesh;
};
std::vector<Shape> shapes() {
    std::vector<Shape> list = {
        {"box_hourglass", test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 400)},
        {"cup", test::cup(0.04, 0.09, 0.004, 1000)},
        {"torus", test::torus(0.05, 0.015, 1000)},
        {"dumbbell", test::dumbbell(0.03, 0.01, 0.12, 1000)},
        {"lopsided", test::lopsided(400)},
        {"wedge", test::wedge(0.03, 0.06, 0.05, 0.08, 400)}};
    for (Shape& shape : list) shape.mesh = test::moved(shape.mesh, test::random_pose(12));
    return list;
}

TEST(PlanGraspsOracle, TheHandMeetsNoFaceOnItsWayOrWhileItCloses) {
    const PlannerConfig config;
    const double tolerance_m = 2.0 * config.manipulability.closing_tolerance_m;
    for (const auto& [name, mesh] : shapes()) {
        PlanRequest request = test::request_for(mesh);
        request.options.max_grasps = 20;
        const PlanReply reply = plan(request, config);
        ASSERT_EQ(reply.status, PlanStatus::kOk) << name << ": " << reply.message;
        for (std::size_t i = 0; i < reply.grasps.size(); ++i) {
            const Grasp& grasp = reply.grasps[i];
            const TriangleMesh mesh_G = test::moved(mesh, grasp.X_FG.inverse());
            for (int step = 0; step <= 10; ++step) {
                EXPECT_FALSE(meets(mesh_G, grasp.open_width_m, 0.01 * step))
                    << name << " grasp " << i << " at " << step << " cm";
                const double closed_m = grasp.width_m + tolerance_m;
                const double opening_m = closed_m + 0.1 * step * (grasp.open_width_m - closed_m);
                EXPECT_FALSE(meets(mesh_G, opening_m, 0.0))
                    << name << " grasp " << i << " open by " << opening_m;
            }
            // Closed a little further than the contact the fingers meet it: it is there.
            EXPECT_TRUE(meets(mesh_G, grasp.width_m - 1e-4, 0.0)) << name << " grasp " << i;
        }
    }
}

}  // namespace
}  // namespace graspd
