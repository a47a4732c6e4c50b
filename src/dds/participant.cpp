#include "participant.hpp"

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>

#include <fastdds/rtps/attributes/RTPSParticipantAttributes.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/rtps/flowcontrol/FlowControllerDescriptor.hpp>

#include "absent_interfaces.hpp"
#include "security_properties.hpp"
#include "type_hashes.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;

constexpr std::uint32_t kHighestDomain = 232;  // of the RTPS port formula

const eprosima::fastrtps::Duration_t kPeerParticipantLease{1, 500000000};
const eprosima::fastrtps::Duration_t kPeerAnnouncementPeriod{0, 300000000};

fast::DomainParticipantFactory& factory() {
    return *fast::DomainParticipantFactory::get_instance();
}

PlanError bad_file(const std::string& file, const std::string& why) {
    return {PlanErrorCode::kUnreadableFile, "DDS profile file " + file + ": " + why};
}

/// The middleware's own messages go to standard error: standard output is for results.
void prepare_middleware() {
    static std::once_flag once;
    std::call_once(once, [] {
        // A DEFAULT_FASTRTPS_PROFILES.xml in the working folder would be loaded by itself.
        ::setenv("SKIP_DEFAULT_XML_FILE", "1", 1);
        fast::Log::ClearConsumers();
        auto consumer = std::make_unique<fast::StdoutErrConsumer>();
        consumer->stderr_threshold(fast::Log::Kind::Info);
        fast::Log::RegisterConsumer(std::move(consumer));
    });
}

std::optional<PlanError> load_profiles(const std::string& file) {
    static std::mutex mutex;
    static std::filesystem::path loaded;
    const std::lock_guard lock(mutex);
    std::error_code failed;
    const auto path = std::filesystem::canonical(file, failed);
    if (failed || !std::filesystem::is_regular_file(path)) {
        return bad_file(file, "no such file");
    }
    if (!loaded.empty() && loaded != path) {
        return PlanError{
            PlanErrorCode::kInvalidInput,
            "DDS profile file " + file + ": this process already uses " + loaded.string()};
    }
    if (factory().load_XML_profiles_file(path.string()) != ReturnCode_t::RETCODE_OK) {
        return bad_file(file, "is not a valid profile file; standard error says where");
    }
    loaded = path;
    return std::nullopt;
}

/// As rmw puts it: values that end with ';', such as "enclave=/;".
void set_user_data(fast::UserDataQosPolicy& user_data, const std::string& text) {
    user_data.data_vec(std::vector<eprosima::fastrtps::rtps::octet>(text.begin(), text.end()));
}

template <class Qos>
void set_type_hash(Qos& qos, const std::string& type_name) {
    const std::string hash(type_hash(type_name));
    if (!hash.empty()) set_user_data(qos.user_data(), "typehash=" + hash + ";");
}

/// Looks for participants at further hosts, at the ports of the domain.
std::optional<PlanError> add_peers(const std::vector<std::string>& hosts,
                                   fast::DomainParticipantQos& qos) {
    using eprosima::fastrtps::rtps::IPLocator;
    for (const std::string& host : hosts) {
        const auto addresses = IPLocator::isIPv4(host) ? std::set<std::string>{host}
                                                       : IPLocator::resolveNameDNS(host).first;
        if (addresses.empty()) {
            return PlanError{PlanErrorCode::kInvalidInput,
                             "static peer " + host + " has no IPv4 address"};
        }
        for (const std::string& address : addresses) {
            eprosima::fastrtps::rtps::Locator_t locator(LOCATOR_KIND_UDPv4, 0);
            IPLocator::setIPv4(locator, address);
            qos.wire_protocol().builtin.initialPeersList.push_back(locator);
        }
    }
    return std::nullopt;
}

/// Everybody drops a dead planner soon: until then its readers confirm nothing, and a writer that
/// keeps what is not confirmed is full after a few samples.
void shorten_lease(fast::DomainParticipantQos& qos) {
    auto& discovery = qos.wire_protocol().builtin.discovery_config;
    discovery.leaseDuration = kPeerParticipantLease;
    discovery.leaseDuration_announcementperiod = kPeerAnnouncementPeriod;
}

void add_sender_apart(fast::DomainParticipantQos& qos) {
    auto sender = std::make_shared<eprosima::fastdds::rtps::FlowControllerDescriptor>();
    sender->name = kSenderApart;
    qos.flow_controllers().push_back(std::move(sender));
}

}  // namespace

Result<std::unique_ptr<Participant>> Participant::join(const DdsSettings& settings) {
    if (settings.domain > kHighestDomain) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "domain = " + std::to_string(settings.domain) + " must be at most 232"};
    }
    if (settings.max_payload_bytes == 0) {
        return PlanError{PlanErrorCode::kInvalidInput, "max_payload_bytes = 0 must be positive"};
    }
    // Fast DDS's factory writes its defaults unguarded whenever a participant is made.
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    prepare_middleware();
    if (auto error = load_profiles(settings.profile_file)) return *std::move(error);
    fast::DomainParticipantQos qos;
    if (factory().get_participant_qos_from_profile(kParticipantProfile, qos) !=
        ReturnCode_t::RETCODE_OK) {
        return bad_file(settings.profile_file,
                        std::string("has no valid profile ") + kParticipantProfile);
    }
    if (const std::string absent = absent_interfaces(qos); !absent.empty()) {
        return PlanError{PlanErrorCode::kInternal, "DDS profile file " + settings.profile_file +
                                                       ": no interface with the address " + absent +
                                                       " is up"};
    }
    if (auto error = add_peers(settings.static_peers, qos)) return *std::move(error);
    if (settings.node.gid_bytes != GidBytes::kOff) {
        set_user_data(qos.user_data(), "enclave=" + settings.node.enclave + ";");
    }
    if (settings.security) set_security(*settings.security, qos);
    if (settings.watch_peers) shorten_lease(qos);
    add_sender_apart(qos);
    std::unique_ptr<Participant> out(new Participant);
    out->participant_ = factory().create_participant(settings.domain, qos);
    if (out->participant_ == nullptr) {
        return PlanError{PlanErrorCode::kInternal,
                         "the middleware did not join domain " + std::to_string(settings.domain) +
                             (settings.security ? "; are the files beside " +
                                                      settings.security->certificate + " valid?"
                                                : "")};
    }
    out->publisher_ = out->participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    out->subscriber_ = out->participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
    if (out->publisher_ == nullptr || out->subscriber_ == nullptr) {
        return PlanError{PlanErrorCode::kInternal, "the middleware made no publisher, subscriber"};
    }
    if (auto error = out->check_profiles(settings.profile_file)) return *std::move(error);
    return out;
}

Participant::~Participant() {
    if (participant_ == nullptr) return;
    participant_->delete_contained_entities();
    factory().delete_participant(participant_);
}

std::optional<PlanError> Participant::check_profiles(const std::string& file) const {
    const auto check = [&](const Contract& contract, const std::string& kind, auto qos,
                           auto&& get) -> std::optional<PlanError> {
        const std::string name = kind + " " + contract.profile;
        if (get(contract.profile, qos) != ReturnCode_t::RETCODE_OK) {
            if (!contract.required) return std::nullopt;
            return bad_file(file, "has no valid profile " + name);
        }
        const std::string broken = broken_contract(qos, contract);
        if (broken.empty()) return std::nullopt;
        return bad_file(file, name + " " + broken);
    };
    const auto reader = [this](const char* name, fast::DataReaderQos& qos) {
        return subscriber_->get_datareader_qos_from_profile(name, qos);
    };
    const auto writer = [this](const char* name, fast::DataWriterQos& qos) {
        return publisher_->get_datawriter_qos_from_profile(name, qos);
    };
    for (const Contract& contract :
         {kRequestEnds, kReplyEnds, kCancelEnds, kStatusEnds, kDiagnosticsEnds, kMarkersEnds,
          kServiceRequestEnds, kServiceReplyEnds, kMoveItRequestEnds, kMoveItReplyEnds,
          kGraphEnds}) {
        auto error = check(contract, "data_reader", fast::DataReaderQos{}, reader);
        if (!error) error = check(contract, "data_writer", fast::DataWriterQos{}, writer);
        if (error) return error;
    }
    return std::nullopt;
}

/// A topic may have both a reader and a writer here.
fast::Topic* Participant::find_topic(const TopicOf& topic) {
    if (auto* known = participant_->lookup_topicdescription(topic.name)) {
        return dynamic_cast<fast::Topic*>(known);
    }
    if (topic.type.register_type(participant_) != ReturnCode_t::RETCODE_OK) return nullptr;
    return participant_->create_topic(topic.name, topic.type.get_type_name(),
                                      fast::TOPIC_QOS_DEFAULT);
}

fast::DataReader* Participant::create_reader(const TopicOf& topic,
                                             fast::DataReaderListener* listener) {
    fast::Topic* made = find_topic(topic);
    if (made == nullptr) return nullptr;
    fast::DataReaderQos qos = reader_qos(topic.contract);
    subscriber_->get_datareader_qos_from_profile(topic.contract.profile, qos);
    if (topic.contract.announces_hash) set_type_hash(qos, made->get_type_name());
    return subscriber_->create_datareader(made, qos, listener);
}

fast::DataWriter* Participant::create_writer(const TopicOf& topic,
                                             fast::DataWriterListener* listener) {
    fast::Topic* made = find_topic(topic);
    if (made == nullptr) return nullptr;
    fast::DataWriterQos qos = writer_qos(topic.contract);
    publisher_->get_datawriter_qos_from_profile(topic.contract.profile, qos);
    set_greeting(topic.contract, qos);
    if (topic.contract.announces_hash) set_type_hash(qos, made->get_type_name());
    return publisher_->create_datawriter(made, qos, listener);
}

}  // namespace graspd::dds
