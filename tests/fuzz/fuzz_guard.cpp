#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include <fastdds/rtps/common/SerializedPayload.h>
#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_reply.hpp"
#include "convert_state.hpp"
#include "guarded_type.hpp"
#include "moveit_service.hpp"
#include "raw_type.hpp"
#include "received_request.hpp"
#include "ros_graph.hpp"
#include "targets.hpp"

namespace graspd::fuzz {
namespace {

namespace wire = dds::wire;
using eprosima::fastdds::dds::SampleInfo;
using eprosima::fastrtps::rtps::SerializedPayload_t;

std::shared_ptr<dds::PayloadGuard> fresh_guard() {
    auto guard = std::make_shared<dds::PayloadGuard>();
    guard->max_payload_bytes = 5000;  // of a request; low, so that inputs reach the limits
    guard->limits = {100, 100, 200, 50};
    return guard;
}

/// Takes a payload through a type support as the middleware does: from a buffer of just its size.
/// Hands the sample on when it was not refused. @return whether it was accepted here and there
template <class Type, class Sample, class Use>
bool take(Type& type, dds::PayloadGuard& guard, Bytes bytes, const Use& use) {
    SerializedPayload_t payload(static_cast<std::uint32_t>(std::max<std::size_t>(bytes.size(), 1)));
    std::ranges::copy(bytes, payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    const std::uint64_t before = guard.rejected;
    const std::unique_ptr<void, void (*)(void*)> sample(
        type.createData(), [](void* data) { delete static_cast<Sample*>(data); });
    const bool taken = type.deserialize(&payload, sample.get());
    require(guard.rejected == before + (taken ? 0 : 1), "a refused sample is counted, once");
    return taken && use(*static_cast<Sample*>(sample.get()));
}

template <class Generated, class Sample = typename Generated::type, class Use>
bool take_guarded(Bytes bytes, const Use& use) {
    static const auto guard = fresh_guard();
    static dds::GuardedType<Generated, Sample> type(guard);
    return take<dds::GuardedType<Generated, Sample>, Sample>(type, *guard, bytes, use);
}

template <class Use>
bool take_raw(Bytes bytes, const Use& use) {
    static const auto guard = fresh_guard();
    static dds::RawType type("raw", guard);
    return take<dds::RawType, dds::Bytes>(type, *guard, bytes, use);
}

const std::vector<Gripper>& known_grippers() {
    static const std::vector<Gripper> known = [] {
        std::vector<Gripper> grippers(1);
        grippers[0].name = "parallel_85";
        return grippers;
    }();
    return known;
}

bool is_told(const std::string& text) {
    return !text.empty() && text.size() < 4096 && text.find('\0') == std::string::npos;
}

void check_identity(const RequestIdentity& identity) {
    for (const std::string& id : {identity.client_id, identity.request_id}) {
        require(id.size() <= 64, "an id in logs has at most 64 characters");
        require(std::ranges::all_of(id, [](char c) { return c >= 0x20 && c <= 0x7e; }),
                "an id in logs is printable");
    }
}

/// What is accepted can be sent and read.
bool check_conversion(const IncomingRequest& request) {
    check_identity(request.identity());
    require(request.time_budget_s() > 0.0 && std::isfinite(request.time_budget_s()),
            "every request has a budget");
    const auto converted = request.convert(known_grippers());
    if (!converted.ok()) {
        const auto code = converted.error().code;
        require(code == PlanErrorCode::kInvalidInput || code == PlanErrorCode::kUnsupported ||
                    code == PlanErrorCode::kTooLarge || code == PlanErrorCode::kUnknownGripper,
                "a request is refused for what is wrong with it");
        require(is_told(converted.error().detail), "a refusal says why");
        return false;
    }
    const PlanRequest& plan_request = converted.value();
    require(!plan_request.grippers.empty(), "a converted request has a gripper");
    for (const Gripper& gripper : plan_request.grippers) {
        require(!validate(gripper).has_value(), "a converted gripper is valid");
    }
    if (!request.object_key().empty() || !plan_request.candidates_FH.empty()) return true;
    const auto written = dds::write_request(plan_request, request.identity().client_id);
    require(written.ok(), "what was read can be written");
    const auto again = dds::read_request(written.value(), known_grippers());
    require(again.ok(), "what was written can be read: " + (again ? "" : again.error().detail));
    return true;
}

/// The mesh, which goes to the planner's type by blocks, is what the generated code reads.
void check_mesh(const dds::ReceivedSample& sample, Bytes bytes) {
    static const dds::CdrStruct* const layout =
        dds::wire_layouts().find("graspd_msgs::msg::dds_::GraspRequest_");
    if (sample.refused) return;
    std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
    wire::GraspRequest_ generated;
    require(dds::read_cdr(std::span(copy), *layout, generated), "both ways read a sample or none");
    const TriangleMesh mesh = dds::read_mesh(generated.mesh());
    require(mesh.faces == sample.mesh_O.faces, "both ways read the same faces");
    require(mesh.vertices.size() == sample.mesh_O.vertices.size(), "and as many vertices");
    const std::size_t size = mesh.vertices.size() * sizeof(Eigen::Vector3d);
    require(size == 0 ||
                std::memcmp(static_cast<const void*>(mesh.vertices.data()),
                            static_cast<const void*>(sample.mesh_O.vertices.data()), size) == 0,
            "both ways read the same vertices");
}

bool take_request(Bytes bytes) {
    return take_guarded<wire::GraspRequest_PubSubType, dds::ReceivedSample>(
        bytes, [&](dds::ReceivedSample& sample) {
            check_mesh(sample, bytes);
            dds::ReceivedRequest request;
            request.sample = std::move(sample);
            request.complete(SampleInfo{});
            return check_conversion(request);
        });
}

/// @param related  as rmw_fastrtps sends it; else as rmw_cyclonedds does
SampleInfo info_of_call(bool related) {
    SampleInfo info;
    info.sample_identity.sequence_number() = {0, 7};
    if (!related) return info;
    eprosima::fastrtps::rtps::GUID_t caller;
    caller.guidPrefix.value[0] = 1;
    caller.entityId.value[3] = 4;
    info.related_sample_identity.writer_guid(caller);
    return info;
}

bool take_call(Bytes bytes, bool related) {
    static const auto guard = fresh_guard();
    return take_raw(bytes, [&](dds::Bytes& payload) {
        const std::uint64_t sent_bytes = payload.size();
        const auto request =
            dds::read_service_call({std::move(payload), sent_bytes}, info_of_call(related), *guard);
        if (request == nullptr) return false;
        require(request->call.has_value(), "a call remembers its caller");
        require(request->call->related.has_value() == related, "a call remembers its vendor");
        require(!request->identity().request_id.empty(), "a call has an id");
        return check_conversion(*request);
    });
}

/// As MoveItService takes a call, and answers it that there is no grasp.
bool take_moveit_call(Bytes bytes, bool related) {
    static const auto settings = std::make_shared<const MoveItSettings>();
    static const dds::CdrStruct* const layout =
        dds::wire_layouts().find("moveit_msgs::srv::dds_::GraspPlanning_Request_");
    return take_raw(bytes, [&](dds::Bytes& payload) {
        const SampleInfo info = info_of_call(related);
        const auto opened = dds::open_service_call(payload, info);
        dds::MoveItRequest request(settings);
        if (!opened || !dds::read_cdr(opened->members, *layout, request.sample)) return false;
        request.call = opened->call;
        request.complete(info, opened->number, 0);
        PlanReply reply;
        reply.status = PlanStatus::kNoGrasp;
        require(dds::moveit_verdict(reply, request.sample).val != 1, "no grasp is no success");
        require(dds::write_moveit_grasps(reply, request.sample, {}).empty(), "no grasp, none sent");
        return check_conversion(request);
    });
}

bool take_reply(Bytes bytes) {
    return take_guarded<wire::RankedGrasps_PubSubType>(bytes, [](const wire::RankedGrasps_& in) {
        const auto reply = dds::read_reply(in);
        if (!reply.ok()) {
            require(is_told(reply.error().detail), "a refusal says why");
            return false;
        }
        const auto again = dds::read_reply(dds::write_reply(reply.value(), {}));
        require(again.ok(), "what was written can be read: " + (again ? "" : again.error().detail));
        return true;
    });
}

bool take_status(Bytes bytes) {
    return take_guarded<wire::PlannerStatus_PubSubType>(bytes, [](const wire::PlannerStatus_& in) {
        const PlannerState state = dds::read_state(in);
        require(to_string(state.mode) != nullptr, "a mode has a name");
        const PlannerState again = dds::read_state(dds::write_state(state));
        require(again.grippers == state.grippers && again.replies == state.replies,
                "a state stays the same on the wire");
        return !dds::write_diagnostics(state, "/graspd").status().empty();
    });
}

bool take_cancel(Bytes bytes) {
    return take_guarded<wire::CancelRequest_PubSubType>(bytes, [](const wire::CancelRequest_& in) {
        require(dds::printable(in.client_id()).size() <= 64, "printable() shortens");
        return true;
    });
}

bool take_graph(Bytes bytes) {
    return take_raw(bytes, [](const dds::Bytes& payload) {
        return dds::gid_bytes_of(payload) != GidBytes::kAuto;
    });
}

}  // namespace

bool fuzz_guard(Bytes bytes) {
    if (bytes.empty()) return false;
    const Bytes payload = bytes.subspan(1);
    switch (bytes[0]) {
        case 'q': return take_request(payload);
        case 'f': return take_call(payload, true);
        case 'c': return take_call(payload, false);
        case 'm': return take_moveit_call(payload, true);
        case 'n': return take_moveit_call(payload, false);
        case 'x': return take_cancel(payload);
        case 'g': return take_graph(payload);
        case 's': return take_status(payload);
        case 'r': return take_reply(payload);
        default: return false;
    }
}

}  // namespace graspd::fuzz
