#!/usr/bin/env python3
"""Several planners on hosts of their own share the requests of a client on another.

    hosts.py --graspd PROGRAM --client PROGRAM --object FILE [--planners N] [--requests N] [--cpu SHARE]

A host is a network namespace with an address of its own on a bridge, all of it in namespaces of this
program. With --cpu every planner gets that share of one core (cgroups), for else hosts on one machine
have the same two cores.

  throughput  1, 2, ... N planners, so many requests in flight that none is idle
  killed      N planners, one ended by kill -9 in the middle
  cut         N planners, the link of one down for three seconds
  stopped     N planners, one asked to stop in the middle
  servers     N planners and the client find each other by two discovery servers instead of multicast, one
              of which is killed in the middle; needs fast-discovery-server (Debian: fastdds-tools)

Checked: every request is answered without a retry; nobody answers one twice where nobody is lost; what
was open when a planner was lost is answered within 2 s and the time that as many requests take. Prints a
table; exit code 1 when something is violated.
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

INSIDE = "GRASPD_HOSTS_INSIDE"
PROFILES = Path(__file__).resolve().parents[2] / "profiles"
NETWORK = "10.77.0"  # of the bridge, which leads nowhere else
CUT_S = 3.0
TAKEN_OVER_S = 2.0  # after a loss
CGROUP = Path("/sys/fs/cgroup/cpu/graspd_hosts")
CONFIG = """server: {workers: 1, queue_capacity: 64}
share: {enabled: true}
"""


def enter_own_network():
    """Runs this program again in namespaces of its own."""
    if INSIDE in os.environ:
        return True
    user = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    unshare = ["unshare", *user, "--net", "--mount"]
    own = "mount -t tmpfs tmpfs /run && mount -t tmpfs tmpfs /dev/shm && ip link set lo up"
    bridge = "ip link add try type bridge && ip link add one type veth peer name two"
    host = "ip netns add try && ip netns exec try true"
    tried = subprocess.run([*unshare, "sh", "-c", f"{own} && {bridge} && {host}"],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    if tried.returncode != 0:
        return False
    os.environ[INSIDE] = "yes"
    enter = own + ' && exec "$@"'
    os.execvp("unshare", [*unshare, "sh", "-c", enter, "hosts", sys.executable, "-B", *sys.argv])


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True)


def fields_of(line):
    return dict(re.findall(r"(\w+)=(\"[^\"]*\"|\S+)", line))


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


class Host:
    """A network namespace on the bridge."""

    def __init__(self, number):
        self.name = f"host{number}"
        self.link = f"veth{number}"
        self.address = f"{NETWORK}.{number}"
        ip("netns", "add", self.name)
        ip("link", "add", self.link, "type", "veth", "peer", "name", "eth0", "netns", self.name)
        ip("link", "set", self.link, "master", "bridge0", "up")
        self.ip_inside("link", "set", "lo", "up")
        self.ip_inside("addr", "add", f"{self.address}/24", "dev", "eth0")
        self.ip_inside("link", "set", "eth0", "up")
        self.ip_inside("route", "add", "239.0.0.0/8", "dev", "eth0")

    def ip_inside(self, *arguments):
        ip("-n", self.name, *arguments)

    def start(self, command, pipe):
        return subprocess.Popen(
            ["ip", "netns", "exec", self.name, *command], text=True, bufsize=1,
            env={**os.environ, "GRASPD_PROFILES": str(PROFILES)}, **{pipe: subprocess.PIPE},
        )


class Process:
    """A program on a host, whose lines are collected while it runs."""

    alive = []

    def __init__(self, host, command, pipe):
        self.lines = []
        self.host = host
        self.process = host.start(command, pipe)
        Process.alive.append(self.process)
        self.thread = threading.Thread(target=self._read, args=(getattr(self.process, pipe),), daemon=True)
        self.thread.start()

    def _read(self, stream):
        for line in stream:
            self.lines.append(line.rstrip("\n"))

    def count(self, text):
        return sum(text in line for line in list(self.lines))

    def finish(self, timeout=600):
        code = self.process.wait(timeout)
        self.thread.join(timeout)
        return code


class Planner(Process):
    def __init__(self, host, options):
        self.group = None
        command = [options.graspd, "--config", options.config, "--domain", str(options.domain)]
        command += ["--profile", options.profile]
        super().__init__(host, command, "stderr")
        if options.cpu:
            self.group = CGROUP / host.name
            self.group.mkdir(parents=True, exist_ok=True)
            (self.group / "cpu.cfs_period_us").write_text("20000")
            (self.group / "cpu.cfs_quota_us").write_text(str(int(20000 * options.cpu)))
            (self.group / "cgroup.procs").write_text(str(self.process.pid))

    def end(self, how):
        if self.process.poll() is None:
            self.process.send_signal(how)
        return self.finish()


class Hosts:
    def __init__(self, options):
        self.options = options
        self.violations = []
        ip("link", "add", "bridge0", "type", "bridge", "mcast_snooping", "0")
        ip("link", "set", "bridge0", "up")
        self.hosts = [Host(number) for number in range(1, options.planners + 2)]
        self.rows = []

    def require(self, holds, what):
        if not holds:
            self.violations.append(what)

    def start(self, count):
        self.options.domain += 1  # nobody hears of those before
        planners = [Planner(host, self.options) for host in self.hosts[:count]]
        end = time.monotonic() + 30
        for planner in planners:
            while planner.count("event=takes_part") < 1 or planner.count("serves=true") < count - 1:
                if time.monotonic() > end:
                    raise TimeoutError("\n".join(planner.lines))
                time.sleep(0.05)
        return planners

    def ask(self, phase, planners, requests, in_flight):
        command = [self.options.client, "--object", self.options.object, "--requests", str(requests)]
        command += ["--in-flight", str(in_flight), "--prefix", f"{phase}-", "--planners", str(planners)]
        command += ["--domain", str(self.options.domain), "--profile", self.options.profile]
        return Process(self.hosts[-1], command, "stdout")

    def wait_for_replies(self, client, count):
        end = time.monotonic() + 120
        while client.count("reply ") < count and client.process.poll() is None:
            if time.monotonic() > end:
                raise TimeoutError(f"{client.count('reply ')} replies, {count} wanted")
            time.sleep(0.005)

    def report(self, phase, client, planners, requests, lost=None):
        """One row; `lost`: when a planner was lost."""
        code = client.finish()
        sent, first, times = {}, {}, collections.Counter()
        by_planner, statuses = collections.Counter(), collections.Counter()
        for line in client.lines:
            fields = fields_of(line)
            if line.startswith("sent "):
                sent[fields["id"]] = float(fields["at"])
            elif line.startswith("reply "):
                times[fields["id"]] += 1
                statuses[fields["status"]] += 1
                if fields["id"] not in first:
                    first[fields["id"]] = float(fields["at"])
                    by_planner[fields["planner"]] += 1
        self.require(code == 0 and len(first) == requests, f"{phase}: {len(first)} of {requests} answered")
        self.require(set(statuses) <= {"OK"}, f"{phase}: {dict(statuses)}")
        twice = sum(count > 1 for count in times.values())
        waits = [1000 * (first[name] - sent[name]) for name in first]
        if not first:
            return 0
        rate = len(first) / (max(first.values()) - min(sent.values()))
        after = float("nan")
        if lost is not None:
            open_then = [name for name in sent if sent[name] <= lost and first.get(name, 1e18) > lost]
            after = max((first.get(name, 1e18) - lost for name in open_then), default=0.0)
            allowed = TAKEN_OVER_S + len(open_then) / rate
            self.require(after <= allowed, f"{phase}: {after:.2f} s after the loss, {allowed:.2f} s allowed")
        taken = sum(planner.count("event=taken_over") for planner in planners)
        shares = " ".join(str(count) for _, count in sorted(by_planner.items()))
        self.rows.append((phase, len(planners), f"{len(first)} of {requests}", f"{rate:.1f}",
                          f"{quantile(waits, 0.5):.0f}", f"{max(waits):.0f}", shares, str(taken),
                          str(twice), f"{1000 * after:.0f}" if lost is not None else ""))
        return twice

    def stop(self, planners):
        for planner in planners:
            self.require(planner.end(signal.SIGTERM) == 0, "graspd did not end with 0")

    def throughput(self, count):
        planners = self.start(count)
        requests = self.options.requests
        client = self.ask("throughput", count, requests, 3 * count)
        twice = self.report("throughput", client, planners, requests)
        self.require(twice == 0, f"throughput: {twice} answered twice")
        self.stop(planners)

    def lose_one(self, phase, lose, restore=None, wants_twice=False):
        count, requests = self.options.planners, self.options.requests
        planners = self.start(count)
        client = self.ask(phase, count, requests, count + 1)
        self.wait_for_replies(client, requests // 3)
        lost = time.monotonic()
        lose(planners[0])
        if restore is not None:
            time.sleep(CUT_S)
            restore(planners[0])
        twice = self.report(phase, client, planners, requests, lost)
        self.require(wants_twice or twice == 0, f"{phase}: {twice} answered twice")
        self.stop(planners[1:])
        if planners[0].process.poll() is None:
            planners[0].end(signal.SIGTERM)

    def servers(self, folder):
        """Everybody is a client of two discovery servers on hosts of the planners."""
        program = shutil.which("fast-discovery-server")
        if program is None:
            print("servers: not tried, there is no fast-discovery-server")
            return
        for host in self.hosts:
            host.ip_inside("route", "del", "239.0.0.0/8")
        servers = []
        text = (PROFILES / "dds/discovery_server.xml").read_text()
        text = re.sub(r"<interfaceWhiteList>.*?</interfaceWhiteList>", "", text, flags=re.DOTALL)
        for number, port in ((0, 11811), (1, 11812)):
            host = self.hosts[number]
            text = text.replace("<address>127.0.0.1</address>", f"<address>{host.address}</address>", 1)
            command = [program, "-i", str(number), "-l", host.address, "-p", str(port)]
            servers.append(Process(host, command, "stdout"))
        self.options.profile = str(folder / "servers.xml")
        Path(self.options.profile).write_text(text)
        self.lose_one("servers", lambda planner: servers[0].process.kill(), wants_twice=False)

    def run(self, folder):
        for count in range(1, self.options.planners + 1):
            self.throughput(count)
        # At least once: what a lost planner answered as it was lost may be planned again.
        self.lose_one("killed", lambda planner: planner.end(signal.SIGKILL), wants_twice=True)
        self.lose_one("cut", lambda planner: ip("link", "set", planner.host.link, "down"),
                      lambda planner: ip("link", "set", planner.host.link, "up"), wants_twice=True)
        self.lose_one("stopped", lambda planner: planner.end(signal.SIGTERM))
        self.servers(folder)

    def print_table(self):
        head = ("phase", "planners", "answered", "per s", "p50 ms", "max ms", "by planner", "taken over",
                "twice", "open ones answered after [ms]")
        rows = [head, ["---"] * len(head), *self.rows]
        for row in rows:
            print("| " + " | ".join(str(cell) for cell in row) + " |")
        for violation in self.violations:
            print(f"VIOLATION {violation}")
        print(f"hosts: {len(self.violations)} violations")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--graspd", required=True)
    parser.add_argument("--client", required=True, help="load_client")
    parser.add_argument("--object", required=True, help="that is asked for")
    parser.add_argument("--planners", type=int, default=3)
    parser.add_argument("--requests", type=int, default=300)
    parser.add_argument("--cpu", type=float, default=0.0, help="share of a core for each planner; 0: no limit")
    parser.add_argument("--log", help="keep the planners' logs in this folder")
    options = parser.parse_args()
    if not enter_own_network():
        print("hosts: no namespaces or no bridges here")
        return 77
    folder = Path(tempfile.mkdtemp(prefix="graspd_hosts_"))
    options.config = str(folder / "planner.yaml")
    options.domain = 40
    options.profile = str(PROFILES / "dds/lan.xml")
    Path(options.config).write_text(CONFIG)
    hosts = None
    try:
        hosts = Hosts(options)
        hosts.run(folder)
        return 1 if hosts.violations else 0
    finally:
        if hosts is not None:
            hosts.print_table()
        for process in Process.alive:
            process.kill()
            process.wait()
        for group in CGROUP.glob("*") if CGROUP.exists() else []:
            if group.is_dir():
                group.rmdir()
        if CGROUP.exists():
            CGROUP.rmdir()
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
