#pragma once

#include <yaml-cpp/yaml.h>

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace graspd::cli {

// How the exports write YAML: for yaml-cpp and for the readers of other tools, most of which are
// PyYAML (YAML 1.1).

/// The shortest text that reads back as the same double, always with a decimal point: PyYAML takes
/// 1e-05 for a text, and ROS takes an integer in a list of floats for an error. Infinity is .inf.
std::string float_text(double value);

/// A float of a message.
struct YamlFloat {
    double value = 0.0;
};
YAML::Emitter& operator<<(YAML::Emitter& out, const YamlFloat& number);

/// A text in double quotes, so that names such as "on" or "1.5" stay texts.
struct YamlText {
    std::string value;
};
YAML::Emitter& operator<<(YAML::Emitter& out, const YamlText& text);

/// [a, b, ...]
struct YamlFloats {
    std::span<const double> values;
};
YAML::Emitter& operator<<(YAML::Emitter& out, const YamlFloats& numbers);

/// {x: a, y: b, z: c}, as geometry_msgs has it.
struct YamlVector {
    Eigen::Vector3d value;
};
YAML::Emitter& operator<<(YAML::Emitter& out, const YamlVector& vector);

/// The quaternion of a rotation with w >= 0, as q and -q are the same rotation.
Eigen::Quaterniond quaternion_of(const Eigen::Isometry3d& pose);

}  // namespace graspd::cli
