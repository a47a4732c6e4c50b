#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>

#include "participant.hpp"
#include "received_request.hpp"
#include "wire_types.hpp"

namespace graspd::dds {

/// The service's replies, each in the way that its caller understands.
class ServiceReplies final : public fast::DataWriterListener {
public:
    /// Makes the writer. @return null when the middleware refuses
    fast::DataWriter* open(Participant& participant, const std::string& topic,
                           const std::shared_ptr<PayloadGuard>& guard);

    /// ROS 2's reply readers are volatile: what is written before they are matched never reaches
    /// them. So a reader of the caller's participant is waited for, `patience` at most.
    /// @return false: not written
    bool write(const ReceivedRequest& to, const wire::RankedGrasps_& reply,
               std::chrono::milliseconds patience);

    void on_publication_matched(fast::DataWriter* writer,
                                const fast::PublicationMatchedStatus& status) override;

private:
    bool knows_participant_of(const std::array<std::uint8_t, 16>& writer) const;

    fast::DataWriter* writer_ = nullptr;
    std::mutex mutex_;
    std::condition_variable matched_;
    std::set<std::array<std::uint8_t, 16>> readers_;  ///< matched ones, by GUID
};

}  // namespace graspd::dds
