#include "graspd/dds/planner_client.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_reply.hpp"
#include "convert_request.hpp"
#include "guarded_type.hpp"
#include "participant.hpp"

namespace graspd {
namespace dds {
namespace {

using Clock = std::chrono::steady_clock;
using eprosima::fastrtps::types::ReturnCode_t;
using ClientRequestType = GuardedType<wire::GraspRequest_PubSubType>;
using ClientReplyType = GuardedType<wire::RankedGrasps_PubSubType>;

constexpr auto kFirstPause = std::chrono::milliseconds(50);  // after OVERLOADED; doubles
constexpr auto kLongestPause = std::chrono::milliseconds(1000);

/// What the middleware's threads tell the client: matches, and the reply that it waits for. Every
/// other reply is taken too, so that this reader never holds the planner's writer back. The
/// middleware may hold its own lock while it calls, so ours is not held while a sample is taken.
class ClientListener final : public fast::DataReaderListener, public fast::DataWriterListener {
public:
    explicit ClientListener(std::string client_id) : client_id_(std::move(client_id)) {}

    void on_data_available(fast::DataReader* reader) override {
        try {
            wire::RankedGrasps_ reply;
            fast::SampleInfo info;
            while (reader->take_next_sample(&reply, &info) == ReturnCode_t::RETCODE_OK) {
                if (info.valid_data) keep_if_awaited(reply);
            }
        } catch (...) {  // out of memory: the same as a reply that was lost
        }
    }
    void on_subscription_matched(fast::DataReader*,
                                 const fast::SubscriptionMatchedStatus& status) override {
        const std::lock_guard lock(mutex_);
        reply_writers_ = status.current_count;
        changed_.notify_all();
    }
    void on_publication_matched(fast::DataWriter*,
                                const fast::PublicationMatchedStatus& status) override {
        const std::lock_guard lock(mutex_);
        request_readers_ = status.current_count;
        changed_.notify_all();
    }

    bool wait_matched(Clock::time_point deadline) {
        std::unique_lock lock(mutex_);
        return changed_.wait_until(lock, deadline,
                                   [this] { return reply_writers_ > 0 && request_readers_ > 0; });
    }
    void expect(const std::string& request_id) {
        const std::lock_guard lock(mutex_);
        awaited_ = request_id;
        reply_.reset();
    }
    std::optional<wire::RankedGrasps_> wait_reply(Clock::time_point deadline) {
        std::unique_lock lock(mutex_);
        changed_.wait_until(lock, deadline, [this] { return reply_.has_value(); });
        return std::exchange(reply_, std::nullopt);
    }

private:
    void keep_if_awaited(const wire::RankedGrasps_& reply) {
        const std::lock_guard lock(mutex_);
        if (reply_ || reply.client_id() != client_id_ || reply.request_id() != awaited_) return;
        reply_ = reply;
        changed_.notify_all();
    }

    const std::string client_id_;
    std::mutex mutex_;
    std::condition_variable changed_;
    int reply_writers_ = 0;
    int request_readers_ = 0;
    std::string awaited_;  ///< empty: none, as no request has an empty id
    std::optional<wire::RankedGrasps_> reply_;
};

class DdsPlannerClient final : public PlannerClient {
public:
    explicit DdsPlannerClient(std::string client_id)
        : client_id_(std::move(client_id)), listener_(client_id_) {}

    std::optional<PlanError> open(const DdsSettings& settings) {
        FirstError errors;
        check_text(client_id_, "client_id", {1, 64}, errors);
        if (errors.any()) return errors.error();
        auto joined = Participant::join(settings);
        if (!joined.ok()) return joined.error();
        participant_ = std::move(joined).value();
        guard_->max_payload_bytes = settings.max_payload_bytes;
        const auto* reader = participant_->create_reader(
            {settings.names.ranked_grasps, fast::TypeSupport(new ClientReplyType(guard_)),
             kReplyEnds},
            &listener_);
        writer_ = participant_->create_writer(
            {settings.names.grasp_request, fast::TypeSupport(new ClientRequestType(guard_)),
             kRequestEnds},
            &listener_);
        if (writer_ != nullptr && reader != nullptr) return std::nullopt;
        return PlanError{PlanErrorCode::kInternal, "the middleware refused an endpoint"};
    }

    bool wait_for_planner(std::chrono::milliseconds timeout) override {
        return listener_.wait_matched(Clock::now() + timeout);
    }

    Result<PlanReply> request(const PlanRequest& request, std::chrono::milliseconds timeout,
                              std::uint32_t retries) override {
        auto written = write_request(request, client_id_);
        if (!written.ok()) return written.error();
        listener_.expect(request.request_id);
        Result<PlanReply> last = no_reply(request, "nothing was sent");
        std::chrono::milliseconds pause = kFirstPause;
        for (std::uint32_t attempt = 0; attempt <= retries; ++attempt) {
            last = ask_once(request, written.value(), Clock::now() + timeout);
            if (is_busy(last) && attempt < retries) {
                // The answer to an earlier, silent attempt may still come.
                if (const auto late = listener_.wait_reply(Clock::now() + pause)) {
                    last = read_reply(*late);
                }
                pause = std::min(2 * pause, kLongestPause);
            }
            if (!is_silent(last) && !is_busy(last)) break;
        }
        listener_.expect("");
        return last;
    }

private:
    static bool is_silent(const Result<PlanReply>& reply) {
        return !reply.ok() && reply.error().code == PlanErrorCode::kNoReply;
    }
    static bool is_busy(const Result<PlanReply>& reply) {
        return reply.ok() && reply.value().status == PlanStatus::kOverloaded;
    }
    static PlanError no_reply(const PlanRequest& request, const std::string& why) {
        return {PlanErrorCode::kNoReply,
                "no reply to request " + shown(request.request_id) + ": " + why};
    }

    Result<PlanReply> ask_once(const PlanRequest& request, wire::GraspRequest_& sample,
                               Clock::time_point deadline) {
        if (!listener_.wait_matched(deadline)) return no_reply(request, "no planner was found");
        if (auto error = send(request, sample, deadline)) return *std::move(error);
        const auto reply = listener_.wait_reply(deadline);
        if (!reply) return no_reply(request, "the planner did not answer in time");
        return read_reply(*reply);
    }

    /// Fast DDS 2.9 reports a timeout, early, when the full history of a volatile writer is emptied
    /// by confirmations while it waits: trying again is all it takes.
    std::optional<PlanError> send(const PlanRequest& request, wire::GraspRequest_& sample,
                                  Clock::time_point deadline) {
        while (true) {
            const ReturnCode_t code =
                writer_->write(&sample, eprosima::fastrtps::rtps::c_InstanceHandle_Unknown);
            if (code == ReturnCode_t::RETCODE_OK) return std::nullopt;
            if (code != ReturnCode_t::RETCODE_TIMEOUT) {
                return PlanError{PlanErrorCode::kInternal,
                                 "the middleware cannot send request " + shown(request.request_id) +
                                     ": return code " + std::to_string(code())};
            }
            if (Clock::now() >= deadline) return no_reply(request, "the planner takes nothing");
        }
    }

    const std::string client_id_;
    std::shared_ptr<PayloadGuard> guard_ = std::make_shared<PayloadGuard>();
    ClientListener listener_;                   // outlives the participant
    std::unique_ptr<Participant> participant_;  // removes the endpoints
    fast::DataWriter* writer_ = nullptr;
};

}  // namespace
}  // namespace dds

Result<std::unique_ptr<PlannerClient>> PlannerClient::open(const DdsSettings& settings,
                                                           std::string client_id) {
    auto client = std::make_unique<dds::DdsPlannerClient>(std::move(client_id));
    if (auto error = client->open(settings)) return *std::move(error);
    return std::unique_ptr<PlannerClient>(std::move(client));
}

}  // namespace graspd
