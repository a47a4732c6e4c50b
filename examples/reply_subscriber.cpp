// Prints the grasps that graspd publishes, with nothing but Fast DDS and the generated types:
//
//     reply_subscriber --count 1 --timeout 30
//
// Replies are kept for a minute for readers that come late, so it may be started after the request.

#include <graspd_msgs/graspdPubSubTypes.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <iostream>

#include "graspd/config/profile_directory.hpp"
#include "participant.hpp"

namespace {

namespace msg = graspd_msgs::msg::dds_;

struct Arguments {
    int count = 0;      ///< replies to wait for; 0: until the timeout
    int timeout_s = 0;  ///< for all of them; 0: for ever
    std::size_t top = 5;
    std::string profile = (graspd::find_profiles().value() / "dds" / "loopback.xml").string();
    std::uint32_t domain = 0;
};

void add_options(CLI::App& app, Arguments& to) {
    app.add_option("--count", to.count, "leave after so many replies; 0: never");
    app.add_option("--timeout", to.timeout_s, "[s] leave after so long; 0: never");
    app.add_option("--top", to.top, "grasps to print of each reply");
    app.add_option("--profile", to.profile, "Fast DDS profiles");
    app.add_option("--domain", to.domain)->envname("ROS_DOMAIN_ID")->check(CLI::Range(0, 232));
}

/// In the order of RankedGrasps__Constants.
const char* status_name(std::uint8_t status) {
    constexpr std::array kNames = {"OK",
                                   "NO_GRASP",
                                   "PARTIAL",
                                   "INVALID_REQUEST",
                                   "UNKNOWN_OBJECT",
                                   "UNKNOWN_GRIPPER",
                                   "OVERLOADED",
                                   "CANCELLED",
                                   "INTERNAL_ERROR"};
    return status < kNames.size() ? kNames.at(status) : "?";
}

/// One line: the pads' midpoint (TCP) and the direction Gz in which the hand approaches it.
void print(std::size_t rank, const msg::Grasp_& grasp) {
    const auto& p = grasp.pose().position();
    const auto& q = grasp.pose().orientation();
    const double approach_x = 2 * (q.x() * q.z() + q.w() * q.y());
    const double approach_y = 2 * (q.y() * q.z() - q.w() * q.x());
    const double approach_z = 1 - 2 * (q.x() * q.x() + q.y() * q.y());
    std::printf("%4zu  %5.3f %7.1f %7.1f  %8.1f %8.1f %8.1f    %5.2f %5.2f %5.2f\n", rank,
                grasp.score(), 1e3 * grasp.width(), 1e3 * grasp.open_width(), 1e3 * p.x(),
                1e3 * p.y(), 1e3 * p.z(), approach_x, approach_y, approach_z);
}

void print(const msg::RankedGrasps_& reply, std::size_t top) {
    double planned_ms = 0.0;
    for (const auto& stage : reply.report().stages()) planned_ms += stage.ms();
    std::printf("\nrequest %s: %s, %zu grasps, planned in %.1f ms, frame \"%s\"\n",
                reply.request_id().c_str(), status_name(reply.status()), reply.grasps().size(),
                planned_ms, reply.header().frame_id().c_str());
    if (!reply.message().empty()) std::printf("%s\n", reply.message().c_str());
    if (!reply.grasps().empty()) {
        std::printf(
            "rank  score   width    open   TCP  x        y        z [mm]  approach x y z\n");
    }
    for (std::size_t i = 0; i < std::min(top, reply.grasps().size()); ++i) {
        print(i + 1, reply.grasps()[i]);
    }
    std::fflush(stdout);
}

/// @return whether as many replies came as were asked for
bool listen(const Arguments& arguments) {
    using Clock = std::chrono::steady_clock;
    example::Participant participant(arguments.domain, arguments.profile);
    auto* reader = participant.reader("rt/graspd/ranked_grasps",
                                      example::dds::TypeSupport(new msg::RankedGrasps_PubSubType()),
                                      "/graspd/ranked_grasps");
    const auto end = Clock::now() + std::chrono::seconds(arguments.timeout_s);
    int seen = 0;
    while (arguments.count == 0 || seen < arguments.count) {
        if (arguments.timeout_s > 0 && Clock::now() >= end) return arguments.count == 0;
        if (!reader->wait_for_unread_message({0, 100'000'000})) continue;
        msg::RankedGrasps_ reply;
        example::dds::SampleInfo info;
        // A sample that cannot be decoded throws here, in this thread, so main reports it.
        while (reader->take_next_sample(&reply, &info) == example::ReturnCode_t::RETCODE_OK) {
            if (!info.valid_data) continue;  // a planner has left
            print(reply, arguments.top);
            ++seen;
        }
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Prints the ranked grasps that graspd publishes");
    try {
        Arguments arguments;
        add_options(app, arguments);
        CLI11_PARSE(app, argc, argv);
        if (listen(arguments)) return 0;
        std::cerr << "reply_subscriber: too few replies within " << arguments.timeout_s << " s\n";
        return 4;
    } catch (const std::exception& error) {
        std::cerr << "reply_subscriber: " << error.what() << '\n';
        return 1;
    }
}
