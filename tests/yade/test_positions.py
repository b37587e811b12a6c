"""Errors of position are taken back by displacements: overlaps go, bonds find their length, and no velocity is left behind."""
import math

import pytest
from yade import O

from contact_scenes import begin, engine, floor, free_disk, material, momenta, run

KAPPA = 0.2
SLIGHT = 1e-4  # ℓ, correctionSlack as it is unless set: an error that is left as it is


@pytest.fixture(autouse=True)
def clean():
    O.reset()
    yield
    O.reset()


def hexagonal_block(overlap, side=20, stuff=None):
    """Ids of side × side disks of 1 m in a hexagonal block whose neighbours overlap by that share of a diameter."""
    stuff = stuff or material(0.3)
    return [free_disk((i + 0.5 * (j % 2)) * (1 - overlap), j * math.sqrt(0.75) * (1 - overlap), stuff=stuff) for j in range(side) for i in range(side)]


def relative_energy(disks):
    """Kinetic energy [J] of the disks relative to their centre of mass, and their mass [kg]."""
    states = [O.bodies[d].state for d in disks]
    mass = sum(s.mass for s in states)
    mean = sum((s.mass * s.vel for s in states), states[0].vel * 0) / mass
    return sum(0.5 * s.mass * (s.vel - mean).squaredNorm() + 0.5 * s.inertia[2] * s.angVel[2] ** 2 for s in states), mass


def test_a_dense_block_in_free_fall_is_not_blown_apart():
    disks, overlap, dt = hexagonal_block(1e-3), 1e-3, 1e-3
    begin(dt=dt, relaxationRate=KAPPA)
    run(50)
    energy, mass = relative_energy(disks)
    # a bias κ g/h on the velocity gives every overlapping pair this speed in the very first step, half of it to each
    biased = 0.5 * mass * (0.5 * KAPPA * overlap / dt) ** 2
    assert energy < 1e-9 * biased
    # a pair's would be down to 0.8^50 = 1.4e-5 of itself; inside a block overlaps have to wait for the rim
    assert engine().overlapWorst < 0.1 * overlap + SLIGHT
    assert O.bodies[disks[0]].state.vel[1] == pytest.approx(-9.81 * 50 * dt, rel=1e-12)


def test_an_overlap_shrinks_by_its_share_a_step_and_the_centre_stays():
    stuff = material(0.3)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(0.99, 0, stuff=stuff)
    begin(gravity=(0, 0, 0), relaxationRate=KAPPA, correctionSpeed=1e3)
    run(1)
    for step in range(1, 20):
        # geometry is read at the beginning of a step; rounding of a handful of operations
        gap = (O.bodies[b].state.pos - O.bodies[a].state.pos).norm() - 1
        assert gap + SLIGHT == pytest.approx((-0.01 + SLIGHT) * (1 - KAPPA) ** step, rel=1e-10)
        assert O.bodies[a].state.pos[0] + O.bodies[b].state.pos[0] == pytest.approx(0.99, abs=1e-14)
        assert O.bodies[a].state.vel.norm() == 0
        O.step()


@pytest.mark.parametrize("slack", [SLIGHT, 0.0])
@pytest.mark.parametrize("moved", [-0.004, 0.004])
def test_a_bond_finds_its_length_from_both_sides(moved, slack):
    stuff = material(0.3, 0.1, tensileStrength=1e6, bondEllipseNormal=0.02, bondEllipseTangential=0.02)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(1.01, 0, stuff=stuff)
    begin(gravity=(0, 0, 0), relaxationRate=KAPPA, correctionSpeed=1e3, correctionSlack=slack)
    O.step()
    assert engine().bond() == 1
    O.bodies[b].state.pos += (moved, 0, 0)
    run(60)
    # 0.8^60 = 1.5e-6 of the 4 mm is left
    assert O.bodies[b].state.pos[0] - O.bodies[a].state.pos[0] == pytest.approx(1.01 + math.copysign(slack, moved), abs=1e-5 * abs(moved))
    assert engine().bonds == 1 and O.bodies[b].state.vel.norm() == 0
    assert engine().energies()["debonding"] == 0


def test_nothing_is_taken_back_without_a_rate_or_sweeps():
    stuff = material(0.3)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(0.99, 0, stuff=stuff)
    for options in ({"relaxationRate": 0}, {"correctionSweeps": 0}):
        begin(gravity=(0, 0, 0), **options)
        run(10)
        assert O.bodies[b].state.pos[0] - O.bodies[a].state.pos[0] == 0.99


def test_the_speed_of_a_correction_is_limited():
    stuff = material(0.3)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(0.9, 0, stuff=stuff)
    begin(gravity=(0, 0, 0), relaxationRate=1, correctionSpeed=0.5, dt=1e-2)
    O.step()
    assert O.bodies[b].state.pos[0] - O.bodies[a].state.pos[0] == pytest.approx(0.9 + 0.5 * 1e-2, rel=1e-12)


def test_what_lifts_a_disk_is_counted():
    stuff = material(0.3)
    floor(stuff)
    disk = free_disk(0, 0.49, stuff=stuff)
    begin(relaxationRate=KAPPA, correctionSpeed=1e3)
    run(100)
    s, e = O.bodies[disk].state, engine()
    assert s.pos[1] == pytest.approx(0.5 - SLIGHT, abs=1e-9) and s.vel.norm() < 1e-12
    # from 0.49 m to there, as far as 0.8^99 lets it
    assert e.correctionEnergy == pytest.approx(s.mass * 9.81 * (0.01 - SLIGHT), rel=1e-7)
    assert abs(e.energyError) < 1e-9 * e.correctionEnergy + 1e-6  # J; rounding of m g y, 1e4 J


def test_disks_are_not_pushed_into_others_that_they_do_not_touch_yet():
    stuff = material(0.3)
    ids = [free_disk(x, 0, stuff=stuff) for x in (0, 0.98, 1.981)]
    begin(gravity=(0, 0, 0), relaxationRate=1, correctionSpeed=1e3, correctionSweeps=200)
    run(3)
    x = [O.bodies[i].state.pos[0] for i in ids]
    # the chain's answer: the first pair needs 0.02, the second had 0.001 to spare
    assert x[1] - x[0] == pytest.approx(1 - SLIGHT, abs=1e-9) and x[2] - x[1] == pytest.approx(1 - SLIGHT, abs=1e-9)


def test_a_spinning_pair_keeps_its_angular_momentum_and_its_length():
    stuff = material(0.3, 0.1, tensileStrength=1e9, bondEllipseNormal=0.1, bondEllipseTangential=0.1)
    pair = [free_disk(-0.5, 0, (0, -1, 0), stuff), free_disk(0.5, 0, (0, 1, 0), stuff)]
    for d in pair:
        O.bodies[d].state.angVel = (0, 0, 2)
    begin(gravity=(0, 0, 0), dt=5e-3)
    O.step()
    assert engine().bond() == 1
    linear, angular = momenta(pair)
    run(2000)  # 10 s, three turns
    after, turned = momenta(pair)
    # equal and opposite at every step; rounding of 2000 steps
    assert abs(turned - angular) < 1e-11 * abs(angular) and (after - linear).norm() < 1e-11 * O.bodies[pair[0]].state.mass
    # every step overshoots by ω² h²/2 = 5e-5 of the length, of which four of five parts are left at κ = 0.2
    assert (O.bodies[pair[1]].state.pos - O.bodies[pair[0]].state.pos).norm() == pytest.approx(1, abs=5e-4)
    assert O.bodies[pair[0]].state.angVel[2] == pytest.approx(2, rel=0.02)
