#!/usr/bin/env python3
"""Many mixed requests at a supervised graspd, and what must hold of every one of them.

    soak.py --graspd PROGRAM --client PROGRAM [--requests N] [--log FILE]

In a network namespace of its own (with its own /dev/shm) four clients ask one question after the
other: good and bad objects, huge ones, cancelled ones, repeated ids.

  steady   the first half, undisturbed
  chaos    the second half; in between clients are killed by kill -9 and go on where they were, the
           participant is killed by kill -9, and the loopback link is down for a second

Checked: every question is answered, with a status that it may have; at most one reply on the wire
for each (planner, writer, id, attempt); each request that a surviving participant took has one
answer in its log; one restart for each kill; no descriptor, no shared memory left; and from the
first 1,500 requests of the steady half to its end memory grows by less than 1 % (judged from 3,000
requests of that half on). Prints a table; exit code 1 when something is violated.
"""

import argparse
import collections
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

CLIENTS = 4
DOMAIN = 90
INSIDE = "GRASPD_SOAK_INSIDE"
PROFILES = Path(__file__).resolve().parents[2] / "profiles"
WARM_REQUESTS = 1500  # the caches of replies and objects are full
JUDGED_REQUESTS = 3000
MAX_GROWTH = 0.01
LINK_DOWN_S = 1.0
STALL_S = 120  # without one answer more: something hangs
CONFIG = "supervisor: {first_wait_s: 0.1, longest_wait_s: 1}\n"


def enter_own_network():
    """Runs this program again in namespaces of its own, if this machine lets us."""
    if INSIDE in os.environ:
        return
    user = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    unshare = ["unshare", *user, "--net", "--mount"]
    if subprocess.run([*unshare, "true"], stderr=subprocess.DEVNULL).returncode != 0:
        print("soak: no namespaces here: the link stays up", flush=True)
        os.environ[INSIDE] = "shared"
        return
    os.environ[INSIDE] = "own"
    enter = 'ip link set lo up && mount -t tmpfs tmpfs /dev/shm && exec "$@"'
    os.execvp("unshare", [*unshare, "sh", "-c", enter, "soak", sys.executable, "-B", *sys.argv])


def fields_of(line):
    return dict(re.findall(r"(\w+)=(\"[^\"]*\"|\S+)", line))


class Output:
    """Lines of a process, collected while it runs."""

    processes = []

    def __init__(self, command, env, pipe):
        self.lines = []
        self.process = subprocess.Popen(
            command, env=env, text=True, **{pipe: subprocess.PIPE}, bufsize=1
        )
        Output.processes.append(self.process)
        self.thread = threading.Thread(
            target=self._read, args=(getattr(self.process, pipe),), daemon=True
        )
        self.thread.start()

    def _read(self, stream):
        for line in stream:
            self.lines.append(line.rstrip("\n"))

    def finish(self, timeout=30):
        code = self.process.wait(timeout)
        self.thread.join(timeout)
        return code


class Daemon(Output):
    """graspd under its supervisor."""

    def __init__(self, program, config, env):
        command = [program, "--supervise", "--config", config, "--domain", str(DOMAIN)]
        command += ["--profile", str(PROFILES / "dds/loopback.xml"), "--log-level", "debug"]
        super().__init__(command, env, "stderr")

    def count(self, text):
        return sum(text in line for line in list(self.lines))

    def wait_for(self, text, times=1, seconds=30):
        end = time.monotonic() + seconds
        while self.count(text) < times:
            if time.monotonic() > end:
                raise TimeoutError(f"graspd did not log {text} {times} times")
            time.sleep(0.05)

    def participant(self):
        started = [line for line in list(self.lines) if "event=child_started" in line]
        return int(fields_of(started[-1])["pid"])

    def lives(self):
        """The log, cut at each start of the participant."""
        lives = []
        for line in self.lines:
            if "event=child_started" in line:
                lives.append([])
            elif lives:
                lives[-1].append(line)
        return lives


class Client:
    """One of the four; killed, it goes on with the question that it was at."""

    def __init__(self, program, name, first, count, env):
        self.program, self.name, self.env = program, name, env
        self.first, self.count = first, count
        self.asked = []
        self.start()

    def start(self):
        done = len(self.asked)
        command = [self.program, "--client", self.name, "--domain", str(DOMAIN)]
        command += ["--profile", str(PROFILES / "dds/loopback.xml")]
        command += ["--first", str(self.first + done), "--count", str(self.count - done)]
        self.output = Output(command, self.env, "stdout")

    def answers(self):
        return self.asked + list(self.output.lines)

    def running(self):
        return self.output.process.poll() is None

    def kill(self):
        self.output.process.kill()
        self.output.finish()
        self.asked += [line for line in self.output.lines if "verdict=" in line]
        self.output.lines = []
        if len(self.asked) < self.count:
            self.start()


def memory_kb(pid):
    text = Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"RssAnon:\s+(\d+)", text).group(1))


def descriptors(pid):
    return len(os.listdir(f"/proc/{pid}/fd"))


def shared_memory():
    return sorted(name for name in os.listdir("/dev/shm") if "fastrtps" in name)


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


class Soak:
    def __init__(self, arguments, config):
        self.arguments = arguments
        self.env = {**os.environ, "GRASPD_PROFILES": str(PROFILES)}
        self.violations = []
        self.figures = []
        self.kills = 0
        self.daemon = Daemon(arguments.graspd, config, self.env)
        self.daemon.wait_for("event=ready")
        watch = [arguments.client, "--watch", "--domain", str(DOMAIN)]
        watch += ["--profile", str(PROFILES / "dds/loopback.xml")]
        self.watch = Output(watch, self.env, "stdout")
        time.sleep(3)  # a first match can take so long

    def require(self, holds, what):
        if not holds:
            self.violations.append(what)

    def figure(self, name, value):
        self.figures.append((name, value))

    def start_clients(self, phase, requests):
        each = requests // CLIENTS
        return [
            Client(self.arguments.client, f"{phase}-{i}", i * each, each, self.env)
            for i in range(CLIENTS)
        ]

    def watch_until(self, clients, is_over, look):
        """Calls look(answers so far) until is_over(answers so far) or no client runs any more."""
        last, since = -1, time.monotonic()
        while any(client.running() for client in clients):
            done = sum(len(client.answers()) for client in clients)
            if is_over(done):
                return
            look(done)
            if done != last:
                last, since = done, time.monotonic()
            if time.monotonic() - since > STALL_S:
                self.require(False, f"no answer within {STALL_S} s, {done} before")
                for client in clients:
                    client.output.process.kill()
                return
            time.sleep(0.1)

    def finish(self, clients, phase):
        self.watch_until(clients, lambda done: False, lambda done: None)
        latencies = collections.defaultdict(list)
        total = 0
        for client in clients:
            client.output.finish()
            answers = [fields_of(line) for line in client.answers()]
            total += len(answers)
            self.require(len(answers) == client.count,
                         f"{client.name}: {len(answers)} of {client.count} questions answered")
            for answer in answers:
                kind = answer["kind"]
                latencies[kind].append(float(answer["ms"]))
                self.require(answer["verdict"] == "ok",
                             f"{answer['id']} ({kind}): {answer['verdict']}, {answer['status']}")
        self.figure(f"{phase}: questions answered", total)
        return latencies

    def steady(self, requests):
        """Undisturbed: memory and descriptors of one life of the participant."""
        pid = self.daemon.participant()
        files = descriptors(pid)
        clients = self.start_clients("steady", requests)
        samples = []
        self.watch_until(clients, lambda done: False,
                         lambda done: samples.append((done, memory_kb(pid))))
        latencies = self.finish(clients, "steady")
        samples.append((requests, memory_kb(pid)))
        self.require(self.daemon.participant() == pid, "the participant died by itself")
        self.require(descriptors(pid) <= files,
                     f"{descriptors(pid)} descriptors after the requests, {files} before")
        self.figure("steady: descriptors before, after", f"{files}, {descriptors(pid)}")
        warm = [memory for done, memory in samples if done <= WARM_REQUESTS]
        late = [memory for done, memory in samples if done >= requests - WARM_REQUESTS // 2]
        before, after = quantile(warm[-20:], 0.5), quantile(late, 0.5)
        growth = after / before - 1
        judged = requests >= JUDGED_REQUESTS
        self.figure("steady: RssAnon [MB] warm, at the end",
                    f"{before / 1024:.1f}, {after / 1024:.1f} ({100 * growth:+.2f} %"
                    + (")" if judged else ", too few requests to judge)"))
        self.require(not judged or growth < MAX_GROWTH, f"memory grew by {100 * growth:.2f} %")
        return latencies

    def disturb(self, turn, clients):
        what = turn % (3 if os.environ[INSIDE] == "own" else 2)
        self.daemon.wait_for("event=ready", self.kills + 1)
        if what == 0:
            os.kill(self.daemon.participant(), signal.SIGKILL)
            self.kills += 1
        elif what == 1:
            running = [client for client in clients if client.running()]
            if running:
                running[turn % len(running)].kill()
        else:
            subprocess.run(["ip", "link", "set", "lo", "down"], check=True)
            time.sleep(LINK_DOWN_S)
            subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
        return ("participant killed", "client killed", "link down")[what]

    def chaos(self, requests):
        clients = self.start_clients("chaos", requests)
        disturbances = max(6, requests // 200)
        done_so_far = collections.Counter()
        for turn in range(disturbances):
            at = requests * (turn + 1) // (disturbances + 2)
            self.watch_until(clients, lambda done, at=at: done >= at, lambda done: None)
            done_so_far[self.disturb(turn, clients)] += 1
        latencies = self.finish(clients, "chaos")
        for name, count in done_so_far.items():
            self.figure(f"chaos: {name}", count)
        return latencies

    def check_wire(self):
        """One reply for each (planner, writer, id, attempt)."""
        seen = collections.Counter()
        for line in self.watch.lines:
            reply = fields_of(line)
            key = tuple(reply[name] for name in ("planner", "writer", "client", "id", "attempt"))
            seen[key] += 1
        for key, times in seen.items():
            self.require(times == 1, f"{times} replies for {' '.join(key)}")
        self.figure("replies on the wire", len(seen))
        self.require(seen, "no reply was seen on the wire")

    def check_log(self):
        """A participant that was not killed answered what it took, once; a killed one not more."""
        lives = self.daemon.lives()
        for number, life in enumerate(lives):
            taken, answered = collections.Counter(), collections.Counter()
            for line in life:
                fields = fields_of(line)
                event, key = fields.get("event"), (fields.get("client"), fields.get("id"))
                if event == "received":
                    taken[key] += 1
                elif event == "request":
                    answered[key] += 1
            whole = number == len(lives) - 1
            for key in taken | answered:
                right = answered[key] == taken[key] if whole else answered[key] <= taken[key]
                self.require(right, f"life {number}: {key} taken {taken[key]} times, "
                                    f"answered {answered[key]} times")
            self.figure(f"life {number}: taken, answered",
                        f"{sum(taken.values())}, {sum(answered.values())}")

    def stop(self):
        self.watch.process.terminate()
        self.require(self.watch.finish() == 0, "the watching client failed")
        self.daemon.process.terminate()
        code = self.daemon.finish()
        self.require(code == 0, f"graspd ended with {code}")
        died = self.daemon.count("event=child_died")
        self.require(died == self.kills, f"{died} crashes for {self.kills} kills")
        ready = [line for line in self.daemon.lines if "event=ready" in line][-1]
        restarts = int(fields_of(ready)["restarts"])
        self.require(restarts == self.kills, f"{restarts} restarts for {self.kills} kills")
        self.figure("restarts", restarts)

    def report(self, steady, chaos):
        print(f"{'':44}{'n':>7}{'p50':>9}{'p95':>9}{'p99':>9}{'max':>10}   [ms]")
        for phase, latencies in (("steady", steady), ("chaos", chaos)):
            everything = [ms for values in latencies.values() for ms in values]
            rows = {"all": everything, **dict(sorted(latencies.items()))}
            for kind, values in rows.items() if phase == "steady" else [("all", everything)]:
                shown = "".join(f"{quantile(values, q):9.1f}" for q in (0.5, 0.95, 0.99))
                print(f"{phase + ': ' + kind:44}{len(values):7}{shown}{quantile(values, 1):10.1f}")
        for name, value in self.figures:
            print(f"{name:44}{value}")
        for violation in self.violations[:50]:
            print(f"VIOLATION {violation}")
        print(f"soak: {len(self.violations)} violations")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--graspd", required=True)
    parser.add_argument("--client", required=True, help="soak_client")
    parser.add_argument("--requests", type=int, default=10000)
    parser.add_argument("--log", help="keep graspd's log here")
    arguments = parser.parse_args()
    enter_own_network()
    folder = Path(tempfile.mkdtemp(prefix="graspd_soak_"))
    (folder / "soak.yaml").write_text(CONFIG)
    files = shared_memory()
    soak = None
    try:
        soak = Soak(arguments, str(folder / "soak.yaml"))
        half = arguments.requests // 2 // CLIENTS * CLIENTS
        steady = soak.steady(half)
        chaos = soak.chaos(half)
        soak.stop()
        soak.check_wire()
        soak.check_log()
        if os.environ[INSIDE] == "own":
            soak.require(shared_memory() == files, f"left in /dev/shm: {shared_memory()}")
        soak.report(steady, chaos)
        return 1 if soak.violations else 0
    finally:
        if soak is not None and arguments.log:
            Path(arguments.log).write_text("\n".join(soak.daemon.lines) + "\n")
        for process in Output.processes:
            process.kill()
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
