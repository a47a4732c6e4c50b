#include "graspd/mesh/coarsen_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

constexpr double kGrowth = 1.25;             // of the cells from one attempt to the next
constexpr double kMostCellsAlong = 1 << 20;  // along an axis, so that three counts fit 64 bits
constexpr double kFacesPerCellSide = 2.0;    // of a surface cut into squares

double area_m2(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.vertices[face[0]];
        sum += 0.5 * (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a).norm();
    }
    return sum;
}

double weight_of(double weight) {
    return std::isfinite(weight) ? weight : 0.0;
}

/// For each vertex the one that stands for its cell.
std::vector<std::uint32_t> cell_heads(const TriangleMesh& mesh, std::span<const double> weight,
                                      const Eigen::Vector3d& corner, double cell_m) {
    struct Place {
        std::uint64_t cell;
        std::uint32_t vertex;
    };
    std::vector<Place> places(mesh.vertices.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        stop_point(i);
        const Eigen::Vector3d at = (mesh.vertices[i] - corner) / cell_m;
        std::uint64_t cell = 0;
        for (int axis = 0; axis < 3; ++axis) {
            cell = (cell << 21) | static_cast<std::uint64_t>(at[axis]);
        }
        places[i] = {cell, i};
    }
    std::ranges::sort(places, [&](const Place& a, const Place& b) {
        if (a.cell != b.cell) return a.cell < b.cell;
        const double of_a = weight_of(weight[a.vertex]), of_b = weight_of(weight[b.vertex]);
        return of_a != of_b ? of_a > of_b : a.vertex < b.vertex;
    });
    std::vector<std::uint32_t> heads(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool first = i == 0 || places[i].cell != places[i - 1].cell;
        heads[places[i].vertex] = first ? places[i].vertex : heads[places[i - 1].vertex];
    }
    return heads;
}

/// The faces between heads that have three different ones, each once, its lowest index first.
std::vector<Triangle> faces_between(const TriangleMesh& mesh,
                                    const std::vector<std::uint32_t>& heads) {
    std::vector<Triangle> faces;
    for (const Triangle& face : mesh.faces) {
        stop_point(faces.size());
        Triangle moved = {heads[face[0]], heads[face[1]], heads[face[2]]};
        if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
        // Not of std::ranges: clang 14 cannot read the subrange that this gives.
        std::rotate(moved.begin(), std::ranges::min_element(moved), moved.end());
        faces.push_back(moved);
    }
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

/// Keeps only the vertices that faces use.
CoarseMesh compacted(const TriangleMesh& mesh, std::vector<Triangle> faces) {
    constexpr std::uint32_t kNone = UINT32_MAX;
    CoarseMesh coarse;
    std::vector<std::uint32_t> place(mesh.vertices.size(), kNone);
    for (Triangle& face : faces) {
        for (std::uint32_t& corner : face) {
            if (place[corner] == kNone) {
                place[corner] = static_cast<std::uint32_t>(coarse.origin.size());
                coarse.origin.push_back(corner);
                coarse.mesh.vertices.push_back(mesh.vertices[corner]);
            }
            corner = place[corner];
        }
    }
    coarse.mesh.faces = std::move(faces);
    return coarse;
}

std::optional<PlanError> check(const TriangleMesh& mesh, std::span<const double> weight,
                               std::uint32_t most_faces) {
    const auto invalid = [](const std::string& what) {
        return PlanError{PlanErrorCode::kInvalidInput, what};
    };
    if (most_faces == 0) return invalid("most_faces = 0 must be positive");
    if (weight.size() != mesh.vertices.size()) {
        return invalid(std::to_string(weight.size()) + " weights for " +
                       std::to_string(mesh.vertices.size()) + " vertices");
    }
    for (const Triangle& face : mesh.faces) {
        const std::uint32_t greatest = std::ranges::max(face);
        if (greatest >= weight.size()) {
            return invalid("a face names vertex " + std::to_string(greatest) + " of " +
                           std::to_string(weight.size()));
        }
    }
    return std::nullopt;
}

}  // namespace

Result<CoarseMesh> coarsen_mesh(const TriangleMesh& mesh, std::span<const double> weight,
                                std::uint32_t most_faces) {
    if (const auto bad = check(mesh, weight, most_faces)) return *bad;
    if (mesh.faces.size() <= most_faces) {
        CoarseMesh same{mesh, std::vector<std::uint32_t>(mesh.vertices.size())};
        std::iota(same.origin.begin(), same.origin.end(), 0u);
        return same;
    }
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
    const double longest_m = box.sizes().maxCoeff();
    double cell_m = std::max(std::sqrt(kFacesPerCellSide * area_m2(mesh) / most_faces),
                             longest_m / kMostCellsAlong);
    // Ends: a cell that holds everything leaves no face.
    for (;; cell_m *= kGrowth) {
        auto faces = faces_between(mesh, cell_heads(mesh, weight, box.min(), cell_m));
        if (faces.size() <= most_faces) return compacted(mesh, std::move(faces));
    }
}

}  // namespace graspd
