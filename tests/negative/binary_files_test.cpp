#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "negative/verdict.hpp"
#include "support/clouds.hpp"
#include "support/shapes.hpp"

// Broken binary files: cut short, with counts that lie, in the wrong byte order, with numbers that
// are none; and what is no file at all.

namespace graspd::test {
namespace {

constexpr auto kInvalid = PlanErrorCode::kInvalidInput;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class T>
std::string raw(T value, bool big_endian = false) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (big_endian) std::ranges::reverse(bytes);  // these tests run on little-endian machines
    return {bytes.data(), bytes.size()};
}

/// A box of 12 faces: 84 bytes of header, 50 a facet, 684 in all.
std::string stl(std::uint32_t promised, std::size_t facets = 12, float first = 0.05F) {
    const TriangleMesh mesh = box({0.1, 0.1, 0.1});
    std::string bytes(80, ' ');
    bytes += raw(promised);
    for (std::size_t f = 0; f < facets; ++f) {
        bytes += std::string(12, '\0');
        for (const std::uint32_t v : mesh.faces[f]) {
            for (const double x : mesh.vertices[v]) bytes += raw(static_cast<float>(x));
        }
        bytes += std::string(2, '\0');
    }
    if (first != 0.05F) bytes.replace(96, 4, raw(first));
    return bytes;
}

const BadFile kStl[] = {
    {"StlCut", "a.stl", stl(12).substr(0, 683),
     unreadable({"promises 12 facets in 684 bytes, file has 683"})},
    {"StlHugeCount", "a.stl", stl(0xffffffffu), unreadable({"4294967295 facets"})},
    {"StlNoFacets", "a.stl", stl(0, 0), unreadable({"promises 0 facets in 84 bytes"})},
    {"StlCountOneTooLarge", "a.stl", stl(13), unreadable({"promises 13 facets in 734 bytes"})},
    // The last facet counts as a writer's own bytes: a hole of three edges. 33 corners, 8 places.
    {"StlCountOneTooSmall", "a.stl", stl(11),
     repaired({{"vertices_welded", 25}, {"holes_filled", 1}})},
    {"StlNan", "a.stl", stl(12, 12, kNan), refused(kInvalid, {"mesh vertex 0 = (nan, "})},
    {"StlHalfAHeader", "a.stl", std::string(40, ' '), unreadable({"40 bytes, header needs 84"})},
};

/// What a PLY of a tetrahedron is made of, each part as a broken writer may have it.
struct Ply {
    bool big_endian = false;  ///< as the header says
    bool swapped = false;     ///< the body is in the other order
    bool doubles = false;
    double first = 0.0;        ///< of the first vertex
    std::uint8_t corners = 3;  ///< of the first face, as its list promises
    std::int32_t corner = 2;   ///< second corner of the first face
};

std::string ply(const Ply& kind) {
    const std::string type = kind.doubles ? "double" : "float";
    std::string bytes = std::string("ply\nformat binary_") + (kind.big_endian ? "big" : "little") +
                        "_endian 1.0\nelement vertex 4\n";
    for (const char* axis : {"x", "y", "z"}) bytes += "property " + type + " " + axis + "\n";
    bytes += "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    const bool big = kind.big_endian != kind.swapped;
    const double at[4][3] = {{kind.first, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    for (const auto& point : at) {
        for (const double x : point) {
            bytes += kind.doubles ? raw(x, big) : raw(static_cast<float>(x), big);
        }
    }
    const std::int32_t faces[4][3] = {{0, kind.corner, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (std::size_t f = 0; f < 4; ++f) {
        bytes += raw(f == 0 ? kind.corners : std::uint8_t{3});
        for (const std::int32_t c : faces[f]) bytes += raw(c, big);
    }
    return bytes;
}

std::string cut(std::string bytes, std::size_t count = 1) {
    bytes.resize(bytes.size() - count);
    return bytes;
}

constexpr double kDoubleNan = std::numeric_limits<double>::quiet_NaN();
const Verdict kWhole = repaired({{"components", 1}});
const Verdict kLastFace = unreadable({"record 3 of 'face'", "promises 3 numbers, more"});

const BadFile kPly[] = {
    {"PlyDoubles", "a.ply", ply({.doubles = true}), kWhole},
    {"PlyBigEndianDoubles", "a.ply", ply({.big_endian = true, .doubles = true}), kWhole},
    {"PlyBigEndianFloats", "a.ply", ply({.big_endian = true}), kWhole},
    {"PlyCut", "a.ply", cut(ply({})), kLastFace},
    {"PlyBigEndianCut", "a.ply", cut(ply({.big_endian = true})), kLastFace},
    {"PlyDoublesCut", "a.ply", cut(ply({.doubles = true})), kLastFace},
    // Without the faces' 52 bytes and two more, 46 of the vertices' 48 are left.
    {"PlyCutInTheVertices", "a.ply", cut(ply({}), 54),
     unreadable({"promises 4 'vertex' records of at least 12 bytes, but only 46"})},
    // Corner 2 in the other order is 0x02000000.
    {"PlyOtherByteOrder", "a.ply", ply({.swapped = true}),
     unreadable({"none of its 4 faces is usable; first: face 0, corner 1 is no vertex"})},
    {"PlyListTooLong", "a.ply", ply({.corners = 255}), unreadable({"promises 255 numbers"})},
    {"PlyNegativeCorner", "a.ply", ply({.corner = -1}),
     repaired({{"faces_dropped", 1}, {"holes_filled", 1}})},
    {"PlyCornerBehindTheLast", "a.ply", ply({.corner = 4}),
     repaired({{"faces_dropped", 1}, {"holes_filled", 1}})},
    {"PlyNan", "a.ply", ply({.doubles = true, .first = kDoubleNan}),
     refused(kInvalid, {"mesh vertex 0 = (nan, 0, 0) is not finite"})},
    {"PlyInfinite", "a.ply", ply({.first = std::numeric_limits<double>::infinity()}),
     refused(kInvalid, {"mesh vertex 0 = (inf, 0, 0) is not finite"})},
};

std::string pcd(const std::string& points, const std::string& data, const char* size = "4",
                const char* type = "F") {
    const std::string three = std::string(size) + " " + size + " " + size;
    const std::string types = std::string(type) + " " + type + " " + type;
    return "VERSION 0.7\nFIELDS x y z\nSIZE " + three + "\nTYPE " + types +
           "\nCOUNT 1 1 1\nWIDTH " + points + "\nHEIGHT 1\nDATA " + data;
}

/// A sphere of 200 points in doubles, of which the first has no x.
std::string pcd_sphere_with_nan() {
    std::string bytes;
    auto points = spiral_sphere(0.05, 200).points;
    points[0].x() = kDoubleNan;
    for (const auto& point : points) {
        for (const double x : point) bytes += raw(x);
    }
    return pcd("200", "binary\n" + bytes, "8");
}

std::string packed(std::uint32_t packed_bytes, std::uint32_t unpacked_bytes,
                   const std::string& bytes) {
    return "binary_compressed\n" + raw(packed_bytes) + raw(unpacked_bytes) + bytes;
}

const BadFile kPcd[] = {
    {"PcdDoublesWithNan", "a.pcd", pcd_sphere_with_nan(),
     repaired({{"points_not_finite", 1}, {"components", 1}, {"surface_deviation", 0}})},
    {"PcdCut", "a.pcd", pcd("1", "binary\n" + std::string(11, '\0')),
     unreadable({"promises 1 points of 12 bytes, but only 11 bytes"})},
    {"PcdHugeCount", "a.pcd", pcd("1000000000", "binary\n" + std::string(12, '\0')),
     unreadable({"promises 1000000000 points"})},
    {"PcdFloatOfOneByte", "a.pcd", pcd("1", "binary\n123", "1"),
     unreadable({"field 'x' has SIZE '1', TYPE 'F'"})},
    {"PcdPackedWithoutSizes", "a.pcd", pcd("1", "binary_compressed\n1234567"),
     unreadable({"has no sizes"})},
    {"PcdPackedCut", "a.pcd", pcd("1", packed(99, 12, "abc")),
     unreadable({"out of 99, but 3 bytes follow"})},
    {"PcdUnpacksToAnotherSize", "a.pcd", pcd("1", packed(3, 13, "abc")),
     unreadable({"unpacks to 13 bytes, but 1 points of 12"})},
    // 3.6e9 bytes out of three: no such file can be, and no memory is taken for it.
    {"PcdBomb", "a.pcd", pcd("300000000", packed(3, 3600000000u, "abc")),
     unreadable({"3600000000 bytes out of 3"})},
    {"PcdPackedGarbage", "a.pcd", pcd("1", packed(3, 12, "\xff\xff\xff")),
     unreadable({"compressed data is broken"})},
    {"PcdOfIntegers", "a.pcd", pcd("1", "binary\n" + std::string(12, '\1'), "4", "I"),
     refused(kInvalid, {"1 finite distinct points of 1"})},
};

class BinaryFiles : public testing::TestWithParam<BadFile> {};

TEST_P(BinaryFiles, GetTheirVerdict) {
    expect_verdict(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Stl, BinaryFiles, testing::ValuesIn(kStl), kName);
INSTANTIATE_TEST_SUITE_P(Ply, BinaryFiles, testing::ValuesIn(kPly), kName);
INSTANTIATE_TEST_SUITE_P(Pcd, BinaryFiles, testing::ValuesIn(kPcd), kName);

// --- no file of a known kind ---

TEST(NoFile, OfAnUnknownKind) {
    const ScratchFolder folder;
    for (const char* name : {"part.step", "part", "part.stl.gz", "stl", ".stl"}) {
        expect_verdict(read_and_close(folder.write(name, stl(12))),
                       unreadable({name, "expected .stl, .obj, .off, .ply or .pcd"}));
    }
}

TEST(NoFile, ButAFolder) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "a.stl");
    expect_verdict(read_and_close(folder.path() / "a.stl"),
                   unreadable({"a.stl", "not a regular file"}));
}

TEST(NoFile, OfThatName) {
    const ScratchFolder folder;
    for (const char* name : {"gone.ply", "\xff\xfe\x80.stl", "a\nb.obj"}) {
        expect_verdict(read_and_close(folder.path() / name), unreadable({name}));
    }
}

// A name that is no UTF-8 is a name.
TEST(NoFile, NeedsANameInUtf8) {
    const ScratchFolder folder;
    expect_verdict(read_and_close(folder.write("\xff\xfe\x80.stl", stl(12))),
                   repaired({{"vertices_welded", 28}}));
}

TEST(NoFile, ThatALinkLeadsNowhere) {
    const ScratchFolder folder;
    std::filesystem::create_symlink(folder.path() / "b.stl", folder.path() / "a.stl");
    expect_verdict(read_and_close(folder.path() / "a.stl"), unreadable({"a.stl"}));
}

}  // namespace
}  // namespace graspd::test
