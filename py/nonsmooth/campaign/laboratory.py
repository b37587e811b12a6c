"""Tension tests from any Python: each runs in a YADE process of its own, and is opened from its folder.

    from nonsmooth import campaign
    from nonsmooth.laboratory import materials, pressing, tension_test

    rock = materials.load("wwr")
    tests = [tension_test.TensionTest(rock, pressing.Shape(500, seed)) for seed in (1, 2, 3, 4, 5)]
    runs = campaign.run_tension_tests(tests, "out/tension", threads=2)
    [run.strength["tensile_strength_Pa"] for run in runs.values()]
"""

from __future__ import annotations

from pathlib import Path

from ..studies import runs
from ..studies.laboratory import sample_runs, tension_campaign, tension_test
from ..system import output_folder

__all__ = ["run_tension_test", "run_tension_tests"]

COMMAND = "tension_test.py"  # which writes the same records


def run_tension_tests(tests, out, threads=1, resume=False) -> dict:
    """Runs laboratory.tension_test.TensionTests, as many at a time as ``threads``, each in ``out/tests/NAME``; returns
    {name: runs.TensionRun}.

    ``resume``: keep tests that have ended, and go on with others from their checkpoints. Raises CampaignError for
    arguments that make no sense, before anything runs, and where a test fails, after the others have ended; FolderError
    where another process works in the folder.
    """
    tests = sample_runs.checked(tests, out, threads, tension_test.TensionTest)
    with output_folder.claimed(out, COMMAND, resume):
        tension_campaign.run(tests, out, threads, resume)
    names = map(tension_campaign.name_of, tests)
    return {name: runs.TensionRun(Path(out) / "tests" / name) for name in names}


def run_tension_test(test, out, resume=False) -> runs.TensionRun:
    """Runs one TensionTest in the folder ``out`` itself, and opens the run. The rest as of :func:`run_tension_tests`,
    which does several side by side.
    """
    (test,) = sample_runs.checked([test], out, 1, tension_test.TensionTest)
    with output_folder.claimed(out, COMMAND, resume):
        sample_runs.run_one(test, out, tension_test.key_of(test), "studies.laboratory.tension:run", resume)
    return runs.TensionRun(out)
