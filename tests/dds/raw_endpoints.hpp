#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <graspd_msgs/graspdPubSubTypes.h>

#include "cdr_bytes.hpp"
#include "participant.hpp"
#include "support/dds_domain.hpp"
#include "wire_types.hpp"

namespace graspd::test {

using dds::Bytes;
using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;

/// The payload of a sample: encapsulation CDR_LE, then the members.
template <class Struct>
Bytes payload_of(const Struct& sample) {
    return dds::cdr_bytes(sample);
}

/// The bytes of a request as rmw_cyclonedds lays them out, put together by hand: encapsulation,
/// eight bytes of the client's id, eight of the call's number, the members.
inline Bytes with_header(const Bytes& plain, std::uint64_t client, std::int64_t number) {
    Bytes out(plain.begin(), plain.begin() + 4);
    for (int i = 0; i < 8; ++i) out.push_back(static_cast<std::uint8_t>(client >> (8 * i)));
    for (int i = 0; i < 8; ++i) {
        out.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8 * i)));
    }
    out.insert(out.end(), plain.begin() + 4, plain.end());
    return out;
}

/// As it arrives: RTPS fills a payload up to a multiple of four bytes, with zeros.
inline Bytes as_received(Bytes payload) {
    payload.resize((payload.size() + 3) / 4 * 4, 0);
    return payload;
}

/// Any bytes under a type's name.
inline dds::fast::TypeSupport raw_type(const char* name) {
    return dds::fast::TypeSupport(new dds::RawType(name, std::make_shared<dds::PayloadGuard>()));
}

/// The two topics of a RawClient.
struct RawTopics {
    std::string request = "rt/graspd/grasp_request";
    std::string request_type = "graspd_msgs::msg::dds_::GraspRequest_";
    dds::Contract request_ends = dds::kRequestEnds;
    std::string reply = "rt/graspd/ranked_grasps";
    std::string reply_type = "graspd_msgs::msg::dds_::RankedGrasps_";
    dds::Contract reply_ends = dds::kReplyEnds;
};

/// The two topics of the service, with the volatile reader of a ROS 2 client.
inline RawTopics service_topics() {
    RawTopics topics{"rq/graspd/plan_graspsRequest",
                     "graspd_msgs::srv::dds_::PlanGrasps_Request_",
                     dds::kServiceRequestEnds,
                     "rr/graspd/plan_graspsReply",
                     "graspd_msgs::srv::dds_::PlanGrasps_Response_",
                     dds::kServiceReplyEnds};
    topics.reply_ends.transient_local = false;
    return topics;
}

/// A participant that writes raw payloads on one topic and collects those of another.
class RawClient final : public dds::fast::DataReaderListener, public dds::fast::DataWriterListener {
public:
    struct Sample {
        Bytes payload;
        eprosima::fastrtps::rtps::SampleIdentity related;  ///< what it answers, by its writer
    };

    explicit RawClient(const RawTopics& topics = {},
                       const DdsSettings& settings = loopback_settings()) {
        auto joined = dds::Participant::join(settings);
        EXPECT_TRUE(joined.ok()) << joined.error().detail;
        participant_ = std::move(joined).value();
        reader_ = participant_->create_reader(
            {topics.reply, raw_type(topics.reply_type.c_str()), topics.reply_ends}, this);
        writer_ = participant_->create_writer(
            {topics.request, raw_type(topics.request_type.c_str()), topics.request_ends}, this);
    }
    ~RawClient() override { participant_.reset(); }

    bool wait_matched(int planners = 1) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(10), [this, planners] {
            return readers_ >= planners && writers_ >= planners;
        });
    }
    /// Waits until both of its partners have left.
    bool wait_alone() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(10),
                                 [this] { return readers_ == 0 && writers_ == 0; });
    }
    /// A full history gives way to a volatile writer with a timeout that means "try again".
    bool write(Bytes payload) {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        ReturnCode code = ReturnCode::RETCODE_TIMEOUT;
        while (code == ReturnCode::RETCODE_TIMEOUT && std::chrono::steady_clock::now() < deadline) {
            code = writer_->write(&payload, eprosima::fastrtps::rtps::c_InstanceHandle_Unknown);
        }
        return code == ReturnCode::RETCODE_OK;
    }
    /// As rmw_fastrtps calls a service: naming its own reply reader.
    /// @return the number of the request, which the reply will name; 0: not written
    std::uint64_t call(Bytes payload) {
        eprosima::fastrtps::rtps::WriteParams parameters;
        parameters.related_sample_identity().writer_guid(reader_->guid());
        if (!writer_->write(&payload, parameters)) return 0;
        return parameters.sample_identity().sequence_number().to64long();
    }
    dds::fast::DataReader& reader() { return *reader_; }
    dds::fast::DataWriter& writer() { return *writer_; }

    /// Waits until so many samples have come, and returns all.
    std::vector<Sample> wait_for_samples(std::size_t count) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::seconds(10), [&] { return samples_.size() >= count; });
        return samples_;
    }
    std::vector<Bytes> wait_for(std::size_t count) {
        std::vector<Bytes> payloads;
        for (Sample& sample : wait_for_samples(count))
            payloads.push_back(std::move(sample.payload));
        return payloads;
    }

    void on_data_available(dds::fast::DataReader* reader) override {
        Bytes bytes;
        dds::fast::SampleInfo info;
        while (reader->take_next_sample(&bytes, &info) == ReturnCode::RETCODE_OK) {
            const std::lock_guard lock(mutex_);
            if (info.valid_data) samples_.push_back({bytes, info.related_sample_identity});
            changed_.notify_all();
        }
    }
    void on_subscription_matched(dds::fast::DataReader*,
                                 const dds::fast::SubscriptionMatchedStatus& status) override {
        const std::lock_guard lock(mutex_);
        writers_ = status.current_count;
        changed_.notify_all();
    }
    void on_publication_matched(dds::fast::DataWriter*,
                                const dds::fast::PublicationMatchedStatus& status) override {
        const std::lock_guard lock(mutex_);
        readers_ = status.current_count;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int readers_ = 0;
    int writers_ = 0;
    std::vector<Sample> samples_;
    std::unique_ptr<dds::Participant> participant_;
    dds::fast::DataReader* reader_ = nullptr;
    dds::fast::DataWriter* writer_ = nullptr;
};

}  // namespace graspd::test
