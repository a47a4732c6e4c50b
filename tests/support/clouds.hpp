#pragma once

#include "graspd/base/geometry.hpp"

namespace graspd::test {

/// Points on a sphere about the origin at nearly equal distances: a spiral from pole (+z) to pole
/// in golden-angle steps. Each stands for 4 pi R^2 / count of the area.
PointCloud spiral_sphere(double radius_m, int count);

}  // namespace graspd::test
