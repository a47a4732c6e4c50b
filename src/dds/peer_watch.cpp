#include "peer_watch.hpp"

#include <algorithm>
#include <utility>

#include "guid_bytes.hpp"
#include "raw_type.hpp"
#include "received_request.hpp"
#include "wire_types.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;

}  // namespace

std::vector<fast::DataReader*> PeerWatch::open(Participant& participant, const WireNames& names,
                                               const std::vector<std::string>& service_replies,
                                               const GuidBytes& self) {
    self_ = self;
    const fast::TypeSupport known_already;
    std::vector readers = {
        participant.create_reader({names.ranked_grasps, known_already, kPeerReplyEnds},
                                  &reply_listener_),
        participant.create_reader({names.status, known_already, kPeerStatusEnds},
                                  &status_listener_)};
    for (const std::string& topic : service_replies) {
        readers.push_back(
            participant.create_reader({topic, known_already, kPeerReplyEnds}, &service_listener_));
    }
    if (std::ranges::count(readers, nullptr) > 0) readers.clear();
    return readers;
}

void PeerWatch::stop() {
    status_listener_.stop();
    reply_listener_.stop();
    service_listener_.stop();
}

/// Changes what is known of a peer, and tells when it serves now and did not before, or the other
/// way round. Handlers are called one at a time, so that the last word is the latest.
template <class Change>
void PeerWatch::change(const GuidBytes& id, Change&& change) {
    if (id == self_) return;
    const std::lock_guard lock(mutex_);
    Peer& peer = peers_[id];
    const bool served = peer.serves();
    change(peer);
    if (peer.serves() != served && handlers_.peer) handlers_.peer(id, peer.serves());
}

bool PeerWatch::take_status(fast::DataReader& reader) {
    wire::PlannerStatus_ status;
    fast::SampleInfo info;
    if (reader.take_next_sample(&status, &info) != ReturnCode_t::RETCODE_OK) return false;
    if (!info.valid_data) return true;
    change(bytes_of(info.sample_identity.writer_guid()), [&](Peer& peer) {
        peer.takes = status.state() != wire::PlannerStatus__Constants::STATE_STOPPING_;
    });
    return true;
}

void PeerWatch::set_alive(const eprosima::fastrtps::rtps::GUID_t& writer, bool lives) {
    change(bytes_of(writer), [lives](Peer& peer) { peer.lives = lives; });
}

void PeerWatch::forget(const eprosima::fastrtps::rtps::GUID_t& writer) {
    change(bytes_of(writer), [](Peer& peer) { peer.lives = false; });
    const std::lock_guard lock(mutex_);
    peers_.erase(bytes_of(writer));
}

bool PeerWatch::take_reply(fast::DataReader& reader) {
    wire::RankedGrasps_ reply;
    fast::SampleInfo info;
    if (reader.take_next_sample(&reply, &info) != ReturnCode_t::RETCODE_OK) return false;
    if (!info.valid_data) return true;
    RequestIdentity to;
    to.writer = reply.request_writer();
    to.request_id = reply.request_id();
    tell_answered(topic_reply_key(to));
    return true;
}

bool PeerWatch::take_service_reply(fast::DataReader& reader) {
    Bytes payload;
    fast::SampleInfo info;
    if (reader.take_next_sample(&payload, &info) != ReturnCode_t::RETCODE_OK) return false;
    if (!info.valid_data) return true;
    if (const auto call = answered_call(payload, info)) tell_answered(reply_key_of(*call));
    return true;
}

void PeerWatch::tell_answered(const std::string& key) const {
    if (handlers_.answered) handlers_.answered(key);
}

}  // namespace graspd::dds
