#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd::mesh_detail {

// One parser a format, on the file's bytes in memory. Ours, because the contract of read_object
// cannot be kept with a library's: CGAL 5.5 merges equal STL corners (their indices would be lost),
// allocates what a header or a list count promises, misreads OBJ files with tabs or an index of 0,
// and says only "false" where a person needs the reason; pcl_io would link VTK and reads PLY files
// of doubles as zeros.

/// A file's records as stored: nothing merged, dropped or checked across records.
struct ParsedObject {
    std::vector<Eigen::Vector3d> points;       ///< file's unit; may hold NaN
    std::vector<std::int64_t> corners;         ///< point indices of all polygons, any value
    std::vector<std::uint32_t> corner_counts;  ///< per polygon
    std::optional<Eigen::Vector3d> sensor_origin;

    void add_polygon(std::initializer_list<std::int64_t> polygon) {
        corners.insert(corners.end(), polygon);
        corner_counts.push_back(static_cast<std::uint32_t>(polygon.size()));
    }
};

/// All of them: kUnreadableFile with the reason (the path is added by read_object). Counts in
/// headers are held against the bytes that are there before memory is reserved.
Result<ParsedObject> parse_stl(std::string_view bytes);
Result<ParsedObject> parse_obj(std::string_view bytes);
Result<ParsedObject> parse_off(std::string_view bytes);
Result<ParsedObject> parse_ply(std::string_view bytes);
Result<ParsedObject> parse_pcd(std::string_view bytes);

/// Cuts a polygon into triangles: a fan about the first corner when it is convex, else by ears.
/// @param polygon  (n >= 3) indices into points
void triangulate_polygon(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<std::uint32_t>& polygon,
                         std::vector<Triangle>& triangles);

}  // namespace graspd::mesh_detail
