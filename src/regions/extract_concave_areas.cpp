#include "graspd/regions/extract_concave_areas.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

std::optional<PlanError> check_input(std::span<const SurfaceSample> samples,
                                     double finger_thickness_m,
                                     const ExtractConcaveAreasConfig& config) {
    if (auto bad = validate(config, "extract_concave_areas.")) return bad;
    if (auto bad = check_positive("extract_concave_areas: finger_thickness_m", finger_thickness_m))
        return bad;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].concavity_m >= 0.0) continue;  // a NaN is not
        std::ostringstream text;
        text << "extract_concave_areas: samples[" << i
             << "].concavity_m = " << samples[i].concavity_m << " is not a length";
        return PlanError{PlanErrorCode::kInvalidInput, text.str()};
    }
    return std::nullopt;
}

}  // namespace

Result<ConcaveAreas> extract_concave_areas(std::span<const SurfaceSample> samples,
                                           double finger_thickness_m,
                                           const ExtractConcaveAreasConfig& config) {
    if (auto bad = check_input(samples, finger_thickness_m, config)) return *bad;
    double largest_m = 0.0;
    for (const SurfaceSample& sample : samples) {
        if (std::isfinite(sample.concavity_m)) largest_m = std::max(largest_m, sample.concavity_m);
    }
    const double least_m = config.min_depth_finger_thicknesses * finger_thickness_m;
    ConcaveAreas areas;
    areas.threshold_m = std::max(config.salient_fraction * largest_m, least_m);
    areas.enlarged_threshold_m = config.enlarged_fraction * areas.threshold_m;
    if (largest_m < least_m || !(largest_m > 0.0)) return areas;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        const double value_m = samples[i].concavity_m;
        if (!std::isfinite(value_m) || value_m < areas.enlarged_threshold_m) continue;
        areas.enlarged.push_back(i);
        if (value_m >= areas.threshold_m) areas.salient.push_back(i);
    }
    return areas;
}

}  // namespace graspd
