"""Makes C++ from graspd's .msg and .srv files with rosidl, for ros_layout_test.cpp.

    generate.py IDL_FOLDER OUTPUT_FOLDER

OUTPUT_FOLDER/include holds rosidl's C++ and three lists: structs.inc and type_supports.inc include all of
it, types.inc has BEGIN(package, folder, name) MEMBER(name)... END for each message as rosidl's parser
sees it. OUTPUT_FOLDER/generate.d names the files that were read (a depfile). Runs with the interpreter
that rosidl is installed for.
"""

import os
import sys
from pathlib import Path

from rosidl_adapter import convert_to_idl
from rosidl_generator_cpp.cli import GenerateCpp
from rosidl_parser.definition import IdlLocator, Message, Service
from rosidl_parser.parser import parse_idl_file
from rosidl_pycommon import convert_camel_case_to_lower_case_underscore as to_file_name
from rosidl_typesupport_introspection_cpp.cli import GenerateIntrospectionCppTypesupport


def package_folders(idl_folder):
    return sorted((idl_folder / "ros2_interfaces").glob("*/")) + [idl_folder / "graspd_msgs"]


def interface_files(package):
    return sorted(path.relative_to(package) for pattern in ("msg/*.msg", "srv/*.srv")
                  for path in package.glob(pattern))


def generate(package, output):
    """rosidl's C++ of one package; returns its .idl files."""
    include = output / "include"
    translated = output / "idl" / package.name
    idl_files = []
    for path in interface_files(package):
        convert_to_idl(package, package.name, path, translated)
        idl_files.append(path.with_suffix(".idl"))
    tuples = [f"{translated}:{path}" for path in idl_files]
    for generator in (GenerateCpp("cpp"), GenerateIntrospectionCppTypesupport("introspection_cpp")):
        generator.generate(package.name, tuples, [], include / package.name)
    return [(translated, path) for path in idl_files]


def messages_of(locator):
    for element in parse_idl_file(IdlLocator(*locator)).content.elements:
        if isinstance(element, Message):
            yield element.structure
        elif isinstance(element, Service):
            yield element.request_message.structure
            yield element.response_message.structure


def type_lines(structure):
    package, folder, name = structure.namespaced_type.namespaced_name()
    yield f"BEGIN({package}, {folder}, {name})"
    for member in structure.members:
        yield f"MEMBER({member.name})"
    yield "END"


def write_includes(path, stems, ending):
    path.write_text("".join(f'#include "{stem}{ending}"\n' for stem in stems))


def main():
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # rosidl prints the name of every file
    idl_folder, output = (Path(argument).resolve() for argument in sys.argv[1:])
    packages = package_folders(idl_folder)
    locators = [locator for package in packages for locator in generate(package, output)]
    stems = [f"{base.name}/{path.parent}/detail/{to_file_name(path.stem)}" for base, path in locators]
    types = [line for locator in locators for structure in messages_of(locator)
             for line in type_lines(structure)]
    include = output / "include"
    write_includes(include / "type_supports.inc", stems, "__type_support.cpp")
    write_includes(include / "structs.inc", stems, "__struct.hpp")
    (include / "types.inc").write_text("\n".join(types) + "\n")
    read = [str(package / path) for package in packages for path in interface_files(package)]
    (output / "generate.d").write_text(f"{include}/types.inc: " + " ".join(read) + "\n")


if __name__ == "__main__":
    main()
