#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/regions/extract_concave_areas.hpp"

namespace graspd {

/// When samples belong to one concavity.
struct ClusterConcavitiesConfig {
    double tolerance_spacings = 2.5;     ///< [1] Euclidean tolerance in sample spacings
    std::uint32_t min_samples = 12;      ///< smaller clusters are noise
    std::uint32_t max_concavities = 16;  ///< the deepest ones are kept
    double enlargement_spacings = 5.0;   ///< [1] how far around a cluster its surroundings reach

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("tolerance_spacings", self.tolerance_spacings, 1.0, 20.0);
        visit("min_samples", self.min_samples, 4u, 100000u);
        visit("max_concavities", self.max_concavities, 1u, 1000u);
        visit("enlargement_spacings", self.enlargement_spacings, 0.0, 100.0);
    }
};

/// One salient concave region.
struct Concavity {
    std::vector<std::uint32_t> salient;   ///< rising indices of samples
    std::vector<std::uint32_t> enlarged;  ///< rising; the salient ones and their surroundings
    double depth_m = 0.0;                 ///< [m] greatest concavity in it
};

/// Splits the salient areas into concavities by Euclidean clustering.
///
/// Source: Lei & Wisse 2016, Sec. II-B, Fig. 4c; the enlarged set of each: Sec. II-D, Fig. 8a.
/// Deviation: the neighbours come from a grid of cells in double precision, not from PCL's tree,
/// which took thirty times as long; the clusters are the same.
///
/// @param samples    (N) as sample_surface gives them
/// @param areas      of the same samples
/// @param spacing_m  [m] usual distance of neighbours, > 0
/// @return concavities, deepest first (ties: more samples, then the lower first index), none when
///         no area is salient; a concavity's enlarged set holds the enlarged samples within
///         enlargement_spacings of one of its salient samples; kInvalidInput for a parameter or
///         length out of range or an index beyond N
/// Complexity O(N log N). Pure, so safe to call from any thread.
Result<std::vector<Concavity>> cluster_concavities(std::span<const SurfaceSample> samples,
                                                   const ConcaveAreas& areas, double spacing_m,
                                                   const ClusterConcavitiesConfig& config);

}  // namespace graspd
