#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include <fastdds/dds/topic/TopicDataType.hpp>

#include "cdr_layout.hpp"
#include "graspd/dds/dds_settings.hpp"

namespace graspd::dds {

/// What a guard lets through, and how much it refused. Shared with whoever reports the count.
struct PayloadGuard {
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [byte] with the encapsulation header
    RequestLimits limits;                          ///< of requests
    std::atomic<std::uint64_t> rejected{0};        ///< samples that were refused
};

/// A type support from fastddsgen whose deserialize() survives any bytes.
///
/// The generated one lets BadParamException and bad_alloc escape into the middleware's thread,
/// which ends the process, and allocates what a count in the sample asks for. Here the bytes are
/// walked first (cdr_layout.hpp); whatever still throws is caught. A refused sample is counted, and
/// the middleware drops it.
///
/// `Sample` is what createData() makes: the generated struct, or a struct that inherits from it.
/// One that has a member read(payload, guard) reads its payload itself.
template <class Generated, class Sample = typename Generated::type>
class GuardedType : public Generated {
public:
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

    explicit GuardedType(std::shared_ptr<PayloadGuard> guard)
        : guard_(std::move(guard)), layout_(wire_layouts().find(Generated::getName())) {
        Generated::auto_fill_type_object(false);
        Generated::auto_fill_type_information(false);
    }

    /// The generated one leaves alignment bytes as the memory was: the same sample would give other
    /// bytes, some of them left by whatever stood there before.
    bool serialize(void* data, Payload* payload) override {
        std::memset(payload->data, 0, payload->max_size);
        return Generated::serialize(data, payload);
    }

    bool deserialize(Payload* payload, void* data) override {
        if (accept(payload, data)) return true;
        guard_->rejected.fetch_add(1, std::memory_order_relaxed);
        return false;
    }

    void* createData() override { return new Sample(); }
    void deleteData(void* data) override { delete static_cast<Sample*>(data); }

private:
    bool accept(Payload* payload, void* data) {
        if (layout_ == nullptr || payload == nullptr || payload->data == nullptr) return false;
        const std::span<std::uint8_t> bytes{payload->data, payload->length};
        auto* sample = static_cast<Sample*>(data);
        try {
            if constexpr (requires { sample->read(bytes, *guard_); }) {
                return sample->read(bytes, *guard_);
            } else {
                return bytes.size() <= guard_->max_payload_bytes &&
                       is_well_formed(bytes, *layout_) &&
                       Generated::deserialize(payload,
                                              static_cast<typename Generated::type*>(sample));
            }
        } catch (...) {  // fastcdr's exceptions, bad_alloc: nothing may pass
            return false;
        }
    }

    std::shared_ptr<PayloadGuard> guard_;
    const CdrStruct* layout_;
};

}  // namespace graspd::dds
