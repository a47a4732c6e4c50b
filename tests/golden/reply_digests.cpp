#include "reply_digests.hpp"

#include "graspd/base/content_hash.hpp"
#include "graspd/dds/payloads.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd::test {
namespace {

PlanRequest on_table(PlanRequest request) {
    request.X_FO.translation() = Eigen::Vector3d(0.3, -0.1, 0.05);
    request.support_plane = {Eigen::Vector3d::UnitZ(), 0.0};
    Obstacle post{box({0.02, 0.02, 0.1}, 12), Eigen::Isometry3d::Identity()};
    post.X_FO.translation() = Eigen::Vector3d(0.38, -0.1, 0.05);
    request.obstacles.push_back(post);
    return request;
}

PlanRequest with_two_grippers(PlanRequest request) {
    Gripper narrow = request.grippers[0];
    narrow.name = "narrow";
    narrow.finger_width_m *= 0.7;
    request.grippers.push_back(narrow);
    return request;
}

PlanRequest with_suggestion(PlanRequest request) {
    request.options.want_suggestion = true;
    return request;
}

PlanRequest too_clear(PlanRequest request) {
    request.options.min_clearance_m = 0.9;
    return request;
}

PlanRequest of_points(PlanRequest request) {
    request.object_O = PointCloud{std::get<TriangleMesh>(request.object_O).vertices, {}};
    return request;
}

TriangleMesh broken(TriangleMesh mesh) {
    mesh.faces.erase(mesh.faces.begin() + 7);
    mesh.faces.push_back(mesh.faces.front());
    return mesh;
}

}  // namespace

std::map<std::string, PlanRequest> digest_requests() {
    const PlanRequest neck = request_for(box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 2000));
    const PlanRequest odd = request_for(moved(lopsided(3000), random_pose(3)));
    std::map<std::string, PlanRequest> requests = {
        {"hourglass", neck},
        {"hourglass_broken", request_for(broken(std::get<TriangleMesh>(neck.object_O)))},
        {"hourglass_two_grippers", with_two_grippers(neck)},
        {"lopsided", odd},
        {"lopsided_cloud", of_points(odd)},
        {"lopsided_none", too_clear(odd)},
        {"lopsided_on_table", on_table(odd)},
        {"lopsided_suggestion", with_suggestion(odd)},
        {"sphere", request_for(sphere(0.03, 4000))},
        {"torus", request_for(torus(0.03, 0.01, 8000))},
        {"nothing", request_for(TriangleMesh{})},
    };
    for (auto& [name, request] : requests) {
        request.request_id = name;
        request.options.time_budget_s = 1e4;  // no clock ends one, however slow the build
    }
    return requests;
}

std::string digest_of(PlanReply reply) {
    reply.request_id.clear();
    for (StageReport& stage : reply.report.stages) stage.ms = 0.0;
    const auto bytes = reply_payload(reply);
    return content_key({std::as_bytes(std::span(bytes))});
}

std::string digest_of(const std::map<std::string, std::string>& digests) {
    std::string all;
    for (const auto& [name, digest] : digests) all += name + ' ' + digest + '\n';
    return content_key({std::as_bytes(std::span(all))});
}

std::map<std::string, std::string> cold_digests() {
    std::map<std::string, std::string> digests;
    for (const auto& [name, request] : digest_requests()) {
        digests[name] = digest_of(plan(request, {}));
    }
    return digests;
}

}  // namespace graspd::test
