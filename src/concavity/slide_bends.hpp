#pragma once

#include <cstdint>
#include <vector>

#include "path_ground.hpp"

namespace graspd::concavity_detail {

/// A vertex's way out after its bends have slid.
struct SlidWay {
    double value_m = 0.0;         ///< [m] infinite when nothing was gained
    std::vector<EdgeBend> bends;  ///< in the order of the way; parents are filled by take_slid
    std::int32_t parent = 0;      ///< what follows the last one
};

/// Shortens ways by sliding all their bends along mesh edges at once: in terms of the bends' places
/// on the edges a way's length is convex, and with the others held each place has a closed form
/// (unfold the two faces of the bend into one plane). Reads the ways alone, so any number of
/// threads may use it.
class BendSlider {
public:
    /// @param field  ways over vertices, without edge bends
    /// @param blockers  per vertex, of rays from there; a vertex's is its thread's alone
    BendSlider(const PathGround& ground, const HullPlaneTree& planes, const TriangleBvh& bvh,
               const ConcavityField& field, std::vector<TriangleBvh::Blocker>& blockers);

    /// A free way from the vertex that is shorter than the field's.
    SlidWay slide(std::uint32_t vertex) const;

    /// A straight free way that leaves the hull aslant and is shorter than the field's bent one:
    /// where a rough wall blocks the perpendicular, the least tilt away from the wall that clears
    /// it.
    SlidWay tilt(std::uint32_t vertex) const;

private:
    /// A bend on its way: at `from`, or between there and `to`.
    struct Bend {
        std::uint32_t from = 0, to = 0;
        double share = 0.0;  ///< [0, 1] of the way from `from` to `to`
        Eigen::Vector3d point;
    };
    /// Vertex, bends and what they end on, a vertex with a value or a facet's plane.
    struct Chain {
        Eigen::Vector3d start, end;
        std::uint32_t vertex = 0;
        std::vector<Bend> bends;
        const HullFacet* facet = nullptr;
        std::int32_t parent = 0;
        double end_value_m = 0.0;

        double length_m() const;
        const Eigen::Vector3d& before(std::size_t i) const;
        Eigen::Vector3d after(std::size_t i) const;
    };

    Chain chain_of(std::uint32_t vertex) const;
    bool holds(std::uint32_t from, std::size_t place, const Eigen::Vector3d& before,
               const Eigen::Vector3d& after) const;
    double choose_edges(Chain& chain) const;
    void settle(Chain& chain) const;
    void relax(Chain& chain) const;
    void place(Chain& chain, std::size_t i) const;
    Eigen::Vector3d lifted_before(std::uint32_t vertex, const Chain& chain, std::size_t i) const;
    bool sees(const Eigen::Vector3d& from, const Chain& chain, std::size_t i) const;
    bool drop_bends(std::uint32_t vertex, Chain& chain) const;
    std::size_t first_blocked(std::uint32_t vertex, const Chain& chain) const;
    bool insert_bend(Chain& chain, std::size_t i) const;
    void hold_back(Chain& chain, double share) const;
    Eigen::Vector3d lifted(const Bend& bend) const;

    const PathGround& ground_;
    const HullPlaneTree& planes_;
    const TriangleBvh& bvh_;
    const ConcavityField& field_;
    std::vector<TriangleBvh::Blocker>& blockers_;
};

/// Writes a slid way into the field.
void take_slid(const SlidWay& way, std::uint32_t vertex, ConcavityField& field);

/// Length of a vertex's way over its edge bends to the next vertex, whose value counts, or to the
/// hull [m].
double length_of_way(const ConcavityField& field, const PathGround& ground,
                     const HullPlaneTree& planes, std::uint32_t vertex);

}  // namespace graspd::concavity_detail
