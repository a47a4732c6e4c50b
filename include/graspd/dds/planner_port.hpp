#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/dds/dds_settings.hpp"
#include "graspd/dds/planner_state.hpp"
#include "graspd/planner/draw_plan.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd {

/// The sixteen bytes of a GUID: prefix, then entity id.
using GuidBytes = std::array<std::uint8_t, 16>;

/// Who asked for what. A request is (writer, request_id, payload_hash): the same three again are a
/// retry; the same writer and id with other bytes are two requests under one name.
struct RequestIdentity {
    GuidBytes writer{};              ///< of the DDS writer
    std::string client_id;           ///< its first 64 characters, unprintable ones shown as '?'
    std::string request_id;          ///< likewise; convert() refuses an id that this had to change
    std::uint64_t payload_hash = 0;  ///< content_hash() of the serialized payload
};

/// Of a request by the topic: 't', the writer's bytes, the request_id.
inline std::string topic_reply_key(const RequestIdentity& identity) {
    return "t" + std::string(identity.writer.begin(), identity.writer.end()) + identity.request_id;
}

/// How much geometry a request brings, counted before it is converted.
struct RequestSize {
    std::uint64_t vertices = 0;  ///< of the object's mesh
    std::uint64_t faces = 0;
    std::uint64_t points = 0;             ///< of the object's cloud
    std::uint64_t obstacle_vertices = 0;  ///< of all obstacles together
    std::uint64_t obstacle_faces = 0;
};

/// A request's bytes.
struct ReceivedPayload {
    std::vector<std::uint8_t> bytes;  ///< encapsulation header and members, as received
    bool by_service = false;          ///< else by the topic
};

/// A request as the listener took it. Nothing has been converted yet, so taking it is cheap.
/// Immutable but for take_over(), so safe to use from any thread.
class IncomingRequest {
public:
    virtual ~IncomingRequest() = default;

    virtual const RequestIdentity& identity() const = 0;
    virtual std::chrono::steady_clock::time_point received() const = 0;
    virtual const std::string& frame_id() const = 0;    ///< name of F, echoed in the reply
    virtual const std::string& object_key() const = 0;  ///< empty when geometry came along
    /// [s] from receipt to reply: as asked for, or the default where it is absent or no number
    virtual double time_budget_s() const = 0;
    virtual RequestSize size() const = 0;
    virtual bool is_call() const = 0;  ///< by the service: its caller alone can read the answer

    /// What the reply to it bears, whichever planner writes it: PeerHandlers::answered() names it.
    virtual std::string reply_key() const { return topic_reply_key(identity()); }
    /// Its time budget counts from `now` on: another planner should have answered it. To be called
    /// before others have it.
    virtual void take_over(std::chrono::steady_clock::time_point now) = 0;

    /// Null unless DdsSettings::keep_payloads asks for it.
    virtual std::shared_ptr<const ReceivedPayload> payload() const { return nullptr; }

    /// Checks every field and converts it. With an object_key the object is left empty for the
    /// caller to fill in.
    ///
    /// @param known  the grippers that a request may name
    /// @return kInvalidInput, kUnsupported (an option that is not served yet) or kUnknownGripper,
    ///         naming the field and its value. Cost: linear in the payload.
    virtual Result<PlanRequest> convert(std::span<const Gripper> known) const = 0;
};

/// Takes over a request. Called on the middleware's threads, perhaps on two at a time: must return
/// at once and not throw.
using RequestHandler = std::function<void(std::unique_ptr<IncomingRequest>)>;

/// Requests that their client has no use for any more.
struct CancelOrder {
    std::string client_id;   ///< as in RequestIdentity; empty: clients without an id
    std::string request_id;  ///< empty: every request of that client
};

/// Told of every CancelRequest; as RequestHandler.
using CancelHandler = std::function<void(const CancelOrder&)>;

/// Told of the GUID of a writer of service calls that has left, or whose participant has; as
/// RequestHandler.
using GoneHandler = std::function<void(const GuidBytes&)>;

/// Told of the other planners of the domain, where DdsSettings::watch_peers is on; as
/// RequestHandler. A planner goes by the GUID of the writer of its status.
struct PeerHandlers {
    /// It serves when it is alive, has said so and is not stopping.
    std::function<void(const GuidBytes& peer, bool serves)> peer;
    /// Told of every reply, our own too, by IncomingRequest::reply_key().
    std::function<void(const std::string& reply_key)> answered;
};

/// What goes back. The ids, frame_id and stamp are echoed from `to`, not from `reply`.
struct OutgoingReply {
    std::shared_ptr<const IncomingRequest> to;
    std::uint32_t attempt = 1;  ///< rises by one with every answer to the same identity
    PlanReply reply;
};

/// The daemon's end of the wire: the topics and the service of docs/interface.md, and its place in
/// the ROS 2 graph.
///
/// Malformed samples are refused and counted before they become a request.
class PlannerPort {
public:
    /// Joins the domain. Requests may arrive before this returns.
    /// @return kUnreadableFile for a profile file that is missing, broken or lacks a profile;
    ///         kInvalidInput for a bad setting; kInternal when the middleware refuses an endpoint
    static Result<std::unique_ptr<PlannerPort>> open(const DdsSettings& settings,
                                                     RequestHandler handler,
                                                     CancelHandler cancel = {},
                                                     GoneHandler gone = {},
                                                     PeerHandlers peers = {});
    /// Leaves the domain: stops listening, then removes every endpoint.
    virtual ~PlannerPort() = default;

    /// Writes one reply, to the topic or to the caller of the service; waits for a slow reader for
    /// the profile's max_blocking_time at most. A caller whose reply reader is not known yet is
    /// waited for, 100 ms at most. To be called from one thread. @return false: the reply is lost
    /// (and counted)
    virtual bool write(const OutgoingReply& reply) = 0;
    /// What write() puts on the topic: encapsulation header and members. Any thread.
    virtual std::vector<std::uint8_t> payload_of(const OutgoingReply& reply) const = 0;
    /// Writes what the planner says of itself to the topics status and diagnostics, and asserts
    /// that it is alive. To be called from one thread. @return false: not written
    virtual bool write_state(PlannerState state) = 0;
    /// Says that this planner is alive, which nobody hears before the first write_state(). With
    /// DdsSettings::watch_peers peers wait 0.5 s for it. Any thread.
    virtual void assert_alive() = 0;
    /// How peers know this planner.
    virtual GuidBytes id() const = 0;
    /// Writes the picture of a plan to the topic markers, in place of the one before; `reply` is
    /// what was answered. May be called beside write() and write_state(), from one thread.
    /// @return false: not written, or DdsSettings::markers is off
    virtual bool write_markers(const PlanPicture& picture, const OutgoingReply& reply) = 0;
    /// No call of a handler is under way or follows once this has returned. Not for the handler.
    virtual void stop_listening() = 0;
    /// Waits until every matched reader has confirmed every reply. @return false: not in that time
    virtual bool wait_acknowledged(std::chrono::milliseconds timeout) = 0;

    virtual std::uint64_t rejected_payloads() const = 0;  ///< malformed samples that were refused
    virtual std::uint64_t lost_replies() const = 0;       ///< calls of write() that gave false
};

}  // namespace graspd
