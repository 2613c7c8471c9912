#!/usr/bin/env python3
"""Checks that every mistake of mutants.py still applies: that its name is unique, that the text that it replaces occurs once
in its file, and that each test that must detect it exists. Builds and runs nothing.

    tests/mutations/check.py

Prints the mistakes that do not apply; the exit code is 1 if there are any.
"""
import fnmatch
import pathlib
import re
import sys
from collections import Counter

from mutants import INTEGRATOR_MUTANTS, MUTANTS

TESTS = pathlib.Path(__file__).resolve().parents[1]
KERNELS = TESTS.parent / "kernels"
# TEST_CASE("name") or TEST_CASE("name", "[tag][tag]"); a name in several literals has all but the first left out.
TEST_CASE = re.compile(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"(?:\s*,\s*"([^"]*)")?')


def faults_of_text(name, file, old, new):
    """Reasons why `old` cannot be replaced by `new` in `file`, one line each."""
    path = KERNELS / file
    if not path.is_file():
        return [f"{name}: kernels/{file} is not there"]
    count = path.read_text().count(old)
    faults = [] if count == 1 else [f"{name}: kernels/{file} holds {count} times, not once: {old}"]
    return faults + ([f"{name}: changes nothing"] if old == new else [])


def faults_of_tests(name, program, cases):
    """Those of the comma-separated patterns that match no test case in the program's folder."""
    folder = TESTS / program.removeprefix("test_")
    found = [case for file in sorted(folder.glob("*.cpp")) for case in TEST_CASE.findall(file.read_text())]
    return [f"{name}: {program} has no test case {pattern}" for pattern in cases.split(",")
            if not any(pattern in tags if pattern.startswith("[") else fnmatch.fnmatchcase(title, pattern)
                       for title, tags in found)]


def main():
    faults = [f"{name}: the name of {count} mutants"
              for name, count in Counter(m[0] for m in MUTANTS + INTEGRATOR_MUTANTS).items() if count > 1]
    for mutant in MUTANTS + INTEGRATOR_MUTANTS:
        faults += faults_of_text(*mutant[:4])
    for mutant in INTEGRATOR_MUTANTS:
        faults += faults_of_tests(mutant[0], *mutant[4])
    print("\n".join(faults) or f"{len(MUTANTS) + len(INTEGRATOR_MUTANTS)} mutants apply")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
