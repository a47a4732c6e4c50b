#include "endpoints.hpp"

namespace graspd::dds {
namespace {

constexpr std::uint32_t kMillisecond_ns = 1000000;
constexpr std::uint32_t kHeartbeat_ns = 100 * kMillisecond_ns;  // 5 MB samples need it
constexpr std::uint32_t kHeartbeatResponse_ns = kMillisecond_ns;
constexpr std::uint32_t kLongestBlocking_ns = 200 * kMillisecond_ns;  // a slow reader's cost

/// Fast DDS sends no heartbeat on demand without a lease; nothing hangs on its length.
constexpr std::int32_t kGreetingLease_ms = 86400000;

/// What readers and writers have in common.
template <class Qos>
void apply(const Contract& contract, Qos& qos) {
    qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = contract.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS
                                                     : fast::VOLATILE_DURABILITY_QOS;
    qos.data_sharing().off();
    if (contract.depth > 0) {
        qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
        qos.history().depth = contract.depth;
    } else {
        qos.history().kind = fast::KEEP_ALL_HISTORY_QOS;
        qos.resource_limits().max_samples = contract.limit;
        qos.resource_limits().max_instances = 1;
        qos.resource_limits().max_samples_per_instance = contract.limit;
        qos.resource_limits().allocated_samples = 4;
    }
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
}

eprosima::fastrtps::Duration_t milliseconds(std::int32_t count) {
    return {count / 1000, static_cast<std::uint32_t>(count % 1000) * kMillisecond_ns};
}

template <class Qos>
void set_lease(std::int32_t lease_ms, Qos& qos) {
    qos.liveliness().kind = fast::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = milliseconds(lease_ms);
    qos.liveliness().announcement_period = milliseconds(lease_ms / 2);
}

template <class Qos>
std::string broken(const Qos& qos, const Contract& contract) {
    if (qos.reliability().kind != fast::RELIABLE_RELIABILITY_QOS) return "must be RELIABLE";
    const bool keeps_all = qos.history().kind == fast::KEEP_ALL_HISTORY_QOS;
    if (contract.depth == 0 && !keeps_all) return "must be KEEP_ALL";
    if (contract.depth > 0 && keeps_all) return "must be KEEP_LAST";
    const auto wanted = contract.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS
                                                 : fast::VOLATILE_DURABILITY_QOS;
    if (qos.durability().kind == wanted) return "";
    return contract.transient_local ? "must be TRANSIENT_LOCAL" : "must be VOLATILE";
}

}  // namespace

fast::DataReaderQos reader_qos(const Contract& contract) {
    fast::DataReaderQos qos;
    apply(contract, qos);
    qos.reliable_reader_qos().times.heartbeatResponseDelay = {0, kHeartbeatResponse_ns};
    if (contract.watches_lease) set_lease(contract.lease_ms, qos);
    return qos;
}

fast::DataWriterQos writer_qos(const Contract& contract) {
    fast::DataWriterQos qos;
    apply(contract, qos);
    qos.reliability().max_blocking_time = {0, kLongestBlocking_ns};
    qos.reliable_writer_qos().times.heartbeatPeriod = {0, kHeartbeat_ns};
    qos.publish_mode().kind = fast::ASYNCHRONOUS_PUBLISH_MODE;
    if (contract.sends_apart) qos.publish_mode().flow_controller_name = kSenderApart;
    if (contract.lifespan_s > 0) qos.lifespan().duration = {contract.lifespan_s, 0};
    if (contract.lease_ms > 0) set_lease(contract.lease_ms, qos);
    return qos;
}

void set_greeting(const Contract& contract, fast::DataWriterQos& qos) {
    if (contract.greets) set_lease(kGreetingLease_ms, qos);
}

std::string broken_contract(const fast::DataReaderQos& qos, const Contract& contract) {
    return broken(qos, contract);
}

std::string broken_contract(const fast::DataWriterQos& qos, const Contract& contract) {
    return broken(qos, contract);
}

}  // namespace graspd::dds
