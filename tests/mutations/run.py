#!/usr/bin/env python3
"""Puts each mistake of mutants.py into a copy of kernels/ and sees whether `phlux verify --quick` catches it.

    tests/mutations/run.py PHLUX [--device SPEC] [--only TEXT]

Prints what caught each; exits with 1 when one survives. Takes some minutes: every mutant is compiled anew.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

from mutants import MUTANTS

KERNELS = pathlib.Path(__file__).resolve().parents[2] / "kernels"


def mutate(folder, file, old, new):
    shutil.copytree(KERNELS, folder)
    text = (folder / file).read_text()
    if text.count(old) != 1:
        raise SystemExit(f"{file} holds {text.count(old)} times: {old}")
    (folder / file).write_text(text.replace(old, new))


def strategies_of(name):
    """The strategies whose code holds the mistake, or some of them: each is compiled anew."""
    named = {"exact": ["exact"], "rejection": ["rejection"], "fold": ["fold"], "disk": ["disk"], "theta": ["theta-phi"],
             "uniform": ["cosine"], "guard": ["lobe-estimate"], "estimate": ["lobe-estimate-printed"]}
    return named.get(name.split()[0].split(":")[0].split("'")[0], ["lobe-ks", "mixture", "exact"])


def caught_by(phlux, options, folder):
    """Texts that say what failed; none where the mutant survived."""
    result = subprocess.run(
        [phlux, "verify", "--quick", "--kernel-dir", folder / "kernels", "--json", folder / "v.json", *options],
        cwd=folder, capture_output=True, text=True)
    if result.returncode not in (0, 1):
        raise SystemExit(f"verify ended with {result.returncode}: {result.stderr}")
    failed = {}
    for entry in json.loads((folder / "v.json").read_text())["results"]:
        if not entry["passed"]:
            failed.setdefault(entry["check"], []).append(entry["strategy"])
    return [f"{check} ({', '.join(names) if len(names) < 4 else f'{len(names)} strategies'})"
            for check, names in failed.items()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("phlux", help="the program")
    parser.add_argument("--device", help="as phlux verify's")
    parser.add_argument("--only", default="", help="mutants whose name holds this")
    arguments = parser.parse_args()
    phlux = str(pathlib.Path(arguments.phlux).resolve())
    options = ["--device", arguments.device] if arguments.device else []
    survivors = 0
    for name, file, old, new in MUTANTS:
        if arguments.only not in name:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            mutate(folder / "kernels", file, old, new)
            chosen = [text for strategy in strategies_of(name) for text in ("--strategy", strategy)]
            caught = caught_by(phlux, options + chosen, folder)
        survivors += not caught
        print(f"{name:45} {'; '.join(caught) or 'SURVIVED'}", flush=True)
    print(f"{survivors} survived")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
