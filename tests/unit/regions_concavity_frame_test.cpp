#include "graspd/regions/concavity_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <pcl/features/moment_of_inertia_estimation.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Points3 = std::vector<Eigen::Vector3d>;

constexpr double kFinger_m = 0.045;

/// A tree far away from everything.
TriangleBvh nothing() {
    return TriangleBvh(test::moved(test::box({0.01, 0.01, 0.01}),
                                   Eigen::Isometry3d(Eigen::Translation3d(10.0, 10.0, 10.0))),
                       1e-9);
}

/// Points of a grid that fills [low, high], n along each side.
Points3 lattice(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int n = 5) {
    Points3 points;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < n; ++k) {
                const Eigen::Vector3d t = Eigen::Vector3d(i, j, k) / (n - 1);
                points.push_back(low + t.cwiseProduct(high - low));
            }
        }
    }
    return points;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// Same bytes, zeros' signs aside.
bool same(const ConcavityFrame& a, const ConcavityFrame& b) {
    bool equal = a.X_OC.matrix() == b.X_OC.matrix() && a.half_extent_m == b.half_extent_m;
    for (std::size_t k = 0; k < 3; ++k) {
        equal = equal && a.planes[k].axis == b.planes[k].axis &&
                a.planes[k].blocked_m3 == b.planes[k].blocked_m3 &&
                a.planes[k].X_OW.matrix() == b.planes[k].X_OW.matrix();
    }
    return equal;
}

// A grid that fills a turned box has, by symmetry, the box's axes and extents. No third moment
// tells their signs, so the largest component of the major and the middle one is positive.
TEST(ConcavityFrame, ATurnedBoxIsFound) {
    const TriangleBvh object = nothing();
    const Eigen::Vector3d half(0.05, 0.03, 0.01);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Isometry3d X_OB = test::random_pose(seed);
        Points3 points;
        for (const Eigen::Vector3d& p : lattice(-half, half)) points.push_back(X_OB * p);
        const auto frame = concavity_frame(points, object, kFinger_m, {});
        ASSERT_TRUE(frame.ok());
        const Eigen::Matrix3d axes = frame.value().X_OC.linear();
        for (int k = 0; k < 3; ++k) {
            EXPECT_LT(angle_between(axes.col(k), X_OB.linear().col(k)), 1e-6);
            EXPECT_NEAR(frame.value().half_extent_m[k], half[k], 1e-9);
        }
        EXPECT_LT((frame.value().X_OC.translation() - X_OB.translation()).norm(), 1e-9);
        EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
        for (const int k : {0, 1}) {
            int largest = 0;
            axes.col(k).cwiseAbs().maxCoeff(&largest);
            EXPECT_GT(axes(largest, k), 0.0);
        }
    }
}

// A lop-sided set: the long tail of each axis points along it, wherever the set is turned.
TEST(ConcavityFrame, TheThirdMomentTellsTheSigns) {
    const TriangleBvh object = nothing();
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Isometry3d X_OB = test::random_pose(seed);
        Points3 points_B = lattice({-0.04, -0.02, -0.005}, {0.04, 0.02, 0.005});
        // A tail along +x and a shorter one along +y: third moments 0.08^3 and 0.04^3 each.
        for (const double z : {-0.005, 0.005}) {
            points_B.emplace_back(0.08, 0.0, z);
            points_B.emplace_back(0.0, 0.04, z);
        }
        Points3 points;
        for (const Eigen::Vector3d& p : points_B) points.push_back(X_OB * p);
        const auto frame = concavity_frame(points, object, kFinger_m, {});
        ASSERT_TRUE(frame.ok());
        // The tails tilt the axes a little; their directions stay.
        EXPECT_GT(frame.value().X_OC.linear().col(0).dot(X_OB.linear().col(0)), 0.99);
        EXPECT_GT(frame.value().X_OC.linear().col(1).dot(X_OB.linear().col(1)), 0.99);
        EXPECT_GT(frame.value().X_OC.linear().col(2).dot(X_OB.linear().col(2)), 0.99);
    }
}

// The origin is the box's centre, not the points' mean: one far point moves the mean a little and
// the box a lot. Points over [-4, 4] x [-2, 2] x [-1, 1] cm with one more at x = 12 cm.
TEST(ConcavityFrame, TheOriginIsTheCentreOfTheBox) {
    auto points = lattice({-0.04, -0.02, -0.01}, {0.04, 0.02, 0.01});
    points.emplace_back(0.12, 0.0, 0.0);
    const auto frame = concavity_frame(points, nothing(), kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    EXPECT_LT((frame.value().X_OC.translation() - Eigen::Vector3d(0.04, 0, 0)).norm(), 1e-9);
    EXPECT_LT((frame.value().half_extent_m - Eigen::Vector3d(0.08, 0.02, 0.01)).norm(), 1e-9);
}

// PCL's moment of inertia, in float, gives the same box but for the signs.
TEST(ConcavityFrame, AgreesWithPcl) {
    const TriangleBvh object = nothing();
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        std::mt19937 engine(seed);
        std::normal_distribution<double> draw(0.0, 0.01);
        const Eigen::Matrix3d turn = test::random_pose(seed).linear();
        Points3 points;
        auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
        for (int i = 0; i < 500; ++i) {
            points.push_back(turn *
                             Eigen::Vector3d(4.0 * draw(engine), 2.0 * draw(engine), draw(engine)));
            const Eigen::Vector3f p = points.back().cast<float>();
            cloud->emplace_back(p.x(), p.y(), p.z());
        }
        pcl::MomentOfInertiaEstimation<pcl::PointXYZ> estimation;
        estimation.setInputCloud(cloud);
        estimation.setAngleStep(1000.0F);  // eccentricities are not wanted
        estimation.compute();
        pcl::PointXYZ low, high, position;
        Eigen::Matrix3f rotation;
        Eigen::Vector3f major, middle, minor;
        ASSERT_TRUE(estimation.getOBB(low, high, position, rotation));
        ASSERT_TRUE(estimation.getEigenVectors(major, middle, minor));

        const auto frame = concavity_frame(points, object, kFinger_m, {});
        ASSERT_TRUE(frame.ok());
        const Eigen::Matrix3d axes = frame.value().X_OC.linear();
        EXPECT_LT(angle_between(axes.col(0), major.cast<double>()), 1e-3);
        EXPECT_LT(angle_between(axes.col(1), middle.cast<double>()), 1e-3);
        EXPECT_LT(angle_between(axes.col(2), minor.cast<double>()), 1e-3);
        const Eigen::Vector3f half = 0.5F * (high.getVector3fMap() - low.getVector3fMap());
        EXPECT_LT((frame.value().half_extent_m - half.cast<double>()).norm(), 1e-4);
        EXPECT_LT(
            (frame.value().X_OC.translation() - position.getVector3fMap().cast<double>()).norm(),
            1e-4);
    }
}

TEST(ConcavityFrame, TheOrderOfPointsDoesNotMatter) {
    const TriangleBvh object(test::u_channel(0.031, 0.025, 0.008, 0.072), 1e-7);
    std::mt19937 engine(5);
    std::normal_distribution<double> draw(0.0, 0.01);
    Points3 points;
    for (int i = 0; i < 200; ++i) points.emplace_back(draw(engine), 2 * draw(engine), draw(engine));
    const auto first = concavity_frame(points, object, kFinger_m, {});
    ASSERT_TRUE(first.ok());
    for (int round = 0; round < 10; ++round) {
        std::ranges::shuffle(points, engine);
        const auto frame = concavity_frame(points, object, kFinger_m, {});
        ASSERT_TRUE(frame.ok());
        EXPECT_TRUE(same(frame.value(), first.value()));
    }
}

/// A channel 31 deep, 25 wide, 72 long with walls of 8 (mm), and the grid over the lower part of
/// its gap, 40 long and 15 high: major axis y, middle x, minor z.
struct Channel {
    TriangleBvh object{test::u_channel(0.031, 0.025, 0.008, 0.072), 1e-7};
    Points3 points = lattice({-0.0125, -0.02, 0.0}, {0.0125, 0.02, 0.015});
};

// Along y the gap is open: nothing in the way. Along z the floor lies below, 40 x 25 x 8 mm, and
// nothing above. Along x both walls, 40 x 15 x 8 mm each.
TEST(ConcavityFrame, ThePlanesOfAChannelByHand) {
    const Channel channel;
    const auto frame = concavity_frame(channel.points, channel.object, kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    const auto& planes = frame.value().planes;
    EXPECT_EQ(planes[0].axis, 0);
    EXPECT_NEAR(planes[0].blocked_m3, 0.0, 1e-12);
    EXPECT_NEAR(planes[0].face_area_m2, 0.025 * 0.015, 1e-12);
    EXPECT_EQ(planes[1].axis, 2);
    EXPECT_NEAR(planes[1].blocked_m3, 0.040 * 0.025 * 0.008, 1e-12);
    EXPECT_NEAR(planes[1].face_area_m2, 0.040 * 0.025, 1e-12);
    EXPECT_EQ(planes[2].axis, 1);
    EXPECT_NEAR(planes[2].blocked_m3, 2 * 0.040 * 0.015 * 0.008, 1e-12);
    EXPECT_NEAR(planes[2].face_area_m2, 0.040 * 0.015, 1e-12);
}

// A finger shorter than the walls meets as much of them as it is long.
TEST(ConcavityFrame, TheFingerEndsInsideTheWall) {
    const Channel channel;
    const auto frame = concavity_frame(channel.points, channel.object, 0.005, {});
    ASSERT_TRUE(frame.ok());
    const auto& planes = frame.value().planes;
    EXPECT_NEAR(planes[1].blocked_m3, 0.040 * 0.025 * 0.005, 1e-12);
    EXPECT_NEAR(planes[2].blocked_m3, 2 * 0.040 * 0.015 * 0.005, 1e-12);
}

// Faces at x = +-15 mm start 2.5 mm inside the walls: 5.5 mm of them are left, and the whole
// finger's length where it is shorter than that.
TEST(ConcavityFrame, ALineThatStartsInsideCountsFromItsStart) {
    const Channel channel;
    const auto points = lattice({-0.015, -0.02, 0.001}, {0.015, 0.02, 0.015});
    for (const double finger_m : {kFinger_m, 0.003}) {
        const auto frame = concavity_frame(points, channel.object, finger_m, {});
        ASSERT_TRUE(frame.ok());
        const auto& planes = frame.value().planes;
        const auto across = std::ranges::find(planes, 1, &PlanePair::axis);
        ASSERT_NE(across, planes.end());
        EXPECT_NEAR(across->blocked_m3, 2 * 0.040 * 0.014 * std::min(finger_m, 0.0055), 1e-12);
    }
}

// Parts that overlap count once: bars over z = 10..20 and 15..30 mm above a patch are 20 mm of
// object, from whichever of the two a line enters first.
TEST(ConcavityFrame, OverlappingPartsCountOnce) {
    const auto at = [](double low, double high) {
        return test::moved(test::box({0.2, 0.2, high - low}),
                           Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.5 * (low + high))));
    };
    const TriangleBvh object(test::joined(at(0.010, 0.020), at(0.015, 0.030)), 1e-9);
    const auto points = lattice({-0.03, -0.02, -0.001}, {0.03, 0.02, 0.001});
    const auto frame = concavity_frame(points, object, kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    EXPECT_NEAR(frame.value().planes[2].blocked_m3, 0.06 * 0.04 * 0.020, 1e-12);
    EXPECT_EQ(frame.value().planes[2].axis, 2);
    // From z = 18 mm both parts surround the start: 12 mm are left upwards, 8 mm downwards.
    const auto inside = concavity_frame(lattice({-0.03, -0.02, 0.0179}, {0.03, 0.02, 0.0181}),
                                        object, kFinger_m, {});
    ASSERT_TRUE(inside.ok());
    const auto& planes = inside.value().planes;
    const auto upright = std::ranges::find(planes, 2, &PlanePair::axis);
    ASSERT_NE(upright, planes.end());
    EXPECT_NEAR(upright->blocked_m3, 0.06 * 0.04 * (0.0119 + 0.0079), 1e-12);
}

// With nothing in the way the larger face comes first.
TEST(ConcavityFrame, TiesGoToTheLargerFace) {
    const auto frame = concavity_frame(lattice({-0.04, -0.02, -0.01}, {0.04, 0.02, 0.01}),
                                       nothing(), kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame.value().planes[0].axis, 2);
    EXPECT_EQ(frame.value().planes[1].axis, 1);
    EXPECT_EQ(frame.value().planes[2].axis, 0);
}

// A cube by its extents, whose faces tie, with more points along x than y than z.
TEST(ConcavityFrame, TiesOfEqualFacesGoToTheHigherAxis) {
    Points3 points;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 4 - axis; ++i) {
            points.push_back(0.02 * Eigen::Vector3d::Unit(axis));
            points.push_back(-0.02 * Eigen::Vector3d::Unit(axis));
        }
    }
    const auto frame = concavity_frame(points, nothing(), kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    EXPECT_LT((frame.value().X_OC.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_EQ(frame.value().planes[0].axis, 2);
    EXPECT_EQ(frame.value().planes[1].axis, 1);
    EXPECT_EQ(frame.value().planes[2].axis, 0);
}

// W is right-handed, sits in the box's centre, looks along the pair's normal, and its first axis is
// the longer side of the face.
TEST(ConcavityFrame, TheWorkingFrames) {
    const Channel channel;
    const auto frame = concavity_frame(channel.points, channel.object, kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    const Eigen::Matrix3d axes = frame.value().X_OC.linear();
    const int longer[3] = {1, 0, 0};  // beside major: middle; beside middle and minor: major
    for (const PlanePair& plane : frame.value().planes) {
        const Eigen::Matrix3d R = plane.X_OW.linear();
        EXPECT_EQ(R.col(2), axes.col(plane.axis));
        EXPECT_EQ(R.col(0), axes.col(longer[plane.axis]));
        EXPECT_LT((R.col(1) - R.col(2).cross(R.col(0))).norm(), 1e-15);
        EXPECT_LT((plane.X_OW.translation() - Eigen::Vector3d(0, 0, 0.0075)).norm(), 1e-12);
    }
}

// Spread and extent are different things: of points that are 6 cm long with little weight at their
// ends and 4 cm wide with all of it, the middle axis of C is the first of W.
TEST(ConcavityFrame, TheFirstWorkingAxisGoesByExtent) {
    Points3 points = {{-0.03, 0, 0}, {0.03, 0, 0}};
    for (int i = 0; i < 10; ++i) {
        for (const double y : {-0.02, 0.02}) points.emplace_back(0.0, y, i % 2 ? 0.001 : -0.001);
    }
    const auto frame = concavity_frame(points, nothing(), kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    EXPECT_NEAR(frame.value().half_extent_m.x(), 0.02, 1e-12);
    EXPECT_NEAR(frame.value().half_extent_m.y(), 0.03, 1e-12);
    const auto& plane = frame.value().planes[0];
    EXPECT_EQ(plane.axis, 2);
    EXPECT_LT(angle_between(plane.X_OW.linear().col(0), Eigen::Vector3d::UnitX()), 1e-9);
}

// The floor of the channel alone is flat: its other two faces have no area, so nothing is in their
// way, yet seen along them the floor is a line. They come last.
TEST(ConcavityFrame, AFlatConcavityIsSeenFromAbove) {
    const Channel channel;
    const auto frame = concavity_frame(lattice({-0.0125, -0.02, 0.0}, {0.0125, 0.02, 0.0}),
                                       channel.object, kFinger_m, {});
    ASSERT_TRUE(frame.ok());
    const PlanePair& best = frame.value().planes[0];
    EXPECT_EQ(best.axis, 2);
    EXPECT_NEAR(best.blocked_m3, 0.040 * 0.025 * 0.008, 1e-12);
    EXPECT_NEAR(frame.value().half_extent_m.z(), 0.0, 1e-12);
}

TEST(ConcavityFrame, EveryErrorNamesItsCause) {
    const TriangleBvh object = nothing();
    const auto good = lattice({-0.04, -0.02, -0.01}, {0.04, 0.02, 0.01});
    const auto fails = [&](const Points3& points, double finger_m,
                           const ConcavityFrameConfig& config, PlanErrorCode code,
                           const char* named) {
        const auto frame = concavity_frame(points, object, finger_m, config);
        ASSERT_FALSE(frame.ok()) << named;
        EXPECT_EQ(frame.error().code, code) << named;
        EXPECT_NE(frame.error().detail.find(named), std::string::npos) << frame.error().detail;
    };
    const auto invalid = PlanErrorCode::kInvalidInput;
    const auto degenerate = PlanErrorCode::kDegenerate;
    fails(good, -1.0, {}, invalid, "finger_length_m = -1");
    fails(good, NAN, {}, invalid, "finger_length_m = nan");
    fails(good, kFinger_m, {.lines_per_side = 0}, invalid, "concavity_frame.lines_per_side = 0");
    auto bad = good;
    bad[6].y() = std::numeric_limits<double>::infinity();
    fails(bad, kFinger_m, {}, invalid, "points_O[6]");
    fails({good[0], good[1], good[9]}, kFinger_m, {}, degenerate, "3 points");
    fails({}, kFinger_m, {}, degenerate, "0 points");
    fails(Points3(5, good[0]), kFinger_m, {}, degenerate, "line");
    Points3 line;
    for (int i = 0; i < 9; ++i) line.push_back(i * Eigen::Vector3d(0.01, 0.02, -0.03));
    fails(line, kFinger_m, {}, degenerate, "line");
}

}  // namespace
}  // namespace graspd
