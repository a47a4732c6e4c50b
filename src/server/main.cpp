#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>

#include "beat.hpp"
#include "daemon_arguments.hpp"
#include "daemon_log.hpp"
#include "daemon_setup.hpp"
#include "describe_state.hpp"
#include "exit_on_abort.hpp"
#include "graspd/base/freed_memory.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/version.hpp"
#include "graspd/dds/payloads.hpp"
#include "idle_watch.hpp"
#include "memory_fence.hpp"
#include "painter.hpp"
#include "planner_service.hpp"
#include "request_line.hpp"
#include "request_recorder.hpp"
#include "supervisor.hpp"
#include "work_share.hpp"

// graspd: the planner as a DDS participant. Here, and nowhere else, it is decided what is built
// with what.

namespace {

using namespace graspd;          // NOLINT(google-build-using-namespace): this is its program
using namespace graspd::server;  // NOLINT(google-build-using-namespace)

constexpr int kExitInternal = 1;  // as graspctl's
constexpr int kExitUsage = 2;

// Together they keep the promise to be gone two seconds after SIGTERM, with time left for the
// middleware to leave the domain.
constexpr std::chrono::milliseconds kStopGrace{500};  // PlannerService::stop takes twice that
constexpr std::chrono::milliseconds kAcknowledgeWait{300};
constexpr std::chrono::milliseconds kStatusPeriod{1000};
constexpr unsigned kBeatsPerStatus = 8;  // where peers listen, who miss a planner after 500 ms

int fail(const PlanError& error) {
    std::cerr << "graspd: " << error.detail << '\n';
    return error.code == PlanErrorCode::kInternal ? kExitInternal : kExitUsage;
}

/// What writes requests to files; null where the configuration asks for none.
Result<std::unique_ptr<RequestRecorder>> open_recorder(const Setup& setup) {
    const ServerConfig& config = setup.config.server;
    if (config.record_dir.empty()) return std::unique_ptr<RequestRecorder>();
    return RequestRecorder::open(
        {config.record_dir, config.record_max_requests, config.record_max_bytes, setup.dds.version,
         setup.dds.config_hash},
        {[&](const ObjectGeometry& geometry) {
             PlanRequest request;
             request.request_id = "object";
             request.object_O = geometry;
             request.grippers = {setup.grippers.front()};  // a request needs one
             auto payload = request_payload(request, "");
             return payload.ok() ? std::move(payload).value() : std::vector<std::uint8_t>{};
         },
         [](const std::string& what, std::uint64_t failures) {
             spdlog::warn("event=record_failed failures={} what={}", failures, log_value(what));
         }});
}

void close_recorder(RequestRecorder& recorder) {
    recorder.close();
    spdlog::info("event=recorded requests={} failures={}", recorder.recorded(),
                 recorder.failures());
}

/// Wakes serve() as a signal from outside would, for a process that should not go on.
void ask_for_the_end(std::atomic<bool>& is_worn_out, std::uint64_t abandoned) {
    spdlog::error("event=exhausted abandoned_plans={} what=\"ends with 1, to be started anew\"",
                  abandoned);
    is_worn_out = true;
    ::kill(::getpid(), SIGTERM);
}

/// What pictures are drawn and published with. Refers to its arguments.
PainterParts painter_parts(const Setup& setup, const std::unique_ptr<PlannerPort>& port) {
    return {[&](const Answer& answer) {
                const auto start = std::chrono::steady_clock::now();
                const ServerConfig& config = setup.config.server;
                const auto picture =
                    draw_plan(*answer.work.drawable, answer.out.reply.grasps, setup.config.planner,
                              {config.markers_max_faces, config.markers_max_grasps});
                if (!picture.ok()) return log_not_drawn(answer, picture.error().detail);
                if (!port->write_markers(picture.value(), answer.out)) {
                    return log_not_drawn(answer, "the middleware did not take it");
                }
                const std::chrono::duration<double, std::milli> taken =
                    std::chrono::steady_clock::now() - start;
                log_drawn(answer, picture.value(), taken.count());
            },
            log_not_drawn};
}

/// What the service tells of its answers, beside the log.
struct Listeners {
    RequestRecorder* record = nullptr;  ///< null: nothing is recorded
    Painter& painter;
};

/// What the service plans, writes and logs with. Refers to its arguments.
ServiceParts parts_of(const Setup& setup, const std::unique_ptr<PlannerPort>& port,
                      const Listeners& listeners, std::atomic<bool>& is_worn_out) {
    return {setup.grippers,
            [&](const PlanRequest& request, PreparedObjectPtr& object, const StopQuery& stop) {
                spdlog::debug("event=planning id={}", log_value(request.request_id));
                return plan(request, object, setup.config.planner, stop);
            },
            [&](const OutgoingReply& reply) { return port->write(reply); },
            [&port, listeners](const Answer& answer) {
                log_answer(answer);
                listeners.painter.answered(answer);
                if (listeners.record != nullptr) {
                    listeners.record->answered(answer, port->payload_of(answer.out));
                }
            },
            [&] { ask_for_the_end(is_worn_out, setup.config.server.abandoned_plans); }};
}

/// Joins the domain; what comes goes to `share`, which gives the service its part.
Result<std::unique_ptr<PlannerPort>> open_port(const DdsSettings& settings, PlannerService& service,
                                               WorkShare& share) {
    const auto now = [] { return WorkShare::Clock::now(); };
    return PlannerPort::open(
        settings,
        [&share, now](auto request) {
            log_received(request->identity());
            share.receive(std::move(request), now());
        },
        [&service](const CancelOrder& order) { log_cancel(order, service.cancel(order)); },
        [&service, &share](const GuidBytes& writer) {
            share.drop(writer);
            log_dropped(service.drop(writer));
        },
        {[&share, now](const GuidBytes& peer, bool serves) {
             log_peer(peer, serves);
             share.see(peer, serves, now());
         },
         [&share, now](const std::string& key) { share.answered(key, now()); }});
}

/// One beat: tells what this planner does, or no more than that it is alive, from when `share` says
/// that others may know.
class Herald {
public:
    Herald(WorkShare& share, PlannerPort& port, unsigned beats_per_status,
           std::function<void()> tell)
        : share_(share), port_(port), beats_per_status_(beats_per_status), tell_(std::move(tell)) {}

    void operator()() {
        if (!share_.tick(std::chrono::steady_clock::now())) return;
        const ShareCounters now = share_.counters();
        if (now.takes_part != takes_part_) log_takes_part(now.peers);
        takes_part_ = now.takes_part;
        if (beats_++ % beats_per_status_ == 0) return tell_();
        port_.assert_alive();
    }

private:
    WorkShare& share_;
    PlannerPort& port_;
    const unsigned beats_per_status_;
    const std::function<void()> tell_;
    unsigned beats_ = 0;
    bool takes_part_ = false;  ///< as logged
};

/// Answers what is open, or leaves it to others. @return whether every thread of the service ended
bool wind_down(PlannerService& service, WorkShare& share, const std::function<void()>& tell) {
    if (!share.leave()) {
        tell();
        return service.stop(kStopGrace);
    }
    // Who takes the requests over must not hear that this planner stops before its last reply.
    log_handed_over(service.hand_over());
    const bool ended = service.stop(kStopGrace);
    tell();
    return ended;
}

/// Serves until a signal comes, or too many plans did not stop. @return the exit code
int serve(const Setup& setup, const sigset_t& signals) {
    const auto recorder = open_recorder(setup);
    if (!recorder.ok()) return fail(recorder.error());
    RequestRecorder* const record = recorder.value().get();
    std::unique_ptr<PlannerPort> port;
    std::atomic<bool> is_worn_out{false};
    Painter painter(painter_parts(setup, port));
    PlannerService service(setup.config.server,
                           parts_of(setup, port, {record, painter}, is_worn_out));
    WorkShare share(
        setup.config.share,
        [&](std::unique_ptr<IncomingRequest> request, bool taken_over) {
            if (taken_over) log_taken_over(request->identity());
            if (record != nullptr) record->received(*request);
            service.handle(std::move(request));
        },
        WorkShare::Clock::now());
    auto opened = open_port(setup.dds, service, share);
    if (!opened.ok()) return fail(opened.error());
    port = std::move(opened).value();
    share.set_self(port->id());
    service.start();
    const auto tell = [&](bool stopping) {
        PlannerState state =
            describe_state(service.counters(), setup.config.server, setup.grippers, stopping);
        state.restarts = setup.restarts;
        describe_share(share.counters(), state);
        port->write_state(std::move(state));
    };
    IdleWatch idle(std::chrono::milliseconds(setup.config.server.idle_trim_ms));
    const unsigned beats_per_status = setup.config.share.enabled ? kBeatsPerStatus : 1;
    Herald herald(share, *port, beats_per_status, [&] { tell(false); });
    Beat beat(kStatusPeriod / beats_per_status, [&] {
        herald();
        const ServiceCounters now = service.counters();
        if (idle.is_due(now.received, now.open, std::chrono::steady_clock::now())) {
            give_back_freed_memory();
        }
    });
    log_ready({setup.dds, setup.config.server, setup.network_why, setup.grippers, setup.restarts});

    int signal = 0;
    sigwait(&signals, &signal);
    spdlog::info("event=stopping signal={}", signal);
    port->stop_listening();
    beat.stop();
    const bool ended = wind_down(service, share, [&] { tell(true); });
    painter.stop();
    const bool confirmed = port->wait_acknowledged(kAcknowledgeWait);
    if (!confirmed) spdlog::warn("event=unconfirmed what=\"some replies were not acknowledged\"");
    log_end(service.counters(), port->rejected_payloads());
    if (record != nullptr) close_recorder(*record);
    const int code = is_worn_out ? kExitInternal : 0;
    if (!ended) std::_Exit(code);  // a planner that does not stop must not keep the process
    exit_on_abort(code);           // the middleware is left to leave the domain
    return code;
}

/// Needs neither threads nor DDS, and so outlives what kills the participant.
int supervise_participant(const std::vector<std::string>& participant,
                          const SupervisorConfig& config) {
    return supervise(participant, config, [](bool fault, const std::string& line) {
        spdlog::log(fault ? spdlog::level::err : spdlog::level::info, "{}", line);
    });
}

int run(const DaemonArguments& arguments, const std::vector<std::string>& participant,
        const sigset_t& signals) {
    const auto config = daemon_config(arguments);
    if (!config.ok()) return fail(config.error());
    if (arguments.print_config) {
        std::cout << print_config(config.value()) << std::flush;
        return std::cout ? 0 : kExitInternal;
    }
    open_log(arguments.log_level);
    if (arguments.supervise) return supervise_participant(participant, config.value().supervisor);
    const auto setup = read_setup(arguments, config.value());
    if (!setup.ok()) return fail(setup.error());
    const std::uint64_t fence = setup.value().config.server.max_address_space_bytes;
    if (!fence_memory(fence)) {
        return fail({PlanErrorCode::kInvalidInput,
                     "server.max_address_space_bytes = " + std::to_string(fence) + " is refused"});
    }
    return serve(setup.value(), signals);
}

}  // namespace

int main(int argc, char** argv) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // before any thread, so that all inherit it
    std::signal(SIGPIPE, SIG_IGN);                  // whoever reads the log may leave
    const auto arguments = parse_daemon_arguments(argc, argv);
    if (const int* code = std::get_if<int>(&arguments)) return *code;
    keep_freed_memory(kFreedMemory_bytes);
    try {
        return run(std::get<DaemonArguments>(arguments), participant_arguments(argc, argv),
                   signals);
    } catch (const std::exception& error) {
        return fail({PlanErrorCode::kInternal, error.what()});
    }
}
