#include "bend_pool.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graspd/base/parallel.hpp"

namespace graspd::concavity_detail {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr float kMargin = 1e-6F;  // [units] that single precision stays within

/// The bends on the hull, or those off it.
std::vector<std::uint32_t> those(std::span<const std::uint32_t> bends, const PathGround& ground,
                                 const ConcavityField& field, bool on_hull) {
    std::vector<std::uint32_t> some;
    for (const std::uint32_t v : bends) {
        if ((field.value_m[v] <= ground.offset_m) == on_hull) some.push_back(v);
    }
    return some;
}

}  // namespace

BendPool::BendPool(const PathGround& ground, const HullPlaneTree& planes,
                   const ConcavityField& field, std::span<const std::uint32_t> bends)
    : ground_(ground), base_(ground.mesh.vertices[ground.order.front()]) {
    bends_.reserve(bends.size());
    for (const std::uint32_t bend : bends) bends_.push_back(static_cast<std::int32_t>(bend));
    quads_.resize((bends_.size() + 3) / 4);
    constexpr std::size_t kAtATime = 1024;
    for_blocks(4 * quads_.size(), kAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) fill_lane(i, planes, field);
    });
    const std::size_t blocks = (quads_.size() + kBlockQuads - 1) / kBlockQuads;
    blocks_.resize((blocks + 3) / 4);  // four blocks and their lanes are one thread's
    for_blocks(4 * blocks_.size(), kAtATime / kBlockQuads,
               [&](std::size_t first, std::size_t last) {
                   for (std::size_t b = first; b < last; ++b) enclose_block(b);
               });
}

void BendPool::fill_lane(std::size_t i, const HullPlaneTree& planes, const ConcavityField& field) {
    Quad& quad = quads_[i / 4];
    const auto lane = static_cast<Eigen::Index>(i % 4);
    const bool is_there = i < bends_.size();
    const auto bend = static_cast<std::size_t>(bends_[is_there ? i : 0]);
    const std::vector<Eigen::Vector3d>& vertices = ground_.mesh.vertices;
    const Eigen::Vector3d& normal = ground_.normals[bend];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        quad.at[axis][lane] =
            static_cast<float>((vertices[bend][a] - base_[a]) / ground_.diagonal_m);
        quad.normal[axis][lane] = static_cast<float>(normal[a]);
    }
    const std::int32_t next = field.parent[bend];
    const bool leads_on = is_there && next != ConcavityField::kNoParent;
    Eigen::Vector3d onward = Eigen::Vector3d::Zero();
    if (leads_on && next < 0) onward = planes.facet(static_cast<std::uint32_t>(-1 - next)).normal;
    if (leads_on && next >= 0) {
        onward = (vertices[static_cast<std::size_t>(next)] - vertices[bend]).stableNormalized();
    }
    quad.value[lane] =
        leads_on ? static_cast<float>(field.value_m[bend] / ground_.diagonal_m) : kNever;
    quad.outline[lane] = ground_.spread[bend] + static_cast<float>(kSlack);
    quad.onward[lane] = static_cast<float>(onward.dot(normal) - kSlack);
}

void BendPool::enclose_block(std::size_t b) {
    Blocks& blocks = blocks_[b / 4];
    const auto lane = static_cast<Eigen::Index>(b % 4);
    const std::size_t first = 4 * b * kBlockQuads;
    const std::size_t last = std::min(bends_.size(), first + 4 * kBlockQuads);
    const auto at = [&](std::size_t i, std::size_t axis) {
        return quads_[i / 4].at[axis][static_cast<Eigen::Index>(i % 4)];
    };
    std::array<float, 3> center{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float low = kNever, high = -kNever;
        for (std::size_t i = first; i < last; ++i) {
            low = std::min(low, at(i, axis));
            high = std::max(high, at(i, axis));
        }
        if (first < last) center[axis] = 0.5F * (low + high);
        blocks.center[axis][lane] = center[axis];
    }
    float radius = 0.0F, least_value = kNever;
    for (std::size_t i = first; i < last; ++i) {
        const float x = at(i, 0) - center[0], y = at(i, 1) - center[1], z = at(i, 2) - center[2];
        radius = std::max(radius, std::sqrt(x * x + y * y + z * z) + kMargin);
        least_value = std::min(least_value, quads_[i / 4].value[static_cast<Eigen::Index>(i % 4)]);
    }
    blocks.least[lane] = least_value - radius;
}

BendPool::Viewpoint BendPool::viewpoint(std::uint32_t v, double limit_m) const {
    Viewpoint from;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        from.at[axis] =
            static_cast<float>((ground_.mesh.vertices[v][a] - base_[a]) / ground_.diagonal_m);
        from.normal[axis] = static_cast<float>(ground_.normals[v][a]);
    }
    from.below = ground_.spread[v] + static_cast<float>(kSlack);
    from.limit = to_units(limit_m);
    return from;
}

float BendPool::to_units(double limit_m) const {
    return static_cast<float>(limit_m / ground_.diagonal_m) + kMargin;
}

/// Per block a length [units] that no way over one of its bends falls short of. @return the least
float BendPool::least_lengths(const Viewpoint& from, std::vector<float>& bounds) const {
    bounds.resize(4 * blocks_.size());
    Eigen::Array4f least = Eigen::Array4f::Constant(kNever);
    for (std::size_t q = 0; q < blocks_.size(); ++q) {
        const Blocks& blocks = blocks_[q];
        const Eigen::Array4f x = blocks.center[0] - from.at[0], y = blocks.center[1] - from.at[1],
                             z = blocks.center[2] - from.at[2];
        const Eigen::Array4f bound = (x * x + y * y + z * z).sqrt() + blocks.least;
        Eigen::Map<Eigen::Array4f>(bounds.data() + 4 * q) = bound;
        least = least.min(bound);
    }
    return least.minCoeff();
}

unsigned BendPool::promising(const Viewpoint& from, const Quad& quad) {
    const Eigen::Array4f x = quad.at[0] - from.at[0], y = quad.at[1] - from.at[1],
                         z = quad.at[2] - from.at[2];
    const Eigen::Array4f length = (x * x + y * y + z * z).sqrt();
    const Eigen::Array4f rise = x * from.normal[0] + y * from.normal[1] + z * from.normal[2];
    const Eigen::Array4f shorter = from.limit - length - quad.value;
    const Eigen::Array4f leaves = rise + from.below * length;
    const unsigned lanes = lanes_not_negative(shorter.min(leaves));
    if (lanes == 0) return 0;
    const Eigen::Array4f along = x * quad.normal[0] + y * quad.normal[1] + z * quad.normal[2];
    const Eigen::Array4f on_outline = quad.outline * length - along.abs();
    const Eigen::Array4f presses = along - quad.onward * length;
    return lanes & lanes_not_negative(on_outline.min(presses));
}

BendPools::BendPools(const PathGround& ground, const HullPlaneTree& planes,
                     const ConcavityField& field, std::span<const std::uint32_t> bends)
    : outer(ground, planes, field, those(bends, ground, field, true)),
      inner(ground, planes, field, those(bends, ground, field, false)) {}

}  // namespace graspd::concavity_detail
