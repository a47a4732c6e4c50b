// One client of scripts/soak: asks the questions of soak_requests.hpp one after the other.
//
//     soak_client --client soak-0 --first 0 --count 100 --domain N --profile dds.xml
//     soak_client --watch --domain N --profile dds.xml          prints every reply on the wire
//
// Standard output, a line each as it happens:
//     asked id=ID kind=KIND status=STATUS ms=MILLISECONDS verdict=ok|lost|wrong
//     reply planner=ID writer=GUID client=ID id=ID attempt=N status=STATUS
// Exit code 0 when every question had an answer that it may have.

#include <graspd_msgs/graspdPubSubTypes.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <thread>

#include "endpoints.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/dds/planner_client.hpp"
#include "participant.hpp"
#include "soak_requests.hpp"
#include "taking_listener.hpp"
#include "wire_types.hpp"

// Fast DDS has a namespace ::dds of its own.
namespace graspd::soak {
namespace {

using Clock = std::chrono::steady_clock;
using eprosima::fastrtps::types::ReturnCode_t;

struct Arguments {
    DdsSettings dds;
    std::string client = "soak";
    std::uint64_t first = 0;
    std::uint64_t count = 100;
    int timeout_ms = 3000;
    std::uint32_t retries = 20;
    int cancel_after_ms = 10;
    bool watch = false;
};

constexpr std::chrono::seconds kLinkComesBack{10};

template <class T>
T value_of(Result<T> result) {
    if (!result.ok()) throw std::runtime_error(result.error().detail);
    return std::move(result).value();
}

/// The link may be down just now.
template <class Open>
auto open_in_time(const Open& open) {
    const auto end = Clock::now() + kLinkComesBack;
    while (true) {
        auto result = open();
        if (result.ok() || Clock::now() > end) return value_of(std::move(result));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

/// Sends cancellations.
class Canceller {
public:
    explicit Canceller(const DdsSettings& settings)
        : participant_(open_in_time([&] { return dds::Participant::join(settings); })),
          writer_(participant_->create_writer(
              {settings.names.cancel,
               dds::fast::TypeSupport(new dds::wire::CancelRequest_PubSubType), dds::kCancelEnds},
              nullptr)) {
        if (writer_ == nullptr) throw std::runtime_error("no writer of cancellations");
    }
    void cancel(const std::string& client, const std::string& id) {
        dds::wire::CancelRequest_ order;
        order.client_id(client);
        order.request_id(id);
        writer_->write(&order);
    }

private:
    std::unique_ptr<dds::Participant> participant_;
    dds::fast::DataWriter* writer_;
};

/// What a reply must repeat when it is asked for again; the times differ.
bool same_answer(const PlanReply& one, const PlanReply& other) {
    return one.status == other.status && one.object_key == other.object_key &&
           std::ranges::equal(one.grasps, other.grasps, [](const Grasp& a, const Grasp& b) {
               return a.score == b.score && a.X_FG.matrix() == b.X_FG.matrix();
           });
}

class Asker {
public:
    explicit Asker(const Arguments& arguments)
        : arguments_(arguments),
          gripper_(value_of(find_gripper("parallel_85", value_of(find_profiles()) / "grippers"))),
          canceller_(arguments.dds),
          client_(
              open_in_time([&] { return PlannerClient::open(arguments.dds, arguments.client); })) {}

    /// @return whether all is well
    bool ask_all() {
        bool well = true;
        for (std::uint64_t i = 0; i < arguments_.count; ++i) {
            well = ask(make_question_of(arguments_.first + i)) && well;
        }
        return well;
    }

private:
    Question make_question_of(std::uint64_t number) const {
        return make_question(arguments_.client, number, gripper_);
    }

    bool ask(const Question& question) {
        const auto start = Clock::now();
        const auto reply = send(question);
        const std::chrono::duration<double, std::milli> time = Clock::now() - start;
        if (!reply.ok()) std::cerr << "soak_client: " << reply.error().detail << '\n';
        const std::string verdict = judge(question, reply);
        std::printf("asked id=%s kind=%s status=%s ms=%.2f verdict=%s\n",
                    question.request.request_id.c_str(), question.kind.c_str(),
                    reply.ok() ? to_string(reply.value().status) : "NONE", time.count(),
                    verdict.c_str());
        std::fflush(stdout);
        return verdict == "ok";
    }

    /// Asks again where the question says so.
    std::string judge(const Question& question, const Result<PlanReply>& reply) {
        if (!reply.ok()) return "lost";
        if (std::ranges::count(question.expected, reply.value().status) == 0) return "wrong";
        if (!question.again) return "ok";
        const auto second = send(question);
        if (!second.ok()) return "lost";
        return same_answer(reply.value(), second.value()) ? "ok" : "wrong";
    }

    Result<PlanReply> send(const Question& question) {
        std::jthread later;
        if (question.cancel) {
            later = std::jthread([this, id = question.request.request_id] {
                std::this_thread::sleep_for(std::chrono::milliseconds(arguments_.cancel_after_ms));
                canceller_.cancel(arguments_.client, id);
            });
        }
        return client_->request(question.request, std::chrono::milliseconds(arguments_.timeout_ms),
                                arguments_.retries);
    }

    const Arguments& arguments_;
    Gripper gripper_;
    Canceller canceller_;
    std::unique_ptr<PlannerClient> client_;
};

void print_reply(const dds::wire::RankedGrasps_& reply) {
    std::string writer;
    for (const auto byte : reply.request_writer()) {
        std::array<char, 3> hex{};
        std::snprintf(hex.data(), hex.size(), "%02x", static_cast<unsigned>(byte));
        writer += hex.data();
    }
    std::printf("reply planner=%s writer=%s client=%s id=%s attempt=%u status=%s\n",
                reply.planner_id().c_str(), writer.c_str(), reply.client_id().c_str(),
                reply.request_id().c_str(), reply.attempt(),
                to_string(static_cast<PlanStatus>(reply.status())));
    std::fflush(stdout);
}

/// Prints every reply until SIGTERM comes.
void watch(const Arguments& arguments) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // before any thread
    dds::TakingListener listener([](dds::fast::DataReader& reader) {
        dds::wire::RankedGrasps_ reply;
        dds::fast::SampleInfo info;
        if (reader.take_next_sample(&reply, &info) != ReturnCode_t::RETCODE_OK) return false;
        if (info.valid_data) print_reply(reply);
        return true;
    });
    const auto participant = value_of(dds::Participant::join(arguments.dds));
    const auto* reader = participant->create_reader(
        {arguments.dds.names.ranked_grasps,
         dds::fast::TypeSupport(new dds::wire::RankedGrasps_PubSubType), dds::kReplyEnds},
        &listener);
    if (reader == nullptr) throw std::runtime_error("no reader of replies");
    int signal = 0;
    sigwait(&signals, &signal);
    listener.stop();
}

int run(int argc, char** argv) {
    CLI::App app("One client of scripts/soak");
    try {
        Arguments to;
        app.add_option("--client", to.client, "its id");
        app.add_option("--first", to.first, "number of the first question");
        app.add_option("--count", to.count, "how many questions");
        app.add_option("--domain", to.dds.domain)->check(CLI::Range(0, 232));
        app.add_option("--profile", to.dds.profile_file, "Fast DDS profiles")->required();
        app.add_option("--timeout", to.timeout_ms, "[ms] for each attempt");
        app.add_option("--retries", to.retries, "how often a question is sent again");
        app.add_flag("--watch", to.watch, "print every reply on the wire instead");
        CLI11_PARSE(app, argc, argv);
        if (!to.watch) return Asker(to).ask_all() ? 0 : 1;
        watch(to);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "soak_client: " << error.what() << '\n';
        return 2;
    }
}

}  // namespace
}  // namespace graspd::soak

int main(int argc, char** argv) {
    return graspd::soak::run(argc, argv);
}
