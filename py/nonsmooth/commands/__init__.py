"""How a command ends, and how it warns: its status, and one line on a line of its own for what a user can mend and for
Ctrl-C.
"""

from __future__ import annotations

import contextlib
import errno
import functools
import signal
import sys
import warnings

from ..errors import UserError, UserNote
from ..running.interrupts import Interrupted, never_lost

__all__ = ["closing", "run"]

# what a folder, a disk or a limit of the system refuses; other errors of the system are ours
REFUSALS = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EACCES, errno.EPERM, errno.EIO}
INTERRUPTED = 130  # as a shell counts a process that Ctrl-C has ended


def run(main, kept="nothing is kept: run it again"):
    """Calls ``main()``. Ends the process with status 1 after a UserError or a file that cannot be written, and with 130
    after Ctrl-C, one line on stderr each; a UserNote is one line too.

    ``kept``: what that line says where what was interrupted did not say it itself.
    """
    try:
        with warnings.catch_warnings(), never_lost():
            warnings.showwarning = functools.partial(_warn, warnings.showwarning)
            main()
    except UserError as error:
        _end(1, f"error: {error}")
    except OSError as error:
        if error.errno not in REFUSALS:
            raise
        _end(
            1,
            f"error: {error.filename or 'a file'}: cannot be used ({error.strerror}); give a folder that can be written and has room",
        )
    except KeyboardInterrupt as stop:
        _end(INTERRUPTED, f"stopped: {str(stop) if isinstance(stop, Interrupted) else kept}")


def _warn(usual, message, category, *where, **more):
    if issubclass(category, UserNote):
        print(f"warning: {message}", file=sys.stderr, flush=True)
    else:
        usual(message, category, *where, **more)


def _end(status, line):
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it ends anyway
    with contextlib.suppress(OSError):
        sys.stdout.flush()  # what was said before comes first
    print(line, file=sys.stderr, flush=True)
    sys.exit(status)


@contextlib.contextmanager
def closing(bar):
    """Closes a tqdm bar at the end of the block. Where the block raises the bar stays on its line, so that the message
    gets one of its own.
    """
    try:
        yield bar
    except BaseException:
        bar.leave = True
        raise
    finally:
        bar.close()
