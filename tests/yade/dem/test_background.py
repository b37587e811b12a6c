"""O.run() in the background: no error that ends it is lost, neither for the script nor for whoever reads the status of
its process.
"""
import math
import os
import subprocess
import sys
import threading
import time

import pytest
import shell
import yade.config
from contact_scenes import begin, floor, free_disk, launch, material, spoilt
from yade import O
from yade.nonsmooth.world import background
from yade.wrapper import Collider, InteractionLoop, PorePressureEngine, PyRunner, WallForceEngine

pytestmark = pytest.mark.usefixtures("empty")


@pytest.fixture(autouse=True)
def all_told():
    """Nothing is left over from other tests, and nothing for the end of this process."""
    background.ended()
    yield
    O.pause()
    background.ended()


def rests():
    """Two disks beside each other on the ground; returns the second."""
    stuff = material(0.3)
    floor(stuff)
    disk = [free_disk(x, 0.5, stuff=stuff) for x in (0, 3)][-1]
    begin()
    O.step()
    return disk


def is_put(disk, z=0.1, x=3):
    O.bodies[disk].state.pos = (x, 0.5, z)


def of(kind):
    return next(e for e in O.engines if isinstance(e, kind))


def until_it_stands():
    while O.running:
        time.sleep(0.001)


def first_that_ends(steps=5):
    """A run that has ended before anybody waits for it."""
    O.run(steps)
    until_it_stands()


def add(one):
    O.engines = O.engines + [one]


# ---- what a script is told -------------------------------------------------------------------------
REFUSALS = {
    "engine": (is_put, "ContactDynamicsEngine: body #2 is at z = 0.1"),
    "material": (lambda disk: spoilt(O.materials[0], restitution=2.0), "restitution = 2"),
    "collider": (lambda disk: spoilt(of(Collider), verletDist=math.nan), "verletDist = nan"),
    "functors": (
        lambda disk: (is_put(disk, 0, x=1.02), setattr(of(InteractionLoop).lawDispatcher, "functors", [])),
        "Law2",
    ),
    "water": (
        lambda disk: setattr(
            O, "engines", O.engines[:3] + [PorePressureEngine(times=[0, 1], heights=[0])] + O.engines[3:]
        ),
        "PorePressureEngine",
    ),
    "wall forces": (lambda disk: add(WallForceEngine(ids=[77], along=[(1, 0, 0)])), "id 77"),
    "no engine of ours": (lambda disk: add(PyRunner(command="1/0", iterPeriod=1)), "division by zero"),
}


@pytest.mark.parametrize("spoil, words", REFUSALS.values(), ids=REFUSALS)
def test_what_ended_a_run_is_raised_by_who_waits_later_and_once(spoil, words):
    spoil(rests())
    before = O.iter
    first_that_ends()
    assert O.iter <= before + 1  # YADE counts a step whose last engine fails, and no more
    with pytest.raises(RuntimeError, match=words):
        O.wait()
    O.wait()
    assert background.ended() == 0


def test_run_and_wait_raises_in_every_race():
    is_put(rests())
    for _ in range(20):
        with pytest.raises(RuntimeError, match="ContactDynamicsEngine"):
            O.run(5, True)
    assert background.ended() == 0


def test_a_script_that_mends_what_it_has_heard_goes_on():
    disk = rests()
    is_put(disk)
    with pytest.raises(RuntimeError):
        O.run(5, wait=True)
    is_put(disk, 0)
    before = O.iter
    O.run(nSteps=5, wait=True)
    assert O.iter == before + 5 and background.ended() == 0


def test_runs_without_an_error_are_as_ever():
    rests()
    O.run(3, True)
    O.run(4)
    O.wait()
    assert O.iter == 8 and not O.running
    O.run()
    O.run(2)  # while it goes on: a new end for it
    O.pause()
    O.wait()
    assert background.ended(0) == 0 and background.ended(3) == 3


# ---- what nobody has heard ---------------------------------------------------------------------------
AFTER = (
    "the end",
    "another run",
    "O.load",
    "O.loadTmp",
    "O.stringToScene",
    "O.reset",
    "O.resetThisScene",
    "O.resetAllScenes",
)


def kept(tmp_path, what):
    O.save(str(tmp_path / "scene.yade.gz"))
    O.saveTmp()
    text = O.sceneToString()
    return {
        "the end": lambda: None,
        "another run": lambda: O.run(1),
        "O.load": lambda: O.load(str(tmp_path / "scene.yade.gz")),
        "O.loadTmp": lambda: O.loadTmp(quiet=True),
        "O.stringToScene": lambda: O.stringToScene(text),
        "O.reset": lambda: O.reset(),
        "O.resetThisScene": lambda: O.resetThisScene(),
        "O.resetAllScenes": lambda: O.resetAllScenes(),
    }[what]


@pytest.mark.parametrize("what", AFTER)
def test_an_error_that_nobody_has_heard_of_ends_the_process_with_1(what, tmp_path, capfd):
    disk = rests()
    follow = kept(tmp_path, what)
    is_put(disk)
    first_that_ends()
    is_put(disk, 0)  # whatever follows does not say it again
    follow()
    until_it_stands()
    capfd.readouterr()
    assert background.ended() == 1
    told = capfd.readouterr().err
    assert told.count("ContactDynamicsEngine: ") == 1 and "O.wait() raise it" in told
    assert background.ended() == 0 and not capfd.readouterr().err  # once


def test_the_same_error_heard_later_is_heard():
    is_put(rests())
    first_that_ends()
    with pytest.raises(RuntimeError):
        O.run(5, wait=True)
    assert background.ended() == 0


def test_two_errors_are_told_and_a_status_of_the_scripts_own_stays(capfd):
    for z in (0.1, 0.2, 0.1):
        O.reset()
        is_put(rests(), z)
        first_that_ends()
    capfd.readouterr()
    assert background.ended(3) == 3
    told = capfd.readouterr().err
    assert told.count("ContactDynamicsEngine: ") == 2 and "status 3" in told


gate = threading.Event()


def late():
    gate.wait(60)
    raise ValueError("said late")


@pytest.mark.parametrize(
    "pause, follow",
    [
        (True, lambda: None),
        (True, lambda: O.run(1)),
        (True, lambda: O.reset()),
        (False, lambda: None),  # whatever ends the run waits for its step
        (False, lambda: O.reset()),
    ],
)
def test_an_error_in_the_last_step_of_a_run_that_is_stopped(pause, follow, capfd):
    rests()
    gate.clear()
    add(PyRunner(command="import test_background; test_background.late()", iterPeriod=1, firstIterRun=3))
    O.run()
    while O.iter < 3:
        time.sleep(0.001)
    if pause:
        O.pause()
    threading.Timer(0.1, gate.set).start()
    follow()
    if pause:
        until_it_stands()
    assert background.ended() == 1 and "said late" in capfd.readouterr().err


def test_a_run_that_goes_on_when_the_script_ends_is_no_error():
    rests()
    O.run()
    while O.iter < 3:
        time.sleep(0.001)
    assert background.ended() == 0 and not O.running


def test_an_engine_may_stop_its_run_and_begin_another():
    rests()
    add(PyRunner(command="O.pause(); O.run()", iterPeriod=1, firstIterRun=2, nDo=1))
    O.run(5, wait=True)
    O.run(5, wait=True)
    assert O.iter >= 5 and background.ended() == 0


# ---- processes ---------------------------------------------------------------------------------------
SCENE = """
import sys, time
from yade import O, utils
from yade.nonsmooth.scene import disk, engines, segments
from yade.wrapper import NscdMat
utils.readParamsFromTable(z=0.1, noTableOk=True)
from yade.params import table
rock = NscdMat()
O.materials.append(rock)
O.bodies.append(segments([(-5, 0), (5, 0)], rock, sense=1))
O.bodies.append([disk((x, 0.5), 0.3, rock) for x in (0, 2)])
O.bodies[2].state.pos = (2, 0.5, table.z)
O.engines, O.dt = engines(), 1e-3
O.run(20)
while O.running:
    time.sleep(0.001)
"""
HEARD = """
try:
    O.wait()
except RuntimeError:
    O.bodies[2].state.pos = (2, 0.5, 0)
O.run(20, wait=True)
"""


@pytest.mark.parametrize(
    "then, status, told",
    [
        ("", 1, True),
        (HEARD, 0, False),
        ("sys.exit(3)", 3, True),
        ("sys.exit(0)", 1, True),
        ("O.exitNoBacktrace()", 1, True),
        ("O.wait()", 1, False),
    ],
)
def test_status_of_a_script(then, status, told, tmp_path):
    script = tmp_path / "refused.py"
    script.write_text(SCENE + then)
    done = launch(script)
    assert done.returncode == status, done.stderr
    assert ("has not waited for" in done.stderr) == told and "z = 0.1" in done.stderr, done.stderr


def test_a_plain_python_and_its_forks(tmp_path):
    """YADE in a Python that is not its program: ends with 1 too, and a fork, which has heard as little, leaves that to
    its parent.
    """
    script = tmp_path / "refused.py"
    fork = "import os\nif os.fork() == 0:\n    sys.exit(0)\nprint('fork', os.waitstatus_to_exitcode(os.wait()[1]))\n"
    script.write_text(f"import sys\nsys.path.insert(0, {os.path.join(yade.config.libDir, 'py')!r})\n{SCENE}{fork}")
    python = sys.executable if "python" in sys.executable else "/usr/bin/python3"
    done = shell.run(python, script, limit=120)
    assert done.returncode == 1 and "fork 0" in done.stdout, done.stdout + done.stderr
    assert done.stderr.count("has not waited for") == 1


def test_jobs_of_yade_batch_that_are_refused_have_failed(tmp_path):
    script, table = tmp_path / "refused.py", tmp_path / "refused.table"
    script.write_text(SCENE + "if table.z > 0.15:\n    utils.waitIfBatch()\n")
    table.write_text("z\n0\n0.1\n0.2\n")
    environment = {k: v for k, v in os.environ.items() if k not in ("OMP_NUM_THREADS", "YADE_BATCH")}
    done = subprocess.run(
        [shell.PREFIX / "bin" / "yade-batch", "--job-threads=1", "-j3", "--log", "z.@.log", str(table), str(script)],
        cwd=tmp_path,
        env=environment,
        text=True,
        capture_output=True,
        timeout=120,
    )
    assert done.stdout.count("done    (exit status 0)") == 1, done.stdout
    assert done.stdout.count("FAILED  (exit status 256)") == 2, done.stdout  # 1, as the shell's call gives it
