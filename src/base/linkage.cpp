#include "graspd/base/linkage.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {
namespace {

PlanError wrong(const std::string& what) {
    return PlanError{PlanErrorCode::kInvalidInput, "gripper.linkage." + what};
}

Eigen::Isometry3d motion_of(const LinkageJoint& joint, double q) {
    const double position = joint.multiplier * q + joint.offset;
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    if (joint.slides) {
        X.translation() = position * joint.axis_J;
    } else {
        X.linear() = Eigen::AngleAxisd(position, joint.axis_J).toRotationMatrix();
    }
    return X;
}

Eigen::Vector3d pad_point(const PadMount& pad, const std::vector<Eigen::Isometry3d>& poses) {
    return pad.joint < 0 ? pad.point : poses[static_cast<std::size_t>(pad.joint)] * pad.point;
}

std::optional<PlanError> check_gap(const Linkage& linkage) {
    constexpr int kSteps = 64;
    double last_m = pad_gap_m(linkage, linkage.open_q);
    for (int i = 1; i <= kSteps; ++i) {
        const double q = linkage.open_q + (linkage.closed_q - linkage.open_q) * i / kSteps;
        const double gap_m = pad_gap_m(linkage, q);
        if (!(gap_m < last_m)) {
            return wrong("driver = " + std::to_string(q) + ": the pads' gap, " +
                         std::to_string(gap_m) + " m, does not fall from open to closed");
        }
        last_m = gap_m;
    }
    if (last_m < -1e-9) {
        return wrong("closed = " + std::to_string(linkage.closed_q) + ": the pads' gap is " +
                     std::to_string(last_m) + " m, below 0");
    }
    return std::nullopt;
}

}  // namespace

std::optional<PlanError> validate(const Linkage& linkage) {
    const auto count = static_cast<std::int32_t>(linkage.joints.size());
    for (std::int32_t i = 0; i < count; ++i) {
        const LinkageJoint& joint = linkage.joints[static_cast<std::size_t>(i)];
        if (joint.parent < -1 || joint.parent >= i) {
            return wrong(joint.name + ".parent = " + std::to_string(joint.parent) +
                         " does not come before it");
        }
        if (!joint.X_PJ.matrix().allFinite() || !std::isfinite(joint.multiplier) ||
            !std::isfinite(joint.offset)) {
            return wrong(joint.name + " holds a number that is not finite");
        }
        if (!(std::abs(joint.axis_J.norm() - 1.0) < 1e-9)) {
            return wrong(joint.name + ".axis has length " + std::to_string(joint.axis_J.norm()) +
                         ", not 1");
        }
    }
    for (const PadMount& pad : linkage.pads) {
        if (pad.joint < -1 || pad.joint >= count || !pad.point.allFinite()) {
            return wrong("pads name joint " + std::to_string(pad.joint) + " of " +
                         std::to_string(count));
        }
    }
    if (!std::isfinite(linkage.open_q) || !std::isfinite(linkage.closed_q)) {
        return wrong("open or closed is not a finite number");
    }
    return check_gap(linkage);
}

std::vector<Eigen::Isometry3d> link_poses_H(const Linkage& linkage, double q) {
    std::vector<Eigen::Isometry3d> poses;
    poses.reserve(linkage.joints.size());
    for (const LinkageJoint& joint : linkage.joints) {
        const Eigen::Isometry3d X_HP = joint.parent < 0
                                           ? Eigen::Isometry3d::Identity()
                                           : poses[static_cast<std::size_t>(joint.parent)];
        poses.push_back(X_HP * joint.X_PJ * motion_of(joint, q));
    }
    return poses;
}

Eigen::Vector3d pad_point_H(const Linkage& linkage, std::size_t pad, double q) {
    return pad_point(linkage.pads[pad], link_poses_H(linkage, q));
}

double pad_gap_m(const Linkage& linkage, double q) {
    const auto poses = link_poses_H(linkage, q);
    return linkage.closing_axis_H.dot(pad_point(linkage.pads[1], poses) -
                                      pad_point(linkage.pads[0], poses));
}

double driver_position(const Linkage& linkage, double opening_m) {
    constexpr double kExact_m = 1e-15;
    constexpr int kMostSteps = 200;
    double wide = linkage.open_q, narrow = linkage.closed_q;
    double over_m = pad_gap_m(linkage, wide) - opening_m;
    double under_m = pad_gap_m(linkage, narrow) - opening_m;
    if (over_m <= 0.0) return wide;
    if (under_m >= 0.0) return narrow;
    int side = 0;  // of the last step
    for (int step = 0; step < kMostSteps; ++step) {
        const double q = (wide * under_m - narrow * over_m) / (under_m - over_m);
        const double rest_m = pad_gap_m(linkage, q) - opening_m;
        if (std::abs(rest_m) <= kExact_m || q == wide || q == narrow) return q;
        if (rest_m > 0.0) {
            wide = q;
            over_m = rest_m;
            if (side > 0) under_m *= 0.5;  // Illinois: else the far end would never move
            side = 1;
        } else {
            narrow = q;
            under_m = rest_m;
            if (side < 0) over_m *= 0.5;
            side = -1;
        }
    }
    return 0.5 * (wide + narrow);
}

// The path of a point is smooth, so it leaves its chord by at most max |p''| step^2 / 8. Every pair
// of joints on the way to it adds at most the product of their rates times the lever of the outer
// one; two turning rates w1, w2 with levers r1 >= r2 give w1^2 r1 + 2 w1 w2 r2 + w2^2 r2.
double sagitta_bound(const Linkage& linkage, std::int32_t joint, double reach_m) {
    double second = 0.0, outer_rate = 0.0, outer_slide = 0.0, lever_m = reach_m;
    const double travel = std::max(std::abs(linkage.open_q), std::abs(linkage.closed_q));
    for (std::int32_t i = joint; i >= 0;) {
        const LinkageJoint& here = linkage.joints[static_cast<std::size_t>(i)];
        const double rate = std::abs(here.multiplier);
        if (here.slides) {
            lever_m += rate * travel + std::abs(here.offset);
            outer_slide += rate;
        } else {
            // first derivative behind this joint: outer_rate * lever + outer_slide at the most
            second += rate * rate * lever_m + 2.0 * rate * (outer_rate * lever_m + outer_slide);
            outer_rate += rate;
        }
        lever_m += here.X_PJ.translation().norm();
        i = here.parent;
    }
    return second / 8.0;
}

}  // namespace graspd
