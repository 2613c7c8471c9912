#!/usr/bin/env python3
"""Simulates the dispatch of launches to K processes, with messages that take time.

Process 0 hands out launches, at most three to a process. Results come over its one link and are added to the film in the
order of the launches; those that are early wait, and while 2 K wait none is handed out.

    scaling.py --launch-fold SECONDS --launch-bytes BYTES [--gigabytes-per-second B] [--latency SECONDS] [--spread S]

prints for each K the share of time that processes work, the bytes per second to process 0, and the share of time that it
adds results. SECONDS and BYTES are those of a launch of 50 ms.
"""
import argparse
import heapq
import random

IN_FLIGHT = 3
LAUNCH = 0.05  # seconds


def simulate(processes, fold, size, bandwidth, latency, spread, launches_each=60):
    """Returns (share of time that processes work, seconds)."""
    generator = random.Random(1)
    free = [0.0] * processes  # when each process is done with what it has
    events = []  # (time of arrival at process 0, launch, process)
    link = film = busy = 0.0
    handed_out = folded = 0
    early = set()
    waiting = []  # processes that were refused a launch
    total = launches_each * processes

    def hand_out(now, process):
        nonlocal handed_out, link, busy
        if handed_out >= total:
            return
        if len(early) >= 2 * processes:
            waiting.append(process)
            return
        length = LAUNCH * generator.lognormvariate(0.0, spread)
        free[process] = max(free[process], now + latency) + length
        busy += length
        heapq.heappush(events, (free[process] + latency, handed_out, process))
        handed_out += 1

    for _ in range(IN_FLIGHT):
        for process in range(processes):
            hand_out(0.0, process)
    end = 0.0
    while events:
        now, launch, process = heapq.heappop(events)
        link = max(link, now) + size / bandwidth
        early.add(launch)
        end = max(end, link)
        while folded in early:
            early.remove(folded)
            film = max(film, link) + fold
            folded += 1
        refused, waiting = waiting + [process], []
        # Adding results delays what follows them.
        for each in refused:
            hand_out(max(link, film - fold * processes), each)
        end = max(end, film)
    return busy / processes / end, end


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--launch-fold", type=float, required=True)
    parser.add_argument("--launch-bytes", type=float, required=True)
    parser.add_argument("--gigabytes-per-second", type=float, default=10.0)
    parser.add_argument("--latency", type=float, default=0.002)
    parser.add_argument("--spread", type=float, default=0.1)
    options = parser.parse_args()
    print("processes  working  MB/s to process 0  process 0 adds")
    for processes in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000):
        share, seconds = simulate(processes, options.launch_fold, options.launch_bytes,
                                  1e9 * options.gigabytes_per_second, options.latency, options.spread)
        launches = 60 * processes
        print(f"{processes:9d}  {100 * share:6.1f}%  {launches * options.launch_bytes / seconds / 1e6:17.1f}"
              f"  {100 * launches * options.launch_fold / seconds:13.1f}%")


if __name__ == "__main__":
    main()
