"""Calls of this package's functions in YADE processes of their own.

Small scenes gain little from threads, so runs side by side use a machine better. Each process has one thread unless
more are asked for.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from ..errors import UserError
from ..system import installation
from ..system.whole_files import write_json

__all__ = ["RunError", "call", "named", "pool"]

_PACKAGE = __package__.rpartition(".")[0]
_WORKER = Path(__file__).with_name("_process_worker.py")
_running, _halted, _guard = set(), False, threading.Lock()  # processes of this one; whether no more may begin


class RunError(UserError, RuntimeError):
    """A run that ended without a result. The message is the run's own where it refused (a UserError), else its status
    and the last line of its output.
    """


def call(function, folder, arguments, threads=1):
    """Calls ``function(folder, **arguments)`` in a process and returns what it returned, with ``wall_s`` [s] added
    where it has none.

    ``function``: of a module of this package, or its name, as "studies.laboratory.biaxial:run", where the module needs
    YADE and this process has none; it returns a dictionary that JSON can hold. ``folder`` exists and is kept; the
    process writes ``log.txt`` and ``found.json`` there. ``arguments``: what JSON can hold; ``threads``: of the process.
    Raises RunError where it fails.
    """
    folder, began = Path(folder), time.monotonic()
    request = folder / "request.json"
    write_json(request, {"function": named(function), "arguments": arguments, "parent": os.getpid()})
    for name in ("found.json", "refused.txt"):
        (folder / name).unlink(missing_ok=True)
    # the log's last line is to be the last that was said: standard output unbuffered, as errors are
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    if threads == 1:  # waiting threads must not spin where processes share the cores
        environment["OMP_WAIT_POLICY"] = "passive"
    with open(folder / "log.txt", "wb") as log:
        status = _run(
            [*installation.command(threads), str(_WORKER), str(folder)],
            stdout=log,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            env=environment,
        )
    try:
        found = json.loads((folder / "found.json").read_text())
    except (OSError, ValueError):
        if (folder / "refused.txt").exists():
            raise RunError((folder / "refused.txt").read_text()) from None
        lines = (folder / "log.txt").read_text(errors="replace").split("\n")
        last = next((line.strip() for line in reversed(lines) if line.strip()), "no output")
        raise RunError(
            f"the run ended with status {status} and no result: {last} (all of it: {folder / 'log.txt'})"
        ) from None
    return {"wall_s": time.monotonic() - began, **found}


def named(function):
    """The name of a function of this package, as :func:`call` takes it; a name as it is."""
    return (
        function
        if isinstance(function, str)
        else f"{function.__module__.removeprefix(f'{_PACKAGE}.')}:{function.__name__}"
    )


def _run(command, **options):
    """Status of a process, which hears of a Ctrl-C that comes meanwhile: one that comes while it begins, when YADE
    would forget it, waits until the worker asks for it.
    """
    with _guard:
        if _halted:
            raise RunError("stopped before it began")
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # of this thread; a process begins with it
        try:
            process = subprocess.Popen(command, **options)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        _running.add(process)
    try:
        return process.wait()
    except KeyboardInterrupt:  # in the main thread alone
        _halt()
        raise
    finally:
        with _guard:
            _running.discard(process)


@contextlib.contextmanager
def pool(threads):
    """A ThreadPoolExecutor for calls side by side. At Ctrl-C those that have not begun do not, and the others'
    processes end as they do at Ctrl-C themselves: with a checkpoint where they have one. A second Ctrl-C kills them."""
    global _halted
    _halted = False
    with ThreadPoolExecutor(max(1, threads)) as made:
        try:
            yield made
        except KeyboardInterrupt:
            made.shutdown(wait=False, cancel_futures=True)
            _halt()
            raise


def _halt():
    global _halted
    with _guard:
        _halted = True
        left = list(_running)
    try:
        for process in left:
            process.send_signal(signal.SIGINT)
        for process in left:
            process.wait()
    except KeyboardInterrupt:
        for process in left:
            process.kill()
        raise
