#include "grasp_conventions.hpp"

namespace graspd::cli {
namespace {

/// D in G: the axes are the same three in another order, the origin lies on Gz.
Eigen::Isometry3d gpd_in_grasp(double base_z_G_m) {
    Eigen::Isometry3d X_GD = Eigen::Isometry3d::Identity();
    X_GD.linear().col(0) = Eigen::Vector3d::UnitZ();  // approach
    X_GD.linear().col(1) = Eigen::Vector3d::UnitX();  // binormal
    X_GD.linear().col(2) = Eigen::Vector3d::UnitY();  // hand axis
    X_GD.translation().z() = base_z_G_m;
    return X_GD;
}

Eigen::Isometry3d along_z(double z_m) {
    return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z_m));
}

}  // namespace

double gpd_base_z_G_m(const Gripper& gripper, double width_m, double open_width_m,
                      double hand_depth_m) {
    const double tip_H_m = pad_z_m(gripper, open_width_m) + gripper.tip_offset_m;
    return tip_H_m - pad_z_m(gripper, width_m) - hand_depth_m;
}

Eigen::Isometry3d tcp_to_gpd(const Eigen::Isometry3d& X_FG, double base_z_G_m) {
    return X_FG * gpd_in_grasp(base_z_G_m);
}

Eigen::Isometry3d gpd_to_tcp(const Eigen::Isometry3d& X_FD, double base_z_G_m) {
    return X_FD * gpd_in_grasp(base_z_G_m).inverse();
}

Eigen::Isometry3d tcp_to_graspgen(const Eigen::Isometry3d& X_FG, double depth_m) {
    return X_FG * along_z(-depth_m);
}

Eigen::Isometry3d graspgen_to_tcp(const Eigen::Isometry3d& X_FB, double depth_m) {
    return X_FB * along_z(depth_m);
}

Eigen::Isometry3d tcp_to_link(const Eigen::Isometry3d& X_FG, const Eigen::Isometry3d& X_HG,
                              const Eigen::Isometry3d& X_HL) {
    return X_FG * X_HG.inverse() * X_HL;
}

Eigen::Isometry3d link_to_tcp(const Eigen::Isometry3d& X_FL, const Eigen::Isometry3d& X_HG,
                              const Eigen::Isometry3d& X_HL) {
    return X_FL * X_HL.inverse() * X_HG;
}

}  // namespace graspd::cli
