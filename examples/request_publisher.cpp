// Asks graspd for grasps, with nothing but Fast DDS and the generated types:
//
//     request_publisher mug.stl --id mug-1 --gripper parallel_85
//
// The reply goes to whoever reads rt/graspd/ranked_grasps; reply_subscriber prints it.

#include <graspd_msgs/graspdPubSubTypes.h>
#include <CLI/CLI.hpp>
#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <iostream>

#include "graspd/config/profile_directory.hpp"
#include "graspd/mesh/read_object.hpp"
#include "participant.hpp"

namespace {

using graspd_msgs::msg::dds_::GraspRequest_;
using graspd_msgs::msg::dds_::GraspRequest_PubSubType;

struct Arguments {
    std::string file;
    double scale = 1.0;  ///< from the file's unit to metres
    std::string id = "request-1";
    std::string gripper = "parallel_85";
    std::string profile = (graspd::find_profiles().value() / "dds" / "loopback.xml").string();
    std::uint32_t domain = 0;
    int timeout_s = 10;
};

void add_options(CLI::App& app, Arguments& to) {
    app.add_option("FILE", to.file, "STL, OBJ, OFF or PLY with faces")->required();
    app.add_option("--scale", to.scale, "factor from the file's numbers to metres");
    app.add_option("--id", to.id, "request id; the same id with the same object is a retry");
    app.add_option("--gripper", to.gripper, "a gripper that graspd knows: graspctl grippers");
    app.add_option("--profile", to.profile, "Fast DDS profiles");
    app.add_option("--domain", to.domain)->envname("ROS_DOMAIN_ID")->check(CLI::Range(0, 232));
    app.add_option("--timeout", to.timeout_s, "[s] for each wait")->check(CLI::Range(1, 3600));
}

/// Coordinates as they stand in the file are frame O; without an object_pose, O is F.
GraspRequest_ make_request(const Arguments& arguments) {
    const auto object = graspd::read_object(arguments.file, arguments.scale);
    if (!object.ok()) throw std::runtime_error(object.error().detail);
    const auto* mesh = std::get_if<graspd::TriangleMesh>(&object.value().object);
    if (mesh == nullptr) throw std::runtime_error(arguments.file + " holds points without faces");

    GraspRequest_ request;
    request.header().frame_id("object");
    request.client_id("request_publisher");
    request.request_id(arguments.id);
    request.gripper(arguments.gripper);
    for (const Eigen::Vector3d& vertex : mesh->vertices) {
        auto& point = request.mesh().vertices().emplace_back();
        point.x(vertex.x());
        point.y(vertex.y());
        point.z(vertex.z());
    }
    for (const graspd::Triangle& face : mesh->faces) {
        request.mesh().triangles().emplace_back().vertex_indices(face);
    }
    return request;
}

/// A sample written before a reader is known would be lost: requests are volatile.
void wait_for_planner(example::dds::DataWriter& writer, int timeout_s) {
    auto& matched = writer.get_statuscondition();
    matched.set_enabled_statuses(example::dds::StatusMask::publication_matched());
    example::dds::WaitSet wait_set;
    wait_set.attach_condition(matched);
    example::dds::ConditionSeq active;
    example::dds::PublicationMatchedStatus status;
    writer.get_publication_matched_status(status);
    if (status.current_count > 0) return;
    wait_set.wait(active, eprosima::fastrtps::Duration_t(timeout_s, 0));
    writer.get_publication_matched_status(status);
    if (status.current_count < 1) throw std::runtime_error("no planner was found in time");
}

void publish(const Arguments& arguments) {
    GraspRequest_ request = make_request(arguments);
    example::Participant participant(arguments.domain, arguments.profile);
    auto* writer = participant.writer("rt/graspd/grasp_request",
                                      example::dds::TypeSupport(new GraspRequest_PubSubType()),
                                      "/graspd/grasp_request");
    wait_for_planner(*writer, arguments.timeout_s);
    if (!writer->write(&request)) throw std::runtime_error("the request could not be sent");
    // Leaving now would take an unsent request along.
    if (writer->wait_for_acknowledgments({arguments.timeout_s, 0}) !=
        example::ReturnCode_t::RETCODE_OK) {
        throw std::runtime_error("the planner did not confirm the request");
    }
    std::cout << "request " << arguments.id << ": " << request.mesh().triangles().size()
              << " triangles sent\n";
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Publishes a mesh file as a request for grasps");
    try {
        Arguments arguments;
        add_options(app, arguments);
        CLI11_PARSE(app, argc, argv);
        publish(arguments);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "request_publisher: " << error.what() << '\n';
        return 1;
    }
}
