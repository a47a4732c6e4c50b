#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include <fastdds/dds/topic/TopicDataType.hpp>

#include "cdr_layout.hpp"

namespace graspd::dds {

/// What a guard lets through, and how much it refused. Shared with whoever reports the count.
struct PayloadGuard {
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [byte] with the encapsulation header
    std::atomic<std::uint64_t> rejected{0};        ///< samples that were refused
};

/// A type support from fastddsgen whose deserialize() survives any bytes.
///
/// The generated one lets BadParamException and bad_alloc escape into the middleware's thread,
/// which ends the process, and allocates what a count in the sample asks for. Here the bytes are
/// walked first (cdr_layout.hpp); whatever still throws is caught. A refused sample is counted, and
/// the middleware drops it.
///
/// `Sample` is what createData() makes: the generated struct, or a struct that inherits from it. If
/// it has a member read(), that reads the payload once its bytes have been walked.
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
        if (payload->length > guard_->max_payload_bytes) return false;
        if (!is_well_formed({payload->data, payload->length}, *layout_)) return false;
        try {
            auto* sample = static_cast<Sample*>(data);
            if constexpr (requires { sample->read(std::span<std::uint8_t>()); }) {
                sample->read({payload->data, payload->length});
                return true;
            } else {
                return Generated::deserialize(payload,
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
