#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd {

/// What came of a grasp.
enum class GraspVerdict : std::uint8_t {
    kHolds,      ///< both fingers held it to the end, and it moved little in the hand
    kCollision,  ///< the open hand met the object or the plane on its way
    kNoContact,  ///< the fingers closed and met nothing
    kDropped,    ///< at least one finger lost it
    kSlips,      ///< held to the end, but it moved too far in the hand
};
/// "holds", "collision", "no_contact", "dropped", "slips".
const char* to_string(GraspVerdict verdict);

/// The parts of the motion, in order.
enum class SimulationPhase : std::uint8_t {
    kApproach,  ///< straight along Gz, the hand open
    kClose,     ///< the fingers close; the object floats without weight
    kLift,      ///< weight comes on, then up
    kShake,     ///< along and about each axis of G
};
/// "approach", "close", "lift", "shake".
const char* to_string(SimulationPhase phase);

/// Forces, motion and limits of one execution.
struct SimulationConfig {
    double friction = 0.6;             ///< Coulomb coefficient, > 0
    double torsion_m = 0.002;          ///< [m] torque about a contact's normal over its force
    double grip_force_N = 20.0;        ///< [N] per finger, > 0
    double mass_kg = 0.1;              ///< [kg] > 0
    double approach_slack_m = 0.0005;  ///< [m] that the open hand may be too large by
    double lift_m = 0.2;               ///< [m]
    // Two periods under an envelope that rises and falls, so that 0.87 of it is reached: 10 mm and
    // 20 degrees, 12.4 m/s2 and 104 rad/s2.
    double shake_m = 0.012;             ///< [m] along each axis of G, 5 Hz
    double shake_rad = 0.40;            ///< [rad] about each axis of G, 2.5 Hz
    double most_shift_m = 0.020;        ///< [m] more is kSlips
    double most_turn_rad = 0.52359878;  ///< [rad] 30 degrees; more is kSlips
    double time_step_s = 0.002;         ///< [s]
    double frame_interval_s = 0.0;      ///< [s] between recorded frames; 0: none are recorded
    /// Unit, against gravity; absent: the support plane's normal, without one -Gz (the hand is
    /// above).
    std::optional<Eigen::Vector3d> up_F;
};

/// Hand and object at one time, for pictures.
struct SimulatedFrame {
    SimulationPhase phase = SimulationPhase::kApproach;
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();  ///< the hand
    Eigen::Isometry3d X_FO = Eigen::Isometry3d::Identity();  ///< the object, from where it was
    double opening_m = 0.0;                                  ///< [m] gap between the pads
};

/// How an execution ended.
struct SimulationResult {
    GraspVerdict verdict = GraspVerdict::kCollision;
    SimulationPhase phase = SimulationPhase::kApproach;  ///< the last one that was entered
    std::string detail;                                  ///< one sentence for people
    double width_m = 0.0;         ///< [m] gap between the pads at the end; 0 after kCollision
    double close_shift_m = 0.0;   ///< [m] of the object's point at the TCP, while closing
    double close_turn_rad = 0.0;  ///< [rad] of the object, while closing
    double shift_m = 0.0;         ///< [m] the same in the hand, after closing
    double turn_rad = 0.0;        ///< [rad]
    std::vector<SimulatedFrame> frames;
};

/// Executes a grasp by physics (MuJoCo): approach, close, lift, shake.
///
/// Source: Lei & Wisse 2016, Sec. III, Fig. 23 (executed grasps).
/// The hand is three rigid boxes whose fingers move as one pair, driven along a given path; no arm.
/// Contacts are those of box_contacts() with the mesh itself: MuJoCo would take its convex hull,
/// which fills just the cavities that grasps are made for. Linkage fingers travel forward until
/// they touch, after that straight. Uniform density.
///
/// @param mesh_F   closed and outward oriented [m]; it stays where it is until a finger moves it
/// @param grasp    X_FG, width_m, open_width_m and approach.distance_m are used
/// @param plane    where the object stands: the open hand must not touch it, its normal is up.
///                 None: the hand comes from above, up is -Gz
/// @return the verdict; kInvalidInput for a setting out of range, kDegenerate for a mesh without
///         volume, kInternal when the simulation gets unstable
/// Same input, same bytes out. Not to be called from several threads at once (MuJoCo's table of
/// colliders is global). Cost: some thousand steps of 0.1 to 1 ms.
Result<SimulationResult> simulate_grasp(const TriangleMesh& mesh_F, const Gripper& gripper,
                                        const Grasp& grasp,
                                        const std::optional<SupportPlane>& plane,
                                        const SimulationConfig& config);

}  // namespace graspd
