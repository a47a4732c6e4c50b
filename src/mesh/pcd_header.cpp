#include "pcd_header.hpp"

#include <array>
#include <string_view>

namespace graspd::mesh_detail {
namespace {

constexpr std::size_t kMostFields = 4096;
constexpr std::int64_t kMostPerField = 65536;     // longest descriptors hold some thousand
constexpr std::int64_t kMostPoints = 1000000000;  // keeps products of counts within 64 bits

/// The header's lines before their parts are put together.
struct Lines {
    std::vector<std::string_view> fields, sizes, types, counts;
    std::int64_t width = -1, height = 1, points = -1;
    std::string_view data;
};

std::vector<std::string_view> rest_of_line(TextScan& scan) {
    std::vector<std::string_view> tokens;
    for (auto token = scan.token_of_line(); !token.empty(); token = scan.token_of_line()) {
        if (tokens.size() <= kMostFields) tokens.push_back(token);
    }
    return tokens;
}

std::optional<PlanError> read_count(TextScan& scan, std::string_view word, std::int64_t& count) {
    const std::string_view token = scan.token_of_line();
    const std::optional<std::int64_t> value = to_integer(token);
    if (!value || *value < 0 || *value > kMostPoints) {
        return unreadable("PCD ", word, " is ", shown(token), ", expected 0 to ", kMostPoints);
    }
    count = *value;
    return std::nullopt;
}

/// The first three numbers of VIEWPOINT. Writers put the origin when they do not know.
std::optional<Eigen::Vector3d> read_viewpoint(TextScan& scan) {
    Eigen::Vector3d place;
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<double> value = to_number(scan.token_of_line());
        if (!value) return std::nullopt;
        place[axis] = *value;
    }
    if (!place.allFinite() || place.isZero(0.0)) return std::nullopt;
    return place;
}

std::optional<PlanError> read_lines(TextScan& scan, Lines& lines, PcdHeader& header) {
    while (scan.seek_content()) {
        const std::string_view word = scan.token_of_line();
        std::optional<PlanError> bad;
        if (word == "FIELDS" || word == "COLUMNS")
            lines.fields = rest_of_line(scan);
        else if (word == "SIZE")
            lines.sizes = rest_of_line(scan);
        else if (word == "TYPE")
            lines.types = rest_of_line(scan);
        else if (word == "COUNT")
            lines.counts = rest_of_line(scan);
        else if (word == "WIDTH")
            bad = read_count(scan, word, lines.width);
        else if (word == "HEIGHT")
            bad = read_count(scan, word, lines.height);
        else if (word == "POINTS")
            bad = read_count(scan, word, lines.points);
        else if (word == "VIEWPOINT")
            header.viewpoint = read_viewpoint(scan);
        else if (word == "DATA")
            lines.data = scan.token_of_line();
        else if (word != "VERSION")
            bad = unreadable("PCD, line ", scan.line(), ": unknown header word ", shown(word));
        if (bad) return bad;
        scan.next_line();
        if (!lines.data.empty()) return std::nullopt;
    }
    return unreadable("PCD header has no 'DATA' line");
}

std::optional<PcdField> make_field(const Lines& lines, std::size_t i) {
    PcdField field;
    field.name = lines.fields[i];
    const std::optional<std::int64_t> size = to_integer(lines.sizes[i]);
    const std::optional<std::int64_t> count =
        lines.counts.empty() ? std::optional<std::int64_t>(1) : to_integer(lines.counts[i]);
    if (!size || !count || *count < 1 || *count > kMostPerField) return std::nullopt;
    field.count = static_cast<std::uint32_t>(*count);
    const std::string_view type = lines.types[i];
    if (type == "F")
        field.type.kind = NumberKind::kFloat;
    else if (type == "I")
        field.type.kind = NumberKind::kSigned;
    else if (type == "U")
        field.type.kind = NumberKind::kUnsigned;
    else
        return std::nullopt;
    const bool fits = *size == 4 || *size == 8 ||
                      (field.type.kind != NumberKind::kFloat && (*size == 1 || *size == 2));
    // Padding may be of any length and is never read as a number.
    if (field.name == "_" && *size >= 1 && *size <= 255)
        field.type.kind = NumberKind::kUnsigned;
    else if (!fits)
        return std::nullopt;
    field.type.bytes = static_cast<std::uint8_t>(*size);
    return field;
}

std::optional<PlanError> make_fields(const Lines& lines, PcdHeader& header) {
    const std::size_t n = lines.fields.size();
    if (n == 0 || n > kMostFields || lines.sizes.size() != n || lines.types.size() != n ||
        (!lines.counts.empty() && lines.counts.size() != n)) {
        return unreadable("PCD lines FIELDS, SIZE, TYPE, COUNT have ", n, ", ", lines.sizes.size(),
                          ", ", lines.types.size(), ", ", lines.counts.size(), " entries");
    }
    for (std::size_t i = 0; i < n; ++i) {
        const std::optional<PcdField> field = make_field(lines, i);
        if (!field) {
            return unreadable("PCD field ", shown(lines.fields[i]), " has SIZE ",
                              shown(lines.sizes[i]), ", TYPE ", shown(lines.types[i]), ", COUNT ",
                              shown(lines.counts.empty() ? "1" : lines.counts[i]));
        }
        header.fields.push_back(*field);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string_view name = std::string_view("xyz").substr(axis, 1);
        std::size_t i = 0;
        while (i < n && (header.fields[i].name != name || header.fields[i].count != 1)) ++i;
        if (i == n) return unreadable("PCD has no field ", shown(name), " of one number");
        header.axis_field[axis] = i;
    }
    return std::nullopt;
}

std::optional<PlanError> settle_points(const Lines& lines, PcdHeader& header) {
    const std::int64_t grid = lines.width < 0 ? -1 : lines.width * lines.height;
    const std::int64_t points = lines.points < 0 ? grid : lines.points;
    if (points < 0) return unreadable("PCD has neither POINTS nor WIDTH");
    if (grid >= 0 && grid != points) {
        return unreadable("PCD POINTS is ", points, ", but WIDTH x HEIGHT is ", lines.width, " x ",
                          lines.height);
    }
    if (points == 0 || points > kMostPoints) return unreadable("PCD holds ", points, " points");
    header.points = static_cast<std::uint64_t>(points);
    return std::nullopt;
}

}  // namespace

Result<PcdHeader> parse_pcd_header(TextScan& scan) {
    Lines lines;
    PcdHeader header;
    if (auto bad = read_lines(scan, lines, header)) return *bad;
    if (auto bad = make_fields(lines, header)) return *bad;
    if (auto bad = settle_points(lines, header)) return *bad;
    if (lines.data == "ascii")
        header.data = PcdData::kAscii;
    else if (lines.data == "binary")
        header.data = PcdData::kBinary;
    else if (lines.data == "binary_compressed")
        header.data = PcdData::kCompressed;
    else
        return unreadable("PCD DATA is ", shown(lines.data),
                          ", expected ascii, binary or binary_compressed");
    return header;
}

}  // namespace graspd::mesh_detail
