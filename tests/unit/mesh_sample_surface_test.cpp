#include "graspd/mesh/sample_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include "support/mesh_damage.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

constexpr double kFinger_m = 0.02;  // with the default of 0.15: a spacing of 3 mm
constexpr double kSpacing_m = 0.003;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> zeros(const TriangleMesh& mesh) {
    return std::vector<double>(mesh.vertices.size(), 0.0);
}

std::vector<SurfaceSample> samples_of(const TriangleMesh& mesh) {
    const auto surface = sample_surface(mesh, zeros(mesh), kFinger_m, {});
    EXPECT_TRUE(surface.ok()) << (surface.ok() ? "" : surface.error().detail);
    return surface.ok() ? surface.value().samples : std::vector<SurfaceSample>{};
}

double area_of(const std::vector<SurfaceSample>& samples) {
    double area_m2 = 0.0;
    for (const SurfaceSample& sample : samples) area_m2 += sample.area_m2;
    return area_m2;
}

/// Exact equality of every number, which operator== of doubles is, zeros' signs aside.
bool same(const SurfaceSample& a, const SurfaceSample& b) {
    return a.point == b.point && a.normal == b.normal && a.area_m2 == b.area_m2 &&
           a.concavity_m == b.concavity_m;
}

bool same(const std::vector<SurfaceSample>& a, const std::vector<SurfaceSample>& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same(x, y); });
}

// A box of 61 x 40 x 25 mm seen along each axis: lines at +-1.5, 4.5, ... mm inside +-30.5, +-20
// and +-12.5 mm are 20, 14 and 8. So 2 (20 x 14 + 14 x 8 + 8 x 20) samples of 9 mm^2.
TEST(SampleSurface, ABoxHasTheLinesThatPassThroughIt) {
    const auto mesh = test::box({0.061, 0.040, 0.025});
    const auto surface = sample_surface(mesh, zeros(mesh), kFinger_m, {});
    ASSERT_TRUE(surface.ok());
    EXPECT_DOUBLE_EQ(surface.value().spacing_m, kSpacing_m);
    const auto& samples = surface.value().samples;
    ASSERT_EQ(samples.size(), 2U * (20 * 14 + 14 * 8 + 8 * 20));
    std::size_t on_top = 0;
    for (const SurfaceSample& sample : samples) {
        EXPECT_DOUBLE_EQ(sample.area_m2, 9e-6);
        if (sample.normal.z() != 1.0) continue;
        ++on_top;
        EXPECT_EQ(sample.point.z(), 0.0125);
        for (const int axis : {0, 1}) {
            const double cell = sample.point[axis] / kSpacing_m - 0.5;
            EXPECT_NEAR(cell, std::round(cell), 1e-9);
        }
    }
    EXPECT_EQ(on_top, 20U * 14U);
}

// A cube whose faces are cut along all grid lines and half way between them: s is a power of 2, so
// every line meets an edge or a corner exactly, and each of the 6 x 6 lines counts once a side.
TEST(SampleSurface, ALineThroughAnEdgeCountsOnce) {
    const double s = 1.0 / 512.0;
    std::vector<double> lines;
    for (int i = -6; i <= 6; ++i) lines.push_back(0.5 * s * i);
    const auto mesh = test::grid_solid(
        {lines, lines, lines}, [](int, int, int) { return true; }, 12);
    const auto surface =
        sample_surface(mesh, zeros(mesh), 1.0 / 512.0, {.spacing_finger_widths = 1.0});
    ASSERT_TRUE(surface.ok());
    // The side spans [-3 s, 3 s]: lines at +-0.5 s, +-1.5 s, +-2.5 s.
    EXPECT_EQ(surface.value().samples.size(), 6U * 36U);
    EXPECT_DOUBLE_EQ(area_of(surface.value().samples), 6.0 * 36.0 * s * s);
}

// Samples stand for their area: each shape gives its own within 2 %. On curved shapes that share
// the grid's symmetry whole rings change their dominant axis between two lines, so these are
// sampled at 0.75 mm.
TEST(SampleSurface, TheSharesAddUpToTheArea) {
    const double pi = std::numbers::pi;
    const auto fine_area = [](const TriangleMesh& mesh) {
        const auto surface = sample_surface(mesh, zeros(mesh), 0.005, {.max_samples = 1000000});
        return surface.ok() ? area_of(surface.value().samples) : 0.0;
    };
    EXPECT_NEAR(fine_area(test::sphere(0.04, 5000)) / (4.0 * pi * 0.04 * 0.04), 1.0, 0.02);
    EXPECT_NEAR(fine_area(test::torus(0.05, 0.02, 5000)) / (4.0 * pi * pi * 0.05 * 0.02), 1.0,
                0.02);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto mesh = test::moved(test::box({0.1, 0.07, 0.05}, 500), test::random_pose(seed));
        EXPECT_NEAR(area_of(samples_of(mesh)) / (2.0 * (0.007 + 0.0035 + 0.005)), 1.0, 0.02);
    }
}

// A sample stands for s^2 (seen along its axis) to sqrt(3) s^2 (along a diagonal).
TEST(SampleSurface, SamplesLieOnTheSurfaceWithItsNormal) {
    for (const SurfaceSample& sample : samples_of(test::sphere(0.04, 20000))) {
        EXPECT_NEAR(sample.point.norm(), 0.04, 2e-5);
        EXPECT_GT(sample.normal.dot(sample.point.normalized()), 0.999);
        EXPECT_NEAR(sample.normal.norm(), 1.0, 1e-15);
        EXPECT_GE(sample.area_m2, 9e-6 * (1.0 - 1e-12));
        EXPECT_LE(sample.area_m2, 9e-6 * std::sqrt(3.0) * (1.0 + 1e-9));
    }
}

// The grid is symmetric about the frame's planes, so a symmetric object's samples are.
TEST(SampleSurface, ASymmetricObjectHasSymmetricSamples) {
    const auto mesh = test::box_hourglass({0.061, 0.047, 0.011}, 0.019, 0.031, 2000);
    const auto samples = samples_of(mesh);
    const auto precedes = [](const SurfaceSample& a, const SurfaceSample& b) {
        return std::lexicographical_compare(a.point.data(), a.point.data() + 3, b.point.data(),
                                            b.point.data() + 3);
    };
    for (int axis = 0; axis < 3; ++axis) {
        auto mirrored = samples;
        for (SurfaceSample& sample : mirrored) {
            sample.point[axis] = -sample.point[axis];
            sample.normal[axis] = -sample.normal[axis];
        }
        std::ranges::sort(mirrored, precedes);
        EXPECT_TRUE(same(mirrored, samples)) << axis;
    }
}

// The samples of flat axis-parallel sides are the same numbers, however the sides are cut.
TEST(SampleSurface, TheCutIntoTrianglesDoesNotMatter) {
    for (const auto& make :
         {+[](std::size_t faces) {
              return test::box({0.061, 0.040, 0.025}, faces);
          },
          +[](std::size_t faces) { return test::u_channel(0.031, 0.025, 0.008, 0.07, faces); },
          +[](std::size_t faces) {
              return test::box_hourglass({0.06, 0.05, 0.01}, 0.02, 0.031, faces);
          }}) {
        const auto coarse = samples_of(make(200));
        EXPECT_GT(coarse.size(), 500U);
        EXPECT_TRUE(same(coarse, samples_of(make(2000))));
        EXPECT_TRUE(same(coarse, samples_of(make(20000))));
    }
}

// Slanted sides cut anew: the same lines, and heights that differ by rounding only. At 45 degrees
// two components of the normal are equal, and rounding must not choose the axis face by face.
TEST(SampleSurface, SlantedSidesKeepTheirLines) {
    const auto prism = [](std::size_t faces) {
        return test::oblique_prism({0.061, 0.040, 0.050}, 0.050, faces);
    };
    const auto coarse = samples_of(prism(200));
    const auto fine = samples_of(prism(20000));
    ASSERT_EQ(coarse.size(), fine.size());
    std::size_t slanted = 0;
    for (const SurfaceSample& sample : coarse) {
        const auto twin = std::ranges::min_element(fine, {}, [&](const SurfaceSample& other) {
            return (other.point - sample.point).norm();
        });
        EXPECT_LT((twin->point - sample.point).norm(), 1e-12);
        if (sample.normal.x() == 0.0) continue;
        ++slanted;
        const double cell = sample.point.z() / kSpacing_m - 0.5;  // lines along x, the lower axis
        EXPECT_NEAR(cell, std::round(cell), 1e-9);
    }
    // 16 lines in z within +-25 mm, 14 in y within +-20 mm, two sides
    EXPECT_EQ(slanted, 2U * 16U * 14U);
}

// The order of faces, of vertices and of a face's corners leaves every byte as it is.
TEST(SampleSurface, TheOrderOfFacesAndVerticesDoesNotMatter) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto mesh = test::moved(test::torus(0.05, 0.02, 3000), test::random_pose(100 + seed));
        std::vector<std::uint32_t> new_of_old;
        const auto other = test::shuffled(mesh, seed, &new_of_old);
        std::vector<double> value(mesh.vertices.size());
        std::vector<double> other_value(value.size());
        for (std::size_t v = 0; v < value.size(); ++v) {
            value[v] = std::abs(std::sin(1e3 * mesh.vertices[v].x()));
            other_value[new_of_old[v]] = value[v];
        }
        // 2000 samples at most, so that the grown spacing is covered too.
        const auto a = sample_surface(mesh, value, kFinger_m, {.max_samples = 2000});
        const auto b = sample_surface(other, other_value, kFinger_m, {.max_samples = 2000});
        ASSERT_TRUE(a.ok() && b.ok());
        EXPECT_EQ(a.value().spacing_m, b.value().spacing_m);
        ASSERT_EQ(a.value().samples.size(), b.value().samples.size());
        EXPECT_TRUE(same(a.value().samples, b.value().samples));
    }
}

// Nor does rounding: a box that was turned and turned back has its faces where they were but for
// some 1e-16, and its samples in the same order.
TEST(SampleSurface, RoundingDoesNotChangeTheOrder) {
    const auto mesh = test::box({0.061, 0.040, 0.025}, 500);
    const auto expected = samples_of(mesh);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Eigen::Isometry3d X = test::random_pose(seed);
        const auto found = samples_of(test::moved(test::moved(mesh, X), X.inverse()));
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_LT((found[i].point - expected[i].point).norm(), 1e-9) << seed << " " << i;
        }
    }
}

// Points rise by x, then by y, also where an object spans more grid units (a millionth of a
// spacing) than 32 bits count: its second box would lie on the first, were they counted modulo
// 2^32.
TEST(SampleSurface, ALongObjectIsInOrderToo) {
    const auto near = test::box({0.061, 0.040, 0.025});
    const double wrap_m = 4294967296e-6 * kSpacing_m;
    const Eigen::Isometry3d X(Eigen::Translation3d(wrap_m, 0.0, 0.0));
    const auto samples = samples_of(test::joined(near, test::moved(near, X)));
    ASSERT_EQ(samples.size(), 2 * samples_of(near).size());
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const Eigen::Vector3d step = samples[i].point - samples[i - 1].point;
        ASSERT_GT(step.x(), -1e-9) << i;
        ASSERT_TRUE(step.x() > 1e-9 || step.y() > -1e-9) << i;
    }
}

// A sampler keeps nothing of the grid that it made before, and outlives the mesh.
TEST(SampleSurface, ASamplerServesAnySpacing) {
    const SampleSurfaceConfig fine, coarse{.spacing_finger_widths = 0.4};
    const auto mesh = test::sphere(0.04, 2000);
    const std::vector<double> value(mesh.vertices.size(), 0.1);
    const auto sampler = [&] {
        const TriangleMesh passing = mesh;
        return SurfaceSampler::of(passing, value);
    }();
    ASSERT_TRUE(sampler.ok());
    for (const SampleSurfaceConfig& config : {coarse, fine, coarse}) {
        const auto found = sampler.value().sample(kFinger_m, config);
        const auto expected = sample_surface(mesh, value, kFinger_m, config);
        ASSERT_TRUE(found.ok() && expected.ok());
        EXPECT_EQ(found.value().spacing_m, config.spacing_finger_widths * kFinger_m);
        EXPECT_TRUE(same(found.value().samples, expected.value().samples));
    }
    EXPECT_FALSE(sampler.value().sample(0.0, fine).ok());
}

// A linear field is interpolated exactly, a constant one to the last bit.
TEST(SampleSurface, ALinearFieldIsKept) {
    const auto mesh = test::moved(test::sphere(0.04, 2000), test::random_pose(7));
    const Eigen::Vector3d slope(0.3, -0.2, 0.5);
    std::vector<double> linear;
    for (const Eigen::Vector3d& vertex : mesh.vertices) linear.push_back(1.0 + slope.dot(vertex));
    const auto surface = sample_surface(mesh, linear, kFinger_m, {});
    ASSERT_TRUE(surface.ok());
    for (const SurfaceSample& sample : surface.value().samples) {
        EXPECT_NEAR(sample.concavity_m, 1.0 + slope.dot(sample.point), 1e-12);
    }
    const std::vector<double> constant(mesh.vertices.size(), 0.1);
    const auto flat = sample_surface(mesh, constant, kFinger_m, {});
    ASSERT_TRUE(flat.ok());
    for (const SurfaceSample& sample : flat.value().samples) EXPECT_EQ(sample.concavity_m, 0.1);
}

// One enclosed vertex makes its faces enclosed, and no other: of a tetrahedron's four faces only
// the one opposite the vertex, told by its normal, has finite samples.
TEST(SampleSurface, AFaceWithAnEnclosedCornerIsEnclosed) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const Eigen::Vector3d opposite[4] = {Eigen::Vector3d::Ones().normalized(),
                                         -Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(),
                                         -Eigen::Vector3d::UnitZ()};
    for (std::size_t v = 0; v < 4; ++v) {
        std::vector<double> value(4, 0.0);
        value[v] = kInfinity;
        const auto surface = sample_surface(mesh, value, kFinger_m, {});
        ASSERT_TRUE(surface.ok());
        std::size_t finite = 0;
        for (const SurfaceSample& sample : surface.value().samples) {
            const bool free = sample.normal.dot(opposite[v]) > 0.999;
            EXPECT_EQ(sample.concavity_m, free ? 0.0 : kInfinity) << v;
            finite += free;
        }
        EXPECT_GT(finite, 100U);
        EXPECT_GT(surface.value().samples.size(), 3 * finite);
    }
}

// A cube of 0.3 m has 0.54 m^2, at 3 mm 60000 samples. For 20000 the spacing grows to
// sqrt(0.54 / 20000) = 5.196 mm.
TEST(SampleSurface, TheSpacingGrowsWithTheSurface) {
    const auto mesh = test::box({0.3, 0.3, 0.3});
    const auto surface = sample_surface(mesh, zeros(mesh), kFinger_m, {});
    ASSERT_TRUE(surface.ok());
    EXPECT_NEAR(surface.value().spacing_m, std::sqrt(0.54 / 20000.0), 1e-6);
    EXPECT_GE(surface.value().spacing_m, std::sqrt(0.54 / 20000.0) * (1.0 - 1e-9));
    EXPECT_NEAR(static_cast<double>(surface.value().samples.size()), 20000.0, 600.0);
}

TEST(SampleSurface, EveryErrorNamesItsCause) {
    const auto mesh = test::box({0.06, 0.04, 0.03});
    const auto fails = [](const TriangleMesh& object, const std::vector<double>& value,
                          double finger_m, const SampleSurfaceConfig& config, PlanErrorCode code,
                          const char* named) {
        const auto surface = sample_surface(object, value, finger_m, config);
        ASSERT_FALSE(surface.ok()) << named;
        EXPECT_EQ(surface.error().code, code) << named;
        EXPECT_NE(surface.error().detail.find(named), std::string::npos) << surface.error().detail;
    };
    const auto invalid = PlanErrorCode::kInvalidInput;
    fails(mesh, zeros(mesh), 0.0, {}, invalid, "finger_width_m = 0");
    fails(mesh, zeros(mesh), NAN, {}, invalid, "finger_width_m = nan");
    fails(mesh, zeros(mesh), kFinger_m, {.spacing_finger_widths = 0.0}, invalid,
          "sample_surface.spacing_finger_widths");
    fails({}, {}, kFinger_m, {}, invalid, "no face");
    fails(mesh, {0.0}, kFinger_m, {}, invalid, "1 values for 8 vertices");
    auto value = zeros(mesh);
    value[3] = -0.01;
    fails(mesh, value, kFinger_m, {}, invalid, "value_m[3] = -0.01");
    value[3] = NAN;
    fails(mesh, value, kFinger_m, {}, invalid, "value_m[3] = nan");
    auto broken = mesh;
    broken.faces[5][1] = 8;
    fails(broken, zeros(mesh), kFinger_m, {}, invalid, "face 5 names vertex 8 of 8");
    broken = mesh;
    broken.vertices[2].y() = kInfinity;
    fails(broken, zeros(mesh), kFinger_m, {}, invalid, "vertex 2");
    fails(test::moved(mesh, Eigen::Isometry3d(Eigen::Translation3d(1e6, 0, 0))), zeros(mesh),
          kFinger_m, {}, invalid, "too far");
    // Areas beyond the largest number: infinite of a box, infinity less infinity of a tetrahedron.
    const auto vast = test::scaled(mesh, 1e200);
    fails(vast, zeros(vast), kFinger_m, {}, invalid, "too far");
    TriangleMesh skew{{{1e200, 2e200, 3e200}, {4e200, -5e200, 6e200}, {-7e200, 8e200, 9e200}}, {}};
    skew.vertices.emplace_back(2e200, 9e200, -4e200);
    skew.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    fails(skew, zeros(skew), kFinger_m, {}, invalid, "too far");
    // A needle between two lines of the grid.
    const auto needle = test::box({0.001, 0.001, 0.0005});
    fails(needle, zeros(needle), kFinger_m, {}, PlanErrorCode::kDegenerate, "no line");
    // 30 thin sheets of 20 km in y: 4e6 rows each of their faces.
    TriangleMesh sheets;
    for (int i = 0; i < 30; ++i) {
        sheets = test::joined(sheets, test::box({1e-9, 2e4, 1e-9}));
    }
    fails(sheets, zeros(sheets), kFinger_m, {}, PlanErrorCode::kTooLarge, "grid rows");
}

}  // namespace
}  // namespace graspd
