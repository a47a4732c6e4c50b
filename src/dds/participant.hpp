#pragma once

#include <memory>
#include <optional>
#include <string>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "endpoints.hpp"
#include "graspd/base/result.hpp"
#include "graspd/dds/dds_settings.hpp"

namespace graspd::dds {

inline constexpr const char* kParticipantProfile = "graspd_participant";

/// A topic with the type that travels on it.
struct TopicOf {
    std::string name;
    fast::TypeSupport type;  ///< null where the participant has the topic already
    Contract contract;
};

/// A DDS participant with the endpoints made through it; the destructor removes them all, after
/// which no listener is called any more.
class Participant {
public:
    /// Loads the profile file, checks it and joins the domain. One process uses one profile file:
    /// the middleware keeps the first profile of a name, whatever a later file says.
    /// @return kUnreadableFile for a file that is missing, broken, lacks a profile or has one whose
    ///         reliability, durability or history is not that of the contract; kInvalidInput for a
    ///         domain above 232, no payload bytes, or a second file; kInternal when the middleware
    ///         refuses or no interface of the profile is up (which another try may find mended)
    static Result<std::unique_ptr<Participant>> join(const DdsSettings& settings);

    Participant(const Participant&) = delete;
    Participant& operator=(const Participant&) = delete;
    ~Participant();

    /// Null when the middleware refuses. The listener must outlive this participant. The endpoint
    /// carries the hash of its type (src/dds/type_hashes.hpp) as ROS 2 nodes do from Iron on.
    fast::DataReader* create_reader(const TopicOf& topic, fast::DataReaderListener* listener);
    fast::DataWriter* create_writer(const TopicOf& topic, fast::DataWriterListener* listener);

    /// Prefix and entity id of this participant.
    eprosima::fastrtps::rtps::GUID_t guid() const { return participant_->guid(); }

private:
    Participant() = default;
    std::optional<PlanError> check_profiles(const std::string& file) const;
    fast::Topic* find_topic(const TopicOf& topic);

    fast::DomainParticipant* participant_ = nullptr;
    fast::Publisher* publisher_ = nullptr;
    fast::Subscriber* subscriber_ = nullptr;
};

}  // namespace graspd::dds
