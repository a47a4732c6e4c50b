#include "participant.hpp"

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>

namespace graspd::dds {
namespace {

using eprosima::fastrtps::types::ReturnCode_t;

constexpr std::uint32_t kHighestDomain = 232;  // of the RTPS port formula

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

/// What a profile must say for the daemon's promises to hold.
template <class Qos>
std::string broken_contract(const Qos& qos, fast::DurabilityQosPolicyKind durability) {
    if (qos.reliability().kind != fast::RELIABLE_RELIABILITY_QOS) return "must be RELIABLE";
    if (qos.history().kind != fast::KEEP_ALL_HISTORY_QOS) return "must be KEEP_ALL";
    if (qos.durability().kind == durability) return "";
    return durability == fast::VOLATILE_DURABILITY_QOS ? "must be VOLATILE"
                                                       : "must be TRANSIENT_LOCAL";
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
    std::unique_ptr<Participant> out(new Participant);
    out->participant_ = factory().create_participant(settings.domain, qos);
    if (out->participant_ == nullptr) {
        return PlanError{PlanErrorCode::kInternal,
                         "the middleware did not join domain " + std::to_string(settings.domain)};
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
    const auto check = [&](const char* name, auto qos, auto durability,
                           auto&& get) -> std::optional<PlanError> {
        if (get(name, qos) != ReturnCode_t::RETCODE_OK) {
            return bad_file(file, std::string("has no valid profile ") + name);
        }
        const std::string broken = broken_contract(qos, durability);
        if (broken.empty()) return std::nullopt;
        return bad_file(file, std::string(name) + " " + broken);
    };
    const auto reader = [this](const char* name, fast::DataReaderQos& qos) {
        return subscriber_->get_datareader_qos_from_profile(name, qos);
    };
    const auto writer = [this](const char* name, fast::DataWriterQos& qos) {
        return publisher_->get_datawriter_qos_from_profile(name, qos);
    };
    constexpr auto kVolatile = fast::VOLATILE_DURABILITY_QOS;
    constexpr auto kLocal = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
    auto error = check(kRequestReader, fast::DataReaderQos{}, kVolatile, reader);
    if (!error) error = check(kReplyReader, fast::DataReaderQos{}, kLocal, reader);
    if (!error) error = check(kRequestWriter, fast::DataWriterQos{}, kVolatile, writer);
    if (!error) error = check(kReplyWriter, fast::DataWriterQos{}, kLocal, writer);
    return error;
}

fast::Topic* Participant::create_topic(const TopicOf& topic) {
    if (topic.type.register_type(participant_) != ReturnCode_t::RETCODE_OK) return nullptr;
    return participant_->create_topic(topic.name, topic.type.get_type_name(),
                                      fast::TOPIC_QOS_DEFAULT);
}

fast::DataReader* Participant::create_reader(const TopicOf& topic, const char* profile,
                                             fast::DataReaderListener* listener) {
    fast::Topic* made = create_topic(topic);
    if (made == nullptr) return nullptr;
    return subscriber_->create_datareader_with_profile(made, profile, listener);
}

fast::DataWriter* Participant::create_writer(const TopicOf& topic, const char* profile,
                                             fast::DataWriterListener* listener) {
    fast::Topic* made = create_topic(topic);
    if (made == nullptr) return nullptr;
    return publisher_->create_datawriter_with_profile(made, profile, listener);
}

}  // namespace graspd::dds
