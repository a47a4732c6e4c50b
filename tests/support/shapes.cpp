#include "support/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace graspd::test {
namespace {

using std::numbers::pi;

/// Appends points of an arc about (0, z) in the profile plane, angles from the +r axis.
void add_arc(std::vector<Eigen::Vector2d>& profile, double radius, double z, double from, double to,
             int parts) {
    for (int i = 0; i <= parts; ++i) {
        const double angle = from + (to - from) * i / parts;
        // On the axis exactly: cos(pi/2) is not 0 in floating point.
        const bool pole = std::abs(std::abs(angle) - 0.5 * pi) < 1e-9;
        profile.emplace_back(pole ? 0.0 : radius * std::cos(angle), z + radius * std::sin(angle));
    }
}

/// Parts of an arc whose chords are about as long as triangles of the mesh.
int arc_parts(double radius, double length, double largest_radius, std::size_t faces) {
    const double spacing =
        std::sqrt(4.0 * pi * largest_radius * length / static_cast<double>(faces));
    return std::max(6, static_cast<int>(std::lround(pi * radius / spacing)));
}

/// Grid lines at +- half of each size, sizes rising.
std::vector<double> centred(std::initializer_list<double> sizes) {
    std::vector<double> lines;
    for (const double size : sizes) lines.insert(lines.begin(), -0.5 * size);
    for (const double size : sizes) lines.push_back(0.5 * size);
    return lines;
}

}  // namespace

TriangleMesh box(const Eigen::Vector3d& size_m, std::size_t faces) {
    return grid_solid(
        {centred({size_m.x()}), centred({size_m.y()}), centred({size_m.z()})},
        [](int, int, int) { return true; }, faces);
}

TriangleMesh sphere(double radius_m, std::size_t faces) {
    std::vector<Eigen::Vector2d> profile;
    add_arc(profile, radius_m, 0.0, -0.5 * pi, 0.5 * pi,
            arc_parts(radius_m, pi * radius_m, radius_m, faces));
    return lathe(profile, false, faces);
}

TriangleMesh cylinder(double radius_m, double height_m, std::size_t faces) {
    const double top = 0.5 * height_m;
    return lathe({{0, -top}, {radius_m, -top}, {radius_m, top}, {0, top}}, false, faces);
}

TriangleMesh u_channel(double depth_m, double width_m, double wall_m, double length_m,
                       std::size_t faces) {
    return grid_solid(
        {centred({width_m, width_m + 2.0 * wall_m}), centred({length_m}), {-wall_m, 0.0, depth_m}},
        [](int i, int, int k) { return k == 0 || i != 1; }, faces);
}

TriangleMesh wedge(double bottom_width_m, double top_width_m, double length_m, double height_m,
                   std::size_t faces) {
    const double width = 0.5 * (bottom_width_m + top_width_m);
    TriangleMesh mesh = box({width, length_m, height_m}, faces);
    for (Eigen::Vector3d& vertex : mesh.vertices) {
        const double t = vertex.z() / height_m + 0.5;
        vertex.x() *= (bottom_width_m + t * (top_width_m - bottom_width_m)) / width;
    }
    return mesh;
}

TriangleMesh oblique_prism(const Eigen::Vector3d& size_m, double shift_m, std::size_t faces) {
    TriangleMesh mesh = box(size_m, faces);
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex.x() += shift_m * vertex.z() / size_m.z();
    return mesh;
}

TriangleMesh blind_hole_block(const Eigen::Vector3d& size_m, double hole_width_m,
                              double hole_depth_m, std::size_t faces) {
    return grid_solid(
        {centred({hole_width_m, size_m.x()}),
         centred({hole_width_m, size_m.y()}),
         {-size_m.z(), -hole_depth_m, 0.0}},
        [](int i, int j, int k) { return i != 1 || j != 1 || k == 0; }, faces);
}

TriangleMesh cup(double radius_m, double height_m, double thickness_m, std::size_t faces) {
    const double inner = radius_m - thickness_m;
    return lathe({{0, 0},
                  {radius_m, 0},
                  {radius_m, height_m},
                  {inner, height_m},
                  {inner, thickness_m},
                  {0, thickness_m}},
                 false, faces);
}

TriangleMesh bowl(double radius_m, double thickness_m, std::size_t faces) {
    const double inner = radius_m - thickness_m;
    const double length = 0.5 * pi * (radius_m + inner) + thickness_m;
    const int parts = (arc_parts(radius_m, length, radius_m, faces) + 1) / 2;
    std::vector<Eigen::Vector2d> profile;
    add_arc(profile, radius_m, 0.0, -0.5 * pi, 0.0, parts);
    add_arc(profile, inner, 0.0, 0.0, -0.5 * pi, parts);
    return lathe(profile, false, faces);
}

TriangleMesh torus(double ring_m, double tube_m, std::size_t faces) {
    const int parts =
        2 * arc_parts(tube_m, 2.0 * pi * tube_m, ring_m + tube_m, faces);  // even: pole rings
    std::vector<Eigen::Vector2d> profile;
    for (int i = 0; i < parts; ++i) {
        const double phi = 2.0 * pi * i / parts;
        profile.emplace_back(ring_m + tube_m * std::cos(phi), tube_m * std::sin(phi));
    }
    return lathe(profile, true, faces);
}

TriangleMesh dumbbell(double ball_radius_m, double bar_radius_m, double distance_m,
                      std::size_t faces) {
    const double meet = std::asin(bar_radius_m / ball_radius_m);  // half angle under the bar
    const double length = 2.0 * pi * ball_radius_m + distance_m - 2.0 * ball_radius_m;
    const int parts = arc_parts(ball_radius_m, length, ball_radius_m, faces);
    std::vector<Eigen::Vector2d> profile;
    add_arc(profile, ball_radius_m, -0.5 * distance_m, -0.5 * pi, 0.5 * pi - meet, parts);
    add_arc(profile, ball_radius_m, 0.5 * distance_m, meet - 0.5 * pi, 0.5 * pi, parts);
    return lathe(profile, false, faces);
}

TriangleMesh l_shape(double leg_x_m, double leg_z_m, double wall_m, double length_m,
                     std::size_t faces) {
    return grid_solid(
        {std::vector<double>{0.0, wall_m, leg_x_m}, centred({length_m}),
         std::vector<double>{0.0, wall_m, leg_z_m}},
        [](int i, int, int k) { return i == 0 || k == 0; }, faces);
}

TriangleMesh hourglass(double disc_radius_m, double neck_radius_m, double neck_length_m,
                       double disc_thickness_m, std::size_t faces) {
    const double neck = 0.5 * neck_length_m;
    const double end = neck + disc_thickness_m;
    return lathe({{0, -end},
                  {disc_radius_m, -end},
                  {disc_radius_m, -neck},
                  {neck_radius_m, -neck},
                  {neck_radius_m, neck},
                  {disc_radius_m, neck},
                  {disc_radius_m, end},
                  {0, end}},
                 false, faces);
}

TriangleMesh box_hourglass(const Eigen::Vector3d& plate_m, double neck_width_m,
                           double neck_length_m, std::size_t faces) {
    return grid_solid(
        {centred({neck_width_m, plate_m.x()}), centred({neck_width_m, plate_m.y()}),
         centred({neck_length_m, neck_length_m + 2.0 * plate_m.z()})},
        [](int i, int j, int k) { return k != 1 || (i == 1 && j == 1); }, faces);
}

TriangleMesh plate_with_hole(const Eigen::Vector3d& size_m, double hole_width_m,
                             std::size_t faces) {
    return grid_solid(
        {centred({hole_width_m, size_m.x()}), centred({hole_width_m, size_m.y()}),
         centred({size_m.z()})},
        [](int i, int j, int) { return i != 1 || j != 1; }, faces);
}

TriangleMesh ring(double inner_radius_m, double outer_radius_m, double height_m,
                  std::size_t faces) {
    const double top = 0.5 * height_m;
    return lathe({{inner_radius_m, -top},
                  {outer_radius_m, -top},
                  {outer_radius_m, top},
                  {inner_radius_m, top}},
                 true, faces);
}

}  // namespace graspd::test
