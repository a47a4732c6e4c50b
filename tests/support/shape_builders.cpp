#include "support/shape_builders.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace graspd::test {
namespace {

struct GridPoint {
    std::array<int, 3> index;
    auto operator<=>(const GridPoint&) const = default;
};

/// The grid with more lines, and the coarse interval that each fine one lies in.
struct FineLines {
    std::vector<double> at;
    std::vector<int> coarse;
};

FineLines divide(const std::vector<double>& lines, double spacing) {
    FineLines fine;
    fine.at.push_back(lines.front());
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        const double length = lines[i + 1] - lines[i];
        const int parts = std::max(1, static_cast<int>(std::lround(length / spacing)));
        for (int p = 1; p <= parts; ++p) {
            fine.at.push_back(p == parts ? lines[i + 1] : lines[i] + length * p / parts);
            fine.coarse.push_back(static_cast<int>(i));
        }
    }
    return fine;
}

/// Collects the sides of filled cells that face empty ones.
class GridSurface {
public:
    explicit GridSurface(std::array<FineLines, 3> lines) : lines_(std::move(lines)) {}

    /// @param cell  fine cell; @param axis, up  which of its six sides
    void add_side(const std::array<int, 3>& cell, std::size_t axis, bool up) {
        const std::size_t b = (axis + 1) % 3;
        const std::size_t c = (axis + 2) % 3;
        std::array<std::array<int, 3>, 4> corner{cell, cell, cell, cell};
        for (auto& point : corner) point[axis] += up;
        ++corner[1][b];
        ++corner[2][b];
        ++corner[2][c];
        ++corner[3][c];
        if (!up) std::swap(corner[1], corner[3]);
        const std::uint32_t v[4] = {vertex(corner[0]), vertex(corner[1]), vertex(corner[2]),
                                    vertex(corner[3])};
        mesh.faces.push_back({v[0], v[1], v[2]});
        mesh.faces.push_back({v[0], v[2], v[3]});
    }

    TriangleMesh mesh;

private:
    std::uint32_t vertex(const std::array<int, 3>& index) {
        const auto [it, added] =
            number_.try_emplace({index}, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (added) {
            mesh.vertices.emplace_back(lines_[0].at[static_cast<std::size_t>(index[0])],
                                       lines_[1].at[static_cast<std::size_t>(index[1])],
                                       lines_[2].at[static_cast<std::size_t>(index[2])]);
        }
        return it->second;
    }

    std::array<FineLines, 3> lines_;
    std::map<GridPoint, std::uint32_t> number_;
};

TriangleMesh grid_surface(const std::array<std::vector<double>, 3>& lines,
                          const std::function<bool(int, int, int)>& filled, double spacing) {
    const std::array<FineLines, 3> fine{divide(lines[0], spacing), divide(lines[1], spacing),
                                        divide(lines[2], spacing)};
    const std::array<int, 3> size{static_cast<int>(fine[0].coarse.size()),
                                  static_cast<int>(fine[1].coarse.size()),
                                  static_cast<int>(fine[2].coarse.size())};
    const auto is_filled = [&](const std::array<int, 3>& cell) {
        std::array<int, 3> coarse{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (cell[axis] < 0 || cell[axis] >= size[axis]) return false;
            coarse[axis] = fine[axis].coarse[static_cast<std::size_t>(cell[axis])];
        }
        return filled(coarse[0], coarse[1], coarse[2]);
    };
    GridSurface surface(fine);
    std::array<int, 3> cell{};
    for (cell[0] = 0; cell[0] < size[0]; ++cell[0]) {
        for (cell[1] = 0; cell[1] < size[1]; ++cell[1]) {
            for (cell[2] = 0; cell[2] < size[2]; ++cell[2]) {
                if (!is_filled(cell)) continue;
                for (std::size_t side = 0; side < 6; ++side) {
                    std::array<int, 3> beyond = cell;
                    beyond[side / 2] += side % 2 ? 1 : -1;
                    if (!is_filled(beyond)) surface.add_side(cell, side / 2, side % 2);
                }
            }
        }
    }
    return std::move(surface.mesh);
}

double area_m2(const TriangleMesh& mesh) {
    double area = 0.0;
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.vertices[face[0]];
        area += 0.5 * (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a).norm();
    }
    return area;
}

/// The profile with points between its corners; without the repeated first point when closed.
std::vector<Eigen::Vector2d> divide_profile(const std::vector<Eigen::Vector2d>& profile,
                                            bool closed, double spacing) {
    std::vector<Eigen::Vector2d> points{profile.front()};
    const std::size_t pieces = closed ? profile.size() : profile.size() - 1;
    for (std::size_t i = 0; i < pieces; ++i) {
        const Eigen::Vector2d& a = profile[i];
        const Eigen::Vector2d& b = profile[(i + 1) % profile.size()];
        const int parts = std::max(1, static_cast<int>(std::lround((b - a).norm() / spacing)));
        for (int p = 1; p <= parts; ++p) points.push_back(p == parts ? b : a + (b - a) * p / parts);
    }
    if (closed) points.pop_back();
    return points;
}

double outline_length(const std::vector<Eigen::Vector2d>& profile, bool closed) {
    double length = closed ? (profile.front() - profile.back()).norm() : 0.0;
    for (std::size_t i = 1; i < profile.size(); ++i) length += (profile[i] - profile[i - 1]).norm();
    return length;
}

double largest_radius(const std::vector<Eigen::Vector2d>& profile) {
    double radius = 0.0;
    for (const Eigen::Vector2d& point : profile) radius = std::max(radius, point.x());
    return radius;
}

/// Length of a mesh edge that gives about `faces` triangles of even size.
double lathe_spacing(const std::vector<Eigen::Vector2d>& profile, bool closed, std::size_t faces) {
    const double area = outline_length(profile, closed) * largest_radius(profile);
    return std::sqrt(4.0 * std::numbers::pi * area / static_cast<double>(faces));
}

/// Rings of regular polygons through the points, each turned about z [rad], joined by bands.
TriangleMesh turned_rings(const std::vector<Eigen::Vector2d>& points,
                          const std::vector<double>& turns, int sides, bool closed) {
    TriangleMesh mesh;
    std::vector<std::vector<std::uint32_t>> rings;  // one vertex on the axis, else `sides`
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d& point = points[i];
        std::vector<std::uint32_t>& ring = rings.emplace_back();
        for (int s = 0; s < (point.x() > 0.0 ? sides : 1); ++s) {
            const double angle = 2.0 * std::numbers::pi * s / sides + turns[i];
            ring.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle),
                                       point.y());
        }
    }
    const std::size_t bands = closed ? rings.size() : rings.size() - 1;
    for (std::size_t i = 0; i < bands; ++i) {
        const auto& low = rings[i];
        const auto& high = rings[(i + 1) % rings.size()];
        for (std::size_t s = 0; s < static_cast<std::size_t>(sides); ++s) {
            const std::size_t t = (s + 1) % static_cast<std::size_t>(sides);
            const auto at = [](const std::vector<std::uint32_t>& ring, std::size_t k) {
                return ring.size() == 1 ? ring[0] : ring[k];
            };
            if (low.size() > 1) mesh.faces.push_back({at(low, s), at(low, t), at(high, t)});
            if (high.size() > 1) mesh.faces.push_back({at(low, s), at(high, t), at(high, s)});
        }
    }
    if (signed_volume_m3(mesh) < 0.0) {
        for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
    }
    return mesh;
}

std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_counts(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> counts;
    for (const Triangle& face : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) ++counts[{face[k], face[(k + 1) % 3]}];
    }
    return counts;
}

}  // namespace

TriangleMesh grid_solid(const std::array<std::vector<double>, 3>& lines,
                        const std::function<bool(int, int, int)>& filled, std::size_t faces) {
    const TriangleMesh coarse = grid_surface(lines, filled, 1e9);
    if (coarse.faces.size() >= faces) return coarse;
    // A square of side s carries two triangles.
    const double spacing = std::sqrt(2.0 * area_m2(coarse) / static_cast<double>(faces));
    return grid_surface(lines, filled, spacing);
}

TriangleMesh lathe(const std::vector<Eigen::Vector2d>& profile, bool closed, std::size_t faces) {
    const std::vector<Eigen::Vector2d> points =
        divide_profile(profile, closed, lathe_spacing(profile, closed, faces));
    const std::vector<double> turns(points.size(), 0.0);
    return turned_rings(points, turns, lathe_sides(profile, closed, faces), closed);
}

int lathe_sides(const std::vector<Eigen::Vector2d>& profile, bool closed, std::size_t faces) {
    const double around = 2.0 * std::numbers::pi * largest_radius(profile);
    const double spacing = lathe_spacing(profile, closed, faces);
    return std::max(8, static_cast<int>(std::lround(around / spacing)));
}

TriangleMesh twisted_lathe(const std::vector<Eigen::Vector2d>& profile, int sides,
                           std::size_t faces, std::uint64_t seed) {
    const double rings = static_cast<double>(faces) / (2.0 * sides);
    double spacing = outline_length(profile, false) / rings;
    std::vector<Eigen::Vector2d> points = divide_profile(profile, false, spacing);
    while (points.size() > profile.size() && static_cast<double>(points.size()) > rings) {
        points = divide_profile(profile, false, spacing *= 1.1);  // short pieces stay whole
    }
    // A turn by a whole number of sides changes nothing but the corners' order, so half a side
    // either way relative to the ring before is every angle.
    std::mt19937_64 random(seed);
    std::vector<double> turns{0.0};
    while (turns.size() < points.size()) {
        const double share = static_cast<double>(random() >> 11) * 0x1.0p-53 - 0.5;
        turns.push_back(turns.back() + share * 2.0 * std::numbers::pi / sides);
    }
    return turned_rings(points, turns, sides, false);
}

double signed_volume_m3(const TriangleMesh& mesh) {
    double volume = 0.0;
    const Eigen::Vector3d& base = mesh.vertices.front();
    for (const Triangle& face : mesh.faces) {
        volume += (mesh.vertices[face[0]] - base)
                      .dot((mesh.vertices[face[1]] - base).cross(mesh.vertices[face[2]] - base)) /
                  6.0;
    }
    return volume;
}

bool is_closed_manifold(const TriangleMesh& mesh) {
    const auto counts = directed_counts(mesh);
    return std::ranges::all_of(counts, [&](const auto& entry) {
        const auto opposite = counts.find({entry.first.second, entry.first.first});
        return entry.second == 1 && opposite != counts.end() && opposite->second == 1;
    });
}

bool is_balanced(const TriangleMesh& mesh) {
    const auto counts = directed_counts(mesh);
    return std::ranges::all_of(counts, [&](const auto& entry) {
        const auto opposite = counts.find({entry.first.second, entry.first.first});
        return opposite != counts.end() && opposite->second == entry.second;
    });
}

}  // namespace graspd::test
