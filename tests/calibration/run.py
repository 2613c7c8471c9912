#!/usr/bin/env python3
"""Compares the verdicts and rankings of short `phlux bench scenes` runs with those of long ones.

    tests/calibration/run.py PHLUX OUT [--seeds 20] [--seconds 3,10,30] [--truth SECONDS] [--side 48] [SCENE.xml...]

Each scene is measured once for --truth seconds (default: 10 times the longest of --seconds), and for each of --seconds with each
seed. Prints a Markdown table of all scenes and times. A run resumes from the tables in OUT. Default: scenes/*.xml and
scenes/stability/*.xml. Columns:

- best, tied, undecided: number of runs that name one method, that name several, and that say that there was too little time.
- wrong: number of runs, of those that name methods, in which no named method has a cost within 10% of the least of the long run,
  or may have it by the long run, which had too little time to tell.
- biased: number of verdicts "biased" for methods that are not biased according to the long run.
- intervals: share of the confidence intervals of the ratio of costs to the best method that contain the ratio of the long run,
  and their number. The intervals of a run are all right with probability 95%, so that each contains it more often. They are
  widened by two standard errors of the ratio of the long run, which has an error too.
"""
import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile
from collections import Counter

TRUTH_SEED = 1_000_000
TOLERANCE = 1.1  # of the least cost: within it a method may be called the best


class Runs:
    def __init__(self, program, out, side):
        self.program, self.out, self.side = program, out, side
        # A matplotlib that cannot be imported: no charts are drawn.
        self.no_charts = tempfile.TemporaryDirectory()
        package = pathlib.Path(self.no_charts.name, "matplotlib")
        package.mkdir()
        (package / "__init__.py").write_text("raise ImportError\n", encoding="utf-8")

    def rows(self, scene, seconds, seed):
        """The rows of scenes.csv by (integrator, strategy, variant); measures them unless they are there. None, and a message, if
        the scene cannot be measured."""
        folder = self.out / f"{scene.parent.name}-{scene.stem}" / f"{seconds:g}s-seed{seed}"
        table = folder / "scenes.csv"
        if not table.exists() or table.read_text(encoding="utf-8").count("\n") < 2:
            command = [self.program, "bench", "scenes", "--scene", scene, "--seconds", f"{seconds:g}", "--seed", str(seed),
                       "--side", str(self.side), "--out", folder]
            done = subprocess.run(command, env={**os.environ, "PYTHONPATH": self.no_charts.name}, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True, check=False)  # without charts the exit code is 5
            if not table.exists():
                print(f"left out: {done.stderr.strip()}", file=sys.stderr)
                return None
        with open(table, newline="", encoding="utf-8") as file:
            return {(row["integrator"], row["strategy"], row["connect_or_weights"]): row for row in csv.DictReader(file)}


def outcome_of(rows):
    ranks = Counter(row["rank"] for row in rows.values())
    return "undecided" if ranks["open"] or not ranks["best"] else "tied" if ranks["tied"] else "best"


def contains_truth(row, truth, truth_of_best):
    """Whether the interval of a ratio of costs contains that of the long run, within the errors of both."""
    ratio = float(truth["cost"]) / float(truth_of_best["cost"])
    errors = [float(r["variance_standard_error"]) / float(r["variance_per_sample"]) for r in (truth, truth_of_best)]
    off = math.log(ratio / float(row["cost_ratio"]))
    reach = math.log(float(row["cost_ratio_high" if off > 0 else "cost_ratio_low"]) / float(row["cost_ratio"]))
    return abs(off) <= math.hypot(reach, 2 * errors[0], 2 * errors[1])


def compare(rows, truth):
    """Counts of one run."""
    counts = Counter({outcome_of(rows): 1, "runs": 1})
    known = {key: float(row["cost"]) for key, row in truth.items() if row["verdict"] == "sound"}
    counts["biased"] = sum(row["verdict"] == "biased" and truth[key]["verdict"] != "biased" for key, row in rows.items())
    named = [key for key, row in rows.items() if row["rank"] in ("best", "tied")]
    if not counts["undecided"] and known:
        counts["wrong"] = int(not any(known.get(key, float("inf")) <= TOLERANCE * min(known.values()) or truth[key]["rank"] == "open"
                                      for key in named))
    best = next((key for key, row in rows.items() if row["rank"] == "best"), None)
    if best in known:
        for key, row in rows.items():
            if key in known and key != best and row["verdict"] == "sound":
                counts["intervals"] += 1
                counts["held"] += contains_truth(row, truth[key], truth[best])
    return counts


def row_text(name, seconds, counts):
    held = f"{100 * counts['held'] / counts['intervals']:.0f}% of {counts['intervals']}" if counts["intervals"] else ""
    numbers = [counts[column] for column in ("runs", "best", "tied", "undecided", "wrong", "biased")]
    return f"| {name} | {seconds:g} | " + " | ".join(map(str, numbers)) + f" | {held} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("scenes", type=pathlib.Path, nargs="*")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--seconds", default="3,10,30")
    parser.add_argument("--truth", type=float)
    parser.add_argument("--side", type=int, default=48)
    options = parser.parse_intermixed_args()
    folder = pathlib.Path(__file__).resolve().parents[2] / "scenes"
    scenes = options.scenes or sorted(folder.glob("*.xml")) + sorted(folder.glob("stability/*.xml"))
    times = [float(text) for text in options.seconds.split(",")]
    runs = Runs(options.program, options.out, options.side)
    totals = {seconds: Counter() for seconds in times}
    print("| scene | seconds | runs | best | tied | undecided | wrong | biased | intervals |")
    print("|---|---|---|---|---|---|---|---|---|")
    for scene in scenes:
        truth = runs.rows(scene, options.truth or 10 * max(times), TRUTH_SEED)
        if truth is None:
            continue
        for seconds in times:
            counts = Counter()
            for seed in range(1, options.seeds + 1):
                counts.update(compare(runs.rows(scene, seconds, seed), truth))
            totals[seconds].update(counts)
            print(row_text(f"{scene.parent.name}/{scene.stem}", seconds, counts), flush=True)
    for seconds in times:
        print(row_text("all", seconds, totals[seconds]))


if __name__ == "__main__":
    main()
