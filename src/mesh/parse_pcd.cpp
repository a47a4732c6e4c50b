#include <liblzf/lzf.h>

#include "object_parsers.hpp"
#include "pcd_header.hpp"

namespace graspd::mesh_detail {
namespace {

// PCD is read here because pcl_io, which could, is linked against VTK in Debian, and graspctl must
// not load a renderer to read points. liblzf is the library whose format binary_compressed is.

// LZF's longest match, 264 bytes, takes 3 bytes: nothing unpacks to more than 88 times its size.
constexpr std::uint64_t kMostExpansion = 88;

Result<ParsedObject> read_ascii(TextScan& scan, const PcdHeader& header) {
    std::uint64_t columns = 0;
    std::uint64_t column_of_axis[3] = {};
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (header.axis_field[axis] == i) column_of_axis[axis] = columns;
        }
        columns += header.fields[i].count;
    }
    if (header.points > (scan.rest().size() + 1) / (2 * columns)) {
        return unreadable("PCD promises ", header.points, " points of ", columns,
                          " columns, but only ", scan.rest().size(), " bytes follow");
    }
    ParsedObject object;
    object.points.reserve(header.points);
    for (std::uint64_t row = 0; row < header.points; ++row) {
        Eigen::Vector3d point;
        for (std::uint64_t column = 0; column < columns; ++column) {
            const std::string_view token = scan.token();
            if (token.empty()) {
                return unreadable("PCD promises ", header.points, " points, ends after ", row);
            }
            for (int axis = 0; axis < 3; ++axis) {
                if (column_of_axis[axis] != column) continue;
                const std::optional<double> value = to_number(token);
                if (!value) {
                    return unreadable("PCD, line ", scan.line(), ": ", shown(token),
                                      " stands where a coordinate should");
                }
                point[axis] = *value;
            }
        }
        object.points.push_back(point);
    }
    return object;
}

/// Where the fields of point i stand: base + i * step.
struct Layout {
    std::uint64_t base[3] = {};
    std::uint64_t step[3] = {};
};

std::uint64_t bytes_per_point(const PcdHeader& header, bool with_padding) {
    std::uint64_t bytes = 0;
    for (const PcdField& field : header.fields) {
        if (with_padding || field.name != "_") bytes += field.bytes();
    }
    return bytes;
}

/// @param by_field  all points' first field, then all second fields, ... as compressed files store
Layout lay_out(const PcdHeader& header, bool by_field, bool with_padding) {
    Layout layout;
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        const PcdField& field = header.fields[i];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (header.axis_field[axis] != i) continue;
            layout.base[axis] = by_field ? before * header.points : before;
            layout.step[axis] = by_field ? field.bytes() : bytes_per_point(header, with_padding);
        }
        if (with_padding || field.name != "_") before += field.bytes();
    }
    return layout;
}

ParsedObject gather(const char* bytes, const PcdHeader& header, const Layout& layout) {
    ParsedObject object;
    object.points.resize(header.points);
    for (std::uint64_t i = 0; i < header.points; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const NumberType type = header.fields[header.axis_field[axis]].type;
            object.points[i][axis] =
                load_number(bytes + layout.base[axis] + i * layout.step[axis], type, false);
        }
    }
    return object;
}

Result<ParsedObject> read_binary(std::string_view body, const PcdHeader& header) {
    const std::uint64_t step = bytes_per_point(header, true);
    if (header.points > body.size() / step) {
        return unreadable("PCD promises ", header.points, " points of ", step, " bytes, but only ",
                          body.size(), " bytes follow");
    }
    return gather(body.data(), header, lay_out(header, false, true));
}

Result<ParsedObject> read_compressed(std::string_view body, const PcdHeader& header) {
    if (body.size() < 8) return unreadable("PCD compressed data has no sizes");
    const std::uint64_t packed = load_little<std::uint32_t>(body.data());
    const std::uint64_t unpacked = load_little<std::uint32_t>(body.data() + 4);
    body.remove_prefix(8);
    // Writers differ in whether padding is stored.
    const bool with_padding = unpacked == header.points * bytes_per_point(header, true);
    if (!with_padding && unpacked != header.points * bytes_per_point(header, false)) {
        return unreadable("PCD compressed data unpacks to ", unpacked, " bytes, but ",
                          header.points, " points of ", bytes_per_point(header, true),
                          " bytes are promised");
    }
    if (packed > body.size() || unpacked > packed * kMostExpansion) {
        return unreadable("PCD compressed data promises ", unpacked, " bytes out of ", packed,
                          ", but ", body.size(), " bytes follow");
    }
    std::string data(unpacked, '\0');
    const unsigned written = lzf_decompress(body.data(), static_cast<unsigned>(packed), data.data(),
                                            static_cast<unsigned>(unpacked));
    if (written != unpacked) {
        return unreadable("PCD compressed data is broken: ", written, " of ", unpacked,
                          " bytes unpacked");
    }
    return gather(data.data(), header, lay_out(header, true, with_padding));
}

Result<ParsedObject> read_body(TextScan& scan, const PcdHeader& header) {
    switch (header.data) {
        case PcdData::kAscii: return read_ascii(scan, header);
        case PcdData::kBinary: return read_binary(scan.rest(), header);
        case PcdData::kCompressed: return read_compressed(scan.rest(), header);
    }
    return unreadable("PCD of unknown data kind");
}

}  // namespace

Result<ParsedObject> parse_pcd(std::string_view bytes) {
    TextScan scan(bytes);
    const Result<PcdHeader> header = parse_pcd_header(scan);
    if (!header) return header.error();
    Result<ParsedObject> object = read_body(scan, header.value());
    if (object) object.value().sensor_origin = header.value().viewpoint;
    return object;
}

}  // namespace graspd::mesh_detail
