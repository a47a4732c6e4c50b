#include "graspd/regions/cluster_concavities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "graspd/mesh/sample_surface.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

constexpr double kSpacing_m = 0.003;

/// Samples under construction, each salient, enlarged or neither.
struct Scene {
    std::vector<SurfaceSample> samples;
    ConcaveAreas areas;

    /// A patch of nx times ny samples on a grid of 3 mm from (x, y), in whole spacings.
    std::vector<std::uint32_t> add_patch(int x, int y, int nx, int ny, double concavity_m,
                                         bool salient) {
        std::vector<std::uint32_t> added;
        for (int i = 0; i < nx; ++i) {
            for (int j = 0; j < ny; ++j) {
                const auto index = static_cast<std::uint32_t>(samples.size());
                SurfaceSample sample;
                sample.point = {(x + i) * kSpacing_m, (y + j) * kSpacing_m, 0.0};
                sample.concavity_m = concavity_m;
                samples.push_back(sample);
                areas.enlarged.push_back(index);
                if (salient) areas.salient.push_back(index);
                added.push_back(index);
            }
        }
        return added;
    }
    Result<std::vector<Concavity>> cluster(const ClusterConcavitiesConfig& config = {}) const {
        return cluster_concavities(samples, areas, kSpacing_m, config);
    }
};

// Neighbours within 2.5 spacings: a gap of 2 joins two patches, one of 3 parts them.
TEST(ClusterConcavities, TheToleranceDecidesWhatIsOne) {
    for (const int gap : {1, 2, 3}) {
        Scene scene;
        const auto left = scene.add_patch(0, 0, 5, 5, 0.02, true);
        const auto right = scene.add_patch(4 + gap, 0, 4, 4, 0.02, true);
        const auto found = scene.cluster();
        ASSERT_TRUE(found.ok());
        if (gap < 3) {
            ASSERT_EQ(found.value().size(), 1U) << gap;
            EXPECT_EQ(found.value()[0].salient.size(), 41U);
            continue;
        }
        ASSERT_EQ(found.value().size(), 2U);
        EXPECT_EQ(found.value()[0].salient, left);
        EXPECT_EQ(found.value()[1].salient, right);
    }
}

// A distance of exactly the tolerance joins, however floats round it and wherever the object lies.
TEST(ClusterConcavities, ExactlyTheToleranceJoins) {
    for (const double offset_m : {0.0, 0.1, -3.7, 1000.0}) {
        Scene scene;
        scene.add_patch(0, 0, 5, 5, 0.02, true);
        scene.add_patch(7, 0, 5, 5, 0.02, true);
        for (SurfaceSample& sample : scene.samples) sample.point.array() += offset_m;
        const auto found = scene.cluster({.tolerance_spacings = 3.0});
        ASSERT_TRUE(found.ok());
        EXPECT_EQ(found.value().size(), 1U) << offset_m;
    }
}

// The deepest comes first; of equally deep ones the larger, then the one with the lower index. What
// is small is noise, and only the first max_concavities stay.
TEST(ClusterConcavities, TheDeepestComesFirst) {
    Scene scene;
    const auto small_first = scene.add_patch(0, 0, 4, 4, 0.02, true);
    const auto large = scene.add_patch(20, 0, 5, 5, 0.02, true);
    const auto small_second = scene.add_patch(40, 0, 4, 4, 0.02, true);
    const auto deep = scene.add_patch(60, 0, 3, 4, 0.02, true);
    scene.samples[deep[7]].concavity_m = 0.03;
    scene.add_patch(80, 0, 11, 1, 0.09, true);  // 11 < 12
    const auto found = scene.cluster();
    ASSERT_TRUE(found.ok());
    ASSERT_EQ(found.value().size(), 4U);
    EXPECT_EQ(found.value()[0].salient, deep);
    EXPECT_EQ(found.value()[0].depth_m, 0.03);
    EXPECT_EQ(found.value()[1].salient, large);
    EXPECT_EQ(found.value()[1].depth_m, 0.02);
    EXPECT_EQ(found.value()[2].salient, small_first);
    EXPECT_EQ(found.value()[3].salient, small_second);
    const auto two = scene.cluster({.max_concavities = 2});
    ASSERT_TRUE(two.ok());
    ASSERT_EQ(two.value().size(), 2U);
    EXPECT_EQ(two.value()[1].salient, large);
    const auto with_noise = scene.cluster({.min_samples = 11});
    ASSERT_TRUE(with_noise.ok());
    EXPECT_EQ(with_noise.value()[0].depth_m, 0.09);
}

// The salient patch spans 0..4 in both directions; of an enlarged strip beside it the columns up to
// 5 spacings away (5..9) belong to its surroundings, the ones further off (10..13) do not.
TEST(ClusterConcavities, SurroundingsReachFiveSpacings) {
    Scene scene;
    auto expected = scene.add_patch(0, 0, 5, 5, 0.02, true);
    const auto strip = scene.add_patch(5, 2, 9, 1, 0.01, false);
    expected.insert(expected.end(), strip.begin(), strip.begin() + 5);
    const auto found = scene.cluster();
    ASSERT_TRUE(found.ok());
    ASSERT_EQ(found.value().size(), 1U);
    EXPECT_EQ(found.value()[0].enlarged, expected);
    const auto alone = scene.cluster({.enlargement_spacings = 0.0});
    ASSERT_TRUE(alone.ok());
    EXPECT_EQ(alone.value()[0].enlarged, alone.value()[0].salient);
}

// Distance counts in every direction: of a sample 3 and 4 spacings off the corner (5 away) and one
// 4 and 4 off (5.66 away) only the first belongs.
TEST(ClusterConcavities, SurroundingsAreRoundAtCorners) {
    Scene scene;
    scene.add_patch(0, 0, 5, 5, 0.02, true);
    const auto near = scene.add_patch(7, 8, 1, 1, 0.01, false);
    const auto far = scene.add_patch(8, 8, 1, 1, 0.01, false);
    const auto found = scene.cluster();
    ASSERT_TRUE(found.ok());
    const auto& enlarged = found.value()[0].enlarged;
    EXPECT_TRUE(std::ranges::binary_search(enlarged, near[0]));
    EXPECT_FALSE(std::ranges::binary_search(enlarged, far[0]));
}

// Two hourglasses 0.2 m apart have two necks, deepest first: half of (60 - 20) and of (60 - 30) mm.
TEST(ClusterConcavities, TwoHourglassesHaveTwoNecks) {
    const auto deep = test::box_hourglass({0.06, 0.06, 0.01}, 0.02, 0.03, 500);
    const auto shallow = test::moved(test::box_hourglass({0.06, 0.06, 0.01}, 0.03, 0.03, 500),
                                     Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.0, 0.0)));
    const auto mesh = test::joined(deep, shallow);
    auto surface = sample_surface(mesh, std::vector<double>(mesh.vertices.size(), 0.0), 0.02, {});
    ASSERT_TRUE(surface.ok());
    auto& samples = surface.value().samples;
    for (SurfaceSample& sample : samples) {
        const bool right = sample.point.x() > 0.1;
        const Eigen::Vector3d p = sample.point - Eigen::Vector3d(right ? 0.2 : 0.0, 0.0, 0.0);
        const double reach = std::max(std::abs(p.x()), std::abs(p.y()));
        if (std::abs(p.z()) <= 0.015) sample.concavity_m = 0.03 - reach;
    }
    const auto areas = extract_concave_areas(samples, 0.01, {.salient_fraction = 0.7});
    ASSERT_TRUE(areas.ok());
    const auto found = cluster_concavities(samples, areas.value(), surface.value().spacing_m, {});
    ASSERT_TRUE(found.ok());
    ASSERT_EQ(found.value().size(), 2U);
    EXPECT_NEAR(found.value()[0].depth_m, 0.02, 1e-12);
    EXPECT_NEAR(found.value()[1].depth_m, 0.015, 1e-12);
    for (const std::uint32_t i : found.value()[0].enlarged) EXPECT_LT(samples[i].point.x(), 0.1);
    for (const std::uint32_t i : found.value()[1].enlarged) EXPECT_GT(samples[i].point.x(), 0.1);
}

// Renaming the samples renames the members and changes nothing else; and by another method, the
// clusters are the components of the graph of pairs nearer than the tolerance.
TEST(ClusterConcavities, TheOrderOfSamplesOnlyRenames) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> draw(0.0, 0.1);
        Scene scene;
        for (std::uint32_t i = 0; i < 300; ++i) {
            SurfaceSample sample;
            sample.point = {draw(engine), draw(engine), 0.2 * draw(engine)};
            sample.concavity_m = 0.01 + draw(engine);
            scene.samples.push_back(sample);
            scene.areas.enlarged.push_back(i);
            if (sample.concavity_m > 0.03) scene.areas.salient.push_back(i);
        }
        std::vector<std::uint32_t> new_of_old(300);
        std::iota(new_of_old.begin(), new_of_old.end(), 0U);
        std::ranges::shuffle(new_of_old, engine);
        Scene other;
        other.samples.resize(300);
        for (std::uint32_t i = 0; i < 300; ++i) other.samples[new_of_old[i]] = scene.samples[i];
        for (const std::uint32_t i : scene.areas.salient) {
            other.areas.salient.push_back(new_of_old[i]);
        }
        std::ranges::sort(other.areas.salient);
        other.areas.enlarged = scene.areas.enlarged;

        const ClusterConcavitiesConfig config{.min_samples = 4};
        const auto a = scene.cluster(config);
        const auto b = other.cluster(config);
        ASSERT_TRUE(a.ok() && b.ok());
        ASSERT_EQ(a.value().size(), b.value().size());
        EXPECT_GE(a.value().size(), 2U);
        for (std::size_t k = 0; k < a.value().size(); ++k) {
            const auto renamed = [&](std::vector<std::uint32_t> members) {
                for (std::uint32_t& i : members) i = new_of_old[i];
                std::ranges::sort(members);
                return members;
            };
            EXPECT_EQ(renamed(a.value()[k].salient), b.value()[k].salient);
            EXPECT_EQ(renamed(a.value()[k].enlarged), b.value()[k].enlarged);
        }

        std::vector<std::uint32_t> component(300);
        std::iota(component.begin(), component.end(), 0U);
        for (bool changed = true; changed;) {
            changed = false;
            for (const std::uint32_t i : scene.areas.salient) {
                for (const std::uint32_t j : scene.areas.salient) {
                    const double d = (scene.samples[i].point - scene.samples[j].point).norm();
                    if (d >= 2.5 * kSpacing_m || component[i] <= component[j]) continue;
                    component[i] = component[j];
                    changed = true;
                }
            }
        }
        std::size_t large = 0;
        for (const std::uint32_t root :
             std::set<std::uint32_t>(component.begin(), component.end())) {
            large += std::ranges::count(component, root) >= 4;
        }
        EXPECT_EQ(a.value().size(), std::min<std::size_t>(large, 16));
        for (const Concavity& concavity : a.value()) {
            for (const std::uint32_t i : concavity.salient) {
                EXPECT_EQ(component[i], component[concavity.salient.front()]);
            }
        }
    }
}

TEST(ClusterConcavities, NoSalientSampleGivesNone) {
    Scene scene;
    scene.add_patch(0, 0, 5, 5, 0.02, false);
    const auto found = scene.cluster();
    ASSERT_TRUE(found.ok());
    EXPECT_TRUE(found.value().empty());
}

TEST(ClusterConcavities, EveryErrorNamesItsCause) {
    Scene good;
    good.add_patch(0, 0, 5, 5, 0.02, true);
    const auto fails = [](const Scene& scene, double spacing_m,
                          const ClusterConcavitiesConfig& config, const char* named) {
        const auto found = cluster_concavities(scene.samples, scene.areas, spacing_m, config);
        ASSERT_FALSE(found.ok()) << named;
        EXPECT_EQ(found.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_NE(found.error().detail.find(named), std::string::npos) << found.error().detail;
    };
    fails(good, 0.0, {}, "spacing_m = 0");
    fails(good, NAN, {}, "spacing_m = nan");
    fails(good, kSpacing_m, {.tolerance_spacings = 0.5}, "cluster_concavities.tolerance_spacings");
    fails(good, kSpacing_m, {.min_samples = 3}, "cluster_concavities.min_samples = 3");
    auto bad = good;
    bad.areas.salient.push_back(25);
    fails(bad, kSpacing_m, {}, "areas.salient names sample 25 of 25");
    bad = good;
    bad.areas.enlarged.push_back(99);
    fails(bad, kSpacing_m, {}, "areas.enlarged names sample 99 of 25");
    bad = good;
    bad.samples[7].point.z() = NAN;
    fails(bad, kSpacing_m, {}, "samples[7].point");
}

}  // namespace
}  // namespace graspd
