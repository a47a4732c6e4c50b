#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/mesh/read_object.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// What can be counted and measured of a surface or a cloud.
struct ObjectFigures {
    std::uint64_t vertices = 0;    ///< or points
    std::uint64_t faces = 0;       ///< 0 for a cloud
    std::uint64_t components = 0;  ///< pieces without a common place; 0 for a cloud
    std::uint64_t holes = 0;       ///< boundary loops
    double area_m2 = 0.0;
    std::optional<double> volume_m3;                   ///< absent where there are holes or no faces
    Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< of the box along the file's axes
    std::optional<double> spacing_m;  ///< a cloud's points: median to the nearest one
};

/// What is wrong with an object, what was done about it, and what would help.
struct Diagnosis {
    std::string file;
    std::string kind;                    ///< "mesh", "cloud", or "unreadable"
    std::string refusal;                 ///< why it cannot be planned for; empty: usable
    ObjectFigures before;                ///< as stored
    std::optional<ObjectFigures> after;  ///< as planned on; absent when it was refused before
    std::vector<Finding> findings;
    std::vector<std::string> advice;  ///< one sentence each, the same order as the findings

    bool usable() const { return refusal.empty(); }
};

/// Runs all that a plan does to an object before it looks for grasps, and counts what a plan does
/// not: faces that cross each other (finding self_intersections).
/// @param file  as read; its findings come first
Diagnosis diagnose_object(const ObjectFile& file, const Gripper& gripper,
                          const PlannerConfig& config);

}  // namespace graspd::cli
