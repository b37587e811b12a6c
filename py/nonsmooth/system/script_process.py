"""A YADE script of soft contacts in a process of its own, with soft or with rigid contacts, and what it took. Needs no
YADE.
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path

from . import installation

__all__ = ["run", "tell"]

_RESULT = "NONSMOOTH_HARD_RESULT"  # the file to which the process writes what it took
_MAIN = Path(__file__).resolve().parents[1] / "world" / "hardening" / "_run_script.py"


def run(
    script,
    how,
    threads=1,
    *,
    arguments=(),
    time=None,
    steps=None,
    keep_step=False,
    damped=False,
    seeded=False,
    environment=os.environ,
    **options,
):
    """Runs ``script`` (its path, as seen from the process) with its ``arguments``; (the process that has ended, what it
    told: a dictionary, None where it did not come so far).

    ``how``: "soft" or "hard"; ``time``: most simulated time [s]; ``steps``: most steps; ``keep_step``: whether rigid
    contacts keep the step of soft ones; ``damped``: whether they have the restitution that damping leaves of springs
    (``harden(O, restitution="damping")``); ``seeded``: whether what a script draws by chance is the same in each run;
    ``options``: of :func:`subprocess.run`. Raises InstallationError and what
    :func:`subprocess.run` raises.
    """
    words = ["--how", how, "--time", "" if time is None else repr(time)]
    words += [] if steps is None else ["--steps", str(steps)]
    words += ["--keep-step"] if keep_step else []
    words += ["--damped"] if damped else []
    words += ["--seeded"] if seeded else []
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "result.json"
        # YADE's parser drops the first --
        done = subprocess.run(
            [*installation.command(threads), "--", str(_MAIN), *words, "--", str(script), *arguments],
            env={**environment, _RESULT: str(result)},
            **options,
        )
        return done, json.loads(result.read_text()) if result.exists() else None


def tell(found):
    """Within that process: writes what it took, a dictionary; False in a process that nobody waits for."""
    path = os.environ.get(_RESULT)
    if path:
        Path(path).write_text(json.dumps(found))
    return bool(path)
