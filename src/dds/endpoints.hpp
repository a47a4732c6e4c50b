#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

namespace graspd::dds {

namespace fast = eprosima::fastdds::dds;

/// What both ends of a topic promise each other. A profile of the topic's name in the profile file
/// may say how (buffers, heartbeats), never something else; without one the built-in QoS holds.
/// All endpoints are reliable.
struct Contract {
    const char* profile;           ///< its name: that of the topic before any remapping
    bool transient_local = false;  ///< a reader that comes late gets what was written before
    std::int32_t depth = 0;        ///< samples kept; 0: all, as far as `limit` goes
    std::int32_t limit = 64;       ///< samples that a history of unlimited depth holds
    std::int32_t lifespan_s = 0;   ///< [s] after which a sample is dropped; 0: never
    std::int32_t lease_ms = 0;     ///< [ms] of MANUAL_BY_TOPIC liveliness; 0: none
    bool watches_lease = false;    ///< its reader is told when a writer misses the lease
    bool greets = false;           ///< its writer can say where it stands (reply_writer.hpp)
    bool required = false;         ///< the profile file must have it
    bool announces_hash = true;    ///< of the type; false: the layout is not the one it is of
    /// Its writer sends on a thread that it shares with no other: megabytes that nobody waits for
    /// must not stand before a reply.
    bool sends_apart = false;
};

inline constexpr Contract kRequestEnds{
    .profile = "/graspd/grasp_request", .limit = 32, .required = true};
inline constexpr Contract kReplyEnds{.profile = "/graspd/ranked_grasps",
                                     .transient_local = true,
                                     .limit = 256,
                                     .lifespan_s = 60,
                                     .greets = true,
                                     .required = true};
inline constexpr Contract kCancelEnds{.profile = "/graspd/cancel"};
inline constexpr Contract kStatusEnds{
    .profile = "/graspd/status", .transient_local = true, .depth = 1, .lease_ms = 3000};
inline constexpr Contract kDiagnosticsEnds{.profile = "/diagnostics", .depth = 10};
inline constexpr Contract kMarkersEnds{
    .profile = "/graspd/markers", .transient_local = true, .depth = 1, .sends_apart = true};
inline constexpr Contract kServiceRequestEnds{.profile = "/graspd/plan_graspsRequest", .limit = 32};
/// Of every service: ROS 2's readers of replies may come after the writer, see ReplyWriter.
constexpr Contract service_reply_ends(const char* profile) {
    return {.profile = profile,
            .transient_local = true,
            .limit = 256,
            .lifespan_s = 60,
            .greets = true};
}
inline constexpr Contract kServiceReplyEnds = service_reply_ends("/graspd/plan_graspsReply");
inline constexpr Contract kMoveItRequestEnds{.profile = "/plan_graspsRequest", .limit = 32};
inline constexpr Contract kMoveItReplyEnds = service_reply_ends("/plan_graspsReply");
inline constexpr Contract kGraphEnds{
    .profile = "ros_discovery_info", .transient_local = true, .depth = 1};

// Of planners that watch each other. A dead one's requests pass on after the lease.
inline constexpr std::int32_t kPeerLease_ms = 500;
inline constexpr Contract kPeerStatusEnds{.profile = "graspd_peer_status",
                                          .transient_local = true,
                                          .limit = 1024,
                                          .lease_ms = kPeerLease_ms,
                                          .watches_lease = true};
/// A reader that is matched late hears of the replies before, and what it holds is held no longer.
inline constexpr Contract kPeerReplyEnds{.profile = "graspd_peer_replies",
                                         .transient_local = true,
                                         .limit = 1024,
                                         .announces_hash = false};

/// The sender of writers that send apart; every participant knows it, none has its thread without
/// such a writer.
inline constexpr const char* kSenderApart = "graspd_sender_apart";

/// The contract as built in.
fast::DataReaderQos reader_qos(const Contract& contract);
fast::DataWriterQos writer_qos(const Contract& contract);
/// What no profile changes: a writer that greets does so by asserting its liveliness.
void set_greeting(const Contract& contract, fast::DataWriterQos& qos);

/// What a profile says against the contract, such as "must be RELIABLE"; empty: nothing.
std::string broken_contract(const fast::DataReaderQos& qos, const Contract& contract);
std::string broken_contract(const fast::DataWriterQos& qos, const Contract& contract);

}  // namespace graspd::dds
