"""Programs of the project as processes of their own, as a user starts them from a shell."""
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
PREFIX = Path(os.environ["YADE_PREFIX"])
BUILD = PREFIX.parent


def environment(**changes):
    """A user's, with the build under test; commands that are not told how many threads to take have as many as this process."""
    return {**os.environ, "NONSMOOTH_BUILD": str(BUILD), **changes}


def run(program, *arguments, limit=600, cwd=None, **changes):
    """Runs a program, one of scripts/ by its name, to its end; ``changes``: of the environment; ``limit`` [s].

    Returns a subprocess.CompletedProcess with text."""
    if (SCRIPTS / program).exists():
        program = SCRIPTS / program
    return subprocess.run(
        [str(word) for word in (program, *arguments)],
        env=environment(**changes),
        cwd=cwd,
        text=True,
        capture_output=True,
        timeout=limit,
    )
