#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets: what is well-formed, from which libFuzzer starts.

    make_seeds.py            into tests/fuzz/corpus/TARGET, each named seed_... (what its target accepts)
                             or refused_...

CDR samples are those of tests/golden/cdr, settings and grippers those of profiles/. Files that bear
another name are libFuzzer's: inputs that once broke a promise, or that reach further.
"""

import random
import re
import struct
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
CORPUS = ROOT / "tests" / "fuzz" / "corpus"


# Well-formed, but with values that the planner refuses: what has every field of the wire, say.
REFUSED = {
    "request_full", "call_fastrtps_full", "call_cyclone_full", "moveit_fastrtps", "moveit_cyclone",
    "reply", "server", "arguments", "shape_3", "shape_6",
}


def write(target, name, data):
    path = CORPUS / target / f"{'refused' if name in REFUSED else 'seed'}_{name}"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())


# ---- guard: one letter, then the payload ---------------------------------------------------------


def golden(name):
    text = (ROOT / "tests/golden/cdr" / f"{name}.hex").read_text()
    return bytes.fromhex("".join(text.split()))


class Cdr:
    """Plain CDR, little endian."""

    def __init__(self):
        self.body = b""

    def number(self, code, value):
        size = struct.calcsize(code)
        self.body += b"\0" * (-len(self.body) % size) + struct.pack("<" + code, value)
        return self

    def text(self, value):
        self.number("I", len(value) + 1)
        self.body += value.encode() + b"\0"
        return self

    def payload(self):
        return b"\0\1\0\0" + self.body + b"\0" * (-len(self.body) % 4)


def small_request():
    """A tetrahedron for a gripper by name, no options: the shortest request that is planned."""
    cdr = Cdr().number("i", 0).number("I", 0).text("map").text("").text("r1").text("")
    cdr.number("I", 4)
    for triangle in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)):
        for corner in triangle:
            cdr.number("I", corner)
    cdr.number("I", 4)
    for point in ((0, 0, 0), (0.05, 0, 0), (0, 0.05, 0), (0, 0, 0.05)):
        for value in point:
            cdr.number("d", value)
    empty_cloud(cdr)
    cdr.number("I", 0).number("I", 0).text("parallel_85")
    for _ in range(3):  # grippers, support_plane, obstacles
        cdr.number("I", 0)
    empty_cloud(cdr)
    for _ in range(3):  # approach_cones, keep_out_boxes, options
        cdr.number("I", 0)
    return cdr.payload()


def cloud_request():
    """Twelve points of floats, inline nothing: the shortest request with a cloud."""
    points = [(x, y, z) for x in (0, 0.03) for y in (0, 0.02, 0.05) for z in (0, 0.04)]
    cdr = Cdr().number("i", 0).number("I", 0).text("map").text("c").text("r2").text("")
    cdr.number("I", 0).number("I", 0)
    cdr.number("i", 0).number("I", 0).text("map").number("I", 1).number("I", len(points))
    cdr.number("I", 3)
    for offset, name in ((0, "x"), (4, "y"), (8, "z")):
        cdr.text(name).number("I", offset).number("B", 7).number("I", 1)
    cdr.number("B", 0).number("I", 12).number("I", 12 * len(points)).number("I", 12 * len(points))
    cdr.body += b"".join(struct.pack("<fff", *point) for point in points)
    cdr.number("B", 1)
    cdr.number("I", 0).number("I", 0).text("parallel_85")
    for _ in range(3):
        cdr.number("I", 0)
    empty_cloud(cdr)
    for _ in range(3):
        cdr.number("I", 0)
    return cdr.payload()


def empty_cloud(cdr):
    cdr.number("i", 0).number("I", 0).text("").number("I", 0).number("I", 0).number("I", 0)
    cdr.number("B", 0).number("I", 0).number("I", 0).number("I", 0).number("B", 0)


def graph(gid_bytes):
    cdr = Cdr()
    cdr.body += bytes(range(gid_bytes))
    cdr.number("I", 1).text("/").text("node")
    for _ in range(2):
        cdr.number("I", 1)
        cdr.body += bytes(range(gid_bytes))
    return cdr.payload()


def guard():
    header = struct.pack("<Qq", 0x1234, 5)
    requests = {"full": golden("GraspRequest"), "mesh": small_request(), "cloud": cloud_request()}
    for name, payload in requests.items():
        write("guard", f"request_{name}", b"q" + payload)
        write("guard", f"call_fastrtps_{name}", b"f" + payload)
        write("guard", f"call_cyclone_{name}", b"c" + payload[:4] + header + payload[4:])
    moveit = golden("MoveItRequest")
    write("guard", "moveit_fastrtps", b"m" + moveit)
    write("guard", "moveit_cyclone", b"n" + moveit[:4] + header + moveit[4:])
    write("guard", "cancel", b"x" + golden("CancelRequest"))
    write("guard", "status", b"s" + golden("PlannerStatus"))
    write("guard", "reply", b"r" + golden("RankedGrasps"))
    for gid_bytes in (16, 24):
        write("guard", f"graph_{gid_bytes}", b"g" + graph(gid_bytes))


# ---- object_file: format (stl, obj, off, ply, pcd), then the file ----------------------------------

POINTS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def stl_text():
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex %g %g %g\n" % POINTS[i] for i in triangle)
        + "endloop\nendfacet\n"
        for triangle in TRIANGLES
    )
    return f"solid cube\n{facets}endsolid cube\n"


def stl_binary():
    out = b"cube".ljust(80) + struct.pack("<I", len(TRIANGLES))
    for triangle in TRIANGLES:
        out += struct.pack("<3f", 0, 0, 0)
        out += b"".join(struct.pack("<3f", *POINTS[i]) for i in triangle) + b"\0\0"
    return out


def obj():
    vertices = "".join("v %g %g %g\n" % point for point in POINTS)
    faces = "".join("f " + " ".join(f"{i + 1}//{i + 1}" for i in quad) + "\n" for quad in QUADS)
    return f"# cube\no cube\n{vertices}vn 0 0 1\n{faces}f -1 -2 -3\n"


def off():
    vertices = "".join("%g %g %g\n" % point for point in POINTS)
    faces = "".join("4 %d %d %d %d\n" % quad for quad in QUADS)
    return f"OFF\n# cube\n8 6 12\n{vertices}{faces}"


def ply(form, real="float"):
    header = (
        f"ply\nformat {form} 1.0\ncomment cube\nelement vertex 8\nproperty {real} x\n"
        f"property {real} y\nproperty {real} z\nelement face 6\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    if form == "ascii":
        vertices = "".join("%g %g %g\n" % point for point in POINTS)
        return header + vertices + "".join("4 %d %d %d %d\n" % quad for quad in QUADS)
    order, code = ("<" if form == "binary_little_endian" else ">"), real[0]
    body = b"".join(struct.pack(f"{order}3{code}", *point) for point in POINTS)
    return header.encode() + body + b"".join(struct.pack(f"{order}B4i", 4, *q) for q in QUADS)


def pcd(data):
    points = [(x, y * 1.1, z * 1.3) for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)]
    header = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 3 1 0 0 0\nPOINTS {len(points)}\n"
        f"DATA {data}\n"
    )
    if data == "ascii":
        return header + "".join("%g %g %g\n" % point for point in points)
    if data == "binary":
        return header.encode() + b"".join(struct.pack("<3f", *point) for point in points)
    raw = b"".join(struct.pack("<f", point[axis]) for axis in range(3) for point in points)
    packed = b"".join(  # LZF literals: a length less one, then so many bytes
        bytes([len(raw[i : i + 32]) - 1]) + raw[i : i + 32] for i in range(0, len(raw), 32)
    )
    return header.encode() + struct.pack("<II", len(packed), len(raw)) + packed


def object_file():
    files = {
        "stl_text": (0, stl_text()),
        "stl_binary": (0, stl_binary()),
        "obj": (1, obj()),
        "off": (2, off()),
        "ply_text": (3, ply("ascii")),
        "ply_little": (3, ply("binary_little_endian", "double")),
        "ply_big": (3, ply("binary_big_endian")),
        "pcd_text": (4, pcd("ascii")),
        "pcd_binary": (4, pcd("binary")),
        "pcd_compressed": (4, pcd("binary_compressed")),
        "pcd_greedy": (0xB4, pcd("ascii")),
        "sheet_wrapped": (0xB2, "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"),
    }
    for name, (choice, data) in files.items():
        write("object_file", name, bytes([choice]) + (data.encode() if isinstance(data, str) else data))


# ---- yaml: one letter, then the text ---------------------------------------------------------------

URDF = """<robot name="hand">
<link name="base"><collision><geometry><box size="0.1 0.04 0.04"/></geometry></collision></link>
<link name="left"><collision><origin xyz="-0.0475 0 0.04"/><geometry><box size="0.01 0.02 0.04"/>
</geometry></collision></link>
<link name="right"><collision><origin xyz="0.0475 0 0.04"/><geometry><cylinder radius="0.005"
length="0.04"/></geometry></collision></link>
<joint name="left_joint" type="prismatic"><parent link="base"/><child link="left"/>
<axis xyz="1 0 0"/><limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
<joint name="right_joint" type="prismatic"><parent link="base"/><child link="right"/>
<axis xyz="-1 0 0"/><limit lower="0" upper="0.04" effort="1" velocity="1"/>
<mimic joint="left_joint" multiplier="1" offset="0"/></joint>
</robot>
"""

CONVEX_GRIPPER = """name: hulls
max_width: 0.08
finger_length: 0.04
finger_width: 0.02
finger_thickness: 0.01
tip_offset: 0.01
palm_width: 0.1
palm_height: 0.04
palm_depth: 0.06
pad_travel: [{opening: 0.0, pad_z: 0.1}, {opening: 0.08, pad_z: 0.09}]
convex_parts:
  - {member: palm, points: [[0, 0, 0], [0.05, 0, 0], [0, 0.02, 0], [0, 0, 0.06]]}
  - {member: finger_left, points: [[-0.05, 0, 0.06], [-0.04, 0, 0.06], [-0.05, 0.01, 0.06], [-0.04, 0, 0.1]]}
"""

ARGUMENTS = """--config
planner.yaml
--ros-args
-r
__node:=arm
-r
__ns:=/cell1
--remap
arm:~/status:=/fleet/status
-p
server.workers:=4
-p
arm:server.queue_capacity:=8
--log-level
cell1.arm:=warn
-e
/safe
--params-file
p.yaml
--disable-rosout-logs
--
--workers
2
"""

PARAMS = """/**:
  ros__parameters:
    server: {workers: 3, queue_capacity: 32}
/graspd:
  ros__parameters:
    ros.gid_bytes: "24"
    search: {levels: 2}
ns:
  "*":
    ros__parameters: {search.planes: 1}
"""


def without_comments(text):
    lines = (line.split(" #")[0].rstrip() for line in text.splitlines())
    return "".join(line + "\n" for line in lines if line and not line.startswith("#"))


def yaml():
    planner = without_comments((ROOT / "profiles/planner.yaml").read_text())
    groups = re.findall(r"^(?:search|vertex_concavity|server|ros):\n(?: .*\n)+", planner, re.MULTILINE)
    write("yaml", "settings", "d" + "".join(groups))
    write("yaml", "server", "sserver:\n  workers: 3\n  queue_capacity: 5\n")
    write("yaml", "server_flat", "sworkers: 3\nqueue_capacity: 5\nmax_payload_bytes: 4096\n")
    for name in ("parallel_85", "franka_hand", "robotiq_2f_85"):
        text = (ROOT / "profiles/grippers" / f"{name}.yaml").read_text()
        write("yaml", f"gripper_{name}", "g" + without_comments(text))
    write("yaml", "gripper_hulls", "g" + CONVEX_GRIPPER)
    write("yaml", "urdf", "u" + URDF)
    write("yaml", "arguments", "a" + ARGUMENTS)
    write("yaml", "params", "p" + PARAMS)


# ---- plan: bytes that plan_input.cpp draws values from ---------------------------------------------


def plan():
    """One of every shape, else at random: no damage, no wrap, no greedy surface, no early stop."""
    for kind in range(10):
        draw = random.Random(kind)
        rest = bytes(draw.randrange(256) for _ in range(146))
        write("plan", f"shape_{kind}", bytes([0, 0, 0, 150, 0, 1, 1, 1, 1, 1, 0, 0, 0, kind]) + rest)
    write("plan", "zeros", b"")


if __name__ == "__main__":
    guard()
    object_file()
    yaml()
    plan()
