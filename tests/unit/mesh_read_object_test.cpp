#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "graspd/mesh/read_object.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

/// A folder of its own for each test, removed at its end.
class ReadObject : public testing::Test {
protected:
    ReadObject() {
        static std::atomic<int> count = 0;
        folder_ = std::filesystem::temp_directory_path() /
                  ("graspd_read_" + std::to_string(getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(folder_);
    }
    ~ReadObject() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    TriangleMesh mesh_of(const std::string& name, const std::string& bytes, double scale = 1.0) {
        auto file = read_object(write(name, bytes), scale);
        EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().detail);
        if (!file.ok()) return {};
        findings_ = file.value().findings;
        auto* mesh = std::get_if<TriangleMesh>(&file.value().object);
        EXPECT_NE(mesh, nullptr) << "expected a mesh";
        return mesh ? *mesh : TriangleMesh{};
    }
    PointCloud cloud_of(const std::string& name, const std::string& bytes, double scale = 1.0) {
        auto file = read_object(write(name, bytes), scale);
        EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().detail);
        if (!file.ok()) return {};
        findings_ = file.value().findings;
        auto* cloud = std::get_if<PointCloud>(&file.value().object);
        EXPECT_NE(cloud, nullptr) << "expected a cloud";
        return cloud ? *cloud : PointCloud{};
    }
    /// The error's text, which must name the file; empty when there was none.
    std::string refusal(const std::string& name, const std::string& bytes) {
        const auto file = read_object(write(name, bytes));
        EXPECT_FALSE(file.ok());
        if (file.ok()) return "";
        EXPECT_EQ(file.error().code, PlanErrorCode::kUnreadableFile);
        EXPECT_THAT(file.error().detail, HasSubstr(name));
        return file.error().detail;
    }

    std::filesystem::path folder_;
    std::vector<Finding> findings_;
};

template <class T>
std::string raw(T value, bool big_endian = false) {
    std::array<char, sizeof(T)> bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (big_endian) std::ranges::reverse(bytes);  // these tests run on little-endian machines
    return {bytes.data(), bytes.size()};
}

/// Binary STL: 80 bytes of title, the count, 50 bytes a facet.
std::string binary_stl(const TriangleMesh& mesh, const std::string& title = "made by a test") {
    std::string bytes = title;
    bytes.resize(80, ' ');
    bytes += raw(static_cast<std::uint32_t>(mesh.faces.size()));
    for (const Triangle& face : mesh.faces) {
        bytes += std::string(12, '\0');
        for (const std::uint32_t v : face) {
            for (const double x : mesh.vertices[v]) bytes += raw(static_cast<float>(x));
        }
        bytes += std::string(2, '\0');
    }
    return bytes;
}

const std::string kTriangleOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

// --- STL ---

// Vertex 3f + k is corner k of facet f: nothing is merged, though corners coincide.
TEST_F(ReadObject, BinaryStlKeepsEveryCorner) {
    const TriangleMesh mesh = test::box({0.5, 0.25, 1.0}, 12);  // exact as floats
    for (const char* title : {"made by a test", "solid of a careless writer"}) {
        const TriangleMesh read = mesh_of("box.STL", binary_stl(mesh, title));
        ASSERT_EQ(read.faces.size(), 12u);
        ASSERT_EQ(read.vertices.size(), 36u);
        for (std::uint32_t f = 0; f < 12; ++f) {
            EXPECT_EQ(read.faces[f], (Triangle{3 * f, 3 * f + 1, 3 * f + 2}));
            for (std::uint32_t k = 0; k < 3; ++k) {
                EXPECT_EQ(read.vertices[3 * f + k], mesh.vertices[mesh.faces[f][k]]);
            }
        }
    }
}

TEST_F(ReadObject, AsciiStl) {
    const TriangleMesh mesh = mesh_of("t.stl",
                                      "solid a facet named vertex\n"
                                      " facet normal 0 0 1\n  outer loop\n"
                                      "   vertex 0 0 0\n   vertex 1.5e-1 0 0\n   vertex 0 +1 0\n"
                                      "  endloop\n endfacet\n"
                                      " FACET NORMAL 0 0 -1 OUTER LOOP VERTEX 0 0 0 VERTEX 0 1 0 "
                                      "VERTEX 1 0 0 ENDLOOP ENDFACET\r\n"
                                      "endsolid a facet named vertex\n");
    ASSERT_EQ(mesh.vertices.size(), 6u);
    EXPECT_EQ(mesh.vertices[1], Eigen::Vector3d(0.15, 0, 0));
    EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(mesh.faces.size(), 2u);
}

TEST_F(ReadObject, BrokenStl) {
    const std::string whole = binary_stl(test::box({1, 1, 1}, 12));
    EXPECT_THAT(refusal("cut.stl", whole.substr(0, whole.size() - 1)),
                HasSubstr("promises 12 facets in 684 bytes, file has 683"));
    std::string huge = whole;
    huge.replace(80, 4, "\xff\xff\xff\xff");
    EXPECT_THAT(refusal("huge.stl", huge), HasSubstr("4294967295 facets"));
    EXPECT_THAT(refusal("empty.stl", ""), HasSubstr("0 bytes"));
    EXPECT_THAT(refusal("none.stl", "solid x\nendsolid x\n"), HasSubstr("without a facet"));
    EXPECT_THAT(refusal("two.stl",
                        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "endloop\nendfacet\nendsolid"),
                HasSubstr("2 corners"));
    EXPECT_THAT(refusal("end.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
                HasSubstr("ends within facet 0"));
    EXPECT_THAT(refusal("word.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n"),
                HasSubstr("line 4: 'zero'"));
}

// --- OBJ ---

// Corners may carry texture and normal indices, count backwards from the last vertex so far, and
// stand between tabs; other statements do not matter.
TEST_F(ReadObject, ObjCorners) {
    const TriangleMesh mesh = mesh_of("t.obj",
                                      "# comment\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\n"
                                      "vt 0 0\nvn 0 0 1\nv\t0 1 0 0.5 0.5 0.5\nusemtl red\ns 1\n"
                                      "f 1/1/1 2//1 3/1\nf\t-3\t-1\t-2\nl 1 2\nv 9 9 9\n"
                                      "f 1 \\\n 2 4\n");
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.faces, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}, {0, 1, 3}}));
    EXPECT_TRUE(findings_.empty());
}

TEST_F(ReadObject, ObjWithoutFacesIsACloud) {
    EXPECT_EQ(cloud_of("t.obj", "v 0 0 0\nv 1 2 3\n").points.size(), 2u);
}

// Index 0 and indices beyond the vertices drop the face, with a finding that counts them.
TEST_F(ReadObject, FacesWithWrongCornersAreDroppedAndReported) {
    const TriangleMesh mesh =
        mesh_of("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\nf 1 2 3\nf 1 2 4\nf 1 2\nf -4 1 2\n");
    EXPECT_EQ(mesh.faces.size(), 1u);
    ASSERT_EQ(findings_.size(), 1u);
    EXPECT_EQ(findings_[0].code, "faces_dropped");
    EXPECT_EQ(findings_[0].value, 4.0);
    EXPECT_THAT(refusal("all.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
                HasSubstr("none of its 1 faces"));
}

TEST_F(ReadObject, BrokenObj) {
    EXPECT_THAT(refusal("a.obj", "f 1 2 3\n"), HasSubstr("without a vertex"));
    EXPECT_THAT(refusal("b.obj", "v 0 0 0\nv 1 x 0\n"), HasSubstr("line 2: vertex 1 has 'x'"));
    EXPECT_THAT(refusal("c.obj", "v 0 0\n"), HasSubstr("line 1"));
    EXPECT_THAT(refusal("d.obj", "v 0 0 0\nf 1 2 a\n"), HasSubstr("'a'"));
}

// --- polygons ---

// Unit square: two triangles. Its area, half of each triangle's doubled area, is 1.
TEST_F(ReadObject, PolygonsAreTriangulatedWithAFinding) {
    const TriangleMesh mesh =
        mesh_of("t.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
    EXPECT_EQ(mesh.faces.size(), 2u);
    ASSERT_EQ(findings_.size(), 1u);
    EXPECT_EQ(findings_[0].code, "polygons_triangulated");
    EXPECT_EQ(findings_[0].value, 1.0);
}

// A concave polygon (an arrowhead whose first corner sees nothing but its neighbours, then a comb)
// is cut into triangles of one sense whose areas add up to the polygon's: the arrowhead
// (0,0) (4,4) (0,2) (-4,4) has the shoelace area 8.
TEST_F(ReadObject, ConcavePolygonsAreCutByEars) {
    const TriangleMesh mesh =
        mesh_of("t.off", "OFF\n4 1 0\n4 4 7\n0 2 7\n-4 4 7\n0 0 7\n4 0 1 2 3\n");
    ASSERT_EQ(mesh.faces.size(), 2u);
    double area = 0.0;
    for (const Triangle& f : mesh.faces) {
        const Eigen::Vector3d normal = (mesh.vertices[f[1]] - mesh.vertices[f[0]])
                                           .cross(mesh.vertices[f[2]] - mesh.vertices[f[0]]);
        EXPECT_GT(normal.z(), 0.0);  // the corners run counter-clockwise seen from +z
        area += 0.5 * normal.norm();
    }
    EXPECT_NEAR(area, 8.0, 1e-12);
}

// --- OFF ---

TEST_F(ReadObject, OffDialects) {
    EXPECT_EQ(mesh_of("a.off", kTriangleOff).faces.size(), 1u);
    EXPECT_EQ(mesh_of("b.off", "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2").faces.size(), 1u);
    EXPECT_EQ(mesh_of("c.off", "# c\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").faces.size(), 1u);
    const TriangleMesh coloured = mesh_of(
        "d.off",
        "COFF\n# counts\n\n3 1 0\n\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0\n# c\n0 1 0 1 1 1 1\n3 0 1 2 "
        "9 9 9\n");
    EXPECT_EQ(coloured.vertices[2], Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(cloud_of("e.off", "OFF\n2 0 0\n1 2 3\n4 5 6\n").points[1], Eigen::Vector3d(4, 5, 6));
}

TEST_F(ReadObject, BrokenOff) {
    EXPECT_THAT(refusal("a.off", "OFF\n1000000000000 1 0\n0 0 0\n"), HasSubstr("promises"));
    EXPECT_THAT(refusal("b.off", "OFF\n3 900 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                HasSubstr("900 faces"));
    EXPECT_THAT(refusal("c.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\n\n"),
                HasSubstr("ends after 1"));
    EXPECT_THAT(refusal("d.off", "OFF\n-3 1 0\n0 0 0\n"), HasSubstr("'-3'"));
    EXPECT_THAT(refusal("e.off", "OFF BINARY\n"), HasSubstr("not supported"));
    EXPECT_THAT(refusal("f.off", "4OFF\n1 0 0\n0 0 0 1\n"), HasSubstr("'4OFF'"));
    EXPECT_THAT(refusal("g.off", "OFF\n0 0 0\n"), HasSubstr("without a vertex"));
    EXPECT_THAT(refusal("h.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"),
                HasSubstr("corner 3"));
}

// --- PLY ---

std::string ply(const std::string& format, const std::string& header, const std::string& body) {
    return "ply\nformat " + format + " 1.0\ncomment made by a test\n" + header + "end_header\n" +
           body;
}

const std::string kVertexHeader =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

TEST_F(ReadObject, AsciiPlyWithOtherProperties) {
    const TriangleMesh mesh =
        mesh_of("t.ply", ply("ascii",
                             "element vertex 3\nproperty uchar red\nproperty float32 z\n"
                             "property double x\nproperty list uchar int tags\nproperty float y\n"
                             "element face 1\nproperty list uint8 int32 vertex_index\n",
                             "9 3 1 2 7 8 2\n9 6 4 0 5\n9 1 1 1 5 1\n3 0 1 2\n"));
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[0], Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(mesh.vertices[1], Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(mesh.faces, (std::vector<Triangle>{{0, 1, 2}}));
}

// Doubles that no float holds, in both byte orders; faces that carry a list of texture coordinates
// and a colour behind their corners, as scanners write them; an element in between that nobody
// needs; corner indices of other types.
TEST_F(ReadObject, BinaryPlyOfDoublesInBothByteOrders) {
    for (const bool big : {false, true}) {
        std::string body;
        for (const double x : {0.1, 0.2, 0.3, 1.1, 0.2, 0.3, 0.1, 1.2, 1e-17}) body += raw(x, big);
        body += raw<std::uint16_t>(513, big);
        body += raw<std::uint8_t>(3);
        for (const auto i : std::array<std::uint16_t, 3>{2, 0, 1}) body += raw(i, big);
        body += raw<std::uint8_t>(6) + std::string(24, '\x7f') + std::string(4, '\xff');
        const TriangleMesh mesh = mesh_of(
            "t.ply", ply(big ? "binary_big_endian" : "binary_little_endian",
                         "element vertex 3\nproperty double x\nproperty double y\n"
                         "property double z\nelement camera 1\nproperty ushort id\n"
                         "element face 1\nproperty list uchar ushort vertex_indices\n"
                         "property list uchar float texcoord\nproperty uchar red\n"
                         "property uchar green\nproperty uchar blue\nproperty uchar alpha\n",
                         body));
        ASSERT_EQ(mesh.vertices.size(), 3u);
        EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(0.1, 1.2, 1e-17));
        EXPECT_EQ(mesh.faces, (std::vector<Triangle>{{2, 0, 1}}));
    }
}

TEST_F(ReadObject, PlyWithoutFacesIsACloud) {
    const PointCloud cloud =
        cloud_of("t.ply", ply("ascii", kVertexHeader, "0 0 0\n1 nan 0\n1 2 3"));
    ASSERT_EQ(cloud.points.size(), 3u);
    EXPECT_TRUE(std::isnan(cloud.points[1].y()));
    EXPECT_FALSE(cloud.sensor_origin.has_value());
    ASSERT_EQ(findings_.size(), 1u);
    EXPECT_EQ(findings_[0].code, "points_not_finite");
    EXPECT_EQ(findings_[0].value, 1.0);
    EXPECT_EQ(cloud_of("u.ply", ply("ascii",
                                    kVertexHeader + "element face 0\n"
                                                    "property list uchar int vertex_indices\n",
                                    "0 0 0\n1 0 0\n1 2 3\n"))
                  .points.size(),
              3u);
}

TEST_F(ReadObject, BrokenPly) {
    EXPECT_THAT(refusal("a.ply", "plx\n"), HasSubstr("does not begin with 'ply'"));
    EXPECT_THAT(refusal("b.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
                HasSubstr("no 'end_header'"));
    EXPECT_THAT(refusal("c.ply", ply("ebcdic", kVertexHeader, "")), HasSubstr("'ebcdic'"));
    EXPECT_THAT(refusal("d.ply", ply("ascii", "element vertex 3\nproperty float x\n", "1\n2\n3\n")),
                HasSubstr("no property 'y'"));
    EXPECT_THAT(refusal("e.ply", ply("ascii", kVertexHeader, "0.0 0 0\n1.0 0 0\n1 2\n")),
                HasSubstr("record 2 of 'vertex', property 'z'"));
    EXPECT_THAT(refusal("f.ply", ply("binary_little_endian", kVertexHeader, std::string(35, 'x'))),
                HasSubstr("promises 3 'vertex' records of at least 12 bytes"));
    EXPECT_THAT(refusal("g.ply", ply("ascii", "element vertex 9000000000000000000\n", "")),
                HasSubstr("has no property"));
    EXPECT_THAT(refusal("h.ply", ply("ascii",
                                     "element vertex 9000000000000000000\nproperty float x\n"
                                     "property float y\nproperty float z\n",
                                     "0 0 0\n")),
                HasSubstr("promises 9000000000000000000"));
    EXPECT_THAT(refusal("i.ply", ply("ascii", "element vertex 1\nproperty quad x\n", "")),
                HasSubstr("'quad'"));
    EXPECT_THAT(refusal("j.ply", ply("ascii", kVertexHeader + "element face 1\nproperty int n\n",
                                     "0 0 0\n0 0 0\n0 0 0\n1\n")),
                HasSubstr("vertex_indices"));
    EXPECT_THAT(refusal("k.ply", ply("ascii",
                                     kVertexHeader + "element tristrips 1\n"
                                                     "property list int int vertex_indices\n",
                                     "0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n")),
                HasSubstr("triangle strips"));
}

// A list count of four billion in a file of a hundred bytes must not cost memory; nor a negative.
TEST_F(ReadObject, PlyListCountsAreHeldAgainstTheFile) {
    const std::string header =
        kVertexHeader + "element face 1\nproperty list uint int vertex_indices\n";
    EXPECT_THAT(refusal("a.ply", ply("binary_little_endian", header,
                                     std::string(36, '\0') + raw<std::uint32_t>(0xffffffffu))),
                HasSubstr("4.29497e+09 numbers"));
    EXPECT_THAT(refusal("b.ply", ply("ascii", header, "0 0 0\n0 0 0\n0 0 0\n-1 0 1 2\n")),
                HasSubstr("-1 numbers"));
}

// --- PCD ---

std::string pcd(const std::string& fields, const std::string& sizes, const std::string& types,
                const std::string& counts, const std::string& grid, const std::string& data) {
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " +
           sizes + "\nTYPE " + types + "\nCOUNT " + counts + "\n" + grid + "\nDATA " + data;
}

// Fields in any order, several numbers in one field, an organised grid with NaN: rows stay rows.
TEST_F(ReadObject, AsciiPcd) {
    const PointCloud cloud =
        cloud_of("t.pcd",
                 pcd("rgb z hist x y", "4 4 4 8 4", "I F F F F", "1 1 2 1 1",
                     "WIDTH 2\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 4",
                     "ascii\n0 3 9 9 1 2\n0 nan 9 9 nan nan\n0 6 9 9 4 5\n0 0 0 0 0 0\n"),
                 0.5);
    ASSERT_EQ(cloud.points.size(), 4u);
    EXPECT_EQ(cloud.points[0], Eigen::Vector3d(0.5, 1, 1.5));
    EXPECT_TRUE(cloud.points[1].array().isNaN().all());
    EXPECT_EQ(cloud.points[2], Eigen::Vector3d(2, 2.5, 3));
    ASSERT_TRUE(cloud.sensor_origin.has_value());
    EXPECT_EQ(*cloud.sensor_origin, Eigen::Vector3d(0.5, 1, 1.5));  // scaled like the points
    ASSERT_EQ(findings_.size(), 1u);
    EXPECT_EQ(findings_[0].value, 1.0);
}

// Old files have neither COUNT nor HEIGHT nor VIEWPOINT; the origin as viewpoint means "unknown".
TEST_F(ReadObject, PcdHeaderDefaults) {
    const PointCloud old = cloud_of("t.pcd",
                                    "VERSION .5\nCOLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\n"
                                    "POINTS 1\nDATA ascii\n1 2 3");
    EXPECT_EQ(old.points.at(0), Eigen::Vector3d(1, 2, 3));
    const PointCloud origin =
        cloud_of("u.pcd", pcd("x y z", "4 4 4", "F F F", "1 1 1",
                              "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0", "ascii\n1 2 3\n"));
    EXPECT_FALSE(origin.sensor_origin.has_value());
}

// Padding of odd length, doubles, 16-bit integers: point by point in "binary".
TEST_F(ReadObject, BinaryPcd) {
    std::string body;
    for (int i = 0; i < 3; ++i) {
        body += raw<double>(0.1 + i) + std::string(7, '\xee') +
                raw(static_cast<std::int16_t>(-5 * i)) + raw<float>(0.5f) + raw<std::uint8_t>(1);
    }
    const PointCloud cloud =
        cloud_of("t.pcd", pcd("x _ y z label", "8 1 2 4 1", "F U I F U", "1 7 1 1 1",
                              "WIDTH 3\nHEIGHT 1\nPOINTS 3", "binary\n" + body));
    ASSERT_EQ(cloud.points.size(), 3u);
    EXPECT_EQ(cloud.points[2], Eigen::Vector3d(2.1, -10, 0.5));
}

/// LZF's plainest encoding: a byte n < 32, then n + 1 bytes as they are.
std::string lzf_literals(const std::string& bytes) {
    std::string packed;
    for (std::size_t i = 0; i < bytes.size(); i += 32) {
        const std::string piece = bytes.substr(i, 32);
        packed += static_cast<char>(piece.size() - 1);
        packed += piece;
    }
    return packed;
}

// Compressed data goes field by field: all labels, all x, ...; files with and without their padding
// in the compressed block both exist.
TEST_F(ReadObject, CompressedPcd) {
    for (const bool with_padding : {false, true}) {
        std::string fields;
        for (const std::uint32_t label : {7u, 8u}) fields += raw(label);
        for (const float x : {1.f, 4.f}) fields += raw(x);
        if (with_padding) fields += std::string(6, '\xee');
        for (const float y : {2.f, 5.f}) fields += raw(y);
        for (const float z : {3.f, 6.f}) fields += raw(z);
        const std::string packed = lzf_literals(fields);
        const PointCloud cloud = cloud_of(
            "t.pcd", pcd("label x _ y z", "4 4 3 4 4", "U F U F F", "1 1 1 1 1",
                         "WIDTH 2\nHEIGHT 1\nPOINTS 2",
                         "binary_compressed\n" + raw(static_cast<std::uint32_t>(packed.size())) +
                             raw(static_cast<std::uint32_t>(fields.size())) + packed));
        ASSERT_EQ(cloud.points.size(), 2u);
        EXPECT_EQ(cloud.points[0], Eigen::Vector3d(1, 2, 3));
        EXPECT_EQ(cloud.points[1], Eigen::Vector3d(4, 5, 6));
    }
}

// A back reference: control byte (length - 2) << 5 | offset >> 8, offset - 1. Zeros that refer to
// themselves unpack to two points at the origin.
TEST_F(ReadObject, CompressedPcdWithBackReference) {
    const std::string packed{'\x00', '\x00', '\xe0', '\x0e', '\x00'};  // 1 literal, then 7 + 14 + 2
    const PointCloud cloud = cloud_of(
        "t.pcd",
        pcd("x y z", "4 4 4", "F F F", "1 1 1", "WIDTH 2\nHEIGHT 1\nPOINTS 2",
            "binary_compressed\n" + raw<std::uint32_t>(5) + raw<std::uint32_t>(24) + packed));
    ASSERT_EQ(cloud.points.size(), 2u);
    EXPECT_EQ(cloud.points[1], Eigen::Vector3d::Zero());
}

TEST_F(ReadObject, BrokenPcd) {
    const auto xyz = [](const std::string& grid, const std::string& data) {
        return pcd("x y z", "4 4 4", "F F F", "1 1 1", grid, data);
    };
    const std::string one = "WIDTH 1\nHEIGHT 1\nPOINTS 1";
    EXPECT_THAT(refusal("a.pcd", xyz("WIDTH 9\nHEIGHT 1\nPOINTS 9", "ascii\n1 2 3\n4 5 6\n")),
                HasSubstr("promises 9 points"));
    EXPECT_THAT(refusal("b.pcd", xyz("WIDTH 2\nHEIGHT 1\nPOINTS 3", "ascii\n1 2 3\n")),
                HasSubstr("POINTS is 3, but WIDTH x HEIGHT is 2 x 1"));
    EXPECT_THAT(refusal("c.pcd", xyz("WIDTH 1000000000\nHEIGHT 1000000000", "binary\n")),
                HasSubstr("1000000000000000000 points"));
    EXPECT_THAT(refusal("d.pcd", xyz(one, "binary\n" + std::string(11, '\0'))),
                HasSubstr("1 points of 12 bytes"));
    EXPECT_THAT(refusal("e.pcd", xyz(one, "binary_compressed\n123")), HasSubstr("no sizes"));
    EXPECT_THAT(refusal("f.pcd", xyz(one, "binary_compressed\n" + raw<std::uint32_t>(99) +
                                              raw<std::uint32_t>(12) + "abc")),
                HasSubstr("out of 99, but 3 bytes"));
    EXPECT_THAT(refusal("g.pcd", xyz(one, "binary_compressed\n" + raw<std::uint32_t>(3) +
                                              raw<std::uint32_t>(13) + "abc")),
                HasSubstr("unpacks to 13 bytes"));
    EXPECT_THAT(refusal("h.pcd", xyz("WIDTH 300000000\nHEIGHT 1",  // 3.6e9 bytes out of 3
                                     "binary_compressed\n" + raw<std::uint32_t>(3) +
                                         raw<std::uint32_t>(3600000000u) + "abc")),
                HasSubstr("3600000000 bytes out of 3"));
    EXPECT_THAT(refusal("i.pcd", xyz(one, "binary_compressed\n" + raw<std::uint32_t>(3) +
                                              raw<std::uint32_t>(12) + "\xff\xff\xff")),
                HasSubstr("broken"));
    EXPECT_THAT(refusal("j.pcd", xyz(one, "morse\n")), HasSubstr("'morse'"));
    EXPECT_THAT(refusal("k.pcd", pcd("x y", "4 4", "F F", "1 1", one, "ascii\n1 2\n")),
                HasSubstr("no field 'z'"));
    EXPECT_THAT(refusal("l.pcd", pcd("x y z", "4 4", "F F F", "1 1 1", one, "ascii\n")),
                HasSubstr("have 3, 2, 3, 3 entries"));
    EXPECT_THAT(refusal("m.pcd", pcd("x y z", "4 4 3", "F F F", "1 1 1", one, "ascii\n")),
                HasSubstr("field 'z' has SIZE '3'"));
    EXPECT_THAT(refusal("n.pcd", xyz(one, "ascii\n1 2 three\n")), HasSubstr("'three'"));
    EXPECT_THAT(refusal("o.pcd", "FIELDS x y z\n"), HasSubstr("no 'DATA' line"));
    EXPECT_THAT(refusal("p.pcd", xyz("POINTS 0", "ascii\n")), HasSubstr("0 points"));
}

// --- any file ---

TEST_F(ReadObject, ScaleIsAFactorOnEveryCoordinate) {
    const TriangleMesh mesh = mesh_of("t.off", kTriangleOff, 0.001);
    EXPECT_EQ(mesh.vertices[1], Eigen::Vector3d(0.001, 0, 0));
}

TEST_F(ReadObject, RefusesABadScale) {
    const auto path = write("t.off", kTriangleOff);
    for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        const auto file = read_object(path, scale);
        ASSERT_FALSE(file.ok());
        EXPECT_EQ(file.error().code, PlanErrorCode::kInvalidInput);
    }
}

TEST_F(ReadObject, RefusesWhatIsNoFileOfAKnownKind) {
    EXPECT_THAT(refusal("t.step", "x"), HasSubstr("'.step', expected .stl"));
    EXPECT_THAT(refusal("t", "x"), HasSubstr("expected .stl"));
    std::filesystem::create_directory(folder_ / "folder.stl");
    EXPECT_THAT(read_object(folder_ / "folder.stl").error().detail,
                HasSubstr("not a regular file"));
    const auto missing = read_object(folder_ / "missing.stl");
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, PlanErrorCode::kUnreadableFile);
    EXPECT_THAT(missing.error().detail, HasSubstr("missing.stl: "));
}

// Whatever the file says, a comma is no decimal point and overlong numbers are still numbers.
TEST_F(ReadObject, Numbers) {
    EXPECT_THAT(refusal("a.off", "OFF\n1 0 0\n0,5 0 0\n"), HasSubstr("'0,5'"));
    const PointCloud cloud =
        cloud_of("b.off", "OFF\n1 0 0\n1e-400 -1E+2 0.1000000000000000055511\n");
    EXPECT_EQ(cloud.points[0], Eigen::Vector3d(0.0, -100.0, 0.1));
}

// Every prefix of a good file, and good files with a byte changed, give a result or an error: the
// sanitiser builds watch over memory.
TEST_F(ReadObject, DamagedFilesNeverCrash) {
    const TriangleMesh box = test::box({1, 1, 1}, 12);
    std::string body = std::string(36, '\1') + raw<std::uint8_t>(3) + std::string(12, '\0');
    const std::string packed = lzf_literals(std::string(24, '\1'));
    const std::pair<const char*, std::string> files[] = {
        {"t.stl", binary_stl(box)},
        {"t.off", kTriangleOff},
        {"t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/2 -1/3\n"},
        {"t.ply",
         ply("binary_little_endian",
             kVertexHeader + "element face 1\nproperty list uchar int vertex_indices\n", body)},
        {"t.pcd", pcd("x y z", "4 4 4", "F F F", "1 1 1", "WIDTH 2\nHEIGHT 1\nPOINTS 2",
                      "binary_compressed\n" + raw(static_cast<std::uint32_t>(packed.size())) +
                          raw<std::uint32_t>(24) + packed)},
    };
    std::size_t refused = 0;
    for (const auto& [name, bytes] : files) {
        ASSERT_TRUE(read_object(write(name, bytes)).ok());
        for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 100) {
            refused += !read_object(write(name, bytes.substr(0, length))).ok();
        }
        for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 200) {
            for (const char damage : {'\0', '9', '\xff', '\n'}) {
                std::string changed = bytes;
                changed[at] = damage;
                refused += !read_object(write(name, changed)).ok();
            }
        }
    }
    EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace graspd
