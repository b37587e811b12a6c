"""Runs pytest inside YADE: scripts/yade-nonsmooth tests/yade/run_pytest.py [--threads N] [--share DIR] [--started FILE]
[PYTEST ARGUMENTS].

--threads N: as the launcher takes it; programs that tests start have as many unless the test says otherwise.
--share DIR: several of these commands at a time share the tests, file by file, by what they write into DIR, which is
empty before the first of them. Give each one thread: a thread that waits for another one at each loop's end, while
others' have the cores, makes steps of small scenes forty times longer. --started FILE: writes down which tests started
a process or sent a signal: see started.py.
"""
import os
import sys

import pytest


# Files that take long, the longest first, so that those who share them end at about the same time.
LONG = [
    f"test_{name}.py"
    for name in (
        "verification",
        "laboratory",
        "examples",
        "commands",
        "benchmark",
        "comparison",
        "packings",
        "columns",
        "soft_walls",
        "killed_runs",
    )
]


class Shared:
    """Runs the tests of files that no other process has taken."""

    def __init__(self, folder):
        self._folder, self._ours = folder, {}
        os.makedirs(folder, exist_ok=True)

    def _take(self, file):
        try:
            os.close(os.open(os.path.join(self._folder, file), os.O_CREAT | os.O_EXCL | os.O_WRONLY))
        except FileExistsError:
            return False
        return True

    def pytest_collection_modifyitems(self, items):
        items.sort(key=lambda item: LONG.index(item.path.name) if item.path.name in LONG else len(LONG))

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item):
        file = item.path.name
        if file not in self._ours:
            self._ours[file] = self._take(file)
        return None if self._ours[file] else True  # True: done, by somebody else

    def pytest_terminal_summary(self, terminalreporter):
        terminalreporter.section("files that this process has taken")
        terminalreporter.line(" ".join(sorted(file for file, ours in self._ours.items() if ours)))


here = os.path.dirname(os.path.realpath(sys.argv[0]))
arguments, plugins = sys.argv[1:], []
if "--threads" in arguments:
    k = arguments.index("--threads")
    del arguments[k : k + 2]
if "--share" in arguments:
    k = arguments.index("--share")
    plugins.append(Shared(arguments[k + 1]))
    del arguments[k : k + 2]
if "--started" in arguments:
    sys.path.insert(0, here)
    from started import Started

    k = arguments.index("--started")
    plugins.append(Started(arguments[k + 1]))
    del arguments[k : k + 2]
if not any(os.path.exists(a.split("::")[0]) for a in arguments):
    arguments.append(here)
status = pytest.main(
    ["-ra", "--durations=20", "--durations-min=5", "--rootdir=" + here, "-p", "no:cacheprovider", *arguments], plugins
)
sys.exit(int(status))
