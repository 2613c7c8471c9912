#!/usr/bin/env python3
"""Determines which functions of the kernels remain in a scene's program after optimisation.

    live_code.py FOLDER        FOLDER: written by write_programs; the environment variable CLANG names the compiler

A function is live if its code is in the optimised program, inlined or not. To detect this, each function is compiled with a
call of a distinct undefined function, which the optimised program still contains if the function is live. Checks of each
program of a scene (WIDTH 1):

- It contains no function that only a part needs which the scene lacks. A function that only a part needs is live in programs
  with every part, and in none of those with every part except this one.
- With the bodies of the functions that are not live removed, the compiled code is the same. So a part that is added for
  other scenes does not change the code of this one.

The table marks parts without a function that only they need.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
from dataclasses import dataclass

CLANG = [os.environ.get("CLANG", "clang"), "-x", "cl", "-cl-std=CL1.2", "--target=spir64"]
MARK = "phlux_live_"
QUALIFIERS = re.compile(r"\b(?:static|inline|const|__kernel|kernel)\b|__attribute__\s*\(\(.*?\)\)")


@dataclass
class Function:
    name: str
    result: str  # type
    begin: int   # of the body, which stands in braces
    end: int


def run(command, text=None):
    result = subprocess.run(command, input=text, capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}:\n{result.stderr[:4000]}")
    return result.stdout


def preprocessed(text):
    return run([*CLANG, "-E", "-P", "-"], text)


def compiled(text):
    """LLVM's intermediate representation after optimisation."""
    return run([*CLANG, "-O1", "-Xclang", "-finclude-default-header", "-w", "-S", "-emit-llvm", "-o", "-", "-"], text)


def functions_of(text):
    """The functions that a preprocessed text defines, in order."""
    functions, depth, start, begin = [], 0, 0, 0
    for match in re.finditer(r"[{};]", text):
        at = match.start()
        if match.group() == "{":
            if depth == 0:
                begin = at
            depth += 1
            continue
        if match.group() == "}":
            depth -= 1
        if depth > 0:
            continue
        head = QUALIFIERS.sub("", text[start:begin]).strip()
        declared = re.fullmatch(r"(.*?)\b(\w+)\s*\(.*\)", head, re.S)
        if match.group() == "}" and declared:
            functions.append(Function(declared.group(2), declared.group(1).strip(), begin, at))
        if match.group() == ";" or declared:
            start = at + 1
    return functions


def marked(text, functions):
    for function in reversed(functions):
        text = f"{text[:function.begin + 1]} {MARK}{function.name}(); {text[function.begin + 1:]}"
    return "".join(f"void {MARK}{function.name}(void);\n" for function in functions) + text


def without_bodies(text, functions, names):
    """The program with these functions returning undefined values."""
    for function in reversed(functions):
        if function.name not in names:
            continue
        body = "{}" if function.result == "void" else f"{{ {function.result} undefined; return undefined; }}"
        text = text[:function.begin] + body + text[function.end + 1:]
    return text


class Program:
    def __init__(self, text):
        self.text = preprocessed(text)
        self.functions = functions_of(self.text)
        self.names = {function.name for function in self.functions}
        self.live = set(re.findall(rf"call [^\n]*@{MARK}(\w+)\(", compiled(marked(self.text, self.functions))))

    def code(self):
        return compiled(self.text)

    def hangs_on_dead_functions(self):
        return self.code() != compiled(without_bodies(self.text, self.functions, self.names - self.live))


def read(path):
    return Program(path.read_text())


def in_parallel(function, arguments):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(function, arguments))


def needed_by_one_part(folder):
    """For each part, the functions that only it needs."""
    paths = sorted(folder.glob("*/*.cl"))
    live = dict(zip(paths, in_parallel(lambda path: read(path).live, paths)))
    files = {path.parent for path in paths}
    parts = sorted({path.stem for path in paths} - {"all"})

    def live_without(part, file):
        return live[file / f"{part}.cl"] if file / f"{part}.cl" in live else live[file / "all.cl"]

    everything = set().union(*(live[file / "all.cl"] for file in files))
    return {part: everything - set().union(*(live_without(part, file) for file in files)) for part in parts}


def check_scene(line, folder, parts):
    """The program's line of the table, and its errors."""
    name, *present = line.split()
    program = read(folder / f"{name}.cl")
    wrong = [f"{name} lacks {part} and holds {', '.join(sorted(own & program.live))}"
             for part, own in parts.items() if part not in present and own & program.live]
    if program.hangs_on_dead_functions():
        wrong.append(f"{name}: functions that are not in the compiled code change it")
    return f"{name:32} {len(program.names):4} {len(program.live):4}", wrong


def check(folder):
    parts = needed_by_one_part(folder / "ablations")
    print("functions that only a part needs:")
    for part, own in parts.items():
        print(f"{part:18} {' '.join(sorted(own)) or '-'}")
    print(f"\n{'program':32}  all live")
    wrong = []
    lines = (folder / "scenes.txt").read_text().splitlines()
    for line, errors in in_parallel(lambda scene: check_scene(scene, folder, parts), lines):
        print(line)
        wrong += errors
    return wrong


SAMPLE = """
typedef struct { float x, y; } Pair;
static float of_spheres(float x) { return x > 0.0f ? exp(x) : x * x; }
static Pair pair_of(float x) { Pair p = {x, HAS_SPHERES ? of_spheres(x) : x}; return p; }
static float never(float x) { return x + 1.0f; }
static float leaks(float x) { return LEAKS ? of_spheres(x) : 0.0f; }
__kernel void sum(__global float* a) { const Pair p = pair_of(a[0]); if (HAS_SPHERES && a[2] > 0.0f) { a[3] = 1.0f; }
  a[1] = p.x + p.y + leaks(p.x); }
"""


def check_of_checks():
    """Checks the check: a part that is switched off is found dead, and one that leaks into a program is found alive."""
    def sample(spheres, leaks):
        return Program(f"#define HAS_SPHERES {spheres}\n#define LEAKS {leaks}\n{SAMPLE}")
    with_spheres, without, leaking = sample(1, 0), sample(0, 0), sample(0, 1)
    found = {
        "all functions are found": with_spheres.names == {"of_spheres", "pair_of", "never", "leaks", "sum"},
        "results are read": [f.result for f in with_spheres.functions] == ["float", "Pair", "float", "float", "void"],
        "what is used is live": with_spheres.live == with_spheres.names - {"never"},
        "what a constant rules out is dead": with_spheres.live - without.live == {"of_spheres"},
        "dead functions do not matter": not without.hangs_on_dead_functions(),
        "what leaks is live": "of_spheres" in leaking.live,
    }
    leaking.live.discard("of_spheres")
    found["a body that is used matters"] = leaking.hangs_on_dead_functions()
    return [f"check of the checks: not so: {claim}" for claim, holds in found.items() if not holds]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    wrong = check_of_checks() or check(pathlib.Path(sys.argv[1]))
    print("\n".join(["", *wrong] if wrong else []))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
