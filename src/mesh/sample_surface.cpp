#include "graspd/mesh/sample_surface.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"
#include "graspd/base/stop.hpp"
#include "grid_scan.hpp"

namespace graspd {
namespace {

using mesh_detail::faces_to_scan;
using mesh_detail::precedes;
using mesh_detail::rows_of;
using mesh_detail::scan_faces;
using mesh_detail::ScanFace;

// Coordinates beyond it have lost the grid's digits, and no hand serves such an object.
constexpr double kMaxGridIndex = 1e7;
// A scan of a hundred million grid rows takes about a second.
constexpr double kMaxRows = 1e8;
// A spacing that grows does so in steps of this share, so that the rounding of the surface's area
// cannot shift the grid.
constexpr double kGrowthStep = 1e-4;
constexpr double kOrderUnit = 1e-6;  // [1] of the spacing: far above rounding, far below detail

PlanError error(PlanErrorCode code, const std::string& detail) {
    return {code, "sample_surface: " + detail};
}

/// What is wrong with a corner of a face, if anything.
std::string complaint(const TriangleMesh& mesh, std::span<const double> value_m, std::size_t face,
                      std::uint32_t v) {
    std::ostringstream text;
    if (v >= mesh.vertices.size()) {
        text << "face " << face << " names vertex " << v << " of " << mesh.vertices.size();
    } else if (!mesh.vertices[v].allFinite()) {
        text << "vertex " << v << " = (" << mesh.vertices[v].transpose() << ") is not finite";
    } else {
        text << "value_m[" << v << "] = " << value_m[v] << " is not a length";
    }
    return text.str();
}

std::optional<PlanError> check_values(const TriangleMesh& mesh, std::span<const double> value_m) {
    if (value_m.size() != mesh.vertices.size()) {
        return error(PlanErrorCode::kInvalidInput, std::to_string(value_m.size()) + " values for " +
                                                       std::to_string(mesh.vertices.size()) +
                                                       " vertices");
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        stop_point(f);
        for (const std::uint32_t v : mesh.faces[f]) {
            const bool good = v < mesh.vertices.size() && mesh.vertices[v].allFinite() &&
                              value_m[v] >= 0.0;  // a NaN is not
            if (!good) return error(PlanErrorCode::kInvalidInput, complaint(mesh, value_m, f, v));
        }
    }
    return std::nullopt;
}

std::optional<PlanError> check_parameters(double finger_width_m,
                                          const SampleSurfaceConfig& config) {
    if (auto bad = validate(config, "sample_surface.")) return bad;
    return check_positive("sample_surface: finger_width_m", finger_width_m);
}

/// [m2] The same whatever the order of the faces: a sum of whole numbers. NaN where a face is too
/// large to measure.
double area_of(std::span<const ScanFace> faces) {
    double largest_m2 = 0.0;
    for (const ScanFace& face : faces) {
        if (!std::isfinite(face.area_m2)) return std::numeric_limits<double>::quiet_NaN();
        largest_m2 = std::max(largest_m2, face.area_m2);
    }
    if (!std::isnormal(largest_m2)) return largest_m2;
    const int count_bits = static_cast<int>(std::bit_width(faces.size()));
    const double unit_m2 = std::ldexp(1.0, std::ilogb(largest_m2) + count_bits - 62);
    if (!std::isnormal(unit_m2)) return largest_m2;
    std::uint64_t units = 0;  // below 2^63
    for (const ScanFace& face : faces) {
        units += static_cast<std::uint64_t>(face.area_m2 / unit_m2 + 0.5);
    }
    return static_cast<double>(units) * unit_m2;
}

/// The configured spacing, or the one at which the surface takes max_samples.
double choose_spacing(double area_m2, double configured_m, double max_samples) {
    const bool fits = area_m2 <= (1.0 - 1e-9) * max_samples * configured_m * configured_m;
    if (fits || std::isnan(area_m2)) return configured_m;
    const double growth = std::sqrt(area_m2 / max_samples) / configured_m - 1.0;
    const double steps = std::ceil(growth / kGrowthStep - 1e-6);
    return configured_m * (1.0 + kGrowthStep * std::max(0.0, steps));
}

/// Orders samples by their points, then their normals, each rounded: what differs by rounding alone
/// stands in the order of what differs in earnest, so that a turned object has its samples in the
/// same order.
class SampleOrder {
public:
    SampleOrder(const std::vector<SurfaceSample>& samples, double spacing_m)
        : samples_(samples), unit_m_(kOrderUnit * spacing_m) {
        for (const SurfaceSample& s : samples) {
            box_.extend(rounded(s.point, unit_m_).head<2>().matrix());
        }
        // Numbers below 2^32 stand side by side in one key; else the samples are compared alone.
        constexpr double kKeys = 4294967296.0;
        keyed_ = (box_.sizes().array() < kKeys).all();
    }

    /// The indices of the samples in their order.
    std::vector<std::uint32_t> indices() const {
        std::vector<Place> places;
        places.reserve(samples_.size());
        for (const SurfaceSample& s : samples_) {
            places.push_back({key_of(s), static_cast<std::uint32_t>(places.size())});
        }
        std::ranges::sort(places, [&](const Place& a, const Place& b) {
            return a.key != b.key ? a.key < b.key : comes_before(samples_[a.at], samples_[b.at]);
        });
        std::vector<std::uint32_t> indices;
        indices.reserve(places.size());
        for (const Place& place : places) indices.push_back(place.at);
        return indices;
    }

private:
    /// A sample's place in the order as far as one number tells.
    struct Place {
        std::uint64_t key;
        std::uint32_t at;
    };

    static Eigen::Array3d rounded(const Eigen::Vector3d& value, double unit) {
        return (value.array() / unit + 0.5).floor();
    }
    /// Rounded x, then rounded y.
    std::uint64_t key_of(const SurfaceSample& sample) const {
        if (!keyed_) return 0;
        const Eigen::Array2d at = rounded(sample.point, unit_m_).head<2>() - box_.min().array();
        return static_cast<std::uint64_t>(at.x()) << 32 | static_cast<std::uint64_t>(at.y());
    }
    bool comes_before(const SurfaceSample& s, const SurfaceSample& t) const {
        const Eigen::Vector3d s_point = rounded(s.point, unit_m_),
                              t_point = rounded(t.point, unit_m_);
        if (s_point != t_point) return precedes(s_point, t_point);
        const Eigen::Vector3d s_normal = rounded(s.normal, kOrderUnit),
                              t_normal = rounded(t.normal, kOrderUnit);
        if (s_normal != t_normal) return precedes(s_normal, t_normal);
        if (s.point != t.point) return precedes(s.point, t.point);
        if (s.normal != t.normal) return precedes(s.normal, t.normal);
        return s.concavity_m < t.concavity_m;
    }

    const std::vector<SurfaceSample>& samples_;
    double unit_m_;
    Eigen::AlignedBox2d box_;  ///< around the points, in units
    bool keyed_ = false;
};

std::vector<SurfaceSample> in_order(const std::vector<SurfaceSample>& samples, double spacing_m) {
    std::vector<SurfaceSample> ordered;
    ordered.reserve(samples.size());
    for (const std::uint32_t at : SampleOrder(samples, spacing_m).indices()) {
        ordered.push_back(samples[at]);
    }
    return ordered;
}

}  // namespace

/// What every spacing needs.
struct SurfaceSampler::Faces {
    std::vector<ScanFace> faces;
    double area_m2 = 0.0;
    double reach_m = 0.0;  ///< [m] greatest coordinate, without its sign
};

Result<SurfaceSampler> SurfaceSampler::of(const TriangleMesh& mesh,
                                          std::span<const double> value_m) {
    if (mesh.faces.empty()) {
        return error(PlanErrorCode::kInvalidInput, "the mesh has no face");
    }
    if (auto bad = check_values(mesh, value_m)) return *bad;
    Faces surface{faces_to_scan(mesh, value_m)};
    surface.area_m2 = area_of(surface.faces);
    for (const ScanFace& face : surface.faces) {
        for (const Eigen::Vector3d& corner : face.corner) {
            surface.reach_m = std::max(surface.reach_m, corner.lpNorm<Eigen::Infinity>());
        }
    }
    return SurfaceSampler(std::make_shared<const Faces>(std::move(surface)));
}

Result<SurfaceSamples> SurfaceSampler::sample(double finger_width_m,
                                              const SampleSurfaceConfig& config) const {
    if (auto bad = check_parameters(finger_width_m, config)) return *bad;
    SurfaceSamples surface;
    surface.spacing_m =
        choose_spacing(faces_->area_m2, config.spacing_finger_widths * finger_width_m,
                       static_cast<double>(config.max_samples));
    if (!(faces_->reach_m / surface.spacing_m <= kMaxGridIndex)) {
        std::ostringstream text;
        text << "a coordinate of " << faces_->reach_m
             << " m is too far from the origin for a spacing of " << surface.spacing_m << " m";
        return error(PlanErrorCode::kInvalidInput, text.str());
    }
    double rows = 0.0;
    for (const ScanFace& face : faces_->faces) rows += rows_of(face, surface.spacing_m);
    if (rows > kMaxRows) {
        return error(PlanErrorCode::kTooLarge,
                     "the faces span " + std::to_string(rows) + " grid rows, more than 1e8");
    }
    surface.samples = scan_faces(faces_->faces, surface.spacing_m);
    if (surface.samples.empty()) {
        return error(PlanErrorCode::kDegenerate, "no line of the grid meets the surface; spacing " +
                                                     std::to_string(surface.spacing_m) + " m");
    }
    stop_point();
    surface.samples = in_order(surface.samples, surface.spacing_m);
    return surface;
}

Result<SurfaceSamples> sample_surface(const TriangleMesh& mesh, std::span<const double> value_m,
                                      double finger_width_m, const SampleSurfaceConfig& config) {
    if (auto bad = check_parameters(finger_width_m, config)) return *bad;
    const auto sampler = SurfaceSampler::of(mesh, value_m);
    if (!sampler) return sampler.error();
    return sampler.value().sample(finger_width_m, config);
}

}  // namespace graspd
