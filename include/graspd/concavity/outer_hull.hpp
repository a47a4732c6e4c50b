#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/box_tree.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// One flat face of a convex hull, coplanar triangles merged.
struct HullFacet {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward unit normal
    double offset_m = 0.0;    ///< [m] normal . p <= offset_m holds for every point of the hull
    Eigen::AlignedBox3d box;  ///< [m] of the facet's vertices
};

/// The convex hull of a point set.
struct OuterHull {
    std::vector<HullFacet> facets;
    std::vector<std::uint32_t> vertices;  ///< rising indices of the points that span it
    double volume_m3 = 0.0;               ///< [m^3]
};

/// The proper outer convex hull of the mesh's vertices, by qhull with merged facets.
///
/// Source: Lei & Wisse 2016, Sec. II-A, Fig. 3c.
/// @param points  (N, N >= 4) finite [m], any frame
/// @return kDegenerate with qhull's reason for fewer than 4 points or coplanar ones
/// Complexity O(N log N). Pure.
Result<OuterHull> outer_hull(std::span<const Eigen::Vector3d> points);

/// Answers "how far is it from a point inside to the nearest hull plane" by a box tree over the
/// facets. For a point inside this is the exact distance to the hull's surface. Immutable after
/// construction, so safe to query from any thread.
class HullPlaneTree {
public:
    struct Nearest {
        double distance_m = 0.0;  ///< [m] >= 0; 0 for a point on or slightly outside the hull
        std::uint32_t facet = 0;
    };
    /// Copies the facets. Precondition: at least one.
    explicit HullPlaneTree(const OuterHull& hull);

    /// The facet whose plane is nearest; ties by the lower index.
    /// @param hint  a facet that may be near, such as a neighbouring point's: it only saves time
    Nearest nearest(const Eigen::Vector3d& point, std::uint32_t hint = 0) const;

    /// The same for points near one another, at a fraction of the cost.
    /// @param nearest  one place a point
    void nearest(std::span<const Eigen::Vector3d> points, std::span<Nearest> nearest) const;

    /// Every facet whose plane is nearer than a limit, whose normal leads away from the point's
    /// surface and on which the foot of the perpendicular comes to lie; and some that miss one of
    /// these by a little. Where there are more than `most`, those that are not among the nearest
    /// `most` may be left out. In no order that means anything.
    /// @param normal   of the surface at the point, of unit length
    /// @param below    [1] sine of how far below the surface's plane a way may lead
    /// @param beside_m [m] how far from the facet's box the foot may lie
    /// @param most     1 to kMostAhead
    void facets_ahead(const Eigen::Vector3d& point, double limit_m, const Eigen::Vector3d& normal,
                      double below, double beside_m, std::size_t most,
                      std::vector<std::uint32_t>& facets) const;
    static constexpr std::size_t kMostAhead = 64;

    /// The facet by whose plane a ray from inside leaves the hull; ties by the lower index, 0 where
    /// rounding leaves none.
    std::uint32_t exit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

    const HullFacet& facet(std::uint32_t index) const { return facets_[index]; }
    std::size_t size() const { return facets_.size(); }

private:
    /// The up to four facets of a leaf side by side, in the tree's units.
    struct Pack {
        std::array<Eigen::Array4f, 3> normal;
        Eigen::Array4f offset;                         ///< infinite where there is no facet
        std::array<Eigen::Array4f, 3> center, extent;  ///< of the facets' boxes, half of it
        std::array<std::uint32_t, 4> facet{};

        Eigen::Array4f distances(const Eigen::Array4f& unit) const {
            return offset - normal[0] * unit[0] - normal[1] * unit[1] - normal[2] * unit[2];
        }
    };
    struct Vicinity;  ///< planes that may be the nearest of some point in a ball

    void add_pack(std::uint32_t& leaf);
    bool gather(const Eigen::Vector3d& middle, double radius_m, std::uint32_t near,
                Vicinity& vicinity) const;
    Nearest nearest_of(const Vicinity& vicinity, const Eigen::Vector3d& point) const;
    Eigen::Array4f to_units(const Eigen::Vector3d& point) const;

    Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< [m] of all facets' boxes
    double diagonal_m_ = 0.0;                           ///< [m] of all facets' boxes
    BoxTree tree_;                                      ///< in units of the diagonal from middle_
    std::vector<Pack> packs_;                           ///< the leaves name places here
    std::vector<HullFacet> facets_;
};

}  // namespace graspd
