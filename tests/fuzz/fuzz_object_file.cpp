#include <array>
#include <cmath>
#include <map>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/read_object.hpp"
#include "graspd/mesh/triangulate_cloud.hpp"
#include "targets.hpp"

namespace graspd::fuzz {
namespace {

bool check_refusal(const PlanError& error) {
    require(!error.detail.empty(), "a refusal says why");
    require(error.code != PlanErrorCode::kInternal, "a file is not our fault: " + error.detail);
    return false;
}

void check_indices(const TriangleMesh& mesh) {
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t v : face) {
            require(v < mesh.vertices.size(), "a face's corner is a vertex");
        }
    }
}

void check_findings(const std::vector<Finding>& findings) {
    for (const Finding& finding : findings) {
        require(!finding.code.empty() && std::isfinite(finding.value), "a finding has a value");
    }
}

/// Each edge is passed as often one way as the other.
void check_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const Triangle& face : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % 3];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, sum] : balance) require(sum == 0, "a conditioned mesh is closed");
}

bool condition(const TriangleMesh& soup, bool wrap) {
    ConditionMeshConfig config;
    config.max_vertices = 4000;
    config.max_faces = 4000;
    config.alpha_wrap = wrap && soup.faces.size() < 30;  // takes a hundred times as long
    config.wrap_alpha = 0.3;
    config.wrap_offset = 0.03;
    const auto conditioned = condition_mesh(soup, config);
    if (!conditioned) return check_refusal(conditioned.error());
    const ConditionedMesh& out = conditioned.value();
    check_indices(out.mesh);
    check_findings(out.findings);
    check_closed(out.mesh);
    for (const Eigen::Vector3d& vertex : out.mesh.vertices) {
        require(vertex.allFinite(), "a conditioned vertex is finite");
    }
    require(out.vertex_of_input.size() == soup.vertices.size(), "every vertex is accounted for");
    for (const std::int32_t v : out.vertex_of_input) {
        require(v >= -1 && v < static_cast<std::int32_t>(out.mesh.vertices.size()),
                "a vertex stands for itself, another or none");
    }
    require(out.volume_m3 > 0.0 && std::isfinite(out.volume_m3), "a solid has a volume");
    require(out.center_of_mass.allFinite(), "a solid has a centre of mass");
    return true;
}

bool triangulate(const PointCloud& cloud, bool greedy) {
    TriangulateCloudConfig config;
    config.greedy_projection = greedy;
    config.max_points = 100;
    config.limit_points = 4000;
    const auto made = triangulate_cloud(cloud, config);
    if (!made) return check_refusal(made.error());
    const TriangulatedCloud& out = made.value();
    check_indices(out.mesh);
    check_findings(out.findings);
    require(!out.mesh.faces.empty(), "a triangulated cloud has faces");
    require(out.vertex_of_point.size() == cloud.points.size(), "every point is accounted for");
    for (const std::int32_t v : out.vertex_of_point) {
        require(v >= -1 && v < static_cast<std::int32_t>(out.mesh.vertices.size()),
                "a point stands for itself, another or none");
    }
    require(out.spacing_m > 0.0 && std::isfinite(out.spacing_m), "points are apart");
    return condition(out.mesh, false);
}

}  // namespace

bool fuzz_object_file(Bytes bytes) {
    if (bytes.empty()) return false;
    static const std::array<ScratchFile, 5> files = {
        ScratchFile("object.stl"), ScratchFile("object.obj"), ScratchFile("object.off"),
        ScratchFile("object.ply"), ScratchFile("object.pcd")};
    const std::uint8_t choice = bytes[0];
    const ScratchFile& file = files[(choice & 0x0f) % files.size()];
    const double scale = (choice & 0x40) != 0 ? 0.001 : 1.0;
    const auto read = read_object(file.write(bytes.subspan(1)), scale);
    if (!read) {
        require(read.error().code == PlanErrorCode::kUnreadableFile, "a bad file is unreadable");
        return check_refusal(read.error());
    }
    check_findings(read.value().findings);
    const bool rare = (choice & 0xb0) == 0xb0;
    if (const auto* mesh = std::get_if<TriangleMesh>(&read.value().object)) {
        check_indices(*mesh);
        return condition(*mesh, rare);
    }
    return triangulate(std::get<PointCloud>(read.value().object), rare);
}

}  // namespace graspd::fuzz
