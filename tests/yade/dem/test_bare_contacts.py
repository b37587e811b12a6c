"""Contacts that nobody has asked for have no interaction; whoever looks later sees what there would have been."""
import math

import numpy as np
import pytest
from contact_scenes import begin, engine, free_disk, material, spoilt
from test_view import busy, everything
from yade import O, utils
from yade.nonsmooth import scene
from yade.wrapper import Collider, NscdMat, SlipWeakeningMat, Sphere

pytestmark = pytest.mark.usefixtures("empty")
SIDE = 20


def lattice(stuff=lambda k: None, stirred=0.0):
    """Disks of 1 m side by side, all touching from above to below; stirred they shear past each other, so that contacts
    come and go. There are no walls.
    """
    shared = material(0.3, 0.05, tensileStrength=2e3, layer=1)
    ids = [free_disk(1.0 * (k % SIDE), 0.999 * (k // SIDE), stuff=stuff(k) or shared) for k in range(SIDE * SIDE)]
    for k, i in enumerate(ids):
        O.bodies[i].state.vel = (
            stirred * (-1) ** (k // SIDE) + 0.2 * stirred * math.sin(k),
            0.2 * stirred * math.cos(3 * k),
            0,
        )
    begin(gravity=(0, 0, 0), dt=2e-3, tolerance=1e-4, maxIterations=300)
    return ids


def way(seen, build, steps, change=None):
    """What there is after steps of a scene, a change of it, and as many; ``seen``: all is looked at after each few."""
    O.reset()
    made = build()
    for half in range(2):
        for _ in range(steps // 10):
            engine().advance(10, view=seen)
        if change and half == 0:
            change(made)
    engine().view()
    return everything()


def same(build, steps=60, change=None):
    """Whether nobody looks or somebody does in between, all that can be read is the same in the end; returns it."""
    unseen, seen = way(False, build, steps, change), way(True, build, steps, change)
    for k, what in enumerate(("bodies", "interactions", "forces", "engine", "step", "time")):
        assert unseen[k] == seen[k], what
    return unseen


def test_what_nobody_asks_for_is_not_made():
    lattice(stirred=2.0)
    for _ in range(4):
        engine().advance(50, view=False)
        assert engine().candidates > 300 and len(O.interactions) == 0
    engine().view()
    assert len(O.interactions) >= O.interactions.countReal() > 300
    pairs = [(i.id1, i.id2) for i in O.interactions if i.isReal]
    assert pairs == sorted(pairs)  # whenever they were made
    assert {(i.id1, i.id2) for i in O.interactions if i.isReal} >= {
        (int(a), int(b)) for a, b in np.frombuffer(engine().contactTable()).reshape(-1, 12)[:, :2]
    }


def test_a_collider_that_looks_anew_finds_no_pair_twice():
    lattice()
    engine().advance(20, view=False)
    counts = [engine().candidates]
    next(one for one in O.engines if isinstance(one, Collider)).verletDist *= 1.01  # it forgets what it knows
    for _ in range(3):
        engine().advance(1, view=False)
        counts.append(engine().candidates)
    assert counts == [2 * SIDE * (SIDE - 1)] * 4 and len(O.interactions) == 0


def test_contacts_that_come_and_go_are_the_same_once_they_are_seen():
    links = same(lambda: lattice(stirred=2.0), 300)[1]
    born = {link[3] for link in links if link[2]}
    assert len(born) > 20 and max(born) > 200  # of many steps; and the order is that of YADE's list


def test_a_table_of_contacts_needs_no_interactions():
    tables = []
    for seen in (False, True):
        O.reset()
        lattice(stirred=2.0)
        engine().advance(80, view=seen)
        rows = np.frombuffer(engine().contactTable()).reshape(-1, 12)
        tables.append(rows[np.lexsort((rows[:, 1], rows[:, 0]))])
        assert (len(O.interactions) == 0) is not seen
    assert len(tables[0]) > 300 and tables[0].tobytes() == tables[1].tobytes()


def without_signs_of_zeros(value):
    return repr(value).replace("-0,", "0,").replace("-0)", "0)")


def test_bonds_of_contacts_that_nobody_has_seen():
    """They are made, yield, grow and break as those of interactions do, and the arrays can take them from there. A zero
    that has been turned has no sign.
    """

    def bonded_unseen():
        stuff = material(0.5, 0.05, tensileStrength=5e2, bondCreationDistance=0.01, restitution=0.1)
        ids = lattice(lambda k: stuff, stirred=2.0)
        engine().advance(1, view=view)
        assert (len(O.interactions) == 0) is not view
        bonded.append(engine().bond())
        assert (len(O.interactions) == 0) is not view
        return ids

    def written_to(_):
        engine().view()
        for i in O.interactions:
            i.phys.restitution = 0.1  # as it is: what is written to is read anew

    ends, bonded = [], []
    for view in (False, True):
        ends.append([without_signs_of_zeros(part) for part in way(view, bonded_unseen, 120, written_to)])
        broken = engine().brokenTension + engine().brokenShear + engine().brokenTorque + engine().brokenMixed
        assert broken > 50 and engine().bonds > 50
    assert bonded[0] == bonded[1] > 600
    assert ends[0] == ends[1]


def test_a_scene_with_all_there_is_is_the_same_when_nobody_looks():
    """Walls that weaken, water, bonds, a driven disk."""
    links = same(lambda: busy(), 240)[1]
    assert sum(link[2] for link in links) > 30


@pytest.mark.parametrize(
    "name, value", [("frictionAngle", 0.1), ("restitution", 0.5), ("residualTensileStrength", 4e3)]
)
def test_contacts_keep_the_strengths_with_which_they_came(name, value):
    """A material that is changed rules the contacts that come from then on."""

    def change(_):
        setattr(O.materials[0], name, value)

    same(lambda: lattice(stirred=2.0), 200, change)
    phys = {"frictionAngle": "friction", "residualTensileStrength": "residualTensileForce"}.get(name, name)
    assert len({round(getattr(i.phys, phys), 6) for i in O.interactions if i.isReal}) >= 2


def test_so_do_those_whose_strengths_are_set_anew_and_those_that_are_unbonded():
    def change(_):
        O.materials[0].frictionAngle = 0.1
        engine().updateStrengths()
        engine().bond()

    same(lambda: lattice(stirred=2.0), 100, change)
    same(lambda: lattice(stirred=2.0), 100, lambda _: (engine().bond(), engine().unbond()))


@pytest.mark.parametrize(
    "change",
    [
        lambda ids: O.interactions.clear(),
        lambda ids: O.bodies.erase(ids[47]),
        lambda ids: (O.bodies.erase(ids[47]), O.bodies.insertAtId(other_disk(), ids[47])),
        lambda ids: setattr(O.bodies[ids[47]], "material", slippery()),
    ],
    ids=["cleared", "erased", "replaced", "material"],
)
def test_what_a_script_ends_without_having_looked_is_ended(change):
    same(lambda: lattice(stirred=2.0), 100, change)


def other_disk():
    return scene.disk((7.0, 1.95), 0.47, O.materials[0])


def slippery():
    return material(0.05)


@pytest.mark.parametrize("what", ["leaves the plane", "another shape"])
def test_bodies_that_the_arrays_cannot_keep_get_interactions(what):
    """Disks that may leave the plane, as far as their states tell, and spheres of another class."""

    def change(ids):
        for i in ids[40:60]:
            if what == "leaves the plane":
                O.bodies[i].state.angVel = (0.5, 0, 0)  # where bonds are marked on it follows that turn
            else:
                O.bodies[i].shape = Sphere(radius=0.5)

    def end(seen):
        O.reset()
        stuff = material(0.5, 0.05, tensileStrength=1e5, bondCreationDistance=0.01)
        ids = lattice(lambda k: stuff, stirred=0.1)
        engine().advance(1, view=seen)
        engine().bond()
        engine().advance(50, view=seen or ids[40:60])
        change(ids)
        engine().advance(50, view=seen)
        if not seen:
            assert 0 < len(O.interactions) < 300 or what == "another shape"
        engine().view()
        return everything()

    unseen, seen = ([without_signs_of_zeros(part) for part in end(way)] for way in (False, True))
    assert unseen == seen and engine().bonds > 300


def test_materials_of_more_kinds_than_the_arrays_keep_have_interactions():
    def kinds(k):
        return material(0.3, tensileStrength=1e3 + k, layer=1)

    same(lambda: lattice(kinds, stirred=2.0), 60)
    O.reset()
    lattice(kinds)
    engine().advance(5, view=False)
    assert engine().candidates > len(O.interactions) > 100


def test_an_interface_that_weakens_has_interactions():
    """Where two layers touch, strength follows slip, which the interactions keep."""

    def two(k):
        if k == 0:
            weak = SlipWeakeningMat(criticalSlip=0.01, frictionAngle=0.5, density=2500)
            upper = material(0.3, layer=2)
            upper.interfaceLayers, upper.interfaceLaws = [1], [weak]
            kinds[:] = [material(0.3, layer=1), upper]
        return kinds[k >= SIDE * SIDE // 2]

    kinds = []
    links = same(lambda: lattice(two, stirred=2.0), 60)[1]
    O.reset()
    lattice(two)
    engine().advance(5, view=False)
    assert all(type(i.phys).__name__ == "SlipWeakeningPhys" for i in O.interactions if i.isReal)
    assert SIDE <= O.interactions.countReal() < 2 * SIDE < len(links)


def test_what_is_saved_unseen_goes_on_with_the_same_bits(tmp_path):
    whole = same(lambda: lattice(stirred=2.0), 100)
    O.reset()
    lattice(stirred=2.0)
    engine().advance(100, view=False)
    O.save(str(tmp_path / "now.yade.gz"))
    for again in (False, True):
        if again:
            O.load(str(tmp_path / "now.yade.gz"))
        engine().advance(100, view=False)
        engine().view()
        assert everything()[0] == whole[0] and everything()[2] == whole[2]


def test_a_material_without_sense_is_refused_in_the_words_of_the_law():
    lattice(lambda k: spoilt(NscdMat(density=2500), frictionAngle=-0.1) if k == 7 else None)
    with pytest.raises(RuntimeError, match="frictionAngle = -0.1"):
        engine().advance(3, view=False)


def test_an_interaction_that_a_script_makes_of_a_pair_it_has_not_seen_takes_the_place_of_its_contact():
    ids = lattice()
    engine().advance(5, view=False)
    made = utils.createInteraction(ids[0], ids[1])
    engine().view()
    assert O.interactions[ids[0], ids[1]] == made and made.iterBorn == 5
    whole = 2 * SIDE * (SIDE - 1)
    assert O.interactions.countReal() == whole and O.interactions[ids[1], ids[2]].iterBorn == 0
    engine().advance(5)
    assert engine().candidates == whole and all(i.phys.length == 1 for i in O.interactions)


def test_looks_that_follow_each_other_mind_what_a_script_has_exchanged():
    """As many interactions as before, and others."""
    ids = lattice()
    engine().advance(5)
    engine().unbond()  # a look after which nothing is known
    for k in range(10):
        O.interactions.erase(ids[2 * k], ids[2 * k + 1])
    O.interactions.eraseNonReal()
    for k in range(10):
        utils.createInteraction(ids[2 * k], ids[2 * k + 1])
    engine().view()
    engine().advance(5)
    assert engine().candidates == 2 * SIDE * (SIDE - 1)
