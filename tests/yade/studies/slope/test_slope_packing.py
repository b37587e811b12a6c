"""Slopes that are pressed: dense, touching, at rest under the pull that presses them, as thick as the section; the same
with a cache, in a mirror and at another size.
"""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest
from slope_scenes import SMALL
from yade import Body, O, Sphere
from yade.nonsmooth import packing, section, similar, tables
from yade.nonsmooth.model import free_surface, geometry
from yade.nonsmooth.packing import relaxation
from yade.nonsmooth.studies.slope import slope_packing
from yade.wrapper import NewtonIntegrator

SHIPPED = section.load("jiufengershan").with_disks(1500)


@pytest.fixture(scope="module")
def made():
    """The packing before, after, and what walls bear there [N/m], summed."""
    before = packing.cached_pack(SHIPPED)
    forces = {}

    def look(share):
        t = tables.contacts(next(e for e in O.engines if hasattr(e, "contactTable")))
        walls = {b.id for b in O.bodies if type(b.shape).__name__ == "Segment"}
        on = np.array([i in walls or j in walls for i, j in zip(t["id1"], t["id2"])])
        sign = np.where([i in walls for i in t["id1"]], 1.0, -1.0)[on]
        push = (t["normal"][on] * sign)[:, None] * np.column_stack((t["nx"], t["ny"]))[on]
        forces.update(share=share, push=push.sum(axis=0), friction=float(np.abs(t["tangential"]).max()))

    after = slope_packing.press(SHIPPED, before, look)
    return before, after, forces


def touching(packed, gap=1e-3):
    """Pairs with gaps below a share of their mean diameter, and disks with fewer than two of them."""
    i, j = relaxation.close_pairs(packed.x, packed.y, packed.r, 0.02 * packed.r.max())
    near = geometry.distance(packed.x[i] - packed.x[j], packed.y[i] - packed.y[j]) < (packed.r[i] + packed.r[j]) * (
        1 + gap
    )
    return np.bincount(np.concatenate((i[near], j[near])), minlength=len(packed))


def test_it_is_denser_and_more_disks_touch(made):
    """A loose frictionless packing has its last per cent to go (0.848 packed, 0.857 pressed by gravity); packed, no
    pair touches to 1e-4, pressed four per disk do but for rattlers: 2 N contacts are what N disks without friction are
    held by, a tenth of them loose."""
    before, after, _ = made
    denser = packing.packing_fraction(after, SHIPPED.outline) / packing.packing_fraction(before, SHIPPED.outline)
    assert 1.003 < denser < 1.013
    assert touching(before, 1e-4).sum() == 0 and 3.4 < touching(after, 1e-4).mean() < 4.1


def test_it_is_as_thick_as_the_section(made):
    """Area of the disks by that of the layers and the bulk's fraction, less the looser strips along walls: within half
    a per cent of a packing that is not pressed.
    """
    _, after, _ = made
    plain = packing.cached_pack(dataclasses.replace(SHIPPED, pressed=False))
    thick = [math.pi * np.sum(p.r**2) / packing.packing_fraction(p, SHIPPED.outline) for p in (after, plain)]
    assert thick[0] / thick[1] == pytest.approx(1.0, abs=5e-3)
    top = free_surface.inward(SHIPPED, after.x, after.y)[1] - after.r
    # highest and lowest of the surface's disks: within a diameter of the largest
    assert -1.0 * SHIPPED.largest < top.min() < 0.1 * SHIPPED.largest


def test_walls_bear_what_presses(made):
    """Sum of the pulls, which hold each other but for the walls: to 2 % of it, what the slowest disks still move by.
    Nothing is borne by friction.
    """
    before, after, forces = made
    way, _ = free_surface.inward(SHIPPED, after.x, after.y)
    weight = SHIPPED.materials["rock"].density * math.pi * after.r**2 * SHIPPED.gravity
    pull = (weight[:, None] * way).sum(axis=0)
    assert np.abs(forces["push"] + pull).max() < 0.02 * np.hypot(*pull)
    assert forces["friction"] == 0.0


def test_radii_and_layers_are_those_of_the_packing_and_layers_stay_in_place(made):
    before, after, _ = made
    assert np.array_equal(before.r, after.r) and np.array_equal(before.layer, after.layer)
    moved = np.hypot(after.x - before.x, after.y - before.y)
    assert np.median(moved) < 0.5 * SHIPPED.largest
    away = [SHIPPED.layers[k].polygon.distance(geometry.Point(x, y)) for x, y, k in zip(after.x, after.y, after.layer)]
    assert np.mean(np.array(away) > 2 * after.r.mean()) < 0.03
    assert packing.overlaps(after).worst < 1e-3
    assert len(O.bodies) == 0  # nothing is left in the scene


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(
    "growth, looks",
    [
        ([2e-2, 3e-3, 1.1e-4, 0.9e-4], 4),  # of itself: the first below 1e-4 is the last
        ([0.5e-4], 1),
        ([-1e-3], 1),  # it has sprung back
        ([2e-4] * 20, slope_packing.LONGEST),
    ],
)
def test_pressing_ends_when_the_mean_depth_grows_no_more_at_any_size(monkeypatch, size, growth, looks):
    """Depths are made up: of a slope of any size they grow by the same shares, and as many looks, √(H/g) apart, are
    made.
    """
    made = dataclasses.replace(section.load(str(SMALL)), pressed=True)
    packed = packing.Packing(np.zeros(3), np.arange(3.0), np.array([1.0, 2.0, 1.0]), np.zeros(3, int))
    depths = [size * np.array([1.0, 2.0, 4.0])]
    for share in growth:
        depths.append(depths[-1] * (1 + share))
    seen, times, shares = iter(depths), [], []
    O.engines = [NewtonIntegrator()]
    monkeypatch.setattr(slope_packing.slope, "build", lambda *_: SimpleNamespace(solver=None))
    monkeypatch.setattr(slope_packing.free_surface, "inward", lambda *_: (np.zeros((3, 2)), next(seen)))
    monkeypatch.setattr(slope_packing.tables, "bodies", lambda _: {"x": np.zeros(3), "y": np.zeros(3)})
    monkeypatch.setattr(slope_packing, "_pull", lambda *_: None)
    monkeypatch.setattr(slope_packing, "advance", lambda until: times.append(until))
    slope_packing.press(made, packed, shares.append)
    assert times == pytest.approx([(k + 1) * math.sqrt(4 * size / 9.81) for k in range(looks)], rel=1e-12)
    assert shares == [(k + 1) / slope_packing.LONGEST for k in range(looks)]


def test_it_is_kept_and_a_mirrored_and_a_similar_slope_have_it_too(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    small = dataclasses.replace(section.load(str(SMALL)), pressed=True)
    shares = []
    made = slope_packing.of(small, progress=shares.append)
    assert shares == sorted(shares) and 0.2 < shares[-1] <= 1.0
    monkeypatch.setattr(slope_packing, "press", None)  # what is kept is taken
    again = slope_packing.of(small)
    assert again.checksum == made.checksum and made.checksum != packing.cached_pack(small).checksum
    there = slope_packing.of(similar.mirrored(small))
    assert np.array_equal(there.x, -made.x) and np.array_equal(there.y, made.y)
    large = slope_packing.of(similar.scaled(small, 3.0))
    assert np.array_equal(large.x, 3.0 * made.x) and np.array_equal(large.r, 3.0 * made.r)
    other = dataclasses.replace(small, seed=5)
    with pytest.raises(TypeError):  # another seed is not taken from there
        slope_packing.of(other)
    assert slope_packing.of(dataclasses.replace(small, pressed=False)).checksum != made.checksum


def test_all_shipped_sections_can_be_pressed():
    """With a thousand disks each. What lies loose on a slope may be thrown off it: in six packings of one section up to
    8 of 1,500 disks.
    """
    for name in section.shipped():
        s = dataclasses.replace(section.load(name), pressed=True)
        s = s.with_disks(1500 if name == "interface" else 600)
        after = slope_packing.press(s, packing.cached_pack(s))
        depth = free_surface.inward(s, after.x, after.y)[1]
        assert np.mean(depth < -2 * s.largest) < 0.01 and np.isfinite(after.x).all(), name
        assert touching(after).mean() > 2.8, name


def test_nothing_sticks_rubs_or_bounces_while_it_is_pressed():
    """Nor does water press; densities stay, and the solver is asked for more."""
    before = section.load("jiufengershan")
    after = slope_packing._smooth(before)
    assert before.water is not None and after.water is None and list(after.materials) == list(before.materials)
    for name, m in after.materials.items():
        numbers = [
            getattr(m, f"{part}{of}")
            for part in ("", "residual_")
            for of in ("friction", "rolling_friction", "tensile_strength")
        ]
        assert numbers == [0.0] * 6 and m.restitution == 0.0 and not m.bonded and m.slip_weakening is None
        assert m.density == before.materials[name].density
    assert (after.numerics.tolerance, after.numerics.max_iterations) == (1e-5, 1000)
    assert after.numerics.time_step == before.numerics.time_step and after.layers == before.layers


def test_each_disk_is_drawn_by_its_weight():
    """The second and the third of three bodies, of 2 and 3 kg, under 10 m/s² along (0, -1) and (0.6, -0.8)."""
    O.reset()
    for mass in (1.0, 2.0, 3.0):
        body = Body()
        body.shape, body.state.mass = Sphere(radius=1), mass
        O.bodies.append(body)
    slope_packing._pull(SimpleNamespace(first_disk=1), 10.0, np.array([(0.0, -1.0), (0.6, -0.8)]))
    found = [tuple(O.forces.f(k, True)) for k in range(3)]
    assert found[0] == (0, 0, 0) and found[1] == pytest.approx((0, -20, 0)) and found[2] == pytest.approx((18, -24, 0))
    O.reset()


def test_a_pressed_packing_is_kept_for_what_made_it():
    """Gravity, the step, the path and the search of neighbours decide its bits, and so does the seed, which is the
    section's if none is said.
    """
    one = section.load(str(SMALL))
    n = one.numerics
    others = [
        dataclasses.replace(one, gravity=9.0),
        *(
            dataclasses.replace(one, numerics=dataclasses.replace(n, **change))
            for change in (dict(time_step=1e-4), dict(path=0.123), dict(verlet_distance=0.123))
        ),
        one.with_disks(500),
    ]
    paths = [slope_packing.cache_path(s, 4) for s in (one, *others)]
    assert len(set(paths)) == len(paths) and slope_packing.cache_path(one, 5) != paths[0]
    assert slope_packing.cache_path(one) == slope_packing.cache_path(one, one.seed) and "-4-pressed-" in paths[0].name
    assert (
        slope_packing.cache_path(dataclasses.replace(one, numerics=dataclasses.replace(n, tolerance=1e-7)), 4)
        == paths[0]
    )


def test_it_is_pressed_for_twelve_falls_at_most(monkeypatch):
    """√(H/g) each, H the greatest depth; at once where nothing may go deeper, and after all twelve where every step
    counts.
    """
    small = section.load(str(SMALL))
    plain = packing.cached_pack(small)
    fall = math.sqrt(free_surface.inward(small, plain.x, plain.y)[1].max() / small.gravity)
    for calm, times in ((1e9, 1), (-1e9, 12)):
        monkeypatch.setattr(slope_packing, "CALM", calm)
        ends, shares = [], []
        slope_packing.press(small, plain, lambda share: (shares.append(share), ends.append((O.time, O.dt))))
        assert shares == pytest.approx([(k + 1) / 12 for k in range(times)])
        for k, (time, step) in enumerate(ends):
            assert time == pytest.approx((k + 1) * fall, abs=0.51 * step)  # it ends before half a step is missing
