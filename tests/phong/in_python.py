"""Runs kernels/phong/example.py; if a module is missing, names it and exits with 77."""
import importlib.util
import pathlib
import runpy
import sys

for module in ("numpy", "pyopencl"):
    if importlib.util.find_spec(module) is None:
        print(f"skipped: Python has no {module}")
        sys.exit(77)
kernels = pathlib.Path(__file__).resolve().parent.parent.parent / "kernels"
sys.exit(runpy.run_path(str(kernels / "phong" / "example.py"))["main"]())
