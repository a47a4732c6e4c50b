#include "moveit_service.hpp"

#include <span>
#include <utility>

#include "graspd/base/content_hash.hpp"
#include "guid_bytes.hpp"
#include "request_limits.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;
using JazzyResponse = ::moveit_msgs::srv::dds_::GraspPlanning_Response_;
using HumbleResponse = ::moveit_msgs_humble::srv::dds_::GraspPlanning_Response_;

constexpr const char* kRequestType = "moveit_msgs::srv::dds_::GraspPlanning_Request_";
constexpr const char* kReplyType = "moveit_msgs::srv::dds_::GraspPlanning_Response_";
constexpr const char* kSource = "graspd";

/// The response in one of the two layouts.
template <class Response>
Response response_to(const MoveItRequest& to, const PlanReply& reply,
                     const MoveItSettings& settings) {
    Response out;
    out.grasps(write_moveit_grasps(reply, to.sample, settings.hands));
    const MoveItVerdict verdict = moveit_verdict(reply, to.sample);
    out.error_code().val(verdict.val);
    if constexpr (requires { out.error_code().message(); }) {
        out.error_code().message(verdict.message);
        out.error_code().source(kSource);
    }
    return out;
}

}  // namespace

void MoveItRequest::complete(const fast::SampleInfo& info, std::int64_t number,
                             std::uint64_t payload_hash) {
    received_ = std::chrono::steady_clock::now();
    identity_.writer = bytes_of(info.sample_identity.writer_guid());
    identity_.request_id = "moveit-" + std::to_string(number);
    identity_.payload_hash = payload_hash;
    for (const auto& mesh : sample.target().meshes()) {
        size_.vertices += mesh.vertices().size();
        size_.faces += mesh.triangles().size();
    }
    for (const auto& obstacle : sample.movable_obstacles()) {
        for (const auto& mesh : obstacle.meshes()) {
            size_.obstacle_vertices += mesh.vertices().size();
            size_.obstacle_faces += mesh.triangles().size();
        }
    }
}

MoveItService::MoveItService(MoveItSettings settings, RequestHandler handle,
                             TakingListener::WriterGone gone, std::shared_ptr<PayloadGuard> guard)
    : settings_(std::make_shared<const MoveItSettings>(std::move(settings))),
      handle_(std::move(handle)),
      guard_(std::move(guard)),
      listener_([this](auto& from) { return take_call(from); }, std::move(gone)) {}

bool MoveItService::open_writer(Participant& participant, const std::string& topic) {
    Contract contract = kMoveItReplyEnds;
    contract.announces_hash = settings_->error_codes == MoveItCodes::kJazzy;
    return writer_.open(participant, {topic, fast::TypeSupport(new RawType(kReplyType, guard_)),
                                      contract}) != nullptr;
}

bool MoveItService::open_reader(Participant& participant, const std::string& topic) {
    reader_ = participant.create_reader(
        {topic, fast::TypeSupport(new CallType(kRequestType, guard_)), kMoveItRequestEnds},
        &listener_);
    return reader_ != nullptr;
}

bool MoveItService::write(const MoveItRequest& to, const PlanReply& reply) {
    const auto& caller = to.identity().writer;
    writer_.meet_caller(caller, listener_.knows(guid_of(caller)));
    if (settings_->error_codes == MoveItCodes::kHumble) {
        return write_service_reply(to.call, response_to<HumbleResponse>(to, reply, *settings_),
                                   writer_.writer());
    }
    return write_service_reply(to.call, response_to<JazzyResponse>(to, reply, *settings_),
                               writer_.writer());
}

bool MoveItService::take_call(fast::DataReader& reader) {
    static const CdrStruct* const layout = wire_layouts().find(kRequestType);
    CallPayload payload;
    fast::SampleInfo info;
    if (reader.take_next_sample(&payload, &info) != ReturnCode_t::RETCODE_OK) return false;
    if (!info.valid_data) return true;
    const auto opened = open_service_call(payload.bytes, info);
    auto request = std::make_unique<MoveItRequest>(settings_);
    request->refused = too_many_bytes(payload.sent_bytes, guard_->max_payload_bytes);
    if (!opened || layout == nullptr ||
        (!request->refused && !read_cdr(opened->members, *layout, request->sample))) {
        guard_->rejected.fetch_add(1, std::memory_order_relaxed);
        return true;
    }
    request->call = opened->call;
    request->complete(info, opened->number, content_hash(std::as_bytes(opened->members)));
    handle_(std::move(request));
    return true;
}

}  // namespace graspd::dds
