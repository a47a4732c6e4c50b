#include "graspd/dds/planner_port.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <utility>

#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_reply.hpp"
#include "convert_request.hpp"
#include "guarded_type.hpp"
#include "participant.hpp"

namespace graspd {
namespace dds {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;

/// A request with the hash that the guard takes of its payload.
struct ReceivedSample : wire::GraspRequest_ {
    std::uint64_t payload_hash = 0;
};
using RequestType = GuardedType<wire::GraspRequest_PubSubType, ReceivedSample>;
using ReplyType = GuardedType<wire::RankedGrasps_PubSubType>;

std::array<std::uint8_t, 16> bytes_of(const eprosima::fastrtps::rtps::GUID_t& guid) {
    std::array<std::uint8_t, 16> out{};
    const auto rest = std::ranges::copy(guid.guidPrefix.value, out.begin()).out;
    std::ranges::copy(guid.entityId.value, rest);
    return out;
}

class ReceivedRequest final : public IncomingRequest {
public:
    /// To be filled by the middleware; complete() must follow.
    ReceivedSample sample;

    void complete(const fast::SampleInfo& info) {
        received_ = std::chrono::steady_clock::now();
        identity_.writer = bytes_of(info.sample_identity.writer_guid());
        identity_.client_id = printable(sample.client_id());
        identity_.request_id = printable(sample.request_id());
        identity_.payload_hash = sample.payload_hash;
    }

    const RequestIdentity& identity() const override { return identity_; }
    std::chrono::steady_clock::time_point received() const override { return received_; }
    const std::string& frame_id() const override { return sample.header().frame_id(); }
    const std::string& object_key() const override { return sample.object_key(); }
    Result<PlanRequest> convert(std::span<const Gripper> known) const override {
        return read_request(sample, known);
    }

private:
    RequestIdentity identity_;
    std::chrono::steady_clock::time_point received_;
};

/// Takes each request from the middleware as soon as it is there and hands it on. The middleware
/// may hold its own lock while it calls, so none of ours is held while the middleware is called.
class RequestListener final : public fast::DataReaderListener {
public:
    explicit RequestListener(RequestHandler handler) : handler_(std::move(handler)) {}

    void on_data_available(fast::DataReader* reader) override {
        if (!enter()) return;
        try {
            while (!stopped_ && take_one(*reader)) {
            }
        } catch (...) {  // out of memory: what was not taken stays with the middleware
        }
        leave();
    }

    /// Returns once no call is under way.
    void stop() {
        std::unique_lock lock(mutex_);
        stopped_ = true;
        left_.wait(lock, [this] { return calls_ == 0; });
    }

private:
    bool enter() {
        const std::lock_guard lock(mutex_);
        if (stopped_) return false;
        ++calls_;
        return true;
    }
    void leave() {
        const std::lock_guard lock(mutex_);
        --calls_;
        left_.notify_all();
    }

    bool take_one(fast::DataReader& reader) {
        auto request = std::make_unique<ReceivedRequest>();
        fast::SampleInfo info;
        if (reader.take_next_sample(&request->sample, &info) != ReturnCode_t::RETCODE_OK) {
            return false;
        }
        if (!info.valid_data) return true;  // a writer that left, no sample
        request->complete(info);
        handler_(std::move(request));
        return true;
    }

    std::mutex mutex_;
    std::condition_variable left_;
    std::atomic<bool> stopped_{false};
    int calls_ = 0;
    RequestHandler handler_;
};

class DdsPlannerPort final : public PlannerPort {
public:
    DdsPlannerPort(const DdsSettings& settings, RequestHandler handler)
        : settings_(settings), listener_(std::move(handler)) {
        guard_->max_payload_bytes = settings.max_payload_bytes;
    }
    ~DdsPlannerPort() override { listener_.stop(); }

    /// The writer first: a request may arrive as soon as there is a reader.
    std::optional<PlanError> open() {
        auto joined = Participant::join(settings_);
        if (!joined.ok()) return joined.error();
        participant_ = std::move(joined).value();
        writer_ = participant_->create_writer(
            {kReplyTopic, fast::TypeSupport(new ReplyType(guard_))}, kReplyWriter, nullptr);
        const auto* reader =
            participant_->create_reader({kRequestTopic, fast::TypeSupport(new RequestType(guard_))},
                                        kRequestReader, &listener_);
        if (writer_ != nullptr && reader != nullptr) return std::nullopt;
        return PlanError{PlanErrorCode::kInternal, "the middleware refused an endpoint"};
    }

    bool write(const OutgoingReply& reply) override {
        bool written = false;
        try {
            wire::RankedGrasps_ sample = write_reply(reply.reply, envelope_of(reply));
            written = writer_->write(&sample);
        } catch (...) {  // out of memory
        }
        if (!written) lost_.fetch_add(1, std::memory_order_relaxed);
        return written;
    }

    void stop_listening() override { listener_.stop(); }

    bool wait_acknowledged(std::chrono::milliseconds timeout) override {
        const double seconds = std::chrono::duration<double>(timeout).count();
        return writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(
                   static_cast<long double>(seconds))) == ReturnCode_t::RETCODE_OK;
    }

    std::uint64_t rejected_payloads() const override { return guard_->rejected; }
    std::uint64_t lost_replies() const override { return lost_; }

private:
    ReplyEnvelope envelope_of(const OutgoingReply& reply) const {
        ReplyEnvelope out;
        if (const auto* request = dynamic_cast<const ReceivedRequest*>(reply.to.get())) {
            out.header.stamp(request->sample.header().stamp());
        }
        out.header.frame_id(reply.to->frame_id());
        out.request_writer = reply.to->identity().writer;
        out.client_id = reply.to->identity().client_id;
        out.request_id = reply.to->identity().request_id;
        out.attempt = reply.attempt;
        out.planner_id = settings_.planner_id;
        out.planner_version = settings_.version;
        out.config_hash = settings_.config_hash;
        return out;
    }

    DdsSettings settings_;
    std::shared_ptr<PayloadGuard> guard_ = std::make_shared<PayloadGuard>();
    std::atomic<std::uint64_t> lost_{0};
    RequestListener listener_;                  // outlives the participant
    std::unique_ptr<Participant> participant_;  // removes the endpoints
    fast::DataWriter* writer_ = nullptr;
};

}  // namespace
}  // namespace dds

Result<std::unique_ptr<PlannerPort>> PlannerPort::open(const DdsSettings& settings,
                                                       RequestHandler handler) {
    auto port = std::make_unique<dds::DdsPlannerPort>(settings, std::move(handler));
    if (auto error = port->open()) return *std::move(error);
    return std::unique_ptr<PlannerPort>(std::move(port));
}

}  // namespace graspd
