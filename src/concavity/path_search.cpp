#include "path_search.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

namespace graspd::concavity_detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxPull = 64;  // bends of one string; a longer one is pulled by later relaxations

// Where no mesh edge leads on, rays look around: from so many vertices of every region without a
// way out, from so many bends, in so many directions, and so many rays in all.
constexpr std::size_t kProbedVertices = 16;
constexpr std::size_t kProbedBends = 256;
constexpr int kProbeDirections = 32;
constexpr std::uint32_t kMostProbes = 8192;
constexpr int kProbeRounds = 4;  // a region may be reached through another one only

/// Directions spread evenly over the sphere: equal steps in height, golden angles between them.
Eigen::Vector3d probe_direction(int index) {
    const double z = 1.0 - (2.0 * index + 1.0) / kProbeDirections;
    const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * index;
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

PathSearch::PathSearch(const TriangleMesh& mesh, const OuterHull& hull, const TriangleBvh& bvh,
                       const ConcavityConfig& config)
    : mesh_(mesh),
      bvh_(bvh),
      config_(config),
      planes_(hull),
      neighbours_(mesh),
      diagonal_m_(mesh_diagonal_m(mesh)),
      offset_m_(config.start_offset * diagonal_m_),
      normals_(angle_weighted_normals(mesh)) {
    const std::size_t count = mesh.vertices.size();
    start_.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
        start_.push_back(mesh.vertices[v] + offset_m_ * normals_[v]);
    }
    field_.value_m.assign(count, kInfinity);
    field_.flag.assign(count, ConcavityFlag::kEnclosed);
    field_.parent.assign(count, ConcavityField::kNoParent);
    failed_.assign(count * config.failed_memory, ConcavityField::kNoParent);
    relaxations_.assign(count, 0);
}

void PathSearch::mark_unreferenced() {
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        if (!neighbours_.of(v).empty()) continue;
        field_.flag[v] = ConcavityFlag::kUnreferenced;
        field_.value_m[v] = std::numeric_limits<double>::quiet_NaN();
    }
}

/// Steps 1 and 2: the distance to the nearest hull plane is a lower bound; where the perpendicular
/// is free it is the answer.
void PathSearch::prove_direct() {
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        if (!unreached(v)) continue;
        const HullPlaneTree::Nearest nearest = planes_.nearest(mesh_.vertices[v]);
        const auto parent = -1 - static_cast<std::int32_t>(nearest.facet);
        if (!sees(v, parent)) continue;
        field_.value_m[v] = nearest.distance_m;
        field_.parent[v] = parent;
        field_.flag[v] = ConcavityFlag::kExact;
    }
}

/// Length of v's way out through a parent (a bend or a hull facet), seen or not.
double PathSearch::length_through(std::uint32_t v, std::int32_t parent) const {
    if (parent >= 0) {
        return (mesh_.vertices[v] - mesh_.vertices[parent]).norm() + field_.value_m[parent];
    }
    const HullFacet& facet = planes_.facet(static_cast<std::uint32_t>(-1 - parent));
    return std::max(0.0, facet.offset_m - facet.normal.dot(mesh_.vertices[v]));
}

bool PathSearch::sees(std::uint32_t v, std::int32_t parent) const {
    const Eigen::Vector3d& from = start_[v];
    if (parent >= 0) return !bvh_.segment_blocked(from, start_[parent]);
    const HullFacet& facet = planes_.facet(static_cast<std::uint32_t>(-1 - parent));
    const double depth_m = facet.offset_m - facet.normal.dot(mesh_.vertices[v]);
    if (depth_m <= offset_m_ / kOffsetOverRayTolerance) return true;  // v lies on the hull
    // One offset beyond the plane: the object's own sides often lie in it, and a way out of the
    // inside, through the solid, ends on one of them.
    const double length_m = facet.offset_m - facet.normal.dot(from) + offset_m_;
    return !bvh_.segment_blocked(from, from + length_m * facet.normal);
}

bool PathSearch::try_parent(std::uint32_t v, std::int32_t parent) {
    if (parent == ConcavityField::kNoParent || parent == static_cast<std::int32_t>(v)) return false;
    const double length = length_through(v, parent);
    if (!(length < field_.value_m[v] * (1.0 - config_.min_gain))) return false;
    const auto ring = failed_.begin() + static_cast<std::ptrdiff_t>(v) * config_.failed_memory;
    const auto ring_end = ring + config_.failed_memory;
    if (std::find(ring, ring_end, parent) != ring_end) return false;
    if (!sees(v, parent)) {
        if (ring != ring_end) {
            std::rotate(ring, ring_end - 1, ring_end);
            *ring = parent;
        }
        return false;
    }
    field_.value_m[v] = length;
    field_.parent[v] = parent;
    field_.flag[v] = ConcavityFlag::kPath;
    return true;
}

/// Tries the mesh neighbours of a bend.
bool PathSearch::try_beside(std::uint32_t v, std::int32_t bend) {
    if (bend < 0) return false;
    return std::ranges::any_of(
        neighbours_.of(static_cast<std::uint32_t>(bend)), [&](std::uint32_t u) {
            return finished(u) && try_parent(v, static_cast<std::int32_t>(u));
        });
}

/// Straightens v's way out: skip bends that are not needed, then slide the bend to its neighbours.
void PathSearch::pull(std::uint32_t v) {
    for (int round = 0; round < kMaxPull; ++round) {
        const std::int32_t bend = field_.parent[v];
        if (bend < 0) return;
        if (!try_parent(v, field_.parent[bend]) && !try_beside(v, bend)) return;
    }
}

bool PathSearch::relax(std::uint32_t from, std::uint32_t to) {
    const std::int32_t parent = field_.parent[from];
    const bool improved = try_parent(to, parent) || try_beside(to, parent) ||
                          try_parent(to, static_cast<std::int32_t>(from));
    if (improved) pull(to);
    return improved;
}

/// Step 3: Dijkstra from the proven vertices that border others.
void PathSearch::propagate_inwards() {
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        if (!finished(v)) continue;
        const bool borders =
            std::ranges::any_of(neighbours_.of(v), [&](std::uint32_t u) { return unreached(u); });
        if (borders) queue_.push({field_.value_m[v], v});
    }
    propagate();
}

/// Values may sink again after a vertex has left the queue, so an improved vertex is queued anew;
/// the count of relaxations bounds the work.
void PathSearch::propagate() {
    while (!queue_.empty()) {
        const QueueItem item = queue_.top();
        queue_.pop();
        if (item.value_m > field_.value_m[item.vertex]) continue;
        for (const std::uint32_t to : neighbours_.of(item.vertex)) {
            if (field_.flag[to] == ConcavityFlag::kExact) continue;
            if (++relaxations_[to] > config_.max_relaxations_per_vertex) continue;
            if (relax(item.vertex, to)) queue_.push({field_.value_m[to], to});
        }
    }
}

/// Vertices without a way out that are joined to `seed` by mesh edges, in a fixed order.
std::vector<std::uint32_t> PathSearch::unreached_region(std::uint32_t seed,
                                                        std::vector<char>& seen) const {
    std::vector<std::uint32_t> region{seed};
    seen[seed] = 1;
    for (std::size_t i = 0; i < region.size(); ++i) {
        for (const std::uint32_t u : neighbours_.of(region[i])) {
            if (seen[u] || !unreached(u)) continue;
            seen[u] = 1;
            region.push_back(u);
        }
    }
    return region;
}

/// Looks around from v: a free ray proposes the plane it leaves the hull by, another one what it
/// meets.
bool PathSearch::probe(std::uint32_t v) {
    bool improved = false;
    for (int k = 0; k < kProbeDirections && probes_ < kMostProbes; ++k) {
        const Eigen::Vector3d direction = probe_direction(k);
        if (direction.dot(normals_[v]) <= 0.0) continue;
        ++probes_;
        const auto hit = bvh_.first_hit(start_[v], direction, diagonal_m_);
        if (!hit) {
            const auto facet = planes_.exit(start_[v], direction);
            improved |= try_parent(v, -1 - static_cast<std::int32_t>(facet));
            continue;
        }
        for (const std::uint32_t u : mesh_.faces[hit->face]) {
            if (finished(u)) improved |= relax(u, v);
        }
    }
    return improved;
}

/// A piece within another one's hollow, or a part cut off by another, is not reached along mesh
/// edges. @return whether some way out was found, so that propagate() has something to do
bool PathSearch::probe_unreached() {
    std::vector<char> seen(mesh_.vertices.size(), 0);
    for (std::uint32_t seed = 0; seed < seen.size(); ++seed) {
        if (seen[seed] || !unreached(seed)) continue;
        const std::vector<std::uint32_t> region = unreached_region(seed, seen);
        const std::size_t step = 1 + region.size() / kProbedVertices;
        for (std::size_t i = 0; i < region.size(); i += step) {
            if (probe(region[i])) queue_.push({field_.value_m[region[i]], region[i]});
        }
    }
    return !queue_.empty();
}

/// The next bend may lie across the void, where no mesh edge leads. Many ways share a bend, so a
/// look around from the bends alone shortens most of them.
bool PathSearch::probe_bends() {
    std::vector<std::uint32_t> bends;
    for (const std::int32_t parent : field_.parent) {
        if (parent >= 0) bends.push_back(static_cast<std::uint32_t>(parent));
    }
    std::ranges::sort(bends);
    bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
    std::mt19937 random;  // seeded by default, so the same choice every time
    for (std::size_t i = 0; i < bends.size() && i < kProbedBends; ++i) {
        std::swap(bends[i], bends[i + random() % (bends.size() - i)]);
        if (field_.flag[bends[i]] != ConcavityFlag::kPath) continue;
        if (probe(bends[i])) queue_.push({field_.value_m[bends[i]], bends[i]});
    }
    return !queue_.empty();
}

void PathSearch::reach_what_no_edge_reaches() {
    for (int round = 0; round < kProbeRounds && probe_unreached(); ++round) propagate();
}

void PathSearch::shorten_across_the_void() {
    if (probe_bends()) propagate();
}

ConcavityField PathSearch::take() {
    // A bend's own value may have sunk after a string through it was measured.
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < field_.value_m.size(); ++v) {
        if (field_.flag[v] == ConcavityFlag::kPath) order.push_back(v);
    }
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return field_.value_m[a] != field_.value_m[b] ? field_.value_m[a] < field_.value_m[b]
                                                      : a < b;
    });
    for (const std::uint32_t v : order) {
        field_.value_m[v] = std::min(field_.value_m[v], length_through(v, field_.parent[v]));
    }
    for (const double value : field_.value_m) {
        if (std::isfinite(value)) field_.largest_m = std::max(field_.largest_m, value);
    }
    return std::move(field_);
}

}  // namespace graspd::concavity_detail
