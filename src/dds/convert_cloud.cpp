#include "convert_cloud.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>

#include "graspd/base/stop.hpp"

namespace graspd::dds {
namespace {

using sensor_msgs::msg::dds_::PointCloud2_;
using sensor_msgs::msg::dds_::PointField_;
namespace datatype = sensor_msgs::msg::dds_::PointField__Constants;

/// Where one coordinate lies within a point.
struct Coordinate {
    std::size_t offset = 0;
    std::size_t bytes = 4;  ///< 4: float, 8: double
};

std::string number(std::uint64_t value) {
    return std::to_string(value);
}

std::optional<Coordinate> find_coordinate(const PointCloud2_& cloud, const char* name,
                                          const std::string& path, FirstError& errors) {
    const PointField_* found = nullptr;
    for (const PointField_& field : cloud.fields()) {
        if (field.name() != name) continue;
        if (found != nullptr) errors.invalid(path + ".fields has two fields " + name);
        found = &field;
    }
    if (found == nullptr) {
        errors.invalid(path + ".fields has no field " + name);
        return std::nullopt;
    }
    const std::string field = path + ".fields." + name;
    const auto type = found->datatype();
    if (type != datatype::FLOAT32_ && type != datatype::FLOAT64_) {
        errors.invalid(field + ".datatype = " + number(type) +
                       " must be 7 (FLOAT32) or 8 (FLOAT64)");
    }
    if (found->count() != 1) {
        errors.invalid(field + ".count = " + number(found->count()) + " must be 1");
    }
    const Coordinate out{found->offset(), type == datatype::FLOAT64_ ? 8u : 4u};
    if (out.offset + out.bytes > cloud.point_step()) {
        errors.invalid(field + ".offset = " + number(out.offset) + " does not leave " +
                       number(out.bytes) + " bytes of point_step = " + number(cloud.point_step()));
    }
    return out;
}

void check_sizes(const PointCloud2_& cloud, const std::string& path, FirstError& errors) {
    const std::uint64_t row = std::uint64_t{cloud.width()} * cloud.point_step();
    const std::uint64_t all = std::uint64_t{cloud.height()} * cloud.row_step();
    if (cloud.width() == 0 || cloud.height() == 0) {
        errors.invalid(path + " has width " + number(cloud.width()) + " and height " +
                       number(cloud.height()) + ", both must be at least 1");
    }
    if (cloud.row_step() < row) {
        errors.invalid(path + ".row_step = " + number(cloud.row_step()) +
                       " is less than width x point_step = " + number(row));
    }
    if (cloud.data().size() != all) {
        errors.invalid(path + ".data has " + number(cloud.data().size()) +
                       " bytes, height x row_step is " + number(all));
    }
}

template <class Float>
double read_float(const std::uint8_t* at, bool swap) {
    std::array<std::uint8_t, sizeof(Float)> bytes{};
    std::memcpy(bytes.data(), at, sizeof(Float));
    if (swap) std::ranges::reverse(bytes);
    return static_cast<double>(std::bit_cast<Float>(bytes));
}

}  // namespace

bool is_empty(const PointCloud2_& cloud) {
    const bool no_points = cloud.width() == 0 || cloud.height() == 0;
    return no_points && cloud.data().empty();
}

std::vector<Eigen::Vector3d> read_cloud(const PointCloud2_& cloud, const std::string& field,
                                        FirstError& errors) {
    constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
    std::array<Coordinate, 3> layout;
    check_sizes(cloud, field, errors);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto coordinate = find_coordinate(cloud, kNames[axis], field, errors);
        if (coordinate) layout[axis] = *coordinate;
    }
    std::vector<Eigen::Vector3d> points;
    if (errors.any()) return points;
    const bool swap = cloud.is_bigendian() != (std::endian::native == std::endian::big);
    points.reserve(std::size_t{cloud.width()} * cloud.height());
    for (std::size_t row = 0; row < cloud.height(); ++row) {
        const std::uint8_t* point = cloud.data().data() + row * cloud.row_step();
        for (std::size_t column = 0; column < cloud.width(); ++column) {
            stop_point(points.size());
            Eigen::Vector3d& out = points.emplace_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::uint8_t* at = point + layout[axis].offset;
                out[static_cast<Eigen::Index>(axis)] = layout[axis].bytes == 8
                                                           ? read_float<double>(at, swap)
                                                           : read_float<float>(at, swap);
            }
            point += cloud.point_step();
        }
    }
    return points;
}

PointCloud2_ write_cloud(const std::vector<Eigen::Vector3d>& points, FirstError& errors) {
    constexpr std::uint32_t kStep = 3 * sizeof(double);
    PointCloud2_ cloud;
    if (points.size() > std::numeric_limits<std::uint32_t>::max() / kStep) {
        errors.set(PlanErrorCode::kTooLarge,
                   "the cloud has " + number(points.size()) + " points, at most " +
                       number(std::numeric_limits<std::uint32_t>::max() / kStep) + " fit");
        return cloud;
    }
    for (const char* name : {"x", "y", "z"}) {
        PointField_ field;
        field.name(name);
        field.offset(static_cast<std::uint32_t>(cloud.fields().size() * sizeof(double)));
        field.datatype(datatype::FLOAT64_);
        field.count(1);
        cloud.fields().push_back(field);
    }
    const auto count = static_cast<std::uint32_t>(points.size());
    cloud.height(points.empty() ? 0 : 1);
    cloud.width(count);
    cloud.is_bigendian(std::endian::native == std::endian::big);
    cloud.point_step(kStep);
    cloud.row_step(kStep * count);
    cloud.data().resize(std::size_t{kStep} * count);
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::memcpy(cloud.data().data() + i * kStep, points[i].data(), kStep);
    }
    cloud.is_dense(std::ranges::all_of(points, [](const auto& p) { return p.allFinite(); }));
    return cloud;
}

}  // namespace graspd::dds
