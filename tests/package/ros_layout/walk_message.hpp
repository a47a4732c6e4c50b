#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rosidl_typesupport_introspection_cpp/message_introspection.hpp>

namespace ros_layout {

/// Fills a message of rosidl, of any type: every number and string differs from the ones before (a
/// boolean from the last one, a byte from the last 250). Sequences get two elements, or one where
/// that is their bound.
void fill_message(const rosidl_typesupport_introspection_cpp::MessageMembers& type, void* message);

/// The message as CDR: 4 bytes of encapsulation (little endian), then its members in rosidl's
/// order.
std::vector<std::uint8_t> to_cdr(const rosidl_typesupport_introspection_cpp::MessageMembers& type,
                                 const void* message);

}  // namespace ros_layout
