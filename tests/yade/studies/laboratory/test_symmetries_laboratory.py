"""The laboratory's walls and membrane: forces by hand, and the same test mirrored, transposed, with other ids and in
other units.
"""
import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene
from yade.nonsmooth.laboratory import membrane
from yade.nonsmooth.laboratory.walls import SIDES, Walls

from contact_scenes import TIGHT, material

MIRROR = {"bottom": "bottom", "top": "top", "left": "right", "right": "left"}
TRANSPOSED = {"bottom": "left", "left": "bottom", "right": "top", "top": "right"}
WIDTH, HEIGHT, PRESSURE = 6.4, 4.4, 1e5
# of 300 steps under load, in the scales of the walls; the solver's 1e-12 where the order of contacts is another
ROUNDING, SOLVED = (1e-9, 1e-7)


pytestmark = pytest.mark.usefixtures("empty")


# ---- walls ----------------------------------------------------------------------------------------


def disks():
    """24 places and radii, with room between them."""
    dice = np.random.default_rng(8)
    x, y = (v.ravel() for v in np.meshgrid(0.55 + 1.05 * np.arange(6), 0.55 + 1.08 * np.arange(4)))
    return np.column_stack((x + dice.uniform(-0.02, 0.02, 24), y + dice.uniform(-0.02, 0.02, 24))), dice.uniform(
        0.4, 0.5, 24
    )


def pressed(names=None, order=None, length=1.0, pressure=1.0, density=1.0, steps=300):
    """A sample between two walls that follow the pressure; ``names``: what each wall is called here. Returns places of
    the disks, of the walls, and stresses, as they are called and measured in the first case."""
    O.reset()
    names = names or {name: name for name in SIDES}
    where, r = disks()
    width, height = WIDTH, HEIGHT
    if names == MIRROR:
        where = np.column_stack((WIDTH - where[:, 0], where[:, 1]))
    if names == TRANSPOSED:
        where, width, height = where[:, ::-1], HEIGHT, WIDTH
    stuff = material(0.3, 0.05)
    stuff.density = 2500.0 * density
    rough, smooth = material(0.4, wall=True), material(0.0, wall=True)
    platen, side = (smooth, rough) if names == TRANSPOSED else (rough, smooth)
    walls = Walls.around(width * length, height * length, platen, side)
    order = range(24) if order is None else order
    ids = dict(zip(order, (O.bodies.append(scene.disk(where[k] * length, r[k] * length, stuff)) for k in order)))
    mass = 2500.0 * density * length**2 * np.pi * float(np.sum(r**2))
    for name in ("right", "top"):
        walls.free(names[name], 0.5 * mass)
    if names == MIRROR:
        walls.drive("right")  # which `free` has not touched; the left one is free
    unit = np.sqrt(density * length**2 / pressure)  # of time, √(m/p)
    O.engines, O.dt = (
        scene.engines(gravity=(0, 0, 0), verlet=0.1 * length, correctionSpeed=length / unit, **TIGHT),
        2e-3 * unit,
    )
    walls.pressure = PRESSURE * pressure
    for _ in range(steps):
        walls.step()
    scene.contact_dynamics().view()
    found = np.array([np.array(O.bodies[ids[k]].state.pos)[:2] for k in range(24)]) / length
    at = {name: np.array(walls.place(names[name]))[:2] / length for name in SIDES}
    if names == MIRROR:
        found[:, 0], at = WIDTH - found[:, 0], {name: np.array([WIDTH - p[0], p[1]]) for name, p in at.items()}
    if names == TRANSPOSED:
        found, at = found[:, ::-1], {name: p[::-1] for name, p in at.items()}
    stresses, forces = walls.stresses(), walls.forces()
    return (
        found,
        np.array([at["right"][0], at["top"][1], at["left"][0], at["bottom"][1]]),
        np.array([stresses[names[s]] for s in SIDES]) / PRESSURE / pressure,
        np.array([forces[names[s]] for s in SIDES]) / PRESSURE / pressure / length,
    )


@pytest.fixture(scope="module")
def here():
    found = pressed()
    O.reset()
    places, walls, stresses, _ = found
    # all disks are up to date, and above their first places or beside them; the walls have come in and press; rough
    # platens keep it from the left one
    assert np.abs(places - disks()[0]).max(axis=1).min() > 1e-3
    assert walls[0] < WIDTH - 0.1 and walls[1] < HEIGHT - 0.1 and (stresses > 0.5).sum() == 3
    return found


def same(found, expected, tolerance):
    for one, other in zip(found, expected):
        assert np.abs(one - other).max() < tolerance


@pytest.mark.parametrize("names", [MIRROR, TRANSPOSED], ids=["mirror", "transposed"])
def test_a_sample_pressed_the_other_way_round(here, names):
    same(pressed(names), here, ROUNDING)


def test_a_sample_in_other_units(here):
    same(pressed(length=1e3, pressure=3.7, density=1e-2), here, ROUNDING)


def test_a_sample_with_other_ids(here):
    same(pressed(order=list(range(24))[::-1]), here, SOLVED)
    same(pressed(order=np.random.default_rng(1).permutation(24).tolist()), here, SOLVED)


def test_forces_of_four_walls_by_hand():
    """One disk between four walls: those that are held take what the free ones give, to the last newton."""
    stuff = material(0.0)
    walls = Walls.around(1.0, 1.0, stuff, stuff)
    O.bodies.append(scene.disk((0.5, 0.5), 0.5, stuff))
    O.engines, O.dt = scene.engines(gravity=(0, 0, 0), **TIGHT), 1e-3
    walls.free("right", 100.0)
    walls.free("top", 100.0)
    walls.pressure = 4e4
    for _ in range(3):
        walls.step()
    assert walls.forces() == pytest.approx(dict.fromkeys(SIDES, 4e4), rel=1e-9)
    assert walls.stresses() == pytest.approx(dict.fromkeys(SIDES, 4e4), rel=1e-9)
    assert (
        (walls.width(), walls.height()) == pytest.approx((1.0, 1.0), abs=1e-9)
        and walls.is_free("top")
        and not walls.is_free("left")
    )
    walls.drive("top", (0, -0.2))  # a platen that comes down: the disk yields nowhere
    assert not walls.is_free("top") and O.forces.permF(walls.ids["top"]).norm() == 0
    walls.free("top", 100.0)
    walls.drive("right", (0.5, 0))  # one that goes: nothing is pressed across any more
    walls.step()
    walls.step()
    push = 4e4 * (1 + 0.5 * O.dt)  # the width at the step's beginning
    assert walls.forces() == pytest.approx(
        {"bottom": push, "top": push, "left": 1e-9, "right": 1e-9}, rel=1e-9, abs=1e-6
    )
    assert walls.width() == pytest.approx(1.0 + 0.5 * 2 * O.dt, abs=1e-9)


def test_stresses_are_forces_over_the_wall_that_bears_them(monkeypatch):
    walls = Walls.around(2.0, 4.0, material(), material())
    monkeypatch.setattr(walls, "forces", lambda: dict.fromkeys(SIDES, 8.0))
    assert walls.stresses() == pytest.approx({"bottom": 4.0, "top": 4.0, "left": 2.0, "right": 2.0}, rel=1e-12)


def test_the_pressure_follows_the_lengths_of_the_sample():
    stuff = material(0.0)
    walls = Walls.around(4.0, 3.0, stuff, stuff)
    O.engines, O.dt = scene.engines(gravity=(0, 0, 0), **TIGHT), 1e-2
    walls.free("right", 50.0)
    walls.free("left", 70.0)
    walls.pressure = 100.0
    walls.step()
    # no disk: F = p H, outwards negative
    assert walls.state("right").vel[0] == pytest.approx(-100 * 3 / 50 * 1e-2, rel=1e-12) and walls.state("left").vel[
        0
    ] == pytest.approx(100 * 3 / 70 * 1e-2, rel=1e-12)
    assert walls.forces() == pytest.approx({"bottom": 0, "right": 0, "left": 0, "top": 0}, abs=1e-9)


# ---- the membrane ---------------------------------------------------------------------------------


def made_sample(seed=4):
    x, y = (v.ravel().astype(float) for v in np.meshgrid(np.arange(9), np.arange(15)))
    dice = np.random.default_rng(seed)
    return (
        x + 0.05 * dice.standard_normal(len(x)),
        y + 0.05 * dice.standard_normal(len(y)),
        dice.uniform(0.45, 0.55, len(x)),
    )


BOTTOM, TOP, SIGMA = -0.55, 14.55, 7.0


def test_the_membrane_of_a_lattice_by_hand():
    """Columns one above the other: an inner disk of a side carries σ₃ times the spacing, the ends half of it and what
    is left to the platens.
    """
    x, y = (v.ravel().astype(float) for v in np.meshgrid(np.arange(4) + 1e-9, np.arange(6)))
    x = x + 1e-7 * np.sin(7 * np.arange(24))  # so that no four disks lie on a circle
    force, area = membrane.forces(x, y, np.full(24, 0.5), -0.7, 5.6, SIGMA)
    left, right = force.reshape(6, 4, 2)[:, 0], force.reshape(6, 4, 2)[:, -1]
    expected = SIGMA * np.array([0.5 + 0.7, 1, 1, 1, 1, 0.5 + 0.6])
    assert left[:, 0] == pytest.approx(expected, abs=1e-5) and right[:, 0] == pytest.approx(-expected, abs=1e-5)
    assert np.abs(force[:, 1]).max() < 1e-5 and np.abs(force.reshape(6, 4, 2)[:, 1:-1]).max() == 0
    assert area == pytest.approx(4.0 * 6.3, abs=1e-5)


@pytest.mark.parametrize("name", ["mirror", "upside down", "shifted", "units", "ids", "pressure"])
def test_the_membrane_in_another_frame(name):
    x, y, r = made_sample()
    force, area = membrane.forces(x, y, r, BOTTOM, TOP, SIGMA)
    assert (np.abs(force).max(axis=1) > 0).sum() == 30 and np.abs(force.sum(axis=0)[0]) < 1e-12 * 15 * SIGMA
    order = np.random.default_rng(3).permutation(len(x))
    found, inside = {
        "mirror": lambda: membrane.forces(-x, y, r, BOTTOM, TOP, SIGMA),
        "upside down": lambda: membrane.forces(x, -y, r, -TOP, -BOTTOM, SIGMA),
        "shifted": lambda: membrane.forces(x + 50, y - 20, r, BOTTOM - 20, TOP - 20, SIGMA),
        "units": lambda: membrane.forces(1e3 * x, 1e3 * y, 1e3 * r, 1e3 * BOTTOM, 1e3 * TOP, SIGMA),
        "ids": lambda: membrane.forces(x[order], y[order], r[order], BOTTOM, TOP, SIGMA),
        "pressure": lambda: membrane.forces(x, y, r, BOTTOM, TOP, -2 * SIGMA),
    }[name]()
    expected = {
        "mirror": force * (-1, 1),
        "upside down": force * (1, -1),
        "units": 1e3 * force,
        "ids": force[order],
        "pressure": -2 * force,
    }.get(name, force)
    scale = {"units": 1e3}.get(name, 1.0)
    assert np.abs(found - expected).max() < 1e-11 * SIGMA * scale  # rounding, places of 50 m
    assert inside == pytest.approx(area * scale**2, rel=1e-12)


def test_a_membrane_turns_a_sample_only_as_its_ends_do():
    """A closed line under a pressure has no moment; what is missing are the two platens, from end to end."""
    x, y, r = made_sample(9)
    force, _ = membrane.forces(x, y, r, BOTTOM, TOP, SIGMA)
    left, right = membrane.sides(x, y, r, BOTTOM, TOP)
    at = np.column_stack((x, y))
    at[left, 0] -= r[left]
    at[right, 0] += r[right]
    # the whole line's: each edge's force acts half at each end, so its moment is that of its middle, as a pressure's
    # is; but the straight pieces to the platens act on the end disks, from whose height to the platen's their arm is
    # counted
    moment = np.sum(at[:, 0] * force[:, 1] - at[:, 1] * force[:, 0])
    lt, lb, rb, rt = at[[left[0], left[-1], right[0], right[-1]], 0]
    # of the pressure on the platens, upwards below and downwards above
    lid = SIGMA * 0.5 * ((rb**2 - lb**2) - (rt**2 - lt**2))
    arm = 0.0
    for chain, sign in ((left, 1), (right, -1)):
        for k, end in ((chain[0], TOP if chain is left else BOTTOM), (chain[-1], BOTTOM if chain is left else TOP)):
            arm += sign * SIGMA * abs(end - y[k]) * 0.5 * (end - y[k])  # of the straight piece's middle above its disk
    assert moment - arm + lid == pytest.approx(0, abs=1e-10 * SIGMA * 15**2)
