#include "closing_axis.hpp"

#include <cmath>

namespace graspd::planner_detail {

ClosingAxis axis_through(const Eigen::Isometry3d& X_PG, double width_m) {
    ClosingAxis axis;
    const Eigen::Vector3d half = 0.5 * width_m * X_PG.linear().col(0);
    axis.left_P = X_PG.translation() - half;
    axis.right_P = X_PG.translation() + half;
    axis.reference_P = X_PG.linear().col(2);
    return axis;
}

Eigen::Isometry3d local_frame(const ClosingAxis& axis, const ApproachPose& pose) {
    const Eigen::Vector3d x = (axis.right_P - axis.left_P).normalized();
    const Eigen::Vector3d& z0 = axis.reference_P;
    const Eigen::Vector3d z =
        (std::cos(pose.turn_rad) * z0 + std::sin(pose.turn_rad) * x.cross(z0)).normalized();
    Eigen::Isometry3d X_PG = Eigen::Isometry3d::Identity();
    X_PG.linear() << x, z.cross(x), z;
    X_PG.translation() = 0.5 * (axis.left_P + axis.right_P) + pose.deeper_m * z;
    return X_PG;
}

TracedCandidate traced(const ClosingAxis& axis, const ApproachPose& pose,
                       const std::string& gripper_name) {
    TracedCandidate candidate;
    candidate.X_PG = local_frame(axis, pose);
    candidate.width_m = (axis.right_P - axis.left_P).norm();
    candidate.gripper_name = gripper_name;
    candidate.source = axis.source;
    candidate.concavity = axis.concavity;
    return candidate;
}

}  // namespace graspd::planner_detail
