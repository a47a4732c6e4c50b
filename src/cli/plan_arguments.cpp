#include "plan_arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "graspd/config/load_gripper.hpp"

namespace graspd::cli {
namespace {

PlanError wrong(const std::string& option, const std::string& value, const std::string& wanted) {
    return {PlanErrorCode::kInvalidInput, option + " = " + value + " must be " + wanted};
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (true) {
        const std::size_t comma = text.find(',', begin);
        parts.push_back(text.substr(begin, comma - begin));
        if (comma == std::string::npos) return parts;
        begin = comma + 1;
    }
}

const std::vector<Eigen::Vector3d>& points_of(
    const std::variant<TriangleMesh, PointCloud>& object) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&object)) return mesh->vertices;
    return std::get<PointCloud>(object).points;
}

/// The plane normal to `up` through the object's lowest finite point.
SupportPlane plane_under(const std::variant<TriangleMesh, PointCloud>& object,
                         const Eigen::Vector3d& up) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : points_of(object)) {
        const double height = up.dot(point);
        if (std::isfinite(height)) lowest = std::min(lowest, height);
    }
    return {up, std::isfinite(lowest) ? lowest : 0.0};
}

/// N numbers between commas.
template <int N>
std::optional<Eigen::Matrix<double, N, 1>> parse_numbers(const std::string& text) {
    const auto parts = split(text);
    if (parts.size() != static_cast<std::size_t>(N)) return std::nullopt;
    Eigen::Matrix<double, N, 1> numbers;
    for (Eigen::Index i = 0; i < N; ++i) {
        const std::string& part = parts[static_cast<std::size_t>(i)];
        const char* end = part.data() + part.size();
        const auto got = std::from_chars(part.data(), end, numbers[i]);
        if (got.ec != std::errc{} || got.ptr != end) return std::nullopt;
    }
    return numbers;
}

}  // namespace

Result<Eigen::Vector3d> parse_direction(const std::string& option, const std::string& text) {
    const auto triple = parse_numbers<3>(text);
    const double length = triple ? triple->norm() : 0.0;
    if (!std::isfinite(length) || length <= 0.0) {
        return wrong(option, text, "none or X,Y,Z, such as 0,0,1");
    }
    return Eigen::Vector3d(*triple / length);
}

Result<Eigen::Vector3d> parse_place(const std::string& option, const std::string& text) {
    const auto place = parse_numbers<3>(text);
    if (place && place->allFinite()) return *place;
    return wrong(option, text, "X,Y,Z in metres, such as 0,0,0.5");
}

Result<Eigen::Isometry3d> parse_pose(const std::string& option, const std::string& text) {
    constexpr double kUnitTolerance = 1e-3;  // as on the wire
    const auto numbers = parse_numbers<7>(text);
    if (!numbers || !numbers->allFinite()) {
        return wrong(option, text, "X,Y,Z,QX,QY,QZ,QW in metres, such as 0,0,0.1,0,0,0,1");
    }
    const Eigen::Vector4d xyzw = numbers->tail<4>();
    if (std::abs(xyzw.norm() - 1.0) > kUnitTolerance) {
        return wrong(option, text, "a pose with a quaternion of unit length");
    }
    Eigen::Isometry3d pose(Eigen::Quaterniond(xyzw).normalized());
    pose.translation() = numbers->head<3>();
    return pose;
}

Result<ObjectFile> read_object_file(const ObjectArguments& arguments) {
    auto file = read_object(arguments.file, arguments.scale);
    if (!file.ok()) return file;
    auto* cloud = std::get_if<PointCloud>(&file.value().object);
    if (cloud != nullptr) {  // triangulate_cloud finds them again
        std::erase_if(file.value().findings,
                      [](const Finding& f) { return f.code == "points_not_finite"; });
    }
    if (arguments.sensor.empty()) return file;
    const auto sensor = parse_place("--sensor", arguments.sensor);
    if (!sensor.ok()) return sensor.error();
    if (cloud != nullptr) cloud->sensor_origin = sensor.value();
    return file;
}

Result<std::uint8_t> parse_sources(const std::string& text) {
    if (text == "all") return std::uint8_t{kAllSources};
    unsigned bits = 0;
    for (const std::string& name : split(text)) {
        const GraspSource known[] = {kBoundary, kWall, kWholeObject};
        const auto source =
            std::ranges::find_if(known, [&](GraspSource s) { return name == to_string(s); });
        if (source == std::end(known)) {
            return wrong("--sources", text, "all, or some of boundary,wall,whole_object");
        }
        bits |= static_cast<unsigned>(*source);
    }
    return static_cast<std::uint8_t>(bits);
}

Result<PlanRequest> make_request(const PlanArguments& arguments,
                                 const std::filesystem::path& profiles,
                                 std::vector<Finding>* findings) {
    auto sources = parse_sources(arguments.sources);
    if (!sources.ok()) return sources.error();
    auto gripper = find_gripper(arguments.gripper, profiles / "grippers");
    if (!gripper.ok()) return gripper.error();
    auto object = read_object_file(arguments.object);
    if (!object.ok()) return object.error();
    if (findings != nullptr) *findings = std::move(object.value().findings);

    PlanRequest request;
    request.request_id = arguments.request_id.empty()
                             ? std::filesystem::path(arguments.object.file).stem().string()
                             : arguments.request_id;
    request.frame_id = arguments.frame_id;
    request.object_O = std::move(object.value().object);
    request.grippers = {std::move(gripper).value()};
    if (arguments.up != "none") {
        const auto up = parse_direction("--up", arguments.up);
        if (!up.ok()) return up.error();
        request.support_plane = plane_under(request.object_O, up.value());
    }
    // A file's z is up unless somebody says otherwise.
    const bool by_default = arguments.gravity.empty() && !request.support_plane && !arguments.scene;
    const std::string gravity = by_default ? "0,0,-1" : arguments.gravity;
    if (!gravity.empty() && gravity != "none") {
        const auto down = parse_direction("--gravity", gravity);
        if (!down.ok()) return down.error();
        request.options.gravity_F = down.value();
    }
    request.options.max_grasps = arguments.top;
    request.options.time_budget_s = arguments.time_budget_ms * 1e-3;
    request.options.friction = arguments.friction;
    request.options.sources = sources.value();
    request.options.want_suggestion = arguments.suggest;
    request.options.want_markers = arguments.markers;
    request.options.seed = arguments.seed;
    return request;
}

}  // namespace graspd::cli
