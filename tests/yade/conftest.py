"""What several test files share: an empty scene, commands called in this process, and the small slope's one run."""
import json
import runpy
import signal
import sys
from types import SimpleNamespace

import pytest
from shell import SCRIPTS
from yade import O


@pytest.fixture
def empty():
    """An empty scene before and after the test."""
    O.reset()
    yield
    O.trackEnergy = O.timingEnabled = O.periodic = False
    O.reset()


@pytest.fixture
def in_process(monkeypatch, capsys):
    """Calls a command in this process: ``in_process("column.py", "--disks", 50)``, a namespace of its ``status``,
    ``out`` and ``err``.

    It costs no start of YADE. What a command does to the process is taken back: its arguments, and Ctrl-C that it
    ignores once it ends.
    """

    def call(name, *words):
        monkeypatch.setattr(sys, "argv", [str(SCRIPTS / name), *map(str, words)])
        before, status = signal.getsignal(signal.SIGINT), 0
        capsys.readouterr()
        try:
            runpy.run_path(str(SCRIPTS / name), run_name="command")  # YADE writes labels of engines into __main__
        except SystemExit as end:
            status = end.code or 0
        finally:
            signal.signal(signal.SIGINT, before)
            O.reset()
        out, err = capsys.readouterr()
        if isinstance(status, str):  # sys.exit with a message
            status, err = 1, f"{err}{status}\n"
        return SimpleNamespace(status=status, out=out, err=err, last=err.strip().split("\n")[-1])

    return call


@pytest.fixture
def cases_here(monkeypatch):
    """Cases of checks are called in this process, one after the other, and not in processes of their own, which
    test_laboratory and others are for.
    """
    from yade.nonsmooth.judges.verification import cases

    known = {}

    def run(runs, threads, **options):
        for one in runs:
            if one.folder not in known:
                O.reset()
                one.folder.mkdir(parents=True)
                known[one.folder] = json.loads(json.dumps(one.function(one.folder, **one.arguments)))
        O.reset()
        return [known[one.folder] for one in runs]

    monkeypatch.setattr(cases.side_by_side, "run", run)


@pytest.fixture(scope="session")
def whole(tmp_path_factory):
    """The small slope's run from its first step to its rest, with all its steps written down: see watched_slope.run."""
    import watched_slope

    O.reset()
    return watched_slope.run(tmp_path_factory.mktemp("whole") / "out")


@pytest.fixture(scope="session")
def known(whole):
    """The whole run's series by hand: see by_hand.Known."""
    from by_hand import Known

    return Known(whole)
