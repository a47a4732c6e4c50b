"""Makes everything that follows from idl/graspd.idl: the ROS 2 interface files, type hashes, tables.

    python3 scripts/interfaces write            idl/graspd_msgs, idl/ros2_interfaces: .msg and .srv
    python3 scripts/interfaces hashes           prints the ROS 2 type hashes of the topics
    python3 scripts/interfaces hashes --write   src/dds/type_hashes.hpp
    python3 scripts/interfaces docs             the section "Fields" of docs/interface.md
    python3 scripts/interfaces check            exit 1 where a file differs from what the above make

`--root FOLDER` takes another checkout than this one.
"""

import argparse
import difflib
import sys
from pathlib import Path

import field_tables
import idl
import ros
import type_hash

INTERFACE_FOLDERS = ("idl/graspd_msgs", "idl/ros2_interfaces")
HASHES = "src/dds/type_hashes.hpp"
DOCUMENT = "docs/interface.md"


def read_messages(root):
    return ros.to_messages(idl.parse((root / "idl/graspd.idl").read_text()))


def interface_files(root):
    """{path: text} of the .msg and .srv files."""
    return {f"idl/{path}": text for path, text in ros.file_texts(read_messages(root)).items()}


def hash_files(root):
    return {HASHES: type_hash.header_text(read_messages(root))}


def document_files(root):
    document = (root / DOCUMENT).read_text()
    return {DOCUMENT: field_tables.updated(document, read_messages(root))}


def stray_files(root, wanted):
    """Interface files on disk that the IDL has no type for."""
    found = [path.relative_to(root).as_posix() for folder in INTERFACE_FOLDERS
             for pattern in ("*.msg", "*.srv") for path in (root / folder).rglob(pattern)]
    return sorted(set(found) - set(wanted))


def write_files(root, texts):
    for path, text in texts.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        if not (root / path).exists() or (root / path).read_text() != text:
            (root / path).write_text(text)
            print(f"wrote {path}")


def differences(root):
    """One text for each file that is missing, differs or is one too many."""
    wanted = interface_files(root)
    found = [f"{path}: not made from the IDL" for path in stray_files(root, wanted)]
    for path, text in {**wanted, **hash_files(root), **document_files(root)}.items():
        if not (root / path).exists():
            found.append(f"{path}: missing")
            continue
        lines = difflib.unified_diff((root / path).read_text().splitlines(), text.splitlines(),
                                     "on disk", "from the IDL", lineterm="", n=0)
        changes = [line for line in lines if not line.startswith(("---", "+++", "@@"))]
        if changes:
            found.append("\n    ".join([f"{path}: {len(changes)} lines differ"] + changes[:6]))
    return found


def check(root):
    found = differences(root)
    for text in found:
        print(text, file=sys.stderr)
    return 1 if found else 0


def write(root):
    texts = interface_files(root)
    for path in stray_files(root, texts):
        (root / path).unlink()
        print(f"removed {path}")
    write_files(root, texts)


def hashes(root, to_file):
    if to_file:
        write_files(root, hash_files(root))
    else:
        for name, digest in type_hash.topic_hashes(read_messages(root)):
            print(digest, name)


def main():
    parser = argparse.ArgumentParser(prog="scripts/interfaces", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("write", "check", "hashes", "docs"))
    parser.add_argument("--write", action="store_true", help="hashes: into the header")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2])
    arguments = parser.parse_args()
    try:
        if arguments.command == "check":
            return check(arguments.root)
        if arguments.command == "write":
            write(arguments.root)
        elif arguments.command == "hashes":
            hashes(arguments.root, arguments.write)
        else:
            write_files(arguments.root, document_files(arguments.root))
    except idl.IdlError as error:
        print(f"idl/graspd.idl: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
