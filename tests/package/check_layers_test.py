"""Shows scripts/check_layers.py trees with one fault each: it must name that fault and nothing else."""

import importlib.util
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "check_layers.py"
spec = importlib.util.spec_from_file_location("check_layers", SCRIPT)
check_layers = importlib.util.module_from_spec(spec)
spec.loader.exec_module(check_layers)


def findings_of(files):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "src").mkdir()
        for name, text in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return check_layers.check_tree(root)


class Layers(unittest.TestCase):
    def assert_only(self, files, *expected):
        findings = findings_of(files)
        self.assertEqual(len(findings), len(expected), findings)
        for finding, part in zip(findings, expected):
            self.assertIn(part, finding)

    def test_a_tree_that_keeps_the_rule(self):
        self.assert_only({
            "include/graspd/base/point.hpp": "#include <vector>\n#include <Eigen/Core>\n",
            "include/graspd/mesh/weld.hpp": '#include "graspd/base/point.hpp"\n',
            "src/mesh/weld.cpp": '#include "graspd/mesh/weld.hpp"\n#include <CGAL/Bbox_3.h>\n'
                                 '#include "own.hpp"\n',
            "src/mesh/own.hpp": "",
            "src/planner/planner.cpp": '#include "graspd/mesh/weld.hpp"\n',
            "src/dds/port.cpp": '#include "graspd/planner/planner.hpp"\n#include "graspd.h"\n',
            "src/server/main.cpp": '#include "graspd/dds/port.hpp"\n',
        })

    def test_a_stage_that_uses_another_stage(self):
        self.assert_only({"src/contour/hull.cpp": '\n#include "graspd/mesh/weld.hpp"\n'},
                         "src/contour/hull.cpp:2: contour must not include graspd/mesh/weld.hpp")

    def test_arrows_that_point_upwards(self):
        for layer, header in (("base", "mesh"), ("mesh", "planner"), ("planner", "dds"),
                              ("dds", "server"), ("config", "planner"), ("planner", "config"),
                              ("server", "cli"), ("cli", "server")):
            self.assert_only({f"include/graspd/{layer}/a.hpp": f'#include "graspd/{header}/b.hpp"\n'},
                             f"{layer} must not include graspd/{header}/b.hpp")

    def test_third_party_headers_under_include(self):
        for header in ("<CGAL/Surface_mesh.h>", "<pcl/point_types.h>", "<fcl/fcl.h>",
                       "<fastdds/dds/domain/DomainParticipant.hpp>", "<yaml-cpp/yaml.h>",
                       "<math.h>", '"own.hpp"'):
            self.assert_only({"include/graspd/mesh/a.hpp": f"#  include {header}\n",
                              "include/graspd/mesh/own.hpp": ""},
                             "a header under include/ includes")

    def test_private_headers_of_other_folders(self):
        self.assert_only({"src/mesh/own.hpp": "", "src/grasp/a.cpp": '#include "own.hpp"\n'},
                         "own.hpp does not lie in src/grasp")
        self.assert_only({"src/mesh/own.hpp": "", "src/grasp/a.cpp": '#include "../mesh/own.hpp"\n'},
                         "climbs out")

    def test_a_layer_without_public_headers(self):
        files = {"src/command_line/tree.hpp": "",
                 "src/cli/a.cpp": '#include "command_line/tree.hpp"\n'}
        self.assert_only(files)
        self.assert_only({**files, "src/mesh/b.cpp": '#include "command_line/tree.hpp"\n'},
                         "src/mesh/b.cpp:1: mesh must not include command_line/tree.hpp")

    def test_generated_types_outside_dds(self):
        self.assert_only({"src/server/a.cpp": '#include "graspdPubSubTypes.h"\n'},
                         "server must not include the generated")

    def test_an_unknown_folder(self):
        self.assert_only({"src/misc/a.cpp": "int x;\n"}, "'misc' is not a layer")


class Sizes(unittest.TestCase):
    @staticmethod
    def lengths(text):
        return list(check_layers.function_lengths(text.splitlines()))

    def test_file_length(self):
        self.assertEqual(findings_of({"src/mesh/a.cpp": "int x;\n" * 400}), [])
        self.assertIn("401 lines", findings_of({"src/mesh/a.cpp": "int x;\n" * 401})[0])

    def test_function_length_in_a_tree(self):
        # head and closing brace are 2 of the lines
        self.assertEqual(findings_of({"src/mesh/a.cpp": "void f() {\n" + "g();\n" * 58 + "}\n"}), [])
        finding = findings_of({"src/mesh/a.cpp": "\nvoid f() {\n" + "g();\n" * 59 + "}\n"})[0]
        self.assertIn("src/mesh/a.cpp:2: a function of 61 lines", finding)

    def test_what_counts_as_a_function(self):
        self.assertEqual(self.lengths("namespace a {\nint f(int x,\n      int y) {\n  return x;\n}\n}\n"),
                         [(2, 4)])
        self.assertEqual(self.lengths("class A {\n  void f() const {\n    if (x) {\n    }\n  }\n};\n"),
                         [(2, 4)])
        self.assertEqual(self.lengths("struct A {\n  int x{f()};\n  std::array<int, 2> y{1, 2};\n};\n"), [])

    def test_member_initialisers_belong_to_the_constructor(self):
        self.assertEqual(self.lengths("A::A(int x) : x_{x}, y_{2} {\n  f();\n  g();\n}\nint z;\n"),
                         [(1, 4)])

    def test_braces_in_text_do_not_count(self):
        text = 'void f() {\n  a("}}");\n  b(\'}\');  // }\n  /* }\n } */ c(R"(})");\n  d(1\'000);\n}\n'
        self.assertEqual(self.lengths(text), [(1, 7)])


if __name__ == "__main__":
    unittest.main()
