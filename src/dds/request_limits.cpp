#include "request_limits.hpp"

namespace graspd::dds {
namespace {

// Beyond these no driver and no hand description goes; they have no setting.
constexpr std::uint64_t kMostCloudFields = 256;
constexpr std::uint64_t kMostPartVertices = 100000;

PlanError over_limit(const std::string& field, std::uint64_t count, std::uint64_t limit,
                     const std::string& setting) {
    return {PlanErrorCode::kTooLarge, field + " = " + std::to_string(count) + ", limit" +
                                          (setting.empty() ? "" : " " + setting + " =") + " " +
                                          std::to_string(limit)};
}

}  // namespace

void RequestCounts::see(const std::string& member, const std::string& name, std::uint64_t count,
                        std::uint32_t most) {
    counts_[{member, name}] += count;
    if (most == 0 || count <= most || unbounded_) return;
    const std::string field = member == name ? name : member + "." + name;
    unbounded_ = PlanError{PlanErrorCode::kTooLarge, field + " has " + std::to_string(count) +
                                                         " elements, at most " +
                                                         std::to_string(most) + " are allowed"};
}

std::uint64_t RequestCounts::count_of(const char* member, const char* name) const {
    const auto found = counts_.find({member, name});
    return found == counts_.end() ? 0 : found->second;
}

RequestSize RequestCounts::size() const {
    return {.vertices = count_of("mesh", "vertices"),
            .faces = count_of("mesh", "triangles"),
            .points = 0,
            .obstacle_vertices = count_of("obstacles", "vertices"),
            .obstacle_faces = count_of("obstacles", "triangles")};
}

std::optional<PlanError> RequestCounts::over(const RequestLimits& limits) const {
    if (unbounded_) return unbounded_;
    struct Limit {
        const char* member;
        const char* name;
        std::uint64_t most;
        const char* setting;
    };
    const std::uint64_t obstacle_vertices = 3 * std::uint64_t{limits.max_obstacle_faces};
    const Limit all[] = {
        {"mesh", "vertices", limits.max_vertices, "condition_mesh.max_vertices"},
        {"mesh", "triangles", limits.max_faces, "condition_mesh.max_faces"},
        {"obstacles", "triangles", limits.max_obstacle_faces, "server.max_obstacle_faces"},
        {"obstacles", "vertices", obstacle_vertices, "3 x server.max_obstacle_faces"},
        {"cloud", "fields", kMostCloudFields, ""},
        {"obstacle_cloud", "fields", kMostCloudFields, ""},
        {"grippers", "vertices", kMostPartVertices, ""},
        {"grippers", "triangles", kMostPartVertices, ""},
    };
    for (const auto& [member, name, most, setting] : all) {
        const std::uint64_t count = count_of(member, name);
        if (count > most) {
            return over_limit(std::string(member) + "." + name, count, most, setting);
        }
    }
    return std::nullopt;
}

std::optional<PlanError> too_many_points(std::uint64_t points, const RequestLimits& limits) {
    if (points <= limits.max_points) return std::nullopt;
    return over_limit("cloud.width x cloud.height", points, limits.max_points,
                      "triangulate_cloud.limit_points");
}

std::optional<PlanError> too_many_bytes(std::uint64_t bytes, std::uint32_t limit) {
    if (bytes <= limit) return std::nullopt;
    return over_limit("bytes of the payload", bytes, limit, "server.max_payload_bytes");
}

}  // namespace graspd::dds
