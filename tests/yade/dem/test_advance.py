"""ContactDynamicsEngine.advance: the same steps as O.step makes, from the caller's thread, ended by signals and by what
engines refuse.
"""
import math
import os
import signal
import sys
import threading

import numpy as np
import pytest
from contact_scenes import begin, bits, box, engine, floor, free_disk, loose_heap, material
from yade import O
from yade.wrapper import Collider, ContactDynamicsEngine, ForceResetter, NonsmoothTimeStepper, PyRunner

pytestmark = pytest.mark.usefixtures("empty")
seen = []  # by engines


def heap(**options):
    stuff = material(0.3, 0.1)
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    return begin(dt=2e-3, tolerance=1e-4, maxIterations=300, **options)


def looking(command, **options):
    """An engine that runs Python in every step; ``test`` is this module there."""
    return PyRunner(
        command=f"import sys; test = sys.modules['{__name__}']; {command}",
        iterPeriod=1,
        initRun=True,
        updateGlobals=False,
        **options,
    )


def refusal(words, *arguments, kind=RuntimeError, **options):
    """advance() is refused in one line that has these words, and makes no step."""
    before = O.iter
    with pytest.raises(kind) as error:
        ContactDynamicsEngine.advance(*arguments, **options)
    assert words in str(error.value) and "\n" not in str(error.value), error.value
    assert O.iter == before


# ---- steps ----------------------------------------------------------------------------------------


def test_steps_have_the_bits_of_single_steps():
    found = []
    for make in (lambda n: [O.step() for _ in range(n)], lambda n: engine().advance(n)):
        O.reset()
        heap()
        for n in (1, 149, 250):
            make(n)
        found.append((bits(), O.iter, O.time, engine().energyError, engine().totalIterations))
    assert found[0] == found[1] and found[0][1] == 400


def test_it_returns_how_many_steps_it_made():
    heap()
    assert engine().advance(0) == 0 and O.iter == 0
    assert engine().advance(3) == 3 and O.iter == 3
    assert ContactDynamicsEngine.advance(steps=np.int64(2)) == 2 and O.iter == 5
    O.engines = []
    assert ContactDynamicsEngine.advance(2) == 2 and O.iter == 7  # whatever the engines


@pytest.mark.parametrize("adapts", [False, True])
def test_it_ends_with_the_step_that_is_nearest_to_a_time(adapts):
    def scene():
        O.reset()
        stuff = material(0.3)
        floor(stuff)
        free_disk(0, 1, (3, 0, 0), stuff=stuff)
        begin()
        if adapts:  # steps of many lengths
            O.engines = [NonsmoothTimeStepper(smallest=1e-4, largest=4e-3, path=2e-3, growth=1.1), *O.engines]

    ends = (1e-3, 0.0514, 0.0515, 0.3, 0.3, 0.71)  # 0.0515: half a step of 1 ms
    scene()
    by_hand = []
    for end in ends:
        while O.time < end - 0.5 * O.dt:
            O.step()
        by_hand.append((O.iter, O.time, bits()))
    scene()
    found, made = [], []
    for end in ends:
        made.append(engine().advance(until=end))
        found.append((O.iter, O.time, bits()))
    assert found == by_hand and sum(made) == O.iter and made[4] == 0
    if not adapts:
        assert made == [1, 50, 0, 249, 0, 410]


def test_whichever_comes_first_ends_it():
    O.dt = 1e-3
    assert ContactDynamicsEngine.advance(5, until=1.0) == 5
    assert ContactDynamicsEngine.advance(500, until=8e-3) == 3


def test_engines_know_how_many_steps_are_left():
    heap()
    O.engines = O.engines + [looking("test.seen.append(contactDynamics.stepsLeft)")]
    seen.clear()
    O.step()
    assert engine().stepsLeft == 0 and seen == [0]
    engine().advance(3)
    assert engine().stepsLeft == 0 and seen == [0, 3, 2, 1]
    engine().advance(until=O.time + 3 * O.dt)
    assert seen[4:6] == [sys.maxsize] * 2 and seen[6:] == [1]
    seen.clear()
    engine().advance(5, until=O.time + 2 * O.dt)
    assert seen == [5, 1]


def test_an_engine_may_advance_another_scene():
    other = O.addScene()
    O.engines = [
        looking(f"O.switchToScene({other}); test.seen.append(ContactDynamicsEngine.advance(2)); O.switchToScene(0)"),
        looking("test.seen.append(ContactDynamicsEngine().stepsLeft)"),
    ]
    seen.clear()
    ContactDynamicsEngine.advance(2)
    assert seen == [2, 2, 2, 1] and O.iter == 2
    O.switchToScene(other)
    assert O.iter == 4
    O.switchToScene(0)


def test_other_threads_go_on_meanwhile():
    heap()
    O.step()
    iters, over = set(), threading.Event()

    def watch():
        while not over.is_set():
            iters.add(O.iter)

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        begun = O.iter
        for _ in range(
            50
        ):  # until the other thread has had its turn within one of them; a lock that is kept never gives it one
            ends = {begun, begun + 100}
            engine().advance(100)
            if any(begun < k < begun + 100 for k in set(iters) - ends):
                break
            begun = O.iter
        else:
            pytest.fail("the other thread has stood still in each of 50 calls")
    finally:
        over.set()
        watcher.join()


def test_another_thread_sees_bodies_move_meanwhile():
    """Though nobody needs them within the steps: what it sees is about a twentieth of a second old."""
    state = O.bodies[free_disk(velocity=(1, 0, 0))].state
    begin(gravity=(0, 0, 0), dt=1e-6)
    O.step()
    places, over = [0.0], threading.Event()

    def watch():
        while not over.wait(1e-3):
            if state.pos[0] != places[-1]:
                places.append(state.pos[0])

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        for k in range(7):  # until it has had its turn within one of them
            begun = state.pos[0]
            engine().advance(1000 * 2**k)
            if any(begun < x < state.pos[0] for x in list(places)):
                break
        else:
            pytest.fail("the other thread has seen no body move in any of the calls")
    finally:
        over.set()
        watcher.join()


# ---- signals --------------------------------------------------------------------------------------


@pytest.fixture
def interrupted(monkeypatch):
    """Sends Ctrl-C from another thread as soon as steps are being made; gives a function that sets what hears it."""
    before = signal.getsignal(signal.SIGINT)  # tests in the background ignore it
    begun, O.dt = threading.Event(), 1e-3
    O.engines = [looking("test.started.set()", nDo=1)]
    monkeypatch.setattr(sys.modules[__name__], "started", begun, raising=False)

    def send():
        begun.wait(60)
        os.kill(os.getpid(), signal.SIGINT)

    sender = threading.Thread(target=send)
    sender.start()
    yield lambda handler: signal.signal(signal.SIGINT, handler)
    sender.join()
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_ends_it_between_two_steps(interrupted):
    interrupted(signal.default_int_handler)
    with pytest.raises(KeyboardInterrupt):
        ContactDynamicsEngine.advance(10**8)  # some ten seconds
    made = O.iter
    assert 0 < made < 10**8 and O.subStep == -1 and ContactDynamicsEngine().stepsLeft == 0
    ContactDynamicsEngine.advance(2)
    assert O.iter == made + 2


def test_a_signal_that_is_only_noted_ends_nothing(interrupted):
    noted = []
    interrupted(lambda number, frame: noted.append(O.iter))
    for _ in range(1000):
        assert ContactDynamicsEngine.advance(100_000) == 100_000
        if noted:
            break
    assert len(noted) == 1 and O.iter % 100_000 == 0


# ---- what ends it otherwise -------------------------------------------------------------------------


def test_what_an_engine_refuses_is_raised_with_its_words():
    e = heap()
    engine().advance(2)
    e.tolerance = -1
    for _ in range(2):
        with pytest.raises(
            RuntimeError, match="^ContactDynamicsEngine: tolerance = -1: it must be positive and finite$"
        ):
            e.advance(5)
        assert O.iter == 2 and e.stepsLeft == 0
    e.tolerance = 1e-4
    assert e.advance(3) == 3 and O.iter == 5  # it goes on with that step, as O.step() does
    O.engines = O.engines + [looking("raise KeyError('what went wrong')", firstIterRun=8)]
    with pytest.raises(RuntimeError, match="PyRunner error(.|\n)*what went wrong"):
        e.advance(10)
    assert O.iter == 8


def test_it_is_refused_while_a_run_is_at_work():
    heap()
    O.run()
    try:
        with pytest.raises(
            RuntimeError,
            match="^ContactDynamicsEngine.advance: O.run.. is making steps in the background: call O.pause.. or O.wait.. first$",
        ):
            engine().advance(1)
    finally:
        O.pause()
        O.run(1, wait=True)  # until the thread has ended


@pytest.mark.parametrize(
    "make, words",
    [
        (
            O.step,
            "ContactDynamicsEngine.advance: step 0 has begun and is not over: call it between two steps and not from an engine",
        ),
        (
            lambda: ContactDynamicsEngine.advance(1),
            "ContactDynamicsEngine.advance: it is making steps of this scene already: call it between two steps, not from an engine",
        ),
    ],
)
def test_it_is_refused_within_a_step_of_the_scene(make, words):
    O.engines = [ForceResetter(), looking("ContactDynamicsEngine.advance(1)")]
    with pytest.raises(RuntimeError, match=words):
        make()
    assert O.iter == 0


def test_it_is_refused_while_another_thread_is_at_it():
    refusals, over = [], threading.Event()

    def disturb():
        while not (over.is_set() or refusals):
            try:
                ContactDynamicsEngine.advance(0)
            except RuntimeError as error:
                refusals.append(str(error))

    other = threading.Thread(target=disturb)
    other.start()
    try:
        for _ in range(50):  # until the other thread has had its turn within one of them
            ContactDynamicsEngine.advance(200_000)
            if refusals:
                break
    finally:
        over.set()
        other.join()
    assert refusals == [
        "ContactDynamicsEngine.advance: it is making steps of this scene already: call it between two steps, not from an engine or another thread"
    ]
    assert O.iter > 0 and O.iter % 200_000 == 0


def test_a_step_that_o_step_has_broken_off_is_finished_by_it():
    e = heap()
    e.tolerance = -1
    with pytest.raises(RuntimeError, match="tolerance"):
        O.step()
    e.tolerance = 1e-4
    refusal("where an error has ended the step, call O.step() to finish it", 1)
    O.step()
    assert e.advance(2) == 2 and O.iter == 3


def test_it_is_refused_where_a_step_is_more_than_a_call():
    heap()
    O.subStepping = True
    refusal("O.subStepping is on", 1)
    O.subStepping = False
    engine().advance(1)


def test_it_ends_where_an_engine_puts_another_scene_in_the_place_of_this_one():
    O.engines = [looking("O.switchScene()", firstIterRun=2)]
    with pytest.raises(
        RuntimeError, match="^ContactDynamicsEngine.advance: after 3 steps an engine has put another scene in the place"
    ):
        ContactDynamicsEngine.advance(10)
    assert O.iter == 0
    O.switchScene()
    assert O.iter == 3


@pytest.mark.parametrize(
    "arguments, kind, words",
    [
        (((),), ValueError, "give steps, until [s], or both"),
        (((-1,),), ValueError, "steps = -1: give 0 or more"),
        (((), ("until", math.nan)), ValueError, "until = nan: give a finite time"),
        (((), ("until", math.inf)), ValueError, "until = inf: give a finite time"),
        (((2.5,),), TypeError, "float"),
        (((), ("until", "soon")), TypeError, "must be real number"),
        (((10**30,),), OverflowError, "too large"),
    ],
)
def test_arguments_without_sense(arguments, kind, words):
    positional, *named = arguments
    refusal(words, *positional, kind=kind, **dict(named))


# ---- what is up to date afterwards ----------------------------------------------------------------


def truth(steps):
    """Table of the disks after so many steps, all of them seen."""
    O.reset()
    heap()
    engine().advance(steps)
    return engine().bodyTable()


def places():
    return [tuple(b.state.pos) for b in O.bodies]


def test_without_a_view_tables_are_true_and_bodies_wait():
    whole = truth(60)
    O.reset()
    heap()
    e = engine()
    e.advance(20)
    before, views = places(), e.views
    e.advance(20, view=False)
    e.advance(until=O.time + 20 * O.dt, view=())
    assert e.bodyTable() == whole and O.iter == 60
    # functors look at disks that have come near each other; and others may look, where a busy machine has let 0.05 s go
    # by
    assert e.views > views or sum(a == b for a, b in zip(before, places())) > 10
    views = e.views
    e.view()
    table = np.frombuffer(whole).reshape(-1, 8)
    assert e.views == views + 1 and [places()[int(row[0])][:2] for row in table] == [tuple(row[1:3]) for row in table]


def test_bodies_that_are_asked_for_are_up_to_date_and_what_is_made_of_them_counts():
    """One disk is looked at and driven in every step, as a platen is; all others wait. The same as where all is
    seen.
    """
    ends = []
    for alone in (True, False):
        O.reset()
        heap()
        e, which = engine(), O.bodies[-1]
        e.advance(5)
        other, views, path = O.bodies[-2].state.pos, e.views, []
        for k in range(60):
            which.state.vel = (0.1 * k, which.state.vel[1], 0)
            if k == 30:
                which.state.mass *= 3
            e.advance(1, view=[which.id, which.id] if alone else True)
            path.append((tuple(which.state.pos), tuple(which.state.vel)))
        assert (O.bodies[-2].state.pos == other) is (e.views == views) and (alone or e.views >= views + 60)
        ends.append((path, e.bodyTable()))
    assert ends[0] == ends[1] and len(set(ends[0][0])) == 60


@pytest.mark.parametrize("change", ["radius", "erased", "shape"])
def test_a_body_that_is_another_one_now_is_taken_anew(change):
    ends = []
    for alone in (True, False):
        O.reset()
        heap()
        e = engine()
        e.advance(40, view=[len(O.bodies) - 1] if alone else True)
        if alone and change != "radius":
            e.view()  # what is not a state of those bodies
        if change == "radius":
            O.bodies[-1].shape.radius *= 0.9
        elif change == "erased":
            O.bodies.erase(len(O.bodies) - 1)
        else:
            O.bodies[-1].shape = type(O.bodies[-1].shape)(radius=0.3)
        e.advance(40)
        ends.append(e.bodyTable())
    assert ends[0] == ends[1] != truth(80)


@pytest.mark.parametrize("steps", [1, 40])
@pytest.mark.parametrize("viewed", [True, False])
def test_interactions_that_are_erased_meanwhile_end(steps, viewed):
    """At once where all was brought up to date before, and otherwise once it is, or once the collider looks for pairs
    anew; nothing points to what is gone.
    """
    ends = []
    for view in (False, True):
        O.reset()
        stuff = material(0.3)
        for k in range(400):
            free_disk(1.0 * (k % 20), 0.999 * (k // 20), stuff=stuff)
        e = begin(dt=2e-3, tolerance=1e-4, maxIterations=300)
        collider = next(one for one in O.engines if isinstance(one, Collider))
        e.advance(1)  # all contacts have interactions
        e.advance(steps, view=view)
        if viewed:
            e.view()
        real = [(i.id1, i.id2) for i in O.interactions if i.isReal]
        for pair in real[::2]:
            O.interactions.erase(*pair)
        e.advance(5, view=view)
        collider.verletDist *= 1.01  # it forgets what it knows
        e.advance(2, view=view)
        assert e.candidates <= 1.1 * len(real)  # no pair twice
        e.advance(40, view=view)
        ends.append(e.bodyTable())
        assert sum(i.isReal for i in O.interactions) > 0.9 * len(real) > 300
    if viewed:
        assert ends[0] == ends[1]
    assert np.all(np.isfinite(np.frombuffer(ends[0])))


def test_what_is_written_elsewhere_is_taken_up_once_all_has_been_seen():
    heap()
    e = engine()
    e.advance(20, view=False)
    O.bodies[-1].state.vel, views = (3, 0, 0), e.views
    e.advance(1, view=False)
    assert e.views > views or O.bodies[-1].state.vel == (3, 0, 0)  # where nobody has looked yet
    e.view()
    assert O.bodies[-1].state.vel[0] == 3
    x = O.bodies[-1].state.pos[0]
    e.advance(1)
    assert O.bodies[-1].state.pos[0] > x + 0.9 * 3 * O.dt


def shown_as_they_are(before):
    """Whether bodies have moved since ``before``, and O.bodies has them where the engine does."""
    table = np.frombuffer(engine().bodyTable()).reshape(-1, 8)
    now = places()
    return now != before and [now[int(row[0])][:2] for row in table] == [tuple(row[1:3]) for row in table]


def test_an_exception_leaves_all_up_to_date():
    """One that an engine's step raises, and one between two steps, where no engine has its turn."""
    heap()
    e = engine()
    e.advance(5)
    before = places()
    e.advance(30, view=False)
    e.tolerance = -1
    with pytest.raises(RuntimeError, match="tolerance"):
        e.advance(100, view=False)
    assert shown_as_they_are(before)


def test_a_signal_that_raises_leaves_all_up_to_date():
    heap()
    e = engine()
    e.advance(5)
    before = places()

    def stop(number, frame):
        raise TimeoutError("enough")

    heard = signal.signal(signal.SIGALRM, stop)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(TimeoutError, match="enough"):
            e.advance(10**8, view=False)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, heard)
    assert shown_as_they_are(before)


def test_what_is_saved_without_a_view_is_true(tmp_path):
    whole = truth(60)
    O.reset()
    heap()
    engine().advance(60, view=False)
    O.save(str(tmp_path / "now.yade.gz"))
    O.load(str(tmp_path / "now.yade.gz"))
    assert engine().bodyTable() == whole


@pytest.mark.parametrize(
    "view, kind, words",
    [
        ([10**6], ValueError, "view: there is no body #1000000: give ids of O.bodies"),
        ([-1], ValueError, "view: there is no body #-1"),
        ([0.5], TypeError, "integer"),
        (3, TypeError, "not iterable"),
    ],
)
def test_bodies_that_are_none_are_refused(view, kind, words):
    heap()
    refusal(words, 2, view=view, kind=kind)
