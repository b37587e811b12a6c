"""Runs the tests that should see a mutant, and says what became of it."""
import functools
import json
import re
import shutil
import time
from dataclasses import dataclass

from workplace import ROOT

# modules of checks that a mutant with checks runs: which notices which is a table of its own
LAW = ("contacts", "bonds", "impacts")
LIMIT = 300.0  # s, for the tests of one mutant

CAUGHT, CRASHED, TIMEOUT, SURVIVED, BROKEN = "caught", "crashed", "timeout", "SURVIVED", "BROKEN"


@dataclass
class Verdict:
    """What became of a mutant: ``by`` the first test that saw it, or what happened; ``noticed``: checks that do not
    hold, of those that were run.
    """

    outcome: str
    by: str = ""
    seconds: float = 0.0
    noticed: frozenset = frozenset()


def placed(test):
    """A test of pytest in YADE, "test_x.py::test_y", with the path of its file below the checkout: no two files have
    the same name.
    """
    file = test.partition("::")[0]
    return "/".join((*_folders().get(file, ("tests", "yade")), test))


@functools.cache
def _folders():
    """{name of a file of tests in YADE: parts of its folder below the checkout}."""
    return {path.name: path.relative_to(ROOT).parts[:-1] for path in (ROOT / "tests" / "yade").rglob("test_*.py")}


def split(tests):
    """Tests by kind, a dictionary: "gtest", "plain" (pytest without YADE), "yade", "check", "verify"."""
    kinds = {"gtest": [], "plain": [], "yade": [], "check": [], "verify": []}
    for test in tests:
        begin, _, rest = test.partition(":")
        if begin in ("gtest", "check", "verify"):
            kinds[begin].append(rest)
        elif begin == "plain":
            kinds["plain"].append(placed(rest))
        elif test.startswith(("fuzz/", "bindings/")):
            kinds["plain"].append(f"tests/{test}")
        else:
            kinds["yade"].append(placed(test))
    return kinds


def run(place, kinds, number, limit, *options):
    """Runs the tests of GoogleTest and of pytest and checks that stand alone, the quick kinds first: yields (kind,
    status, output); ``options``: of pytest.
    """
    if kinds["gtest"]:
        # ccache may have made the path of a test's source, by which it finds its data, one from the build folder on
        yield "gtest", *place.run(
            [place.tests, "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={':'.join(kinds['gtest'])}"],
            number,
            limit,
            place.tests.parent,
        )
    if kinds["plain"]:
        yield "plain", *place.pytest(["--noconftest", *options, *kinds["plain"]], False, number, limit)
    if kinds["yade"]:
        yield "yade", *place.pytest(["--rootdir=tests/yade", *options, *kinds["yade"]], True, number, limit)
    if kinds["verify"]:
        holds, said = verify(place, kinds["verify"], number)
        missed = [f"FAILED {name}" for name in kinds["verify"] if not holds.get(name, False)]
        yield "verify", int(bool(missed)), "\n".join([said, *missed])


def verify(place, names, number=0):
    """Runs checks, by name or module; returns ({check: holds}, output). One that is missing did not come to its end."""
    out = place.folder / "verify"
    shutil.rmtree(out, ignore_errors=True)
    status, said = place.run(
        [
            place.source / "scripts" / "yade-nonsmooth",
            "scripts/verify.py",
            "--quick",
            "--threads",
            "1",
            "--out",
            out,
            "--only",
            *names,
        ],
        number,
        LIMIT,
    )
    holds = {}
    for path in (out / "checks").glob("*/result.json"):
        result = json.loads(path.read_text())
        holds[path.parent.name] = not result["error"] and all(claim["passed"] for claim in result["claims"])
    return holds, said if status is not None else f"stopped after {LIMIT:g} s"


def sound(place, tests, checks):
    """What is wrong with the copy without a mutant: a list of words, empty where all ``tests`` pass; and {check:
    holds}.
    """
    wrong, holds = [], {}
    for kind, status, said in run(place, split(tests), 0, 20 * LIMIT):
        if status != 0:
            wrong.append(f"{kind}: tests end with status {status} on the copy without a mutant:\n{said[-3000:]}")
    if checks:
        holds, said = verify(place, checks)
        wrong += [
            f"the check {name} fails on the copy without a mutant" for name, good in holds.items() if not good
        ] or ([] if holds else [said[-3000:]])
    return wrong, holds


def judge(place, mutated, known=None, limit=LIMIT, options=()):
    """The Verdict on a mutant; ``known``: {check: holds} without one, for mutants that checks should see; ``limit`` [s]
    for its tests of a kind; ``options``: of pytest.
    """
    began = time.monotonic()
    restore = (lambda: None) if mutated.compiled else place.change(mutated)
    try:
        verdict = _verdict(place, mutated, mutated.number if mutated.compiled else 0, known, limit, options)
    finally:
        restore()
    verdict.seconds = time.monotonic() - began
    return verdict


def _verdict(place, mutated, number, known, limit, options):
    kinds = split(mutated.tests)
    for kind, status, said in run(place, kinds, number, limit, "-x", *options):
        if status is None:
            return Verdict(TIMEOUT, f"{kind}: stopped after {limit:g} s")
        # 1: a test has failed; of pytest 2 and 3 are errors of collection and of its own, 4 and 5 that there is no such
        # test
        if status == 1 and (kind == "gtest" or re.search(r"^(FAILED|ERROR) ", said, re.MULTILINE)):
            found = re.search(r"^\[  FAILED  \] (\S+)|^(?:FAILED|ERROR) (.+?)(?: - .*)?$", said, re.MULTILINE)
            return Verdict(CAUGHT, next(filter(None, found.groups()), kind) if found else kind)
        if status in (4, 5) and kind != "gtest" or re.search(r"^\[=+\] 0 tests ", said, re.MULTILINE):
            return Verdict(BROKEN, f"{kind}: no such test: {said[-300:]}")
        if status:
            return Verdict(CRASHED, f"{kind} ends with {status}: {' '.join(said.split())[-160:]}")
    if not kinds["check"]:
        return Verdict(SURVIVED)
    holds, said = verify(place, LAW, number)
    noticed = frozenset(name for name in known if not holds.get(name, False))
    missed = [name for name in kinds["check"] if name not in noticed]
    return (
        Verdict(SURVIVED, f"not noticed by {', '.join(missed)}", noticed=noticed)
        if missed
        else Verdict(CAUGHT, f"{len(noticed)} checks", noticed=noticed)
    )
