#pragma once

#include <array>
#include <cstdint>
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
    /// string would press onto the solid there.
    template <class Visit>
    void visit_promising(std::uint32_t v, double limit_m, Visit&& visit) const {
        const Viewpoint from = viewpoint(v, limit_m);
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            if (is_too_far(from, blocks_[b])) continue;
            const std::size_t last = std::min(quads_.size(), (b + 1) * kBlockQuads);
            for (std::size_t q = b * kBlockQuads; q < last; ++q) {
                unsigned lanes = promising(from, quads_[q]);
                while (lanes != 0) visit(bends_[4 * q + take_lane(lanes)]);
            }
        }
    }

private:
    static constexpr std::size_t kBlockQuads = 4;

    /// Four bends in units of the diagonal.
    struct Quad {
        std::array<Eigen::Array4f, 3> at, normal;
        Eigen::Array4f value;    ///< infinite where there is none
        Eigen::Array4f outline;  ///< sine of the widest angle to the outline, with the slack
        Eigen::Array4f onward;   ///< normal . direction of the way that goes on, less the slack
    };
    struct Block {
        std::array<float, 3> center{};
        float radius = 0.0F, least_value = 0.0F;
    };
    struct Viewpoint {
        std::array<float, 3> at{}, normal{};
        float below = 0.0F;  ///< how far below the normal's plane ways may lead [1], a sine
        float limit = 0.0F;  ///< [units]
    };

    Viewpoint viewpoint(std::uint32_t v, double limit_m) const;
    static bool is_too_far(const Viewpoint& from, const Block& block);
    static unsigned promising(const Viewpoint& from, const Quad& quad);
    void fill_lane(std::size_t i, const HullPlaneTree& planes, const ConcavityField& field);
    void enclose_block(std::size_t b);

    const PathGround& ground_;
    Eigen::Vector3d base_ = Eigen::Vector3d::Zero();  ///< [m] from where the units are measured
    std::vector<std::int32_t> bends_;
    std::vector<Quad> quads_;
    std::vector<Block> blocks_;
};

}  // namespace graspd::concavity_detail
