#!/usr/bin/env python3
"""Runs the scripts of bench/PYTHON.md whose modules this Python has.

    python_page.py PROGRAM SOURCE

PROGRAM is the built phlux, SOURCE the folder of the sources. The exit code is 77 (skipped) if none can be run.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SKIPPED = 77


def works(statement):
    return subprocess.run([sys.executable, "-c", statement], capture_output=True).returncode == 0


def commands(page, start):
    return [line.split() for line in re.findall("^    (.*)$", page, re.M) if line.startswith(start)]


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    page = (source / "bench/PYTHON.md").read_text()
    scripts = re.findall("^```python\n(.*?)^```$", page, re.M | re.S)
    render, = commands(page, "./phlux render")
    uses = commands(page, "reading/bin/python ")
    needs = ["import numpy, OpenEXR; OpenEXR.File", "import matplotlib"]
    if not len(scripts) == len(uses) == len(needs):
        sys.exit(f"{len(scripts)} scripts, {len(uses)} commands")
    done = 0
    with tempfile.TemporaryDirectory() as folder:
        for name in ("bench", "scenes"):
            (pathlib.Path(folder) / name).symlink_to(source / name)
        subprocess.run([program, *render[1:], "--size", "32x32", "-n", "8"], check=True, cwd=folder)
        for script, use, need in zip(scripts, uses, needs):
            if not works(need):
                print("skipped, as this fails:", need)
                continue
            (pathlib.Path(folder) / use[1]).write_text(script)
            subprocess.run([sys.executable, *use[1:]], check=True, cwd=folder)
            done += 1
        if works(needs[1]) and not (pathlib.Path(folder) / uses[1][-1]).stat().st_size:
            sys.exit("no chart")
    sys.exit(0 if done else SKIPPED)


main()
