#include "ros_graph.hpp"

#include "cdr_bytes.hpp"
#include "guid_bytes.hpp"
#include "wire_types.hpp"

namespace graspd::dds {
namespace {

constexpr const char* kTopic = "ros_discovery_info";
constexpr const char* kType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
constexpr const char* kOldType = "rmw_dds_common_gid24::msg::dds_::ParticipantEntitiesInfo_";

using Id = std::array<std::uint8_t, 16>;

template <class Gid>
Gid gid_of(const Id& id) {
    Gid gid;
    std::ranges::copy(id, gid.data().begin());  // what follows in a longer one stays zero
    return gid;
}

/// The announcement in one of the two layouts.
template <class Info, class Node, class Gid>
Bytes announcement(const RosNode& node, const Id& participant, std::span<const Id> readers,
                   std::span<const Id> writers) {
    Info info;
    info.gid(gid_of<Gid>(participant));
    Node& entry = info.node_entities_info_seq().emplace_back();
    entry.node_namespace(node.node_namespace);
    entry.node_name(node.name);
    for (const Id& id : readers) entry.reader_gid_seq().push_back(gid_of<Gid>(id));
    for (const Id& id : writers) entry.writer_gid_seq().push_back(gid_of<Gid>(id));
    return cdr_bytes(info);
}

}  // namespace

GidBytes gid_bytes_of(std::span<const std::uint8_t> payload) {
    const CdrStruct* now = wire_layouts().find(kType);
    const CdrStruct* old = wire_layouts().find(kOldType);
    if (now == nullptr || old == nullptr) return GidBytes::kAuto;
    const bool is_16 = is_well_formed(payload, *now);
    const bool is_24 = is_well_formed(payload, *old);
    if (is_16 == is_24) return GidBytes::kAuto;
    return is_16 ? GidBytes::k16 : GidBytes::k24;
}

RosGraph::RosGraph(RosNode node, std::span<fast::DataReader* const> readers,
                   std::span<fast::DataWriter* const> writers)
    : node_(std::move(node)) {
    for (const auto* reader : readers) reader_ids_.push_back(bytes_of(reader->guid()));
    for (const auto* writer : writers) writer_ids_.push_back(bytes_of(writer->guid()));
}

bool RosGraph::open(Participant& participant, const std::shared_ptr<PayloadGuard>& guard) {
    participant_id_ = bytes_of(participant.guid());
    TopicOf topic{kTopic, fast::TypeSupport(new RawType(kType, guard)), kGraphEnds};
    writer_ = participant.create_writer(topic, nullptr);
    if (writer_ == nullptr) return false;
    announce(node_.gid_bytes);
    topic.contract.depth = 0;  // of all participants together
    return participant.create_reader(topic, this) != nullptr;
}

void RosGraph::on_data_available(fast::DataReader* reader) {
    using eprosima::fastrtps::types::ReturnCode_t;
    try {
        Bytes payload;
        fast::SampleInfo info;
        while (reader->take_next_sample(&payload, &info) == ReturnCode_t::RETCODE_OK) {
            const bool own = info.sample_identity.writer_guid() == writer_->guid();
            if (info.valid_data && !own) announce(gid_bytes_of(payload));
        }
    } catch (...) {  // out of memory: the next announcement will do
    }
}

/// Once; kAuto says nothing.
void RosGraph::announce(GidBytes gid_bytes) {
    if (gid_bytes != GidBytes::k16 && gid_bytes != GidBytes::k24) return;
    const std::lock_guard lock(mutex_);
    if (announced_) return;
    Bytes bytes;
    if (gid_bytes == GidBytes::k16) {
        namespace now = rmw_dds_common::msg::dds_;
        bytes = announcement<now::ParticipantEntitiesInfo_, now::NodeEntitiesInfo_, now::Gid_>(
            node_, participant_id_, reader_ids_, writer_ids_);
    } else {
        namespace old = rmw_dds_common_gid24::msg::dds_;
        bytes = announcement<old::ParticipantEntitiesInfo_, old::NodeEntitiesInfo_, old::Gid_>(
            node_, participant_id_, reader_ids_, writer_ids_);
    }
    announced_ = writer_->write(&bytes);
}

}  // namespace graspd::dds
