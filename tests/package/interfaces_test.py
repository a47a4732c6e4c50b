"""Shows scripts/interfaces to be right: what it made is on disk, and its type hashes are ROS 2's."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts" / "interfaces"
sys.path.insert(0, str(SCRIPTS))
import field_tables  # noqa: E402
import idl  # noqa: E402
import ros  # noqa: E402
import type_hash  # noqa: E402

# As ROS 2 Jazzy and Kilted publish them: `ros2 topic info -v`, or rosidl's X__get_type_hash().
PUBLISHED_HASHES = {
    "builtin_interfaces/msg/Time": "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197",
    "builtin_interfaces/msg/Duration": "e8d009f659816f758b75334ee1a9ca5b5c0b859843261f14c7f937349599d93b",
    "std_msgs/msg/Header": "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01",
    "std_msgs/msg/ColorRGBA": "77a7a5b9ae477306097665106e0413ba74440245b1f3d0c6d6405fe5c7813fe8",
    "geometry_msgs/msg/Point": "6963084842a9b04494d6b2941d11444708d892da2f4b09843b9c43f42a7f6881",
    "geometry_msgs/msg/Vector3": "cc12fe83e4c02719f1ce8070bfd14aecd40f75a96696a67a2a1f37f7dbb0765d",
    "geometry_msgs/msg/Quaternion": "8a765f66778c8ff7c8ab94afcc590a2ed5325a1d9a076ffff38fbce36f458684",
    "geometry_msgs/msg/Pose": "d501954e9476cea2996984e812054b68026ae0bfae789d9a10b23daf35cc90fa",
    "geometry_msgs/msg/PoseStamped":
        "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8",
    "geometry_msgs/msg/Vector3Stamped":
        "d4829622288cbb443886e7ea94ea5671a3b1be6bab4ad04224432a65f7d7887a",
    "geometry_msgs/msg/Point32": "2fc4db7cae16a4582c79a56b66173a8d48d52c7dc520ddc55a0d4bcf2a4bfdbc",
    "geometry_msgs/msg/Polygon": "3782f9f0bf044964d692d6c017d705e37611afb1f0bf6a9dee248a7dda0f784a",
    "shape_msgs/msg/Plane": "dfbfe8314689c850615d4a727af017e9aa86c10e369a606c8c851ef8f16c58c8",
    "trajectory_msgs/msg/JointTrajectoryPoint":
        "de8907036d8bd45aac6f30cc9044a3d4a329c42cbf719aff7d95a584cfa532d7",
    "trajectory_msgs/msg/JointTrajectory":
        "179b33eba59d676f6d967ac71fe35e7ca2f64b2f3928f4a018cec115e213796e",
    "shape_msgs/msg/MeshTriangle": "618e5c073eeb729e433ef6226e72c01d995c459fb7d76348c9700409a5020bd0",
    "shape_msgs/msg/Mesh": "f2150b82d8ee7e8bc3f396a2b158aefb4b9a5510a474be271ba1268aebb55289",
    "sensor_msgs/msg/PointField": "5c6a4750728c2bcfbbf7037225b20b02d4429634732146b742dee1726637ef01",
    "sensor_msgs/msg/PointCloud2": "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    "sensor_msgs/msg/CompressedImage":
        "15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a",
    "visualization_msgs/msg/UVCoordinate":
        "f27f7ed21fe360c6066944f856b801a0c0d1e94e815b6886444b42d90b196a26",
    "visualization_msgs/msg/MeshFile":
        "7710ece15a148fb7c9b546364cfb215bb06098087bd6394fe5b73a493508f8c4",
    "visualization_msgs/msg/Marker":
        "45b13ccf791f225962bf74e746f9644518855d783a6f42ba0cc14fde2b4f3ce0",
    "visualization_msgs/msg/MarkerArray":
        "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
    "diagnostic_msgs/msg/KeyValue": "d68081eaa540288c5440753baecef0c4e16e81a5f78ad68902ded5100413bb42",
    "diagnostic_msgs/msg/DiagnosticStatus":
        "b0e3e692ea2d54a8af2f4ef1930e81556a2db55216b771f8a7d2724ed47bf0e4",
    "diagnostic_msgs/msg/DiagnosticArray":
        "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
    "rmw_dds_common/msg/Gid": "ab6f21cfbb0a6dbb837161e1110c2051a2850ed9f9c53944d7115d9bcebedf71",
    "rmw_dds_common/msg/NodeEntitiesInfo":
        "8ffef65ee2d088c63b1e8fcd31e800ba9fc8dbe0ee15ca60d1676de5218087a7",
    "rmw_dds_common/msg/ParticipantEntitiesInfo":
        "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
}
# Types of ROS 2 whose hashes were found nowhere, or follow from such types.
UNPUBLISHED = ["moveit_msgs/msg/CollisionObject", "moveit_msgs/msg/Grasp",
               "moveit_msgs/msg/GripperTranslation", "moveit_msgs/msg/MoveItErrorCodes",
               "moveit_msgs/srv/GraspPlanning", "moveit_msgs/srv/GraspPlanning_Event",
               "moveit_msgs/srv/GraspPlanning_Request", "moveit_msgs/srv/GraspPlanning_Response",
               "object_recognition_msgs/msg/ObjectType", "shape_msgs/msg/SolidPrimitive"]
# std_srvs/SetBool and Trigger, with requests that have one member and none.
PUBLISHED_SERVICE_HASHES = {
    "service_msgs/msg/ServiceEventInfo":
        "41bcbbe07a75c9b52bc96bfd5c24d7f0fc0a08c0cb7921b3373c5732345a6f45",
    "std_srvs/srv/SetBool": "abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a",
    "std_srvs/srv/SetBool_Request": "c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e",
    "std_srvs/srv/SetBool_Response": "d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059",
    "std_srvs/srv/SetBool_Event": "3c4c20015afb4303eafd347b1d6a786f171a89c814726961a9593ef10df878cf",
    "std_srvs/srv/Trigger": "eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f",
    "std_srvs/srv/Trigger_Request": "d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199",
    "std_srvs/srv/Trigger_Event": "ec4a1d26b0575e61906890342aba9523a2360e9845857c5590fa6e23bc39e1c2",
}
STD_SRVS = """
module builtin_interfaces { module msg { module dds_ {
@final struct Time_ { long sec; unsigned long nanosec; };
}; }; };
module std_srvs { module srv { module dds_ {
@final struct SetBool_Request_ { boolean data; };
@final struct SetBool_Response_ { boolean success; string message; };
@final struct Trigger_Request_ { };
@final struct Trigger_Response_ { boolean success; string message; };
}; }; };
"""


def run(*arguments):
    return subprocess.run([sys.executable, "-B", str(SCRIPTS), *arguments], capture_output=True,
                          text=True, check=False)


def hashes_of(text):
    descriptions = type_hash.describe_all(ros.to_messages(idl.parse(text)))
    return {name: type_hash.type_hash(name, descriptions).removeprefix("RIHS01_")
            for name in descriptions}


class OnDisk(unittest.TestCase):
    def test_the_files_of_this_checkout(self):
        result = run("check")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def in_a_copy(self, path, change, *commands):
        """What `check` says after a file of a copy was changed and these commands were run."""
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            shutil.copytree(ROOT / "idl", root / "idl")
            for name in ("docs/interface.md", "src/dds/type_hashes.hpp"):
                (root / name).parent.mkdir(parents=True)
                shutil.copy(ROOT / name, root / name)
            change(root / path)
            for command in commands:
                self.assertEqual(run(*command, "--root", folder).returncode, 0)
            result = run("check", "--root", folder)
            return result.returncode, result.stderr

    def test_each_kind_of_file_that_differs(self):
        for path in ("idl/graspd_msgs/msg/Grasp.msg", "idl/graspd_msgs/srv/PlanGrasps.srv",
                     "idl/ros2_interfaces/std_msgs/msg/Header.msg", "src/dds/type_hashes.hpp"):
            code, text = self.in_a_copy(path, lambda file: file.write_text(file.read_text() + "x\n"))
            self.assertEqual(code, 1)
            self.assertIn(f"{path}: 1 lines differ\n    -x", text)
            code, text = self.in_a_copy(path, lambda file: file.unlink())
            self.assertEqual((code, text), (1, f"{path}: missing\n"))

    def test_a_table_that_differs(self):
        code, text = self.in_a_copy("docs/interface.md", lambda file: file.write_text(
            file.read_text().replace("| `open_width` | `float64` |", "| `open_width` | `float32` |")))
        self.assertEqual(code, 1)
        self.assertIn("docs/interface.md: 2 lines differ", text)

    def test_a_file_too_many(self):
        code, text = self.in_a_copy("idl/graspd_msgs/msg/Old.msg", lambda file: file.write_text(""))
        self.assertEqual((code, text),
                         (1, "idl/graspd_msgs/msg/Old.msg: not made from the IDL\n"))
        self.assertEqual(self.in_a_copy("idl/graspd_msgs/msg/Old.msg",
                                        lambda file: file.write_text(""), ["write"]), (0, ""))

    def test_a_changed_member_shows_everywhere_until_all_is_made_anew(self):
        def rename(file):
            file.write_text(file.read_text().replace("double open_width;", "double opened_width;"))

        code, text = self.in_a_copy("idl/graspd.idl", rename)
        self.assertEqual(code, 1)
        for path in ("idl/graspd_msgs/msg/Grasp.msg", "src/dds/type_hashes.hpp", "docs/interface.md"):
            self.assertIn(path, text)
        self.assertEqual(self.in_a_copy("idl/graspd.idl", rename, ["write"], ["hashes", "--write"],
                                        ["docs"]), (0, ""))


class BuildFiles(unittest.TestCase):
    def test_the_ros_package_lists_every_interface(self):
        package = ROOT / "idl/graspd_msgs"
        text = (package / "CMakeLists.txt").read_text()
        listed = [line.strip(' "') for line in text.splitlines() if line.startswith('  "')]
        found = [path.relative_to(package).as_posix() for pattern in ("*.msg", "*.srv")
                 for path in package.rglob(pattern)]
        self.assertEqual(listed, sorted(found))

    def test_the_ros_package_depends_on_what_it_uses(self):
        package = ROOT / "idl/graspd_msgs"
        messages = ros.to_messages(idl.parse((ROOT / "idl/graspd.idl").read_text()))
        used = {field.type.split("/")[0] for message in messages if message.package == ros.PACKAGE
                for field in message.fields if "/" in field.type} - {ros.PACKAGE}
        for name in sorted(used):
            self.assertIn(f"<depend>{name}</depend>", (package / "package.xml").read_text())
            self.assertIn(f"find_package({name} REQUIRED)", (package / "CMakeLists.txt").read_text())


class Hashes(unittest.TestCase):
    def test_ros_types_have_the_published_hashes(self):
        found = hashes_of((ROOT / "idl/graspd.idl").read_text())
        self.assertEqual({name: found[name] for name in PUBLISHED_HASHES}, PUBLISHED_HASHES)
        ours = [name for name in found if not name.startswith(("graspd_msgs/", "service_msgs/"))]
        self.assertEqual(sorted(ours), sorted([*PUBLISHED_HASHES, *UNPUBLISHED]))

    def test_services_have_the_published_hashes(self):
        found = hashes_of(STD_SRVS)
        self.assertEqual({name: found[name] for name in PUBLISHED_SERVICE_HASHES},
                         PUBLISHED_SERVICE_HASHES)

    def test_bounds_and_arrays_count(self):
        pattern = "module a {{ module msg {{ module dds_ {{ @final struct B_ {{ {} b; }}; }}; }}; }};"
        members = ("octet", "sequence<octet>", "sequence<octet, 2>", "sequence<octet, 3>", "string",
                   "string<2>", "string<3>", "sequence<string<3>, 3>")
        self.assertEqual(len({hashes_of(pattern.format(member))["a/msg/B"] for member in members}),
                         len(members))


class Errors(unittest.TestCase):
    def assert_error(self, text, expected):
        with self.assertRaises(idl.IdlError) as caught:
            idl.parse(text)
        self.assertEqual(str(caught.exception), expected)

    def in_struct(self, members):
        return ("module a {\nmodule msg {\nmodule dds_ {\n@final struct B_ {\n" + members +
                "\n};\n};\n};\n};\n")

    def test_negative_constants(self):
        parsed = idl.parse("module a { @final struct B_ { }; module B__Constants {\n"
                           "const long C_ = -7; const long D_ = 7; }; };")
        self.assertEqual([c.value for c in parsed.constants["a::B_"]], [-7, 7])

    def test_unknown_words(self):
        self.assert_error("module a {\n  union b;\n};\n",
                          "line 2: expected 'module' or '@final struct', found 'union'")
        self.assert_error("module a {\n  struct b {};\n};\n",
                          "line 2: expected 'module' or '@final struct', found 'struct'")
        self.assert_error(self.in_struct("long a;\nshort b;"), "line 6: unknown type 'short'")
        self.assert_error(self.in_struct("unsigned octet b;"), "line 5: unknown type 'unsigned'")
        self.assert_error(self.in_struct("x::msg::dds_::C_ c;"),
                          "line 5: unknown type 'x::msg::dds_::C_'")
        self.assert_error(self.in_struct("@key long a;"), "line 5: expected a type, found '@key'")
        self.assert_error("module a {\n  /* b */\n};\n", "line 2: unknown character '/'")

    def test_what_is_missing(self):
        self.assert_error(self.in_struct("long a\nlong b;"), "line 6: expected ';', found 'long'")
        self.assert_error(self.in_struct("long a[];"), "line 5: expected a number, found ']'")
        self.assert_error(self.in_struct("long a[2][2];"), "line 5: expected ';', found '['")
        self.assert_error(self.in_struct("sequence<long a;"), "line 5: expected '>', found 'a'")
        self.assert_error("module a {\n", "line 2: expected 'module' or '@final struct', "
                                          "found 'end of file'")
        self.assert_error("module a { module B__Constants { const octet C_ = 1; }; };",
                          "constants of a::B_, which is not a struct")

    def test_the_program_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "idl").mkdir()
            (Path(folder) / "idl/graspd.idl").write_text("module a {\n  enum b;\n};\n")
            result = run("write", "--root", folder)
            self.assertEqual(result.returncode, 1)
            self.assertEqual(result.stderr, "idl/graspd.idl: line 2: expected 'module' or "
                                            "'@final struct', found 'enum'\n")


class Texts(unittest.TestCase):
    def messages(self, members):
        return ros.to_messages(idl.parse(
            "module graspd_msgs { module msg { module dds_ {\n/// A thing.\n"
            "@final struct A_ { long x; };\n@final struct B_ {\n" + members + "};\n}; }; };\n"))

    def test_comments_before_and_behind_a_member(self):
        text = ros.file_texts(self.messages("/// one,\n/// two\nlong a;\ndouble b;  ///< three,\n"
                                            "///< four\n// nothing\nsequence<string, 3> c;\n"))
        self.assertEqual(text["graspd_msgs/msg/B.msg"], ros.NOTICE + "\n"
                         "int32 a        # one, two\nfloat64 b      # three, four\nstring[<=3] c\n")
        self.assertEqual(text["graspd_msgs/msg/A.msg"], ros.NOTICE + "\n# A thing.\n\nint32 x\n")

    def test_frames_are_explained(self):
        text = ros.file_texts(self.messages("long a;  ///< along Hz\n"))["graspd_msgs/msg/B.msg"]
        self.assertIn("# H is the gripper's mounting frame", text)
        self.assertNotIn("# F is", text)

    def test_a_table_escapes_what_markdown_reads(self):
        section = field_tables.section(self.messages("long a;  ///< |a| < 2\n"))
        self.assertIn("| `a` | `int32` | \\|a\\| \\< 2 |", section)


if __name__ == "__main__":
    unittest.main()
