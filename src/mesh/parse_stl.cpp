#include <cstring>
#include <string>

#include "byte_order.hpp"
#include "object_parsers.hpp"
#include "text_scan.hpp"

namespace graspd::mesh_detail {
namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of title, a 32-bit facet count
constexpr std::size_t kFacetBytes = 50;   // normal, three corners, two bytes of attributes

Result<ParsedObject> parse_binary(std::string_view bytes, std::uint32_t facets) {
    ParsedObject object;
    object.points.reserve(3 * std::size_t{facets});
    for (std::uint32_t f = 0; f < facets; ++f) {
        const char* corner = bytes.data() + kHeaderBytes + f * kFacetBytes + 12;
        for (int k = 0; k < 3; ++k, corner += 12) {
            object.points.emplace_back(load_little<float>(corner), load_little<float>(corner + 4),
                                       load_little<float>(corner + 8));
        }
        const std::int64_t first = 3 * std::int64_t{f};
        object.add_polygon({first, first + 1, first + 2});
    }
    return object;
}

bool same_word(std::string_view token, std::string_view word) {
    if (token.size() != word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if ((token[i] | 0x20) != word[i]) return false;
    }
    return true;
}

std::optional<PlanError> read_corner(TextScan& scan, ParsedObject& object) {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view token = scan.token();
        const std::optional<double> value = to_number(token);
        if (!value) {
            return unreadable("ascii STL, line ", scan.line(), ": ", shown(token),
                              " stands where a coordinate should");
        }
        point[axis] = *value;
    }
    object.points.push_back(point);
    return std::nullopt;
}

/// Reads "... vertex x y z vertex x y z vertex x y z endloop endfacet", behind "facet".
std::optional<PlanError> read_facet(TextScan& scan, ParsedObject& object) {
    const std::size_t first = object.points.size();
    for (std::string_view word = scan.token(); !same_word(word, "endfacet"); word = scan.token()) {
        if (word.empty()) {
            return unreadable("ascii STL ends within facet ", object.corner_counts.size());
        }
        if (!same_word(word, "vertex")) continue;  // normal, its numbers, outer, loop, endloop
        if (auto bad = read_corner(scan, object)) return bad;
    }
    if (object.points.size() - first != 3) {
        return unreadable("ascii STL, line ", scan.line(), ": facet ", object.corner_counts.size(),
                          " has ", object.points.size() - first, " corners, expected 3");
    }
    const std::int64_t corner = static_cast<std::int64_t>(first);
    object.add_polygon({corner, corner + 1, corner + 2});
    return std::nullopt;
}

Result<ParsedObject> parse_ascii(std::string_view bytes) {
    ParsedObject object;
    TextScan scan(bytes);
    for (std::string_view word = scan.token(); !word.empty(); word = scan.token()) {
        if (same_word(word, "solid") || same_word(word, "endsolid")) {
            scan.next_line();  // a title may hold any word
        } else if (same_word(word, "facet")) {
            if (auto bad = read_facet(scan, object)) return *bad;
        } else {
            return unreadable("ascii STL, line ", scan.line(), ": ", shown(word),
                              " stands where 'facet' or 'endsolid' should");
        }
    }
    if (object.points.empty()) return unreadable("ascii STL without a facet");
    return object;
}

}  // namespace

Result<ParsedObject> parse_stl(std::string_view bytes) {
    // Many binary files begin with "solid" too: the size decides, then the word.
    std::uint64_t facets = 0;
    if (bytes.size() >= kHeaderBytes) facets = load_little<std::uint32_t>(bytes.data() + 80);
    const std::uint64_t promised = kHeaderBytes + kFacetBytes * facets;
    if (facets > 0 && promised == bytes.size()) {
        return parse_binary(bytes, static_cast<std::uint32_t>(facets));
    }
    TextScan scan(bytes);
    if (same_word(scan.token(), "solid")) return parse_ascii(bytes);
    if (facets > 0 && promised < bytes.size()) {  // some writers append bytes of their own
        return parse_binary(bytes, static_cast<std::uint32_t>(facets));
    }
    if (bytes.size() < kHeaderBytes) {
        return unreadable("neither ascii STL (no 'solid') nor binary STL (", bytes.size(),
                          " bytes, header needs ", kHeaderBytes, ")");
    }
    return unreadable("binary STL promises ", facets, " facets in ", promised, " bytes, file has ",
                      bytes.size());
}

}  // namespace graspd::mesh_detail
