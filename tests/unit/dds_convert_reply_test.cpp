#include "convert_reply.hpp"

#include <gmock/gmock.h>

#include "support/plan_samples.hpp"

namespace graspd::dds {
namespace {

using test::expect_same;
using test::full_reply;
using testing::HasSubstr;

ReplyEnvelope envelope() {
    ReplyEnvelope out;
    out.header.frame_id("table");
    out.header.stamp().sec(17);
    out.header.stamp().nanosec(23);
    for (std::size_t i = 0; i < 16; ++i) out.request_writer[i] = static_cast<std::uint8_t>(i + 1);
    out.client_id = "client";
    out.request_id = "a request";
    out.attempt = 3;
    out.planner_id = "planner";
    out.planner_version = "1.2.3";
    out.config_hash = "fedcba9876543210";
    return out;
}

TEST(ConvertReply, EveryFieldComesBack) {
    const auto back = read_reply(write_reply(full_reply(), envelope()));
    ASSERT_TRUE(back.ok()) << back.error().detail;
    expect_same(full_reply(), back.value());
}

TEST(ConvertReply, EnvelopeGoesAlong) {
    const auto reply = write_reply(full_reply(), envelope());
    EXPECT_EQ(reply.header().frame_id(), "table");
    EXPECT_EQ(reply.header().stamp().sec(), 17);
    EXPECT_EQ(reply.header().stamp().nanosec(), 23u);
    EXPECT_EQ(reply.request_writer(), envelope().request_writer);
    EXPECT_EQ(reply.client_id(), "client");
    EXPECT_EQ(reply.request_id(), "a request");
    EXPECT_EQ(reply.attempt(), 3u);
    EXPECT_EQ(reply.planner_id(), "planner");
    EXPECT_EQ(reply.planner_version(), "1.2.3");
    EXPECT_EQ(reply.config_hash(), "fedcba9876543210");
    EXPECT_EQ(reply.score_kind(), "calibrated");
    EXPECT_EQ(reply.convention(), "tcp_z_approach_x_closing");
}

// The numbers of PlanStatus are those of the IDL.
TEST(ConvertReply, EveryStatusHasItsNumber) {
    namespace status = wire::RankedGrasps__Constants;
    const std::pair<PlanStatus, std::uint8_t> rows[] = {
        {PlanStatus::kOk, status::STATUS_OK_},
        {PlanStatus::kNoGrasp, status::STATUS_NO_GRASP_},
        {PlanStatus::kPartial, status::STATUS_PARTIAL_},
        {PlanStatus::kInvalidRequest, status::STATUS_INVALID_REQUEST_},
        {PlanStatus::kUnknownObject, status::STATUS_UNKNOWN_OBJECT_},
        {PlanStatus::kUnknownGripper, status::STATUS_UNKNOWN_GRIPPER_},
        {PlanStatus::kOverloaded, status::STATUS_OVERLOADED_},
        {PlanStatus::kCancelled, status::STATUS_CANCELLED_},
        {PlanStatus::kInternalError, status::STATUS_INTERNAL_ERROR_}};
    for (const auto& [plan, number] : rows) {
        PlanReply reply;
        reply.status = plan;
        const auto on_wire = write_reply(reply, envelope());
        EXPECT_EQ(on_wire.status(), number);
        EXPECT_EQ(read_reply(on_wire).value().status, plan);
    }
    EXPECT_EQ(kBoundary, wire::PlanOptions__Constants::SOURCE_BOUNDARY_);
    EXPECT_EQ(kWall, wire::PlanOptions__Constants::SOURCE_WALL_);
    EXPECT_EQ(kWholeObject, wire::PlanOptions__Constants::SOURCE_WHOLE_OBJECT_);
}

TEST(ConvertReply, QuaternionsHaveAPositiveRealPart) {
    PlanReply reply = full_reply();
    for (int i = 0; i < 36; ++i) {
        reply.grasps[0].X_FG.linear() =
            Eigen::AngleAxisd(0.2 * i, Eigen::Vector3d(1, 2, 2) / 3.0).toRotationMatrix();
        EXPECT_GE(write_reply(reply, envelope()).grasps()[0].pose().orientation().w(), 0.0);
    }
}

TEST(ConvertReply, OnlyThreeNearMissesFit) {
    PlanReply reply = full_reply();
    reply.report.near_misses.push_back(reply.report.near_misses[0]);
    EXPECT_EQ(write_reply(reply, envelope()).report().near_misses().size(), 3u);
}

TEST(ConvertReply, WhatThisVersionDoesNotKnowIsRefused) {
    const auto good = write_reply(full_reply(), envelope());
    const auto error_of = [](const wire::RankedGrasps_& reply) {
        const auto read = read_reply(reply);
        EXPECT_FALSE(read.ok());
        return read.ok() ? std::string() : read.error().detail;
    };
    auto reply = good;
    reply.status(9);
    EXPECT_THAT(error_of(reply), HasSubstr("status = 9"));
    reply = good;
    reply.convention("tool0");
    EXPECT_THAT(error_of(reply), HasSubstr("convention = \"tool0\""));
    reply = good;
    reply.grasps()[1].source(3);
    EXPECT_THAT(error_of(reply), HasSubstr("grasps[1].source = 3"));
    reply = good;
    reply.grasps()[0].hand_pose().orientation({});
    EXPECT_THAT(error_of(reply), HasSubstr("grasps[0].hand_pose.orientation"));
    reply = good;
    reply.report().near_misses().resize(4);
    EXPECT_THAT(error_of(reply), HasSubstr("near_misses has 4"));
}

}  // namespace
}  // namespace graspd::dds
