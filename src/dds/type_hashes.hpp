// Generated from idl/graspd.idl by scripts/interfaces. Do not edit.
#pragma once

#include <string_view>

namespace graspd::dds {

/// A type as it is named on the wire, and its hash.
struct TypeHash {
    std::string_view dds_type_name;
    std::string_view hash;
};

/// ROS 2's type hashes (REP-2011) of every type that graspd has a topic of.
///
/// ROS 2 nodes announce the hash of an endpoint's type as "typehash=RIHS01_...;" in its user data,
/// from Iron on. The endpoints of a service carry the hash of the message that they transport; the
/// service's own hash belongs into "sertypehash=RIHS01_...;", which newer versions of ROS 2 add.
/// The hash of ParticipantEntitiesInfo_ is that of the 16-byte Gid.
inline constexpr TypeHash kTypeHashes[] = {
    {"graspd_msgs::msg::dds_::GraspRequest_",
     "RIHS01_e497d58acbc524481ced9a7434e9cc07c9c28093fc11d77dbe6b1ed0dead1d5a"},
    {"graspd_msgs::msg::dds_::RankedGrasps_",
     "RIHS01_f04709f96351f9ca2ef734cc0c79198b517b6ce4f48f57dfa5d073e5cf4fb031"},
    {"graspd_msgs::msg::dds_::CancelRequest_",
     "RIHS01_cdff04f7e2e1bf5d3af1b70655e0dabb16f473e68bf17306e97f4cbdbdd5af96"},
    {"graspd_msgs::msg::dds_::PlannerStatus_",
     "RIHS01_9b0b904892cb324af0475336d4969757482eb890d142c50888b861bc8e680405"},
    {"graspd_msgs::srv::dds_::PlanGrasps_Request_",
     "RIHS01_1a35953c73db8576bcf550b2b64fb8080bf606a7ad6f5d3f3c583c98991dcb4d"},
    {"graspd_msgs::srv::dds_::PlanGrasps_Response_",
     "RIHS01_23a438c01f9f0cba98d7ce67eb29b83757d7f7fb8b39e8cddcae7343ea65b9e3"},
    {"graspd_msgs::srv::dds_::PlanGrasps_",
     "RIHS01_cd9b8c6228e47ac5d3d85432eb1eea86088f78a3897ab162f32a0428061e859b"},
    {"moveit_msgs::srv::dds_::GraspPlanning_Request_",
     "RIHS01_3c0c610c8d2369bc95caf7fd4a2dc4f43dbc83c39f1e5dfc0b0885de56f58885"},
    {"moveit_msgs::srv::dds_::GraspPlanning_Response_",
     "RIHS01_9eaf3e82801852e9508006aec607de77c9f6f5defbe8f9e89f254080117ee1c3"},
    {"moveit_msgs::srv::dds_::GraspPlanning_",
     "RIHS01_669cd00f6ecb2ec71060b363815b828cc5fed9646adc10d7b1701777b9dc5c5b"},
    {"visualization_msgs::msg::dds_::MarkerArray_",
     "RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf"},
    {"diagnostic_msgs::msg::dds_::DiagnosticArray_",
     "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
    {"rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
     "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"},
};

/// The hash of a type by its name on the wire, such as "graspd_msgs::msg::dds_::RankedGrasps_".
///
/// @return "RIHS01_" and 64 hexadecimal digits; empty for a type that is not in kTypeHashes
/// Complexity O(types). Pure, so safe to call from any thread.
constexpr std::string_view type_hash(std::string_view dds_type_name) {
    for (const TypeHash& row : kTypeHashes) {
        if (row.dds_type_name == dds_type_name) return row.hash;
    }
    return {};
}

}  // namespace graspd::dds
