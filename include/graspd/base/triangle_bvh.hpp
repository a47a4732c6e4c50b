#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/box_tree.hpp"
#include "graspd/base/geometry.hpp"

namespace graspd {

/// A box tree over triangles that answers ray and segment queries.
///
/// Watertight by an absolute tolerance: a ray within `tolerance_m` of a triangle's edge hits it, so
/// nothing leaks between neighbours however small they are. (A tolerance relative to the triangle
/// leaks above 20k faces; see docs/architecture.md.) Rays in a triangle's own plane do not hit it.
/// Boxes and, four at a time, triangles are sorted out in single precision with a margin for all
/// its roundings; what is left is judged in double precision. Immutable after construction, so safe
/// to query from any thread.
class TriangleBvh {
public:
    /// A place where a ray meets the surface.
    struct Hit {
        double distance_m = 0.0;   ///< [m] from the ray's origin
        std::uint32_t face = 0;    ///< index into the mesh's faces
        bool from_outside = true;  ///< the ray meets the face's outer side

        /// Becomes the nearest hit where it is that; of equally near ones, that of the lower face
        /// is. @return whether it did
        bool keep_if_nearer(std::optional<Hit>& nearest) const;
    };

    /// Copies what it needs of `mesh`; faces of zero area are never hit. Cost O(F log F).
    /// @param tolerance_m [m] >= 0, e.g. 1e-6 of the diagonal
    TriangleBvh(const TriangleMesh& mesh, double tolerance_m);

    /// Which triangles blocked a segment. What is asked next is often blocked by them too.
    struct Blocker {
        std::uint32_t pack = UINT32_MAX;  ///< none yet
    };

    /// True when some triangle meets the closed segment from `a` to `b` [m].
    bool segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

    /// The same; looks at what blocked an earlier segment first, which only saves time, and notes
    /// what blocks this one.
    bool segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         Blocker& blocker) const;

    /// The nearest hit within max_distance_m along the unit direction; ties by the lower face
    /// index.
    std::optional<Hit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                 double max_distance_m) const;

    /// What a line meets first from either end, as far as the other end.
    struct EndHits {
        std::optional<Hit> from_a, from_b;
    };
    /// Lines of one length side by side: along the pose's x axis, from `a` at -half_length_m to `b`
    /// at +half_length_m, at every pair of a y and a z.
    struct LineGrid {
        Eigen::Isometry3d pose;
        double half_length_m = 0.0;
        std::span<const double> y_m, z_m;  ///< [m] rising by even steps
    };
    /// For each line, row by row (all z of the first y, ...), what first_hit() says from `a` and,
    /// back, from `b`: one walk for all of them.
    std::vector<EndHits> hits_from_ends(const LineGrid& grid) const;

    /// All hits by rising distance (ties by face). Hits on a shared edge come once per face, unless
    /// they follow each other within the tolerance on the same side: then one stands for all.
    std::vector<Hit> all_hits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double max_distance_m) const;

    /// Faces that come within a distance of a box, and some that do not: those in tree boxes that
    /// no axis of either box separates from it. Rising indices.
    std::vector<std::uint32_t> faces_near(const OrientedBox& box, double within_m) const;

    /// True when the solid box and some triangle have a point in common; touching counts. With
    /// `way` the solid is everything that the box passes while it moves along it without turning.
    ///
    /// Exact up to the rounding of double precision (box_meets_triangle): triangles are sorted out
    /// four at a time in single precision with a margin for its rounding. Ends at the first hit.
    /// A box within the surface that touches no triangle does not meet it: see surrounds().
    /// @param way  [m] in the frame of the mesh
    bool meets_box(const OrientedBox& box,
                   const Eigen::Vector3d& way = Eigen::Vector3d::Zero()) const;

    /// True when a box that meets no triangle lies inside the closed surface.
    bool surrounds(const OrientedBox& box) const;

    /// True when the point [m] lies inside the closed surface: majority of three ray directions,
    /// each judged by the side of the first face that it meets; two that agree suffice.
    bool contains(const Eigen::Vector3d& point) const;

    /// [m] Around all triangles, padded by the tolerance; empty without triangles.
    const Eigen::AlignedBox3d& bounds() const { return bounds_; }

    /// Memory that this takes, with all that it owns [bytes].
    std::uint64_t bytes() const;

private:
    /// The up to four triangles of a leaf side by side, in the tree's units.
    struct Pack {
        std::array<Eigen::Array4f, 3> origin, edge1, edge2, normal;  ///< normal: edge2 x edge1
        Eigen::Array4f longest;  ///< edge; below zero where there is no triangle
        std::uint32_t first = 0, count = 0;
    };
    struct Ray;
    class GridWalk;
    struct Vicinity;
    /// A triangle's products round by less, over powers of its longest edge [units].
    static constexpr float kRounding = 2e-6F;

    void add_pack(std::uint32_t& leaf);
    static unsigned near_lanes(const Ray& ray, const Pack& pack, float reach, float margin);
    bool pack_blocks(const Ray& ray, const Pack& pack, float reach) const;
    static unsigned near_lanes(const Vicinity& vicinity, const Pack& pack);
    template <class Visit>
    bool visit_near(const Vicinity& vicinity, Visit&& visit) const;
    bool meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, std::uint32_t place,
               double reach, Hit& hit) const;
    template <bool kNearestFirst, class Visit>
    void traverse(const Ray& ray, double& reach, Visit&& visit) const;

    double tolerance_m_ = 0.0;
    Eigen::AlignedBox3d bounds_;  ///< [m] of the triangles, padded by the tolerance
    double diagonal_m_ = 0.0;     ///< [m] of bounds_
    double units_per_m_ = 0.0;
    Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< [m] of bounds_
    BoxTree tree_;                           ///< in units of the diagonal, from bounds_' middle
    std::vector<Eigen::Vector3d> vertices_;  ///< [m]
    std::vector<Triangle> faces_;            ///< in the order of the packs
    std::vector<std::uint32_t> number_;      ///< in the mesh, of the face at a place
    float margin_ = 0.0F;                    ///< that the tolerance and all roundings stay within
    std::vector<Pack> packs_;                ///< the leaves name places here
};

}  // namespace graspd
