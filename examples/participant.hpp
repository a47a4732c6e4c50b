#pragma once

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

namespace example {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

/// Ends the program with a message (main catches it) when the middleware gave nothing.
template <class T>
T* required(T* entity, const std::string& what) {
    if (entity == nullptr) throw std::runtime_error("the middleware refused " + what);
    return entity;
}

/// A DDS participant whose transports and QoS come from one profile file, and from nowhere else:
/// a file that is missing or broken ends the program, it never falls back to defaults that would
/// reach out into the network.
class Participant {
public:
    Participant(std::uint32_t domain, const std::string& profile_file) {
        ::setenv("SKIP_DEFAULT_XML_FILE", "1", 1);  // none from the working folder
        if (factory().load_XML_profiles_file(profile_file) != ReturnCode_t::RETCODE_OK) {
            throw std::runtime_error(profile_file + " is no valid profile file");
        }
        participant_ =
            required(factory().create_participant_with_profile(domain, "graspd_participant"),
                     "profile graspd_participant");
    }
    ~Participant() {
        participant_->delete_contained_entities();
        factory().delete_participant(participant_);
    }
    Participant(const Participant&) = delete;
    Participant& operator=(const Participant&) = delete;

    dds::DataWriter* writer(const char* topic, const dds::TypeSupport& type, const char* profile) {
        dds::Topic* made = make_topic(topic, type);
        dds::Publisher* publisher =
            required(participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "a publisher");
        return required(publisher->create_datawriter_with_profile(made, profile), profile);
    }
    dds::DataReader* reader(const char* topic, const dds::TypeSupport& type, const char* profile) {
        dds::Topic* made = make_topic(topic, type);
        dds::Subscriber* subscriber =
            required(participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "a subscriber");
        return required(subscriber->create_datareader_with_profile(made, profile), profile);
    }

private:
    static dds::DomainParticipantFactory& factory() {
        return *dds::DomainParticipantFactory::get_instance();
    }
    dds::Topic* make_topic(const char* name, const dds::TypeSupport& type) {
        type.register_type(participant_);
        return required(
            participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT), name);
    }

    dds::DomainParticipant* participant_ = nullptr;
};

}  // namespace example
