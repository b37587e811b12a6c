"""Programs of the project as processes of their own, as a user starts them from a shell."""
import os
import resource
import signal
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
PREFIX = Path(os.environ["YADE_PREFIX"])
BUILD = PREFIX.parent


def environment(**changes):
    """A user's, with the build under test; commands that are not told how many threads to take have as many as this
    process.
    """
    return {**os.environ, "NONSMOOTH_BUILD": str(BUILD), **changes}


def run(program, *arguments, limit=600, cwd=None, given=None, **changes):
    """Runs a program, one of scripts/ by its name, to its end; ``given``: by standard input; ``changes``: of the
    environment; ``limit`` [s].

    Returns a subprocess.CompletedProcess with text."""
    if (SCRIPTS / program).exists():
        program = SCRIPTS / program
    return subprocess.run(
        [str(word) for word in (program, *arguments)],
        env=environment(**changes),
        cwd=cwd,
        input=given,
        text=True,
        capture_output=True,
        timeout=limit,
    )


def example(script, cwd, /, **values):
    """Runs one of scripts/examples in the folder ``cwd``, with ``values`` of its table as they stand there (texts in quotes).
    Returns a subprocess.CompletedProcess with text.
    """
    table = Path(cwd) / "values.table"
    table.write_text(f"{' '.join(values)}\n{' '.join(map(str, values.values()))}\n")
    return run("yade-nonsmooth", SCRIPTS / "examples" / script, limit=300, cwd=cwd, YADE_BATCH=f"{table}:2")


def batch(table, script, folder, log):
    """yade-batch in a folder, one job after the other, with the lines of a table; ``log``: of each, "@" its name.
    Returns a subprocess.CompletedProcess with text.
    """
    kept = {k: v for k, v in os.environ.items() if k not in ("OMP_NUM_THREADS", "YADE_BATCH")}
    command = [PREFIX / "bin" / "yade-batch", "-j1", "--log", log, table, script]
    return subprocess.run(command, cwd=folder, env=kept, text=True, capture_output=True, timeout=300)


def start(name, *arguments, limit=None, **changes):
    """A command that goes on beside the test; ``limit``: of the size of its files [bytes]; ``changes``: of the
    environment.
    """

    def prepare():
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # tests in the background ignore it, and so would what they start
        if limit:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    return subprocess.Popen(
        [SCRIPTS / name, *map(str, arguments)],
        env=environment(**changes),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=prepare,
    )


def ended(process):
    """Status, output and lines on stderr as a file holds them: a progress bar goes back to the begin of its line."""
    out, said = process.communicate(timeout=600)
    assert "Traceback" not in said and "Traceback" not in out, said
    return process.returncode, out, said.split("\n")


def wait_for(found, process):
    """Until ``found()`` is true; a process that ends before is a failure."""
    while not found():
        assert process.poll() is None, process.communicate()
        time.sleep(0.05)
