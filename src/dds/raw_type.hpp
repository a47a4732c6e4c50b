#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <fastdds/dds/topic/TopicDataType.hpp>

#include "guarded_type.hpp"

namespace graspd::dds {

using Bytes = std::vector<std::uint8_t>;

/// Payloads as they are, under a type's name, for samples whose layout the name does not tell: the
/// service's, which ROS 2's vendors lay out in two ways, and the graph's, which changed with Iron.
/// A sample is a Bytes: encapsulation header, then the members.
class RawType : public eprosima::fastdds::dds::TopicDataType {
public:
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

    RawType(const char* name, std::shared_ptr<PayloadGuard> guard) : guard_(std::move(guard)) {
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
        payload->encapsulation = CDR_LE;
        return true;
    }
    bool deserialize(Payload* payload, void* data) override {
        try {
            if (payload->length <= guard_->max_payload_bytes) {
                static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
                return true;
            }
        } catch (...) {  // no memory for it
        }
        guard_->rejected.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
    }
    void* createData() override { return new Bytes(); }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

protected:
    std::shared_ptr<PayloadGuard> guard_;
};

/// A service call's payload. Of one that is larger than allowed there is no more than who sent it
/// and what it names.
struct CallPayload {
    Bytes bytes;
    std::uint64_t sent_bytes = 0;  ///< as many as came
};

/// As RawType, for the reader of a service's calls: they are answered even when they are too large.
class CallType final : public RawType {
public:
    using RawType::RawType;

    bool deserialize(Payload* payload, void* data) override {
        const std::uint32_t kept = payload->length <= guard_->max_payload_bytes
                                       ? payload->length
                                       : std::min(payload->length, kHead_bytes);
        try {
            auto& call = *static_cast<CallPayload*>(data);
            call.bytes.assign(payload->data, payload->data + kept);
            call.sent_bytes = payload->length;
            return true;
        } catch (...) {  // no memory for it
            guard_->rejected.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
    }
    void* createData() override { return new CallPayload(); }
    void deleteData(void* data) override { delete static_cast<CallPayload*>(data); }

private:
    static constexpr std::uint32_t kHead_bytes = 4096;  // header and names
};

}  // namespace graspd::dds
