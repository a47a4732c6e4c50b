"""Compares the .msg and .srv files, as rosidl's own parser reads them, with the text of idl/graspd.idl.

Neither side goes through scripts/interfaces: the IDL is taken apart by regular expressions here. Runs
with the interpreter that rosidl is installed for.
"""

import re
import unittest
from pathlib import Path

from rosidl_adapter.parser import parse_message_file, parse_service_file

IDL_FOLDER = Path(__file__).resolve().parents[2] / "idl"
# As the IDL calls rosidl's types; byte, char and uint8 are one octet each.
IDL_TYPES = {"bool": "boolean", "byte": "octet", "char": "octet", "uint8": "octet", "int32": "long",
             "uint32": "unsigned long", "int64": "long long", "uint64": "unsigned long long",
             "float32": "float", "float64": "double", "string": "string"}


def idl_types():
    """({full name: [(type, member)]}, {full name: {constant: value}}) of the IDL, Humble's layouts left out."""
    text = re.sub(r"//[^\n]*", "", (IDL_FOLDER / "graspd.idl").read_text())
    structs, constants = {}, {}
    scope = []
    for word, name, body in re.findall(r"(module|struct|\}) *(\w+)?(?: *\{([^{}]*)\})?", text):
        if word == "}":
            scope.pop()
        elif word == "module" and name.endswith("__Constants"):
            owner = "::".join(scope + [name.removesuffix("_Constants")])
            constants[owner] = {constant.removesuffix("_"): int(value) for constant, value
                                in re.findall(r"(\w+) = (-?\d+);", body)}
        elif word == "module":
            scope.append(name)
        elif scope[0] not in ("rmw_dds_common_gid24", "moveit_msgs_humble"):
            members = re.findall(r"\s*([\w:<>, ]+?) (\w+)(\[\d+\])?;", body)
            structs["::".join(scope + [name])] = [(kind + array, member)
                                                  for kind, member, array in members]
    return structs, constants


def as_idl(field_type):
    if field_type.pkg_name:
        text = f"{field_type.pkg_name}::msg::dds_::{field_type.type}_"
    else:
        text = IDL_TYPES[field_type.type]
        if field_type.string_upper_bound:
            text += f"<{field_type.string_upper_bound}>"
    if not field_type.is_array:
        return text
    if field_type.is_fixed_size_array():
        return f"{text}[{field_type.array_size}]"
    return f"sequence<{text}, {field_type.array_size}>" if field_type.is_upper_bound \
        else f"sequence<{text}>"


def message_files():
    """Yields (full name, rosidl's specification) of every message and service part."""
    for path in sorted(IDL_FOLDER.rglob("*.msg")):
        package = path.parent.parent.name
        yield f"{package}::msg::dds_::{path.stem}_", parse_message_file(package, str(path))
    for path in sorted(IDL_FOLDER.rglob("*.srv")):
        package = path.parent.parent.name
        service = parse_service_file(package, str(path))
        yield f"{package}::srv::dds_::{path.stem}_Request_", service.request
        yield f"{package}::srv::dds_::{path.stem}_Response_", service.response


class InterfaceFiles(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.structs, self.constants = idl_types()
        self.files = dict(message_files())

    def test_both_sides_have_the_same_types(self):
        self.assertEqual(sorted(self.files), sorted(self.structs))
        self.assertGreaterEqual(len(self.structs), 60)  # as many as the IDL has today

    def test_members_have_the_same_names_order_and_types(self):
        for name, message in self.files.items():
            with self.subTest(name):
                self.assertEqual([(as_idl(field.type), field.name) for field in message.fields],
                                 self.structs[name])

    def test_constants_have_the_same_names_and_values(self):
        for name, message in self.files.items():
            with self.subTest(name):
                found = {constant.name: constant.value for constant in message.constants}
                self.assertEqual(found, self.constants.get(name, {}))
        self.assertEqual(len(self.constants), 8)

    def test_every_field_of_graspd_is_explained(self):
        for name, message in self.files.items():
            for field in message.fields if name.startswith("graspd_msgs") else ():
                with self.subTest(f"{name} {field.name}"):
                    self.assertTrue(field.annotations.get("comment")
                                    or field.annotations.get("unit"))


if __name__ == "__main__":
    unittest.main()
