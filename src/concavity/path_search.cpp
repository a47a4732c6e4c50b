#include "path_search.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "graspd/base/parallel.hpp"
#include "graspd/base/stop.hpp"
#include "graspd/base/stoppable_sort.hpp"
#include "slide_bends.hpp"

namespace graspd::concavity_detail {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();
constexpr double kBand = 2.0;  // mean edges: width of the values that are relaxed side by side
constexpr int kMaxPull = 64;   // bends of one string; a longer one is pulled by later relaxations

// Where no mesh edge leads on, rays look around: from so many vertices of every region without a
// way out, in so many directions, and so many rays in all.
constexpr std::size_t kProbedVertices = 16;
constexpr std::uint32_t kMostProbes = 8192;
constexpr int kProbeRounds = 4;  // a region may be reached through another one only

/// Directions spread evenly over the sphere: equal steps in height, golden angles between them.
/// Each lookout has its own set, turned and shifted against the others'.
Eigen::Vector3d probe_direction(std::size_t lookout, int index, int count) {
    constexpr double kGolden = 0.6180339887498949;
    const double turn = kGolden * static_cast<double>(lookout);
    const double shift = turn - std::floor(turn);  // in [0, 1)
    const double z = 1.0 - 2.0 * (index + shift) / count;
    const double angle = std::numbers::pi * ((3.0 - std::sqrt(5.0)) * index + 2.0 * turn);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

PathSearch::PathSearch(const PathGround& ground, const HullPlaneTree& planes,
                       const TriangleBvh& bvh, const ConcavityConfig& config)
    : ground_(ground), planes_(planes), bvh_(bvh), config_(config) {
    const std::size_t count = ground.mesh.vertices.size();
    field_.value_m.assign(count, kNoWay);
    field_.flag.assign(count, ConcavityFlag::kEnclosed);
    field_.parent.assign(count, ConcavityField::kNoParent);
    stop_point();
    failed_.assign(count * config.failed_memory, ConcavityField::kNoParent);
    stop_point();
    relaxations_.assign(count, 0);
    blockers_.resize(count);
    band_.first.assign(count, Band::kEnd);
    band_.last.assign(count, Band::kEnd);
    for (std::uint32_t v = 0; v < count; ++v) {
        stop_point(v);
        if (!ground.neighbours.of(v).empty()) continue;
        field_.flag[v] = ConcavityFlag::kUnreferenced;
        field_.value_m[v] = std::numeric_limits<double>::quiet_NaN();
    }
}

/// Steps 1 and 2: the distance to the nearest hull plane is a lower bound; where the perpendicular
/// is free it is the answer.
void PathSearch::prove_direct() {
    for_blocks(ground_.order.size(), kVerticesAtATime, [&](std::size_t first, std::size_t last) {
        std::array<Eigen::Vector3d, kVerticesAtATime> points;
        std::array<HullPlaneTree::Nearest, kVerticesAtATime> nearest;
        const std::size_t count = last - first;
        for (std::size_t i = 0; i < count; ++i) {
            points[i] = ground_.mesh.vertices[ground_.order[first + i]];
        }
        planes_.nearest({points.data(), count}, {nearest.data(), count});
        TriangleBvh::Blocker blocker;  // the last vertex's, often near
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t v = ground_.order[first + i];
            if (!unreached(v)) continue;
            const auto parent = -1 - static_cast<std::int32_t>(nearest[i].facet);
            blockers_[v] = blocker;
            const bool is_free = sees(v, parent);
            blocker = blockers_[v];
            if (!is_free) continue;
            field_.value_m[v] = nearest[i].distance_m;
            field_.parent[v] = parent;
            field_.flag[v] = ConcavityFlag::kExact;
        }
    });
}

/// Length of v's way out through a parent (a bend or a hull facet), seen or not.
double PathSearch::length_through(std::uint32_t v, std::int32_t parent) const {
    const std::vector<Eigen::Vector3d>& vertices = ground_.mesh.vertices;
    if (parent >= 0) return (vertices[v] - vertices[parent]).norm() + field_.value_m[parent];
    const HullFacet& facet = planes_.facet(static_cast<std::uint32_t>(-1 - parent));
    return std::max(0.0, facet.offset_m - facet.normal.dot(vertices[v]));
}

bool PathSearch::sees(std::uint32_t v, std::int32_t parent) {
    const Eigen::Vector3d& from = ground_.lifted[v];
    if (parent >= 0) return !bvh_.segment_blocked(from, ground_.lifted[parent], blockers_[v]);
    const HullFacet& facet = planes_.facet(static_cast<std::uint32_t>(-1 - parent));
    const double depth_m = facet.offset_m - facet.normal.dot(ground_.mesh.vertices[v]);
    if (depth_m <= ground_.offset_m / kOffsetOverRayTolerance) return true;  // v is on the hull
    return !bvh_.segment_blocked(from, beyond_plane(facet, from, ground_.offset_m), blockers_[v]);
}

/// Takes a parent into `way` when that is shorter and free.
bool PathSearch::consider(std::uint32_t v, std::int32_t parent, Way& way) {
    if (parent == ConcavityField::kNoParent || parent == static_cast<std::int32_t>(v)) return false;
    const double length = length_through(v, parent);
    if (!(length < way.value_m * (1.0 - config_.min_gain))) return false;
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
    way = {length, parent};
    return true;
}

/// Tries the mesh neighbours of a bend.
bool PathSearch::consider_beside(std::uint32_t v, std::int32_t bend, Way& way) {
    if (bend < 0) return false;
    return std::ranges::any_of(
        ground_.neighbours.of(static_cast<std::uint32_t>(bend)), [&](std::uint32_t u) {
            return finished(u) && consider(v, static_cast<std::int32_t>(u), way);
        });
}

/// Pulls a string tight: skips bends that are not needed, then slides the bend to its neighbours.
void PathSearch::straighten(std::uint32_t v, Way& way) {
    for (int round = 0; round < kMaxPull; ++round) {
        const std::int32_t bend = way.parent;
        if (bend < 0) return;
        if (!consider(v, field_.parent[bend], way) && !consider_beside(v, bend, way)) return;
    }
}

/// Tries what another vertex's way goes through, then that vertex.
bool PathSearch::consider_over(std::uint32_t v, std::uint32_t from, Way& way) {
    const std::int32_t parent = field_.parent[from];
    const bool improved = consider(v, parent, way) || consider_beside(v, parent, way) ||
                          consider(v, static_cast<std::int32_t>(from), way);
    if (improved) straighten(v, way);
    return improved;
}

bool PathSearch::accept(std::uint32_t v, const Way& way) {
    if (!(way.value_m < field_.value_m[v])) return false;
    field_.value_m[v] = way.value_m;
    field_.parent[v] = way.parent;
    field_.flag[v] = ConcavityFlag::kPath;
    queue_.push({way.value_m, v});
    return true;
}

/// Step 3: Dijkstra from the proven vertices that border others.
void PathSearch::propagate_inwards() {
    for (std::uint32_t v = 0; v < field_.flag.size(); ++v) {
        stop_point(v);
        if (!finished(v)) continue;
        const bool borders = std::ranges::any_of(ground_.neighbours.of(v),
                                                 [&](std::uint32_t u) { return unreached(u); });
        if (borders) queue_.push({field_.value_m[v], v});
    }
    propagate();
}

/// A band of values at a time: the vertices next to it look at all of it side by side. Values may
/// sink again after a vertex has left the queue, so an improved vertex is queued anew; the count of
/// relaxations bounds the work.
void PathSearch::propagate() {
    while (!queue_.empty()) {
        stop_point();
        take_band(queue_.top().value_m + kBand * ground_.mean_edge_m);
        relax_band();
    }
}

/// Takes what is queued up to a value and notes which vertices it may help.
void PathSearch::take_band(double most_m) {
    band_.targets.clear();
    band_.links.clear();
    std::size_t taken = 0;
    while (!queue_.empty() && queue_.top().value_m <= most_m) {
        const QueueItem item = queue_.top();
        queue_.pop();
        stop_point(++taken);
        if (item.value_m > field_.value_m[item.vertex]) continue;
        for (const std::uint32_t to : ground_.neighbours.of(item.vertex)) {
            if (field_.flag[to] == ConcavityFlag::kExact) continue;
            if (++relaxations_[to] > config_.max_relaxations_per_vertex) continue;
            const auto link = static_cast<std::uint32_t>(band_.links.size());
            band_.links.push_back({item.vertex, Band::kEnd});
            if (band_.first[to] == Band::kEnd) {
                band_.first[to] = link;
                band_.targets.push_back(to);
            } else {
                band_.links[band_.last[to]].next = link;
            }
            band_.last[to] = link;
        }
    }
}

void PathSearch::relax_band() {
    band_.ways.resize(band_.targets.size());
    const auto relax = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t to = band_.targets[i];
            Way way = known(to);
            for (auto link = band_.first[to]; link != Band::kEnd; link = band_.links[link].next) {
                consider_over(to, band_.links[link].from, way);
            }
            band_.ways[i] = way;
        }
    };
    constexpr std::size_t kAtATime = 32;
    for_blocks(band_.targets.size(), kAtATime, relax);
    for (std::size_t i = 0; i < band_.targets.size(); ++i) {
        stop_point(i);
        accept(band_.targets[i], band_.ways[i]);
        band_.first[band_.targets[i]] = Band::kEnd;
    }
}

/// Vertices without a way out that are joined to `seed` by mesh edges, in a fixed order.
std::vector<std::uint32_t> PathSearch::unreached_region(std::uint32_t seed,
                                                        std::vector<char>& seen) const {
    std::vector<std::uint32_t> region{seed};
    seen[seed] = 1;
    for (std::size_t i = 0; i < region.size(); ++i) {
        stop_point(i);
        for (const std::uint32_t u : ground_.neighbours.of(region[i])) {
            if (seen[u] || !unreached(u)) continue;
            seen[u] = 1;
            region.push_back(u);
        }
    }
    return region;
}

/// Looks from v in `count` of the directions that lead off the surface: a free ray proposes the
/// plane it leaves the hull by, another one what it meets.
bool PathSearch::look_around(std::uint32_t v, std::size_t lookout, int count, Way& way) {
    constexpr int kStep = 13;  // any odd number visits every direction
    bool improved = false;
    for (int k = 0; k < kAllDirections && count > 0; ++k) {
        const int index = k * kStep % kAllDirections;
        const Eigen::Vector3d direction = probe_direction(lookout, index, kAllDirections);
        if (direction.dot(ground_.normals[v]) <= 0.0) continue;
        --count;
        const auto hit = bvh_.first_hit(ground_.lifted[v], direction, ground_.diagonal_m);
        if (!hit) {
            const auto facet = planes_.exit(ground_.lifted[v], direction);
            improved |= consider(v, -1 - static_cast<std::int32_t>(facet), way);
            continue;
        }
        for (const std::uint32_t u : ground_.mesh.faces[hit->face]) {
            if (finished(u)) improved |= consider_over(v, u, way);
        }
    }
    return improved;
}

/// A piece within another one's hollow, or a part cut off by another, is not reached along mesh
/// edges. @return whether some way out was found, so that propagate() has something to do
bool PathSearch::probe_unreached() {
    std::vector<char> seen(field_.flag.size(), 0);
    for (std::uint32_t seed = 0; seed < seen.size(); ++seed) {
        if (seen[seed] || !unreached(seed)) continue;
        const std::vector<std::uint32_t> region = unreached_region(seed, seen);
        const std::size_t step = 1 + region.size() / kProbedVertices;
        for (std::size_t i = 0; i < region.size() && probes_ < kMostProbes; i += step) {
            stop_point();
            Way way = known(region[i]);
            probes_ += kAllDirections;
            if (look_around(region[i], i, kAllDirections, way)) accept(region[i], way);
        }
    }
    return !queue_.empty();
}

void PathSearch::reach_what_no_edge_reaches() {
    for (int round = 0; round < kProbeRounds && probe_unreached(); ++round) propagate();
}

/// Step 5: bends slide along mesh edges.
void PathSearch::slide_bends() {
    const std::vector<std::uint32_t> bent = bent_vertices();
    BendSlider slider(ground_, planes_, bvh_, field_, blockers_);
    std::vector<SlidWay> ways(bent.size());
    for_blocks(bent.size(), kVerticesAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            ways[i] = slider.slide(bent[i]);
            SlidWay tilted = slider.tilt(bent[i]);
            if (tilted.value_m < ways[i].value_m) ways[i] = std::move(tilted);
        }
    });
    for (std::size_t i = 0; i < bent.size(); ++i) {
        if (ways[i].value_m < field_.value_m[bent[i]]) take_slid(ways[i], bent[i], field_);
    }
}

ConcavityField PathSearch::take() {
    // A bend's own value may have sunk after a string through it was measured.
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t v = 0; v < field_.value_m.size(); ++v) {
        if (field_.flag[v] == ConcavityFlag::kPath) order.emplace_back(field_.value_m[v], v);
    }
    stoppable_sort(order);
    std::size_t measured = 0;
    for (const auto& [value_m, v] : order) {
        stop_point(measured++);
        field_.value_m[v] = std::min(field_.value_m[v], length_of_way(field_, ground_, planes_, v));
    }
    for (const double value : field_.value_m) {
        if (std::isfinite(value)) field_.largest_m = std::max(field_.largest_m, value);
    }
    field_.lifted = ground_.lifted;
    return std::move(field_);
}

}  // namespace graspd::concavity_detail
