#include "support/path_certificate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace graspd::test {
namespace {

using Eigen::Vector3d;

/// Segments by their end points, and whether they are blocked: the later segments of a way are
/// mostly those of its bends' own ways.
class SegmentMemory {
public:
    explicit SegmentMemory(const ExactSurface& surface) : surface_(surface) {}

    /// Whether any segment of the path is blocked.
    bool blocks(const std::vector<Vector3d>& path, PathCertificate& count) {
        bool any = false;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            const Vector3d &a = path[i], &b = path[i + 1];
            const auto [known, added] =
                known_.try_emplace({a.x(), a.y(), a.z(), b.x(), b.y(), b.z()}, false);
            if (added) {
                known->second = surface_.blocks(a, b);
                ++count.segments;
                count.blocked += known->second;
            }
            any = any || known->second;
        }
        return any;
    }

private:
    using Ends = std::array<double, 6>;
    struct Hash {
        std::size_t operator()(const Ends& ends) const {
            std::uint64_t hash = 0;
            for (const double x : ends) {
                hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
                hash ^= hash >> 32;
            }
            return static_cast<std::size_t>(hash);
        }
    };

    const ExactSurface& surface_;
    std::unordered_map<Ends, bool, Hash> known_;
};

double length_m(const std::vector<Vector3d>& path) {
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
    return length;
}

/// [m] the least distance inside the hull's planes; negative outside.
double depth_m(const OuterHull& hull, const Vector3d& p) {
    double depth = std::numeric_limits<double>::infinity();
    for (const HullFacet& facet : hull.facets) {
        depth = std::min(depth, facet.offset_m - facet.normal.dot(p));
    }
    return depth;
}

/// Whether both paths have the same bends, but for the lift; the tested one's last point is one
/// lift short of the hull, and it starts one lift off.
bool runs_along(const std::vector<Vector3d>& tested, const std::vector<Vector3d>& path,
                double lift_m) {
    if (tested.size() != path.size()) return false;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if ((tested[i] - path[i]).norm() > 2.5 * lift_m) return false;
    }
    return true;
}

}  // namespace

PathCertificate certify_paths(const TriangleMesh& mesh, const ConcavityRun& run,
                              const ExactSurface& surface) {
    const double diagonal_m = mesh_diagonal_m(mesh);
    const double lift_m = ConcavityConfig{}.start_offset * diagonal_m;
    SegmentMemory memory(surface);
    PathCertificate count;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const double value_m = run.field.value_m[v];
        count.vertices += run.field.flag[v] != ConcavityFlag::kUnreferenced;
        const bool exact = run.field.flag[v] == ConcavityFlag::kExact;
        count.exact += exact;
        count.enclosed += run.field.flag[v] == ConcavityFlag::kEnclosed;
        if (!std::isfinite(value_m) || value_m < 2.0 * lift_m) continue;
        ++count.paths;
        const std::vector<Vector3d> path = escape_path(mesh, run.hull, run.field, v);
        const std::vector<Vector3d> tested = tested_path(mesh, run.hull, run.field, v);
        // Rounding of coordinates a thousand diagonals away is 1e-13 of the diagonal.
        const double rounding_m = 1e-9 * value_m + 1e-12 * diagonal_m;
        const bool blocked = memory.blocks(tested, count);
        const bool wrong_length = !(std::abs(length_m(path) - value_m) < rounding_m);
        const bool wrong_end = path.size() < 2 || path.front() != mesh.vertices[v] ||
                               depth_m(run.hull, path.back()) > rounding_m;
        const bool strayed = !runs_along(tested, path, lift_m);
        const bool not_exact = exact && depth_m(run.hull, mesh.vertices[v]) < value_m - rounding_m;
        count.wrong_lengths += wrong_length;
        count.wrong_ends += wrong_end;
        count.strayed += strayed;
        count.not_exact += not_exact;
        const bool bad = blocked || wrong_length || wrong_end || strayed || not_exact;
        if (bad) count.first_bad = std::min(count.first_bad, v);
    }
    return count;
}

}  // namespace graspd::test
