"""One script in a process of its own, bounded in steps, and what became of it."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from ...system import script_process

__all__ = ["OUTCOMES", "run"]

#: What can become of a script.
OUTCOMES = ("runs", "differs", "overlaps", "refused", "lacks", "stopped", "fails")
CHECKS = 3  # times as long a check may take
MOST_OVERLAP = 0.01  # radii, of a script that "runs"
_REFUSALS = (
    "HardenError",
    "ContactDynamicsEngine:",
    "NscdInteractionLoop:",
    "PlanarGridCollider:",
    "PlanarNewtonIntegrator:",
    "SpatialNewtonIntegrator:",
)


def run(script, sources, how="hard", steps=None, time=None, limit=120):
    """Runs ``script`` (its path in the folder ``sources``) in a copy of its folder; a dictionary of

    ``outcome``: one of OUTCOMES, ``message``: of a refusal or an error, ``found``: numbers at its end, where it got so
    far. ``how``: "hard" or "soft"; ``steps``: most steps, ``time``: most simulated time [s]; ``limit``: wall time [s].
    """
    home = Path(sources) / script
    check = "checks" in home.parts  # they compare numbers at the times of their own steps, at their own end
    limit *= CHECKS if check and how == "hard" else 1
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "scripts"
        shutil.copytree(home.parent, place)
        try:
            done, found = script_process.run(
                home.name,
                how,
                time=time,
                steps=None if check else steps,
                keep_step=check,
                damped=True,
                seeded=True,
                environment={**os.environ, "MPLBACKEND": "Agg", "OMP_WAIT_POLICY": "passive"},
                cwd=place,
                stdin=subprocess.DEVNULL,
                timeout=limit,
                capture_output=True,
                text=True,
                errors="replace",
            )
        except subprocess.TimeoutExpired:
            return {"script": script, "outcome": "stopped", "message": f"after {limit} s of wall time", "found": None}
    said, status = f"{done.stdout}\n{done.stderr}", done.returncode
    message = _last_error(said)
    if status == 0 and found:
        outcome, message = "runs" if found["largest overlap [radii]"] < MOST_OVERLAP else "overlaps", ""
    elif any(name in message for name in _REFUSALS):
        outcome = "refused"
    elif "YadeCheckError" in message:
        outcome = "differs"
    else:
        outcome, message = "fails", message or f"status {status}"
        # what the script asks for and this YADE or this machine has not, whatever its contacts
        if how == "hard" and run(script, sources, "soft", steps=1, time=time, limit=limit)["message"] == message:
            outcome = "lacks"
    return {"script": script, "outcome": outcome, "message": message, "found": found}


def _last_error(text):
    """The last line of a traceback, without the class's module."""
    lines = [line for line in text.strip().split("\n") if re.match(r"[\w.]*(Error|Exception|Warning|Exit)\b", line)]
    return re.sub(r"^[\w.]*\.(?=\w+(Error|Exception))", "", lines[-1]) if lines else ""
