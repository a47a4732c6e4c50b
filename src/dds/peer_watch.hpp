#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "graspd/dds/planner_port.hpp"
#include "participant.hpp"
#include "taking_listener.hpp"

namespace graspd::dds {

/// Hears of the other planners of the domain: whether they live, by the liveliness of the writers
/// of their status, and what they answer, by the topic and by the services.
class PeerWatch {
public:
    explicit PeerWatch(PeerHandlers handlers) : handlers_(std::move(handlers)) {}

    /// The types of the topics must be known to the participant, so their writers come before.
    /// @param self  GUID of our own status writer
    /// @param service_replies  topics of the services' replies
    /// @return the readers; none when the middleware refuses one
    std::vector<fast::DataReader*> open(Participant& participant, const WireNames& names,
                                        const std::vector<std::string>& service_replies,
                                        const GuidBytes& self);
    void stop();

private:
    struct Peer {
        bool lives = true;
        bool takes = false;  ///< has said that it is not stopping
        bool serves() const { return lives && takes; }
    };

    bool take_status(fast::DataReader& reader);
    bool take_reply(fast::DataReader& reader);
    bool take_service_reply(fast::DataReader& reader);
    void set_alive(const eprosima::fastrtps::rtps::GUID_t& writer, bool lives);
    void forget(const eprosima::fastrtps::rtps::GUID_t& writer);
    template <class Change>
    void change(const GuidBytes& id, Change&& change);
    void tell_answered(const std::string& key) const;

    const PeerHandlers handlers_;
    GuidBytes self_{};
    std::mutex mutex_;  ///< guards the peers
    std::map<GuidBytes, Peer> peers_;
    TakingListener status_listener_{
        [this](auto& from) { return take_status(from); },
        [this](const auto& writer) { forget(writer); },
        [this](const auto& writer, bool lives) { set_alive(writer, lives); }};
    TakingListener reply_listener_{[this](auto& from) { return take_reply(from); }};
    TakingListener service_listener_{[this](auto& from) { return take_service_reply(from); }};
};

}  // namespace graspd::dds
