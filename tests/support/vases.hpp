#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

/// Shortest ways up and out of a cavity of revolution, in its meridian plane: the cavity is u <=
/// r(z) for the radius u and a wall r(z) of straight pieces. A visibility graph over the wall's
/// corners; heights rise along a shortest way, since every obstacle is a graph over z, so the graph
/// is solved from the top down.
class MeridianWays {
public:
    /// @param wall  (radius, z) [m] of the wall's corners, z strictly rising; the hull's plane is
    /// at
    ///              the last one's height
    explicit MeridianWays(std::vector<Eigen::Vector2d> wall);

    /// Length of the shortest way from a point (radius, z) of the cavity or its wall [m].
    double value_m(const Eigen::Vector2d& point) const;

private:
    bool is_free(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;
    double value_by_m(const Eigen::Vector2d& point, std::size_t first_corner) const;

    std::vector<Eigen::Vector2d> wall_;
    std::vector<double> value_m_;  ///< [m] of each corner
};

/// A vase about z, 121 mm high: foot, belly, waist and a thick rounded lip that reaches 6 mm into
/// the mouth, so that ways out of the belly wind round the lip's arc. (radius, z) [m]; `outer` from
/// the axis below to the top of the lip, `inner` from there down to the axis.
struct VaseProfile {
    std::vector<Eigen::Vector2d> outer, inner;

    /// @param parts  straight pieces that stand for a quarter of the lip's arc
    explicit VaseProfile(int parts);
    std::vector<Eigen::Vector2d> outline() const;
    /// Corners of the cavity's wall from the floor's rim up, radii times a factor.
    std::vector<Eigen::Vector2d> wall(double factor) const;
};

/// The vase as a lathe's mesh, rings aligned. Closed, outward oriented.
TriangleMesh vase(std::size_t faces);

/// The same with every ring turned by a random angle. Closed, outward oriented.
TriangleMesh twisted_vase(std::size_t faces, std::uint64_t seed);

/// Concavity of the vases' vertices.
///
/// Cavity, rings aligned: exact. The part of the cavity at height z lies in u <= r(z) for the
/// distance u along the direction of the vertex, the corner of its ring, since all rings have their
/// corners at the same angles; projection onto the meridian plane lengthens no way, and the ways in
/// that plane are free. Outside: the hull's sides are planes between two rings' sides; the distance
/// to them is that in the plane through the sides' middles, where all radii are smaller by the
/// cosine of half a side's angle. The profile is a graph over each of the hull's lines, so the
/// perpendicular is free.
///
/// Rings turned: a bracket. With n sides, every triangle's corners lie within an angle of 3 pi / n
/// about the axis, so the surface lies between the profile's surface of revolution and that with
/// radii smaller by c = cos(3 pi / (2 n)). The cavity is thus a part of the full cavity of
/// revolution, whose ways are as short or shorter; and it holds the smaller one, which a vertex
/// reaches by (1 - c) of its radius straight inwards. Outside: the hull is a part of the profile's
/// hull of revolution and holds that with radii smaller by c; the way straight to the former is
/// free.
class VaseAnswer {
public:
    /// @param parts  of a quarter of the lip, as in the profile; @param sides  of every ring
    VaseAnswer(int parts, int sides, bool twisted);
    double lowest_m(const Eigen::Vector3d& vertex) const;
    double highest_m(const Eigen::Vector3d& vertex) const;

private:
    bool is_outside(const Eigen::Vector2d& point) const;
    double outside_m(Eigen::Vector2d point, double point_factor, double hull_factor) const;

    VaseProfile profile_;
    double factor_ = 1.0;       ///< c above
    double side_factor_ = 1.0;  ///< of the middle of a ring's side, rings aligned
    bool twisted_ = false;
    MeridianWays full_, small_;
};

VaseAnswer vase_answer(std::size_t faces);
VaseAnswer twisted_vase_answer(std::size_t faces);

}  // namespace graspd::test
