#include "object_parsers.hpp"
#include "text_scan.hpp"

namespace graspd::mesh_detail {
namespace {

/// Next token of the logical line: a backslash at a line's end continues it.
std::string_view next_token(TextScan& scan) {
    std::string_view token = scan.token_of_line();
    while (token == "\\" && scan.next_line()) token = scan.token_of_line();
    return token;
}

std::optional<PlanError> read_vertex(TextScan& scan, ParsedObject& object) {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view token = next_token(scan);
        const std::optional<double> value = to_number(token);
        if (!value) {
            return unreadable("OBJ, line ", scan.line(), ": vertex ", object.points.size(), " has ",
                              shown(token), " for a coordinate");
        }
        point[axis] = *value;
    }
    object.points.push_back(point);
    return std::nullopt;
}

std::optional<PlanError> read_face(TextScan& scan, ParsedObject& object) {
    std::uint32_t count = 0;
    for (std::string_view token = next_token(scan); !token.empty(); token = next_token(scan)) {
        const std::optional<std::int64_t> index = to_integer(token.substr(0, token.find('/')));
        if (!index) {
            return unreadable("OBJ, line ", scan.line(), ": face ", object.corner_counts.size(),
                              " has ", shown(token), " for a corner");
        }
        // Counted from 1, or backwards from the last vertex so far; 0 means none.
        const std::int64_t so_far = static_cast<std::int64_t>(object.points.size());
        object.corners.push_back(*index > 0 ? *index - 1 : *index < 0 ? so_far + *index : -1);
        ++count;
    }
    object.corner_counts.push_back(count);
    return std::nullopt;
}

}  // namespace

Result<ParsedObject> parse_obj(std::string_view bytes) {
    ParsedObject object;
    TextScan scan(bytes);
    while (scan.seek_content()) {
        const std::string_view word = next_token(scan);
        if (word == "v") {
            if (auto bad = read_vertex(scan, object)) return *bad;
        } else if (word == "f" || word == "fo") {
            if (auto bad = read_face(scan, object)) return *bad;
        }
        // Everything else (normals, texture, groups, materials, curves) does not shape the object.
        scan.next_line();
    }
    if (object.points.empty()) return unreadable("OBJ without a vertex ('v x y z')");
    return object;
}

}  // namespace graspd::mesh_detail
