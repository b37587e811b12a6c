"""Runs checks one after the other, keeps what each found in a folder of its own, and picks up what an earlier run has
finished.
"""

from __future__ import annotations

import json
import math
import shutil
import time
import traceback
from dataclasses import asdict, dataclass
from pathlib import Path

from ...system import keys
from ...system.whole_files import write_json
from .claims import Claim, Findings
from .registry import Bench, Check

__all__ = ["CheckResult", "run_checks"]


@dataclass
class CheckResult(Findings):
    """A finished check as the report shows it; ``plots``: (path of a PNG below the report's folder, caption)."""

    check: Check | None = None
    wall_s: float = 0.0
    error: str = ""  # why it did not finish

    @property
    def passed(self) -> bool:
        """Whether the check came to its end and all its claims hold."""
        return not self.error and super().passed


def run_checks(
    checks, out, *, quick=False, threads=1, resume=False, progress=lambda check, text: None, done=lambda result: None
):
    """Runs the checks and yields a :class:`CheckResult` for each, in order; each is on disk before the next begins.

    ``resume``: take over what an earlier run with the same ``quick``, engines and code wrote in ``out`` and finished
    without an error.
    """
    for check in checks:
        folder = Path(out) / "checks" / check.name
        result = _read(check, folder, quick) if resume else None
        if result is None:
            if not resume:  # an interrupted check may have finished parts of its own
                # first: a kill on the way must not leave it with half of what it names
                (folder / "result.json").unlink(missing_ok=True)
                shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True, exist_ok=True)
            bench = Bench(
                folder=folder, quick=quick, threads=threads, progress=lambda text, check=check: progress(check, text)
            )
            result = _run(check, bench)
            _write(result, folder, quick)
        done(result)
        yield result


def _run(check, bench):
    began = time.monotonic()
    found, error = Findings(), ""
    try:
        _clear_scene()
        found = check.run(bench)
    except Exception as problem:  # a check that stops must not take the others along
        error = f"{type(problem).__name__}: {problem}"
        (bench.folder / "error.txt").write_text(traceback.format_exc())
    finally:
        _clear_scene()
    plots = []
    for number, (figure, caption) in enumerate(found.plots):
        path = figure
        if not isinstance(figure, Path):
            path = bench.folder / f"plot-{number}.png"
            figure.savefig(path, dpi=130, bbox_inches="tight")
        plots.append((str(path.relative_to(bench.folder.parent.parent)), caption))
    return CheckResult(**{**vars(found), "plots": plots}, check=check, wall_s=time.monotonic() - began, error=error)


def _clear_scene():
    """An empty YADE scene; outside YADE there is none."""
    try:
        from yade import O
    except ImportError:
        return
    O.reset()


def _write(result, folder, quick):
    plain = {**vars(result), "claims": [_plain(c) for c in result.claims], "key": _key(result.check, quick)}
    del plain["check"]  # a function
    write_json(folder / "result.json", plain)


def _key(check, quick):
    """Of what a result is of: the check, its form, the engines and the code."""
    return keys.run_key([check.name, quick], check.run)


def _plain(claim):
    """A claim as JSON can hold it: no bound is infinite, no figure undefined."""
    return {name: None if isinstance(v, float) and not math.isfinite(v) else v for name, v in asdict(claim).items()} | {
        "passed": claim.passed
    }


def _read(check, folder, quick):
    try:
        plain = json.loads((folder / "result.json").read_text())
        if plain.pop("key") != _key(check, quick) or plain["error"]:
            return None
        missing, claims = {"measured": math.nan, "low": -math.inf, "high": math.inf}, []
        for fields in plain["claims"]:
            del fields["passed"]
            claims.append(Claim(**{k: missing[k] if v is None and k in missing else v for k, v in fields.items()}))
        return CheckResult(**{**plain, "claims": claims, "plots": [tuple(p) for p in plain["plots"]]}, check=check)
    except (OSError, ValueError, KeyError, TypeError):
        return None
