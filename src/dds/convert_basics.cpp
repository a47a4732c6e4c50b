#include "convert_basics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "graspd/base/stop.hpp"

namespace graspd::dds {
namespace {

namespace geometry = geometry_msgs::msg::dds_;

constexpr double kUnitTolerance = 1e-3;  // a quaternion rounded to three decimals still passes
constexpr double kExact = 1e-12;         // closer than this to 1 is left alone, bit for bit

bool is_printable(char c) {
    return c >= 0x20 && c <= 0x7e;
}

std::string shown_vector(const Eigen::Vector3d& v) {
    return "(" + shown(v.x()) + ", " + shown(v.y()) + ", " + shown(v.z()) + ")";
}

Eigen::Vector3d finite(const Eigen::Vector3d& vector, const std::string& field,
                       FirstError& errors) {
    if (!vector.allFinite())
        errors.invalid(field + " = " + shown_vector(vector) + " must be finite");
    return vector;
}

void check_unit(double length, const std::string& field, FirstError& errors) {
    if (std::abs(length - 1.0) <= kUnitTolerance) return;  // a NaN is not near 1
    errors.invalid(field + " has length " + shown(length) + ", must be 1 within 0.001");
}

}  // namespace

std::string printable(const std::string& text) {
    constexpr std::size_t kMost = 64;
    std::string out = text.substr(0, kMost);
    std::ranges::replace_if(
        out, [](char c) { return !is_printable(c); }, '?');
    return out;
}

std::string shown(const std::string& text) {
    return "\"" + printable(text) + "\"";
}

std::string shown(double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.9g", value);
    return digits.data();
}

std::string element(const std::string& name, std::size_t index) {
    return name + "[" + std::to_string(index) + "]";
}

void check_text(const std::string& text, const std::string& field,
                std::pair<std::size_t, std::size_t> length, FirstError& errors) {
    const auto [least, most] = length;
    if (text.size() < least || text.size() > most) {
        errors.invalid(field + " = " + shown(text) + " has " + std::to_string(text.size()) +
                       " characters, must have " + std::to_string(least) + " to " +
                       std::to_string(most));
    }
    if (!std::ranges::all_of(text, is_printable)) {
        errors.invalid(field + " = " + shown(text) + " must be printable ASCII");
    }
}

void check_count(std::size_t count, std::size_t most, const std::string& field,
                 FirstError& errors) {
    if (count <= most) return;
    errors.invalid(field + " has " + std::to_string(count) + " elements, at most " +
                   std::to_string(most) + " are allowed");
}

double read_number(double value, const std::string& field, const NumberRange& range,
                   FirstError& errors) {
    const bool above = range.open_at_least ? value > range.least : value >= range.least;
    if (!above || !(value <= range.greatest)) {
        errors.invalid(field + " = " + shown(value) + " is outside " +
                       (range.open_at_least ? "(" : "[") + shown(range.least) + ", " +
                       shown(range.greatest) + "]");
    }
    return value;
}

Eigen::Vector3d read_finite(const geometry::Point_& point, const std::string& field,
                            FirstError& errors) {
    return finite({point.x(), point.y(), point.z()}, field, errors);
}

Eigen::Vector3d read_finite(const geometry::Vector3_& vector, const std::string& field,
                            FirstError& errors) {
    return finite({vector.x(), vector.y(), vector.z()}, field, errors);
}

Eigen::Vector3d read_unit(const geometry::Vector3_& vector, const std::string& field,
                          FirstError& errors) {
    Eigen::Vector3d direction(vector.x(), vector.y(), vector.z());
    const double length = direction.norm();
    check_unit(length, field, errors);
    if (std::abs(length - 1.0) <= kExact) return direction;
    return direction / length;
}

Eigen::Isometry3d read_pose(const geometry::Pose_& pose, const std::string& field,
                            FirstError& errors) {
    const auto& q = pose.orientation();
    Eigen::Quaterniond turn(q.w(), q.x(), q.y(), q.z());
    const double length = turn.norm();
    check_unit(length, field + ".orientation", errors);
    if (!(std::abs(length - 1.0) <= kExact)) turn.coeffs() /= length;
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = turn.toRotationMatrix();
    out.translation() = read_finite(pose.position(), field + ".position", errors);
    return out;
}

TriangleMesh read_mesh(const shape_msgs::msg::dds_::Mesh_& mesh) {
    TriangleMesh out;
    out.vertices.reserve(mesh.vertices().size());
    for (const auto& v : mesh.vertices()) {
        stop_point(out.vertices.size());
        out.vertices.emplace_back(v.x(), v.y(), v.z());
    }
    out.faces.reserve(mesh.triangles().size());
    for (const auto& triangle : mesh.triangles()) {
        stop_point(out.faces.size());
        out.faces.push_back(triangle.vertex_indices());
    }
    return out;
}

bool is_empty(const shape_msgs::msg::dds_::Mesh_& mesh) {
    return mesh.vertices().empty() && mesh.triangles().empty();
}

geometry::Point_ write_point(const Eigen::Vector3d& point) {
    geometry::Point_ out;
    out.x(point.x());
    out.y(point.y());
    out.z(point.z());
    return out;
}

geometry::Vector3_ write_vector(const Eigen::Vector3d& vector) {
    geometry::Vector3_ out;
    out.x(vector.x());
    out.y(vector.y());
    out.z(vector.z());
    return out;
}

geometry::Pose_ write_pose(const Eigen::Isometry3d& pose) {
    Eigen::Quaterniond turn(pose.linear());
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    geometry::Pose_ out;
    out.position(write_point(pose.translation()));
    out.orientation().x(turn.x());
    out.orientation().y(turn.y());
    out.orientation().z(turn.z());
    out.orientation().w(turn.w());
    return out;
}

shape_msgs::msg::dds_::Mesh_ write_mesh(const TriangleMesh& mesh) {
    shape_msgs::msg::dds_::Mesh_ out;
    out.vertices().reserve(mesh.vertices.size());
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
        out.vertices().push_back(write_point(vertex));
    }
    out.triangles().resize(mesh.faces.size());
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        out.triangles()[i].vertex_indices(mesh.faces[i]);
    }
    return out;
}

}  // namespace graspd::dds
