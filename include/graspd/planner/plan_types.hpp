#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"
#include "graspd/grasp/score_grasp.hpp"

namespace graspd {

// What goes into the planner and what comes out of it. The wire (idl/graspd.idl), the JSON of
// graspctl and these structs carry the same fields; frames and units as in docs/architecture.md.

/// Terminal verdict of a request; the numbers are those of the wire.
enum class PlanStatus : std::uint8_t {
    kOk = 0,              ///< at least one grasp
    kNoGrasp = 1,         ///< planned to the end, none found; the report says why
    kPartial = 2,         ///< the time budget ran out; the best so far, perhaps none
    kInvalidRequest = 3,  ///< message names the field and the value
    kUnknownObject = 4,   ///< object_key is not cached
    kUnknownGripper = 5,  ///< no such profile
    kOverloaded = 6,      ///< the queue was full; try again
    kCancelled = 7,       ///< cancelled by its client, or the daemon is stopping
    kInternalError = 8,   ///< a fault of ours
};
/// "OK", "NO_GRASP", "PARTIAL", ... as in JSON and in logs.
const char* to_string(PlanStatus status);
/// The status of a request that an error refuses.
PlanStatus status_of(PlanErrorCode code);

/// Where grasp candidates come from. Bits may be combined; 0 means all.
enum GraspSource : std::uint8_t {
    kBoundary = 1,     ///< the paper: along the boundary of a concave region
    kWall = 2,         ///< across a wall, a finger inside a concavity
    kWholeObject = 4,  ///< anywhere on the surface, for convex bodies
    kAllSources = 7,
    kCandidate = 8,  ///< given by the request (PlanRequest::candidates_FH), no choice
};
/// "boundary", "wall", "whole_object", "candidate".
const char* to_string(GraspSource source);

/// A plane that carries the object: normal_F . p = offset_m, object on the normal's side.
struct SupportPlane {
    Eigen::Vector3d normal_F = Eigen::Vector3d::UnitZ();  ///< unit
    double offset_m = 0.0;                                ///< [m]
};

/// Something that the gripper must not touch, given as a mesh with a pose.
struct Obstacle {
    TriangleMesh mesh;                                       ///< [m] own coordinates
    Eigen::Isometry3d X_FO = Eigen::Isometry3d::Identity();  ///< its pose in F
};

/// Approach directions that are allowed: within half_angle of the axis.
struct ApproachCone {
    Eigen::Vector3d axis_F = -Eigen::Vector3d::UnitZ();  ///< unit, pointing as Gz does
    double half_angle_rad = 0.0;                         ///< [rad] in (0, pi]
};

/// Options of one request; every default is that of an absent PlanOptions on the wire.
struct PlanOptions {
    std::uint32_t max_grasps = 10;  ///< most grasps in the reply, >= 1
    double time_budget_s = 10.0;    ///< [s] from receipt to reply, > 0
    double friction = 0.6;          ///< Coulomb coefficient, > 0
    double min_clearance_m = 0.0;   ///< [m] least distance of the gripper on its way
    std::optional<double> mass_kg;  ///< [kg] > 0; absent: volume x 500 kg/m3
    std::optional<Eigen::Vector3d> center_of_mass_O;  ///< [m] absent: of the filled mesh
    std::optional<Eigen::Vector3d> gravity_F;  ///< unit, its direction; absent: against the support
                                               ///< plane's normal, without one any direction
    double grip_force_N = 20.0;                ///< [N] per finger, > 0
    std::uint8_t sources = kAllSources;        ///< bits of GraspSource
    bool want_suggestion = false;              ///< say what would help, also when there are grasps
    bool want_markers = false;                 ///< the daemon draws the plan; plan() does not care
    std::uint64_t seed = 0;                    ///< of every random draw
};

/// One planning problem. O is the object as received, F the frame of the request's header.
struct PlanRequest {
    std::string request_id;                                  ///< 1..64 printable characters
    std::string frame_id;                                    ///< name of F, echoed
    std::variant<TriangleMesh, PointCloud> object_O;         ///< [m]
    Eigen::Isometry3d X_FO = Eigen::Isometry3d::Identity();  ///< pose of the object in F
    std::vector<Gripper> grippers;                           ///< at least one; best over all wins
    std::optional<SupportPlane> support_plane;
    std::vector<Obstacle> obstacles;
    std::vector<ApproachCone> approach_cones;  ///< empty: every direction
    std::vector<OrientedBox> keep_out_F;       ///< boxes that no gripper part may enter
    /// Mounting frames of hands to be judged; when there are any, nothing is searched for.
    std::vector<Eigen::Isometry3d> candidates_FH;
    PlanOptions options;
};

/// Where a pad touches.
struct Contact {
    Eigen::Vector3d point_F = Eigen::Vector3d::Zero();   ///< [m]
    Eigen::Vector3d normal_F = Eigen::Vector3d::Zero();  ///< outward unit normal of the object
};

/// A straight motion of the hand.
struct LinearMotion {
    Eigen::Vector3d direction_F = Eigen::Vector3d::Zero();  ///< unit, the way the hand moves
    double distance_m = 0.0;                                ///< [m]
};

/// Errors of the hand's pose that a grasp stands, in every direction of the grasp frame.
struct PoseTolerance {
    double shift_m = 0.0;   ///< [m]
    double turn_rad = 0.0;  ///< [rad]
};

/// A ranked grasp; convention tcp_z_approach_x_closing (Gx closing, Gz approach, origin = TCP at
/// contact).
struct Grasp {
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();           ///< at contact
    Eigen::Isometry3d X_FG_pregrasp = Eigen::Isometry3d::Identity();  ///< before the approach
    Eigen::Isometry3d X_FH = Eigen::Isometry3d::Identity();  ///< mounting frame at the grasp
    LinearMotion approach;
    LinearMotion retreat;
    double width_m = 0.0;             ///< [m] pad gap when both pads touch
    double open_width_m = 0.0;        ///< [m] pad gap during the approach
    std::array<Contact, 2> contacts;  ///< at the pad on -Gx, at the pad on +Gx
    std::string gripper_name;
    std::int32_t concavity_index = -1;  ///< 0 = deepest; -1 for whole_object
    double concavity_depth_m = 0.0;     ///< [m] greatest concavity of that region
    double clearance_m = 0.0;           ///< [m] least distance to anything, pre-grasp to grasp
    double beta_rad = 0.0;              ///< [rad] force-balance angle (II-F), 0 is best
    double min_friction = 0.0;          ///< least friction coefficient that holds it
    double min_force_N = 0.0;           ///< [N] grip force per finger that carries the mass
    double score = 0.0;                 ///< in [0, 1] = 1 / (1 + exp(-sum of terms))
    std::vector<ScoreTerm> terms;
    GraspSource source = kBoundary;
    std::int32_t candidate = -1;             ///< index in candidates_FH; -1: found by the planner
    std::optional<PoseTolerance> tolerance;  ///< of the best few; absent where it was not measured
};

/// One stage's work: items in, items out, and how long it took.
struct StageReport {
    std::string name;  ///< the stage header's name, such as "regions/cluster_concavities"
    double ms = 0.0;   ///< [ms] wall time; the only part of a reply that the clock touches
    std::uint64_t in = 0;
    std::uint64_t out = 0;
};

/// How many candidates fell by one typed reason.
struct RejectionCount {
    std::string reason;
    std::uint64_t count = 0;
};

/// A candidate that nearly made it.
struct NearMiss {
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();
    std::string reason;   ///< the typed reason that felled it
    double margin = 0.0;  ///< by how much it failed, in `unit`
    std::string unit;     ///< "m", "rad" or "1"
};

/// How the verdict came about.
struct PlanReport {
    std::vector<StageReport> stages;
    std::vector<RejectionCount> rejections;
    std::vector<NearMiss> near_misses;  ///< at most three
    std::vector<Finding> findings;
    std::string suggestion;  ///< empty when none was computed; forms in docs/interface.md
};

/// The planner's answer; exactly one for every request.
struct PlanReply {
    std::string request_id;
    std::string frame_id;
    std::string object_key;  ///< hash of the object's geometry, hexadecimal
    PlanStatus status = PlanStatus::kInternalError;
    std::string message;   ///< empty for kOk; else one sentence with the field and the value
    std::string strategy;  ///< "concavity", "mixed", "whole_object", "candidates", or empty
                           ///< without grasps
    std::vector<Grasp> grasps;
    PlanReport report;
};

}  // namespace graspd
