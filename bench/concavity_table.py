#!/usr/bin/env python3
"""Prints the table of docs/concavity.md: median milliseconds, memory and instructions.

    concavity_table.py PROGRAM [MESH...]

PROGRAM is bench/concavity_once. A MESH is a file or SHAPE/FACES; without any, shapes of four sizes.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SIZES = (5000, 16000, 70000, 300000)
SHAPES = ("cup", "channel", "tunnel_3d", "twisted vase", "torus")
TIMES = "9"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return done.stdout + done.stderr


def instructions(program, mesh):
    with tempfile.NamedTemporaryFile() as out:
        text = run("valgrind", "--tool=callgrind", "--toggle-collect=*concavity_of_soup*",
                   f"--callgrind-out-file={out.name}", program, mesh, "1")
    return int(re.search(r"Collected : (\d+)", text).group(1))


def main():
    program, meshes = sys.argv[1], sys.argv[2:]
    meshes = meshes or [f"{shape}/{faces}" for shape in SHAPES for faces in SIZES]
    head = None
    for mesh in meshes:
        text = run(program, mesh, "2", TIMES)
        faces = re.search(r": (\d+) faces", text).group(1)
        memory = re.search(r"([\d.]+) MB", text).group(1)
        steps = re.findall(r"^  (\S+) +([\d.]+) ms$", text, re.M)
        if head is None:
            head = ["mesh", "faces"] + [step for step, _ in steps] + ["MB", "M instr."]
            print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
        row = [pathlib.Path(mesh).name if pathlib.Path(mesh).exists() else mesh.split("/")[0], faces]
        row += [f"{float(ms):.3g}" for _, ms in steps]
        row += [memory, f"{instructions(program, mesh) / 1e6:.0f}"]
        print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
