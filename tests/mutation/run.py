#!/usr/bin/env python3
"""Tests the tests: breaks the law on purpose and expects the quick verification to notice.

  tests/mutation/run.py BUILD   with BUILD the build folder of the checkout; works in BUILD/mutation

Builds one copy of the plugin with all mutants (mutants.py), runs the quick checks of single contacts, bonds and impacts on it unbroken and
with each mutant, and prints which checks notice which. Fails where the unbroken copy does, where a check that must notice does not, and
where a check notices nothing at all.
"""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from mutants import MUTANTS, apply

ROOT = Path(__file__).resolve().parents[2]
MODULES = ("contacts", "bonds", "impacts")
TOOLS = {**os.environ, "PATH": "/usr/bin:/bin:/usr/sbin"}


def fail(text):
    sys.exit(f"mutation: {text}")


def copy_sources(target):
    """The sources, with the edits; a file that did not change keeps its time, so that only what changed is built again."""
    fresh = target.with_name(target.name + ".new")
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    for name in ("CMakeLists.txt", "cmake", "pkg", "py", "scripts"):
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, fresh / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, fresh / name)
    apply(fresh / "pkg")
    for path in fresh.rglob("*"):
        old = target / path.relative_to(fresh)
        if path.is_file() and old.is_file() and old.read_bytes() == path.read_bytes():
            os.utime(path, ns=(old.stat().st_atime_ns, old.stat().st_mtime_ns))
    shutil.rmtree(target, ignore_errors=True)
    fresh.rename(target)


def build(source, folder, main_build):
    known = dict(line.split("=", 1) for line in (main_build / "CMakeCache.txt").read_text().splitlines() if "=" in line and line[0] not in "#/")
    options = [f"-D{name}={value}" for key, value in known.items() for name, _, _ in [key.partition(":")] if name in ("YADE_PREFIX", "YADE_HEADERS")]
    commands = (["cmake", "-G", "Ninja", "-S", source, "-B", folder, "-DNONSMOOTH_TESTS=OFF", "-DNONSMOOTH_BENCHMARKS=OFF", *options], ["ninja", "-C", folder])
    for command in commands:
        done = subprocess.run([str(c) for c in command], env=TOOLS, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            fail(f"the copy could not be built:\n{done.stdout[-3000:]}")


def verify(source, build_folder, out, mutant=""):
    """{check: holds} of the quick verification with a mutant; a run that ends in the middle counts as noticed by what is missing."""
    shutil.rmtree(out, ignore_errors=True)
    environment = {**os.environ, "NONSMOOTH_BUILD": str(build_folder), "NONSMOOTH_MUTANT": mutant}
    command = [source / "scripts" / "yade-nonsmooth", source / "scripts" / "verify.py", "--quick", "--out", out, "--only", *MODULES]
    done = subprocess.run([str(c) for c in command], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=1800)
    holds = {}
    for path in (out / "checks").glob("*/result.json"):
        result = json.loads(path.read_text())
        holds[path.parent.name] = not result["error"] and all(claim["passed"] for claim in result["claims"])
    if not holds:
        fail(f"the verification did not run:\n{done.stdout[-3000:]}")
    return holds


def main():
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / "CMakeCache.txt").is_file():
        fail("give the build folder of the checkout: tests/mutation/run.py build")
    main_build = Path(sys.argv[1]).resolve()
    work = main_build / "mutation"
    source, folder = work / "source", work / "build"
    copy_sources(source)
    build(source, folder, main_build)

    print("unbroken …", flush=True)
    sound = verify(source, folder, work / "unbroken")
    problems = [f"{name} fails on the unbroken copy" for name, holds in sound.items() if not holds]
    noticed = {}
    for mutant in MUTANTS:
        print(f"{mutant.name}: {mutant.broken} …", flush=True)
        holds = verify(source, folder, work / mutant.name, mutant.name)
        noticed[mutant.name] = {name for name in sound if not holds.get(name, False)}
        for name in mutant.caught_by:
            if name not in noticed[mutant.name]:
                problems.append(f"{name} does not notice the mutant {mutant.name}")
        if not noticed[mutant.name]:
            problems.append(f"nothing notices the mutant {mutant.name}")

    problems += [f"{name} notices no mutant" for name in sorted(sound) if not any(name in found for found in noticed.values())]

    width = max(map(len, sound))
    print(f"\n{'check':{width}s}  " + "  ".join(m.name for m in MUTANTS))
    for name in sorted(sound):
        print(f"{name:{width}s}  " + "  ".join(f"{'caught' if name in noticed[m.name] else '.':{len(m.name)}s}" for m in MUTANTS))
    for problem in problems:
        print(f"FAILED: {problem}")
    sys.exit(bool(problems))


main()
