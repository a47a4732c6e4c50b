#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "graspd/base/lanes.hpp"
#include "path_ground.hpp"

namespace graspd::concavity_detail {

/// Vertices that may be the next bend of other vertices' ways, as the ways stood when the pool was
/// made: side by side in single precision, near ones together, so that those that cannot shorten a
/// way are passed over by the dozen.
class BendPool {
public:
    /// Slack of all directions [1], a sine: the lift lets ways start a little below a face.
    static constexpr double kSlack = 0.1;

    /// @param bends  finished vertices, near ones together
    BendPool(const PathGround& ground, const HullPlaneTree& planes, const ConcavityField& field,
             std::span<const std::uint32_t> bends);

    std::size_t size() const { return bends_.size(); }

    /// Calls visit(bend) for every bend over which v's way might be shorter than limit_m and taut:
    /// the straight way leaves the solid at v, the bend lies on the outline seen from v, and the
    /// string would press onto the solid there. Each call returns the limit from then on [m].
    template <class Visit>
    void visit_promising(std::uint32_t v, double limit_m, Visit&& visit) const {
        Viewpoint from = viewpoint(v, limit_m);
        thread_local std::vector<float> bounds;  // one allocation a thread instead of a vertex
        // First where ways may be shortest: what is found there lowers the limit for all others.
        float done = -std::numeric_limits<float>::infinity();
        const float least = least_lengths(from, bounds);
        for (float next = least + kFirstShare * (from.limit - least); done < from.limit;
             done = next, next = std::numeric_limits<float>::infinity()) {
            for (std::size_t b = 0; b < bounds.size(); ++b) {
                if (bounds[b] <= done || bounds[b] > std::min(next, from.limit)) continue;
                visit_block(from, b, visit);
            }
        }
    }

private:
    static constexpr std::size_t kBlockQuads = 4;
    static constexpr float kFirstShare = 0.25F;  ///< of the span between least length and limit

    /// Four bends in units of the diagonal.
    struct Quad {
        std::array<Eigen::Array4f, 3> at, normal;
        Eigen::Array4f value;    ///< infinite where there is none
        Eigen::Array4f outline;  ///< sine of the widest angle to the outline, with the slack
        Eigen::Array4f onward;   ///< normal . direction of the way that goes on, less the slack
    };
    /// Balls around the bends of four blocks.
    struct Blocks {
        std::array<Eigen::Array4f, 3> center;
        Eigen::Array4f least;  ///< value of a bend less the radius; infinite where there is none
    };
    struct Viewpoint {
        std::array<float, 3> at{}, normal{};
        float below = 0.0F;  ///< how far below the normal's plane ways may lead [1], a sine
        float limit = 0.0F;  ///< [units]
    };

    Viewpoint viewpoint(std::uint32_t v, double limit_m) const;
    template <class Visit>
    void visit_block(Viewpoint& from, std::size_t b, Visit&& visit) const {
        const std::size_t last = std::min(quads_.size(), (b + 1) * kBlockQuads);
        for (std::size_t q = b * kBlockQuads; q < last; ++q) {
            unsigned lanes = promising(from, quads_[q]);
            while (lanes != 0) from.limit = to_units(visit(bends_[4 * q + take_lane(lanes)]));
        }
    }
    float to_units(double limit_m) const;
    float least_lengths(const Viewpoint& from, std::vector<float>& bounds) const;
    static unsigned promising(const Viewpoint& from, const Quad& quad);
    void fill_lane(std::size_t i, const HullPlaneTree& planes, const ConcavityField& field);
    void enclose_block(std::size_t b);

    const PathGround& ground_;
    Eigen::Vector3d base_ = Eigen::Vector3d::Zero();  ///< [m] from where the units are measured
    std::vector<std::int32_t> bends_;
    std::vector<Quad> quads_;
    std::vector<Blocks> blocks_;
};

/// Bends on the hull apart from the others: where they are near, behind a wall, they would crowd
/// out all others.
struct BendPools {
    BendPools(const PathGround& ground, const HullPlaneTree& planes, const ConcavityField& field,
              std::span<const std::uint32_t> bends);

    std::size_t size() const { return outer.size() + inner.size(); }

    BendPool outer, inner;
};

}  // namespace graspd::concavity_detail
