"""Which tests start a process or send a signal: a plugin of pytest that sees them do it, by Python's audit events."""
import csv
import sys

import pytest

# what subprocess, os, signal and multiprocessing tell of themselves; ctypes' calls of the machine's own functions are
# not seen
EVENTS = (
    "subprocess.Popen",
    "os.fork",
    "os.forkpty",
    "os.posix_spawn",
    "os.system",
    "os.exec",
    "os.kill",
    "os.killpg",
    "signal.pthread_kill",
)


class Started:
    """Writes into FILE a row for each test that starts a process or sends a signal: its id, the seconds that it and its
    fixtures took, and the events.

    A fixture of a file or of the session counts for the test that needs it first.
    """

    COLUMNS = ("test", "seconds", "events")

    def __init__(self, file):
        self._file, self._events, self._seconds = file, None, {}
        with open(file, "w", newline="") as out:
            csv.writer(out).writerow(self.COLUMNS)
        sys.addaudithook(self._hear)

    def _hear(self, event, arguments):
        if event in EVENTS and self._events is not None:
            self._events.add(event)

    @pytest.hookimpl(hookwrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item):
        self._events, self._seconds = set(), {}
        yield
        if self._events:
            with open(self._file, "a", newline="") as out:
                row = (item.nodeid, f"{sum(self._seconds.values()):.2f}", " ".join(sorted(self._events)))
                csv.writer(out).writerow(row)
        self._events = None

    def pytest_runtest_logreport(self, report):
        self._seconds[report.when] = report.duration
