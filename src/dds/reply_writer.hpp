#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <set>

#include "participant.hpp"

namespace graspd::dds {

/// A writer of replies, whose readers may have come just now.
///
/// ROS 2's readers are volatile: they take nothing that was written before they were matched. And a
/// volatile reader of Cyclone DDS counts as written before it whatever comes before the writer's
/// first heartbeat, so that the first reply to a fresh client was lost in one of five calls. Hence
/// a reply waits until a reader of its caller is matched, and new readers get a heartbeat first.
class ReplyWriter final : public fast::DataWriterListener {
public:
    /// Makes the writer; the topic's contract greets. @return null when the middleware refuses
    fast::DataWriter* open(Participant& participant, const TopicOf& topic);

    /// Waits until a reader of the participant of `caller` (GUID of any of its endpoints) is
    /// matched, `patience` at most, then greets readers that are new.
    void meet(const std::array<std::uint8_t, 16>& caller, std::chrono::milliseconds patience);

    /// As meet(), for the caller of a service, who is waited for unless it has left.
    void meet_caller(const std::array<std::uint8_t, 16>& caller, bool is_there);

    fast::DataWriter& writer() { return *writer_; }

    void on_publication_matched(fast::DataWriter* writer,
                                const fast::PublicationMatchedStatus& status) override;

private:
    bool knows_participant_of(const std::array<std::uint8_t, 16>& endpoint) const;

    fast::DataWriter* writer_ = nullptr;
    std::mutex mutex_;
    std::condition_variable matched_;
    std::set<std::array<std::uint8_t, 16>> readers_;  ///< matched ones, by GUID
    bool has_new_reader_ = false;
};

}  // namespace graspd::dds
