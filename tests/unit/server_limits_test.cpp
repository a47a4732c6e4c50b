// Requests that ask for more than there is, and callers that have gone.

#include <gmock/gmock.h>

#include <new>

#include "make_reply.hpp"
#include "memory_fence.hpp"
#include "server_served.hpp"

namespace graspd::server {
namespace {

using namespace std::chrono_literals;
using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(MemoryLimit, WhatWouldTakeTooMuchIsRefusedByItsCounts) {
    ServerConfig config = Served::one_worker(4);
    config.max_memory_bytes = 1u << 20;
    Served served(plan_at_once, config);
    auto large = request(1, "large");
    large->counted.vertices = 12345;
    served.service.handle(std::move(large));
    served.service.handle(request(1, "small"));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kInvalidRequest, PlanStatus::kOk));
    EXPECT_THAT(
        served.written.copy()[0].reply.message,
        AllOf(HasSubstr("mesh.vertices = 12345"), HasSubstr("server.max_memory_bytes = 1048576")));
    EXPECT_EQ(served.service.counters().open, 0u);
}

// What the limits of counts let through by default, the limit of memory does too.
TEST(MemoryLimit, TheDefaultsAgree) {
    const RequestLimits limits;
    RequestSize mesh, cloud;
    mesh.vertices = limits.max_vertices;
    mesh.faces = limits.max_faces;
    mesh.obstacle_faces = limits.max_obstacle_faces;
    mesh.obstacle_vertices = limits.max_obstacle_faces / 2;
    cloud.points = limits.max_points;
    EXPECT_LE(needed_bytes(mesh), ServerConfig{}.max_memory_bytes);
    EXPECT_LE(needed_bytes(cloud), ServerConfig{}.max_memory_bytes);
    EXPECT_EQ(limits.max_vertices, PlannerConfig{}.condition_mesh.max_vertices);
    EXPECT_EQ(limits.max_faces, PlannerConfig{}.condition_mesh.max_faces);
    EXPECT_EQ(limits.max_points, PlannerConfig{}.triangulate_cloud.limit_points);
    EXPECT_EQ(limits.max_obstacle_faces, ServerConfig{}.max_obstacle_faces);
}

TEST(MemoryLimit, OutOfMemoryCostsItsRequestAlone) {
    Served served([](const PlanRequest& problem, const StopQuery& stop) {
        if (problem.request_id == "hungry") throw std::bad_alloc();
        return plan_at_once(problem, stop);
    });
    served.service.handle(request(1, "hungry"));
    served.service.handle(request(1, "modest"));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kInternalError, PlanStatus::kOk));
    EXPECT_THAT(served.written.copy()[0].reply.message, HasSubstr("out of memory"));
}

TEST(GoneCaller, ItsServiceCallsAreDroppedAndNothingElse) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request(1, "under way"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    auto call = request(2, "call");
    call->call = true;
    auto others = request(3, "other's call");
    others->call = true;
    const std::array<std::uint8_t, 16> writer = call->id.writer;
    served.service.handle(std::move(call));
    served.service.handle(std::move(others));
    served.service.handle(request(2, "by the topic"));  // any reader may wait for its reply
    EXPECT_EQ(served.service.drop(writer), 1u);
    ASSERT_TRUE(served.wait_for(1));
    EXPECT_EQ(served.written.copy()[0].reply.request_id, "call");
    EXPECT_EQ(served.statuses()[0], PlanStatus::kCancelled);
    EXPECT_EQ(served.service.counters().dropped, 1u);
    EXPECT_EQ(served.service.drop(writer), 0u);
    planner.release();
    ASSERT_TRUE(served.wait_for(4));
    EXPECT_EQ(planner.calls(), 3);
}

}  // namespace
}  // namespace graspd::server
