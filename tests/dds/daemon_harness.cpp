#include "daemon_harness.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>

#include "graspd/config/load_gripper.hpp"

namespace graspd::test {
namespace {

PlanRequest request_for(TriangleMesh mesh, const std::string& id) {
    PlanRequest request;
    request.request_id = id;
    request.frame_id = "table";
    request.object_O = std::move(mesh);
    request.grippers = {
        load_gripper(GRASPD_SOURCE_DIR "/profiles/grippers/parallel_85.yaml").value()};
    return request;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& name, const std::string& text)
    : path_(std::filesystem::path(testing::TempDir()) / (std::to_string(::getpid()) + name)) {
    std::ofstream(path_) << text;
}

PlanRequest box_request(const std::string& id) {
    return request_for(box({0.04, 0.06, 0.08}), id);
}

PlanRequest long_request(const std::string& id) {
    return request_for(torus(0.05, 0.015, 300000), id);
}

std::string off_text(const TriangleMesh& mesh) {
    std::ostringstream text;
    text << "OFF\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
    for (const auto& v : mesh.vertices) text << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const auto& f : mesh.faces) text << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
    return text.str();
}

}  // namespace graspd::test
