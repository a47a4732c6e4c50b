#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "byte_order.hpp"
#include "graspd/base/result.hpp"
#include "text_scan.hpp"

namespace graspd::mesh_detail {

/// A property of a PLY element: one number, or a counted list of numbers.
struct PlyProperty {
    std::string name;
    NumberType type;
    std::optional<NumberType> list_count;  ///< type of the count, for lists
};

/// One kind of record, such as "vertex", and how many the file holds.
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
    PlyFormat format = PlyFormat::kAscii;
    std::vector<PlyElement> elements;
};

/// Reads up to and including the "end_header" line, and holds every count against the bytes that
/// follow.
Result<PlyHeader> parse_ply_header(TextScan& scan);

}  // namespace graspd::mesh_detail
