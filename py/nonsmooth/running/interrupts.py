"""Ctrl-C: noted while a run goes on, and acted upon where its records are whole."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading

__all__ = ["Interrupted", "be_patient", "never_lost", "noted"]

AGAIN = 0.05  # s until an interrupt that was lost comes again


class Interrupted(KeyboardInterrupt):
    """A run that Ctrl-C has ended; the message says what is kept and how to go on."""


_patient = False


def be_patient():
    """From now on a second Ctrl-C within :func:`noted` is as good as one: for a process that may hear it from the
    terminal and from the command that started it.
    """
    global _patient
    _patient = True


@contextlib.contextmanager
def never_lost():
    """Within the block a Ctrl-C that comes while Python is done with an object (in a ``__del__``), where an exception
    is told and forgotten, comes again a moment later.
    """
    before = sys.unraisablehook

    def again(lost):
        if issubclass(lost.exc_type, KeyboardInterrupt):
            late = threading.Timer(AGAIN, signal.pthread_kill, (threading.main_thread().ident, signal.SIGINT))
            late.daemon = True
            late.start()
        else:
            before(lost)

    sys.unraisablehook = again
    try:
        yield
    finally:
        sys.unraisablehook = before


@contextlib.contextmanager
def noted():
    """Within the block Ctrl-C only leaves a note; gives a function that tells whether it came. A second one ends the
    block at once.

    A note that the block did not act upon becomes a KeyboardInterrupt when it ends. Outside the main thread, which
    alone hears of signals, and in a process that ignores Ctrl-C, as a shell's background jobs do, nothing changes.
    """
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        yield lambda: False
        return
    came = False

    def note(number, frame):
        nonlocal came
        if came and not _patient:
            raise KeyboardInterrupt
        came = True

    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: came
    finally:
        signal.signal(signal.SIGINT, before if before is not None else signal.default_int_handler)
    if came:
        raise KeyboardInterrupt
