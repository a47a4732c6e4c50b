"""Type hashes of ROS 2 (RIHS01, from Iron on), as REP-2011 and REP-2016 define them.

A hash is the SHA-256 of the type's description as JSON, together with the descriptions of every type
that it reaches, sorted by name. Constants, comments and default values do not count.
"""

import hashlib
import json

# type_description_interfaces/msg/FieldType: single values; arrays and sequences add an offset.
TYPE_IDS = {"int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8,
            "uint64": 9, "float32": 10, "float64": 11, "bool": 15, "byte": 16, "string": 17,
            "char": 3}  # rosidl turns a .msg file's char into uint8
NESTED_TYPE_ID = 1
BOUNDED_STRING_ID = 21
SHAPE_OFFSETS = {"one": 0, "array": 48, "bounded": 96, "unbounded": 144}
# service_msgs/msg/ServiceEventInfo, which the event message of every service holds.
EVENT_INFO = ("service_msgs/msg/ServiceEventInfo", (
    ("event_type", 3, 0, ""), ("stamp", 1, 0, "builtin_interfaces/msg/Time"),
    ("client_gid", 51, 16, ""), ("sequence_number", 8, 0, "")))


def field_description(name, type_id, capacity=0, nested="", string_capacity=0):
    return {"name": name, "type": {"type_id": type_id, "capacity": capacity,
                                   "string_capacity": string_capacity, "nested_type_name": nested}}


def describe_field(field):
    nested = ""
    if "/" in field.type:
        package, name = field.type.split("/")
        nested = f"{package}/msg/{name}"
        type_id = NESTED_TYPE_ID
    else:
        type_id = BOUNDED_STRING_ID if field.string_bound else TYPE_IDS[field.type]
    return field_description(field.name, type_id + SHAPE_OFFSETS[field.shape], field.size, nested,
                             field.string_bound)


def describe_message(message):
    fields = [describe_field(field) for field in message.fields]
    if not fields:  # rosidl adds this member, since C and C++ have no empty struct
        fields = [field_description("structure_needs_at_least_one_member", TYPE_IDS["uint8"])]
    return {"type_name": f"{message.package}/{message.folder}/{message.name}", "fields": fields}


def describe_service(name):
    """The event message and the service itself, given name = package/srv/Name."""
    info, event_fields = EVENT_INFO
    bounded = NESTED_TYPE_ID + SHAPE_OFFSETS["bounded"]
    yield {"type_name": info, "fields": [field_description(*field) for field in event_fields]}
    yield {"type_name": name + "_Event", "fields": [
        field_description("info", NESTED_TYPE_ID, 0, info),
        field_description("request", bounded, 1, name + "_Request"),
        field_description("response", bounded, 1, name + "_Response")]}
    yield {"type_name": name, "fields": [
        field_description(f"{part.lower()}_message", NESTED_TYPE_ID, 0, f"{name}_{part}")
        for part in ("Request", "Response", "Event")]}


def describe_all(messages):
    """{type name: description} of the messages and of their services."""
    descriptions = []
    for message in messages:
        descriptions.append(describe_message(message))
        if message.folder == "srv" and message.name.endswith("_Response"):
            name = f"{message.package}/srv/{message.name.removesuffix('_Response')}"
            descriptions += describe_service(name)
    return {description["type_name"]: description for description in descriptions}


def reached_types(type_name, descriptions):
    reached = set()
    waiting = [type_name]
    while waiting:
        for field in descriptions[waiting.pop()]["fields"]:
            nested = field["type"]["nested_type_name"]
            if nested and nested not in reached:
                reached.add(nested)
                waiting.append(nested)
    return sorted(reached)


def type_hash(type_name, descriptions):
    """"RIHS01_..." of a type such as "std_msgs/msg/Header"."""
    full = {"type_description": descriptions[type_name],
            "referenced_type_descriptions": [descriptions[name] for name
                                             in reached_types(type_name, descriptions)]}
    text = json.dumps(full, ensure_ascii=True, separators=(", ", ": "), sort_keys=False)
    return "RIHS01_" + hashlib.sha256(text.encode()).hexdigest()


# The types of the topics that graspd has, and its service.
TOPIC_TYPES = ("graspd_msgs/msg/GraspRequest", "graspd_msgs/msg/RankedGrasps",
               "graspd_msgs/msg/CancelRequest", "graspd_msgs/msg/PlannerStatus",
               "graspd_msgs/srv/PlanGrasps_Request", "graspd_msgs/srv/PlanGrasps_Response",
               "graspd_msgs/srv/PlanGrasps", "moveit_msgs/srv/GraspPlanning_Request",
               "moveit_msgs/srv/GraspPlanning_Response", "moveit_msgs/srv/GraspPlanning",
               "visualization_msgs/msg/MarkerArray",
               "diagnostic_msgs/msg/DiagnosticArray", "rmw_dds_common/msg/ParticipantEntitiesInfo")

HEADER = """\
// Generated from idl/graspd.idl by scripts/interfaces. Do not edit.
#pragma once

#include <string_view>

namespace graspd::dds {{

/// A type as it is named on the wire, and its hash.
struct TypeHash {{
    std::string_view dds_type_name;
    std::string_view hash;
}};

/// ROS 2's type hashes (REP-2011) of every type that graspd has a topic of.
///
/// ROS 2 nodes announce the hash of an endpoint's type as "typehash=RIHS01_...;" in its user data,
/// from Iron on. The endpoints of a service carry the hash of the message that they transport; the
/// service's own hash belongs into "sertypehash=RIHS01_...;", which newer versions of ROS 2 add.
/// The hash of ParticipantEntitiesInfo_ is that of the 16-byte Gid.
inline constexpr TypeHash kTypeHashes[] = {{
{rows}
}};

/// The hash of a type by its name on the wire, such as "graspd_msgs::msg::dds_::RankedGrasps_".
///
/// @return "RIHS01_" and 64 hexadecimal digits; empty for a type that is not in kTypeHashes
/// Complexity O(types). Pure, so safe to call from any thread.
constexpr std::string_view type_hash(std::string_view dds_type_name) {{
    for (const TypeHash& row : kTypeHashes) {{
        if (row.dds_type_name == dds_type_name) return row.hash;
    }}
    return {{}};
}}

}}  // namespace graspd::dds
"""


def dds_type_name(type_name):
    package, folder, name = type_name.split("/")
    return f"{package}::{folder}::dds_::{name}_"


def topic_hashes(messages):
    """[(type name, hash)] of TOPIC_TYPES."""
    descriptions = describe_all(messages)
    return [(name, type_hash(name, descriptions)) for name in TOPIC_TYPES]


def header_text(messages):
    """The text of src/dds/type_hashes.hpp."""
    rows = [f'    {{"{dds_type_name(name)}",\n     "{digest}"}},'
            for name, digest in topic_hashes(messages)]
    return HEADER.format(rows="\n".join(rows))
