// What must not change a plan: where the object lies, the order of its vertices and faces, the unit
// of length, how finely a flat-sided shape is meshed, and what runs beside it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "graspd/grasp/rank_grasps.hpp"
#include "graspd/planner/planner.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Matrix3d;
using test::request_for;

constexpr double kDegree = std::numbers::pi / 180.0;

struct Shape {
    std::string name;
    TriangleMesh mesh;
};
/// Shapes that some turn or mirror carries into themselves: several grasps are equally good.
std::vector<Shape> symmetric_shapes() {
    return {{"box_hourglass", test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000)},
            {"l_shape", test::l_shape(0.06, 0.04, 0.008, 0.05, 1000)},
            {"box", test::box({0.06, 0.04, 0.08}, 300)}};
}

/// Whether two grasps are the same but for rounding: 0.5 mm and 0.5 degrees.
bool same_pose(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double within_m = 0.0005,
               double within_rad = 0.5 * kDegree) {
    return (a.translation() - b.translation()).norm() <= within_m &&
           grasp_angle_rad(a.linear(), b.linear()) <= within_rad;
}

/// Same verdict and a best grasp that is just as good.
void expect_as_good(const PlanReply& a, const PlanReply& b) {
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.strategy, b.strategy);
    ASSERT_FALSE(a.grasps.empty());
    ASSERT_FALSE(b.grasps.empty());
    EXPECT_NEAR(a.grasps[0].score, b.grasps[0].score, 1e-6);
    EXPECT_NEAR(a.grasps[0].width_m, b.grasps[0].width_m, 1e-6);
}

/// Besides, the best grasp of `b` is that of `a` moved by X.
void expect_moved(const PlanReply& a, const PlanReply& b, const Eigen::Isometry3d& X) {
    expect_as_good(a, b);
    if (a.grasps.empty() || b.grasps.empty()) return;
    EXPECT_TRUE(same_pose(X * a.grasps[0].X_FG, b.grasps[0].X_FG))
        << "off by " << (X * a.grasps[0].X_FG.translation() - b.grasps[0].X_FG.translation()).norm()
        << " m and "
        << grasp_angle_rad(X.linear() * a.grasps[0].X_FG.linear(), b.grasps[0].X_FG.linear())
        << " rad";
}

TEST(PlanInvariance, TheGraspMovesWithALopsidedObject) {
    const TriangleMesh mesh = test::lopsided(1000);
    const PlanReply home = plan(request_for(mesh), {});
    ASSERT_EQ(home.status, PlanStatus::kOk) << home.message;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(seed);
        const Eigen::Isometry3d X = test::random_pose(seed);
        expect_moved(home, plan(request_for(test::moved(mesh, X)), {}), X);
        // By the object's pose instead of its vertices.
        PlanRequest posed = request_for(mesh);
        posed.X_FO = X;
        expect_moved(home, plan(posed, {}), X);
        // Half and half.
        PlanRequest both = request_for(test::moved(mesh, test::random_pose(seed + 100)));
        both.X_FO = X * test::random_pose(seed + 100).inverse();
        expect_moved(home, plan(both, {}), X);
    }
}

TEST(PlanInvariance, SymmetricObjectsKeepTheirScoreWhereverTheyLie) {
    for (const auto& [name, mesh] : symmetric_shapes()) {
        const PlanReply home = plan(request_for(mesh), {});
        ASSERT_EQ(home.status, PlanStatus::kOk) << name << home.message;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            const Eigen::Isometry3d X = test::random_pose(seed);
            expect_as_good(home, plan(request_for(test::moved(mesh, X)), {}));
        }
    }
}

TEST(PlanInvariance, TheOrderOfVerticesAndFacesDoesNotMatter) {
    std::vector<Shape> shapes = symmetric_shapes();
    shapes.push_back({"lopsided", test::lopsided(1000)});
    for (const auto& [name, mesh] : shapes) {
        const PlanReply home = plan(request_for(mesh), {});
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            const PlanReply other = plan(request_for(test::shuffled(mesh, seed)), {});
            expect_as_good(home, other);
            if (name == "lopsided") {
                expect_moved(home, other, Eigen::Isometry3d::Identity());
            }
        }
    }
}

/// Gripper and settings in another unit of length.
PlanRequest scaled(PlanRequest request, double s) {
    request.object_O = test::scaled(std::get<TriangleMesh>(request.object_O), s);
    for (Gripper& g : request.grippers) {
        for (double* length : {&g.min_width_m, &g.max_width_m, &g.finger_length_m,
                               &g.finger_width_m, &g.finger_thickness_m, &g.tip_offset_m,
                               &g.palm_width_m, &g.palm_height_m, &g.palm_depth_m, &g.palm_z_m}) {
            *length *= s;
        }
    }
    return request;
}
PlannerConfig scaled(PlannerConfig config, double s) {
    config.grasp_sides.max_depth_m *= s;
    config.force_balance.max_rms_m *= s;
    config.local_cloud.max_depth_m *= s;
    config.manipulability.approach_distance_m *= s;
    config.manipulability.preshape_margin_m *= s;
    config.manipulability.closing_tolerance_m *= s;
    config.manipulability.release_m *= s;
    config.contact_patch.compression_m *= s;
    config.load_ratios.torsion_length_m *= s;
    config.score_grasp.clearance_scale_m *= s;
    config.search.refine_shift_m *= s;
    config.search.insertion_least_tip_m *= s;
    config.search.tolerance_shift_m *= s;
    config.search.lever_weight_rad_m /= s;
    config.search.most_clearance_m *= s;
    return config;
}

// All lengths times a factor, angles and masses as they are: the same grasps, scaled.
TEST(PlanInvariance, TheUnitOfLengthDoesNotMatter) {
    for (const TriangleMesh& mesh :
         {test::lopsided(1000), test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000)}) {
        PlanRequest request = request_for(mesh);
        request.options.mass_kg = 0.1;
        const PlanReply home = plan(request, {});
        ASSERT_EQ(home.status, PlanStatus::kOk) << home.message;
        for (const double s : {0.5, 2.0, 4.0}) {
            SCOPED_TRACE(s);
            const PlanReply other = plan(scaled(request, s), scaled(PlannerConfig{}, s));
            ASSERT_EQ(other.status, home.status) << other.message;
            ASSERT_EQ(other.grasps.size(), home.grasps.size());
            EXPECT_EQ(other.strategy, home.strategy);
            for (std::size_t i = 0; i < home.grasps.size(); ++i) {
                const Grasp& a = home.grasps[i];
                const Grasp& b = other.grasps[i];
                EXPECT_NEAR(a.score, b.score, 1e-6) << i;
                EXPECT_NEAR(s * a.width_m, b.width_m, 1e-6 * s) << i;
                EXPECT_NEAR(s * a.clearance_m, b.clearance_m, 1e-6 * s) << i;
                Eigen::Isometry3d expected = a.X_FG;
                expected.translation() *= s;
                EXPECT_TRUE(same_pose(expected, b.X_FG, 1e-5 * s, 1e-4)) << i;
            }
        }
    }
}

/// Whether some mirroring of the axes in `mirrors` carries one grasp near the other. A mirror turns
/// a right-handed frame into a left-handed one; with its y axis reversed, the same for two equal
/// pads, it is right-handed again.
bool same_up_to(const std::vector<Matrix3d>& symmetries, const Grasp& a, const Grasp& b) {
    return std::ranges::any_of(symmetries, [&](const Matrix3d& symmetry) {
        Eigen::Isometry3d image = Eigen::Isometry3d::Identity();
        image.translation() = symmetry * a.X_FG.translation();
        image.linear() = symmetry * a.X_FG.linear();
        if (symmetry.determinant() < 0.0) image.linear().col(1) *= -1.0;
        return same_pose(image, b.X_FG, 0.002, 3.0 * kDegree);
    });
}
std::vector<Matrix3d> mirrors(bool x, bool y, bool z) {
    std::vector<Matrix3d> all;
    for (unsigned k = 0; k < 8; ++k) {
        if (((k & 1u) != 0 && !x) || ((k & 2u) != 0 && !y) || ((k & 4u) != 0 && !z)) continue;
        all.emplace_back(Eigen::Vector3d((k & 1u) != 0 ? -1.0 : 1.0, (k & 2u) != 0 ? -1.0 : 1.0,
                                         (k & 4u) != 0 ? -1.0 : 1.0)
                             .asDiagonal());
    }
    return all;
}

// 200, 2,000 and 20,000 faces of one flat-sided shape: the best grasp stays within 2 mm and 3
// degrees, up to the shape's own symmetry.
TEST(PlanInvariance, HowFinelyTheShapeIsMeshedDoesNotMatter) {
    struct Row {
        const char* name;
        std::vector<Matrix3d> symmetries;
        TriangleMesh (*mesh)(std::size_t faces);
        // Whether few faces can carry the concavity: in the channel it has creases across them, so
        // other boundaries are found, and with them other grasps that are as good.
        bool linear = true;
    };
    const Row rows[] = {
        {"box_hourglass", mirrors(true, true, true),
         [](std::size_t f) {
             return test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, f);
         }},
        {"l_shape", mirrors(false, true, false),
         [](std::size_t f) { return test::l_shape(0.06, 0.04, 0.008, 0.05, f); }},
        {"u_channel", mirrors(true, true, false),
         [](std::size_t f) { return test::u_channel(0.03, 0.03, 0.008, 0.07, f); }, false},
        {"lopsided", mirrors(false, false, false), test::lopsided},
        {"box", mirrors(true, true, true),
         [](std::size_t f) {
             return test::box({0.04, 0.06, 0.09}, f);
         }},
        {"wedge", mirrors(true, true, false),
         [](std::size_t f) { return test::wedge(0.03, 0.05, 0.06, 0.09, f); }},
        {"oblique_prism",
         {Matrix3d::Identity(), -Matrix3d::Identity(),
          Eigen::DiagonalMatrix<double, 3>(1, -1, 1).toDenseMatrix(),
          Eigen::DiagonalMatrix<double, 3>(-1, 1, -1).toDenseMatrix()},
         [](std::size_t f) {
             return test::oblique_prism({0.04, 0.06, 0.09}, 0.02, f);
         }},
        {"plate_with_hole", mirrors(true, true, true),
         [](std::size_t f) {
             return test::plate_with_hole({0.14, 0.10, 0.02}, 0.04, f);
         }},
        {"blind_hole_block", mirrors(true, true, false), [](std::size_t f) {
             return test::blind_hole_block({0.07, 0.05, 0.06}, 0.03, 0.04, f);
         }}};
    for (const Row& row : rows) {
        const PlanReply coarse = plan(request_for(row.mesh(200)), {});
        ASSERT_EQ(coarse.status, PlanStatus::kOk) << row.name << ": " << coarse.message;
        for (const std::size_t faces : {2000, 20000}) {
            const PlanReply fine = plan(request_for(row.mesh(faces)), {});
            ASSERT_EQ(fine.status, PlanStatus::kOk) << row.name << ": " << fine.message;
            const Grasp& a = coarse.grasps[0];
            const Grasp& b = fine.grasps[0];
            EXPECT_NEAR(a.score, b.score, 1e-3) << row.name << " " << faces;
            if (!row.linear) continue;
            EXPECT_TRUE(same_up_to(row.symmetries, a, b))
                << row.name << " " << faces << ": " << to_string(a.source) << " " << a.score << " "
                << a.width_m << " at " << a.X_FG.translation().transpose() << " x "
                << a.X_FG.linear().col(0).transpose() << " z " << a.X_FG.linear().col(2).transpose()
                << "; " << to_string(b.source) << " " << b.score << " " << b.width_m << " at "
                << b.X_FG.translation().transpose() << " x " << b.X_FG.linear().col(0).transpose()
                << " z " << b.X_FG.linear().col(2).transpose();
        }
    }
}

TEST(PlanInvariance, WhatRunsBesideDoesNotMatter) {
    std::vector<PlanRequest> requests;
    for (const auto& [name, mesh] : symmetric_shapes()) requests.push_back(request_for(mesh));
    std::vector<PlanReply> alone;
    for (const PlanRequest& request : requests) alone.push_back(plan(request, {}));
    constexpr std::size_t kThreads = 6;
    std::vector<PlanReply> beside(kThreads * requests.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < kThreads; ++t) {
            threads.emplace_back([&, t] {
                for (std::size_t i = 0; i < requests.size(); ++i) {
                    const std::size_t which = (i + t) % requests.size();
                    beside[t * requests.size() + which] = plan(requests[which], {});
                }
            });
        }
    }
    for (std::size_t k = 0; k < beside.size(); ++k) {
        SCOPED_TRACE(k);
        test::expect_identical(beside[k], alone[k % requests.size()]);
    }
}

}  // namespace
}  // namespace graspd
