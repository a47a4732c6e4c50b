// The part of PathSearch that looks across the void.

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <utility>

#include "bend_pool.hpp"
#include "graspd/base/parallel.hpp"
#include "graspd/base/stop.hpp"
#include "path_search.hpp"

namespace graspd::concavity_detail {
namespace {

// How far the search across the void goes. Candidates are tried shortest first.
constexpr std::size_t kMostBends = 512;       // most used ones, whose own ways come first
constexpr std::size_t kBendLookouts = 128;    // of these, which look around in all directions
constexpr std::size_t kMostTries = 64;        // bends that one of these tries,
constexpr std::size_t kTries = 12;            // that any other vertex tries, and planes,
constexpr std::size_t kOuterTries = 4;        // and bends on the hull
constexpr std::size_t kSearched = 16384;      // vertices searched first, about
constexpr std::size_t kHiding = 2;            // of the bends found hidden: what hides them is tried
constexpr std::size_t kBendBudget = 8000000;  // pairs of a vertex and a possible bend
constexpr std::size_t kPlaneBudget = 6000000;  // pairs of a vertex and a plane
constexpr double kLeastGain = 1e-4;            // [1] of the value
constexpr double kBesideFacet = 0.01;  // [1] of the diagonal: how far from a facet a foot may lie

using Entry = std::pair<double, std::int32_t>;  ///< length [m] through a parent, the parent

}  // namespace

/// Vertices whose value is not proven, near ones together.
std::vector<std::uint32_t> PathSearch::bent_vertices() const {
    std::vector<std::uint32_t> bent;
    for (const std::uint32_t v : ground_.order) {
        if (field_.flag[v] == ConcavityFlag::kPath) bent.push_back(v);
    }
    return bent;
}

/// Finished vertices over which a string may be taut, near ones together: those with a convex edge,
/// without those in the middle of a face of the hull, which no way from inside comes by.
std::vector<std::uint32_t> PathSearch::possible_bends() const {
    const auto on_hull = [&](std::uint32_t v) { return field_.value_m[v] <= ground_.offset_m; };
    std::vector<std::uint32_t> bends;
    std::size_t seen = 0;
    for (const std::uint32_t v : ground_.order) {
        stop_point(seen++);
        if (!finished(v) || !ground_.can_bend[v]) continue;
        if (on_hull(v) && std::ranges::all_of(ground_.neighbours.of(v), on_hull)) continue;
        bends.push_back(v);
    }
    return bends;
}

/// The bends that most of the ways that are not proven go through, near ones together.
std::vector<std::uint32_t> PathSearch::most_used_bends() const {
    std::vector<std::uint32_t> uses(field_.parent.size(), 0);
    for (std::size_t v = 0; v < field_.parent.size(); ++v) {
        if (field_.parent[v] >= 0) ++uses[static_cast<std::size_t>(field_.parent[v])];
    }
    std::vector<std::uint32_t> counts;
    for (const std::uint32_t count : uses) {
        if (count > 0) counts.push_back(count);
    }
    std::uint32_t least = 1;
    if (counts.size() > kMostBends) {
        const auto last = counts.begin() + static_cast<std::ptrdiff_t>(kMostBends - 1);
        std::ranges::nth_element(counts, last, std::greater<>());
        least = *last;
    }
    std::vector<std::uint32_t> bends;
    for (const std::uint32_t v : ground_.order) {
        if (uses[v] >= least && bends.size() < kMostBends) bends.push_back(v);
    }
    return bends;
}

/// The few shortest of the candidates that promise a gain, shortest first.
class PathSearch::Shortlist {
public:
    Shortlist(const PathSearch& search, std::uint32_t v, double limit_m, std::size_t tries)
        : search_(search), v_(v), limit_m_(limit_m), tries_(tries) {}

    void note(std::int32_t parent) {
        const Entry entry{search_.length_through(v_, parent), parent};
        if (!(entry.first < limit_m_)) return;
        if (count_ == tries_ && !(entry < best_[count_ - 1])) return;
        std::size_t place = count_ < tries_ ? count_++ : count_ - 1;
        for (; place > 0 && entry < best_[place - 1]; --place) best_[place] = best_[place - 1];
        best_[place] = entry;
    }
    /// [m] what is not shorter comes too late.
    double limit_m() const { return count_ == tries_ ? best_[count_ - 1].first : limit_m_; }
    std::span<const Entry> entries() const { return {best_.data(), count_}; }

private:
    const PathSearch& search_;
    std::uint32_t v_;
    double limit_m_;
    std::array<Entry, kMostTries> best_;
    std::size_t tries_, count_ = 0;
};

/// @return whether one of the list was taken
bool PathSearch::consider_listed(std::uint32_t v, const Shortlist& list, Way& way) {
    for (const auto& [length_m, parent] : list.entries()) {
        if (!consider(v, parent, way)) continue;
        straighten(v, way);
        return true;
    }
    return false;
}

/// Tries the corners of the face that hides a bend: often the next ones to bend over.
void PathSearch::consider_hiding(std::uint32_t v, std::int32_t bend, Way& way) {
    const Eigen::Vector3d& from = ground_.lifted[v];
    const Eigen::Vector3d to_bend = ground_.lifted[static_cast<std::size_t>(bend)] - from;
    const double length_m = to_bend.norm();
    const auto hit = bvh_.first_hit(from, to_bend / length_m, length_m);
    if (!hit) return;
    for (const std::uint32_t u : ground_.mesh.faces[hit->face]) {
        if (finished(u) && consider(v, static_cast<std::int32_t>(u), way)) straighten(v, way);
    }
}

/// Tries the bends of the pools, of those that promise a gain the shortest first.
void PathSearch::consider_pool(std::uint32_t v, const BendPools& pools, std::size_t tries,
                               Way& way) {
    const double limit_m = way.value_m * (1.0 - kLeastGain);
    Shortlist inner(*this, v, limit_m, tries), outer(*this, v, limit_m, kOuterTries);
    const auto fill = [&](const BendPool& pool, Shortlist& list) {
        pool.visit_promising(v, limit_m, [&](std::int32_t bend) {
            list.note(bend);
            return list.limit_m();
        });
    };
    fill(pools.outer, outer);
    fill(pools.inner, inner);
    if (consider_listed(v, outer, way) || consider_listed(v, inner, way)) return;
    const std::size_t hidden = std::min(kHiding, inner.entries().size());
    for (const auto& [length_m, bend] : inner.entries().first(hidden)) {
        consider_hiding(v, bend, way);
    }
}

/// Tries the hull's planes that are nearer than the way is long and lie ahead of v, the nearest
/// first.
void PathSearch::consider_planes(std::uint32_t v, Way& way) {
    thread_local std::vector<std::uint32_t> facets;  // one allocation a thread instead of a vertex
    const double limit_m = way.value_m * (1.0 - kLeastGain);
    planes_.facets_ahead(ground_.mesh.vertices[v], limit_m, ground_.normals[v],
                         double{ground_.spread[v]} + BendPool::kSlack,
                         kBesideFacet * ground_.diagonal_m, kTries, facets);
    Shortlist list(*this, v, limit_m, kTries);
    for (const std::uint32_t facet : facets) list.note(-1 - static_cast<std::int32_t>(facet));
    consider_listed(v, list, way);
}

/// Searches a better way for each vertex on its own, then takes what was found and spreads it.
/// @return per vertex whether its way has become shorter by what is worth looking around for
std::vector<char> PathSearch::improve(
    const std::vector<std::uint32_t>& vertices,
    const std::function<void(std::uint32_t v, std::size_t place, Way& way)>& search) {
    std::vector<Way> ways(vertices.size());
    constexpr std::size_t kAtATime = 16;
    for_blocks(vertices.size(), kAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            ways[i] = known(vertices[i]);
            search(vertices[i], i, ways[i]);
        }
    });
    stop_point();
    std::vector<char> gained(vertices.size(), 0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        gained[i] = ways[i].value_m < field_.value_m[vertices[i]] * (1.0 - kLeastGain);
        accept(vertices[i], ways[i]);
    }
    propagate();
    return gained;
}

/// Of the bends that most ways use, those whose own ways are not proven.
std::vector<std::uint32_t> PathSearch::bends_to_shorten() const {
    std::vector<std::uint32_t> bends = most_used_bends();
    std::erase_if(bends, [&](std::uint32_t v) { return field_.flag[v] != ConcavityFlag::kPath; });
    return bends;
}

/// Shortens the ways of bends that many ways use.
void PathSearch::shorten_bends(const std::vector<std::uint32_t>& bends) {
    const BendPools all(ground_, planes_, field_, possible_bends());
    const std::size_t stride = 1 + bends.size() / kBendLookouts;
    improve(bends, [&](std::uint32_t v, std::size_t place, Way& way) {
        consider_planes(v, way);
        consider_pool(v, all, kMostTries, way);
        if (place % stride == 0) look_around(v, place, kAllDirections, way);
    });
}

/// Shortens the ways of the bends that most ways use over bends whose own ways have become shorter
/// since the values were `known_m`: the others, and the planes, have been tried.
void PathSearch::shorten_bends_again(const std::vector<double>& known_m) {
    std::vector<std::uint32_t> shorter = possible_bends();
    std::erase_if(shorter, [&](std::uint32_t v) { return !(field_.value_m[v] < known_m[v]); });
    if (shorter.empty()) return;
    const BendPools pools(ground_, planes_, field_, shorter);
    improve(bends_to_shorten(), [&](std::uint32_t v, std::size_t, Way& way) {
        consider_pool(v, pools, kMostTries, way);
    });
}

/// Shortens ways that are not proven, by what the mesh neighbours' ways go through and by all
/// vertices and all planes, as many as the budgets allow: first of vertices evenly spread, then of
/// those around which a shorter way was found.
void PathSearch::shorten_all(const std::vector<std::uint32_t>& bent) {
    const BendPools used(ground_, planes_, field_, most_used_bends());
    const BendPools all(ground_, planes_, field_, possible_bends());
    const auto shorten = [&](const std::vector<std::uint32_t>& some) {
        const std::size_t bend_stride = 1 + some.size() * all.size() / kBendBudget;
        const std::size_t plane_stride = 1 + some.size() * planes_.size() / kPlaneBudget;
        return improve(some, [&](std::uint32_t v, std::size_t place, Way& way) {
            for (const std::uint32_t u : ground_.neighbours.of(v)) {
                if (finished(u) && consider(v, field_.parent[u], way)) straighten(v, way);
            }
            if (place % plane_stride == 0) consider_planes(v, way);
            consider_pool(v, place % bend_stride == 0 ? all : used, kTries, way);
        });
    };
    const std::size_t stride = 1 + bent.size() / kSearched;
    std::vector<std::uint32_t> sample, around;
    for (std::size_t i = 0; i < bent.size(); i += stride) sample.push_back(bent[i]);
    const std::vector<char> gained = shorten(sample);
    for (std::size_t i = 0; i < bent.size(); ++i) {
        const std::size_t before = i / stride, after = std::min(before + 1, sample.size() - 1);
        if (i % stride != 0 && (gained[before] || gained[after])) around.push_back(bent[i]);
    }
    if (!around.empty()) shorten(around);
}

/// Step 4: the next bend may lie across the void, where no mesh edge leads. First the bends' own
/// ways, which many share, then those of other vertices, then the bends' once more, as some lead
/// over vertices whose ways have just become shorter.
void PathSearch::shorten_across_the_void() {
    std::vector<std::uint32_t> others = bent_vertices();
    if (others.empty()) return;
    stop_point();
    const std::vector<double> known_m = field_.value_m;
    const std::vector<std::uint32_t> bends = bends_to_shorten();
    shorten_bends(bends);
    std::vector<char> searched(known_m.size(), 0);
    for (const std::uint32_t v : bends) searched[v] = 1;
    std::erase_if(others, [&](std::uint32_t v) { return searched[v] != 0; });
    if (!others.empty()) shorten_all(others);
    shorten_bends_again(known_m);
}

}  // namespace graspd::concavity_detail
