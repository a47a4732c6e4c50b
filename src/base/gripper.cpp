#include "graspd/base/gripper.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace graspd {
namespace {

constexpr double kLargest_m = 2.0;  // no gripper part that we know of is longer than two metres

std::optional<PlanError> check(const char* field, double value, double least, double greatest) {
    if (std::isfinite(value) && value >= least && value <= greatest) return std::nullopt;
    std::ostringstream text;
    text << "gripper." << field << " = " << value << " is outside [" << least << ", " << greatest
         << "] m";
    return PlanError{PlanErrorCode::kInvalidInput, text.str()};
}

std::optional<PlanError> check_travel(const Gripper& gripper) {
    for (std::size_t i = 0; i < gripper.pad_travel.size(); ++i) {
        const PadTravel& row = gripper.pad_travel[i];
        if (auto bad = check("pad_travel.opening", row.opening_m, 0.0, kLargest_m)) return bad;
        if (auto bad = check("pad_travel.pad_z", row.pad_z_m, -kLargest_m, kLargest_m)) return bad;
        if (i > 0 && row.opening_m <= gripper.pad_travel[i - 1].opening_m) {
            std::ostringstream text;
            text << "gripper.pad_travel row " << i << ": opening " << row.opening_m
                 << " m does not rise above " << gripper.pad_travel[i - 1].opening_m << " m";
            return PlanError{PlanErrorCode::kInvalidInput, text.str()};
        }
    }
    return std::nullopt;
}

std::optional<PlanError> check_parts(const Gripper& gripper) {
    const auto joints =
        gripper.linkage ? static_cast<std::int32_t>(gripper.linkage->joints.size()) : 0;
    for (std::size_t i = 0; i < gripper.convex_parts.size(); ++i) {
        const ConvexPart& part = gripper.convex_parts[i];
        const auto wrong = [&](const std::string& what) {
            return PlanError{PlanErrorCode::kInvalidInput,
                             "gripper.convex_parts[" + std::to_string(i) + "] " + part.name + what};
        };
        if (part.points.size() < 4) {
            return wrong(" has " + std::to_string(part.points.size()) + " points, fewer than 4");
        }
        for (const Eigen::Vector3d& point : part.points) {
            if (point.allFinite() && point.cwiseAbs().maxCoeff() <= kLargest_m) continue;
            std::ostringstream text;
            text << " has the point " << point.transpose() << ", outside [" << -kLargest_m << ", "
                 << kLargest_m << "] m";
            return wrong(text.str());
        }
        if (part.joint < -1 || part.joint >= joints) {
            return wrong(" hangs on joint " + std::to_string(part.joint) + " of " +
                         std::to_string(joints));
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<PlanError> validate(const Gripper& gripper) {
    constexpr double kLeast_m = 1e-4;
    struct Row {
        const char* field;
        double value, least;
    };
    const Row rows[] = {
        {"max_width", gripper.max_width_m, kLeast_m},
        {"min_width", gripper.min_width_m, 0.0},
        {"finger_length", gripper.finger_length_m, kLeast_m},
        {"finger_width", gripper.finger_width_m, kLeast_m},
        {"finger_thickness", gripper.finger_thickness_m, kLeast_m},
        {"tip_offset", gripper.tip_offset_m, 0.0},
        {"palm_width", gripper.palm_width_m, kLeast_m},
        {"palm_height", gripper.palm_height_m, kLeast_m},
        {"palm_depth", gripper.palm_depth_m, kLeast_m},
        {"palm_z", gripper.palm_z_m, -kLargest_m},
        {"pad_width", gripper.pad_width_m, 0.0},
        {"pad_height", gripper.pad_height_m, 0.0},
    };
    for (const Row& row : rows) {
        if (auto bad = check(row.field, row.value, row.least, kLargest_m)) return bad;
    }
    if (auto bad = check("min_width", gripper.min_width_m, 0.0, gripper.max_width_m)) return bad;
    if (auto bad = check("tip_offset", gripper.tip_offset_m, 0.0, gripper.finger_length_m))
        return bad;
    if (!std::isfinite(gripper.closing_yaw_rad)) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "gripper.closing_yaw is not a finite number"};
    }
    if (auto bad = check_travel(gripper)) return bad;
    if (gripper.linkage) {
        if (auto bad = validate(*gripper.linkage)) return bad;
    }
    return check_parts(gripper);
}

double pad_z_m(const Gripper& gripper, double opening_m) {
    const auto& table = gripper.pad_travel;
    if (table.empty()) {
        return gripper.palm_z_m + gripper.palm_depth_m + gripper.finger_length_m -
               gripper.tip_offset_m;
    }
    const auto above = std::ranges::find_if(
        table, [&](const PadTravel& row) { return row.opening_m >= opening_m; });
    if (above == table.begin()) return table.front().pad_z_m;
    if (above == table.end()) return table.back().pad_z_m;
    const auto below = std::prev(above);
    const double t = (opening_m - below->opening_m) / (above->opening_m - below->opening_m);
    return below->pad_z_m + t * (above->pad_z_m - below->pad_z_m);
}

Eigen::Isometry3d grasp_in_hand(const Gripper& gripper, double contact_width_m) {
    Eigen::Isometry3d X_HG = Eigen::Isometry3d::Identity();
    X_HG.rotate(Eigen::AngleAxisd(gripper.closing_yaw_rad, Eigen::Vector3d::UnitZ()));
    X_HG.translation().z() = pad_z_m(gripper, contact_width_m);
    return X_HG;
}

std::vector<GripperPart> gripper_parts(const Gripper& gripper, double contact_width_m,
                                       double opening_m) {
    const double tcp_z_H = pad_z_m(gripper, contact_width_m);
    const double palm_rear = gripper.palm_z_m - tcp_z_H;
    const double tip = pad_z_m(gripper, opening_m) + gripper.tip_offset_m - tcp_z_H;
    const double inner = 0.5 * opening_m;
    const double outer = inner + gripper.finger_thickness_m;
    const double half_finger = 0.5 * gripper.finger_width_m;
    const Eigen::Vector3d palm_half(0.5 * gripper.palm_width_m, 0.5 * gripper.palm_height_m, 0.0);
    const Eigen::Vector3d rear(0, 0, palm_rear);
    const Eigen::Vector3d front(0, 0, palm_rear + gripper.palm_depth_m);
    const double heel = tip - gripper.finger_length_m;
    return {
        {"palm", Eigen::AlignedBox3d(rear - palm_half, front + palm_half)},
        {"finger_left", Eigen::AlignedBox3d(Eigen::Vector3d(-outer, -half_finger, heel),
                                            Eigen::Vector3d(-inner, half_finger, tip))},
        {"finger_right", Eigen::AlignedBox3d(Eigen::Vector3d(inner, -half_finger, heel),
                                             Eigen::Vector3d(outer, half_finger, tip))},
    };
}

}  // namespace graspd
