#!/usr/bin/env python3
"""Checks the dependency rule between the folders of graspd, and the size of files and functions.

    check_layers.py [ROOT]     ROOT: a checkout; default the one this file lies in

A folder under include/graspd/ and the folder of that name under src/ are one layer. ALLOWED says what
a layer may include besides itself. A layer of PRIVATE has nothing under include/: others include its
headers as "layer/header.hpp". Under include/ only std, Eigen and graspd headers may appear: a
third-party header there would reach everybody who includes ours. Prints one line a finding,
`file:line: what`, and exits with 1 if there is any.
"""

import re
import sys
from pathlib import Path

STAGES = ["mesh", "concavity", "regions", "contour", "grasp", "collision"]
ALLOWED = {
    "base": set(),
    **{stage: {"base"} for stage in STAGES},
    "config": {"base", "mesh"},  # mesh: a URDF's collision meshes
    "planner": {"base", *STAGES},
    "dds": {"base", "planner"},
    "simulate": {"base", "collision", "planner"},
    "command_line": set(),
    "cli": {"base", *STAGES, "planner", "config", "dds", "simulate", "command_line"},
    "server": {"base", *STAGES, "planner", "config", "dds", "command_line"},
    "examples": {"base", *STAGES, "planner", "config", "dds"},
}
PRIVATE = {"command_line"}
# What fastddsgen makes of idl/graspd.idl.
GENERATED = re.compile(r"graspd(PubSubTypes)?\.h$")
MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
# Text before a "{" that opens something else than a function, although it may hold a ")".
NOT_A_FUNCTION = re.compile(
    r"^\s*(namespace|class|struct|union|enum|extern|if|else|for|while|switch|do|try|catch|return)\b"
)

# A constructor's member initialiser: `Queue(int size) : size_{size} {`, the first brace.
MEMBER_INITIALISER = re.compile(r"\)[^;{}]*:[^:].*\w$", re.DOTALL)


def is_standard(header):
    """std headers have neither slash nor dot."""
    return "/" not in header and "." not in header


def layer_of(path):
    """The layer a source file belongs to; None for tests and other files, which may use anything."""
    parts = path.parts
    if parts[:2] == ("include", "graspd") and len(parts) > 3:
        return parts[2]
    if parts[0] == "src" and len(parts) > 2:
        return parts[1]
    if parts[0] == "src":
        return "main"
    return "examples" if parts[0] == "examples" else None


def lies_beside(file, header):
    """Whether a header lies in a file's own folder; X.hpp.in becomes X.hpp in the build."""
    return (file.parent / header).exists() or (file.parent / f"{header}.in").exists()


def check_includes(root, path, lines):
    layer = layer_of(path)
    public = path.parts[0] == "include"
    if layer is not None and layer != "main" and layer not in ALLOWED:
        yield 1, f"'{layer}' is not a layer that scripts/check_layers.py knows"
        return
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quoted, header = match.group(1) == '"', match.group(2)
        if header.startswith("graspd/"):
            target = header.split("/")[1]
            if layer == "main" or target == layer or target in ALLOWED.get(layer, set()):
                continue
            yield number, f"{layer} must not include {header}"
        elif public and not (is_standard(header) or header.startswith("Eigen/")):
            yield number, f"a header under include/ includes {header}; only std, Eigen and graspd"
        elif ".." in header.split("/"):
            yield number, f"{header} climbs out of its folder"
        elif GENERATED.search(header) and layer not in ("dds", "examples"):
            yield number, f"{layer} must not include the generated {header}"
        elif quoted and header.split("/")[0] in PRIVATE:
            if layer is not None and header.split("/")[0] not in ALLOWED.get(layer, set()):
                yield number, f"{layer} must not include {header}"
        elif quoted and not GENERATED.search(header) and not lies_beside(root / path, header):
            yield number, f"{header} does not lie in {path.parent}"


def strip_text(lines):
    """The lines without comments, strings and character literals, so that braces can be counted."""
    inside_comment = False
    raw_end = None
    for line in lines:
        out = []
        i = 0
        while i < len(line):
            if raw_end is not None:
                end = line.find(raw_end, i)
                i = len(line) if end < 0 else end + len(raw_end)
                raw_end = None if end >= 0 else raw_end
            elif inside_comment:
                end = line.find("*/", i)
                i = len(line) if end < 0 else end + 2
                inside_comment = end < 0
            elif line.startswith("//", i):
                break
            elif line.startswith("/*", i):
                inside_comment = True
                i += 2
            elif raw := re.match(r'R"([^()\\ ]*)\(', line[i:]):
                raw_end = f'){raw.group(1)}"'
                i += raw.end()
            elif line[i] == '"' or (line[i] == "'" and not (i and line[i - 1].isalnum())):
                end = i + 1
                while end < len(line) and line[end] != line[i]:
                    end += 2 if line[end] == "\\" else 1
                i = end + 1
            else:
                out.append(line[i])
                i += 1
        yield "".join(out)


def function_lengths(lines):
    """(first line, length) of each function body: an opening brace after a parameter list."""
    open_braces = []  # (line number, is a function) of each brace not yet closed
    head = ""  # text since the last ; { or }
    head_line = 1
    for number, line in enumerate(strip_text(lines), 1):
        if line.lstrip().startswith("#"):
            continue
        for character in line:
            if character == "{" and MEMBER_INITIALISER.search(head):
                open_braces.append((number, False))
                head += character
            elif character == "{":
                in_function = any(is_function for _, is_function in open_braces)
                is_function = (
                    not in_function and ")" in head and not NOT_A_FUNCTION.match(head.strip())
                )
                open_braces.append((head_line if is_function else number, is_function))
                head = ""
            elif character == "}":
                first, is_function = open_braces.pop() if open_braces else (number, False)
                if is_function:
                    yield first, number - first + 1
                # after a member initialiser the constructor's head goes on
                head = head[: head.rindex("{")] if "{" in head else ""
            elif character == ";":
                head = ""
            else:
                if not head.strip() and not character.isspace():
                    head_line = number
                head += character
        head += " "


def check_sizes(lines):
    if len(lines) > MAX_FILE_LINES:
        yield MAX_FILE_LINES + 1, f"{len(lines)} lines; a file may have {MAX_FILE_LINES}"
    for first, length in function_lengths(lines):
        if length > MAX_FUNCTION_LINES:
            yield first, f"a function of {length} lines; {MAX_FUNCTION_LINES} are allowed"


def check_tree(root):
    findings = []
    for folder in ("include", "src", "examples"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".hpp", ".cpp", ".h"):
                continue
            relative = path.relative_to(root)
            lines = path.read_text(encoding="utf-8").splitlines()
            for check in (check_includes(root, relative, lines), check_sizes(lines)):
                findings += [f"{relative}:{number}: {what}" for number, what in check]
    return findings


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    if not (root / "src").is_dir():
        print(f"check_layers: {root} holds no src/", file=sys.stderr)
        return 2
    findings = check_tree(root)
    print("\n".join(findings) if findings else "layers: in order")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
