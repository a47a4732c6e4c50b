#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// How densely the surface is sampled.
struct SampleSurfaceConfig {
    double spacing_finger_widths = 0.15;  ///< [1] spacing of the samples in finger widths
    std::uint32_t max_samples = 20000;    ///< a larger surface is sampled more coarsely

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("spacing_finger_widths", self.spacing_finger_widths, 0.01, 2.0);
        visit("max_samples", self.max_samples, 100u, 1000000u);
    }
};

/// Samples of a surface and the grid constant they were taken with.
struct SurfaceSamples {
    std::vector<SurfaceSample> samples;
    double spacing_m = 0.0;  ///< [m] usual distance of neighbours
};

/// A surface's faces, checked and ready for grids of any spacing.
class SurfaceSampler {
public:
    /// @param mesh     closed, outward oriented [m]; the frame fixes the grid
    /// @param value_m  per vertex: concavity [m], >= 0 or +infinity
    /// @return kInvalidInput for an empty mesh, an index out of range, a vertex that is not finite,
    ///         a value that is none or a wrong count of them
    static Result<SurfaceSampler> of(const TriangleMesh& mesh, std::span<const double> value_m);

    /// As sample_surface(), of this surface. Safe to call from any thread.
    Result<SurfaceSamples> sample(double finger_width_m, const SampleSurfaceConfig& config) const;

private:
    struct Faces;
    explicit SurfaceSampler(std::shared_ptr<const Faces> faces) : faces_(std::move(faces)) {}

    std::shared_ptr<const Faces> faces_;
};

/// Takes samples that depend on the shape alone, not on how it is cut into triangles.
///
/// A face is sampled where the lines of a square grid parallel to its dominant axis (largest
/// component of its normal, ties by the lower axis) meet it. The lines run through
/// ((i + 1/2) s, (j + 1/2) s) for whole i, j, so the grid is symmetric about the frame's planes. A
/// sample stands for the area s^2 / |n_axis|, between s^2 and 1.74 s^2; a line through an edge
/// shared by two faces of one dominant axis counts once.
///
/// Source: none in the paper, which works on mesh vertices; so a mesh of 160 faces and one of
/// 20,000 give the same regions (docs/architecture.md).
///
/// @param mesh           closed, outward oriented [m]; the frame fixes the grid
/// @param value_m        per vertex: concavity [m], >= 0 or +infinity; interpolated linearly, and
///                       infinite where a corner of the face is
/// @param finger_width_m [m] > 0
/// @return samples in a total order (point, then normal, each but for rounding) that depends
///         neither on the order of faces nor of vertices; spacing_m grows above the configured one
///         where area / spacing^2 would exceed max_samples; kInvalidInput for a parameter, length
///         or value out of range, an empty mesh, an index out of range, a vertex that is not finite
///         or lies beyond 1e7 spacings, or a wrong count of values; kTooLarge when the faces span
///         more than 1e8 rows of the grid; kDegenerate when no grid line meets the surface
/// Complexity O(F + rows + S log S). Pure, so safe to call from any thread.
Result<SurfaceSamples> sample_surface(const TriangleMesh& mesh, std::span<const double> value_m,
                                      double finger_width_m, const SampleSurfaceConfig& config);

}  // namespace graspd
