#include "grid_scan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graspd/base/parallel.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::mesh_detail {
namespace {

// Components of a normal that differ by less are equal: faces of one slanted plane then agree on
// their dominant axis however they are rounded.
constexpr double kAxisTie = 1.0 + 1e-9;
constexpr std::size_t kFacesAtATime = 2048;

int dominant_axis(const Eigen::Vector3d& normal) {
    int best = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (std::abs(normal[axis]) > kAxisTie * std::abs(normal[best])) best = axis;
    }
    return best;
}

ScanFace make_face(const TriangleMesh& mesh, std::span<const double> value_m, const Triangle& t) {
    std::array<std::uint32_t, 3> order = t;
    bool turned = false;
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
        if (!precedes(mesh.vertices[order[j]], mesh.vertices[order[i]])) continue;
        std::swap(order[i], order[j]);
        turned = !turned;
    }
    ScanFace face;
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

std::pair<double, double> extent(const ScanFace& face, int axis) {
    const auto [low, high] =
        std::minmax({face.corner[0][axis], face.corner[1][axis], face.corner[2][axis]});
    return {low, high};
}

/// Grid lines that meet faces. Every row of a face is cut by exactly two of its edges, and an
/// edge's cut is computed from its lower end, so that both faces at an edge get the same number:
/// [left, right) then counts each line once.
class Scanner {
public:
    Scanner(double spacing_m, std::vector<SurfaceSample>& samples)
        : spacing_m_(spacing_m), samples_(samples) {}

    void scan(const ScanFace& face);

private:
    double first_line(double from) const { return std::floor(from / spacing_m_ - 0.5); }
    double line_at(double index) const { return (index + 0.5) * spacing_m_; }
    void scan_row(const ScanFace& face, double row);
    void emit(const ScanFace& face, double u, double v);

    double spacing_m_;
    std::vector<SurfaceSample>& samples_;
    std::size_t rows_ = 0;
};

void Scanner::scan(const ScanFace& face) {
    const auto [low, high] = extent(face, (face.axis + 2) % 3);
    for (double j = first_line(low); line_at(j) < high; j += 1.0) {
        stop_point(++rows_);
        scan_row(face, line_at(j));
    }
}

void Scanner::scan_row(const ScanFace& face, double row) {
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
std::pair<double, double> weights(const ScanFace& face, double u_m, double v_m) {
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

void Scanner::emit(const ScanFace& face, double u, double v) {
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

}  // namespace

bool precedes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    if (a.x() != b.x()) return a.x() < b.x();
    if (a.y() != b.y()) return a.y() < b.y();
    return a.z() < b.z();
}

std::vector<ScanFace> faces_to_scan(const TriangleMesh& mesh, std::span<const double> value_m) {
    std::vector<ScanFace> faces(mesh.faces.size());
    for_blocks(faces.size(), kFacesAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) {
            faces[f] = make_face(mesh, value_m, mesh.faces[f]);
        }
    });
    return faces;
}

double rows_of(const ScanFace& face, double spacing_m) {
    const auto [low, high] = extent(face, (face.axis + 2) % 3);
    return (high - low) / spacing_m + 2.0;
}

std::vector<SurfaceSample> scan_faces(std::span<const ScanFace> faces, double spacing_m) {
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

}  // namespace graspd::mesh_detail
