#include "ply_header.hpp"

#include <string_view>

namespace graspd::mesh_detail {
namespace {

std::optional<NumberType> number_type(std::string_view name) {
    struct Row {
        std::string_view name;
        NumberType type;
    };
    static constexpr Row kRows[] = {
        {"char", {NumberKind::kSigned, 1}},     {"int8", {NumberKind::kSigned, 1}},
        {"uchar", {NumberKind::kUnsigned, 1}},  {"uint8", {NumberKind::kUnsigned, 1}},
        {"short", {NumberKind::kSigned, 2}},    {"int16", {NumberKind::kSigned, 2}},
        {"ushort", {NumberKind::kUnsigned, 2}}, {"uint16", {NumberKind::kUnsigned, 2}},
        {"int", {NumberKind::kSigned, 4}},      {"int32", {NumberKind::kSigned, 4}},
        {"uint", {NumberKind::kUnsigned, 4}},   {"uint32", {NumberKind::kUnsigned, 4}},
        {"int64", {NumberKind::kSigned, 8}},    {"uint64", {NumberKind::kUnsigned, 8}},
        {"float", {NumberKind::kFloat, 4}},     {"float32", {NumberKind::kFloat, 4}},
        {"double", {NumberKind::kFloat, 8}},    {"float64", {NumberKind::kFloat, 8}},
    };
    for (const Row& row : kRows) {
        if (row.name == name) return row.type;
    }
    return std::nullopt;
}

std::optional<PlanError> read_format(TextScan& scan, PlyHeader& header) {
    const std::string_view format = scan.token_of_line();
    if (format == "ascii") {
        header.format = PlyFormat::kAscii;
    } else if (format == "binary_little_endian") {
        header.format = PlyFormat::kLittleEndian;
    } else if (format == "binary_big_endian") {
        header.format = PlyFormat::kBigEndian;
    } else {
        return unreadable("PLY of format ", shown(format),
                          ", expected ascii, binary_little_endian or binary_big_endian");
    }
    return std::nullopt;
}

std::optional<PlanError> read_element(TextScan& scan, PlyHeader& header) {
    const std::string_view name = scan.token_of_line();
    const std::string_view token = scan.token_of_line();
    const std::optional<std::int64_t> count = to_integer(token);
    if (!count || *count < 0) {
        return unreadable("PLY, line ", scan.line(), ": element ", shown(name), " has count ",
                          shown(token));
    }
    header.elements.push_back({std::string(name), static_cast<std::uint64_t>(*count), {}});
    return std::nullopt;
}

std::optional<PlanError> read_property(TextScan& scan, PlyHeader& header) {
    if (header.elements.empty()) {
        return unreadable("PLY, line ", scan.line(), ": a property before any element");
    }
    PlyProperty property;
    std::string_view word = scan.token_of_line();
    if (word == "list") {
        word = scan.token_of_line();
        property.list_count = number_type(word);
        if (!property.list_count || property.list_count->kind == NumberKind::kFloat) {
            return unreadable("PLY, line ", scan.line(), ": list counts of type ", shown(word));
        }
        word = scan.token_of_line();
    }
    const std::optional<NumberType> type = number_type(word);
    if (!type) return unreadable("PLY, line ", scan.line(), ": unknown type ", shown(word));
    property.type = *type;
    property.name = scan.token_of_line();
    header.elements.back().properties.push_back(std::move(property));
    return std::nullopt;
}

/// Fewest bytes that a record can take: a digit and a blank for each number in ascii.
std::uint64_t least_bytes(const PlyElement& element, PlyFormat format) {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        const std::uint8_t binary =
            property.list_count ? property.list_count->bytes : property.type.bytes;
        bytes += format == PlyFormat::kAscii ? 2 : binary;
    }
    return bytes;
}

std::optional<PlanError> check_counts(const PlyHeader& header, std::uint64_t bytes_left) {
    std::uint64_t left = bytes_left + (header.format == PlyFormat::kAscii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        if (element.count == 0) continue;
        const std::uint64_t each = least_bytes(element, header.format);
        if (each == 0) return unreadable("PLY element ", shown(element.name), " has no property");
        if (element.count > left / each) {
            return unreadable("PLY promises ", element.count, " ", shown(element.name),
                              " records of at least ", each, " bytes, but only ", left,
                              " bytes are left");
        }
        left -= element.count * each;
    }
    return std::nullopt;
}

}  // namespace

Result<PlyHeader> parse_ply_header(TextScan& scan) {
    if (scan.token_of_line() != "ply") return unreadable("PLY file does not begin with 'ply'");
    PlyHeader header;
    bool has_format = false;
    while (scan.next_line()) {
        const std::string_view word = scan.token_of_line();
        std::optional<PlanError> bad;
        if (word == "format") {
            bad = read_format(scan, header);
            has_format = true;
        } else if (word == "element") {
            bad = read_element(scan, header);
        } else if (word == "property") {
            bad = read_property(scan, header);
        } else if (word == "end_header") {
            if (!has_format) return unreadable("PLY header without a 'format' line");
            scan.next_line();
            if (auto wrong = check_counts(header, scan.rest().size())) return *wrong;
            return header;
        } else if (word != "comment" && word != "obj_info" && !word.empty()) {
            return unreadable("PLY, line ", scan.line(), ": unknown header word ", shown(word));
        }
        if (bad) return *bad;
    }
    return unreadable("PLY header has no 'end_header'");
}

}  // namespace graspd::mesh_detail
