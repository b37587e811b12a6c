"""WallForceEngine: what a wall bears, as its mean over steps and its peak."""
import math

import pytest
from contact_scenes import begin, bits, floor, free_disk, material, refused, run
from yade import O
from yade._utils import sumForces
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.nonsmooth.wall_forces import WallForces
from yade.wrapper import ForceResetter, NewtonIntegrator, WallForceEngine

pytestmark = pytest.mark.usefixtures("empty")
RIGHT, UP = Vector3(1, 0, 0), Vector3(0, 1, 0)


def bent_wall():
    """Pieces in three directions; their ids."""
    stuff = material(0.3)
    ids = O.bodies.append(scene.segments([(-12, 5), (0, 0), (0.3, 0), (10, 0), (14, 8)], stuff, piece=1.3))
    for k in range(60):
        disk = free_disk(-9 + 1.05 * (k % 20), 6 + 1.1 * (k // 20), (2, -40, 0), stuff)
    assert disk == len(ids) + 59
    return ids


def looked(ids):
    """Normal and shear force of the last step, by YADE's own sums over the pieces in one line."""
    normal = shear = 0.0
    lines = []
    for i in ids:
        along = O.bodies[i].state.ori * RIGHT
        angle = math.atan2(along[1], along[0])
        if not lines or abs(angle - lines[-1][0]) > 1e-9:
            lines.append((angle, (along[0], along[1]), []))
        lines[-1][2].append(i)
    assert len(lines) == 3
    for _, (c, s), pieces in lines:
        x, y = sumForces(pieces, RIGHT), sumForces(pieces, UP)
        normal += x * s - y * c
        shear += x * c + y * s
    return normal, shear


@pytest.mark.parametrize("period", [1, 3])
def test_sums_have_the_bits_of_looks_after_each_step(period):
    ids = bent_wall()
    begin(tolerance=1e-4, maxIterations=300)
    forces = WallForces({"bed": ids}, period)
    for first in (0, 40):
        time, normal, shear, peak = 0.0, 0.0, 0.0, -math.inf
        for _ in range(40):
            O.dt = 1e-3 * (1 + O.iter % 4)
            before = O.time
            O.step()
            if O.iter % period == 0:
                seconds, found = O.time - before, looked(ids)
                time, normal, shear, peak = (
                    time + seconds,
                    normal + found[0] * seconds,
                    shear + found[1] * seconds,
                    max(peak, found[0]),
                )
        assert forces.take() == {"bed": (normal / time, shear / time, peak)} and peak > 0, first


def test_it_changes_nothing_and_goes_on_after_loading(tmp_path):
    found = []
    for watched in (False, True):
        O.reset()
        walls = {"bed": bent_wall()}
        begin(tolerance=1e-4, maxIterations=300)
        forces = WallForces(walls) if watched else None
        run(30)
        if watched:
            O.save(str(tmp_path / "state.yade.gz"))
        run(30)
        found.append(bits())
    assert found[0] == found[1]
    whole = forces.take()
    O.load(str(tmp_path / "state.yade.gz"))
    again = WallForces(walls)
    assert sum(isinstance(e, WallForceEngine) for e in O.engines) == 1
    run(30)
    assert bits() == found[0] and again.take() == whole


def pulled(force):
    """One piece, from left to right, with a force on it in each step; the engine that sums it up."""
    wall = floor(material())
    O.forces.setPermF(wall, force)
    found = WallForceEngine(ids=[wall], along=[RIGHT])
    O.engines = [ForceResetter(), NewtonIntegrator(damping=0), found]
    O.dt = 0.5
    return wall, found


def test_signs_and_what_is_forgotten():
    wall, found = pulled((3, 4, 0))
    run(2)
    # it is drawn off its ground, and along
    assert (found.seconds, found.normal, found.shear, found.peak) == (1.0, -4.0, 3.0, -4.0)
    O.forces.setPermF(wall, (0, -8, 0))
    run(1)
    assert found.take() == (pytest.approx(0.0, abs=1e-12), pytest.approx(2.0, rel=1e-12), 8.0)
    with pytest.raises(RuntimeError, match="^WallForceEngine: no step was counted"):
        found.take()
    run(1)
    found.forget()
    O.forces.setPermF(wall, (0, 2, 0))
    run(1)
    assert found.take() == (-2.0, 0.0, -2.0)


@pytest.mark.parametrize(
    "spoil, words",
    [
        (lambda e: setattr(e, "along", []), ("WallForceEngine: 1 ids and 0 directions",)),
        (lambda e: setattr(e, "period", 0), ("period = 0", "at least 1")),
        (lambda e: setattr(e, "ids", [-1]), ("id -1", "no such body")),
        (lambda e: setattr(O, "engines", [O.engines[0], e, O.engines[1]]), ("before the integrator", "put it behind")),
    ],
)
def test_what_would_be_summed_up_wrongly_is_refused(spoil, words):
    _, found = pulled((0, 0, 0))
    run(1)
    spoil(found)
    refused(*words)
