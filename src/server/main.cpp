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
#include "describe_state.hpp"
#include "graspd/base/freed_memory.hpp"
#include "graspd/config/domain_id.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/load_moveit_hand.hpp"
#include "graspd/config/network_profile.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/security.hpp"
#include "graspd/config/version.hpp"
#include "graspd/config/wire_names.hpp"
#include "graspd/dds/payloads.hpp"
#include "idle_watch.hpp"
#include "memory_fence.hpp"
#include "painter.hpp"
#include "planner_service.hpp"
#include "request_line.hpp"
#include "request_recorder.hpp"
#include "supervisor.hpp"

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

/// Everything that was read before a thread starts.
struct Setup {
    DaemonConfig config;
    DdsSettings dds;
    std::string network_why;  ///< what chose the profile file
    std::vector<Gripper> grippers;
    std::uint32_t restarts = 0;  ///< by the supervisor
};

std::string process_name() {
    std::array<char, 256> host{};
    const bool known = ::gethostname(host.data(), host.size() - 1) == 0;
    return std::string(known ? host.data() : "graspd") + ":" + std::to_string(::getpid());
}

Result<Setup> read_setup(const DaemonArguments& arguments, DaemonConfig config) {
    const auto domain = choose_domain(arguments.domain);
    if (!domain.ok()) return domain.error();
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    auto grippers = load_grippers(profiles.value() / "grippers");
    if (!grippers.ok()) return grippers.error();
    auto hands = load_moveit_hands(profiles.value() / "grippers");
    if (!hands.ok()) return hands.error();
    auto moveit = moveit_settings(config.ros, std::move(hands).value());
    if (!moveit.ok()) return moveit.error();
    auto network = choose_network(arguments.profile_file, profiles.value(), network_environment());
    if (!network.ok()) return network.error();
    auto names = wire_names(arguments.ros);
    if (!names.ok()) return names.error();
    auto security = choose_security(arguments.ros.enclave, security_variables());
    if (!security.ok()) return security.error();
    DdsSettings dds;
    dds.domain = domain.value();
    dds.profile_file = network.value().profile_file;
    dds.static_peers = network.value().static_peers;
    dds.security = std::move(security).value();
    dds.names = std::move(names).value();
    dds.node = ros_node(arguments.ros, config.ros);
    dds.moveit = std::move(moveit).value();
    dds.planner_id = process_name();
    dds.version = version();
    dds.config_hash = config_hash(config.planner);
    dds.max_payload_bytes = config.server.max_payload_bytes;
    dds.limits = {config.planner.condition_mesh.max_vertices,
                  config.planner.condition_mesh.max_faces,
                  config.planner.triangulate_cloud.limit_points, config.server.max_obstacle_faces};
    dds.keep_payloads = !config.server.record_dir.empty();
    dds.markers = config.server.markers_when() != MarkersWhen::kNever;
    return Setup{config, std::move(dds), network.value().why, std::move(grippers).value(),
                 restarts_from_environment()};
}

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
    auto opened = PlannerPort::open(
        setup.dds,
        [&](auto request) {
            log_received(request->identity());
            if (record != nullptr) record->received(*request);
            service.handle(std::move(request));
        },
        [&](const CancelOrder& order) { log_cancel(order, service.cancel(order)); },
        [&](const auto& writer) { log_dropped(service.drop(writer)); });
    if (!opened.ok()) return fail(opened.error());
    port = std::move(opened).value();
    service.start();
    const auto tell = [&](bool stopping) {
        PlannerState state =
            describe_state(service.counters(), setup.config.server, setup.grippers, stopping);
        state.restarts = setup.restarts;
        port->write_state(std::move(state));
    };
    IdleWatch idle(std::chrono::milliseconds(setup.config.server.idle_trim_ms));
    Beat beat(kStatusPeriod, [&] {
        tell(false);
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
    tell(true);
    const bool ended = service.stop(kStopGrace);
    painter.stop();
    const bool confirmed = port->wait_acknowledged(kAcknowledgeWait);
    if (!confirmed) spdlog::warn("event=unconfirmed what=\"some replies were not acknowledged\"");
    log_end(service.counters(), port->rejected_payloads());
    if (record != nullptr) close_recorder(*record);
    const int code = is_worn_out ? kExitInternal : 0;
    if (!ended) std::_Exit(code);  // a planner that does not stop must not keep the process
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
