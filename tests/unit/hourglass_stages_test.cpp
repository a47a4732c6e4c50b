// The stages from mesh to step points in a row, on hourglasses whose every number can be worked out
// by hand. All lengths in the comments in mm.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

#include "graspd/concavity/outer_hull.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/contour/boundary_points.hpp"
#include "graspd/contour/concave_hull.hpp"
#include "graspd/contour/order_boundary.hpp"
#include "graspd/contour/project_points.hpp"
#include "graspd/grasp/circle_cut.hpp"
#include "graspd/grasp/step_points.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/regions/cluster_concavities.hpp"
#include "graspd/regions/concavity_frame.hpp"
#include "graspd/regions/extract_concave_areas.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Points2 = std::vector<Eigen::Vector2d>;
using Points3 = std::vector<Eigen::Vector3d>;

constexpr double kFingerWidth_m = 0.02;
constexpr double kFingerThickness_m = 0.01;
constexpr double kFingerLength_m = 0.045;
constexpr double kSpacing_m = 0.003;    // 0.15 finger widths
constexpr double kThreshold_m = 0.009;  // 0.45 of 20 mm: no sample's value is near it
constexpr double kOutlined_m = 0.0085;  // the neck's corners are rounded by alpha, 9 mm

/// What each stage gives, in order.
struct Stages {
    ConditionedMesh conditioned;
    OuterHull hull;
    ConcavityField field;
    SurfaceSamples surface;
    ConcaveAreas areas;
    std::vector<Concavity> concavities;
    ConcavityFrame frame;
    Points2 outline, enlarged_outline, boundary;
};

Points3 points_of(const SurfaceSamples& surface, const std::vector<std::uint32_t>& indices) {
    Points3 points;
    for (const std::uint32_t i : indices) points.push_back(surface.samples[i].point);
    return points;
}

/// Runs II-A to II-D; leaves what comes after a failure empty, so that the checks fail.
Stages run(const TriangleMesh& soup) {
    Stages s;
    const auto take = [](auto&& result, auto& into) {
        EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().detail);
        if (result.ok()) into = std::move(result).value();
        return result.ok();
    };
    if (!take(condition_mesh(soup, {}), s.conditioned)) return s;
    const TriangleMesh& mesh = s.conditioned.mesh;
    const ConcavityConfig concavity;
    const TriangleBvh bvh(mesh,
                          mesh_diagonal_m(mesh) * concavity.start_offset / kOffsetOverRayTolerance);
    if (!take(outer_hull(mesh.vertices), s.hull)) return s;
    if (!take(shortest_path_concavity(mesh, s.hull, bvh, concavity), s.field)) return s;
    if (!take(sample_surface(mesh, s.field.value_m, kFingerWidth_m, {}), s.surface)) return s;
    const auto& samples = s.surface.samples;
    const double spacing_m = s.surface.spacing_m;
    if (!take(extract_concave_areas(samples, kFingerThickness_m, {.salient_fraction = 0.45}),
              s.areas))
        return s;
    if (!take(cluster_concavities(samples, s.areas, spacing_m, {}), s.concavities)) return s;
    if (s.concavities.empty()) return s;
    const Points3 salient_O = points_of(s.surface, s.concavities[0].salient);
    const Points3 enlarged_O = points_of(s.surface, s.concavities[0].enlarged);
    if (!take(concavity_frame(salient_O, bvh, kFingerLength_m, {}), s.frame)) return s;
    const Eigen::Isometry3d& X_OW = s.frame.planes[0].X_OW;
    ConcaveHull cluster, enlarged;
    if (!take(concave_hull(project_points(salient_O, X_OW), spacing_m, {}), cluster)) return s;
    if (!take(concave_hull(project_points(enlarged_O, X_OW), spacing_m, {}), enlarged)) return s;
    s.outline = cluster.outline;
    s.enlarged_outline = enlarged.outline;
    Points2 kept;
    if (take(boundary_points(s.outline, s.enlarged_outline, spacing_m, {}), kept))
        s.boundary = order_boundary(kept);
    return s;
}

/// Points of the boundary between the neck's rounded corners, first or second axis of W along x.
Points2 neck_part(const Points2& points) {
    Points2 neck;
    for (const Eigen::Vector2d& p : points) {
        if (std::abs(p.y()) < kOutlined_m) neck.push_back(p);
    }
    return neck;
}

/// Plates of 60 x 48 x 10 on a square neck, 20 wide and 30 long. W's first axis is x (19.5 is
/// longer than 15), its third y, so its second is -z.
class BoxHourglass : public testing::Test {
protected:
    static void SetUpTestSuite() {
        stages_ = new Stages(run(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 20000)));
    }
    static void TearDownTestSuite() {
        delete stages_;
        stages_ = nullptr;
    }
    static const Stages& stages() { return *stages_; }

private:
    static inline Stages* stages_ = nullptr;
};

// Volume 2 (60 x 48 x 10) + 20 x 20 x 30; nothing to repair. The hull is the box around it.
TEST_F(BoxHourglass, ConditionAndHull) {
    EXPECT_NEAR(stages().conditioned.volume_m3, 2 * 0.06 * 0.048 * 0.01 + 0.02 * 0.02 * 0.03,
                1e-12);
    EXPECT_EQ(stages().conditioned.fill_vertices, 0U);
    EXPECT_NEAR(stages().hull.volume_m3, 0.06 * 0.048 * 0.05, 1e-12);
    EXPECT_EQ(stages().hull.facets.size(), 6U);
}

// Between the plates every way out is straight: min(30 - |x|, 24 - |y|). On the neck's side at x =
// +-10, in its middle, (60 - 20) / 2 = 20.
TEST_F(BoxHourglass, Concavity) {
    const TriangleMesh& mesh = stages().conditioned.mesh;
    EXPECT_NEAR(stages().field.largest_m, 0.02, 1e-9);
    ASSERT_EQ(stages().field.value_m.size(), mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Eigen::Vector3d& p = mesh.vertices[v];
        const double out = std::min(0.03 - std::abs(p.x()), 0.024 - std::abs(p.y()));
        EXPECT_NEAR(stages().field.value_m[v], std::abs(p.z()) <= 0.015001 ? out : 0.0, 1e-6);
    }
}

// Lines at odd multiples of 1.5. Neck: 6 x 10 on each of four sides. Plates: inside 20 x 16 = 320
// lines less the neck's 36, outside 320; rims: lines at z = 16.5, 19.5, 22.5, so 3 x (20 + 16)
// twice.
TEST_F(BoxHourglass, Samples) {
    EXPECT_DOUBLE_EQ(stages().surface.spacing_m, kSpacing_m);
    const std::size_t plate = 2 * 20 * 16 - 36 + 2 * 3 * (20 + 16);
    EXPECT_EQ(stages().surface.samples.size(), 4U * 60U + 2U * plate);
    for (const SurfaceSample& sample : stages().surface.samples) {
        const Eigen::Vector3d& p = sample.point;
        if (std::abs(p.z()) > 0.0151 || std::abs(p.x()) > 0.0299 || std::abs(p.y()) > 0.0239)
            continue;
        // Below the true value by the sagging of chords under the ridge where two ways are equal.
        const double out = std::min(0.03 - std::abs(p.x()), 0.024 - std::abs(p.y()));
        EXPECT_LE(sample.concavity_m, out + 1e-6);
        EXPECT_GE(sample.concavity_m, out - 1e-3);
    }
}

// From 9 up: |x| <= 21 (14 lines) and |y| <= 15 (10 lines), less the neck's 36, on both plates; the
// whole neck. One cluster, whose box reaches to (19.5, 13.5, 15); its surroundings are what lies
// within 15 of that box: the plates but for their far corners, such as (28.5, 22.5, 25), which is
// hypot(9, 9, 10) = 16.2 away. (Above the neck there is no salient sample, yet none further than
// hypot(9, 10) = 13.5 from one.)
TEST_F(BoxHourglass, OneClusterIsTheNeck) {
    EXPECT_NEAR(stages().areas.threshold_m, kThreshold_m, 1e-9);
    EXPECT_EQ(stages().areas.salient.size(), 240U + 2U * (14U * 10U - 36U));
    ASSERT_EQ(stages().concavities.size(), 1U);
    const Concavity& neck = stages().concavities[0];
    EXPECT_EQ(neck.salient, stages().areas.salient);
    EXPECT_NEAR(neck.depth_m, 0.02, 1e-9);
    for (const std::uint32_t i : neck.salient) {
        const Eigen::Vector3d& p = stages().surface.samples[i].point;
        EXPECT_LE(std::abs(p.x()), 0.0195 + 1e-12);
        EXPECT_LE(std::abs(p.y()), 0.0135 + 1e-12);
        EXPECT_LE(std::abs(p.z()), 0.015 + 1e-12);
    }
    for (std::uint32_t i = 0; i < stages().surface.samples.size(); ++i) {
        const Eigen::Vector3d& p = stages().surface.samples[i].point;
        const Eigen::Vector3d off((std::abs(p.x()) - 0.0195), (std::abs(p.y()) - 0.0135),
                                  (std::abs(p.z()) - 0.015));
        const bool near = off.cwiseMax(0.0).norm() < 0.015 + 1e-9;
        EXPECT_EQ(std::ranges::binary_search(neck.enlarged, i), near) << p.transpose();
    }
}

// Spread along z 64620, x 54210, y 34050 (sums of squares, mm^2): z major, x middle, y minor.
// Reaching in along x or y nothing is in the way; the face across y is the larger one, 30 x 39.
// Along z stand both plates, 39 x 27 x 10 each.
TEST_F(BoxHourglass, Frame) {
    const ConcavityFrame& frame = stages().frame;
    EXPECT_LT((frame.half_extent_m - Eigen::Vector3d(0.015, 0.0195, 0.0135)).norm(), 1e-9);
    EXPECT_LT(frame.X_OC.translation().norm(), 1e-9);
    Eigen::Matrix3d axes;
    axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    EXPECT_LT((frame.X_OC.linear() - axes).norm(), 1e-6);
    EXPECT_EQ(frame.planes[0].axis, 2);
    EXPECT_NEAR(frame.planes[0].blocked_m3, 0.0, 1e-15);
    EXPECT_NEAR(frame.planes[0].face_area_m2, 0.03 * 0.039, 1e-9);
    EXPECT_EQ(frame.planes[1].axis, 1);
    EXPECT_NEAR(frame.planes[1].blocked_m3, 0.0, 1e-15);
    EXPECT_EQ(frame.planes[2].axis, 0);
    EXPECT_NEAR(frame.planes[2].blocked_m3, 2 * 0.039 * 0.027 * 0.01, 1e-12);
    Eigen::Matrix3d working;
    working << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    EXPECT_LT((frame.planes[0].X_OW.linear() - working).norm(), 1e-6);
}

// In the plane of x and z the cluster is the neck, |x| <= 10, with the plates' edges |x| <= 19.5 at
// z = +-15. Where its outline runs through the plates it lies inside the enlarged one and drops
// out: what stays are the neck's two sides, sampled at +-1.5, 4.5, 7.5, and the plates' edges where
// they part from the plates' samples at both ends.
TEST_F(BoxHourglass, BoundaryIsTheNecksTwoSides) {
    const Points2 neck = neck_part(stages().boundary);
    EXPECT_EQ(neck.size(), 12U);
    for (const Eigen::Vector2d& p : neck) {
        EXPECT_NEAR(std::abs(p.x()), 0.01, 1e-9);
        const double cell = p.y() / kSpacing_m - 0.5;
        EXPECT_NEAR(cell, std::round(cell), 1e-6);
    }
    for (const Eigen::Vector2d& p : stages().boundary) EXPECT_GE(std::abs(p.x()), 0.01 - 1e-9);
    // The cluster's outline did run through the plates.
    EXPECT_GT(std::ranges::count_if(stages().outline,
                                    [](const auto& p) { return std::abs(p.x()) < 0.0099; }),
              8);
}

// Steps of half a finger width, 10, along each side. From a step on one side the circle of radius
// hypot(20, 3) cuts the other side 20 across and 3 along, where the side reaches that far.
TEST_F(BoxHourglass, StepsAndCutsAreTheNecksWidthApart) {
    const Points2& boundary = stages().boundary;
    const double gap_m = 4.0 * kSpacing_m;
    const auto steps = step_points(boundary, 0.01, 0.02, gap_m);
    ASSERT_TRUE(steps.ok());
    std::size_t crossings = 0;
    for (std::size_t k = 0; k < steps.value().size(); ++k) {
        const StepPoint& step = steps.value()[k];
        if (k > 0) {
            const StepPoint& before = steps.value()[k - 1];
            const bool jump = std::ranges::any_of(
                std::views::iota(before.segment, step.segment + 1),
                [&](std::size_t n) { return (boundary[n + 1] - boundary[n]).norm() > gap_m; });
            if (!jump) {
                EXPECT_NEAR((step.point - before.point).norm(), 0.01, 1e-9);
            }
        }
        const bool on_left = step.point.x() < 0.0 && std::abs(step.point.y()) < 0.0045;
        if (!on_left) continue;
        EXPECT_NEAR(step.point.x(), -0.01, 1e-9);
        const auto cuts = all_circle_cuts(boundary, step.point, std::hypot(0.02, 0.003), 0, gap_m);
        for (const CircleCut& cut : cuts) {
            if (cut.point.x() < 0.0 || std::abs(cut.point.y()) > 0.0075) continue;
            ++crossings;
            EXPECT_NEAR(cut.point.x() - step.point.x(), 0.02, 1e-9);
            EXPECT_NEAR(std::abs(cut.point.y() - step.point.y()), 0.003, 1e-9);
        }
    }
    EXPECT_GE(crossings, 1U);
}

// The same with discs of radius 30 on a round neck of radius 10, 30 long. All planes through the
// axis are alike, so the best one is some of them; seen in it the neck is 20 wide. Samples stand at
// most hypot(3, 3) / 2 = 2.12 beside the silhouette: 10 - sqrt(100 - 4.5) = 0.23 inside it.
TEST(RoundHourglass, TheNeckIsFoundInAnyPlaneThroughTheAxis) {
    const Stages s = run(test::hourglass(0.03, 0.01, 0.03, 0.01, 20000));
    EXPECT_NEAR(s.field.largest_m, 0.02, 1e-4);  // hull of a polygon of many sides
    ASSERT_EQ(s.concavities.size(), 1U);
    EXPECT_NEAR(s.concavities[0].depth_m, 0.02, 1e-4);
    EXPECT_GT(std::abs(s.frame.X_OC.linear()(2, 0)), 1.0 - 1e-6);  // major along the axis
    EXPECT_NEAR(s.frame.half_extent_m.x(), 0.015, 1e-6);
    EXPECT_NE(s.frame.planes[0].axis, 0);
    EXPECT_NEAR(s.frame.planes[0].blocked_m3, 0.0, 1e-15);
    EXPECT_EQ(s.frame.planes[2].axis, 0);
    const Points2 neck = neck_part(s.boundary);
    EXPECT_GE(neck.size(), 10U);
    for (const Eigen::Vector2d& p : neck) {
        EXPECT_LE(std::abs(p.x()), 0.01 + 1e-9);
        EXPECT_GE(std::abs(p.x()), 0.01 - 0.00023 - 1e-5);
    }
}

}  // namespace
}  // namespace graspd
