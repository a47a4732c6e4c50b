#include "slide_bends.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "graspd/base/triangle_bvh.hpp"

namespace graspd::concavity_detail {
namespace {

constexpr std::size_t kMostSliding = 6;  // of a way that slide; what follows stays
constexpr int kEdgeRounds = 8;           // a bend that reaches an edge's end goes on along another
constexpr int kInsertions = 4;           // of bends where a slid way is blocked
constexpr int kHoldBacks = 2;            // halvings of how far the bends slide
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr double kSettled = 1e-5;          // [1] of the length that a round has to gain
constexpr double kLeastSlide = 3e-4;       // [1] of the length that sliding may gain at most
constexpr int kSettleRounds = 32;          // of bends in turn
constexpr double kLeastLean = 0.1;         // sine; a flatter floor does not block the perpendicular
constexpr double kLeastSlope = 0.5;        // cosine of a tilted way to the plane it leaves by
constexpr int kTiltRounds = 6;             // halvings of the tilt
constexpr double kLeastTiltGain = 1e-3;    // [1] of the value
constexpr double kLeastShortening = 1e-6;  // [1] of the value; less is not worth its rays

/// Where the way a, p, c is shortest for p = base + s * along on a line, along of unit length:
/// c turned about the line into a's plane, on the other side, is seen from a in a straight line.
double shortest_crossing(const Eigen::Vector3d& base, const Eigen::Vector3d& along,
                         const Eigen::Vector3d& a, const Eigen::Vector3d& c) {
    const Eigen::Vector3d to_a = a - base, to_c = c - base;
    const double at_a = to_a.dot(along), at_c = to_c.dot(along);
    const double far_a = (to_a - at_a * along).norm(), far_c = (to_c - at_c * along).norm();
    const double sum = far_a + far_c;
    return sum > 0.0 ? (at_a * far_c + at_c * far_a) / sum : 0.5 * (at_a + at_c);
}

/// The same for the way from a over p straight to a plane of this unit normal.
double shortest_to_plane(const Eigen::Vector3d& base, const Eigen::Vector3d& along,
                         const Eigen::Vector3d& a, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d to_a = a - base;
    const double at_a = to_a.dot(along);
    const double far_a = (to_a - at_a * along).norm();
    const double slope = along.dot(normal);
    const double rest = 1.0 - slope * slope;
    constexpr double kPerpendicular = 1e-12;
    if (rest < kPerpendicular)
        return slope > 0.0 ? std::numeric_limits<double>::infinity()
                           : -std::numeric_limits<double>::infinity();
    return at_a + far_a * slope / std::sqrt(rest);
}

}  // namespace

double BendSlider::Chain::length_m() const {
    double length = 0.0;
    Eigen::Vector3d at = start;
    for (const Bend& bend : bends) {
        length += (bend.point - at).norm();
        at = bend.point;
    }
    if (facet != nullptr) return length + std::max(0.0, facet->offset_m - facet->normal.dot(at));
    return length + (end - at).norm() + end_value_m;
}

const Eigen::Vector3d& BendSlider::Chain::before(std::size_t i) const {
    return i == 0 ? start : bends[i - 1].point;
}

/// From bend i to what comes next [m]; straight out of the hull where that is its plane.
Eigen::Vector3d BendSlider::Chain::after(std::size_t i) const {
    const Eigen::Vector3d& at = bends[i].point;
    if (i + 1 < bends.size()) return bends[i + 1].point - at;
    if (facet == nullptr) return end - at;
    return std::max(0.0, facet->offset_m - facet->normal.dot(at)) * facet->normal;
}

BendSlider::BendSlider(const PathGround& ground, const HullPlaneTree& planes,
                       const TriangleBvh& bvh, const ConcavityField& field,
                       std::vector<TriangleBvh::Blocker>& blockers)
    : ground_(ground), planes_(planes), bvh_(bvh), field_(field), blockers_(blockers) {}

BendSlider::Chain BendSlider::chain_of(std::uint32_t vertex) const {
    const std::vector<Eigen::Vector3d>& vertices = ground_.mesh.vertices;
    Chain chain;
    chain.vertex = vertex;
    chain.start = vertices[vertex];
    chain.parent = field_.parent[vertex];
    while (chain.parent >= 0 && chain.bends.size() < kMostSliding) {
        const auto bend = static_cast<std::uint32_t>(chain.parent);
        chain.bends.push_back({bend, bend, 0.0, vertices[bend]});
        chain.parent = field_.parent[bend];
    }
    if (chain.parent >= 0) {
        chain.end = vertices[static_cast<std::size_t>(chain.parent)];
        chain.end_value_m = field_.value_m[static_cast<std::size_t>(chain.parent)];
    } else {
        chain.facet = &planes_.facet(static_cast<std::uint32_t>(-1 - chain.parent));
    }
    return chain;
}

/// Whether a string keeps its bend on an edge: the edge is convex, both ends of the string leave
/// the solid there, and the straight way between them runs through it.
/// @param place          of the edge among those that leave the vertex `from`
/// @param before, after  where the string comes from and goes, from the bend [m]
bool BendSlider::holds(std::uint32_t from, std::size_t place, const Eigen::Vector3d& before,
                       const Eigen::Vector3d& after) const {
    constexpr double kLeaves = 0.1;    // sine: between vertices a string may dip below a face
    constexpr double kPresses = 1e-5;  // sine: a string along a face does not press on it
    const std::uint32_t to = ground_.neighbours.of(from)[place];
    const auto back = ground_.neighbours.of(to);
    const auto twin = std::ranges::find(back, from) - back.begin();
    if (twin == static_cast<std::ptrdiff_t>(back.size())) return false;
    const TriangleMesh& mesh = ground_.mesh;
    const auto normal_beside = [&](std::uint32_t vertex, std::size_t edge) -> const auto& {
        return ground_.corners[ground_.neighbours.faces_of(vertex)[edge]].normal;
    };
    const Eigen::Vector3d& left = normal_beside(from, place);
    const Eigen::Vector3d& right = normal_beside(to, static_cast<std::size_t>(twin));
    const Eigen::Vector3d along = (mesh.vertices[to] - mesh.vertices[from]).stableNormalized();
    if (left.dot(along.cross(right)) > 0.0) return false;  // concave
    const double near = before.norm(), far = after.norm();
    const auto leaves = [&](const Eigen::Vector3d& end, double length) {
        return std::max(end.dot(left), end.dot(right)) >= -kLeaves * length;
    };
    if (!leaves(before, near) || !leaves(after, far)) return false;
    // Shares of the straight way that lie below each face.
    double first = 0.0, last = 1.0;
    for (const Eigen::Vector3d& normal : {left, right}) {
        const double low = before.dot(normal) + kPresses * near;
        const double high = after.dot(normal) + kPresses * far;
        if (low >= 0.0 && high >= 0.0) return false;
        if (low > 0.0) first = std::max(first, low / (low - high));
        if (high > 0.0) last = std::min(last, low / (low - high));
    }
    return first < last;
}

/// For each bend at a vertex the edge that holds it and along which the way shortens fastest.
/// @return [m] at most so much shorter does the way get before a bend reaches the end of its edge:
///         a convex length falls fastest where it starts. 0 where no bend has got an edge
double BendSlider::choose_edges(Chain& chain) const {
    double gain_m = 0.0;
    for (std::size_t i = 0; i < chain.bends.size(); ++i) {
        Bend& bend = chain.bends[i];
        if (bend.share > 0.0 && bend.share < 1.0) continue;
        if (bend.share >= 1.0) bend.from = bend.to;
        bend.share = 0.0;
        bend.to = bend.from;
        const Eigen::Vector3d before = chain.before(i) - bend.point;
        const Eigen::Vector3d after = chain.after(i);
        const Eigen::Vector3d pull = before.stableNormalized() + after.stableNormalized();
        constexpr double kTaut = 1e-7;  // sine of the angle that counts as none
        const auto neighbours = ground_.neighbours.of(bend.from);
        thread_local std::vector<std::pair<double, std::size_t>> gains;  // with the edges' places
        gains.clear();
        for (std::size_t place = 0; place < neighbours.size(); ++place) {
            const Eigen::Vector3d edge = ground_.mesh.vertices[neighbours[place]] - bend.point;
            const double gain = pull.dot(edge) / edge.norm();
            if (gain > kTaut) gains.emplace_back(-gain, place);
        }
        std::ranges::sort(gains);
        double best = 0.0;
        for (const auto& [less, place] : gains) {
            if (!holds(bend.from, place, before, after)) continue;
            best = -less;
            bend.to = neighbours[place];
            break;
        }
        if (bend.to != bend.from) {
            gain_m += best * (ground_.mesh.vertices[bend.to] - bend.point).norm();
        }
    }
    return gain_m;
}

/// Moves one bend to where the way is shortest with the others held.
void BendSlider::place(Chain& chain, std::size_t i) const {
    Bend& bend = chain.bends[i];
    const Eigen::Vector3d& base = ground_.mesh.vertices[bend.from];
    const Eigen::Vector3d edge = ground_.mesh.vertices[bend.to] - base;
    const double length_m = edge.norm();
    const Eigen::Vector3d along = edge / length_m;
    const bool is_last = i + 1 == chain.bends.size();
    double at_m = 0.0;
    if (is_last && chain.facet != nullptr) {
        at_m = shortest_to_plane(base, along, chain.before(i), chain.facet->normal);
    } else {
        const Eigen::Vector3d& next = is_last ? chain.end : chain.bends[i + 1].point;
        at_m = shortest_crossing(base, along, chain.before(i), next);
    }
    bend.share = std::clamp(at_m / length_m, 0.0, 1.0);
    bend.point = base + bend.share * edge;
}

/// Moves the bends in turn until the way hardly gets shorter: the length is convex, so they settle
/// where all of them together make it least.
void BendSlider::settle(Chain& chain) const {
    double known_m = chain.length_m();
    for (int round = 0; round < kSettleRounds; ++round) {
        for (std::size_t i = 0; i < chain.bends.size(); ++i) {
            if (chain.bends[i].from != chain.bends[i].to) place(chain, i);
        }
        const double length_m = chain.length_m();
        if (known_m - length_m <= kSettled * length_m) return;
        known_m = length_m;
    }
}

/// Slides all bends, from edge to edge, until none has an edge to go on along.
void BendSlider::relax(Chain& chain) const {
    const double least_m = kLeastSlide * chain.length_m();
    for (int round = 0; round < kEdgeRounds && choose_edges(chain) > least_m; ++round) {
        settle(chain);
    }
}

Eigen::Vector3d BendSlider::lifted(const Bend& bend) const {
    if (bend.share <= 0.0) return ground_.lifted[bend.from];
    if (bend.share >= 1.0) return ground_.lifted[bend.to];
    const Eigen::Vector3d normal =
        (1.0 - bend.share) * ground_.normals[bend.from] + bend.share * ground_.normals[bend.to];
    return bend.point + ground_.offset_m * normal.stableNormalized();
}

Eigen::Vector3d BendSlider::lifted_before(std::uint32_t vertex, const Chain& chain,
                                          std::size_t i) const {
    return i == 0 ? ground_.lifted[vertex] : lifted(chain.bends[i - 1]);
}

/// Whether the segment from a lifted point to bend i, or to what follows the last one, is free.
bool BendSlider::sees(const Eigen::Vector3d& from, const Chain& chain, std::size_t i) const {
    const auto target = [&]() -> Eigen::Vector3d {
        if (i < chain.bends.size()) return lifted(chain.bends[i]);
        if (chain.facet != nullptr) return beyond_plane(*chain.facet, from, ground_.offset_m);
        return ground_.lifted[static_cast<std::size_t>(chain.parent)];
    };
    return !bvh_.segment_blocked(from, target(), blockers_[chain.vertex]);
}

/// The first segment that meets the surface: i ends at bend i; kNone where all are free.
std::size_t BendSlider::first_blocked(std::uint32_t vertex, const Chain& chain) const {
    for (std::size_t i = 0; i <= chain.bends.size(); ++i) {
        if (!sees(lifted_before(vertex, chain, i), chain, i)) return i;
    }
    return kNone;
}

/// Takes out bends that no edge holds, now that the others have slid. @return whether there were
/// any
bool BendSlider::drop_bends(std::uint32_t vertex, Chain& chain) const {
    bool dropped = false;
    for (std::size_t i = 0; i < chain.bends.size();) {
        constexpr double kStraight = 1e-6;  // sine of the turn
        const Bend& bend = chain.bends[i];
        const Eigen::Vector3d turn =
            (chain.before(i) - bend.point).stableNormalized() + chain.after(i).stableNormalized();
        const bool stuck = bend.from == bend.to && turn.norm() > kStraight;
        if (stuck && sees(lifted_before(vertex, chain, i), chain, i + 1)) {
            chain.bends.erase(chain.bends.begin() + static_cast<std::ptrdiff_t>(i));
            dropped = true;
        } else {
            ++i;
        }
    }
    return dropped;
}

/// Where the segment that ends at bend i dips below an edge beside it, puts a bend on that edge: a
/// string that has slid off a vertex may lie over several of the vertex's edges.
bool BendSlider::insert_bend(Chain& chain, std::size_t i) const {
    if (i >= chain.bends.size() || chain.bends.size() >= 2 * kMostSliding) return false;
    const Eigen::Vector3d& from = chain.before(i);
    const Eigen::Vector3d& to = chain.bends[i].point;
    Bend best;
    double deepest_m = 0.0;
    const auto try_edges_at = [&](std::uint32_t hub) {
        const auto neighbours = ground_.neighbours.of(hub);
        for (std::size_t place = 0; place < neighbours.size(); ++place) {
            const Eigen::Vector3d& base = ground_.mesh.vertices[hub];
            const Eigen::Vector3d edge = ground_.mesh.vertices[neighbours[place]] - base;
            const double length_m = edge.norm();
            const double share = shortest_crossing(base, edge / length_m, from, to) / length_m;
            constexpr double kEnd = 1e-3;
            if (!(share > kEnd && share < 1.0 - kEnd)) continue;
            const Eigen::Vector3d point = base + share * edge;
            const double deep_m = (from - point).norm() + (to - point).norm() - (from - to).norm();
            if (deep_m <= deepest_m || !holds(hub, place, from - point, to - point)) continue;
            deepest_m = deep_m;
            best = {hub, neighbours[place], share, point};
        }
    };
    try_edges_at(chain.bends[i].from);
    if (chain.bends[i].to != chain.bends[i].from) try_edges_at(chain.bends[i].to);
    if (deepest_m == 0.0) return false;
    chain.bends.insert(chain.bends.begin() + static_cast<std::ptrdiff_t>(i), best);
    return true;
}

/// Moves bends that were at vertices back towards them.
void BendSlider::hold_back(Chain& chain, double share) const {
    for (Bend& bend : chain.bends) {
        if (bend.from == bend.to) continue;
        const Eigen::Vector3d& base = ground_.mesh.vertices[bend.from];
        bend.share *= share;
        bend.point = base + bend.share * (ground_.mesh.vertices[bend.to] - base);
    }
}

SlidWay BendSlider::slide(std::uint32_t vertex) const {
    SlidWay way{std::numeric_limits<double>::infinity(), {}, 0};
    if (field_.parent[vertex] < 0) return way;
    const double most_m = field_.value_m[vertex] * (1.0 - kLeastShortening);
    Chain chain = chain_of(vertex);
    relax(chain);
    if (!(chain.length_m() < most_m)) return way;
    if (drop_bends(vertex, chain)) relax(chain);
    const Chain slid = chain;
    std::size_t blocked = first_blocked(vertex, chain);
    for (int round = 0; round < kInsertions && blocked != kNone; ++round) {
        if (!insert_bend(chain, blocked)) break;
        settle(chain);
        relax(chain);
        if (drop_bends(vertex, chain)) relax(chain);
        blocked = first_blocked(vertex, chain);
    }
    double share = 1.0;
    for (int round = 0; round < kHoldBacks && blocked != kNone; ++round) {
        chain = slid;
        hold_back(chain, share *= 0.5);
        blocked = first_blocked(vertex, chain);
    }
    way.value_m = chain.length_m();
    if (blocked != kNone || !(way.value_m < most_m)) {
        way.value_m = std::numeric_limits<double>::infinity();
        return way;
    }
    way.parent = chain.parent;
    for (const Bend& bend : chain.bends) way.bends.push_back({bend.point, lifted(bend), 0});
    return way;
}

SlidWay BendSlider::tilt(std::uint32_t vertex) const {
    SlidWay way{std::numeric_limits<double>::infinity(), {}, 0};
    std::int32_t end = field_.parent[vertex];
    if (end < 0) return way;
    while (end >= 0) end = field_.parent[static_cast<std::size_t>(end)];
    const HullFacet& below = planes_.facet(static_cast<std::uint32_t>(-1 - end));
    const Eigen::Vector3d& normal = below.normal;
    const Eigen::Vector3d& start = ground_.lifted[vertex];
    Eigen::Vector3d side = ground_.normals[vertex] - ground_.normals[vertex].dot(normal) * normal;
    const double lean = side.norm();  // sine of the wall's angle to the plane
    const double depth_m = below.offset_m - normal.dot(ground_.mesh.vertices[vertex]);
    const double most_m = field_.value_m[vertex] * (1.0 - kLeastTiltGain);
    if (!(depth_m > ground_.offset_m && depth_m < most_m) || lean < kLeastLean) return way;
    side /= lean;
    const auto direction = [&](double tangent) {
        return Eigen::Vector3d((normal + tangent * side).normalized());
    };
    const auto is_clear = [&](double tangent) {
        const double length_m = depth_m * std::sqrt(1.0 + tangent * tangent) + ground_.offset_m;
        return !bvh_.segment_blocked(start, start + length_m * direction(tangent),
                                     blockers_[vertex]);
    };
    double clear = std::sqrt(most_m * most_m / (depth_m * depth_m) - 1.0), blocked = 0.0;
    if (!is_clear(clear)) return way;
    for (int round = 0; round < kTiltRounds; ++round) {
        const double middle = 0.5 * (clear + blocked);
        (is_clear(middle) ? clear : blocked) = middle;
    }
    const Eigen::Vector3d out = direction(clear);
    const std::uint32_t facet = planes_.exit(ground_.mesh.vertices[vertex], out);
    const HullFacet& plane = planes_.facet(facet);
    const double slope = plane.normal.dot(out);
    if (!(slope > kLeastSlope)) return way;
    const double length_m =
        (plane.offset_m - plane.normal.dot(ground_.mesh.vertices[vertex])) / slope;
    if (!(length_m > 0.0 && length_m < most_m)) return way;
    way.value_m = length_m;
    way.parent = -1 - static_cast<std::int32_t>(facet);
    const double tested_m = (plane.offset_m - plane.normal.dot(start) - ground_.offset_m) / slope;
    way.bends.push_back(
        {ground_.mesh.vertices[vertex] + length_m * out, start + std::max(0.0, tested_m) * out, 0});
    return way;
}

}  // namespace graspd::concavity_detail
