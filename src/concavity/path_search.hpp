#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "graspd/concavity/shortest_path_concavity.hpp"
#include "path_ground.hpp"

namespace graspd::concavity_detail {

struct BendPools;

/// The working state of shortest_path_concavity, which shows the order of the steps. Steps that run
/// on several threads read the ways found so far and write new ones aside, so their result does not
/// depend on the threads.
class PathSearch {
public:
    PathSearch(const PathGround& ground, const HullPlaneTree& planes, const TriangleBvh& bvh,
               const ConcavityConfig& config);

    void prove_direct();
    void propagate_inwards();
    void reach_what_no_edge_reaches();
    void shorten_across_the_void();
    void slide_bends();
    ConcavityField take();

private:
    static constexpr std::size_t kVerticesAtATime = 128;  ///< of one thread
    static constexpr int kAllDirections = 32;             ///< of a look around

    struct QueueItem {
        double value_m;
        std::uint32_t vertex;
        bool operator>(const QueueItem& other) const {
            return value_m != other.value_m ? value_m > other.value_m : vertex > other.vertex;
        }
    };
    /// A way out of some vertex that is better than what was known.
    struct Way {
        double value_m;
        std::int32_t parent;
    };
    class Shortlist;

    bool finished(std::uint32_t v) const { return std::isfinite(field_.value_m[v]); }
    bool unreached(std::uint32_t v) const { return field_.flag[v] == ConcavityFlag::kEnclosed; }
    Way known(std::uint32_t v) const { return {field_.value_m[v], field_.parent[v]}; }

    double length_through(std::uint32_t v, std::int32_t parent) const;
    bool sees(std::uint32_t v, std::int32_t parent);
    bool consider(std::uint32_t v, std::int32_t parent, Way& way);
    bool consider_beside(std::uint32_t v, std::int32_t bend, Way& way);
    void straighten(std::uint32_t v, Way& way);
    bool consider_over(std::uint32_t v, std::uint32_t from, Way& way);
    bool accept(std::uint32_t v, const Way& way);
    void propagate();
    void take_band(double most_m);
    void relax_band();

    std::vector<std::uint32_t> unreached_region(std::uint32_t seed, std::vector<char>& seen) const;
    bool look_around(std::uint32_t v, std::size_t lookout, int count, Way& way);
    bool probe_unreached();

    std::vector<std::uint32_t> bent_vertices() const;
    std::vector<std::uint32_t> possible_bends() const;
    std::vector<std::uint32_t> most_used_bends() const;
    bool consider_listed(std::uint32_t v, const Shortlist& list, Way& way);
    void consider_hiding(std::uint32_t v, std::int32_t bend, Way& way);
    void consider_planes(std::uint32_t v, Way& way);
    void consider_pool(std::uint32_t v, const BendPools& pools, std::size_t tries, Way& way);
    std::vector<std::uint32_t> bends_to_shorten() const;
    void shorten_bends(const std::vector<std::uint32_t>& bends);
    void shorten_bends_again(const std::vector<double>& known_m);
    void shorten_all(const std::vector<std::uint32_t>& bent);
    std::vector<char> improve(
        const std::vector<std::uint32_t>& vertices,
        const std::function<void(std::uint32_t v, std::size_t place, Way& way)>& search);

    const PathGround& ground_;
    const HullPlaneTree& planes_;
    const TriangleBvh& bvh_;
    const ConcavityConfig& config_;
    std::vector<std::int32_t> failed_;            ///< ring of hidden parents per vertex
    std::vector<TriangleBvh::Blocker> blockers_;  ///< per vertex, of rays from there
    std::vector<std::uint32_t> relaxations_;
    std::uint32_t probes_ = 0;
    /// Vertices next to those of a band of values, with these neighbours, in the order of values.
    struct Band {
        static constexpr std::uint32_t kEnd = UINT32_MAX;
        struct Link {
            std::uint32_t from, next;
        };
        std::vector<std::uint32_t> targets, first, last;  ///< first and last link per vertex
        std::vector<Link> links;
        std::vector<Way> ways;  ///< per target
    };
    Band band_;
    std::priority_queue<QueueItem, std::vector<QueueItem>, std::greater<>> queue_;
    ConcavityField field_;
};

}  // namespace graspd::concavity_detail
