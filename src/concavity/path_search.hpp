#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "graspd/concavity/shortest_path_concavity.hpp"
#include "vertex_fans.hpp"

namespace graspd::concavity_detail {

/// The working state of shortest_path_concavity, which shows the order of the steps.
class PathSearch {
public:
    PathSearch(const TriangleMesh& mesh, const OuterHull& hull, const TriangleBvh& bvh,
               const ConcavityConfig& config);

    void mark_unreferenced();
    void prove_direct();
    void propagate_inwards();
    void reach_what_no_edge_reaches();
    void shorten_across_the_void();
    ConcavityField take();

private:
    struct QueueItem {
        double value_m;
        std::uint32_t vertex;
        bool operator>(const QueueItem& other) const {
            return value_m != other.value_m ? value_m > other.value_m : vertex > other.vertex;
        }
    };

    bool finished(std::uint32_t v) const { return std::isfinite(field_.value_m[v]); }
    bool unreached(std::uint32_t v) const { return field_.flag[v] == ConcavityFlag::kEnclosed; }

    void propagate();
    bool probe_unreached();
    bool probe_bends();
    double length_through(std::uint32_t v, std::int32_t parent) const;
    bool sees(std::uint32_t v, std::int32_t parent) const;
    bool try_parent(std::uint32_t v, std::int32_t parent);
    bool relax(std::uint32_t from, std::uint32_t to);
    bool try_beside(std::uint32_t v, std::int32_t bend);
    void pull(std::uint32_t v);
    std::vector<std::uint32_t> unreached_region(std::uint32_t seed, std::vector<char>& seen) const;
    bool probe(std::uint32_t v);

    const TriangleMesh& mesh_;
    const TriangleBvh& bvh_;
    const ConcavityConfig& config_;
    HullPlaneTree planes_;
    VertexNeighbours neighbours_;
    double diagonal_m_, offset_m_;
    std::vector<Eigen::Vector3d> normals_;
    std::vector<Eigen::Vector3d> start_;  ///< vertices lifted off the surface: where paths run
    std::vector<std::int32_t> failed_;    ///< ring of hidden parents per vertex
    std::vector<std::uint32_t> relaxations_;
    std::uint32_t probes_ = 0;
    std::priority_queue<QueueItem, std::vector<QueueItem>, std::greater<>> queue_;
    ConcavityField field_;
};

}  // namespace graspd::concavity_detail
