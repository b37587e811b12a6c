"""Soft counterparts of a material: their thresholds against the hard law's, bonds contact by contact, walls, the step's
limit, the way back.
"""
import dataclasses
import math
import random

import pytest
from yade import O
from yade.nonsmooth import scene, section, soft
from yade.nonsmooth.judges.verification.bonds import (
    FRICTION,
    F_A,
    LENGTH,
    RADIUS,
    RESIDUAL,
    ROLLING,
    SIGMA,
    Pair,
    cases,
)
from yade.nonsmooth.soft.bonds import bonded
from yade.wrapper import CohFrictMat, FrictMat, JCFpmMat, NewtonIntegrator

from contact_scenes import begin, contacts, engine, run

ROCK = section.Material(
    "rock",
    friction=FRICTION,
    residual_friction=0.2,
    rolling_friction=ROLLING,
    residual_rolling_friction=0.05,
    tensile_strength=SIGMA,
    density=2500.0,
)
E = 1e9  # Pa
# A ramp of 8,000 steps overshoots by rate/ω, 7e-4 of a threshold; contacts that yield by 1e-3 ℓ turn the load by 1e-3.
RAMP = 5e-3


pytestmark = pytest.mark.usefixtures("empty")


def parameters(model="cohesion_moment", rock=ROCK, **more):
    return soft.equivalent(rock, E, model, **{**dict(diameter=LENGTH, damping=0.5), **more})


class SoftPair:
    """A fixed disk and a free one at `angle`, as verification.bonds.Pair has them, with soft contacts."""

    def __init__(self, e, angle=0.0, bond=True, gap=0.0, fragile=True):
        O.reset()
        stuff = soft.material(e)
        O.materials.append(stuff)
        self.c, self.s = math.cos(angle), math.sin(angle)
        O.bodies.append(scene.disk((0, 0), RADIUS, stuff, fixed=True))
        self.free = O.bodies.append(scene.disk(((LENGTH + gap) * self.c, (LENGTH + gap) * self.s), RADIUS, stuff))
        O.engines = soft.engines(e, gravity=(0, 0, 0), ductile=not fragile)
        O.dt = 0.5 * e.step_limit
        if e.model == "jcfpm":
            O.bodies[self.free].state.blockedDOFs = "zXYZ"  # nothing resists rolling
        if bond:
            assert soft.bond(e, fragile=fragile) == 1

    def load(self, normal=0.0, shear=0.0, torque=0.0):
        """Compression and shear [N] at the contact point on the free disk, torque about it [N m]."""
        O.forces.setPermF(self.free, (-normal * self.c - shear * self.s, -normal * self.s + shear * self.c, 0))
        O.forces.setPermT(self.free, (0, 0, torque - RADIUS * shear))

    def threshold(self, loads, yields, steps=8000):
        """x at which `yields(contact)` becomes true, None (contact lost) included: loads grow to those of x = 0, then x
        to 1.2.
        """
        for k in range(steps // 4):
            self.load(**{key: value * 4 * k / steps for key, value in loads(0).items()})
            O.step()
        for k in range(steps):
            self.load(**loads(1.2 * k / steps))
            O.step()
            if yields(next(iter(contacts()), None)):
                return 1.2 * k / steps
        return math.inf


def broken(contact):
    return contact is None or not bonded(contact.phys)


def yields(contact):
    """Whether a bond bears one of its thresholds: −F_a, μ_s (F_a + N) or μ_r ℓ (F_a + N)."""
    p = contact.phys
    held = p.normalAdhesion + p.normalForce.dot(contact.geom.normal)
    return (
        held <= 1e-9 * p.normalAdhesion
        or p.shearForce.norm() >= p.tangensOfFrictionAngle * held * (1 - 1e-9)
        or p.moment_bending.norm() >= p.maxRollPl * held * (1 - 1e-9)
    )


#: Loads of verification.bonds: each mode alone, shear and torque under compression and under tension, and shear with
#: torque.
LOADS = list(cases(F_A, FRICTION, ROLLING))


@pytest.mark.parametrize("angle", [0.0, 2.0])
@pytest.mark.parametrize("name", LOADS)
def test_a_soft_bond_breaks_where_the_hard_one_does(name, angle):
    loads = cases(F_A, FRICTION, ROLLING)[name][2]
    hard = Pair(angle).threshold(loads)
    found = SoftPair(parameters(), angle).threshold(loads, broken)
    print(f"{name}, {angle:g} rad: hard {hard:.6f}, soft {found:.6f} of the derived threshold")
    assert found == pytest.approx(hard, rel=RAMP)


@pytest.mark.parametrize("name", LOADS)
def test_a_ductile_bond_yields_where_the_hard_one_does_and_holds(name):
    loads = cases(F_A, FRICTION, ROLLING)[name][2]
    hard = Pair(2.0).threshold(loads)
    pair = SoftPair(parameters(), 2.0, fragile=False)
    found = pair.threshold(loads, yields)
    print(f"ductile, {name}: hard {hard:.6f}, soft {found:.6f} of the derived threshold")
    assert found == pytest.approx(hard, rel=RAMP)
    pair.load(**loads(1.05))
    # 20 steps under 5 % too much move the disk by some 1e-4 ℓ, far less than the ellipse's 2e-2: it yields on, and
    # bears no more than the threshold
    begin = O.bodies[pair.free].state.pos
    for _ in range(20):
        O.step()
        (p,) = (i.phys for i in contacts())
        held = p.normalAdhesion + p.normalForce.dot(contacts()[0].geom.normal)
        assert not broken(contacts()[0]) and held >= -1e-9 * F_A
        held += 1e-9 * F_A  # rounding
        assert p.shearForce.norm() <= FRICTION * held and p.moment_bending.norm() <= ROLLING * LENGTH * held
    assert yields(contacts()[0]) and (O.bodies[pair.free].state.pos - begin).norm() > 1e-6


@pytest.mark.parametrize("name", ["tension", "shear", "shear under compression", "shear under tension"])
def test_a_bond_of_jcfpm_breaks_where_the_hard_one_does(name):
    loads = cases(F_A, FRICTION, ROLLING)[name][2]
    hard = Pair(2.0).threshold(loads)
    found = SoftPair(parameters("jcfpm"), 2.0).threshold(loads, broken)
    print(f"jcfpm, {name}: hard {hard:.6f}, soft {found:.6f} of the derived threshold")
    assert found == pytest.approx(hard, rel=RAMP)


def slides(contact):
    p = contact.phys
    return p.shearForce.norm() >= p.tangensOfFrictionAngle * p.normalForce.norm() * (1 - 1e-9) > 0


def rolls(contact):
    p = contact.phys
    return p.moment_bending.norm() >= p.maxRollPl * p.normalForce.norm() * (1 - 1e-9) > 0


@pytest.mark.parametrize("name, yields", [("shear under compression", slides), ("torque under compression", rolls)])
def test_a_contact_without_a_bond_yields_where_the_hard_one_does(name, yields):
    loads = cases(0.0, 0.2, 0.05)[name][2]
    pair = Pair(2.0, **{**RESIDUAL, "residualTensileStrength": 0.0})
    engine().unbond()
    hard = pair.threshold(loads)
    found = SoftPair(parameters(), 2.0, bond=False, gap=-1e-9).threshold(loads, yields)
    print(f"no bond, {name}: hard {hard:.6f}, soft {found:.6f} of the derived threshold")
    assert found == pytest.approx(hard, rel=RAMP)


def test_springs_with_friction_slide_where_the_residual_law_does():
    loads = cases(0.0, 0.2, 0.0)["shear under compression"][2]
    pair = SoftPair(parameters("friction"), 2.0, bond=False, gap=-1e-9)
    O.bodies[pair.free].state.blockedDOFs = "zXYZ"  # nothing resists rolling
    assert pair.threshold(loads, slides) == pytest.approx(1, rel=RAMP)


def test_a_bond_over_a_gap_is_born_without_force_and_breaks_at_the_same_load():
    loads = cases(F_A, FRICTION, ROLLING)["tension"][2]
    for model in ("cohesion_moment", "jcfpm"):
        pair = SoftPair(parameters(model), gap=0.015)
        run(100)
        # rounding of R₁ + R₂ − distance
        assert O.bodies[pair.free].state.pos[0] == pytest.approx(LENGTH + 0.015, abs=1e-12)
        assert pair.threshold(loads, broken) == pytest.approx(1, rel=RAMP)


def row_breaks(strength, count=8, steps=10000):
    """Whether a bond of a horizontal row held at one end breaks under a growing weight; F_a = `strength` weights of a
    disk.
    """
    weight = ROCK.density * math.pi * RADIUS**2 * 9.81
    e = parameters(rock=dataclasses.replace(ROCK, tensile_strength=strength * weight / LENGTH), damping=0.8)
    O.reset()
    O.materials.append(soft.material(e))
    for k in range(count + 1):
        O.bodies.append(scene.disk((k * LENGTH, 0), RADIUS, O.materials[0], fixed=k == 0))
    O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0)), 0.9 * e.step_limit
    assert soft.bond(e) == count
    newton = next(engine for engine in O.engines if isinstance(engine, NewtonIntegrator))
    for k in range(2 * steps):
        newton.gravity = (0, -9.81 * min(1, (k + 1) / steps), 0)
        O.step()
        if len(contacts()) < count or any(map(broken, contacts())):
            assert not O.interactions.has(0, 1, True) or broken(O.interactions[0, 1])  # the root bears most
            return True
    return False


def test_a_bonded_row_held_at_one_end_breaks_at_the_strength_that_statics_asks_for():
    asked = 8**2 / (2 * ROLLING)  # F_a/w = n²/(2 μ_r), the hard law's to 1e-5 (verification.bonds.cantilever)
    assert not row_breaks(1.03 * asked)  # 3 %: the row swings on by some 1.5 % when its weight stops growing
    assert row_breaks(0.97 * asked)


def lattice(stuff, seed=3):
    """Disks of several sizes with gaps and overlaps around the creation distance."""
    dice = random.Random(seed)
    for k in range(36):
        O.bodies.append(scene.disk((k % 6, k // 6), dice.uniform(0.46, 0.5), stuff))


def test_bonds_are_those_of_the_hard_law_with_its_thresholds_at_each_contact():
    rock = dataclasses.replace(ROCK, bond_creation_distance=0.03)
    hard_stuff = scene.material(rock)
    O.materials.append(hard_stuff)
    lattice(hard_stuff)
    begin(gravity=(0, 0, 0), reach=0.05)
    run(1)
    count = engine().bond()
    hard = {
        frozenset((i.id1, i.id2)): (i.phys.tensileForce, i.phys.friction, i.phys.rollingArm)
        for i in contacts()
        if i.phys.bonded
    }
    for model in ("cohesion_moment", "jcfpm"):
        O.reset()
        e = parameters(model, rock, diameter=(0.9, 1.0))
        O.materials.append(soft.material(e))
        lattice(O.materials[0])
        O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0)), 0.5 * e.step_limit
        assert 0 < soft.bond(e) == count < 60
        assert soft.bond(e) == 0
        assert {frozenset((i.id1, i.id2)) for i in contacts()} == set(hard)
        for i in contacts():
            tension, friction, arm = hard[frozenset((i.id1, i.id2))]
            p, same = i.phys, dict(rel=1e-12)  # products in another order
            if model == "jcfpm":
                assert (p.FnMax, p.FsMax, p.tanFrictionAngle) == pytest.approx(
                    (tension, friction * tension, friction), **same
                )
            else:
                assert (p.normalAdhesion, p.shearAdhesion, p.rollingAdhesion) == pytest.approx(
                    (tension, friction * tension, arm * tension), **same
                )
                assert (p.tangensOfFrictionAngle, p.maxRollPl) == pytest.approx((friction, arm), **same)
            r1, r2 = (O.bodies[k].shape.radius for k in (i.id1, i.id2))
            assert (p.kn, p.ks) == pytest.approx(e.stiffnesses(r1, r2)[:2], **same)


def test_bonds_join_the_disks_of_one_layer_only():
    e = parameters()
    O.materials.append(soft.material(e))
    ids = [O.bodies.append(scene.disk((k, 0), RADIUS, O.materials[0])) for k in range(4)]
    O.engines = soft.engines(e)
    assert (soft.bond(e, ids[:2]), soft.bond(e, ids[2:])) == (1, 1)
    assert sorted((i.id1, i.id2) for i in contacts()) == [(0, 1), (2, 3)]
    assert soft.bond(parameters(rock=dataclasses.replace(ROCK, bonded=False))) == 0


@pytest.mark.parametrize("model", ["cohesion_moment", "jcfpm"])
def test_a_broken_bond_gets_the_residual_strengths(model):
    pair = SoftPair(parameters(model))
    loads = cases(F_A, FRICTION, ROLLING)["shear under compression"][2]
    assert pair.threshold(loads, broken) < 1.2
    soft.weaken()
    p = contacts()[0].phys
    if model == "jcfpm":
        assert p.tanFrictionAngle == pytest.approx(0.2)
    else:
        assert (p.tangensOfFrictionAngle, p.maxRollPl) == pytest.approx((0.2, 0.05 * LENGTH))


@pytest.mark.parametrize("model", soft.MODELS)
def test_a_disk_rests_on_a_segment_by_its_spring_and_slides_along_it(model):
    e = parameters(model)
    O.materials.append(soft.material(e))
    wall = soft.wall_material(e, 0.1)
    O.materials.append(wall)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], wall, piece=1, sense=1))
    body = O.bodies[O.bodies.append(scene.disk((0.3, RADIUS), RADIUS, O.materials[0]))]
    O.engines, O.dt = soft.engines(e), 0.5 * e.step_limit
    run(1000)
    weight = body.state.mass * 9.81
    assert RADIUS - body.state.pos[1] == pytest.approx(weight / (E * RADIUS), rel=1e-3)  # at rest: k_n = E R at a wall
    body.state.blockedDOFs = "zXYZ"
    body.state.vel = (1, 0, 0)
    run(200)
    drag = O.forces.f(body.id)[0]
    assert drag == pytest.approx(-0.1 * weight, rel=0.01)  # the normal force still trembles a little
    assert all(type(i.phys).__name__ == "WallPhys" for i in contacts())


def test_damping_gives_the_restitution_that_is_stated():
    for damping in (0.0, 0.2, 0.7):
        e = parameters("friction", damping=damping)
        O.reset()
        O.materials.append(soft.material(e))
        O.bodies.append(scene.disk((0, 0), RADIUS, O.materials[0], fixed=True))
        body = O.bodies[O.bodies.append(scene.disk((LENGTH + 1e-4, 0), RADIUS, O.materials[0]))]
        body.state.vel = (-0.1, 0, 0)
        O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0)), 0.01 * e.step_limit
        run(3000)
        # the spring's half period is some 300 steps
        assert body.state.vel[0] == pytest.approx(0.1 * e.restitution, rel=0.01)


def test_damping_slows_a_fall_as_stated():
    e = parameters("friction", damping=0.2)
    O.materials.append(soft.material(e))
    body = O.bodies[O.bodies.append(scene.disk((0, 0), RADIUS, O.materials[0]))]
    O.engines, O.dt = soft.engines(e), 0.5 * e.step_limit
    run(100)
    assert body.state.vel[1] == pytest.approx(-0.8 * 9.81 * 100 * O.dt, rel=1e-12)


def growth(e, factor, places):
    """Largest speed of bonded disks after 2,000 steps of `factor` times the limit, by that at the beginning; no
    damping.
    """
    O.reset()
    O.materials.append(soft.material(e))
    for k, place in enumerate(places):
        body = O.bodies[O.bodies.append(scene.disk(place, RADIUS, O.materials[0]))]
        body.state.vel = (1e-6 * (-1) ** k, 0.3e-6 * (-1) ** (k // 2), 0)
    O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0)), factor * e.step_limit
    soft.bond(e)
    run(2000)
    return max(b.state.vel.norm() for b in O.bodies) / 1e-6


def test_the_step_limit_is_where_a_pair_becomes_unstable_and_safe_for_a_patch():
    strong = dataclasses.replace(ROCK, tensile_strength=1e30)
    pair = [(0, 0), (LENGTH, 0)]
    e = parameters(rock=strong, contacts=1, damping=0)
    assert growth(e, 0.99, pair) < 20  # below the limit steps of 2/ω amplify by 1/√(1 − 0.99²) = 7
    assert growth(e, 1.01, pair) > 1e6  # above it by exp(2 arcosh 1.01) = 1.3 a step
    patch = [(LENGTH * (a + 0.5 * b), LENGTH * b * math.sqrt(0.75)) for a in range(5) for b in range(5)]
    e = parameters(rock=strong, damping=0)
    assert growth(e, 0.99, patch) < 20
    assert growth(e, 3.0, patch) > 1e6  # and the bound is no worse than a factor of three


def test_the_way_back():
    pair = SoftPair(parameters())
    back = soft.material_of(contacts()[0], residual=ROCK, name="rock")
    assert dataclasses.asdict(back) == pytest.approx(dataclasses.asdict(ROCK), rel=1e-12)
    pair.load(normal=-2 * F_A)
    run(200)
    assert not contacts()
    rock = dataclasses.replace(
        ROCK, rolling_friction=0.125, residual_rolling_friction=0.125, residual_friction=FRICTION
    )
    for model, lost in (("cohesion_moment", {}), ("jcfpm", dict(rolling_friction=0.0, residual_rolling_friction=0.0))):
        back = soft.material_of(soft.material(parameters(model, rock)), LENGTH, name="rock")
        assert dataclasses.asdict(back) == pytest.approx(
            dataclasses.asdict(dataclasses.replace(rock, **lost)), rel=1e-12
        )
    assert soft.material_of(FrictMat(frictionAngle=math.atan(0.4)), 1.0).friction == pytest.approx(0.4)


COHESIVE = dict(
    normalCohesion=4e5, shearCohesion=1.2e5, frictionAngle=math.atan(0.3), momentRotationLaw=True, etaRoll=0.25
)


@pytest.mark.parametrize(
    "make, word",
    [
        (lambda: soft.material_of(CohFrictMat(**{**COHESIVE, "shearCohesion": 2e5}), 1.0), "shearCohesion"),
        (lambda: soft.material_of(CohFrictMat(**{**COHESIVE, "etaRoll": 0.5}), 1.0), "etaRoll"),
        (lambda: soft.material_of(CohFrictMat(**{**COHESIVE, "etaRoll": -1}), 1.0), "elastic"),
        (lambda: soft.material_of(CohFrictMat(**{**COHESIVE, "normalCohesion": -1}), 1.0), "normalCohesion -1"),
        (lambda: soft.material_of(JCFpmMat(tensileStrength=1e5, cohesion=1e5, frictionAngle=0.3), 1.0), "cohesion"),
        (lambda: soft.material_of(CohFrictMat(**COHESIVE)), "diameter None"),
        (lambda: soft.material_of(3.0, 1.0), "float"),
        (lambda: parameters("mindlin"), "mindlin"),
        (lambda: parameters(diameter=(2, 1)), "diameter"),
        (lambda: parameters(diameter=(1, math.inf)), r"diameter \(1, inf\)"),
        (lambda: soft.equivalent(ROCK, 0, diameter=1), "stiffness 0"),
        (lambda: parameters(shear_ratio=0), "shear_ratio"),
        (lambda: parameters(rolling_ratio=0), "rolling_ratio"),
        (lambda: parameters(damping=1), "damping"),
        (lambda: parameters(rock=dataclasses.replace(ROCK, density=None)), "density"),
        (
            lambda: parameters(rock=dataclasses.replace(ROCK, slip_weakening=section.SlipWeakening("step", 5.0))),
            "slip_weakening",
        ),
        (lambda: soft.bond(parameters("friction")), "no bonds"),
        (lambda: soft.bond(parameters()), "O.engines"),
    ],
)
def test_what_has_no_counterpart_is_refused_by_name(make, word):
    with pytest.raises(soft.SoftError, match=word):
        make()


def test_disks_of_another_material_are_refused():
    e = parameters()
    O.materials.append(soft.material(parameters("friction")))
    O.bodies.append(scene.disk((0, 0), RADIUS, O.materials[0]))
    O.engines = soft.engines(e)
    with pytest.raises(soft.SoftError, match="body 0: material FrictMat"):
        soft.bond(e)


@pytest.mark.parametrize(
    "model, words",
    [
        (
            "cohesion_moment",
            (
                "150000 N",
                "45000 N",
                "22500 N m",
                "elliptic zone",
                "residual tensile strength",
                "0.197396 rad (atan 0.2)",
            ),
        ),
        ("jcfpm", ("150000 N", "45000 N", "moments:", "0.291457 rad (atan 0.3)", "0.197396 rad (atan 0.2)")),
        ("friction", ("bonds:", "moments:", "cohesion_moment without bonds", "0.197396 rad (atan 0.2)")),
    ],
)
def test_the_description_has_thresholds_and_losses(model, words):
    text = str(soft.describe(parameters(model, diameter=(1, 2))))
    for word in words:
        assert word in text


@pytest.mark.parametrize("model", soft.MODELS)
def test_the_description_has_every_attribute_that_the_material_sets(model):
    e = parameters(model, diameter=(1, 2))
    made = soft.material(e)
    kind, usual = type(made).__name__, type(made)().dict()
    rows = soft.describe(e).rows
    told = {name: value for _, name, value, _ in rows}
    thresholds = {what.partition(" ")[0]: name for what, name, *_ in rows if what.split()[1:2] == ["threshold"]}
    assert thresholds == dict(
        zip(
            ("tension", "shear", "torque"),
            {
                "cohesion_moment": ("normalAdhesion", "shearAdhesion", "rollingAdhesion"),
                "jcfpm": ("FnMax", "FsMax", "-"),
                "friction": ("-", "-", "-"),
            }[model],
        )
    )
    # between two equal disks of the mean diameter, and from the same formulae as contacts have it
    stiffness = next(value for what, name, value, _ in rows if name == "kn")
    assert float(stiffness.split()[0]) == pytest.approx(e.stiffnesses(0.5 * e.length, 0.5 * e.length)[0], rel=1e-5)
    # JCFpm's own friction angle is that of its bonds, and nothing else is called so
    of_bonds = [name for what, name, _, law in rows if (what, law) == ("friction angle of a bond", "atan μ_s")]
    assert of_bonds == (["JCFpmMat.frictionAngle"] if model == "jcfpm" else [])
    changed = {name for name, value in made.dict().items() if value != usual[name] and name not in ("id", "label")}
    assert changed <= set(e.attributes()) and {f"{kind}.{name}" for name in e.attributes()} <= set(told)
    for name, value in e.attributes().items():
        assert getattr(made, name) == value
        shown = told[f"{kind}.{name}"]
        # six digits
        assert (
            shown == str(value)
            if isinstance(value, bool)
            else float(shown.split()[0]) == pytest.approx(value, rel=1e-5)
        )


#: Ways to move the free disk about the fixed one, by their progress x: (gap, angle of the centre, turn of the disk) [m,
#: rad, rad] at x = 1, a multiple of the way to the ellipse's edge, and the force and torque that the bond bears on it,
#: as parts of F_a, μ_s F_a and μ_r ℓ F_a. A disk that turns by twice the angle of its centre rolls, by the angle itself
#: slides and turns. Where tension yields, N = −F_a leaves nothing of the others.
WAYS = {
    "tension": ((0.04, 0.0, 0.0), (1, 0, 0)),
    "shear": ((0.0, 0.06, 0.0), (0, 1, 0)),
    "torque": ((0.0, 0.4, 0.8), (0, 0, 1)),
    "shear with torque": ((0.0, 0.12, 0.12), (0, 1, 1)),
    "tension with shear": ((0.03, 0.04, 0.0), (1, 0, 0)),
    "tension with torque": ((0.03, 0.1, 0.2), (1, 0, 0)),
}
ZONE = (0.02, 0.03)


def mark(gap, angle, turn):
    """Where the marked point lies from its first place, along the first normal and tangent: that of the free disk which
    touched the fixed one, in units of ε_n ℓ and ε_t ℓ. Independent of the engine's way to reckon it, which has bodies'
    positions and rotations.
    """
    x = (LENGTH + gap) * math.cos(angle) - RADIUS * math.cos(turn) - RADIUS
    y = (LENGTH + gap) * math.sin(angle) - RADIUS * math.sin(turn)
    return x / (ZONE[0] * LENGTH), y / (ZONE[1] * LENGTH)


@pytest.mark.parametrize("way", WAYS)
def test_a_ductile_bond_yields_and_breaks_where_the_hard_one_does(way):
    """Displacement is driven; the bond bears its thresholds until the marked point leaves the ellipse."""
    aim, (tension, shear, torque) = WAYS[way]
    rock = dataclasses.replace(ROCK, bond_ellipse=ZONE)
    e = soft.equivalent(rock, E, diameter=LENGTH, damping=0.5)
    stuff = soft.material(e)
    O.materials.append(stuff)
    O.bodies.append(scene.disk((0, 0), RADIUS, stuff, fixed=True))
    body = O.bodies[O.bodies.append(scene.disk((LENGTH, 0), RADIUS, stuff))]
    O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0), ductile=True), 0.5 * e.step_limit
    with pytest.raises(soft.SoftError, match="BondEllipseEngine"):
        engines, O.engines = O.engines, soft.engines(e, gravity=(0, 0, 0))
        try:
            soft.bond(e, fragile=False)
        finally:
            O.engines = engines
    assert soft.bond(e, fragile=False) == 1
    O.engines[-2].iterPeriod = 1
    body.state.blockedDOFs = "xyzXYZ"
    steps = 4000
    edge = _root(lambda x: math.hypot(*mark(*(x * a for a in aim))) - 1)
    assert 0.3 < edge < 0.9
    for k in range(steps):
        gap, angle, _ = (a * (k + 1) / steps for a in aim)
        target = (LENGTH + gap) * math.cos(angle), (LENGTH + gap) * math.sin(angle)
        body.state.vel = tuple((a - b) / O.dt for a, b in zip(target, body.state.pos)) + (0,)
        body.state.angVel = (0, 0, aim[2] / (steps * O.dt))
        p = contacts()[0].phys if contacts() else None
        if p is None or p.cohesionBroken:
            break
        borne = p.normalForce.norm(), p.shearForce.norm(), p.moment_bending.norm()
        O.step()
    # both sides: to the one step in which it leaves the ellipse
    assert (k - 1) / steps - 1e-9 <= edge <= k / steps + 1e-9
    # yield is exact in YADE's law; what is not loaded is rounding of the places, 1e-16 m times 5e8 N/m, or what is left
    # of T and Γ when tension yields
    wanted = tension * F_A, shear * FRICTION * F_A, torque * ROLLING * LENGTH * F_A
    assert borne == pytest.approx(wanted, rel=1e-6, abs=1e-4 * F_A)
    assert O.engines[-2].broken == 1 and O.engines[-2].count == 0


def _root(f, low=0.0, high=1.0):
    """Zero of a function that is negative at ``low`` and positive at ``high``, by bisection."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return high


def test_only_moments_have_ductile_bonds():
    e = parameters("jcfpm")
    O.materials.append(soft.material(e))
    O.bodies.append(scene.disk((0, 0), RADIUS, O.materials[0]))
    O.engines = soft.engines(e)
    with pytest.raises(soft.SoftError, match="cohesion_moment"):
        soft.bond(e, fragile=False)


def test_ductile_bonds_are_saved(tmp_path):
    e = parameters()
    stuff = soft.material(e)
    O.materials.append(stuff)
    O.bodies.append(scene.disk((0, 0), RADIUS, stuff, fixed=True))
    O.bodies.append(scene.disk((LENGTH, 0), RADIUS, stuff))
    O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0), ductile=True), 0.5 * e.step_limit
    soft.bond(e, fragile=False)
    O.save(str(tmp_path / "pair.yade.gz"))
    O.load(str(tmp_path / "pair.yade.gz"))
    assert O.engines[-2].count == 1
    O.bodies[1].state.pos = (LENGTH * 1.05, 0, 0)  # out of the ellipse at once
    run(O.engines[-2].iterPeriod + 2)
    assert O.engines[-2].broken == 1 and not contacts()
