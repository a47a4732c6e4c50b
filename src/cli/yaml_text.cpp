#include "yaml_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace graspd::cli {

std::string float_text(double value) {
    if (std::isnan(value)) return ".nan";
    if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    std::string text(digits.data(), end);
    if (text.find('.') != std::string::npos) return text;
    const std::size_t exponent = text.find('e');
    return exponent == std::string::npos ? text + ".0" : text.insert(exponent, ".0");
}

YAML::Emitter& operator<<(YAML::Emitter& out, const YamlFloat& number) {
    return out << float_text(number.value);
}

YAML::Emitter& operator<<(YAML::Emitter& out, const YamlText& text) {
    return out << YAML::DoubleQuoted << text.value;
}

YAML::Emitter& operator<<(YAML::Emitter& out, const YamlFloats& numbers) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const double value : numbers.values) out << float_text(value);
    return out << YAML::EndSeq;
}

YAML::Emitter& operator<<(YAML::Emitter& out, const YamlVector& vector) {
    out << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "x" << YAML::Value << YamlFloat{vector.value.x()};
    out << YAML::Key << "y" << YAML::Value << YamlFloat{vector.value.y()};
    out << YAML::Key << "z" << YAML::Value << YamlFloat{vector.value.z()};
    return out << YAML::EndMap;
}

Eigen::Quaterniond quaternion_of(const Eigen::Isometry3d& pose) {
    Eigen::Quaterniond turn(pose.linear());
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    return turn;
}

}  // namespace graspd::cli
