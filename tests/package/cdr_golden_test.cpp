// The bytes of one sample of each of graspd's topics, every member filled, as ros_layout_test.cpp
// made them from ROS 2's side: the wire does not change unnoticed, also where rosidl is not
// installed.
#include <graspd_msgs/graspd.h>
#include <gtest/gtest.h>

#include "cdr_samples.hpp"

namespace {

using cdr_samples::Bytes;

template <typename Type>
void expect_golden(const std::string& name) {
    const Bytes golden = cdr_samples::read_golden(name);
    ASSERT_FALSE(golden.empty()) << cdr_samples::golden_path(name);
    Type sample;
    EXPECT_EQ(cdr_samples::read_cdr(golden, sample), 0u);
    EXPECT_EQ(cdr_samples::write_cdr(sample), golden);
    Type empty;
    EXPECT_LT(cdr_samples::write_cdr(empty).size(), golden.size());
}

TEST(CdrGolden, GraspRequest) {
    expect_golden<graspd_msgs::msg::dds_::GraspRequest_>("GraspRequest");
}
TEST(CdrGolden, RankedGrasps) {
    expect_golden<graspd_msgs::msg::dds_::RankedGrasps_>("RankedGrasps");
}
TEST(CdrGolden, CancelRequest) {
    expect_golden<graspd_msgs::msg::dds_::CancelRequest_>("CancelRequest");
}
TEST(CdrGolden, PlannerStatus) {
    expect_golden<graspd_msgs::msg::dds_::PlannerStatus_>("PlannerStatus");
}
// The service's messages are those of the topics, with no byte added.
TEST(CdrGolden, PlanGraspsRequest) {
    expect_golden<graspd_msgs::srv::dds_::PlanGrasps_Request_>("GraspRequest");
}
TEST(CdrGolden, PlanGraspsResponse) {
    expect_golden<graspd_msgs::srv::dds_::PlanGrasps_Response_>("RankedGrasps");
}
TEST(CdrGolden, MoveItRequest) {
    expect_golden<moveit_msgs::srv::dds_::GraspPlanning_Request_>("MoveItRequest");
}
TEST(CdrGolden, MoveItResponse) {
    expect_golden<moveit_msgs::srv::dds_::GraspPlanning_Response_>("MoveItResponse");
}
// Humble's response is Jazzy's without the two strings at its end.
TEST(CdrGolden, MoveItResponseOfHumble) {
    const Bytes golden = cdr_samples::read_golden("MoveItResponse");
    moveit_msgs::srv::dds_::GraspPlanning_Response_ jazzy;
    ASSERT_EQ(cdr_samples::read_cdr(golden, jazzy), 0u);
    moveit_msgs_humble::srv::dds_::GraspPlanning_Response_ humble;
    const std::size_t rest = cdr_samples::read_cdr(golden, humble);
    EXPECT_EQ(humble.error_code().val(), jazzy.error_code().val());
    EXPECT_EQ(humble.grasps(), jazzy.grasps());
    EXPECT_EQ(cdr_samples::write_cdr(humble),
              Bytes(golden.begin(), golden.end() - static_cast<std::ptrdiff_t>(rest)));
}

// Worked by hand from the CDR rules: numbers stand at multiples of their size counted from behind
// the 4 bytes of encapsulation, a string is its length with the closing zero, then its characters.
TEST(CdrGolden, CancelRequestByHand) {
    graspd_msgs::msg::dds_::CancelRequest_ cancel;
    cancel.header().stamp().sec(1);
    cancel.header().stamp().nanosec(2);
    cancel.header().frame_id("map");
    cancel.client_id("a");
    cancel.request_id("r1");
    const Bytes expected = {0,   1, 0, 0, 1, 0, 0,   0, 2, 0, 0, 0, 4, 0, 0,   0,   'm', 'a',
                            'p', 0, 2, 0, 0, 0, 'a', 0, 0, 0, 3, 0, 0, 0, 'r', '1', 0};
    EXPECT_EQ(cdr_samples::write_cdr(cancel), expected);
}

}  // namespace
