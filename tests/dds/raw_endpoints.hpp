#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include <fastcdr/Cdr.h>
#include <graspd_msgs/graspdPubSubTypes.h>

#include "participant.hpp"
#include "support/dds_domain.hpp"
#include "wire_types.hpp"

namespace graspd::test {

using Bytes = std::vector<std::uint8_t>;
using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;

/// The payload of a sample: encapsulation CDR_LE, then the members.
template <class Struct>
Bytes payload_of(const Struct& sample) {
    Bytes bytes(Struct::getCdrSerializedSize(sample) + 4);
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    sample.serialize(cdr);
    bytes.resize(cdr.getSerializedDataLength());
    return bytes;
}

/// Sends any bytes under a type's name.
class RawType final : public dds::fast::TopicDataType {
public:
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

    explicit RawType(const char* name) {
        setName(name);
        m_typeSize = 4;
        m_isGetKeyDefined = false;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, Payload* payload) override {
        const auto& bytes = *static_cast<Bytes*>(data);
        std::ranges::copy(bytes, payload->data);
        payload->length = static_cast<std::uint32_t>(bytes.size());
        return true;
    }
    bool deserialize(Payload* payload, void* data) override {
        static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
        return true;
    }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
    }
    void* createData() override { return new Bytes(); }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

/// A participant that writes raw payloads under the request's type and reads raw replies.
class RawClient final : public dds::fast::DataReaderListener, public dds::fast::DataWriterListener {
public:
    RawClient() {
        auto joined = dds::Participant::join(loopback_settings());
        EXPECT_TRUE(joined.ok()) << joined.error().detail;
        participant_ = std::move(joined).value();
        const char* reply = "graspd_msgs::msg::dds_::RankedGrasps_";
        const char* request = "graspd_msgs::msg::dds_::GraspRequest_";
        participant_->create_reader({dds::kReplyTopic, dds::fast::TypeSupport(new RawType(reply))},
                                    dds::kReplyReader, this);
        writer_ = participant_->create_writer(
            {dds::kRequestTopic, dds::fast::TypeSupport(new RawType(request))}, dds::kRequestWriter,
            this);
    }
    ~RawClient() override { participant_.reset(); }

    bool wait_matched() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(10),
                                 [this] { return readers_ > 0 && writers_ > 0; });
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
    /// Waits until so many replies have come, and returns all.
    std::vector<Bytes> wait_for(std::size_t count) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::seconds(10), [&] { return replies_.size() >= count; });
        return replies_;
    }

    void on_data_available(dds::fast::DataReader* reader) override {
        Bytes bytes;
        dds::fast::SampleInfo info;
        while (reader->take_next_sample(&bytes, &info) == ReturnCode::RETCODE_OK) {
            const std::lock_guard lock(mutex_);
            if (info.valid_data) replies_.push_back(bytes);
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
    std::vector<Bytes> replies_;
    std::unique_ptr<dds::Participant> participant_;
    dds::fast::DataWriter* writer_ = nullptr;
};

}  // namespace graspd::test
