#include "graspd/mesh/read_object.hpp"

#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

#include "object_parsers.hpp"
#include "text_scan.hpp"

namespace graspd {
namespace {

using namespace mesh_detail;

// A gibibyte is 20 million STL facets, five times what condition_mesh takes by default.
constexpr std::uintmax_t kMostFileBytes = 1u << 30;

using Parser = Result<ParsedObject> (*)(std::string_view);

Parser parser_of(const std::string& extension) {
    if (extension == ".stl") return parse_stl;
    if (extension == ".obj") return parse_obj;
    if (extension == ".off") return parse_off;
    if (extension == ".ply") return parse_ply;
    if (extension == ".pcd") return parse_pcd;
    return nullptr;
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

Result<std::string> read_bytes(const std::filesystem::path& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) {
        return unreadable(status ? status.message() : "not a regular file");
    }
    const std::uintmax_t size = std::filesystem::file_size(path, status);
    if (status) return unreadable(status.message());
    if (size > kMostFileBytes) {
        return unreadable("file has ", size, " bytes, the most is ", kMostFileBytes);
    }
    std::ifstream file(path, std::ios::binary);
    std::string bytes(size, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!file || file.gcount() != static_cast<std::streamsize>(size)) {
        return unreadable("cannot be read to its end (", size, " bytes)");
    }
    return bytes;
}

/// Faces as triangles, and what did not become one.
struct Faces {
    std::vector<Triangle> triangles;
    std::size_t polygons = 0;  ///< with more than three corners
    std::size_t dropped = 0;   ///< fewer than three corners, or one out of range
    std::string first_dropped;
};

Faces make_triangles(const ParsedObject& parsed) {
    Faces faces;
    faces.triangles.reserve(parsed.corner_counts.size());
    std::vector<std::uint32_t> polygon;
    std::size_t first = 0;
    for (std::size_t f = 0; f < parsed.corner_counts.size(); ++f) {
        const std::size_t count = parsed.corner_counts[f];
        polygon.clear();
        for (std::size_t k = first; k < first + count; ++k) {
            const std::int64_t corner = parsed.corners[k];
            if (corner < 0 || corner >= static_cast<std::int64_t>(parsed.points.size())) break;
            polygon.push_back(static_cast<std::uint32_t>(corner));
        }
        first += count;
        if (polygon.size() < count || count < 3) {
            if (faces.dropped++ == 0) {
                faces.first_dropped =
                    "first: face " + std::to_string(f) +
                    (count < 3 ? ", " + std::to_string(count) + " corners"
                               : ", corner " + std::to_string(polygon.size()) + " is no vertex");
            }
            continue;
        }
        faces.polygons += count > 3;
        triangulate_polygon(parsed.points, polygon, faces.triangles);
    }
    return faces;
}

void report(const Faces& faces, std::size_t not_finite, std::vector<Finding>& findings) {
    const auto add = [&](const char* code, std::size_t count, const std::string& detail) {
        if (count == 0) return;
        findings.push_back({code, static_cast<double>(count), std::to_string(count) + detail});
    };
    add("polygons_triangulated", faces.polygons, " faces had more than three corners");
    add("faces_dropped", faces.dropped, " faces were unusable; " + faces.first_dropped);
    add("points_not_finite", not_finite, " points have a coordinate that is not finite");
}

Result<ObjectFile> assemble(ParsedObject parsed, double scale) {
    std::size_t not_finite = 0;
    for (Eigen::Vector3d& point : parsed.points) {
        point *= scale;
        not_finite += !point.allFinite();
    }
    if (parsed.sensor_origin) *parsed.sensor_origin *= scale;
    Faces faces = make_triangles(parsed);
    ObjectFile file;
    report(faces, not_finite, file.findings);
    if (parsed.corner_counts.empty()) {
        file.object = PointCloud{std::move(parsed.points), parsed.sensor_origin};
        return file;
    }
    if (faces.triangles.empty()) {
        return unreadable("none of its ", parsed.corner_counts.size(), " faces is usable; ",
                          faces.first_dropped);
    }
    file.object = TriangleMesh{std::move(parsed.points), std::move(faces.triangles)};
    return file;
}

Result<ObjectFile> parse_file(const std::filesystem::path& path, Parser parse, double scale) {
    const Result<std::string> bytes = read_bytes(path);
    if (!bytes) return bytes.error();
    Result<ParsedObject> parsed = parse(bytes.value());
    if (!parsed) return parsed.error();
    return assemble(std::move(parsed).value(), scale);
}

}  // namespace

Result<ObjectFile> read_object(const std::filesystem::path& path, double scale) {
    if (!std::isfinite(scale) || scale <= 0.0) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "scale = " + std::to_string(scale) + " is not a number above 0"};
    }
    const std::string extension = lower_extension(path);
    const Parser parse = parser_of(extension);
    if (!parse) {
        return unreadable(path.string(), ": extension ", shown(extension),
                          ", expected .stl, .obj, .off, .ply or .pcd");
    }
    Result<ObjectFile> file = parse_file(path, parse, scale);
    if (!file) return PlanError{file.error().code, path.string() + ": " + file.error().detail};
    return file;
}

}  // namespace graspd
