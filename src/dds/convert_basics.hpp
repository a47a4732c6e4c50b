#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "wire_types.hpp"

namespace graspd::dds {

// Between the wire's plain structs and Eigen. Functions that read a field take its path, such as
// "obstacles[2].pose", and note the first one that is wrong.

/// Remembers the first error of a conversion; later ones are dropped.
class FirstError {
public:
    void set(PlanErrorCode code, std::string detail) {
        if (!error_) error_ = PlanError{code, std::move(detail)};
    }
    void invalid(std::string detail) { set(PlanErrorCode::kInvalidInput, std::move(detail)); }

    bool any() const { return error_.has_value(); }
    const std::optional<PlanError>& error() const { return error_; }

private:
    std::optional<PlanError> error_;
};

/// A range for read_number(), with how it is written.
struct NumberRange {
    double least = 0.0;
    double greatest = 0.0;
    bool open_at_least = false;  ///< `least` itself is outside
};

inline constexpr double kLargest = std::numeric_limits<double>::max();
inline constexpr NumberRange kPositive{0.0, kLargest, true};
inline constexpr std::size_t kMostFrameId = 256;  ///< characters of a header's frame_id

/// At most 64 characters, what is not printable ASCII replaced by '?'.
std::string printable(const std::string& text);
/// printable() in quotation marks, for messages.
std::string shown(const std::string& text);
/// The shortest decimal text of nine digits or fewer, for messages.
std::string shown(double value);
/// "name[index]".
std::string element(const std::string& name, std::size_t index);

/// Checks that a text has `least` to `most` characters, all printable ASCII.
void check_text(const std::string& text, const std::string& field,
                std::pair<std::size_t, std::size_t> length, FirstError& errors);
/// Checks a count against its bound of the IDL, which readers do not enforce.
void check_count(std::size_t count, std::size_t most, const std::string& field, FirstError& errors);
/// Checks that a number is finite and inside its range.
double read_number(double value, const std::string& field, const NumberRange& range,
                   FirstError& errors);

Eigen::Vector3d read_finite(const geometry_msgs::msg::dds_::Point_& point, const std::string& field,
                            FirstError& errors);
Eigen::Vector3d read_finite(const geometry_msgs::msg::dds_::Vector3_& vector,
                            const std::string& field, FirstError& errors);
/// A direction; its length must be 1 within 0.001, and is made 1 exactly.
Eigen::Vector3d read_unit(const geometry_msgs::msg::dds_::Vector3_& vector,
                          const std::string& field, FirstError& errors);
/// A pose; its quaternion's length must be 1 within 0.001, and is made 1 exactly.
Eigen::Isometry3d read_pose(const geometry_msgs::msg::dds_::Pose_& pose, const std::string& field,
                            FirstError& errors);
/// Every vertex and face as it stands: the planner judges indices and coordinates. Throws Stopped.
TriangleMesh read_mesh(const shape_msgs::msg::dds_::Mesh_& mesh);
bool is_empty(const shape_msgs::msg::dds_::Mesh_& mesh);

geometry_msgs::msg::dds_::Point_ write_point(const Eigen::Vector3d& point);
geometry_msgs::msg::dds_::Vector3_ write_vector(const Eigen::Vector3d& vector);
/// Of the two quaternions that mean the same rotation the one with w >= 0.
geometry_msgs::msg::dds_::Pose_ write_pose(const Eigen::Isometry3d& pose);
shape_msgs::msg::dds_::Mesh_ write_mesh(const TriangleMesh& mesh);

}  // namespace graspd::dds
