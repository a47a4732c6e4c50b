// graspd's .msg and .srv files and idl/graspd.idl describe the same bytes. rosidl makes C++ from
// the former, fastddsgen from the latter. Each message of rosidl is filled, written as CDR by
// rosidl's introspection, and read by fastddsgen's type: all members must have the same names,
// types and values.
//
// With GRASPD_WRITE_GOLDEN=1 the files under tests/golden/cdr are written anew.
#include <array>
#include <cstdlib>
#include <type_traits>
#include <vector>

#include <graspd_msgs/graspd.h>
#include <gtest/gtest.h>
#include <rosidl_typesupport_introspection_cpp/message_type_support_decl.hpp>

#include "cdr_samples.hpp"
#include "ros_layout/walk_message.hpp"
#include "structs.inc"

namespace {

template <typename Type>
concept HasElements = !std::is_same_v<Type, std::string> && requires(const Type& type) {
    type.size();
    type[0];
};

// A function for each message, declared before any is used: messages hold messages.
#define MEMBER(name)
#define END
#define BEGIN(package, folder, name)                      \
    void compare_values(const package::folder::name& ros, \
                        const package::folder::dds_::name##_& dds);
#include "types.inc"
#undef BEGIN
#undef MEMBER
#undef END

template <typename Ros, typename Dds>
void compare(const char* name, const Ros& ros, const Dds& dds) {
    SCOPED_TRACE(name);
    if constexpr (HasElements<Ros>) {
        ASSERT_EQ(ros.size(), dds.size());
        for (std::size_t i = 0; i < ros.size(); ++i) compare("[i]", ros[i], dds[i]);
    } else if constexpr (std::is_same_v<Ros, std::string>) {
        EXPECT_EQ(ros, std::string(dds.c_str()));  // string<N> is fastddsgen's fixed_string
    } else if constexpr (std::is_arithmetic_v<Ros>) {
        EXPECT_TRUE((std::is_same_v<Ros, Dds>)) << "types differ";
        EXPECT_EQ(ros, dds);
    } else {
        compare_values(ros, dds);
    }
}

#define MEMBER(name) compare(#name, ros.name, dds.name());
#define END }
#define BEGIN(package, folder, name)                      \
    void compare_values(const package::folder::name& ros, \
                        const package::folder::dds_::name##_& dds) {
#include "types.inc"
#undef BEGIN
#undef MEMBER
#undef END

template <typename Ros>
cdr_samples::Bytes fill_and_write(Ros& message) {
    using rosidl_typesupport_introspection_cpp::get_message_type_support_handle;
    using rosidl_typesupport_introspection_cpp::MessageMembers;
    const auto& type =
        *static_cast<const MessageMembers*>(get_message_type_support_handle<Ros>()->data);
    ros_layout::fill_message(type, &message);
    return ros_layout::to_cdr(type, &message);
}

template <typename Ros, typename Dds>
void check_layout(const char* name) {
    SCOPED_TRACE(name);
    Ros ros;
    const cdr_samples::Bytes bytes = fill_and_write(ros);
    Dds dds;
    ASSERT_NO_THROW(EXPECT_EQ(cdr_samples::read_cdr(bytes, dds), 0u) << "bytes left over");
    EXPECT_EQ(cdr_samples::write_cdr(dds), bytes);
    compare_values(ros, dds);
}

TEST(RosLayout, EveryMessageHasTheSameMembersTypesAndBytes) {
    int messages = 0;
#define MEMBER(name)
#define END
#define BEGIN(package, folder, name)                                                         \
    check_layout<package::folder::name, package::folder::dds_::name##_>(#package "/" #folder \
                                                                                 "/" #name); \
    ++messages;
#include "types.inc"
#undef BEGIN
#undef MEMBER
#undef END
    EXPECT_GE(messages, 60);  // as the IDL has today, without Humble's layouts
}

template <typename Ros>
void check_golden(const std::string& name) {
    Ros ros;
    const cdr_samples::Bytes bytes = fill_and_write(ros);
    if (std::getenv("GRASPD_WRITE_GOLDEN") != nullptr) cdr_samples::write_golden(name, bytes);
    EXPECT_EQ(bytes, cdr_samples::read_golden(name)) << name;
}

TEST(RosLayout, TopicsHaveTheCommittedBytes) {
    check_golden<graspd_msgs::msg::GraspRequest>("GraspRequest");
    check_golden<graspd_msgs::msg::RankedGrasps>("RankedGrasps");
    check_golden<graspd_msgs::msg::CancelRequest>("CancelRequest");
    check_golden<graspd_msgs::msg::PlannerStatus>("PlannerStatus");
    check_golden<graspd_msgs::srv::PlanGrasps_Request>("GraspRequest");
    check_golden<graspd_msgs::srv::PlanGrasps_Response>("RankedGrasps");
    check_golden<moveit_msgs::srv::GraspPlanning_Request>("MoveItRequest");
    check_golden<moveit_msgs::srv::GraspPlanning_Response>("MoveItResponse");
}

}  // namespace
