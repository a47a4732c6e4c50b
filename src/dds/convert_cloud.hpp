#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "convert_basics.hpp"

namespace graspd::dds {

/// Whether a cloud counts as absent: no points and no data.
bool is_empty(const sensor_msgs::msg::dds_::PointCloud2_& cloud);

/// The points of a PointCloud2: fields x, y and z, each FLOAT32 or FLOAT64 of count 1, anywhere in
/// the point, of either byte order. Height x width points, row by row; a NaN stays a NaN.
///
/// Every size is checked before anything is read: the fields' offsets against point_step, row_step
/// against width x point_step, and data against height x row_step. The first mismatch is noted with
/// the numbers, and gives no points.
std::vector<Eigen::Vector3d> read_cloud(const sensor_msgs::msg::dds_::PointCloud2_& cloud,
                                        const std::string& field, FirstError& errors);

/// One row of little-endian FLOAT64 x, y, z. kTooLarge is noted for more than 178 million points,
/// whose row_step would not fit.
sensor_msgs::msg::dds_::PointCloud2_ write_cloud(const std::vector<Eigen::Vector3d>& points,
                                                 FirstError& errors);

}  // namespace graspd::dds
