#include "walk_message.hpp"

#include <algorithm>
#include <stdexcept>

#include <fastcdr/Cdr.h>
#include <rosidl_typesupport_introspection_cpp/field_types.hpp>

#include "../cdr_samples.hpp"

namespace ros_layout {
namespace {

namespace introspection = rosidl_typesupport_introspection_cpp;
using introspection::MessageMember;
using introspection::MessageMembers;

const MessageMembers& nested_type(const MessageMember& member) {
    return *static_cast<const MessageMembers*>(member.members_->data);
}

bool is_sequence(const MessageMember& member) {
    return member.is_array_ && (member.array_size_ == 0 || member.is_upper_bound_);
}

/// Calls visit with a reference to the value, of the C++ type that the member's elements have.
template <typename Visit>
void with_value(const MessageMember& member, void* value, const Visit& visit) {
    switch (member.type_id_) {
        case introspection::ROS_TYPE_BOOLEAN: return visit(*static_cast<bool*>(value));
        case introspection::ROS_TYPE_OCTET:
        case introspection::ROS_TYPE_UINT8: return visit(*static_cast<std::uint8_t*>(value));
        case introspection::ROS_TYPE_INT32: return visit(*static_cast<std::int32_t*>(value));
        case introspection::ROS_TYPE_UINT32: return visit(*static_cast<std::uint32_t*>(value));
        case introspection::ROS_TYPE_INT64: return visit(*static_cast<std::int64_t*>(value));
        case introspection::ROS_TYPE_UINT64: return visit(*static_cast<std::uint64_t*>(value));
        case introspection::ROS_TYPE_FLOAT: return visit(*static_cast<float*>(value));
        case introspection::ROS_TYPE_DOUBLE: return visit(*static_cast<double*>(value));
        case introspection::ROS_TYPE_STRING: return visit(*static_cast<std::string*>(value));
        default:
            throw std::invalid_argument(std::string("the IDL has no type such as that of ") +
                                        member.name_);
    }
}

class Filler {
public:
    void fill(const MessageMembers& type, void* message) {
        for (std::uint32_t i = 0; i < type.member_count_; ++i) {
            const MessageMember& member = type.members_[i];
            void* at = static_cast<std::uint8_t*>(message) + member.offset_;
            if (is_sequence(member)) {
                const std::size_t bound = member.is_upper_bound_ ? member.array_size_ : 2;
                member.resize_function(at, std::min<std::size_t>(2, bound));
            }
            if (!member.is_array_) {
                fill_one(member, at);
            } else {
                for (std::size_t k = 0; k < member.size_function(at); ++k) {
                    fill_one(member, member.get_function(at, k));
                }
            }
        }
    }

private:
    void fill_one(const MessageMember& member, void* value) {
        if (member.type_id_ == introspection::ROS_TYPE_MESSAGE) {
            fill(nested_type(member), value);
            return;
        }
        ++count_;
        with_value(member, value, [this](auto& target) { set(target); });
    }

    void set(bool& target) const { target = count_ % 2 == 1; }
    void set(std::uint8_t& target) const { target = static_cast<std::uint8_t>(1 + count_ % 250); }
    void set(std::string& target) const { target = "text " + std::to_string(count_); }
    template <typename Number>
    void set(Number& target) const {
        target = static_cast<Number>(count_);
        if constexpr (!std::is_integral_v<Number>) target += Number{0.5};
    }

    std::uint64_t count_ = 0;
};

void write(const MessageMembers& type, const void* message, eprosima::fastcdr::Cdr& out);

void write_one(const MessageMember& member, const void* value, eprosima::fastcdr::Cdr& out) {
    if (member.type_id_ == introspection::ROS_TYPE_MESSAGE) {
        write(nested_type(member), value, out);
    } else {
        with_value(member, const_cast<void*>(value), [&out](const auto& source) { out << source; });
    }
}

void write(const MessageMembers& type, const void* message, eprosima::fastcdr::Cdr& out) {
    for (std::uint32_t i = 0; i < type.member_count_; ++i) {
        const MessageMember& member = type.members_[i];
        const void* at = static_cast<const std::uint8_t*>(message) + member.offset_;
        if (!member.is_array_) {
            write_one(member, at, out);
            continue;
        }
        const std::size_t count = member.size_function(at);
        if (is_sequence(member)) out << static_cast<std::uint32_t>(count);
        for (std::size_t k = 0; k < count; ++k) {
            write_one(member, member.get_const_function(at, k), out);
        }
    }
}

}  // namespace

void fill_message(const MessageMembers& type, void* message) {
    Filler().fill(type, message);
}

std::vector<std::uint8_t> to_cdr(const MessageMembers& type, const void* message) {
    return cdr_samples::cdr_of([&](eprosima::fastcdr::Cdr& out) { write(type, message, out); });
}

}  // namespace ros_layout
