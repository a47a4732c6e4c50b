#pragma once

#include <string>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::cli {

/// What a reply's JSON (schema graspd/1, as write_json() writes it) says about its grasps.
struct GraspFile {
    std::string request_id;
    std::string frame_id;              ///< name of F, in which all poses are
    std::string status;                ///< "OK", "NO_GRASP", ...
    std::string message;               ///< why, when the status is not OK
    std::vector<Grasp> grasps;         ///< in the file's order; `candidate` is not in the file
    std::vector<std::uint32_t> ranks;  ///< one for each grasp, from 1
    /// Member `gripper`; an error that names what it lacks when it cannot serve as one.
    Result<Gripper> gripper = PlanError{PlanErrorCode::kInvalidInput, "gripper is missing"};
};

/// Reads a reply's JSON strictly: the schema and the convention must be ours, numbers finite (but
/// for null where write_json() has one for infinite), quaternions of unit length to 1e-3, as on the
/// wire, and `rotation` and `hand_pose`, which say the same again, must agree with the pose.
///
/// @param given  the gripper that the grasps are for, of which a grasp without `hand_pose` takes
///               it; may be null
/// @return kInvalidInput with the member, such as grasps[0].quaternion, and its value
Result<GraspFile> read_grasps(const std::string& text, const Gripper* given = nullptr);

}  // namespace graspd::cli
