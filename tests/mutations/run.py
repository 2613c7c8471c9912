#!/usr/bin/env python3
"""Puts each mistake of mutants.py into a copy of kernels/ and checks that `phlux verify --quick` detects it, or, for
light tracing and bidirectional path tracing, that the tests named with it do.

    tests/mutations/run.py PHLUX [--tests FOLDER] [--device SPEC] [--only TEXT]

Prints what detected each; the exit code is 1 if one survives. Takes some minutes, since every mutant must be compiled.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from mutants import INTEGRATOR_MUTANTS, MUTANTS

KERNELS = pathlib.Path(__file__).resolve().parents[2] / "kernels"


def mutate(folder, file, old, new):
    shutil.copytree(KERNELS, folder)
    text = (folder / file).read_text()
    if text.count(old) != 1:
        raise SystemExit(f"{file} holds {text.count(old)} times: {old}")
    (folder / file).write_text(text.replace(old, new))


def strategies_of(name):
    """The strategies whose code contains the mistake, or some of them: each must be compiled."""
    named = {"exact": ["exact"], "rejection": ["rejection"], "fold": ["fold"], "disk": ["disk"], "theta": ["theta-phi"],
             "uniform": ["cosine"], "guard": ["lobe-estimate"], "estimate": ["lobe-estimate-printed"]}
    return named.get(name.split()[0].split(":")[0].split("'")[0], ["lobe-ks", "mixture", "exact"])


def caught_by(phlux, options, folder):
    """Names of the failures; none if the mutant survived."""
    result = subprocess.run(
        [phlux, "verify", "--quick", "--kernel-dir", folder / "kernels", "--json", folder / "v.json", *options],
        cwd=folder, capture_output=True, text=True)
    if result.returncode not in (0, 1):
        raise SystemExit(f"verify ended with {result.returncode}: {result.stderr}")
    failed = {}
    for entry in json.loads((folder / "v.json").read_text())["results"]:
        if not entry["passed"]:
            failed.setdefault(entry["check"], []).append(entry.get("strategy") or entry["integrator"])
    return [f"{check} ({', '.join(names) if len(names) < 4 else f'{len(names)} strategies'})"
            for check, names in failed.items()]


def failed_tests(program, cases, device, folder):
    """Names of the failing test cases, or that of the program if it ends before it reports any."""
    environment = dict(os.environ, PHLUX_TEST_KERNELS=str(folder / "kernels"))
    if device:
        environment["PHLUX_DEVICE"] = device
    result = subprocess.run([program, cases, "--reporter", "xml"], cwd=folder, env=environment, capture_output=True, text=True)
    if "<TestCase" not in result.stdout:
        raise SystemExit(f"{program.name} has no test case {cases}: {result.stderr}")
    if result.returncode == 0:
        return []
    failed = re.findall(r'<TestCase name="([^"]*)"(?:(?!</TestCase>).)*<OverallResult success="false"', result.stdout, re.S)
    return failed or [program.name]


def verify_mutants(arguments, survivors):
    phlux = str(pathlib.Path(arguments.phlux).resolve())
    options = ["--device", arguments.device] if arguments.device else []
    for name, file, old, new, *integrator in MUTANTS:
        if arguments.only not in name:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            mutate(folder / "kernels", file, old, new)
            chosen = (["--integrator", *integrator] if integrator else
                      [text for strategy in strategies_of(name) for text in ("--strategy", strategy)])
            tell(name, caught_by(phlux, options + chosen, folder), survivors)


def integrator_mutants(arguments, survivors):
    for name, file, old, new, (program, cases) in INTEGRATOR_MUTANTS:
        if arguments.only not in name:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            mutate(folder / "kernels", file, old, new)
            tests = pathlib.Path(arguments.tests).resolve() / program
            tell(name, failed_tests(tests, cases, arguments.device, folder), survivors)


def tell(name, caught, survivors):
    if not caught:
        survivors.append(name)
    print(f"{name:60} {'; '.join(caught) or 'SURVIVED'}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("phlux", help="the program")
    parser.add_argument("--tests", help="the folder of the test programs: mistakes of the integrators too")
    parser.add_argument("--device", help="as phlux verify's")
    parser.add_argument("--only", default="", help="mutants whose name holds this")
    arguments = parser.parse_args()
    survivors = []
    verify_mutants(arguments, survivors)
    if arguments.tests:
        integrator_mutants(arguments, survivors)
    print(f"{len(survivors)} survived")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
