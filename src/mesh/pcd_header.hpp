#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "byte_order.hpp"
#include "graspd/base/result.hpp"
#include "text_scan.hpp"

namespace graspd::mesh_detail {

/// A field of a PCD point: `count` numbers of one type.
struct PcdField {
    std::string name;  ///< "_" is padding
    NumberType type;
    std::uint32_t count = 1;

    std::uint64_t bytes() const { return std::uint64_t{type.bytes} * count; }
};

enum class PcdData : std::uint8_t { kAscii, kBinary, kCompressed };

struct PcdHeader {
    std::vector<PcdField> fields;
    std::uint64_t points = 0;
    std::optional<Eigen::Vector3d> viewpoint;  ///< only one that is not the origin
    PcdData data = PcdData::kAscii;
    std::size_t axis_field[3] = {};  ///< indices in `fields` of x, y, z
};

/// Reads up to and including the "DATA" line.
Result<PcdHeader> parse_pcd_header(TextScan& scan);

}  // namespace graspd::mesh_detail
