#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "support/concavity_run.hpp"
#include "support/exact_surface.hpp"

namespace graspd::test {

/// What exact predicates find about the ways of a concavity field.
struct PathCertificate {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    std::size_t vertices = 0;         ///< that faces use
    std::size_t exact = 0;            ///< of them flagged exact
    std::size_t enclosed = 0;         ///< of them without a way out
    std::size_t paths = 0;            ///< of vertices further in than two lifts
    std::size_t segments = 0;         ///< different ones of those paths
    std::size_t blocked = 0;          ///< of the segments
    std::size_t wrong_lengths = 0;    ///< escape paths whose length is not the value
    std::size_t wrong_ends = 0;       ///< that do not lead from the vertex to the hull
    std::size_t strayed = 0;          ///< whose tested path runs elsewhere than the escape path
    std::size_t not_exact = 0;        ///< flagged exact, and another hull plane is nearer
    std::uint32_t first_bad = kNone;  ///< a vertex counted in one of the five above
};

/// Walks every vertex's way and tests each segment once.
PathCertificate certify_paths(const TriangleMesh& mesh, const ConcavityRun& run,
                              const ExactSurface& surface);

}  // namespace graspd::test
