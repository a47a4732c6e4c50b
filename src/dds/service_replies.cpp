#include "service_replies.hpp"

#include "guid_bytes.hpp"

namespace graspd::dds {
namespace {

constexpr const char* kType = "graspd_msgs::srv::dds_::PlanGrasps_Response_";
constexpr std::ptrdiff_t kPrefix_bytes = 12;  // of a GUID: its participant

}  // namespace

fast::DataWriter* ServiceReplies::open(Participant& participant, const std::string& topic,
                                       const std::shared_ptr<PayloadGuard>& guard) {
    writer_ = participant.create_writer(
        {topic, fast::TypeSupport(new RawType(kType, guard)), kServiceReplyEnds}, this);
    return writer_;
}

void ServiceReplies::on_publication_matched(fast::DataWriter*,
                                            const fast::PublicationMatchedStatus& status) {
    eprosima::fastrtps::rtps::GUID_t guid;
    eprosima::fastrtps::rtps::iHandle2GUID(guid, status.last_subscription_handle);
    const std::lock_guard lock(mutex_);
    if (status.current_count_change > 0) readers_.insert(bytes_of(guid));
    if (status.current_count_change < 0) readers_.erase(bytes_of(guid));
    matched_.notify_all();
}

/// GUIDs of one participant begin alike, so they stand together in the set.
bool ServiceReplies::knows_participant_of(const std::array<std::uint8_t, 16>& writer) const {
    std::array<std::uint8_t, 16> first{};
    std::copy_n(writer.begin(), kPrefix_bytes, first.begin());
    const auto at = readers_.lower_bound(first);
    return at != readers_.end() &&
           std::equal(first.begin(), first.begin() + kPrefix_bytes, at->begin());
}

bool ServiceReplies::write(const ReceivedRequest& to, const wire::RankedGrasps_& reply,
                           std::chrono::milliseconds patience) {
    {
        std::unique_lock lock(mutex_);
        matched_.wait_for(lock, patience,
                          [&] { return knows_participant_of(to.identity().writer); });
    }
    // The reply's message has one member, so its bytes are those of a RankedGrasps_.
    const ServiceCall& call = *to.call;
    if (call.related) {
        Bytes payload = cdr_bytes(reply);
        eprosima::fastrtps::rtps::WriteParams parameters;
        parameters.related_sample_identity(*call.related);
        return writer_->write(&payload, parameters);
    }
    Bytes payload = cdr_bytes(reply, call.header);
    return writer_->write(&payload);
}

}  // namespace graspd::dds
