// Every candidate ends as one grasp or as one typed reason, stage by stage, whatever the request
// asks for. The sums are those of test::planned().

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::rejections_of;

struct Shape {
    std::string name;
    TriangleMesh mesh;
};
std::vector<Shape> shapes() {
    return {{"box", test::box({0.06, 0.04, 0.08}, 500)},
            {"wide box", test::box({0.10, 0.12, 0.14}, 500)},
            {"box_hourglass", test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000)},
            {"cup", test::cup(0.045, 0.09, 0.004, 2000)},
            {"wedge", test::wedge(0.05, 0.12, 0.11, 0.10, 1000)},
            {"torus", test::torus(0.05, 0.015, 1500)},
            {"lopsided", test::lopsided(600)}};
}

struct Case {
    const char* name;
    std::function<void(PlanRequest&)> set;
    const char* reason = "";  ///< that some shape must show, or the case tests nothing
};
std::vector<Case> cases() {
    OrientedBox beside;
    beside.pose.translation() = Vector3d(0.0, 0.0, 0.12);
    beside.half_extent = Vector3d(0.08, 0.08, 0.06);
    return {{"as it is", [](PlanRequest&) {}, "axis_too_wide"},
            {"plane",
             [](PlanRequest& r) {
                 r.support_plane = SupportPlane{Vector3d::UnitZ(), -0.05};
             },
             "approach_hits_plane"},
            {"keep-out", [=](PlanRequest& r) { r.keep_out_F = {beside}; }, "palm_hits_keep_out"},
            {"obstacle",
             [=](PlanRequest& r) {
                 r.obstacles = {{test::box(2.0 * beside.half_extent), beside.pose}};
             },
             "palm_hits_obstacle"},
            {"clearance", [](PlanRequest& r) { r.options.min_clearance_m = 0.006; }, "clearance"},
            {"cone",
             [](PlanRequest& r) {
                 r.approach_cones = {{-Vector3d::UnitZ(), 0.4}};
             },
             "outside_approach_cones"},
            {"friction", [](PlanRequest& r) { r.options.friction = 0.1; }, "slips"},
            {"free on all sides", [](PlanRequest& r) { r.options.sources = kWholeObject; },
             "pose_surplus"},
            {"one grasp", [](PlanRequest& r) { r.options.max_grasps = 1; }, "surplus"},
            {"walls", [](PlanRequest& r) { r.options.sources = kWall; }, "axis_source_unwanted"},
            {"boundary", [](PlanRequest& r) { r.options.sources = kBoundary; }},
            {"pads that do not meet", [](PlanRequest& r) { r.grippers.front().min_width_m = 0.03; },
             "axis_no_contact"},
            {"two grippers",
             [](PlanRequest& r) {
                 r.grippers.insert(r.grippers.begin(), r.grippers.front());
                 r.grippers.back().name = "narrow";
                 r.grippers.back().max_width_m = 0.03;
             }},
            {"all at once", [=](PlanRequest& r) {
                 r.support_plane = SupportPlane{Vector3d::UnitZ(), -0.05};
                 r.keep_out_F = {beside};
                 r.options.min_clearance_m = 0.002;
                 r.approach_cones = {{-Vector3d::UnitZ(), 0.9}, {Vector3d::UnitX(), 0.5}};
                 r.options.sources = kWall | kBoundary;
                 r.options.want_suggestion = true;
             }}};
}

TEST(PlanCounts, AddUpStageByStage) {
    const auto all = shapes();
    for (const Case& each : cases()) {
        std::uint64_t seen = 0;
        for (const auto& [name, mesh] : all) {
            SCOPED_TRACE(std::string(each.name) + ", " + name);
            PlanRequest request = test::request_for(mesh);
            each.set(request);
            seen += rejections_of(test::planned(request), each.reason);
        }
        EXPECT_TRUE(seen > 0U || each.reason == std::string()) << each.name;
    }
}

}  // namespace
}  // namespace graspd
