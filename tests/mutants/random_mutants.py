#!/usr/bin/env python3
"""Breaks the software by chance, one token at a time, and says which of these mistakes no test sees.

  tests/mutants/random_mutants.py [BUILD] [--cpp] [--count N] [--seed S] [--only MODULE …] [--plain] [--resume] [--survivors] [--list]

A mutant is one comparison turned, one sign, index, constant or name changed, or one condition dropped, in the Python
package outside `verification`, or in pkg/dem with --cpp. The files of tests that import the module judge it, the
nearest first, until one fails; in C++ those that the table of mutants names for the file, and those that name what it
defines. What ends a process or does not come to its end is caught too. Results are kept in BUILD/random_mutants as they
come.

The status is 1 where less than 92 % are caught. A survivor gets a test of the right answer; one that computes the same
gets a line in same.py.
"""
import argparse
import dataclasses
import json
import re
import sys
import time
import zlib

import judge as judging
from changes import as_mutant, chosen
from cpp_changes import changes as changes_of_cpp
from mutant import SYMBOL, TableError
from near_tests import PACKAGE, NearTests
from python_changes import changes as changes_of_python
from tqdm import tqdm
from workplace import ROOT, BuildError, Place, build, mutated_sources, share

sys.path.insert(0, str(ROOT / "py"))
from nonsmooth.system.whole_files import write_json

PLAIN = ("plain:", "gtest:", "bindings/", "fuzz/")  # begin of the names of tests that need no YADE
LEAST = 0.92  # share that is to be caught
SHORTEST = 60.0  # s, for a file of tests, or five times what it takes without a mutant
BUDGET = 240.0  # s, for all files that judge a mutant; what is left then is not asked
LONG = 30.0  # s; files known to take longer are asked last
SOUND_LIMIT = 900.0  # s, for a file without a mutant
GATE = "pkg/dem/checks/LayoutCheck.cpp"  # a library of its own, which YADE loads before the one that has the switch


def read_arguments():
    parser = argparse.ArgumentParser(prog="random_mutants.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "build",
        nargs="?",
        default=ROOT / "build",
        metavar="BUILD",
        help="build folder of the checkout (default: build)",
    )
    parser.add_argument("--cpp", action="store_true", help="mutants of pkg/dem instead of the package's; builds a copy")
    parser.add_argument("--count", type=int, default=300, metavar="N", help="how many (default: %(default)s)")
    parser.add_argument(
        "--seed", type=int, default=1, metavar="S", help="other mutants for each seed (default: %(default)s)"
    )
    parser.add_argument(
        "--only",
        nargs="+",
        metavar="MODULE",
        help="of these modules (laboratory.strength) or files (pkg/dem/walls/Arc.cpp)",
    )
    parser.add_argument(
        "--resume", action="store_true", help="goes on: those that were judged before keep their verdicts"
    )
    parser.add_argument(
        "--survivors", action="store_true", help="tries those again that survived before, and keeps all other verdicts"
    )
    parser.add_argument(
        "--plain",
        action="store_true",
        help="asks only tests that need no YADE, some seconds each, about modules that they import",
    )
    parser.add_argument(
        "--budget", type=float, default=BUDGET, metavar="S", help="seconds of tests for a mutant (default: %(default)g)"
    )
    parser.add_argument("--workers", type=int, default=1, metavar="N", help="mutants at a time (default: %(default)s)")
    parser.add_argument(
        "--list", action="store_true", help="shows the mutants and the tests that would judge them, and ends"
    )
    args = parser.parse_args()
    args.build = ROOT / args.build
    if args.count < 1 or args.workers < 1:
        parser.error(f"--count {args.count} --workers {args.workers}: give 1 or more of either")
    if not args.list and not (args.build / "CMakeCache.txt").is_file():
        parser.error(f"{args.build}: is no build folder; run scripts/setup.sh first, or give one")
    return parser, args


def sources(cpp):
    """Files that may be changed, below the checkout, sorted."""
    if cpp:
        found = [path for ending in ("*.cpp", "*.hpp") for path in (ROOT / "pkg" / "dem").rglob(ending)]
    else:
        found = [path for path in (ROOT / PACKAGE).rglob("*.py") if "verification" not in path.parts]
    return sorted({path.relative_to(ROOT).as_posix() for path in found} - {GATE})


def files_of(parser, args):
    """The files that --only names, all without it."""
    every = sources(args.cpp)
    if not args.only:
        return every
    named = [word if "/" in word else (PACKAGE / word.replace(".", "/")).as_posix() for word in args.only]
    found = [f for f in every if any(f in (n, f"{n}.py") or f.startswith(f"{n}/") for n in named)]
    for word, name in zip(args.only, named):
        if not any(f in (name, f"{name}.py") or f.startswith(f"{name}/") for f in every):
            parser.error(
                f"--only {word}: there is no such file; give a module as laboratory.strength, or a file as pkg/dem/walls/Arc.cpp with --cpp"
            )
    return found


def pick(args, files, near, again, refused=()):
    """[(Change, Mutant)] in the order of their trial: those of the digests ``again``, or without any at most as many as
    are asked for; none of the digests ``refused``."""
    of = changes_of_cpp if args.cpp else changes_of_python
    picked, spans = [], {}
    for one in chosen([c for f in files for c in of(f, (ROOT / f).read_text())], args.seed):
        # one switch cannot stand within another
        others = spans.setdefault(one.file, set())
        if args.cpp and any(one.reach != r and one.reach[0] < r[1] and r[0] < one.reach[1] for r in others):
            continue
        if one.digest in refused or (again and one.digest not in again):
            continue
        tests = [t for t in near.of(one.file, one.scope) if not args.plain or t.startswith(PLAIN)]
        mutated = as_mutant(one, ROOT, tests) if tests else None
        if mutated:
            others.add(one.reach)
            picked.append((one, mutated))
        if not again and len(picked) == args.count:
            break
    return picked


def compiled(work, main_build, picked):
    """The build of a copy with the mutants of C++, and those of them that the compiler takes."""
    targets = ["nonsmooth_gate", "nonsmooth_engines"]
    targets += [f"nonsmooth_{name}_module" for name in ("contact", "slip", "packing")]
    while True:
        mutated_sources(work / "source", [m for _, m in picked])
        try:
            build(work / "source", work / "build", main_build, targets, "-k", "0")
            return work / "build", picked
        except BuildError as error:
            refused = refused_by(work / "source", error.said)
            if not refused & {m.number for _, m in picked}:
                raise
            print(f"{len(refused)} are none to the compiler and are left out", flush=True)
            picked = [(c, m) for c, m in picked if m.number not in refused]


def refused_by(source, said):
    """Numbers of the mutants in the lines of which the compiler complains."""
    refused = set()
    for path, line in set(re.findall(r"^(\S*pkg/\S+?):(\d+):\d+: (?:fatal )?error", said, re.MULTILINE)):
        text = (source / path[path.rindex("pkg/") :]).read_text().splitlines()
        for above in range(int(line) - 1, max(-1, int(line) - 8), -1):
            numbers = re.findall(rf"{SYMBOL} == (\d+)", text[above])
            refused |= set(map(int, numbers))
            if numbers:
                break
    return refused


class Judge:
    """Asks the files of tests about one mutant after the other; what fails without one too is not asked again."""

    def __init__(self, sound, budget, near):
        self.sound, self.budget, self.near = sound, budget, near

    def __call__(self, place, mutated):
        """(Verdict, number of files that were not asked)."""
        spent = 0.0
        for k, test in enumerate(sorted(mutated.tests, key=lambda t: self.sound.get(t, {}).get("seconds", 0) > LONG)):
            if spent > self.budget:
                return judging.Verdict(judging.SURVIVED, seconds=spent), len(mutated.tests) - k
            verdict = self._ask(place, mutated, test)
            spent += verdict.seconds
            if verdict.outcome not in (judging.SURVIVED, judging.BROKEN):
                verdict.seconds = spent
                return verdict, 0
        return judging.Verdict(judging.SURVIVED, seconds=spent), 0

    def _ask(self, place, mutated, test):
        """The Verdict of one file of tests."""
        known, spent = self._known(test), 0.0
        while True:
            options = [word for name in known["failing"] for word in ("--deselect", name)]
            limit = max(SHORTEST, 5 * known["seconds"]) if known["seconds"] else judging.LIMIT
            verdict = judging.judge(place, dataclasses.replace(mutated, tests=(test,)), None, limit, options)
            spent, verdict.seconds = spent + verdict.seconds, spent + verdict.seconds
            if verdict.outcome == judging.SURVIVED:
                known["seconds"] = max(known["seconds"], verdict.seconds)
            # a file that does not come to its end without a mutant says nothing
            elif verdict.outcome in (judging.CRASHED, judging.TIMEOUT) and not self._ends(place, test):
                return judging.Verdict(judging.SURVIVED, seconds=spent)
            elif verdict.outcome == judging.CAUGHT and not self._passes(place, test, verdict.by):
                if verdict.by in known["failing"]:
                    raise RuntimeError(f"{verdict.by} fails without a mutant, and pytest does not leave it out")
                # by the folder of the file, or that of the checkout, whichever pytest begins names with
                known["failing"] += [verdict.by, re.sub(r".*tests/\w+/", "", verdict.by)]
                continue
            return verdict

    def _known(self, test):
        """What is known of a file as it is now: {"seconds", "failing", "passing", "ends"}."""
        text = zlib.crc32(self.near.texts[test].encode())
        if self.sound.get(test, {}).get("text") != text:
            self.sound[test] = {"text": text, "seconds": 0.0, "failing": [], "passing": [], "ends": None}
        return self.sound[test]

    def _ends(self, place, test):
        """Whether a file comes to its end without a mutant."""
        known = self._known(test)
        if known["ends"] is None:
            began = time.monotonic()
            known["ends"] = all(
                status in (0, 1) for _, status, _ in judging.run(place, judging.split([test]), 0, SOUND_LIMIT)
            )
            known["seconds"] = max(known["seconds"], time.monotonic() - began)
        return known["ends"]

    def _passes(self, place, test, name):
        """Whether one test of a file passes without a mutant."""
        known = self._known(test)
        if name not in known["passing"]:
            kinds = {kind: [name] if tests else [] for kind, tests in judging.split([test]).items()}
            if any(status for _, status, _ in judging.run(place, kinds, 0, SOUND_LIMIT)):
                return False
            known["passing"].append(name)
        return True


def row(one, verdict, unasked, tests):
    """What is kept of a mutant."""
    return {
        "digest": one.digest,
        "place": one.place,
        "scope": one.scope,
        "kind": one.kind,
        "before": one.before,
        "after": one.after,
        "outcome": verdict.outcome,
        "by": verdict.by,
        "seconds": round(verdict.seconds, 1),
        "tests": len(tests),
        "not_asked": unasked,
    }


def line(found):
    """A row of the table that is printed."""
    left = f"  ({found['not_asked']} of {found['tests']} files not asked)" if found["not_asked"] else ""
    return f"{found['outcome']:9s} {found['seconds']:6.1f} s  {found['place']}  {found['before']} → {found['after']}  [{found['by']}]{left}"


def kept(path):
    """What an earlier call has kept: {test: what is known of it}, {digest: row}, and the digests that the compiler
    refuses.
    """
    try:
        found = json.loads(path.read_text())
    except FileNotFoundError:
        found = {"sound": {}, "mutants": []}
    except ValueError as error:
        sys.exit(f"mutation: {path} cannot be read ({error}); remove it, and all mutants are tried again")
    return found["sound"], {m["digest"]: m for m in found["mutants"]}, set(found.get("refused", ()))


def main():
    parser, args = read_arguments()
    near = NearTests(ROOT)
    work = args.build.resolve() / "random_mutants"
    path = work / ("cpp.json" if args.cpp else "python.json")
    sound, before, refused = kept(path)
    if args.survivors and not before:
        parser.error(f"--survivors: {path} holds no verdicts; run without it first")
    picked = pick(args, files_of(parser, args), near, before if args.survivors else (), refused)
    if args.list:
        for one, mutated in picked:
            print(f"{one.place}  {one.scope}  {one.says}  [{', '.join(mutated.tests)}]")
        return 0
    work.mkdir(exist_ok=True)
    known = old = before if args.resume or args.survivors else {}
    if args.survivors:
        known = {digest: m for digest, m in old.items() if m["outcome"] != judging.SURVIVED}
    libraries = args.build.resolve()
    try:
        if args.cpp:
            asked = {one.digest for one, _ in picked}
            libraries, picked = compiled(work, libraries, picked)
            refused |= asked - {one.digest for one, _ in picked}  # a later call need not build with them again
    except (TableError, BuildError) as error:
        sys.exit(f"mutation: {error}")
    waiting = [(one, mutated) for one, mutated in picked if one.digest not in known]
    rows = [known[one.digest] for one, _ in picked if one.digest in known]
    judge = Judge(sound, args.budget, near)
    places = [
        Place(work / f"place-{k}", libraries, args.build.resolve())
        for k in range(max(1, min(args.workers, len(waiting))))
    ]
    try:
        with tqdm(total=len(picked), initial=len(rows), unit="mutant") as bar:
            for (one, mutated), (verdict, unasked) in share(places, waiting, lambda place, item: judge(place, item[1])):
                rows.append(row(one, verdict, unasked, mutated.tests))
                # what waits to be tried again keeps its verdict, also where this call is stopped
                left = [m for digest, m in old.items() if digest not in {r["digest"] for r in rows}]
                write_json(
                    path, {"seed": args.seed, "sound": sound, "mutants": rows + left, "refused": sorted(refused)}
                )
                tqdm.write(line(rows[-1]))
                bar.update()
    except KeyboardInterrupt:
        print(f"stopped; --resume goes on with what is kept in {path}", file=sys.stderr)
        return 130
    finally:
        for place in places:
            place.close()
    return report(rows)


def report(rows):
    """Prints the table of survivors and the shares; returns the status."""
    survivors = [r for r in rows if r["outcome"] == judging.SURVIVED]
    caught = len(rows) - len(survivors)
    print("\nsurvivors:" if survivors else "\nno survivors")
    for found in survivors:
        print(line(found))
    kinds = sorted({r["kind"] for r in rows})
    shares = [(k, [r for r in rows if r["kind"] == k]) for k in kinds]
    print("\n" + ", ".join(f"{k} {sum(r['outcome'] != judging.SURVIVED for r in of)} of {len(of)}" for k, of in shares))
    print(f"{caught} of {len(rows)} caught ({caught / max(1, len(rows)):.1%}), {LEAST:.0%} wanted")
    return int(caught < LEAST * len(rows))


if __name__ == "__main__":
    sys.exit(main())
