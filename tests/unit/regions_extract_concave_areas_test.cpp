#include "graspd/regions/extract_concave_areas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "graspd/mesh/sample_surface.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr ExtractConcaveAreasConfig kHalf{.salient_fraction = 0.5, .enlarged_fraction = 0.5};

std::vector<SurfaceSample> samples_with(const std::vector<double>& concavity_m) {
    std::vector<SurfaceSample> samples(concavity_m.size());
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i].concavity_m = concavity_m[i];
    return samples;
}

/// Samples 3 mm apart of a channel 31 deep, 25 wide and 72 long (mm), with the concavity that
/// tests/support/shapes.hpp gives for it.
std::vector<SurfaceSample> channel_samples() {
    const double depth = 0.031, width = 0.025, length = 0.072;
    const auto mesh = test::u_channel(depth, width, 0.008, length, 500);
    auto surface = sample_surface(mesh, std::vector<double>(mesh.vertices.size(), 0.0), 0.02, {});
    EXPECT_TRUE(surface.ok());
    for (SurfaceSample& sample : surface.value().samples) {
        const Eigen::Vector3d& p = sample.point;
        const bool in_gap = std::abs(p.x()) <= 0.5 * width && p.z() >= 0.0 && p.z() < depth &&
                            std::abs(p.y()) < 0.5 * length;
        if (in_gap) sample.concavity_m = std::min(depth - p.z(), 0.5 * length - std::abs(p.y()));
    }
    return std::move(surface).value().samples;
}

// Lines at odd multiples of 1.5 mm. Largest concavity: 31 mm in the middle of the floor, so the
// threshold is 15.5 mm: on the floor |y| <= 20.5 (14 lines) times |x| <= 12.5 (8 lines); on the two
// walls z <= 15.5 (5 lines) times 14. Enlarged from 7.75 mm: |y| <= 28.25 (18 lines), z <= 23.25
// (8).
TEST(ExtractConcaveAreas, ChannelByHand) {
    const auto samples = channel_samples();
    const auto areas = extract_concave_areas(samples, 0.01, kHalf);
    ASSERT_TRUE(areas.ok());
    EXPECT_DOUBLE_EQ(areas.value().threshold_m, 0.0155);
    EXPECT_DOUBLE_EQ(areas.value().enlarged_threshold_m, 0.00775);
    EXPECT_EQ(areas.value().salient.size(), 8U * 14U + 2U * 5U * 14U);
    EXPECT_EQ(areas.value().enlarged.size(), 8U * 18U + 2U * 8U * 18U);
    for (const std::uint32_t i : areas.value().salient) {
        const Eigen::Vector3d& p = samples[i].point;
        EXPECT_TRUE(std::abs(p.x()) <= 0.0125 && std::abs(p.y()) <= 0.0205 && p.z() <= 0.0155);
    }
}

// Both thresholds are inclusive; 0.25 and 0.5 are exact in binary.
TEST(ExtractConcaveAreas, ThresholdsAreInclusive) {
    const auto areas =
        extract_concave_areas(samples_with({0.249, 0.25, 0.499, 0.5, 1.0}), 0.01, kHalf);
    ASSERT_TRUE(areas.ok());
    EXPECT_EQ(areas.value().threshold_m, 0.5);
    EXPECT_EQ(areas.value().salient, (std::vector<std::uint32_t>{3, 4}));
    EXPECT_EQ(areas.value().enlarged, (std::vector<std::uint32_t>{1, 2, 3, 4}));
}

// What half a finger does not fit into is no concavity: dents of 3.9 mm for fingers of 8 mm leave
// both sets empty, of 4 mm not, and then the least depth is the threshold, not half the largest.
TEST(ExtractConcaveAreas, ShallowDentsAreNoConcavity) {
    const auto shallow = extract_concave_areas(samples_with({0.0, 0.0039, 0.003}), 0.008, kHalf);
    ASSERT_TRUE(shallow.ok());
    EXPECT_EQ(shallow.value().threshold_m, 0.004);
    EXPECT_TRUE(shallow.value().salient.empty());
    EXPECT_TRUE(shallow.value().enlarged.empty());
    const auto deep = extract_concave_areas(samples_with({0.0, 0.004, 0.003}), 0.008, kHalf);
    ASSERT_TRUE(deep.ok());
    EXPECT_EQ(deep.value().threshold_m, 0.004);
    EXPECT_EQ(deep.value().salient, (std::vector<std::uint32_t>{1}));
    EXPECT_EQ(deep.value().enlarged, (std::vector<std::uint32_t>{1, 2}));
}

// By default everything with a way out may be surroundings, however convex.
TEST(ExtractConcaveAreas, ConvexPartsAreSurroundings) {
    const auto areas = extract_concave_areas(samples_with({0.0, 0.02, kInfinity, 0.001}), 0.01, {});
    ASSERT_TRUE(areas.ok());
    EXPECT_EQ(areas.value().enlarged_threshold_m, 0.0);
    EXPECT_EQ(areas.value().enlarged, (std::vector<std::uint32_t>{0, 1, 3}));
}

// A convex object has none even when every depth would do.
TEST(ExtractConcaveAreas, AConvexObjectHasNone) {
    const auto areas = extract_concave_areas(samples_with({0.0, 0.0}), 0.01,
                                             {.min_depth_finger_thicknesses = 0.0});
    ASSERT_TRUE(areas.ok());
    EXPECT_TRUE(areas.value().salient.empty());
    EXPECT_TRUE(areas.value().enlarged.empty());
    const auto none = extract_concave_areas({}, 0.01, {});
    ASSERT_TRUE(none.ok());
    EXPECT_TRUE(none.value().salient.empty());
}

// Enclosed samples neither belong to a set nor raise the threshold.
TEST(ExtractConcaveAreas, EnclosedSamplesAreLeftOut) {
    const auto areas =
        extract_concave_areas(samples_with({kInfinity, 0.02, kInfinity, 0.01}), 0.01, kHalf);
    ASSERT_TRUE(areas.ok());
    EXPECT_EQ(areas.value().threshold_m, 0.01);
    EXPECT_EQ(areas.value().salient, (std::vector<std::uint32_t>{1, 3}));
    EXPECT_EQ(areas.value().enlarged, (std::vector<std::uint32_t>{1, 3}));
    const auto none = extract_concave_areas(samples_with({kInfinity}), 0.01, {});
    ASSERT_TRUE(none.ok());
    EXPECT_TRUE(none.value().enlarged.empty());
}

// For any values: rising indices, the salient set inside the enlarged one, membership by value.
TEST(ExtractConcaveAreas, MembershipFollowsTheValue) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> draw(0.0, 0.05);
        std::vector<double> values(200);
        for (double& value : values) value = draw(engine);
        const auto samples = samples_with(values);
        const ExtractConcaveAreasConfig config{.salient_fraction = draw(engine) * 20.0,
                                               .enlarged_fraction = draw(engine) * 20.0};
        if (config.salient_fraction < 0.01) continue;
        const auto areas = extract_concave_areas(samples, 0.01, config);
        ASSERT_TRUE(areas.ok());
        const double largest = *std::ranges::max_element(values);
        std::vector<std::uint32_t> salient, enlarged;
        for (std::uint32_t i = 0; i < values.size(); ++i) {
            const double threshold = std::max(0.005, config.salient_fraction * largest);
            if (values[i] >= config.enlarged_fraction * threshold) enlarged.push_back(i);
            if (values[i] >= threshold) salient.push_back(i);
        }
        EXPECT_EQ(areas.value().salient, salient);
        EXPECT_EQ(areas.value().enlarged, enlarged);
    }
}

TEST(ExtractConcaveAreas, EveryErrorNamesItsCause) {
    const auto fails = [](const std::vector<double>& values, double thickness_m,
                          const ExtractConcaveAreasConfig& config, const char* named) {
        const auto areas = extract_concave_areas(samples_with(values), thickness_m, config);
        ASSERT_FALSE(areas.ok()) << named;
        EXPECT_EQ(areas.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_NE(areas.error().detail.find(named), std::string::npos) << areas.error().detail;
    };
    fails({0.1}, 0.0, {}, "finger_thickness_m = 0");
    fails({0.1}, kInfinity, {}, "finger_thickness_m = inf");
    fails({0.1}, 0.01, {.salient_fraction = 0.0}, "extract_concave_areas.salient_fraction = 0");
    fails({0.1}, 0.01, {.enlarged_fraction = 1.5}, "extract_concave_areas.enlarged_fraction = 1.5");
    fails({0.1, -0.5}, 0.01, {}, "samples[1].concavity_m = -0.5");
    fails({0.1, 0.2, NAN}, 0.01, {}, "samples[2].concavity_m = nan");
}

}  // namespace
}  // namespace graspd
