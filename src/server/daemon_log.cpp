#include "daemon_log.hpp"

#include <spdlog/fmt/ranges.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "profile_interfaces.hpp"
#include "request_line.hpp"

namespace graspd::server {

void open_log(const std::string& level) {
    auto log = spdlog::stderr_logger_mt("graspd");
    log->set_pattern("time=%Y-%m-%dT%H:%M:%S.%eZ level=%l %v", spdlog::pattern_time_type::utc);
    log->set_level(spdlog::level::from_str(level));
    log->flush_on(spdlog::level::trace);
    spdlog::set_default_logger(std::move(log));
}

void log_ready(const DaemonStart& start) {
    std::string names;
    for (const Gripper& gripper : start.grippers) {
        names += (names.empty() ? "" : " ") + gripper.name;
    }
    const DdsSettings& dds = start.dds;
    spdlog::info(
        "event=ready domain={} interfaces={} profile={} network={} security={} node={} "
        "request_topic={} "
        "planner_id={} "
        "version={} config_hash={} "
        "workers={} queue_capacity={} restarts={} grippers={}",
        dds.domain, log_value(profile_file_interfaces(dds.profile_file)),
        log_value(dds.profile_file), log_value(start.network_why),
        dds.security ? log_value(dds.security->certificate) : "off", log_value(full_name(dds.node)),
        log_value(dds.names.grasp_request), log_value(dds.planner_id), dds.version, dds.config_hash,
        start.server.workers, start.server.queue_capacity, start.restarts, log_value(names));
}

void log_cancel(const CancelOrder& order, std::size_t cancelled) {
    spdlog::info("event=cancel id={} client={} cancelled={}", log_value(order.request_id),
                 log_value(order.client_id), cancelled);
}

void log_dropped(std::size_t calls) {
    if (calls > 0) spdlog::info("event=caller_gone dropped={}", calls);
}

void log_received(const RequestIdentity& identity) {
    if (!spdlog::should_log(spdlog::level::debug)) return;
    spdlog::debug("event=received id={} client={}", log_value(identity.request_id),
                  log_value(identity.client_id));
}

void log_taken_over(const RequestIdentity& identity) {
    spdlog::info("event=taken_over id={} client={}", log_value(identity.request_id),
                 log_value(identity.client_id));
}

void log_takes_part(std::size_t peers) {
    spdlog::info("event=takes_part peers={}", peers);
}

void log_peer(const GuidBytes& peer, bool serves) {
    spdlog::info("event=peer guid={:02x} serves={}", fmt::join(peer, ""), serves);
}

void log_handed_over(std::size_t requests) {
    spdlog::info("event=handed_over requests={}", requests);
}

void log_answer(const Answer& answer) {
    const bool fault = answer.out.reply.status == PlanStatus::kInternalError || !answer.written;
    spdlog::log(fault ? spdlog::level::err : spdlog::level::info, "event=request {}",
                request_line(answer));
}

void log_drawn(const Answer& answer, const PlanPicture& picture, double ms) {
    spdlog::debug("event=drawn id={} faces={} of={} regions={} hands={} ms={:.1f}",
                  log_value(answer.out.reply.request_id), picture.object_F.faces.size(),
                  picture.all_faces, picture.regions.size(), picture.hands_F.size(), ms);
}

void log_not_drawn(const Answer& answer, const std::string& what) {
    spdlog::warn("event=not_drawn id={} what={}", log_value(answer.out.reply.request_id),
                 log_value(what));
}

void log_end(const ServiceCounters& counters, std::uint64_t rejected_payloads) {
    const auto count = [&](PlanStatus status) {
        return counters.answers.at(static_cast<std::size_t>(status));
    };
    spdlog::info(
        "event=stopped received={} ok={} no_grasp={} partial={} overloaded={} cancelled={} "
        "internal_error={} repeated={} lost={} abandoned_plans={} dropped={} rejected_payloads={}",
        counters.received, count(PlanStatus::kOk), count(PlanStatus::kNoGrasp),
        count(PlanStatus::kPartial), count(PlanStatus::kOverloaded), count(PlanStatus::kCancelled),
        count(PlanStatus::kInternalError), counters.repeated, counters.lost,
        counters.abandoned_plans, counters.dropped, rejected_payloads);
}

}  // namespace graspd::server
