// Asks graspd for grasps by its service, from any ROS 2 node:
//
//     ros2 run graspd_client plan_grasps_client mug.off parallel_85

#include <chrono>
#include <fstream>
#include <graspd_msgs/srv/plan_grasps.hpp>
#include <rclcpp/rclcpp.hpp>
#include <stdexcept>

namespace {

using PlanGrasps = graspd_msgs::srv::PlanGrasps;
using graspd_msgs::msg::RankedGrasps;
using namespace std::chrono_literals;

constexpr int kAttempts = 3;
constexpr auto kPatience = 15s;  // graspd's default time budget is 10 s

/// The triangles of an OFF file, in metres.
shape_msgs::msg::Mesh read_off(const std::string& path) {
    std::ifstream file(path);
    std::string magic;
    std::size_t vertices = 0, faces = 0, edges = 0;
    if (!(file >> magic >> vertices >> faces >> edges) || magic != "OFF") {
        throw std::runtime_error(path + " is no OFF file");
    }
    shape_msgs::msg::Mesh mesh;
    mesh.vertices.resize(vertices);
    mesh.triangles.resize(faces);
    for (auto& p : mesh.vertices) file >> p.x >> p.y >> p.z;
    for (auto& t : mesh.triangles) {
        std::size_t corners = 0;
        file >> corners >> t.vertex_indices[0] >> t.vertex_indices[1] >> t.vertex_indices[2];
        if (corners != 3) throw std::runtime_error(path + " has a face that is no triangle");
    }
    if (!file) throw std::runtime_error(path + " ends too early");
    return mesh;
}

/// One call. @return null: no reply in time
PlanGrasps::Response::SharedPtr call(const rclcpp::Node::SharedPtr& node,
                                     rclcpp::Client<PlanGrasps>& client,
                                     const PlanGrasps::Request::SharedPtr& request) {
    auto future = client.async_send_request(request);
    const auto code = rclcpp::spin_until_future_complete(node, future, kPatience);
    if (code == rclcpp::FutureReturnCode::SUCCESS) return future.get();
    client.remove_pending_request(future);
    return nullptr;
}

void print(const rclcpp::Logger& logger, const RankedGrasps& reply) {
    for (const auto& grasp : reply.grasps) {
        const auto& p = grasp.pose.position;
        const auto& q = grasp.pose.orientation;
        RCLCPP_INFO(logger,
                    "score %.3f at (%.4f %.4f %.4f), xyzw (%.3f %.3f %.3f %.3f), gap %.4f m",
                    grasp.score, p.x, p.y, p.z, q.x, q.y, q.z, q.w, grasp.width);
    }
    if (!reply.grasps.empty()) return;
    RCLCPP_WARN(logger, "no grasp: %s", reply.message.c_str());
    for (const auto& rejection : reply.report.rejections) {
        RCLCPP_WARN(logger, "  %s: %lu", rejection.reason.c_str(),
                    static_cast<unsigned long>(rejection.count));
    }
    if (!reply.report.suggestion.empty()) {
        RCLCPP_WARN(logger, "  %s", reply.report.suggestion.c_str());
    }
}

/// As graspctl's.
int exit_code(const RankedGrasps& reply) {
    if (!reply.grasps.empty()) return 0;
    switch (reply.status) {
        case RankedGrasps::STATUS_NO_GRASP:
        case RankedGrasps::STATUS_PARTIAL: return 3;
        case RankedGrasps::STATUS_CANCELLED: return 4;
        case RankedGrasps::STATUS_INTERNAL_ERROR: return 1;
        default: return 2;
    }
}

int run(const rclcpp::Node::SharedPtr& node, const std::string& file, const std::string& gripper) {
    auto client = node->create_client<PlanGrasps>("/graspd/plan_grasps");
    auto request = std::make_shared<PlanGrasps::Request>();
    request->request.header.frame_id = "object";
    request->request.client_id = node->get_name();
    request->request.request_id = "1";  // the same in every attempt: a retry
    request->request.gripper = gripper;
    request->request.mesh = read_off(file);
    if (!client->wait_for_service(10s)) throw std::runtime_error("no planner within 10 s");
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const auto response = call(node, *client, request);
        if (response && response->reply.status != RankedGrasps::STATUS_OVERLOADED) {
            print(node->get_logger(), response->reply);
            return exit_code(response->reply);
        }
        RCLCPP_WARN(node->get_logger(), response ? "the planner is busy" : "no reply in time");
        rclcpp::sleep_for(500ms * (attempt + 1));
    }
    return 4;
}

}  // namespace

int main(int argc, char** argv) {
    const auto arguments = rclcpp::init_and_remove_ros_arguments(argc, argv);
    auto node = std::make_shared<rclcpp::Node>("plan_grasps_client");
    int code = 2;
    try {
        if (arguments.size() != 3)
            throw std::runtime_error("usage: plan_grasps_client FILE GRIPPER");
        code = run(node, arguments[1], arguments[2]);
    } catch (const std::exception& error) {
        RCLCPP_ERROR(node->get_logger(), "%s", error.what());
    }
    rclcpp::shutdown();
    return code;
}
