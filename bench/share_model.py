#!/usr/bin/env python3
"""How many planners a site needs: a simulation of planners that share requests by rendezvous hash.

    share_model.py [--planners N] [--clients C] [--period S] [--plan-ms MS] [--workers W] [--group G]

Each of C clients asks once every S seconds on average, at times of its own (a Poisson stream); a request falls
to one of N planners by chance, as the hash does it, waits for one of its W workers, and takes a plan's time:
log-normal with the given median and a 95 % quantile of three times that (what plans of scans from 5,000 to
70,000 faces show). A planner with a full queue answers OVERLOADED, and the client asks again after 0.5 s, 1 s,
2 s... "ideal" gives each request to the planner that is free first, which nobody who does not know all queues
can do: what the hash costs is the difference.

With --group the planners and clients are split into groups that hear nothing of each other (namespaces or
domains): each planner then receives the requests of its group alone. Bytes: what one planner receives, with
--request-kb a request. Deterministic: the draws are seeded.
"""

import argparse
import heapq
import math
import random

QUEUE = 16  # server.queue_capacity
BACKOFF_S = 0.5
SIGMA = math.log(3) / 1.645  # of the logarithm, where 95 of 100 are below three medians


def quantile(values, share):
    return values[min(len(values) - 1, int(share * len(values)))]


class Planner:
    def __init__(self, workers):
        self.free_at = [0.0] * workers  # heap
        self.starts = []  # heap of start times of what waits

    def take(self, now, service):
        """@return the end of the plan, or None where the queue is full."""
        while self.starts and self.starts[0] <= now:
            heapq.heappop(self.starts)
        if len(self.starts) >= QUEUE:
            return None
        start = max(now, heapq.heappop(self.free_at))
        heapq.heappush(self.free_at, start + service)
        if start > now:
            heapq.heappush(self.starts, start)
        return start + service


def simulate(options, requests, ideal):
    """@return sorted latencies [s] and how often a request was answered OVERLOADED."""
    draw = random.Random(1)
    planners = [Planner(options.workers) for _ in range(options.planners)]
    rate = options.clients / options.period
    events, now = [], 0.0  # heap of (time, number, first asked, service time, attempt)
    latencies, overloaded, arrived = [], 0, 0
    median = options.plan_ms / 1000
    while arrived < requests or events:
        if arrived < requests and (not events or now <= events[0][0]):
            event = (now, arrived, now, median * math.exp(SIGMA * draw.gauss(0, 1)), 0)
            arrived += 1
            now += draw.expovariate(rate)
        else:
            event = heapq.heappop(events)
        at, number, asked, service, attempt = event
        planner = min(planners, key=lambda one: one.free_at[0]) if ideal else draw.choice(planners)
        end = planner.take(at, service)
        if end is None:
            overloaded += 1
            heapq.heappush(events, (at + BACKOFF_S * 2 ** min(attempt, 5), number, asked, service, attempt + 1))
        else:
            latencies.append(end - asked)
    return sorted(latencies), overloaded


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planners", type=int, default=100)
    parser.add_argument("--clients", type=int, default=10000)
    parser.add_argument("--period", type=float, default=0, help="[s] between two requests of a client; 0: a table")
    parser.add_argument("--plan-ms", type=float, default=70, help="median of a plan")
    parser.add_argument("--workers", type=int, default=2, help="of a planner")
    parser.add_argument("--group", type=int, default=0, help="planners that hear each other; 0: all")
    parser.add_argument("--request-kb", type=float, default=390, help="16,000 faces")
    parser.add_argument("--requests", type=int, default=100000, help="that are simulated")
    options = parser.parse_args()
    group = options.group or options.planners
    mean = options.plan_ms / 1000 * math.exp(SIGMA**2 / 2)
    capacity = options.planners * options.workers / mean
    loads = [0.3, 0.5, 0.6, 0.7, 0.8, 0.9]
    periods = [options.period] if options.period else [options.clients / (load * capacity) for load in loads]
    print(f"{options.planners} planners of {options.workers} workers, {options.clients} clients, plans of "
          f"{options.plan_ms:.0f} ms (mean {1000 * mean:.0f}): at most {capacity:.0f} a second")
    print("| period [s] | load | per s | p50 [ms] | p95 | p99 | overloaded | ideal p99 | a planner receives [MB/s] |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for options.period in periods:
        rate = options.clients / options.period
        times, overloaded = simulate(options, options.requests, ideal=False)
        best, _ = simulate(options, options.requests // 4, ideal=True)
        received = rate * group / options.planners * options.request_kb / 1000
        cells = [f"{options.period:.1f}", f"{rate / capacity:.0%}", f"{rate:.0f}"]
        cells += [f"{1000 * quantile(times, share):.0f}" for share in (0.5, 0.95, 0.99)]
        cells += [f"{overloaded / options.requests:.2%}", f"{1000 * quantile(best, 0.99):.0f}", f"{received:.0f}"]
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
