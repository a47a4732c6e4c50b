#include <array>
#include <cmath>

#include "object_parsers.hpp"
#include "ply_header.hpp"

namespace graspd::mesh_detail {
namespace {

/// Gives the body's numbers one after the other, whatever the format.
class PlyNumbers {
public:
    PlyNumbers(const TextScan& scan, PlyFormat format)
        : scan_(scan), bytes_(scan.rest()), format_(format) {}

    /// The next number; nothing when the file ends or holds something else there.
    std::optional<double> next(NumberType type) {
        if (format_ == PlyFormat::kAscii) return to_number(scan_.token());
        if (bytes_.size() < type.bytes) return std::nullopt;
        const double value = load_number(bytes_.data(), type, format_ == PlyFormat::kBigEndian);
        bytes_.remove_prefix(type.bytes);
        return value;
    }
    /// Numbers that the rest of the file can hold at most.
    std::uint64_t at_most(NumberType type) const {
        return format_ == PlyFormat::kAscii ? scan_.rest().size() / 2 + 1
                                            : bytes_.size() / type.bytes;
    }

private:
    TextScan scan_;
    std::string_view bytes_;
    PlyFormat format_;
};

PlanError broken_record(const PlyElement& element, std::uint64_t record,
                        const PlyProperty& property) {
    return unreadable("PLY record ", record, " of ", shown(element.name), ", property ",
                      shown(property.name), ": the file ends or holds no number there");
}

/// Reads a list; with `faces` given, it becomes a polygon there.
std::optional<PlanError> read_list(PlyNumbers& numbers, const PlyElement& element,
                                   std::uint64_t record, const PlyProperty& property,
                                   ParsedObject* faces) {
    const std::optional<double> count = numbers.next(*property.list_count);
    if (!count) return broken_record(element, record, property);
    if (!(*count >= 0.0) || *count > static_cast<double>(numbers.at_most(property.type))) {
        return unreadable("PLY record ", record, " of ", shown(element.name), ": list ",
                          shown(property.name), " promises ", *count,
                          " numbers, more than the file has left");
    }
    const std::uint32_t length = static_cast<std::uint32_t>(*count);
    for (std::uint32_t k = 0; k < length; ++k) {
        const std::optional<double> value = numbers.next(property.type);
        if (!value) return broken_record(element, record, property);
        const bool whole = std::abs(*value) < 9e15 && *value == std::floor(*value);
        if (faces) faces->corners.push_back(whole ? static_cast<std::int64_t>(*value) : -1);
    }
    if (faces) faces->corner_counts.push_back(length);
    return std::nullopt;
}

/// What to keep of an element: coordinates by property, and the property with the corners.
struct Selection {
    std::array<std::size_t, 3> coordinate{SIZE_MAX, SIZE_MAX, SIZE_MAX};
    std::size_t corners = SIZE_MAX;
    bool is_vertex = false;
};

Result<Selection> select(const PlyElement& element) {
    Selection selection;
    selection.is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (is_face && property.list_count &&
            (property.name == "vertex_indices" || property.name == "vertex_index")) {
            selection.corners = i;
        }
        if (!selection.is_vertex || property.list_count || property.name.size() != 1) continue;
        const int axis = property.name[0] - 'x';
        if (axis >= 0 && axis < 3) selection.coordinate[static_cast<std::size_t>(axis)] = i;
    }
    for (std::size_t axis = 0; selection.is_vertex && axis < 3; ++axis) {
        if (selection.coordinate[axis] == SIZE_MAX) {
            return unreadable("PLY vertices have no property '", "xyz"[axis], "'");
        }
    }
    if (is_face && element.count > 0 && selection.corners == SIZE_MAX) {
        return unreadable("PLY faces have no list 'vertex_indices' or 'vertex_index'");
    }
    if (element.name == "tristrips" && element.count > 0) {
        return unreadable("PLY triangle strips are not supported, write faces");
    }
    return selection;
}

std::optional<PlanError> read_element(PlyNumbers& numbers, const PlyElement& element,
                                      ParsedObject& object) {
    const Result<Selection> selected = select(element);
    if (!selected) return selected.error();
    const Selection& selection = selected.value();
    if (selection.is_vertex) object.points.reserve(object.points.size() + element.count);
    if (selection.corners != SIZE_MAX) object.corner_counts.reserve(element.count);
    for (std::uint64_t record = 0; record < element.count; ++record) {
        Eigen::Vector3d point = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.list_count) {
                ParsedObject* faces = i == selection.corners ? &object : nullptr;
                if (auto bad = read_list(numbers, element, record, property, faces)) return bad;
                continue;
            }
            const std::optional<double> value = numbers.next(property.type);
            if (!value) return broken_record(element, record, property);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (selection.coordinate[axis] == i) point[static_cast<int>(axis)] = *value;
            }
        }
        if (selection.is_vertex) object.points.push_back(point);
    }
    return std::nullopt;
}

}  // namespace

Result<ParsedObject> parse_ply(std::string_view bytes) {
    TextScan scan(bytes);
    const Result<PlyHeader> header = parse_ply_header(scan);
    if (!header) return header.error();
    ParsedObject object;
    PlyNumbers numbers(scan, header.value().format);
    for (const PlyElement& element : header.value().elements) {
        if (auto bad = read_element(numbers, element, object)) return *bad;
    }
    if (object.points.empty()) return unreadable("PLY without a vertex");
    return object;
}

}  // namespace graspd::mesh_detail
