#include <gtest/gtest.h>

#include "negative/verdict.hpp"

// Broken text files. A refusal names the place and what stands there.

namespace graspd::test {
namespace {

constexpr auto kInvalid = PlanErrorCode::kInvalidInput;

const std::string kFacet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";

/// A tetrahedron whose first corner is the text given.
std::string stl_tetrahedron(const std::string& first) {
    const std::string corner[4] = {first, "0.1 0 0", "0 0.1 0", "0 0 0.1"};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    std::string text = "solid t\n";
    for (const auto& face : faces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int c : face) text += "vertex " + corner[c] + "\n";
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid t\n";
}

const std::string kObjTetrahedron = "v 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

const BadFile kStl[] = {
    {"StlEmpty", "a.stl", "", unreadable({"a.stl", "0 bytes, header needs 84"})},
    {"StlNoFacet", "a.stl", "solid x\nendsolid x\n", unreadable({"without a facet"})},
    {"StlCutInACorner", "a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0",
     unreadable({"line 4", "'' stands where a coordinate should"})},
    {"StlCutInAFacet", "a.stl", kFacet, unreadable({"ends within facet 0"})},
    {"StlTwoCorners", "a.stl", kFacet + "endloop\nendfacet\n",
     unreadable({"facet 0 has 2 corners, expected 3"})},
    {"StlFourCorners", "a.stl",
     kFacet + "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
     unreadable({"facet 0 has 4 corners, expected 3"})},
    {"StlWordForANumber", "a.stl", kFacet + "vertex 0 zero 0\n", unreadable({"line 6: 'zero'"})},
    {"StlDecimalComma", "a.stl", kFacet + "vertex 0,5 0 0\n", unreadable({"'0,5'"})},
    {"StlHexadecimal", "a.stl", kFacet + "vertex 0x1p3 0 0\n", unreadable({"'0x1p3'"})},
    {"StlStrayWord", "a.stl", "solid x\nhello\n", unreadable({"'hello' stands where 'facet'"})},
    {"StlWebPage", "a.stl", "<html>404 not found</html>", unreadable({"neither ascii STL"})},
    {"StlUtf16", "a.stl", std::string("\xff\xfes\0o\0l\0i\0d\0", 12),
     unreadable({"neither ascii STL"})},
    {"StlNan", "a.stl", stl_tetrahedron("nan 0 0"),
     refused(kInvalid, {"mesh vertex 0 = (nan, 0, 0) is not finite"})},
    {"StlInfinite", "a.stl", stl_tetrahedron("0 -inf 0"),
     refused(kInvalid, {"mesh vertex 0 = (0, -inf, 0) is not finite"})},
    {"StlTooLargeForADouble", "a.stl", stl_tetrahedron("0 0 1e999"),
     refused(kInvalid, {"mesh vertex 0 = (0, 0, inf)"})},
    {"StlTooSmallForADouble", "a.stl", stl_tetrahedron("0 0 1e-999"),
     repaired({{"vertices_welded", 8}})},  // 12 corners, 4 places
    {"StlSquaresOverflow", "a.stl", stl_tetrahedron("1e300 0 0"),
     refused(kInvalid, {"bounding box is too large to measure"})},
    {"StlAllOnALine", "a.stl",
     "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 3 0 0\n"
     "endloop\nendfacet\nendsolid\n",
     refused(PlanErrorCode::kDegenerate, {"no face of the mesh has an area"})},
    {"StlAllAtOnePlace", "a.stl",
     "solid\nfacet normal 0 0 0\nouter loop\nvertex 1 2 3\nvertex 1 2 3\nvertex 1 2 3\n"
     "endloop\nendfacet\nendsolid\n",
     refused(PlanErrorCode::kDegenerate, {"all 1 faces of the mesh are degenerate"})},
};

const BadFile kObj[] = {
    {"ObjEmpty", "a.obj", "", unreadable({"OBJ without a vertex"})},
    {"ObjComments", "a.obj", "# nothing\n\n# here\n", unreadable({"OBJ without a vertex"})},
    {"ObjBytes", "a.obj",
     std::string("\x7f"
                 "ELF\x02\x01\0\0\n\0\xff\xfe",
                 12),
     unreadable({"OBJ without a vertex"})},
    {"ObjWordForANumber", "a.obj", "v 0 0 0\nv 0 x 0\n", unreadable({"line 2: vertex 1 has 'x'"})},
    {"ObjTwoNumbers", "a.obj", "v 0 0\n", unreadable({"line 1: vertex 0 has ''"})},
    {"ObjWordForACorner", "a.obj", kObjTetrahedron + "f 1 2 a\n",
     unreadable({"line 7: face 3 has 'a' for a corner"})},
    {"ObjCornerTooLarge", "a.obj", kObjTetrahedron + "f 1 2 99999999999999999999\n",
     unreadable({"'99999999999999999999' for a corner"})},
    {"ObjNoSuchCorners", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 5 6\n",
     unreadable({"none of its 1 faces is usable", "face 0, corner 0 is no vertex"})},
    {"ObjCornerZero", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 0 2\n",
     unreadable({"face 0, corner 1 is no vertex"})},
    {"ObjTooFarBack", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n",
     unreadable({"face 0, corner 2 is no vertex"})},
    {"ObjTwoCorners", "a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", unreadable({"face 0, 2 corners"})},
    // Four places, three faces with one that names no vertex: two faces of a tetrahedron are left.
    {"ObjOneBadFace", "a.obj",
     "v 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nv 0 0 0\nf 1 3 2\nf 1 2 4\nf 1 4 9\n",
     repaired({{"faces_dropped", 1}, {"holes_filled", 1}})},
    {"ObjNan", "a.obj", "v 0 nan 0\n" + kObjTetrahedron,
     refused(kInvalid, {"mesh vertex 0 = (0, nan, 0) is not finite"})},
    {"ObjFewPoints", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
     refused(kInvalid, {"4 finite distinct points of 4, at least 10"})},
};

const BadFile kOff[] = {
    {"OffEmpty", "a.off", "", unreadable({"OFF file is empty"})},
    {"OffKeywordAlone", "a.off", "OFF\n", unreadable({"ends after its keyword"})},
    {"OffNegativeCount", "a.off", "OFF\n-3 1 0\n0 0 0\n",
     unreadable({"'-3' stands where a count should"})},
    {"OffWordForACount", "a.off", "OFF\nthree 1 0\n", unreadable({"'three' stands where a count"})},
    {"OffHugeCount", "a.off", "OFF\n4000000000000 1 0\n0 0 0\n",
     unreadable({"promises 4000000000000 vertices", "only 6 bytes"})},
    {"OffHugeFaceCount", "a.off", "OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n",
     unreadable({"4000000000 faces"})},
    {"OffCountTooLargeForAnInteger", "a.off", "OFF\n99999999999999999999 1 0\n",
     unreadable({"'99999999999999999999' stands where a count should"})},
    {"OffTooFewVertices", "a.off", "OFF\n4 0 0\n0.000 0 0\n1.000 0 0\n",
     unreadable({"promises 4 vertices"})},
    {"OffTooFewFaces", "a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
     unreadable({"promises 2 faces, ends after 1"})},
    {"OffBinary", "a.off", "OFF BINARY\n", unreadable({"not supported, write it as text"})},
    {"OffFourDimensions", "a.off", "4OFF\n1 0 0\n0 0 0 1\n", unreadable({"'4OFF'"})},
    {"OffNoVertex", "a.off", "OFF\n0 0 0\n", unreadable({"without a vertex"})},
    {"OffWordForANumber", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 up 0\n3 0 1 2\n",
     unreadable({"line 5: vertex 2 has 'up'"})},
    {"OffFractionForACorner", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
     unreadable({"corner 2 of face 0 is '1.5'"})},
    {"OffNegativeCorners", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
     unreadable({"face 0 has '-3' corners"})},
    {"OffNoSuchCorner", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
     unreadable({"face 0, corner 2 is no vertex"})},
    {"OffNegativeCorner", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 -1 1 2\n",
     unreadable({"face 0, corner 0 is no vertex"})},
};

std::string ply(const std::string& header, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}
const std::string kXyz = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kList = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kThree = "0 0 0\n1 0 0\n0 1 0\n";

const BadFile kPly[] = {
    {"PlyEmpty", "a.ply", "", unreadable({"does not begin with 'ply'"})},
    {"PlyHeaderCut", "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n",
     unreadable({"no 'end_header'"})},
    {"PlyNoFormat", "a.ply", "ply\n" + kXyz + "end_header\n" + kThree,
     unreadable({"without a 'format' line"})},
    {"PlyUnknownFormat", "a.ply", "ply\nformat ebcdic 1.0\n", unreadable({"'ebcdic'"})},
    {"PlyNegativeCount", "a.ply", ply("element vertex -1\nproperty float x\n", ""),
     unreadable({"line 3: element 'vertex' has count '-1'"})},
    {"PlyHugeCount", "a.ply",
     ply("element vertex 9000000000000000000\nproperty float x\nproperty float y\n"
         "property float z\n",
         kThree),
     unreadable({"promises 9000000000000000000 'vertex' records"})},
    {"PlyUnknownType", "a.ply", ply("element vertex 1\nproperty quad x\n", ""),
     unreadable({"line 4: unknown type 'quad'"})},
    {"PlyFractionalListCount", "a.ply",
     ply(kXyz + "element face 1\nproperty list float int vertex_indices\n", kThree),
     unreadable({"list counts of type 'float'"})},
    {"PlyNoY", "a.ply", ply("element vertex 1\nproperty float x\nproperty float z\n", "1 2\n"),
     unreadable({"no property 'y'"})},
    {"PlyPropertyOfNothing", "a.ply", ply("property float x\n", ""),
     unreadable({"a property before any element"})},
    {"PlyUnknownWord", "a.ply", "ply\nformat ascii 1.0\nhello\n",
     unreadable({"line 3: unknown header word 'hello'"})},
    {"PlyCutInAVertex", "a.ply", ply(kXyz, "0.0 0 0\n1.0 0 0\n1 2\n"),
     unreadable({"record 2 of 'vertex', property 'z'"})},
    {"PlyWordForANumber", "a.ply", ply(kXyz, "0 0 0\n1 none 0\n0 1 0\n"),
     unreadable({"record 1 of 'vertex', property 'y'"})},
    {"PlyNegativeList", "a.ply", ply(kXyz + kList, kThree + "-1 0 1 2\n"),
     unreadable({"'vertex_indices' promises -1 numbers"})},
    {"PlyListTooLong", "a.ply", ply(kXyz + kList, kThree + "4000000000 0 1 2\n"),
     unreadable({"promises 4e+09 numbers"})},
    {"PlyListCut", "a.ply", ply(kXyz + kList, kThree + "3 0 1\n"),
     unreadable({"record 0 of 'face'"})},
    {"PlyStrips", "a.ply",
     ply(kXyz + "element tristrips 1\nproperty list int int vertex_indices\n", kThree + "3 0 1 2"),
     unreadable({"triangle strips"})},
    {"PlyFacesWithoutCorners", "a.ply",
     ply(kXyz + "element face 1\nproperty int n\n", kThree + "1"),
     unreadable({"no list 'vertex_indices'"})},
    {"PlyNoVertex", "a.ply",
     ply("element vertex 0\nproperty float x\nproperty float y\nproperty float z\n", ""),
     unreadable({"PLY without a vertex"})},
    {"PlyFractionForACorner", "a.ply", ply(kXyz + kList, kThree + "3 0 1 1.5\n"),
     unreadable({"face 0, corner 2 is no vertex"})},
    {"PlyFlatCloud", "a.ply",
     ply("element vertex 10\nproperty float x\nproperty float y\nproperty float z\n",
         "0 0 0\n1 0 0\n2 0 0\n3 0 0\n0 1 0\n1 1 0\n2 1 0\n3 1 0\n0 2 0\n1 2 0\n"),
     refused(PlanErrorCode::kDegenerate, {"cloud of 10 points is flat"})},
};

std::string pcd(const std::string& header, const std::string& data) {
    return "VERSION 0.7\n" + header + "DATA " + data;
}
const std::string kFields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
const std::string kTwo = kFields + "WIDTH 2\nHEIGHT 1\nPOINTS 2\n";

const BadFile kPcd[] = {
    {"PcdEmpty", "a.pcd", "", unreadable({"no 'DATA' line"})},
    {"PcdHeaderCut", "a.pcd", "VERSION 0.7\n" + kTwo, unreadable({"no 'DATA' line"})},
    {"PcdNoFields", "a.pcd", pcd("WIDTH 2\nHEIGHT 1\n", "ascii\n"),
     unreadable({"have 0, 0, 0, 0 entries"})},
    {"PcdTooFewSizes", "a.pcd", pcd("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nWIDTH 1\n", "ascii\n"),
     unreadable({"have 3, 2, 3, 0 entries"})},
    {"PcdNoZ", "a.pcd", pcd("FIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 1\n", "ascii\n1 2\n"),
     unreadable({"no field 'z'"})},
    {"PcdZOfTwoNumbers", "a.pcd",
     pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 2\nWIDTH 1\n", "ascii\n1 2 3 4\n"),
     unreadable({"no field 'z' of one number"})},
    {"PcdUnknownType", "a.pcd",
     pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE X F F\nWIDTH 1\n", "ascii\n1 2 3\n"),
     unreadable({"field 'x' has SIZE '4', TYPE 'X'"})},
    {"PcdWrongSize", "a.pcd",
     pcd("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nWIDTH 1\n", "ascii\n1 2 3\n"),
     unreadable({"field 'z' has SIZE '3'"})},
    {"PcdNoSuchCount", "a.pcd",
     pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 0 1\nWIDTH 1\n", "ascii\n1 2 3\n"),
     unreadable({"field 'y'", "COUNT '0'"})},
    {"PcdNegativeWidth", "a.pcd", pcd(kFields + "WIDTH -1\n", "ascii\n1 2 3\n"),
     unreadable({"WIDTH is '-1', expected 0 to"})},
    {"PcdHugeWidth", "a.pcd", pcd(kFields + "WIDTH 99999999999\n", "ascii\n1 2 3\n"),
     unreadable({"WIDTH is '99999999999'"})},
    {"PcdNoPoints", "a.pcd", pcd(kFields + "POINTS 0\n", "ascii\n"), unreadable({"0 points"})},
    {"PcdNoCounts", "a.pcd", pcd(kFields, "ascii\n1 2 3\n"),
     unreadable({"neither POINTS nor WIDTH"})},
    {"PcdCountsDiffer", "a.pcd",
     pcd(kFields + "WIDTH 2\nHEIGHT 1\nPOINTS 3\n", "ascii\n1 2 3\n4 5 6\n7 8 9\n"),
     unreadable({"POINTS is 3, but WIDTH x HEIGHT is 2 x 1"})},
    {"PcdTooFewRows", "a.pcd", pcd(kFields + "POINTS 9\n", "ascii\n1 2 3\n4 5 6\n"),
     unreadable({"promises 9 points of 3 columns, but only 12 bytes"})},
    {"PcdLastRowCut", "a.pcd", pcd(kTwo, "ascii\n1.00 2 3\n4 5\n"),
     unreadable({"promises 2 points, ends after 1"})},
    {"PcdWordForANumber", "a.pcd", pcd(kTwo, "ascii\n1 2 3\n4 five 6\n"),
     unreadable({"'five' stands where a coordinate should"})},
    {"PcdUnknownWord", "a.pcd", pcd("COLOUR red\n", "ascii\n"),
     unreadable({"line 2: unknown header word 'COLOUR'"})},
    {"PcdUnknownData", "a.pcd", pcd(kTwo, "morse\n"), unreadable({"'morse'"})},
    {"PcdAllNan", "a.pcd", pcd(kTwo, "ascii\nnan nan nan\nnan nan nan\n"),
     refused(kInvalid, {"0 finite distinct points of 2, at least 10"})},
    {"PcdFewPoints", "a.pcd", pcd(kTwo, "ascii\n0 0 0\n1 1 1\n"),
     refused(kInvalid, {"2 finite distinct points of 2, at least 10"})},
};

class TextFiles : public testing::TestWithParam<BadFile> {};

TEST_P(TextFiles, GetTheirVerdict) {
    expect_verdict(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Stl, TextFiles, testing::ValuesIn(kStl), kName);
INSTANTIATE_TEST_SUITE_P(Obj, TextFiles, testing::ValuesIn(kObj), kName);
INSTANTIATE_TEST_SUITE_P(Off, TextFiles, testing::ValuesIn(kOff), kName);
INSTANTIATE_TEST_SUITE_P(Ply, TextFiles, testing::ValuesIn(kPly), kName);
INSTANTIATE_TEST_SUITE_P(Pcd, TextFiles, testing::ValuesIn(kPcd), kName);

}  // namespace
}  // namespace graspd::test
