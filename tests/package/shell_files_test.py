"""Tries what the programs write for the shell: completion scripts and manual pages.

    shell_files_test.py GRASPCTL [GRASPD]
"""

import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GRASPCTL = Path(sys.argv[1])
GRASPD = Path(sys.argv[2]) if len(sys.argv) > 2 else None
ENVIRONMENT = dict(os.environ, GRASPD_PROFILES=str(ROOT / "profiles"), LC_ALL="C",
                   PATH=f"{GRASPCTL.parent}{os.pathsep}{os.environ['PATH']}")


def run(*command, text=None):
    done = subprocess.run([str(word) for word in command], input=text, env=ENVIRONMENT,
                          capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(f"{command}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def options_in(text):
    """Every option of a --help text or a manual page."""
    words = text.replace("\\-", "-").replace("\\fB", " ").replace("\\fR", " ").replace(",", " ").split()
    return {word.strip(",.:;()") for word in words if word.startswith("--")}


class Completion(unittest.TestCase):
    def offered(self, *words):
        """What bash offers for the last word."""
        script = run(GRASPCTL, "completion", "bash")
        line = " ".join(f"'{word}'" for word in words)
        return run("bash", "-u", text=f"{script}\nCOMP_WORDS=({line})\nCOMP_CWORD={len(words) - 1}\n"
                   '_graspctl\nprintf "%s\\n" "${COMPREPLY[@]}"\n').split()

    def test_a_subcommand(self):
        self.assertEqual(self.offered("graspctl", "pl"), ["plan"])
        self.assertLess({"plan", "simulate", "doctor", "grippers", "completion"},
                        set(self.offered("graspctl", "")))
        self.assertNotIn("man-page", self.offered("graspctl", ""))

    def test_every_option_of_every_subcommand(self):
        for command in self.offered("graspctl", ""):
            told = options_in(run(GRASPCTL, command, "--help"))
            self.assertLessEqual(set(self.offered("graspctl", command, "--")), told)
            self.assertIn("--help", self.offered("graspctl", command, "--"))
        self.assertLess({"--gripper", "--scene", "--format"},
                        set(self.offered("graspctl", "plan", "mug.stl", "--")))

    def test_values(self):
        self.assertEqual(self.offered("graspctl", "plan", "--units", ""), ["mm", "cm", "m"])
        self.assertEqual(self.offered("graspctl", "plan", "--gripper", "f"), ["franka_hand"])
        self.assertEqual(self.offered("graspctl", "completion", "z"), ["zsh"])
        self.assertEqual(self.offered("graspctl", "plan", "mu"), [])  # a file

    @unittest.skipUnless(shutil.which("zsh"), "no zsh here")
    def test_zsh_reads_its_script(self):
        run("zsh", "-n", text=run(GRASPCTL, "completion", "zsh"))


class ManualPages(unittest.TestCase):
    def check_page(self, page, name):
        self.assertTrue(page.startswith(f".TH {name} "), page[:40])
        for section in ("NAME", "SYNOPSIS", "OPTIONS", "EXIT STATUS", "ENVIRONMENT", "SEE ALSO"):
            self.assertIn(f"\n.SH {section}\n", page)
        if shutil.which("man"):
            done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", "-"],
                                  input=page, capture_output=True, text=True, check=False)
            if "groff" not in done.stderr and "not found" not in done.stderr:
                self.assertEqual(done.stderr, "")

    def test_graspctl(self):
        page = run(GRASPCTL, "man-page")
        self.check_page(page, "GRASPCTL")
        for command in ("plan", "simulate", "doctor", "concavity", "grippers"):
            self.assertLessEqual(options_in(run(GRASPCTL, command, "--help")), options_in(page))

    @unittest.skipUnless(GRASPD, "a build without the daemon")
    def test_graspd(self):
        page = run(GRASPD, "--man-page")
        self.check_page(page, "GRASPD")
        self.assertLessEqual(options_in(run(GRASPD, "--help")), options_in(page))
        self.assertNotIn("--man-page", options_in(page))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
