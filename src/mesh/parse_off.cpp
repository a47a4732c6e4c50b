#include <array>

#include "object_parsers.hpp"
#include "text_scan.hpp"

namespace graspd::mesh_detail {
namespace {

// "0 0 0\n", and "0\n": the fewest bytes that a vertex and a face can take.
constexpr std::uint64_t kLeastVertexBytes = 6;
constexpr std::uint64_t kLeastFaceBytes = 2;

struct Counts {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
};

/// Reads the keyword, where there is one, and the counts of vertices, faces and edges.
Result<Counts> read_counts(TextScan& scan) {
    if (!scan.seek_content()) return unreadable("OFF file is empty");
    TextScan ahead = scan;
    std::string_view word = ahead.token_of_line();
    std::string_view first;
    if (const std::size_t at = word.find("OFF"); at != std::string_view::npos) {
        const std::string_view prefix = word.substr(0, at);  // of ST, C, N: colours, normals, ...
        if (prefix.find_first_not_of("STCN") != std::string_view::npos) {
            return unreadable("OFF of kind ", shown(word), ": only three dimensions are read");
        }
        scan.token_of_line();
        first = word.substr(at + 3);  // some data sets write "OFF8 12 18"
        if (first.empty() && !scan.seek_content()) return unreadable("OFF ends after its keyword");
    }
    std::array<std::int64_t, 2> counts{};
    for (std::int64_t& count : counts) {
        if (first.empty()) first = scan.token();
        const std::optional<std::int64_t> value = to_integer(first);
        if (!value || *value < 0) {
            return unreadable("OFF, line ", scan.line(), ": ", shown(first),
                              first == "BINARY" ? " is not supported, write it as text"
                                                : " stands where a count should");
        }
        count = *value;
        first = {};
    }
    scan.next_line();  // the number of edges, which nobody needs
    return Counts{static_cast<std::uint64_t>(counts[0]), static_cast<std::uint64_t>(counts[1])};
}

std::optional<PlanError> read_vertex(TextScan& scan, ParsedObject& object, std::uint64_t count) {
    if (!scan.seek_content()) {
        return unreadable("OFF promises ", count, " vertices, ends after ", object.points.size());
    }
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view token = scan.token_of_line();
        const std::optional<double> value = to_number(token);
        if (!value) {
            return unreadable("OFF, line ", scan.line(), ": vertex ", object.points.size(), " has ",
                              shown(token), " for a coordinate");
        }
        point[axis] = *value;
    }
    object.points.push_back(point);
    scan.next_line();  // normal, colour, texture
    return std::nullopt;
}

std::optional<PlanError> read_face(TextScan& scan, ParsedObject& object, std::uint64_t count) {
    if (!scan.seek_content()) {
        return unreadable("OFF promises ", count, " faces, ends after ",
                          object.corner_counts.size());
    }
    const std::string_view token = scan.token_of_line();
    const std::optional<std::int64_t> corners = to_integer(token);
    if (!corners || *corners < 0) {
        return unreadable("OFF, line ", scan.line(), ": face ", object.corner_counts.size(),
                          " has ", shown(token), " corners");
    }
    for (std::int64_t k = 0; k < *corners; ++k) {
        const std::string_view corner = scan.token_of_line();
        const std::optional<std::int64_t> index = to_integer(corner);
        if (!index) {
            return unreadable("OFF, line ", scan.line(), ": corner ", k, " of face ",
                              object.corner_counts.size(), " is ", shown(corner));
        }
        object.corners.push_back(*index);
    }
    object.corner_counts.push_back(static_cast<std::uint32_t>(*corners));
    scan.next_line();  // colour
    return std::nullopt;
}

}  // namespace

Result<ParsedObject> parse_off(std::string_view bytes) {
    TextScan scan(bytes);
    const Result<Counts> counts = read_counts(scan);
    if (!counts) return counts.error();
    const auto [vertices, faces] = counts.value();
    const std::uint64_t there = scan.rest().size() + 1;  // the last line may lack its end
    if (vertices > there / kLeastVertexBytes || faces > there / kLeastFaceBytes) {
        return unreadable("OFF promises ", vertices, " vertices and ", faces, " faces, but only ",
                          there - 1, " bytes follow");
    }
    if (vertices == 0) return unreadable("OFF without a vertex");
    ParsedObject object;
    object.points.reserve(vertices);
    object.corner_counts.reserve(faces);
    while (object.points.size() < vertices) {
        if (auto bad = read_vertex(scan, object, vertices)) return *bad;
    }
    while (object.corner_counts.size() < faces) {
        if (auto bad = read_face(scan, object, faces)) return *bad;
    }
    return object;
}

}  // namespace graspd::mesh_detail
