#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

/// How the box's faces are judged.
struct ConcavityFrameConfig {
    std::uint32_t lines_per_side = 8;  ///< a face is probed by a square grid of so many lines

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("lines_per_side", self.lines_per_side, 1u, 100u);
    }
};

/// One of the box's three pairs of parallel faces.
struct PlanePair {
    int axis = 2;               ///< of C, normal to both faces: 0 major, 1 middle, 2 minor
    double blocked_m3 = 0.0;    ///< [m^3] object in both faces extruded outward by finger_length
    double face_area_m2 = 0.0;  ///< [m^2] of one face
    /// Working frame W: origin at the box's centre, third axis the pair's normal, first axis the
    /// longer of the box's other two axes, second = third x first.
    Eigen::Isometry3d X_OW = Eigen::Isometry3d::Identity();
};

/// The oriented bounding box of a concavity and the order in which its planes are worth trying.
struct ConcavityFrame {
    Eigen::Isometry3d X_OC = Eigen::Isometry3d::Identity();   ///< axes major, middle, minor; origin
                                                              ///< at the box's centre
    Eigen::Vector3d half_extent_m = Eigen::Vector3d::Zero();  ///< [m] along the axes of C
    std::array<PlanePair, 3> planes;                          ///< the best pair first
};

/// Puts a box around a concavity by moment of inertia and orders its pairs of faces by the chance
/// that a hand that reaches through them hits the object.
///
/// Source: Lei & Wisse 2016, Sec. II-C, Fig. 5.
/// Deviation: the criterion is open in the paper. Ours: the volume of object inside the two faces
/// extruded outward by the finger's length; least wins, ties (within 1e-9 of the box's volume) by
/// larger face area, then by the higher axis. Signs of the axes: third moment of the points >= 0
/// along major and middle, minor = major x middle; where a third moment vanishes, the axis's
/// largest component (ties: lowest index) is made positive. A pair whose face is narrower than
/// 1e-6 of the box comes last: seen along it the concavity is a line.
/// Deviation: the axes are computed in double instead of by PCL's MomentOfInertiaEstimation, whose
/// floats leave them good to 1e-5 only and whose signs follow the order of points; a test compares
/// the two.
///
/// @param points_O         (N, N >= 4) points of the concavity [m]
/// @param object_O         tree of the object's surface, same frame
/// @param finger_length_m  [m] > 0
/// @return the frame; the result does not depend on the order of points; kInvalidInput for a
///         non-finite point or a length or parameter out of range; kDegenerate for fewer than 4
///         points or collinear ones
/// Complexity O(N + lines^2 log F). Pure, so safe to call from any thread.
Result<ConcavityFrame> concavity_frame(std::span<const Eigen::Vector3d> points_O,
                                       const TriangleBvh& object_O, double finger_length_m,
                                       const ConcavityFrameConfig& config);

}  // namespace graspd
