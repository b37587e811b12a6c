"""Walls whose friction a slip law finds in cells along them: a block of disks beside the closed forms of one cell."""
import math

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.nonsmooth.slip import parameter_sets, surface
from yade.nonsmooth.slip.laws import SlipError, SlipLaw
from yade.wrapper import NewtonIntegrator, NscdMat, SlipSurfaceMat

from contact_scenes import G, begin, contacts, engine, material, run

pytestmark = pytest.mark.usefixtures("empty")

DIP = math.radians(22)
STRESS = 2.183e6  # Pa, of 100 m of rock of 2,400 kg/m³ on this slope
ADIABATIC = dict(
    heat_capacity=2.85e6, thermal_diffusivity=0.0, pressurization_coefficient=6.7e4, hydraulic_diffusivity=0.0
)


def law(critical=1.0634, friction=0.4, **more):
    """A zone without diffusion: strength is f σ exp(−δ/D_c), with D_c = ρc h/(f Λ)."""
    thickness = critical * friction * 6.7e4 / 2.85e6
    return SlipLaw("thermal_pressurization", **{**ADIABATIC, "friction": friction, "thickness": thickness, **more})


def wall(**more):
    return SlipSurfaceMat(**{"law": law(), "density": 2400, **more})


def block(surface_material, length=160.0, seed=1, rows=3, dip=DIP, turn=0.0, mirror=1, reach=40.0, speed=0.1):
    """A block of bonded disks of 1.4 to 2.6 m on a long wall that falls by ``dip`` to the right; returns its disks' ids.

    Its forces on the wall are unequal and travel: the lowest disks are of many sizes, and carry what lies on them.
    """
    dice = np.random.default_rng(seed)
    stuff = material(0.5, 1.0, tensileStrength=1e12, bondCreationDistance=0.05)
    spheres, x = [], 0.0
    while x < length:
        r = dice.uniform(0.7, 1.3)
        spheres.append((x + r, r, r))
        x += 2 * r
    top = list(spheres)
    for _ in range(rows - 1):
        top = [(a, b + 2 * r, r) for a, b, r in top]
        spheres += top
    mass = sum(math.pi * r * r for *_, r in spheres)
    stuff.density = STRESS * x / (G * math.cos(DIP)) / mass

    def placed(a, b):
        c, s = math.cos(dip), math.sin(dip)
        px, py = mirror * (a * c + b * s), -a * s + b * c
        c, s = math.cos(turn), math.sin(turn)
        return px * c - py * s, px * s + py * c

    ends = [placed(-reach, 0), placed(x + reach, 0)]
    O.bodies.append(scene.segments(ends[::mirror], surface_material, piece=11.0))
    ids = [O.bodies.append(scene.disk(placed(a, b), r, stuff)) for a, b, r in spheres]
    way = Vector3(placed(1, 0)[0], placed(1, 0)[1], 0)
    down = (G * math.sin(turn), -G * math.cos(turn), 0)
    begin(gravity=down, dt=0.005, tolerance=1e-6, maxIterations=2000)
    run(1)
    assert engine().bond() >= len(ids) - 1  # one stiff body
    for i in ids:
        O.bodies[i].state.vel = speed * way
    return ids, way


def course(ids, way, surface_material, steps, share=0.0):
    """Slip [m] of the block and the mean share of the strength that is left in cells that lie below it all the time, after each
    step until ``share`` is left.
    """
    start = O.bodies[ids[0]].state.pos
    places = [O.bodies[i].state.pos.dot(way) for i in ids]
    ends = np.sort(surface.cells(surface_material)["ends_m"] @ np.array(way)[:2], axis=1)
    inner = (ends[:, 0] > min(places) + 14) & (ends[:, 1] < max(places))
    if not inner.any():  # a block that is shorter than that: all cells
        inner[:] = True
    rows = []
    for _ in range(steps):
        run(1)
        slip = (O.bodies[ids[0]].state.pos - start).dot(way)
        friction = surface.cells(surface_material)["friction"]
        rows.append((slip, float(np.mean(friction[inner]) / 0.4)))
        if rows[-1][1] < share:
            break
    return np.array(rows)


def reached(rows, share):
    """Slip at which a share was left first, between two steps."""
    k = int(np.argmax(rows[:, 1] < share))
    assert rows[k, 1] < share, "strength did not fall so far"
    return float(np.interp(share, rows[k - 1 : k + 1, 1][::-1], rows[k - 1 : k + 1, 0][::-1]))


def test_a_law_says_what_friction_is():
    m = wall()
    assert m.frictionAngle == pytest.approx(math.atan(0.4)) and m.wall
    names, values = m.law
    assert names == ("thermal_pressurization",) and values["friction"] == [0.4]
    m.law = law(friction=0.3)
    assert m.frictionAngle == pytest.approx(math.atan(0.3))
    assert surface.units(m) == {"temperature": "°C", "pressure": "Pa", "vapour": "-"}
    assert all(len(column) == 0 for column in surface.cells(m).values())  # no step yet


@pytest.mark.parametrize("dt", [0.005, 0.01])
@pytest.mark.parametrize("critical, most", [(1.0634, 1000), (5.0, 2000)])
def test_a_block_loses_its_strength_as_one_cell_does(critical, most, dt):
    # 10 % are left at ln 10 D_c; forces of a block of disks are unequal and travel, hence 5 %
    m = wall(law=law(critical))
    ids, way = block(m)
    O.dt = dt
    rows = course(ids, way, m, most, share=0.1)
    assert reached(rows, 0.1) == pytest.approx(math.log(10) * critical, rel=0.05)


@pytest.mark.parametrize("critical, most", [(1.0634, 1000), (5.0, 2000)])
def test_half_the_step_and_half_the_cell_change_little(critical, most):
    """Slip and speed where 10 % are left: by less than 2 %, the most that numbers of this kind are quoted to."""
    found = []
    for dt, length in ((0.01, 0.0), (0.005, 0.0), (0.01, 8.0)):  # a cell of eight diameters has 16 m
        O.reset()
        m = wall(law=law(critical), cellLength=length)
        ids, way = block(m)
        O.dt = dt
        found.append((reached(course(ids, way, m, most, share=0.1), 0.1), O.bodies[ids[0]].state.vel.norm()))
        assert np.mean(surface.cells(m)["length_m"]) == pytest.approx(length or 16.0, rel=0.05)
    for other in found[1:]:
        assert other == pytest.approx(found[0], rel=0.02)


def test_heat_is_what_sliding_loses():
    m = wall()
    ids, way = block(m)
    course(ids, way, m, 200)
    O.dt = 0.0075  # in between
    course(ids, way, m, 100)
    lost = sum(engine().wallSlidingLoss)
    assert m.heat == pytest.approx(lost, rel=1e-10)  # sums of the same numbers in another order
    found = surface.cells(m)
    thickness = m.law[1]["thickness"][0]
    kept = (
        2.85e6 * thickness * np.sum(found["length_m"] * (found["temperature"] - 15))
    )  # one node, since nothing diffuses
    assert kept == pytest.approx(lost, rel=1e-10)


def test_a_cell_slips_by_the_way_of_what_slides_on_it():
    m = wall(cellLength=1000.0)
    ids, way = block(m, length=4.0, rows=1, speed=0.5)
    begun = O.bodies[ids[0]].state.vel.dot(way)
    rows = course(ids, way, m, 250)
    found, ended = surface.cells(m), O.bodies[ids[0]].state.vel.dot(way)
    assert found["slip_rate_m_per_s"] == pytest.approx([ended], rel=1e-6)
    # places go by the speed of a step's end, cells by its mean, of which heat is made; errors of position are less
    ahead = 0.5 * O.dt * (ended - begun)
    assert found["slip_m"] == pytest.approx([rows[-1, 0] - ahead], abs=1e-4) and abs(ahead) > 1e-3


@pytest.mark.parametrize("change", [dict(mirror=-1), dict(turn=0.7), dict(turn=-2.0)])
def test_mirrored_and_turned_slopes_do_the_same(change):
    # three disks in a row, whose forces are unique: rounding alone
    m = wall(cellLength=2.0)
    rows = course(*block(m, length=4.0, rows=1, speed=0.5), m, 250)
    O.reset()
    other = wall(cellLength=2.0)
    assert course(*block(other, length=4.0, rows=1, speed=0.5, **change), other, 250) == pytest.approx(rows, rel=1e-9)


def test_cells_do_not_know_how_walls_are_cut():
    stuff = material(0.5)
    for piece, expected in ((3.0, 5), (40.0, 5)):
        O.reset()
        m = wall(cellLength=8.0)
        O.bodies.append(scene.segments([(0, 0), (20, 0), (20, 20)], m, piece=piece))
        O.bodies.append(scene.disk((1, 1), 1.0, material(0.5)))
        begin()
        run(1)
        found = surface.cells(m)
        assert len(found["begin_m"]) == expected
        assert found["begin_m"] == pytest.approx(8.0 * np.arange(5)) and found["length_m"] == pytest.approx(8.0)
        assert found["ends_m"][2] == pytest.approx(np.array([(16, 0), (20, 4)]))
        assert found["normal_stress_Pa"] == pytest.approx([math.pi * 2500 * G / 8, 0, 0, 0, 0], rel=1e-9)
    assert stuff is not None


def test_walls_apart_have_cells_apart_and_arcs_have_them_too():
    m = wall(cellLength=8.0)
    O.bodies.append(scene.segments([(0, 0), (12, 0)], m))
    O.bodies.append(scene.segments([(100, 0), (112, 0)], m))
    O.bodies.append(scene.arc((0, 50), 10.0, math.pi, 2 * math.pi, m))
    disk = O.bodies.append(scene.disk((0, 42), 2.0, material(0.5)))
    begin()
    run(1)
    found = surface.cells(m)
    assert found["length_m"] == pytest.approx([6, 6, 6, 6] + 4 * [10 * math.pi / 4])
    lowest = [i for i in contacts() if disk in (i.id1, i.id2)][0].phys.cell
    assert lowest in (5, 6)  # the bottom is where they meet
    assert found["ends_m"][5][1] == pytest.approx((0, 40)) and found["ends_m"][4][0] == pytest.approx((-10, 50))


@pytest.mark.parametrize("backwards", [False, True])
def test_strength_has_no_joints(backwards):
    """A disk that slides over a joint keeps the friction of the cell; also where walls run the other way, as those of a
    mirrored slope do."""
    m = wall(law=SlipLaw("step", friction=0.4, weakened_friction=0.0, critical_slip=0.5), cellLength=1000.0)
    O.bodies.append(scene.segments([(-5, 0), (5, 0), (15, 0)], m, backwards=backwards))
    disk = O.bodies.append(scene.disk((0, 0.5), 0.5, material(0.5)))
    begin(dt=1e-3)
    O.bodies[disk].state.blockedDOFs = "zXYZ"
    O.bodies[disk].state.vel = (10, 0, 0)
    frictions = []
    for _ in range(1200):
        run(1)
        frictions += [i.phys.currentFriction for i in contacts()]
    assert O.bodies[disk].state.pos[0] > 6 and m.cellCount() == 1
    assert frictions == sorted(frictions, reverse=True) and frictions[-1] == 0


def test_a_wall_that_runs_back_has_its_cells_where_they_are():
    for backwards in (False, True):
        O.reset()
        m = wall(cellLength=4.0)
        O.bodies.append(scene.segments([(0, 0), (6, 0), (12, 0)], m, piece=3.0, backwards=backwards))
        disk = O.bodies.append(scene.disk((3.5, 0.5), 0.5, material(0.5)))
        begin()
        run(2)
        found = surface.cells(m)
        (borne,) = np.flatnonzero(found["normal_stress_Pa"])
        lower, upper = sorted(found["ends_m"][borne, :, 0])
        assert (lower, upper) == (pytest.approx(0), pytest.approx(4)) and len(found["slip_m"]) == 3
        assert O.bodies[disk].state.pos[0] == pytest.approx(3.5)


def test_stress_of_a_cell_is_a_mean_over_its_last_slip():
    m = wall(law=SlipLaw("none", friction=0.0), cellLength=100.0, averagingSlip=1.0)
    O.bodies.append(scene.segments([(0, 0), (100, 0)], m))
    disk = O.bodies.append(scene.disk((10, 0.5), 0.5, material(0.0)))
    begin(dt=1e-3)
    O.bodies[disk].state.vel = (1, 0, 0)
    run(2000)
    before = O.bodies[disk].state.mass * G / 100
    assert surface.cells(m)["normal_stress_Pa"] == pytest.approx([before], rel=1e-6)
    next(e for e in O.engines if isinstance(e, NewtonIntegrator)).gravity = (0, -2 * G, 0)
    run(1000)  # another metre: 1/e of the old stress are left
    assert surface.cells(m)["normal_stress_Pa"] == pytest.approx([before * (2 - math.exp(-1))], rel=1e-3)


def test_cells_of_walls_that_are_gone_have_no_places():
    m = wall()
    O.bodies.append(scene.segments([(0, 0), (20, 0)], m))
    begin()
    run(1)
    O.reset()
    assert np.isnan(surface.cells(m)["ends_m"]).all() and len(surface.cells(m)["slip_m"]) == 3


def test_a_material_that_is_used_again_begins_anew():
    m = wall()
    ids, way = block(m, length=20.0)
    course(ids, way, m, 50)
    assert m.heat > 0
    O.reset()
    ids, way = block(m, length=20.0)
    assert m.heat == pytest.approx(sum(engine().wallSlidingLoss), rel=1e-10, abs=1e-6)
    course(ids, way, m, 50)
    assert m.heat == pytest.approx(sum(engine().wallSlidingLoss), rel=1e-10)


def test_what_is_saved_goes_on_with_the_same_bits(tmp_path):
    m = wall(label="slide")
    ids, way = block(m, length=60.0)
    course(ids, way, m, 60)
    O.save(str(tmp_path / "scene.yade.bz2"))
    whole = course(ids, way, m, 60), surface.cells(m)
    O.load(str(tmp_path / "scene.yade.bz2"))
    again = O.materials["slide"] if "slide" in [n.label for n in O.materials] else O.bodies[0].material
    rest = course(ids, way, again, 60), surface.cells(again)
    assert np.array_equal(whole[0][:, 1], rest[0][:, 1])
    assert all(np.array_equal(whole[1][name], rest[1][name]) for name in whole[1])


def test_what_is_forgotten_has_not_slipped():
    m = wall()
    ids, way = block(m, length=60.0)
    course(ids, way, m, 100)
    assert surface.cells(m)["slip_m"].max() > 0.01
    m.forgetSlip()
    found = surface.cells(m)
    assert not found["slip_m"].any() and not (found["temperature"] - 15).any() and m.heat == 0
    assert found["friction"] == pytest.approx(0.4)


@pytest.mark.parametrize("name", ["vaiont", "fault_gouge", "silica_gel"])
def test_what_is_held_keeps_its_friction_and_knows_what_presses(name):
    """Also of laws that go by the speed. From when it is let go it slips, weakens and heats."""
    m = wall(
        law=parameter_sets.law(name, friction=0.4) if name != "silica_gel" else parameter_sets.law(name), held=True
    )
    before = float(np.tan(m.frictionAngle))
    ids, way = block(m, length=60.0, speed=2.0)
    run(40)
    found = surface.cells(m)
    below = found["normal_stress_Pa"] > 1e5
    assert below.any() and found["friction"] == pytest.approx(before, rel=1e-12)  # rounding
    assert not found["slip_m"].any() and not found["slip_rate_m_per_s"].any() and m.heat == 0
    assert "temperature" not in found or np.ptp(found["temperature"]) < 1e-9  # rounding
    m.held = False
    run(40)
    after = surface.cells(m)
    assert after["slip_m"][below].max() > 0.1 and after["friction"][below].min() < before - 1e-3 and m.heat > 0


def test_a_wall_below_its_friction_stays_cold():
    m = wall()
    ids, way = block(m, length=60.0, dip=math.radians(10), speed=0.0)
    course(ids, way, m, 100)
    found = surface.cells(m)
    assert found["temperature"] == pytest.approx(15.0, abs=1e-3)
    # the weight that rests on the wall, whichever cells carry it
    weight = sum(O.bodies[i].state.mass for i in ids) * G * math.cos(math.radians(10))
    assert np.sum(found["normal_stress_Pa"] * found["length_m"]) == pytest.approx(weight, rel=0.05)


@pytest.mark.parametrize(
    "values, words",
    [
        (dict(law="vaiont"), "SlipLaw"),
        (dict(frictionAngle=0.3), "frictionAngle"),
        (dict(residualFrictionAngle=0.1), "residualFrictionAngle"),
        (dict(cellLength=-1), "cellLength"),
        (dict(wall=False), "wall"),
        (dict(averagingSlip=math.inf), "averagingSlip"),
    ],
)
def test_what_makes_no_sense_is_refused(values, words):
    with pytest.raises(ValueError, match=words):
        wall(**values)


def test_cells_lie_on_segments_of_a_wall_alone():
    m = wall()
    O.materials.append(m)
    O.bodies.append(scene.segments([(0, 0), (20, 0)], material(0.5)))
    O.bodies.append(scene.disk((5, 1), 1.0, m))
    begin()
    with pytest.raises(RuntimeError, match="Segments and Arcs"):
        run(1)
    O.reset()
    layer = NscdMat(density=2500, frictionAngle=0.5, interfaceLayers=[1], interfaceLaws=[wall()])
    with pytest.raises(ValueError, match="along walls"):
        begin_with(layer)


def begin_with(stuff):
    O.materials.append(stuff)
    O.bodies.append(scene.segments([(0, 0), (20, 0)], stuff))
    O.bodies.append(scene.disk((5, 1), 1.0, stuff))
    begin()
    try:
        run(1)
    except RuntimeError as error:
        raise ValueError(str(error)) from None


def test_a_wall_that_comes_later_needs_its_own():
    m = wall()
    O.bodies.append(scene.segments([(0, 0), (20, 0)], m))
    O.bodies.append(scene.disk((5, 1), 1.0, material(0.5)))
    begin()
    run(1)
    O.bodies.append(scene.segments([(40, 0), (60, 0)], m))
    with pytest.raises(RuntimeError, match="a material of their own"):
        run(1)


def test_cells_are_cut_once_and_are_no_more_than_a_million():
    m = wall(cellLength=5.0)
    O.bodies.append(scene.segments([(0, 0), (20, 0)], m))
    O.bodies.append(scene.disk((5, 1), 1.0, material(0.5)))
    begin()
    run(1)
    m.cellLength = 3.0
    O.bodies.append(scene.disk((15, 1), 1.0, material(0.5)))
    with pytest.raises(RuntimeError, match="cellLength = 3: its cells have been cut, 5 m long"):
        run(1)
    O.reset()
    O.bodies.append(scene.segments([(0, 0), (20, 0)], wall(cellLength=1e-9)))
    begin()
    with pytest.raises(RuntimeError, match="2e.10 cells along 20 m of wall; give at least 2e-05 m"):
        run(1)


def test_no_law_is_refused():
    m = SlipSurfaceMat(density=2400)
    with pytest.raises((RuntimeError, ValueError), match="law"):
        begin_with(m)


def test_other_materials_have_no_cells():
    with pytest.raises(SlipError, match="SlipSurfaceMat"):
        surface.cells(material(0.5))
