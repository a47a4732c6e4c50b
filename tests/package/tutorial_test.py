"""Types the commands of docs/tutorial.md again: each must still end as the page says.

    tutorial_test.py GRASPCTL WITH_SIMULATION(ON|OFF)

Blocks below `<!-- tutorial -->` are typed, in a folder of their own where scripts and examples are; those
below `<!-- tutorial: simulate -->` only by a build with the simulation. Compared are the words in capitals of an answer's first line (OK, NO_GRASP), the grasps' count, and the exit
code that follows from them.
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GRASPCTL, WITH_SIMULATION = Path(sys.argv.pop(1)), sys.argv.pop(1) == "ON"
BLOCK = re.compile(r"<!-- tutorial(: simulate)? -->\n```\n(.*?)```", re.DOTALL)
EXIT_CODES = {"NO_GRASP": 3}


def steps(text):
    """(command, the first line of its answer, needs the simulation) in the page's order."""
    for simulate, block in BLOCK.findall(text):
        lines = block.splitlines()
        for line, answer in zip(lines, lines[1:] + [""]):
            if line.startswith("$ "):
                yield line[2:], "" if answer.startswith("$ ") else answer, bool(simulate)


def verdict(line):
    """What of an answer's first line is the same on every machine."""
    return re.findall(r"\b(?:[A-Z_]{2,}|usable|holds|\d+ (?:grasps|points))\b", line)


class Tutorial(unittest.TestCase):
    def test_every_command_ends_as_the_page_says(self):
        typed = 0
        path = f"{GRASPCTL.parent}{os.pathsep}{os.environ['PATH']}"
        environment = dict(os.environ, PATH=path, GRASPD_PROFILES=str(ROOT / "profiles"),
                           PYTHONDONTWRITEBYTECODE="1")
        with tempfile.TemporaryDirectory() as folder:
            for name in ("scripts", "examples"):
                (Path(folder) / name).symlink_to(ROOT / name)
            for command, answer, simulate in steps((ROOT / "docs/tutorial.md").read_text()):
                if simulate and not WITH_SIMULATION:
                    continue
                with self.subTest(command):
                    done = subprocess.run(shlex.split(command), cwd=folder, env=environment,
                                          capture_output=True, text=True, check=False)
                    first = next(iter(done.stdout.splitlines()), "")
                    self.assertEqual(verdict(first), verdict(answer), done.stderr)
                    expected = [EXIT_CODES[word] for word in verdict(answer) if word in EXIT_CODES]
                    self.assertEqual(done.returncode, sum(expected), done.stderr)
                    typed += 1
        self.assertGreaterEqual(typed, 10)


if __name__ == "__main__":
    unittest.main()
