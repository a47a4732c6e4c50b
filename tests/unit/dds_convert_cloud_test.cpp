#include "convert_cloud.hpp"

#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>

#include "convert_request.hpp"
#include "support/plan_samples.hpp"

namespace graspd::dds {
namespace {

using sensor_msgs::msg::dds_::PointCloud2_;
using sensor_msgs::msg::dds_::PointField_;
using testing::ElementsAre;
using testing::HasSubstr;

PointField_ field(const char* name, std::uint32_t offset, std::uint8_t datatype) {
    PointField_ out;
    out.name(name);
    out.offset(offset);
    out.datatype(datatype);
    out.count(1);
    return out;
}

/// As a depth camera sends it: 2 rows of 2 points of 20 bytes (z double at 0, x float at 8, y float
/// at 12, 4 bytes of colour) and 3 bytes of padding a row; the point of row r, column c is
/// (c + 1, r + 0.5, -2 r - c).
PointCloud2_ camera_cloud(bool big_endian) {
    PointCloud2_ cloud;
    cloud.height(2);
    cloud.width(2);
    cloud.point_step(20);
    cloud.row_step(43);
    cloud.is_bigendian(big_endian);
    cloud.fields({field("rgb", 16, 6), field("y", 12, 7), field("z", 0, 8), field("x", 8, 7)});
    cloud.data().assign(86, 0xaa);
    const auto put = [&](std::size_t at, std::uint64_t bits, std::size_t bytes) {
        for (std::size_t i = 0; i < bytes; ++i) {
            const std::size_t shift = big_endian ? bytes - 1 - i : i;
            cloud.data()[at + i] = static_cast<std::uint8_t>(bits >> (8 * shift));
        }
    };
    for (std::size_t row = 0; row < 2; ++row) {
        for (std::size_t column = 0; column < 2; ++column) {
            const std::size_t at = row * 43 + column * 20;
            const auto r = static_cast<double>(row);
            const auto c = static_cast<double>(column);
            put(at, std::bit_cast<std::uint64_t>(-2.0 * r - c), 8);
            put(at + 8, std::bit_cast<std::uint32_t>(static_cast<float>(c + 1.0)), 4);
            put(at + 12, std::bit_cast<std::uint32_t>(static_cast<float>(r + 0.5)), 4);
        }
    }
    return cloud;
}

TEST(ConvertCloud, ReadsEitherByteOrderMixedTypesAndPadding) {
    for (const bool big_endian : {false, true}) {
        FirstError errors;
        const auto points = read_cloud(camera_cloud(big_endian), "cloud", errors);
        ASSERT_FALSE(errors.any()) << errors.error()->detail;
        EXPECT_THAT(points, ElementsAre(Eigen::Vector3d(1, 0.5, 0), Eigen::Vector3d(2, 0.5, -1),
                                        Eigen::Vector3d(1, 1.5, -2), Eigen::Vector3d(2, 1.5, -3)));
    }
}

// What an organised camera cloud did not measure stays NaN, at its place in the grid.
TEST(ConvertCloud, KeepsPointsThatWereNotMeasured) {
    PointCloud2_ cloud = camera_cloud(false);
    const auto nan = std::bit_cast<std::array<std::uint8_t, 4>>(std::nanf(""));
    std::ranges::copy(nan, cloud.data().begin() + 20 + 8);  // x of row 0, column 1
    cloud.is_dense(false);
    FirstError errors;
    const auto points = read_cloud(cloud, "cloud", errors);
    ASSERT_FALSE(errors.any());
    ASSERT_EQ(points.size(), 4u);
    EXPECT_TRUE(std::isnan(points[1].x()));
    EXPECT_EQ(points[1].y(), 0.5);
    EXPECT_EQ(points[3], Eigen::Vector3d(2, 1.5, -3));
}

// The sensor origin is given in O, as the cloud is, and reaches the planner as it is.
TEST(ConvertCloud, SensorOriginReachesTheCloud) {
    PlanRequest request = test::small_request();
    request.object_O = PointCloud{{{1, 2, 3}}, Eigen::Vector3d(0.25, -0.5, 1)};
    const auto read = read_request(write_request(request, "").value(), {});
    ASSERT_TRUE(read.ok()) << read.error().detail;
    const auto& cloud = std::get<PointCloud>(read.value().object_O);
    ASSERT_TRUE(cloud.sensor_origin.has_value());
    EXPECT_EQ(*cloud.sensor_origin, Eigen::Vector3d(0.25, -0.5, 1));
}

TEST(ConvertCloud, EmptyMeansNoPointsAndNoData) {
    EXPECT_TRUE(is_empty(PointCloud2_{}));
    PointCloud2_ cloud = camera_cloud(false);
    EXPECT_FALSE(is_empty(cloud));
    cloud.width(0);
    EXPECT_FALSE(is_empty(cloud));  // data without points is a mistake to be reported
    cloud.data().clear();
    EXPECT_TRUE(is_empty(cloud));
    cloud.width(1);
    EXPECT_FALSE(is_empty(cloud));
}

struct BadCloud {
    const char* name;
    std::function<void(PointCloud2_&)> spoil;
    std::vector<std::string> says;
};

void PrintTo(const BadCloud& bad, std::ostream* out) {
    *out << bad.name;
}

class BadClouds : public testing::TestWithParam<BadCloud> {};

TEST_P(BadClouds, AreRefusedWithTheNumbers) {
    PointCloud2_ cloud = camera_cloud(false);
    GetParam().spoil(cloud);
    FirstError errors;
    EXPECT_TRUE(read_cloud(cloud, "cloud", errors).empty());
    ASSERT_TRUE(errors.any());
    EXPECT_EQ(errors.error()->code, PlanErrorCode::kInvalidInput);
    for (const std::string& part : GetParam().says) {
        EXPECT_THAT(errors.error()->detail, HasSubstr(part));
    }
}

const BadCloud kBadClouds[] = {
    {"NoWidth", [](PointCloud2_& c) { c.width(0); }, {"width 0"}},
    {"NoHeight", [](PointCloud2_& c) { c.height(0); }, {"height 0"}},
    {"ShortRow", [](PointCloud2_& c) { c.row_step(39); }, {"row_step = 39", "40"}},
    {"ShortData", [](PointCloud2_& c) { c.data().pop_back(); }, {"85 bytes", "86"}},
    {"LongData", [](PointCloud2_& c) { c.data().push_back(0); }, {"87 bytes", "86"}},
    {"HugeHeight", [](PointCloud2_& c) { c.height(0xffffffffu); }, {"184683593685"}},
    {"HugeBoth",
     [](PointCloud2_& c) {
         c.height(0x80000000u);
         c.row_step(0x80000000u);  // 2^62 bytes
         c.width(0x80000000u);
     },
     {"row_step"}},
    {"NoX", [](PointCloud2_& c) { c.fields()[3].name("X"); }, {"no field x"}},
    {"NoFields", [](PointCloud2_& c) { c.fields().clear(); }, {"no field x"}},
    {"TwoX", [](PointCloud2_& c) { c.fields()[0].name("x"); }, {"two fields x"}},
    {"IntegerY", [](PointCloud2_& c) { c.fields()[1].datatype(5); }, {"y.datatype = 5", "FLOAT32"}},
    {"PairOfZ", [](PointCloud2_& c) { c.fields()[2].count(2); }, {"z.count = 2"}},
    {"NoZ", [](PointCloud2_& c) { c.fields()[2].count(0); }, {"z.count = 0"}},
    {"XBehindThePoint",
     [](PointCloud2_& c) { c.fields()[3].offset(17); },
     {"x.offset = 17", "point_step = 20"}},
    {"DoubleBehindThePoint",
     [](PointCloud2_& c) { c.fields()[2].offset(13); },
     {"z.offset = 13", "8 bytes"}},
    {"OffsetThatWraps",
     [](PointCloud2_& c) { c.fields()[3].offset(0xfffffffdu); },
     {"x.offset = 4294967293"}},
    {"NoStep", [](PointCloud2_& c) { c.point_step(0); }, {"point_step = 0"}},
};

INSTANTIATE_TEST_SUITE_P(ConvertCloud, BadClouds, testing::ValuesIn(kBadClouds),
                         [](const auto& test) { return std::string(test.param.name); });

// DESIGN 5: a cloud whose own frame differs from F is refused with the value.
TEST(ConvertCloud, FrameMustBeEmptyOrThatOfTheRequest) {
    PlanRequest request = test::small_request();
    request.object_O = PointCloud{{{1, 2, 3}}, {}};
    auto wire_request = write_request(request, "").value();
    EXPECT_TRUE(read_request(wire_request, {}).ok());
    wire_request.cloud().header().frame_id("");
    EXPECT_TRUE(read_request(wire_request, {}).ok());
    wire_request.cloud().header().frame_id("camera");
    const auto refused = read_request(wire_request, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().detail, HasSubstr("cloud.header.frame_id = \"camera\""));
    EXPECT_THAT(refused.error().detail, HasSubstr("\"base\""));
}

TEST(ConvertCloud, BadSensorOriginIsRefused) {
    PlanRequest request = test::small_request();
    request.object_O = PointCloud{{{1, 2, 3}}, Eigen::Vector3d(0, 0, 1)};
    auto wire_request = write_request(request, "").value();
    wire_request.sensor_origin()[0].x(std::numeric_limits<double>::infinity());
    EXPECT_THAT(read_request(wire_request, {}).error().detail, HasSubstr("sensor_origin[0]"));
    wire_request.sensor_origin().resize(2);
    EXPECT_THAT(read_request(wire_request, {}).error().detail, HasSubstr("sensor_origin has 2"));
}

}  // namespace
}  // namespace graspd::dds
