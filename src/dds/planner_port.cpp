#include "graspd/dds/planner_port.hpp"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include <graspd_msgs/graspdPubSubTypes.h>

#include "convert_reply.hpp"
#include "convert_state.hpp"
#include "guarded_type.hpp"
#include "guid_bytes.hpp"
#include "moveit_service.hpp"
#include "participant.hpp"
#include "peer_watch.hpp"
#include "plan_markers.hpp"
#include "received_request.hpp"
#include "reply_envelope.hpp"
#include "reply_writer.hpp"
#include "ros_graph.hpp"
#include "taking_listener.hpp"

namespace graspd {
namespace dds {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;

using RequestType = GuardedType<wire::GraspRequest_PubSubType, ReceivedSample>;
using ReplyType = GuardedType<wire::RankedGrasps_PubSubType>;
using CancelType = GuardedType<wire::CancelRequest_PubSubType>;
using StatusType = GuardedType<wire::PlannerStatus_PubSubType>;
using DiagnosticsType = GuardedType<diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType>;

using MarkersType = GuardedType<visualization_msgs::msg::dds_::MarkerArray_PubSubType>;

constexpr const char* kServiceRequestType = "graspd_msgs::srv::dds_::PlanGrasps_Request_";
constexpr const char* kServiceReplyType = "graspd_msgs::srv::dds_::PlanGrasps_Response_";

class DdsPlannerPort final : public PlannerPort {
public:
    DdsPlannerPort(const DdsSettings& settings, RequestHandler request, CancelHandler cancel,
                   GoneHandler gone, PeerHandlers peers)
        : settings_(settings),
          handle_request_(std::move(request)),
          handle_cancel_(std::move(cancel)),
          handle_gone_(std::move(gone)),
          peers_(std::move(peers)) {
        guard_->max_payload_bytes = settings.max_payload_bytes;
        guard_->limits = settings.limits;
        if (settings.moveit.error_codes != MoveItCodes::kOff) {
            moveit_ = std::make_unique<MoveItService>(
                settings.moveit, handle_request_, [this](const auto& writer) { tell_gone(writer); },
                guard_);
        }
    }
    ~DdsPlannerPort() override { DdsPlannerPort::stop_listening(); }

    /// Writers first: a request may arrive as soon as there is a reader.
    std::optional<PlanError> open() {
        auto joined = Participant::join(settings_);
        if (!joined.ok()) return joined.error();
        participant_ = std::move(joined).value();
        const WireNames& names = settings_.names;
        auto* reply_writer = reply_writer_.open(
            *participant_,
            {names.ranked_grasps, fast::TypeSupport(new ReplyType(guard_)), kReplyEnds});
        Contract status_ends = kStatusEnds;
        if (settings_.watch_peers) status_ends.lease_ms = kPeerLease_ms;
        status_writer_ = writer<StatusType>(names.status, status_ends);
        diagnostics_writer_ = writer<DiagnosticsType>(names.diagnostics, kDiagnosticsEnds);
        auto* service_writer = service_writer_.open(
            *participant_,
            {names.service_reply, fast::TypeSupport(new RawType(kServiceReplyType, guard_)),
             kServiceReplyEnds});
        std::vector writers = {reply_writer, status_writer_, diagnostics_writer_, service_writer};
        if (settings_.markers) {
            markers_writer_ = writer<MarkersType>(names.markers, kMarkersEnds);
            writers.push_back(markers_writer_);
        }
        if (std::ranges::count(writers, nullptr) > 0) return refused();
        if (moveit_ && !moveit_->open_writer(*participant_, names.moveit_reply)) return refused();
        std::vector<fast::DataReader*> peer_readers;
        if (settings_.watch_peers && (peer_readers = watch_peers()).empty()) return refused();
        std::vector readers = {
            reader<RequestType>(names.grasp_request, kRequestEnds, request_listener_),
            reader<CancelType>(names.cancel, kCancelEnds, cancel_listener_),
            participant_->create_reader(
                {names.service_request,
                 fast::TypeSupport(new CallType(kServiceRequestType, guard_)), kServiceRequestEnds},
                &service_listener_)};
        if (std::ranges::count(readers, nullptr) > 0) return refused();
        if (moveit_ && !moveit_->open_reader(*participant_, names.moveit_request)) return refused();
        if (moveit_) {
            writers.push_back(&moveit_->writer().writer());
            readers.push_back(moveit_->reader());
        }
        readers.insert(readers.end(), peer_readers.begin(), peer_readers.end());
        if (settings_.node.gid_bytes == GidBytes::kOff) return std::nullopt;
        graph_.emplace(settings_.node, readers, writers);
        return graph_->open(*participant_, guard_) ? std::nullopt : refused();
    }

    bool write(const OutgoingReply& reply) override {
        bool written = false;
        try {
            written = send(reply);
        } catch (...) {  // out of memory
        }
        if (!written) lost_.fetch_add(1, std::memory_order_relaxed);
        return written;
    }

    std::vector<std::uint8_t> payload_of(const OutgoingReply& reply) const override {
        return cdr_bytes(write_reply(reply.reply, envelope_of(reply, settings_)));
    }

    bool write_state(PlannerState state) override {
        state.planner_id = settings_.planner_id;
        state.version = settings_.version;
        state.config_hash = settings_.config_hash;
        state.rejected_payloads = rejected_payloads();
        auto status = dds::write_state(state);
        auto diagnostics = write_diagnostics(state, full_name(settings_.node));
        const bool said = status_writer_->write(&status);
        return diagnostics_writer_->write(&diagnostics) && said;
    }

    void assert_alive() override { status_writer_->assert_liveliness(); }
    GuidBytes id() const override { return bytes_of(status_writer_->guid()); }

    bool write_markers(const PlanPicture& picture, const OutgoingReply& reply) override {
        if (markers_writer_ == nullptr) return false;
        auto markers = plan_markers(picture, reply.reply, header_of(*reply.to));
        return markers_writer_->write(&markers);
    }

    void stop_listening() override {
        request_listener_.stop();
        service_listener_.stop();
        if (moveit_) moveit_->stop();
        cancel_listener_.stop();
        peers_.stop();
    }

    bool wait_acknowledged(std::chrono::milliseconds timeout) override {
        const auto deadline = std::chrono::steady_clock::now() + timeout;
        bool confirmed = true;
        std::vector<ReplyWriter*> reply_writers = {&reply_writer_, &service_writer_};
        if (moveit_) reply_writers.push_back(&moveit_->writer());
        for (ReplyWriter* writer : reply_writers) {
            const std::chrono::duration<long double> rest =
                deadline - std::chrono::steady_clock::now();
            const eprosima::fastrtps::Duration_t left(std::max(rest.count(), 0.0L));
            const auto code = writer->writer().wait_for_acknowledgments(left);
            confirmed = confirmed && code == ReturnCode_t::RETCODE_OK;
        }
        return confirmed;
    }

    std::uint64_t rejected_payloads() const override { return guard_->rejected; }
    std::uint64_t lost_replies() const override { return lost_; }

private:
    bool send(const OutgoingReply& reply) {
        if (const auto* call = dynamic_cast<const MoveItRequest*>(reply.to.get())) {
            return moveit_ && moveit_->write(*call, reply.reply);
        }
        wire::RankedGrasps_ sample = write_reply(reply.reply, envelope_of(reply, settings_));
        const auto* request = dynamic_cast<const ReceivedRequest*>(reply.to.get());
        const auto& caller = reply.to->identity().writer;
        if (request == nullptr || !request->call) {
            reply_writer_.meet(caller, {});  // somebody else may read what one asks for
            return reply_writer_.writer().write(&sample);
        }
        service_writer_.meet_caller(caller, service_listener_.knows(guid_of(caller)));
        // The service's response has one member, so its bytes are those of a RankedGrasps_.
        return write_service_reply(*request->call, sample, service_writer_.writer());
    }

    void tell_gone(const eprosima::fastrtps::rtps::GUID_t& writer) {
        if (handle_gone_) handle_gone_(bytes_of(writer));
    }

    std::vector<fast::DataReader*> watch_peers() {
        std::vector<std::string> service_replies = {settings_.names.service_reply};
        if (moveit_) service_replies.push_back(settings_.names.moveit_reply);
        return peers_.open(*participant_, settings_.names, service_replies, id());
    }

    static std::optional<PlanError> refused() {
        return PlanError{PlanErrorCode::kInternal, "the middleware refused an endpoint"};
    }
    template <class Type>
    fast::DataWriter* writer(const std::string& topic, const Contract& contract) {
        return participant_->create_writer({topic, fast::TypeSupport(new Type(guard_)), contract},
                                           nullptr);
    }
    template <class Type>
    fast::DataReader* reader(const std::string& topic, const Contract& contract,
                             TakingListener& listener) {
        return participant_->create_reader({topic, fast::TypeSupport(new Type(guard_)), contract},
                                           &listener);
    }

    bool take_request(fast::DataReader& reader) {
        auto request = std::make_unique<ReceivedRequest>();
        if (settings_.keep_payloads) request->sample.payload = std::make_shared<ReceivedPayload>();
        fast::SampleInfo info;
        if (reader.take_next_sample(&request->sample, &info) != ReturnCode_t::RETCODE_OK) {
            return false;
        }
        if (!info.valid_data) return true;  // a writer that left, no sample
        request->complete(info);
        handle_request_(std::move(request));
        return true;
    }

    bool take_call(fast::DataReader& reader) {
        CallPayload payload;
        fast::SampleInfo info;
        if (reader.take_next_sample(&payload, &info) != ReturnCode_t::RETCODE_OK) return false;
        if (!info.valid_data) return true;
        if (auto request =
                read_service_call(std::move(payload), info, *guard_, settings_.keep_payloads)) {
            handle_request_(std::move(request));
        } else {
            guard_->rejected.fetch_add(1, std::memory_order_relaxed);
        }
        return true;
    }

    bool take_cancel(fast::DataReader& reader) {
        wire::CancelRequest_ order;
        fast::SampleInfo info;
        if (reader.take_next_sample(&order, &info) != ReturnCode_t::RETCODE_OK) return false;
        if (info.valid_data && handle_cancel_) {
            handle_cancel_({printable(order.client_id()), printable(order.request_id())});
        }
        return true;
    }

    DdsSettings settings_;
    const RequestHandler handle_request_;
    const CancelHandler handle_cancel_;
    const GoneHandler handle_gone_;
    std::shared_ptr<PayloadGuard> guard_ = std::make_shared<PayloadGuard>();
    std::atomic<std::uint64_t> lost_{0};
    // Listeners outlive the participant, which removes the endpoints.
    TakingListener request_listener_{[this](auto& from) { return take_request(from); }};
    TakingListener service_listener_{[this](auto& from) { return take_call(from); },
                                     [this](const auto& writer) { tell_gone(writer); }};
    TakingListener cancel_listener_{[this](auto& from) { return take_cancel(from); }};
    ReplyWriter reply_writer_;
    ReplyWriter service_writer_;
    PeerWatch peers_;
    std::unique_ptr<MoveItService> moveit_;  ///< null: off
    std::optional<RosGraph> graph_;
    std::unique_ptr<Participant> participant_;
    fast::DataWriter* status_writer_ = nullptr;
    fast::DataWriter* diagnostics_writer_ = nullptr;
    fast::DataWriter* markers_writer_ = nullptr;  ///< null: off
};

}  // namespace
}  // namespace dds

Result<std::unique_ptr<PlannerPort>> PlannerPort::open(const DdsSettings& settings,
                                                       RequestHandler handler, CancelHandler cancel,
                                                       GoneHandler gone, PeerHandlers peers) {
    auto port = std::make_unique<dds::DdsPlannerPort>(
        settings, std::move(handler), std::move(cancel), std::move(gone), std::move(peers));
    if (auto error = port->open()) return *std::move(error);
    return std::unique_ptr<PlannerPort>(std::move(port));
}

}  // namespace graspd
