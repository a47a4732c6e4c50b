"""The ROS 2 side of the wire: names, types, and the text of .msg and .srv files.

ROS 2 mangles pkg/msg/Type to pkg::msg::dds_::Type_ on the wire; here it goes the other way round.
"""

import re
import textwrap
from dataclasses import dataclass

PACKAGE = "graspd_msgs"
# Humble's layout under the same ROS 2 names.
SKIPPED_PACKAGES = ("rmw_dds_common_gid24", "moveit_msgs_humble")
COLUMNS = 98
ROS_TYPES = {"boolean": "bool", "octet": "uint8", "float": "float32", "double": "float64",
             "string": "string", "long": "int32", "unsigned long": "uint32", "long long": "int64",
             "unsigned long long": "uint64"}
# Where ROS 2 has another type of the same size: (message, member) -> type.
SPECIAL_TYPES = {("diagnostic_msgs/DiagnosticStatus", "level"): "byte",
                 ("rmw_dds_common/Gid", "data"): "char",
                 ("moveit_msgs/CollisionObject", "operation"): "byte"}
# The same for all constants of a message.
SPECIAL_CONSTANT_TYPES = {"diagnostic_msgs/DiagnosticStatus": "byte",
                          "moveit_msgs/CollisionObject": "byte"}
FRAMES = {
    "F": "F is the frame that the request's header.frame_id names.",
    "O": "O is the coordinates of the mesh or cloud as received; object_pose is O in F.",
    "H": "H is the gripper's mounting frame: Hz the approach axis, origin at the flange.",
    "G": "G is the grasp frame: origin midway between the pads' centres at the contact width, Gx the "
         "closing direction, Gz the approach direction, Gy = Gz x Gx."}
NOTICE = "# Generated from idl/graspd.idl by scripts/interfaces. Do not edit."


@dataclass
class Field:
    """`type` is a word of .msg files, or package/Name; shape, size and string_bound as in idl.Member."""

    name: str
    type: str
    shape: str
    size: int
    string_bound: int
    comment: str

    def type_text(self, package):
        """The type as a .msg file of that package writes it."""
        text = self.type.removeprefix(package + "/")
        if self.string_bound:
            text += f"<={self.string_bound}"
        return text + {"one": "", "array": f"[{self.size}]", "bounded": f"[<={self.size}]",
                       "unbounded": "[]"}[self.shape]


@dataclass
class Message:
    package: str
    folder: str  # "msg" or "srv"
    name: str
    dds_name: str
    comment: str
    fields: list
    constants: list  # of (type, name, value, comment)


def ros_name(full_name):
    """graspd_msgs::msg::dds_::Grasp_ -> ("graspd_msgs", "msg", "Grasp")."""
    package, folder, _, name = full_name.split("::")
    return package, folder, name.removesuffix("_")


def to_field(owner, member):
    if "::" in member.type:
        package, _, name = ros_name(member.type)
        type_name = f"{package}/{name}"
    else:
        type_name = SPECIAL_TYPES.get((owner, member.name), ROS_TYPES[member.type])
    return Field(member.name, type_name, member.shape, member.size, member.string_bound,
                 member.comment)


def to_messages(idl):
    """Every struct of the IDL that ROS 2 knows, in the order of the text."""
    messages = []
    for full_name, struct in idl.structs.items():
        package, folder, name = ros_name(full_name)
        if package in SKIPPED_PACKAGES:
            continue
        owner = f"{package}/{name}"
        constants = [(SPECIAL_CONSTANT_TYPES.get(owner, ROS_TYPES[c.type]), c.name.removesuffix("_"),
                      c.value, c.comment) for c in idl.constants.get(full_name, [])]
        fields = [to_field(owner, member) for member in struct.members]
        messages.append(Message(package, folder, name, full_name, struct.comment, fields, constants))
    return messages


def paragraphs(comment):
    """The comment's paragraphs, each without its line breaks."""
    return [" ".join(part.split()) for part in comment.split("\n\n") if part.strip()]


def comment_lines(comment):
    lines = []
    for paragraph in paragraphs(comment):
        lines += ["#"] if lines else []
        lines += ["# " + line for line in textwrap.wrap(paragraph, COLUMNS - 2)]
    return lines


def declaration_lines(declarations):
    """Lines of (declaration, comment): all comments behind where that fits, else all above."""
    column = max((len(text) for text, _ in declarations), default=0) + 2
    flat = [(text, " ".join(comment.split())) for text, comment in declarations]
    if all(column + 2 + len(comment) <= COLUMNS for _, comment in flat):
        return [f"{text:{column}}# {comment}" if comment else text for text, comment in flat]
    lines = []
    for text, comment in flat:
        lines += ([""] if lines else []) + comment_lines(comment) + [text]
    return lines


def frame_lines(message):
    """What the letters mean that the comments of a message name frames by."""
    text = "\n".join([message.comment] + [field.comment for field in message.fields])
    used = set(re.findall(r"\b([FOGH])[xyz]?\b", text))
    return [line for letter, meaning in FRAMES.items()
            if letter in used and f"{letter} is" not in message.comment
            for line in comment_lines(meaning)]


def body_lines(message):
    """Comment, constants and fields of a message."""
    parts = [comment_lines(message.comment)]
    if message.package == PACKAGE:
        parts.append(frame_lines(message))
    parts.append(declaration_lines([(f"{type_name} {name}={value}", comment)
                                    for type_name, name, value, comment in message.constants]))
    parts.append(declaration_lines([(f"{field.type_text(message.package)} {field.name}", field.comment)
                                    for field in message.fields]))
    lines = []
    for part in parts:
        lines += ([""] if lines and part else []) + part
    return lines


def file_texts(messages):
    """{path below idl/: text} of every .msg and .srv file."""
    texts = {}
    for message in messages:
        below = "" if message.package == PACKAGE else "ros2_interfaces/"
        if message.folder == "msg":
            path = f"{below}{message.package}/msg/{message.name}.msg"
            texts[path] = "\n".join([NOTICE] + body_lines(message)) + "\n"
        elif message.name.endswith("_Request"):
            service = message.name.removesuffix("_Request")
            path = f"{below}{message.package}/srv/{service}.srv"
            texts[path] = "\n".join([NOTICE] + service_lines(messages, message, service)) + "\n"
    return texts


def service_lines(messages, request, service):
    """Request and response of one service, which the IDL holds as two structs."""
    response = next(message for message in messages
                    if message.package == request.package and message.name == service + "_Response")
    return body_lines(request) + ["---"] + body_lines(response)
