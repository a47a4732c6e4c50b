#!/usr/bin/env python3
"""Guards the concavity's speed by counting instructions, which no other load disturbs.

    count_instructions.py PROGRAM TABLE [--update]

PROGRAM is bench/concavity_once; TABLE holds lines "MESH INSTRUCTIONS". Fails when a mesh takes more
than a quarter above its line, or when the instructions grow faster than faces^1.1 from the first to
the last mesh of a shape. --update writes what was counted into TABLE.
"""
import math
import re
import subprocess
import sys
import tempfile

MARGIN = 1.25
STEEPEST = 1.1


def count(program, mesh):
    """(instructions, faces) of one conditioning and concavity, on one thread."""
    with tempfile.NamedTemporaryFile() as out:
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", "--toggle-collect=*concavity_of_soup*",
             f"--callgrind-out-file={out.name}", program, mesh, "1"],
            capture_output=True, text=True, timeout=240)
    counted = re.search(r"Collected : (\d+)", done.stderr)
    faces = re.search(r": (\d+) faces", done.stdout)
    if done.returncode != 0 or not counted or not faces:
        sys.exit(f"{mesh}: no count\n{done.stdout}{done.stderr}")
    return int(counted.group(1)), int(faces.group(1))


def main():
    program, table = sys.argv[1:3]
    with open(table, encoding="utf-8") as lines:
        known = [line.split() for line in lines if line.strip()]
    bad = []
    shapes = {}
    counted = []
    for mesh, limit in known:
        instructions, faces = count(program, mesh)
        counted.append((mesh, instructions))
        shapes.setdefault(mesh.split("/")[0], []).append((faces, instructions))
        ratio = instructions / int(limit)
        print(f"{mesh}: {instructions} instructions, {ratio:.3f} of the table's")
        if ratio > MARGIN:
            bad.append(f"{mesh} takes {ratio:.2f} times the instructions of the table")
    for shape, sizes in shapes.items():
        (few, least), (many, most) = sizes[0], sizes[-1]
        slope = math.log(most / least) / math.log(many / few)
        print(f"{shape}: instructions grow as faces^{slope:.3f}")
        if slope > STEEPEST:
            bad.append(f"{shape} grows as faces^{slope:.2f}")
    if "--update" in sys.argv[3:]:
        with open(table, "w", encoding="utf-8") as out:
            out.writelines(f"{mesh} {instructions}\n" for mesh, instructions in counted)
    if bad:
        sys.exit("\n".join(bad))


if __name__ == "__main__":
    main()
