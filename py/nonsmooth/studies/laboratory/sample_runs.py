"""Tests of samples side by side: checked before any begins, their samples pressed first, each in a folder of its own."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

from ...errors import UserError
from ...running import processes, side_by_side
from ...system import checks
from . import pressing

__all__ = ["CampaignError", "checked", "run", "run_one"]


class CampaignError(UserError, RuntimeError):
    """Tests that could not be run; the message says which and why."""


def checked(tests, out, threads, kind):
    """The ``tests``, a list of one or more of the class ``kind``. Raises CampaignError for anything else, and for an
    ``out`` or ``threads`` that cannot be used.
    """
    checks.path("out", out, CampaignError, "give the path of a folder for the tests")
    checks.count("threads", threads, CampaignError, "give a whole number from 1, how many run at a time")
    what = f"{kind.__module__.rpartition('.')[2]}.{kind.__name__}"
    if not isinstance(tests, Iterable) or isinstance(tests, str):
        raise CampaignError(f"tests {checks.shown(tests)}: give a list of {what}")
    tests = list(tests)
    if not tests:
        raise CampaignError(f"tests []: there is nothing to run; give one {what} or more")
    for test in tests:
        if not isinstance(test, kind):
            raise CampaignError(f"tests, {checks.shown(test)}: give a list of {what}")
    return tests


def run(made, out, threads, function, advice, resume=False, progress=lambda share, doing: None):
    """Runs tests by ``function`` ("module:function" of the package), as many at a time as ``threads``, each in
    ``out/tests/NAME``; returns their folders.

    ``made``: (name, test, key of all that it depends on) of each, a list; ``advice``: what to do where two have one
    name. The rest, and what it raises, as of :func:`.campaign.run`.
    """
    home = Path(out) / "tests"
    runs = [side_by_side.Run(name, home / name, function, asdict(test), key) for name, test, key in made]
    side_by_side.check(runs, CampaignError, advice)
    side_by_side.check_folders(runs, resume, CampaignError, go_on=True)
    _press({test.shape for _, test, _ in made}, home, threads, progress)
    side_by_side.run(
        runs,
        threads,
        resume,
        CampaignError,
        progress=lambda share, ended: progress(share, f"{len(runs)} test{'s' if len(runs) > 1 else ''}"),
        go_on=True,
    )
    folders = [one.folder for one in runs]
    for folder in folders:
        shutil.rmtree(folder / "checkpoint", ignore_errors=True)
    return folders


def run_one(test, out, key, function, resume=False):
    """The same of one test in the folder ``out`` itself."""
    one = side_by_side.Run(str(out), Path(out), function, asdict(test), key)
    side_by_side.check_folders([one], resume, CampaignError, go_on=True)
    _press({test.shape}, Path(out), 1, lambda share, doing: None)
    side_by_side.run([one], 1, resume, CampaignError, go_on=True)
    shutil.rmtree(Path(out) / "checkpoint", ignore_errors=True)


def _press(shapes, home, threads, progress):
    """Makes the samples that are not in the cache, before many tests ask for them."""
    missing = sorted(
        (s for s in shapes if pressing.CACHE.find(pressing.cache_path(s)) is None), key=lambda s: (s.seed, s.count)
    )
    if not missing:
        return
    for shape in missing:
        shape.section()  # refuses a sample that is too small, before anything runs
    progress(0.0, f"pressing {len(missing)} sample{'s' if len(missing) > 1 else ''}")
    folders = [home / f"pressing-{k}" for k in range(len(missing))]
    with processes.pool(threads) as pool:
        futures = [pool.submit(pressing.prepare, shape, folder) for shape, folder in zip(missing, folders)]
        failures = [str(error) for f in futures if (error := f.exception())]
    if failures:
        raise CampaignError(f"a sample could not be made: {failures[0]}")
