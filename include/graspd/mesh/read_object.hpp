#pragma once

#include <filesystem>
#include <variant>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// An object file's contents: a mesh when the file has faces, else a cloud.
/// Vertices are kept as stored, so that index i means the file's i-th vertex record (for STL, which
/// has none, vertex 3f + k is corner k of facet f).
struct ObjectFile {
    std::variant<TriangleMesh, PointCloud> object;
    std::vector<Finding> findings;  ///< polygons_triangulated, faces_dropped, points_not_finite
};

/// Reads STL, OBJ, OFF, PLY (ascii and binary, float and double) or PCD (ascii, binary,
/// binary_compressed), by the file name's extension in any case.
///
/// @param scale  factor on every coordinate, > 0: 0.001 for a file in millimetres
/// @return kUnreadableFile naming the path and what was expected; kInvalidInput for a bad scale
Result<ObjectFile> read_object(const std::filesystem::path& path, double scale = 1.0);

}  // namespace graspd
