#!/usr/bin/env python3
"""The second half of scripts/compare_builds: compares the replies of two build folders."""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OBJECTS = ROOT / "examples" / "objects"
PLANS = [["--seed", "1"], ["--seed", "2", "--concavity", "tetrahedral"],
         ["--seed", "3", "--up", "0,0,1", "--friction", "0.3", "--suggest"]]
SECONDS = 1500  # a sanitized build takes its time


def output_of(command):
    done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, cwd=ROOT)
    # graspctl plan: 0 grasps, 3 none. Whatever else it says is compared as well.
    return done.returncode, done.stdout, done.stderr


def without_times(text):
    """A reply's JSON; the times become 0, everything else stays as it was printed."""
    # Numbers stay texts, so that the last digit counts.
    reply = json.loads(text, parse_float=str, parse_int=str)
    reply["timings_ms"]["total"] = "0"
    for stage in reply["report"]["stages"]:
        stage["ms"] = "0"
    return json.dumps(reply, indent=1)


def wire_digests(build):
    code, text, errors = output_of([build / "tests/golden/reply_digest", "--each"])
    if code != 0:
        sys.exit(f"{build}: reply_digest ended with {code}\n{errors}")
    return dict(line.split() for line in text.splitlines())


def plans(build):
    replies = {}
    for path in sorted(OBJECTS.iterdir()):
        if path.suffix == ".md":
            continue
        for options in PLANS:
            # No clock ends a plan, however slow the build.
            code, text, errors = output_of([build / "src/cli/graspctl", "plan", path, "--format", "json",
                                            "--time-budget", "1e9", *options])
            name = " ".join([path.name, *options])
            if code not in (0, 3):
                sys.exit(f"{build}: graspctl plan {name} ended with {code}\n{errors}")
            replies[name] = f"exit {code}\n" + without_times(text)
    return replies


def compare(what, first, second):
    """Prints the names whose values differ; how many."""
    names = sorted(first.keys() | second.keys())
    different = [name for name in names if first.get(name) != second.get(name)]
    for name in different:
        print(f"differs: {what} {name}")
    print(f"{what}: {len(names) - len(different)} of {len(names)} the same")
    return len(different) + (not names)


def main():
    builds = [ROOT / name for name in sys.argv[1:]]
    bad = compare("requests of tests/golden", *[wire_digests(build) for build in builds])
    bad += compare("plans of examples/objects", *[plans(build) for build in builds])
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
