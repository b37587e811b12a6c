"""Runs pytest for one mutant after the other in children of a process that has imported what takes time, YADE included
where it runs in YADE.

  scripts/yade-nonsmooth tests/mutants/server.py IN OUT --threads N      or python3 instead of the launcher

IN and OUT are numbers of open pipes. A line in, {"arguments", "environment", "number", "output", "limit"}, all of them
JSON, gives a line out: the status of pytest, null where the child was stopped after ``limit`` seconds. Nothing of the
package under test stays imported here, so a child reads it anew.
"""
import atexit
import contextlib
import ctypes
import importlib
import json
import os
import re
import signal
import sys
import time

import matplotlib.backends.backend_agg  # noqa: F401
import matplotlib.figure  # noqa: F401
import meshio  # noqa: F401
import pytest
import scipy.spatial  # noqa: F401
import scipy.stats  # noqa: F401
import shapely.geometry  # noqa: F401
import yaml  # noqa: F401


def choose(number):
    """Sets the switch of a library that was loaded before; others read the environment."""
    with open("/proc/self/maps") as maps:
        libraries = set(re.findall(r"/\S*/nonsmooth_engines\.so", maps.read()))
    for library in libraries:
        with contextlib.suppress(ValueError):  # one without mutants
            ctypes.c_int.in_dll(ctypes.CDLL(library), "nonsmooth_mutant").value = number


def child(job):
    os.setsid()
    output = os.open(job["output"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream in (1, 2):
        os.dup2(output, stream)
    os.environ.update(job["environment"])
    choose(job["number"])
    status = 3
    try:
        if watched:
            importlib.import_module("yade.nonsmooth.world.background").watch(*watched)
        status = int(pytest.main(job["arguments"]))
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def serve(job):
    """Status of a child for the job; what it has started ends with it."""
    asked_by, pid, until = os.getppid(), os.fork(), time.monotonic() + job["limit"]
    if pid == 0:
        child(job)
    while True:
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended or time.monotonic() > until or os.getppid() != asked_by:  # nobody waits for it any more
            break
        time.sleep(0.02)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGKILL)
    if not ended:
        os.waitpid(pid, 0)
        return None
    return os.waitstatus_to_exitcode(status)


def forget_background():
    """Takes back what the engines had yade.nonsmooth.world.background do when YADE loaded them, and forgets the
    package. Returns the arguments of its watch(), None without YADE.
    """
    found = sys.modules.get("yade.nonsmooth.world.background")
    if found is None:
        return None
    from yade.wrapper import Omega

    Omega.run, Omega.wait, Omega.exitNoBacktrace = found._run, found._wait, found._leave
    for name in found._BEGIN_ANEW:
        setattr(Omega, name, getattr(Omega, name).__wrapped__)
    atexit.unregister(found._last)
    for name in [name for name in sys.modules if f"{name}.".startswith("yade.nonsmooth.")]:
        del sys.modules[name]
    vars(sys.modules["yade"]).pop("nonsmooth", None)
    return found._take, found._is_over


watched = forget_background()
if "nonsmooth" in sys.modules or "yade.nonsmooth" in sys.modules:
    sys.exit("the package under test is imported already")
with os.fdopen(int(sys.argv[1])) as jobs, os.fdopen(int(sys.argv[2]), "w") as answers:
    print("ready", file=answers, flush=True)
    for line in jobs:
        print(json.dumps(serve(json.loads(line))), file=answers, flush=True)
