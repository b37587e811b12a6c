"""The packing at rest by LMGC90 in YADE, by the checks of the verification report in their quick form, and the engine's
stopping tests.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import contact
from yade.nonsmooth.judges.verification import Bench, lmgc90, solver

from contact_scenes import begin, box, engine, loose_heap, material, run


pytestmark = pytest.mark.usefixtures("empty")


@pytest.mark.parametrize(
    "check",
    [
        lmgc90.lmgc90_step_in_our_arrays,
        lmgc90.lmgc90_step_by_us,
        lmgc90.lmgc90_packing_stays_at_rest,
        solver.stopping_tests_by_name,
    ],
    ids=lambda f: f.__name__,
)
def test_check_holds(check, tmp_path):
    outcome = check(Bench(folder=tmp_path, quick=True))
    assert outcome.claims
    for claim in outcome.claims:
        assert claim.passed, f"{claim.what}: {claim.measured:g} {claim.unit}, allowed {claim.low:g} to {claim.high:g}"


def heap(**options):
    stuff = material(0.3)
    box(stuff, 10, 12)
    loose_heap(stuff)
    begin(dt=2e-3, **{"tolerance": 1e-3, **options})
    run(600)
    return engine()


def test_engine_stops_by_name():
    sweeps = {}
    for name in ("Quad", "QM/16", "Maxm"):
        O.reset()
        e = heap(stoppingTest=name)
        assert e.unconverged == 0 and math.isfinite(e.residual)
        sweeps[name] = e.totalIterations
    # the same heap, but not the same steps: the stricter test still needs more
    assert sweeps["Quad"] < sweeps["Maxm"]


def test_solver_without_yade_stops_by_name_alike(tmp_path):
    e = heap(stoppingTest="QM/16")
    e.dump(str(tmp_path / "step.h5"))
    problem = contact.load(tmp_path / "step.h5")
    again = contact.solve(problem, tolerance=e.tolerance, max_iterations=e.maxIterations, stopping="QM/16")
    assert again.iterations == e.iterations and np.array_equal(again.impulse, problem.impulse)
    assert contact.velocity_changes(problem).qm16 <= e.tolerance * (1 + 1e-6)
    # the independent residual all the same
    assert again.relative == pytest.approx(contact.residual(problem).relative, rel=1e-9)
    with pytest.raises(ValueError, match="stopping = 'quad': it must be 'naturalMap', 'Quad', 'Maxm' or 'QM/16'"):
        contact.solve(problem, stopping="quad")


def test_unknown_stopping_test_is_refused():
    material()
    begin(stoppingTest="quad")
    with pytest.raises(RuntimeError, match="stoppingTest = 'quad': it must be 'naturalMap', 'Quad', 'Maxm' or 'QM/16'"):
        O.step()


def test_stopping_test_survives_save_and_load(tmp_path):
    heap(stoppingTest="QM/16")
    O.save(str(tmp_path / "heap.yade.gz"))
    O.reset()
    O.load(str(tmp_path / "heap.yade.gz"))
    assert engine().stoppingTest == "QM/16"
