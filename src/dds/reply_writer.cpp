#include "reply_writer.hpp"

#include <algorithm>
#include <utility>

#include "guid_bytes.hpp"

namespace graspd::dds {
namespace {

constexpr std::ptrdiff_t kPrefix_bytes = 12;  // of a GUID: its participant
constexpr std::chrono::milliseconds kCallerPatience{100};
constexpr std::chrono::milliseconds kNoPatience{0};

}  // namespace

fast::DataWriter* ReplyWriter::open(Participant& participant, const TopicOf& topic) {
    writer_ = participant.create_writer(topic, this);
    return writer_;
}

void ReplyWriter::on_publication_matched(fast::DataWriter*,
                                         const fast::PublicationMatchedStatus& status) {
    eprosima::fastrtps::rtps::GUID_t guid;
    eprosima::fastrtps::rtps::iHandle2GUID(guid, status.last_subscription_handle);
    const std::lock_guard lock(mutex_);
    if (status.current_count_change > 0) {
        readers_.insert(bytes_of(guid));
        has_new_reader_ = true;
    } else if (status.current_count_change < 0) {
        readers_.erase(bytes_of(guid));
    }
    matched_.notify_all();
}

/// GUIDs of one participant begin alike, so they stand together in the set.
bool ReplyWriter::knows_participant_of(const std::array<std::uint8_t, 16>& endpoint) const {
    std::array<std::uint8_t, 16> first{};
    std::copy_n(endpoint.begin(), kPrefix_bytes, first.begin());
    const auto at = readers_.lower_bound(first);
    return at != readers_.end() &&
           std::equal(first.begin(), first.begin() + kPrefix_bytes, at->begin());
}

void ReplyWriter::meet(const std::array<std::uint8_t, 16>& caller,
                       std::chrono::milliseconds patience) {
    bool greet = false;
    {
        std::unique_lock lock(mutex_);
        matched_.wait_for(lock, patience, [&] { return knows_participant_of(caller); });
        greet = std::exchange(has_new_reader_, false);
    }
    if (greet) writer_->assert_liveliness();  // sends every reader a heartbeat
}

void ReplyWriter::meet_caller(const std::array<std::uint8_t, 16>& caller, bool is_there) {
    meet(caller, is_there ? kCallerPatience : kNoPatience);
}

}  // namespace graspd::dds
