#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// What counts as concave. The paper leaves both thresholds open.
struct ExtractConcaveAreasConfig {
    double salient_fraction = 0.5;  ///< [1] salient from this share of the largest concavity on
    /// [1] enlarged from this share of the salience threshold on; 0: all that lies around
    double enlarged_fraction = 0.0;
    /// [1] least salience threshold in finger thicknesses: what no finger can use is no concavity
    double min_depth_finger_thicknesses = 0.5;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("salient_fraction", self.salient_fraction, 0.01, 1.0);
        visit("enlarged_fraction", self.enlarged_fraction, 0.0, 1.0);
        visit("min_depth_finger_thicknesses", self.min_depth_finger_thicknesses, 0.0, 100.0);
    }
};

/// The concave part of a surface at one threshold.
struct ConcaveAreas {
    double threshold_m = 0.0;             ///< [m] salient samples have at least this concavity
    double enlarged_threshold_m = 0.0;    ///< [m] enlarged ones at least this
    std::vector<std::uint32_t> salient;   ///< rising indices of samples
    std::vector<std::uint32_t> enlarged;  ///< rising; holds every salient one too
};

/// Cuts out the most concave areas by a threshold, and their less concave surroundings.
///
/// Source: Lei & Wisse 2016, Sec. II-B, Figs. 4a-b; the enlarged set: Sec. II-D, Fig. 8a.
/// Deviation: the threshold follows from the largest concavity and the finger's thickness (open in
/// the paper); samples that no path reaches (infinite concavity) belong to neither set.
///
/// @param samples             (N) as sample_surface gives them
/// @param finger_thickness_m  [m] > 0
/// @return the sets; both empty for a convex object, whose largest concavity lies below the least
///         threshold; kInvalidInput for a parameter, length or value out of range (NaN, negative)
/// Complexity O(N). Pure, so safe to call from any thread.
Result<ConcaveAreas> extract_concave_areas(std::span<const SurfaceSample> samples,
                                           double finger_thickness_m,
                                           const ExtractConcaveAreasConfig& config);

}  // namespace graspd
