#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "convert_moveit.hpp"
#include "participant.hpp"
#include "raw_type.hpp"
#include "received_request.hpp"
#include "reply_writer.hpp"
#include "taking_listener.hpp"

namespace graspd::dds {

/// A call of MoveIt's service GraspPlanning.
class MoveItRequest final : public IncomingRequest {
public:
    MoveItCall sample;
    ServiceCall call;
    std::optional<PlanError> refused;  ///< over a limit: nothing was read then

    explicit MoveItRequest(std::shared_ptr<const MoveItSettings> settings)
        : settings_(std::move(settings)) {}
    void complete(const fast::SampleInfo& info, std::int64_t number, std::uint64_t payload_hash);

    const RequestIdentity& identity() const override { return identity_; }
    std::chrono::steady_clock::time_point received() const override { return received_; }
    const std::string& frame_id() const override { return sample.target().header().frame_id(); }
    const std::string& object_key() const override { return no_key_; }
    double time_budget_s() const override { return PlanOptions{}.time_budget_s; }
    RequestSize size() const override { return size_; }
    bool is_call() const override { return true; }
    std::string reply_key() const override { return reply_key_of(call); }
    void take_over(std::chrono::steady_clock::time_point now) override { received_ = now; }
    Result<PlanRequest> convert(std::span<const Gripper> known) const override {
        if (refused) return *refused;
        return read_moveit_call(sample, identity_.request_id, known, *settings_);
    }

private:
    std::shared_ptr<const MoveItSettings> settings_;
    RequestIdentity identity_;
    std::chrono::steady_clock::time_point received_;
    RequestSize size_;
    std::string no_key_;
};

/// The service /plan_grasps: MoveIt's calls become requests like any other, and their replies
/// MoveIt's. A call has no id of its own, so each is planned anew.
class MoveItService {
public:
    /// @param handle  takes over each request; @param gone  told of a caller that has left;
    /// @param guard  counts malformed calls
    MoveItService(MoveItSettings settings, RequestHandler handle, TakingListener::WriterGone gone,
                  std::shared_ptr<PayloadGuard> guard);

    /// Makes the endpoints, the writer before the reader. @return false when the middleware refuses
    bool open_writer(Participant& participant, const std::string& topic);
    bool open_reader(Participant& participant, const std::string& topic);

    bool write(const MoveItRequest& to, const PlanReply& reply);
    void stop() { listener_.stop(); }

    ReplyWriter& writer() { return writer_; }
    fast::DataReader* reader() { return reader_; }

private:
    bool take_call(fast::DataReader& reader);

    const std::shared_ptr<const MoveItSettings> settings_;
    const RequestHandler handle_;
    std::shared_ptr<PayloadGuard> guard_;
    TakingListener listener_;
    ReplyWriter writer_;
    fast::DataReader* reader_ = nullptr;
};

}  // namespace graspd::dds
