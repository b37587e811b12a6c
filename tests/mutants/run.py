#!/usr/bin/env python3
"""Tests the tests: breaks the software on purpose, one line at a time, and expects the tests beside it to notice.

  tests/mutants/run.py [BUILD] [--all | --only NAME …] [--base COMMIT] [--workers N]

BUILD is the build folder of the checkout (default: build); all is done in copies in BUILD/mutants. Without --all some
thirty mutants are tried: those of the law at large, of files that have changed since --base (default: where the branch
left main, on main the commit before), and some of all others. The status is 1 where a mutant survives that is not among
those known to, where the copy without mutants fails, or where a mutant cannot be applied. What became of each stands in
BUILD/mutants/verdicts.json too.
"""
import argparse
import random
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import judge as judging
from mutant import TableError, place as look_up
from mutants import KNOWN, MUTANTS
from workplace import ROOT, BuildError, Place, build, mutated_sources, share

sys.path.insert(0, str(ROOT / "py"))
from nonsmooth.system.whole_files import write_json

COUNT = 30  # mutants of the quick part
OUTCOMES = (judging.CAUGHT, judging.CRASHED, judging.TIMEOUT, judging.SURVIVED, judging.BROKEN)


def read_arguments():
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "build",
        nargs="?",
        default=ROOT / "build",
        type=Path,
        metavar="BUILD",
        help="build folder of the checkout (default: build)",
    )
    parser.add_argument("--all", action="store_true", help="all mutants")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these mutants")
    parser.add_argument("--base", metavar="COMMIT", help="the quick part looks at what has changed since")
    parser.add_argument("--workers", type=int, default=2, metavar="N", help="tests at a time (default: %(default)s)")
    parser.add_argument("--list", action="store_true", help="names the mutants and ends")
    args = parser.parse_args()
    unknown = set(args.only or ()) - {m.name for m in MUTANTS}
    if unknown:
        parser.error(f"--only {' '.join(sorted(unknown))}: there is no such mutant; --list names them")
    if not args.list and not (args.build / "CMakeCache.txt").is_file():
        parser.error(f"{args.build}: is no build folder; run scripts/setup.sh --tests first, or give one")
    return args


def git(*words):
    """Lines that git says in the checkout; none where it cannot, or is not there."""
    try:
        done = subprocess.run(["git", "-C", ROOT, *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    except FileNotFoundError:
        return []
    return done.stdout.split("\n")[:-1] if done.returncode == 0 else []


def changed(base):
    """Files that have changed since ``base``, committed or not; none where there is no git."""
    if base is None:
        here, left = git("rev-parse", "HEAD"), git("merge-base", "HEAD", "main") or git(
            "merge-base", "HEAD", "origin/main"
        )
        base = left[0] if left and left != here else "HEAD~1"
    return set(git("diff", "--name-only", base))


def quick(files):
    """The mutants of the quick part: those that checks judge, then those of changed ``files`` or of tests that have
    changed, then some of all.
    """
    dice = random.Random(1)  # the same ones for the same change
    chosen = [m for m in MUTANTS if any(t.startswith("check:") for t in m.tests)]
    fast = [m for m in MUTANTS if not m.slow and m not in chosen]
    near = [
        m
        for m in fast
        if m.files & files or any(judging.placed(t.removeprefix("plain:")).partition("::")[0] in files for t in m.tests)
    ]
    chosen += near if len(near) <= COUNT - len(chosen) else dice.sample(near, COUNT - len(chosen))
    others = [m for m in fast if m not in chosen]
    wanted = max(0, COUNT - len(chosen))
    chosen += [others[k * len(others) // wanted] for k in range(wanted)] if wanted < len(others) else others
    return [m for m in MUTANTS if m in chosen]


def built(work, main_build, chosen):
    """The build with all mutants of the C++, as far as the ``chosen`` ones need it; else that of the checkout."""
    if not any(m.compiled for m in chosen):
        return main_build
    began = time.monotonic()
    mutated_sources(work / "source", MUTANTS)
    targets = ["nonsmooth_gate", "nonsmooth_engines"]
    targets += [f"nonsmooth_{name}_module" for name in ("contact", "slip", "packing")]
    targets += ["contact_tests"] * any(t.startswith("gtest:") for m in chosen for t in m.tests)
    build(work / "source", work / "build", main_build, targets)
    print(f"built the copy with the mutants of the C++, {time.monotonic() - began:.0f} s", flush=True)
    return work / "build"


def sound(places, chosen):
    """{check: holds} without a mutant; ends where a test that should see a mutant fails on the copy without one."""
    files = {}
    for m in chosen:
        for test in m.tests:
            if not test.startswith("check:"):
                # a file's tests in one place, for what they share
                files.setdefault(test.partition("::")[0], set()).add(test)
    parts = [[] for _ in places]
    for k, tests in enumerate(sorted(files.values(), key=len, reverse=True)):
        parts[k % len(parts)] += sorted(tests)
    checks = judging.LAW if any(t.startswith("check:") for m in chosen for t in m.tests) else ()
    with ThreadPoolExecutor(len(places)) as pool:
        found = list(
            pool.map(lambda k: judging.sound(places[k], parts[k], checks if k == 0 else ()), range(len(places)))
        )
    wrong = [line for lines, _ in found for line in lines]
    if wrong:
        sys.exit("mutation: " + "\n".join(wrong))
    return found[0][1]


def try_all(places, chosen, known):
    """{mutant: Verdict}, printed one by one."""

    def one(place, mutated):
        verdict = judging.judge(place, mutated, known)
        print(
            f"{verdict.outcome:9s} {verdict.seconds:5.1f} s  {mutated.name}: {mutated.broken}  [{verdict.by}]",
            flush=True,
        )
        return verdict

    return dict(share(places, chosen, one))


def show_checks(verdicts, known):
    """The table of checks that notice mutants; returns what is wrong with it."""
    law = {m: v for m, v in verdicts.items() if any(t.startswith("check:") for t in m.tests)}
    if not law:
        return []
    width = max(map(len, known))
    print(f"\n{'check':{width}s}  " + "  ".join(m.name for m in law))
    for name in sorted(known):
        print(
            f"{name:{width}s}  "
            + "  ".join(f"{'caught' if name in v.noticed else '.':{len(m.name)}s}" for m, v in law.items())
        )
    whole = len(law) == sum(any(t.startswith("check:") for t in m.tests) for m in MUTANTS)
    return [
        f"the check {name} notices no mutant"
        for name in sorted(known)
        if whole and not any(name in v.noticed for v in law.values())
    ]


def write(path, verdicts, counts, seconds):
    """What became of the mutants as JSON, with the commit."""
    found = {
        "commit": (git("rev-parse", "HEAD") or [None])[0],
        "changed_since": bool(git("status", "--porcelain", "--untracked-files=no")),
        "table": len(MUTANTS),
        "tried": len(verdicts),
        "wall_s": seconds,
        **{name.lower(): count for name, count in counts.items()},
        "known_to_survive": len(KNOWN),
        "mutants": [
            {"name": m.name, "file": m.edits[0][0], "broken": m.broken, "outcome": v.outcome.lower(), "by": v.by}
            for m, v in verdicts.items()
        ],
    }
    write_json(path, found)


def main():
    args, began = read_arguments(), time.monotonic()
    if args.list:
        for m in MUTANTS:
            print(f"{m.name:32s} {m.edits[0][0]:42s} {m.broken}{'  (slow)' if m.slow else ''}")
        return
    try:
        twice = sorted(name for name, count in Counter(m.name for m in MUTANTS).items() if count > 1)
        if twice:
            raise TableError(f"mutants have one name: {', '.join(twice)}; rename one of each")
        for m in MUTANTS:
            for file, old, _ in m.edits:
                look_up(ROOT, m, file, old)
        chosen = (
            [m for m in MUTANTS if m.name in args.only]
            if args.only
            else list(MUTANTS)
            if args.all
            else quick(changed(args.base))
        )
        main_build = args.build.resolve()
        work = main_build / "mutants"
        work.mkdir(exist_ok=True)
        libraries = built(work, main_build, chosen)
    except (TableError, BuildError) as error:
        sys.exit(f"mutation: {error}")
    places = [Place(work / f"place-{k}", libraries, main_build) for k in range(max(1, min(args.workers, len(chosen))))]
    try:
        known = sound(places, chosen)
        print(f"the copy without mutants passes, {time.monotonic() - began:.0f} s", flush=True)
        verdicts = try_all(places, chosen, known)
    finally:
        for place in places:
            place.close()

    problems = show_checks(verdicts, known)
    counts = {outcome: sum(v.outcome == outcome for v in verdicts.values()) for outcome in OUTCOMES}
    seconds = round(time.monotonic() - began)
    print(
        f"\n{len(verdicts)} mutants of {len(MUTANTS)}: {', '.join(f'{count} {outcome}' for outcome, count in counts.items())}; {seconds} s"
    )
    write(work / "verdicts.json", verdicts, counts, seconds)
    for m, v in verdicts.items():
        if v.outcome in (judging.SURVIVED, judging.BROKEN):
            if m.name in KNOWN and v.outcome == judging.SURVIVED:
                print(f"survives, as is known: {m.name} ({m.broken}): {KNOWN[m.name]}")
            else:
                problems.append(f"{v.outcome}: {m.name} ({m.broken}), {', '.join(m.tests)}. {v.by}")
    for problem in problems:
        print(f"FAILED: {problem}")
    sys.exit(bool(problems))


main()
