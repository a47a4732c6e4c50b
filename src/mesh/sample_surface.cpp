#include "graspd/mesh/sample_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "graspd/base/parallel.hpp"
#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"
#include "graspd/base/stop.hpp"
#include "graspd/base/stoppable_sort.hpp"

namespace graspd {
namespace {

// Components of a normal that differ by less are equal: faces of one slanted plane then agree on
// their dominant axis however they are rounded.
constexpr double kAxisTie = 1.0 + 1e-9;
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

/// A face ready to be scanned. Its corners stand in lexicographic order, so that rounding does not
/// depend on where the face began.
struct Face {
    std::array<Eigen::Vector3d, 3> corner;
    std::array<double, 3> value_m{};
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit; zero for a face without area
    double area_m2 = 0.0;
    int axis = 2;  ///< dominant
};

bool precedes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    if (a.x() != b.x()) return a.x() < b.x();
    if (a.y() != b.y()) return a.y() < b.y();
    return a.z() < b.z();
}

int dominant_axis(const Eigen::Vector3d& normal) {
    int best = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (std::abs(normal[axis]) > kAxisTie * std::abs(normal[best])) best = axis;
    }
    return best;
}

Face make_face(const TriangleMesh& mesh, std::span<const double> value_m, const Triangle& t) {
    std::array<std::uint32_t, 3> order = t;
    bool turned = false;
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
        if (!precedes(mesh.vertices[order[j]], mesh.vertices[order[i]])) continue;
        std::swap(order[i], order[j]);
        turned = !turned;
    }
    Face face;
    for (int k = 0; k < 3; ++k) {
        face.corner[k] = mesh.vertices[order[k]];
        face.value_m[k] = value_m[order[k]];
    }
    const Eigen::Vector3d cross =
        (face.corner[1] - face.corner[0]).cross(face.corner[2] - face.corner[0]);
    const double norm = cross.norm();
    face.area_m2 = 0.5 * norm;
    if (norm > 0.0) face.normal = (turned ? -1.0 : 1.0) * cross / norm;
    face.axis = dominant_axis(face.normal);
    return face;
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

std::optional<PlanError> check_input(const TriangleMesh& mesh, std::span<const double> value_m,
                                     double finger_width_m, const SampleSurfaceConfig& config) {
    if (auto bad = validate(config, "sample_surface.")) return bad;
    if (auto bad = check_positive("sample_surface: finger_width_m", finger_width_m)) return bad;
    if (mesh.faces.empty()) {
        return error(PlanErrorCode::kInvalidInput, "the mesh has no face");
    }
    return check_values(mesh, value_m);
}

/// The configured spacing, or the one at which the surface takes max_samples.
double choose_spacing(std::span<const Face> faces, double configured_m, double max_samples) {
    double area_m2 = 0.0;
    for (const Face& face : faces) area_m2 += face.area_m2;
    if (area_m2 <= (1.0 - 1e-9) * max_samples * configured_m * configured_m) return configured_m;
    // The same sum whatever the order of faces.
    std::vector<double> areas(faces.size());
    std::ranges::transform(faces, areas.begin(), &Face::area_m2);
    stoppable_sort(areas);
    area_m2 = 0.0;
    for (const double area : areas) area_m2 += area;
    const double growth = std::sqrt(area_m2 / max_samples) / configured_m - 1.0;
    const double steps = std::ceil(growth / kGrowthStep - 1e-6);
    return configured_m * (1.0 + kGrowthStep * std::max(0.0, steps));
}

std::pair<double, double> extent(const Face& face, int axis) {
    const auto [low, high] =
        std::minmax({face.corner[0][axis], face.corner[1][axis], face.corner[2][axis]});
    return {low, high};
}

/// Rows that the face spans, at most.
double rows_of(const Face& face, double spacing_m) {
    const auto [low, high] = extent(face, (face.axis + 2) % 3);
    return (high - low) / spacing_m + 2.0;
}

/// Grid lines that meet faces. Every row of a face is cut by exactly two of its edges, and an
/// edge's cut is computed from its lower end, so that both faces at an edge get the same number:
/// [left, right) then counts each line once.
class Scanner {
public:
    Scanner(double spacing_m, std::vector<SurfaceSample>& samples)
        : spacing_m_(spacing_m), samples_(samples) {}

    void scan(const Face& face);

private:
    double first_line(double from) const { return std::floor(from / spacing_m_ - 0.5); }
    double line_at(double index) const { return (index + 0.5) * spacing_m_; }
    void scan_row(const Face& face, double row);
    void emit(const Face& face, double u, double v);

    double spacing_m_;
    std::vector<SurfaceSample>& samples_;
    std::size_t rows_ = 0;
};

void Scanner::scan(const Face& face) {
    const auto [low, high] = extent(face, (face.axis + 2) % 3);
    for (double j = first_line(low); line_at(j) < high; j += 1.0) {
        stop_point(++rows_);
        scan_row(face, line_at(j));
    }
}

void Scanner::scan_row(const Face& face, double row) {
    const int u = (face.axis + 1) % 3;
    const int v = (face.axis + 2) % 3;
    std::array<double, 2> cut{};
    std::size_t cuts = 0;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d* low = &face.corner[k];
        const Eigen::Vector3d* high = &face.corner[(k + 1) % 3];
        if ((*low)[v] > (*high)[v]) std::swap(low, high);
        if (!((*low)[v] <= row && row < (*high)[v])) continue;
        const double share = (row - (*low)[v]) / ((*high)[v] - (*low)[v]);
        cut[cuts++ % 2] = (*low)[u] + share * ((*high)[u] - (*low)[u]);
    }
    if (cuts != 2) return;
    const auto [left, right] = std::minmax(cut[0], cut[1]);
    for (double i = first_line(left); line_at(i) < right; i += 1.0) {
        if (line_at(i) >= left) emit(face, line_at(i), row);
    }
}

/// Barycentric weights of corners 1 and 2, kept inside for slivers, whose weights are all rounding.
std::pair<double, double> weights(const Face& face, double u_m, double v_m) {
    const int u = (face.axis + 1) % 3;
    const int v = (face.axis + 2) % 3;
    const Eigen::Vector3d& o = face.corner[0];
    const Eigen::Vector2d e1(face.corner[1][u] - o[u], face.corner[1][v] - o[v]);
    const Eigen::Vector2d e2(face.corner[2][u] - o[u], face.corner[2][v] - o[v]);
    const Eigen::Vector2d p(u_m - o[u], v_m - o[v]);
    const double twice_area = e1.x() * e2.y() - e1.y() * e2.x();
    if (twice_area == 0.0) return {0.0, 0.0};
    return {std::clamp((p.x() * e2.y() - p.y() * e2.x()) / twice_area, 0.0, 1.0),
            std::clamp((e1.x() * p.y() - e1.y() * p.x()) / twice_area, 0.0, 1.0)};
}

void Scanner::emit(const Face& face, double u, double v) {
    const auto [w1, w2] = weights(face, u, v);
    const auto mix = [&, w1 = w1, w2 = w2](double a, double b, double c) {
        // Differences from the first corner keep a constant exact.
        const double mixed = a + w1 * (b - a) + w2 * (c - a);
        return std::clamp(mixed, std::min({a, b, c}), std::max({a, b, c}));
    };
    SurfaceSample sample;
    const int axis = face.axis;
    sample.point[axis] = mix(face.corner[0][axis], face.corner[1][axis], face.corner[2][axis]);
    sample.point[(axis + 1) % 3] = u;
    sample.point[(axis + 2) % 3] = v;
    sample.normal = face.normal;
    sample.area_m2 = spacing_m_ * spacing_m_ / std::abs(face.normal[axis]);
    const auto& [a, b, c] = face.value_m;
    const double highest = std::max({a, b, c});
    sample.concavity_m = std::isfinite(highest) ? mix(a, b, c) : highest;
    samples_.push_back(sample);
}

constexpr std::size_t kFacesAtATime = 2048;

std::vector<Face> make_faces(const TriangleMesh& mesh, std::span<const double> value_m) {
    std::vector<Face> faces(mesh.faces.size());
    for_blocks(faces.size(), kFacesAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) {
            faces[f] = make_face(mesh, value_m, mesh.faces[f]);
        }
    });
    return faces;
}

/// Samples in the order of the faces.
std::vector<SurfaceSample> scan_faces(std::span<const Face> faces, double spacing_m) {
    std::vector<std::vector<SurfaceSample>> parts((faces.size() + kFacesAtATime - 1) /
                                                  kFacesAtATime);
    for_blocks(faces.size(), kFacesAtATime, [&](std::size_t first, std::size_t last) {
        Scanner scanner(spacing_m, parts[first / kFacesAtATime]);
        for (std::size_t f = first; f < last; ++f) {
            stop_point(f - first);
            if (faces[f].area_m2 > 0.0) scanner.scan(faces[f]);
        }
    });
    std::vector<SurfaceSample> samples = std::move(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) {
        samples.insert(samples.end(), parts[i].begin(), parts[i].end());
    }
    return samples;
}

/// A sample and what it is ordered by: its point, then its normal, each rounded. What differs by
/// rounding alone stands in the order of what differs in earnest, so that a turned object has its
/// samples in the same order.
struct OrderedSample {
    Eigen::Vector3d point, normal;
    std::uint32_t at = 0;
};

std::vector<SurfaceSample> in_order(const std::vector<SurfaceSample>& samples, double spacing_m) {
    const auto rounded = [](const Eigen::Vector3d& value, double unit) -> Eigen::Vector3d {
        return (value.array() / (kOrderUnit * unit) + 0.5).floor();
    };
    std::vector<OrderedSample> order;
    order.reserve(samples.size());
    for (const SurfaceSample& s : samples) {
        const auto at = static_cast<std::uint32_t>(order.size());
        order.push_back({rounded(s.point, spacing_m), rounded(s.normal, 1.0), at});
    }
    std::ranges::sort(order, [&](const OrderedSample& a, const OrderedSample& b) {
        if (a.point != b.point) return precedes(a.point, b.point);
        if (a.normal != b.normal) return precedes(a.normal, b.normal);
        const SurfaceSample &s = samples[a.at], &t = samples[b.at];
        if (s.point != t.point) return precedes(s.point, t.point);
        if (s.normal != t.normal) return precedes(s.normal, t.normal);
        return s.concavity_m < t.concavity_m;
    });
    std::vector<SurfaceSample> ordered;
    ordered.reserve(order.size());
    for (const OrderedSample& o : order) ordered.push_back(samples[o.at]);
    return ordered;
}

}  // namespace

Result<SurfaceSamples> sample_surface(const TriangleMesh& mesh, std::span<const double> value_m,
                                      double finger_width_m, const SampleSurfaceConfig& config) {
    if (auto bad = check_input(mesh, value_m, finger_width_m, config)) return *bad;
    const std::vector<Face> faces = make_faces(mesh, value_m);
    double reach_m = 0.0;
    for (const Face& face : faces) {
        for (const Eigen::Vector3d& corner : face.corner) {
            reach_m = std::max(reach_m, corner.lpNorm<Eigen::Infinity>());
        }
    }
    SurfaceSamples surface;
    surface.spacing_m = choose_spacing(faces, config.spacing_finger_widths * finger_width_m,
                                       static_cast<double>(config.max_samples));
    if (!(reach_m / surface.spacing_m <= kMaxGridIndex)) {
        std::ostringstream text;
        text << "a coordinate of " << reach_m << " m is too far from the origin for a spacing of "
             << surface.spacing_m << " m";
        return error(PlanErrorCode::kInvalidInput, text.str());
    }
    double rows = 0.0;
    for (const Face& face : faces) rows += rows_of(face, surface.spacing_m);
    if (rows > kMaxRows) {
        return error(PlanErrorCode::kTooLarge,
                     "the faces span " + std::to_string(rows) + " grid rows, more than 1e8");
    }
    surface.samples = scan_faces(faces, surface.spacing_m);
    if (surface.samples.empty()) {
        return error(PlanErrorCode::kDegenerate, "no line of the grid meets the surface; spacing " +
                                                     std::to_string(surface.spacing_m) + " m");
    }
    stop_point();
    surface.samples = in_order(surface.samples, surface.spacing_m);
    return surface;
}

}  // namespace graspd
