#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "graspd/dds/dds_settings.hpp"
#include "participant.hpp"
#include "raw_type.hpp"

namespace graspd::dds {

/// Makes the planner a node of the ROS 2 graph: tells on ros_discovery_info which endpoints are its
/// own. With GidBytes::kAuto the first announcement of another participant that is well-formed
/// decides which layout is spoken in this domain.
class RosGraph final : public fast::DataReaderListener {
public:
    /// @param readers, writers  the node's endpoints
    RosGraph(RosNode node, std::span<fast::DataReader* const> readers,
             std::span<fast::DataWriter* const> writers);

    /// Makes the endpoints of the graph's topic and announces the node, if it is known how.
    /// @return false when the middleware refuses
    bool open(Participant& participant, const std::shared_ptr<PayloadGuard>& guard);

    void on_data_available(fast::DataReader* reader) override;

private:
    void announce(GidBytes gid_bytes);

    const RosNode node_;
    std::vector<std::array<std::uint8_t, 16>> reader_ids_;
    std::vector<std::array<std::uint8_t, 16>> writer_ids_;
    std::array<std::uint8_t, 16> participant_id_{};
    fast::DataWriter* writer_ = nullptr;
    std::mutex mutex_;  ///< guards what follows
    bool announced_ = false;
};

/// The layout of a payload on ros_discovery_info; kAuto when it fits neither or both.
GidBytes gid_bytes_of(std::span<const std::uint8_t> payload);

}  // namespace graspd::dds
