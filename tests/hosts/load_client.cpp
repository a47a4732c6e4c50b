// Asks for one object again and again, so many requests at a time, and never twice for the same:
// what is not answered is lost. tests/hosts/hosts.py runs it on a host of its own.
//
//     load_client --object FILE --requests N --in-flight K --domain N --profile dds.xml
//
// Standard output, a line each as it happens; times in seconds on the machine's monotonic clock:
//     sent id=ID at=SECONDS
//     reply id=ID at=SECONDS planner=ID status=STATUS        also a second one to the same id
// Exit code 0 when every request was answered.

#include <graspd_msgs/graspdPubSubTypes.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <set>
#include <thread>

#include "convert_request.hpp"
#include "endpoints.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/mesh/read_object.hpp"
#include "participant.hpp"
#include "taking_listener.hpp"
#include "wire_types.hpp"

namespace graspd::hosts {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;
using namespace std::chrono_literals;

struct Arguments {
    DdsSettings dds;
    std::string object;
    std::string prefix = "r";
    std::size_t requests = 100;
    std::size_t in_flight = 8;
    int planners = 1;
};

constexpr std::chrono::seconds kLongestWait{20};
constexpr std::chrono::milliseconds kSecondReplies{500};  // time for one too many to come

double now_s() {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    return now.count();
}

template <class T>
T value_of(Result<T> result) {
    if (!result.ok()) throw std::runtime_error(result.error().detail);
    return std::move(result).value();
}

class Load {
public:
    explicit Load(const Arguments& arguments)
        : arguments_(arguments), participant_(value_of(dds::Participant::join(arguments.dds))) {
        PlanRequest request;
        request.request_id = "r";
        request.object_O = value_of(read_object(arguments.object)).object;
        request.grippers = {
            value_of(find_gripper("parallel_85", value_of(find_profiles()) / "grippers"))};
        sample_ = value_of(dds::write_request(request, "load"));
        participant_->create_reader(
            {arguments.dds.names.ranked_grasps,
             dds::fast::TypeSupport(new dds::wire::RankedGrasps_PubSubType), dds::kReplyEnds},
            &listener_);
        writer_ = participant_->create_writer(
            {arguments.dds.names.grasp_request,
             dds::fast::TypeSupport(new dds::wire::GraspRequest_PubSubType), dds::kRequestEnds},
            nullptr);
        if (writer_ == nullptr) throw std::runtime_error("no writer of requests");
    }
    ~Load() { listener_.stop(); }

    /// @return whether every request was answered
    bool run() {
        wait_matched();
        for (std::size_t i = 0; i < arguments_.requests; ++i) {
            if (!wait_until_open(arguments_.in_flight - 1)) return false;
            send(arguments_.prefix + std::to_string(i));
        }
        const bool all = wait_until_open(0);
        std::this_thread::sleep_for(kSecondReplies);
        return all;
    }

private:
    void wait_matched() {
        dds::fast::PublicationMatchedStatus status;
        const auto deadline = std::chrono::steady_clock::now() + kLongestWait;
        do {
            std::this_thread::sleep_for(50ms);
            writer_->get_publication_matched_status(status);
        } while (status.current_count < arguments_.planners &&
                 std::chrono::steady_clock::now() < deadline);
        std::this_thread::sleep_for(500ms);  // their writers are matched by then as well
    }
    bool wait_until_open(std::size_t count) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, kLongestWait, [&] { return open_.size() <= count; });
    }
    void send(const std::string& id) {
        sample_.request_id(id);
        {
            const std::scoped_lock lock(mutex_);
            open_.insert(id);
            std::printf("sent id=%s at=%.6f\n", id.c_str(), now_s());
        }
        // A writer whose history is full says so after a while: a reader does not confirm.
        while (writer_->write(&sample_, eprosima::fastrtps::rtps::c_InstanceHandle_Unknown) ==
               ReturnCode_t::RETCODE_TIMEOUT) {
        }
    }
    bool take(dds::fast::DataReader& reader) {
        dds::wire::RankedGrasps_ reply;
        dds::fast::SampleInfo info;
        if (reader.take_next_sample(&reply, &info) != ReturnCode_t::RETCODE_OK) return false;
        if (!info.valid_data || !reply.request_id().starts_with(arguments_.prefix)) return true;
        const std::scoped_lock lock(mutex_);
        std::printf("reply id=%s at=%.6f planner=%s status=%s\n", reply.request_id().c_str(),
                    now_s(), reply.planner_id().c_str(),
                    to_string(static_cast<PlanStatus>(reply.status())));
        std::fflush(stdout);
        open_.erase(reply.request_id());
        changed_.notify_all();
        return true;
    }

    const Arguments& arguments_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<std::string> open_;
    dds::wire::GraspRequest_ sample_;
    dds::TakingListener listener_{[this](auto& from) { return take(from); }};
    std::unique_ptr<dds::Participant> participant_;
    dds::fast::DataWriter* writer_ = nullptr;
};

int run(int argc, char** argv) {
    CLI::App app("Asks for one object again and again");
    try {
        Arguments to;
        app.add_option("--object", to.object, "mesh or cloud")->required();
        app.add_option("--requests", to.requests, "how many");
        app.add_option("--in-flight", to.in_flight, "so many at a time")
            ->check(CLI::PositiveNumber);
        app.add_option("--prefix", to.prefix, "of the requests' ids");
        app.add_option("--planners", to.planners, "waits for so many");
        app.add_option("--domain", to.dds.domain)->check(CLI::Range(0, 232));
        app.add_option("--profile", to.dds.profile_file, "Fast DDS profiles")->required();
        CLI11_PARSE(app, argc, argv);
        return Load(to).run() ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << "load_client: " << error.what() << '\n';
        return 2;
    }
}

}  // namespace
}  // namespace graspd::hosts

int main(int argc, char** argv) {
    return graspd::hosts::run(argc, argv);
}
