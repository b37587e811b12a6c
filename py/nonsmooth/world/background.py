"""``O.run()``, ``O.wait()`` and the end of the process, such that no error of a run in the background is lost.

YADE makes the steps of ``O.run()`` in a thread of its own. ``O.wait()`` raises the error that ends the thread, an
engine's refusal or any other, but only if it waits already when the error comes. ``O.run(n, wait=True)`` begins to wait
after it has begun to run, and may be late. With the plugin in YADE

* ``O.wait()``, and with it ``O.run(n, wait=True)``, raises what has ended the run (RuntimeError), whenever it came, and
  once;
* a process tells at its end of an error that the script has not heard of, and ends with status 1 instead of 0.

A prompt ends as it would: its user has the error in the log.
"""

from __future__ import annotations

import atexit
import ctypes
import functools
import os
import sys
import threading
import time

from yade.wrapper import Omega

__all__ = ["ended", "watch"]

_LOOK = 0.001  # s from one look at whether a step is over to the next
# what puts another thread in the place of the one whose error was not heard yet
_BEGIN_ANEW = (
    "load",
    "loadTmp",
    "reload",
    "reset",
    "resetAllScenes",
    "resetCurrentScene",
    "resetThisScene",
    "stringToScene",
)

_run, _wait, _leave = Omega.run, Omega.wait, Omega.exitNoBacktrace
_take = _is_over = _process = None  # see watch()
_unheard: list[str] = []  # messages of runs that are past


def watch(take, is_over):
    """Replaces methods of YADE's ``Omega``; the plugin's library calls it, once. ``take()`` gives the message of the
    error that ended the last run, and has YADE forget it, or None; ``is_over()`` whether no step of a run is under
    way."""
    global _take, _is_over, _process
    _take, _is_over, _process = take, is_over, os.getpid()
    Omega.run, Omega.wait, Omega.exitNoBacktrace = _run_and_raise, _wait_and_raise, _leave_and_tell
    for name in _BEGIN_ANEW:
        setattr(Omega, name, _anew(getattr(Omega, name)))
    atexit.register(_last)


def ended(status=0):
    """The status of a process that is to end with ``status``: 1 instead of 0 where nobody has heard of an error, which
    stderr is told then.
    """
    if os.getpid() != _process:  # a fork: its parent tells
        return status
    _keep(stop=status == 0)
    if not _unheard or _at_a_prompt():
        return status
    told, status = "\n".join(_unheard), status or 1
    _unheard.clear()
    sys.stdout.flush()
    print(
        f"error: O.run() was ended by an error that this script has not waited for, so the process ends with status {status}:\n{told}\n"
        "O.run(n, wait=True) and O.wait() raise it.",
        file=sys.stderr,
    )
    return status


def _may_wait():
    """For a run's thread: that thread itself, which makes O.run() from within an engine, would wait for ever."""
    return threading.current_thread() is threading.main_thread()


def _keep(stop=False):
    """Keeps what YADE is about to forget; ``stop``: a run that goes on ends with the present step."""
    if _may_wait():
        if stop:
            Omega().pause()
        while not (Omega().running or _is_over()):
            time.sleep(_LOOK)
    message = _take()
    if message is not None and message not in _unheard:
        _unheard.append(message)


def _heard(message):
    if message in _unheard:
        _unheard.remove(message)


@functools.wraps(_run)
def _run_and_raise(self, nSteps=-1, wait=False):
    _keep()
    _run(self, nSteps)
    while _may_wait() and self.running and _is_over():
        time.sleep(_LOOK / 100)  # until its thread has begun: YADE crashes where a scene is reset before
    if wait:
        self.wait()


@functools.wraps(_wait)
def _wait_and_raise(self):
    try:
        _wait(self)
    except RuntimeError as error:
        _heard(str(error))
        raise
    message = _take()  # it came before the waiting began
    if message is not None:
        _heard(message)
        raise RuntimeError(message)


@functools.wraps(_leave)
def _leave_and_tell(self, status=0):
    _leave(self, ended(status))


def _anew(method):
    @functools.wraps(method)
    def begin(self, *arguments, **options):
        _keep(stop=True)
        return method(self, *arguments, **options)

    return begin


def _at_a_prompt():
    import yade.runtime

    options = getattr(yade.runtime, "opts", None)  # of YADE's own program
    if options is None:
        return hasattr(sys, "ps1")
    return not options.exitAfter and sys.stdin is not None and sys.stdin.isatty()


def _last():
    """At the end of a Python that does not ask ended(): YADE's own program, or a plain one that has imported YADE."""
    status = ended()
    if status:
        sys.modules["yade.boot"].finalize()  # YADE's temporary folder
        sys.stdout.flush()
        sys.stderr.flush()
        ctypes.CDLL(None).fflush(None)
        os._exit(status)
