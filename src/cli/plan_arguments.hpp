#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "graspd/mesh/read_object.hpp"
#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// How a file's numbers become metres.
struct ObjectArguments {
    std::string file;
    double scale = 1.0;  ///< factor on every coordinate
    std::string sensor;  ///< "X,Y,Z" [m] where a cloud's sensor stood; empty: as the file says
};

/// What `plan` and `request` take from the command line, in the words of a person at a shell.
struct PlanArguments {
    ObjectArguments object;
    std::string gripper = "parallel_85";  ///< name of a profile, or a .yaml file
    std::uint32_t top = 10;
    double time_budget_ms = 10000.0;  ///< [ms]
    double friction = 0.6;
    std::string up = "none";      ///< "X,Y,Z" or "none"
    std::string gravity;          ///< "X,Y,Z", "none", or empty: against up, else along -z
    std::string concavity;        ///< "any_angle", "tetrahedral", or empty: as configured
    std::string sources = "all";  ///< comma-separated names
    bool suggest = false;         ///< also when there are grasps
    bool markers = false;         ///< graspd draws the plan on /graspd/markers
    std::uint64_t seed = 0;
    std::string frame_id = "object";
    std::string request_id;  ///< empty: the file's stem
    bool scene = false;      ///< FILE is a cloud of a plane and what stands on it
    std::string object_at;   ///< "X,Y,Z" [m] which object of the scene; empty: the best one
};

/// Where the result goes and in which form.
struct OutputArguments {
    std::string format = "table";  ///< "table" or "json"
    std::string out;               ///< file; empty: standard output
    std::string report;            ///< directory for the whole report; empty: none
};

/// Reads the object; --sensor takes the place of what the file says.
/// @return read_object's error, or kInvalidInput for --sensor
Result<ObjectFile> read_object_file(const ObjectArguments& arguments);

/// Reads the object, finds the gripper and makes the request; frame F is the file's own.
/// With `up` the object stands on the plane that is normal to it and touches its lowest point.
/// @return the first wrong argument, named as on the command line
/// @param findings  of the file's reader are added when given
Result<PlanRequest> make_request(const PlanArguments& arguments,
                                 const std::filesystem::path& profiles,
                                 std::vector<Finding>* findings = nullptr);

/// "x,y,z" as a point. @return kInvalidInput, naming the option
Result<Eigen::Vector3d> parse_place(const std::string& option, const std::string& text);

/// "x,y,z,qx,qy,qz,qw" as a pose; the quaternion is of unit length to 1e-3.
/// @return kInvalidInput, naming the option
Result<Eigen::Isometry3d> parse_pose(const std::string& option, const std::string& text);

/// "x,y,z" as a unit vector. @return kInvalidInput, naming the option, for anything else, or a zero
/// or non-finite one
Result<Eigen::Vector3d> parse_direction(const std::string& option, const std::string& text);

/// "boundary,wall,whole_object" or "all" as bits of GraspSource.
Result<std::uint8_t> parse_sources(const std::string& text);

}  // namespace graspd::cli
