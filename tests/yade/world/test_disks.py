"""Disks of what YADE's own makers of spheres give."""
import math

import numpy as np
import pytest
from yade import O, pack, utils, ymport
from yade.nonsmooth import scene
from yade.wrapper import FrictMat, NscdMat

from contact_scenes import begin, material, run

pytestmark = pytest.mark.usefixtures("empty")

DENSITY = 2600.0


@pytest.fixture
def stuff():
    made = NscdMat(density=DENSITY, frictionAngle=0.4)
    O.materials.append(made)
    return made


def check(bodies, places, stuff, blocked="zXY"):
    """These bodies are disks at (x, y) with radii r."""
    assert len(bodies) == len(places)
    for b, (x, y, r) in zip(bodies, places):
        assert tuple(b.state.pos) == pytest.approx((x, y, 0), abs=1e-15) and b.state.pos[2] == 0
        assert b.shape.radius == pytest.approx(r, rel=1e-15)
        assert b.state.mass == pytest.approx(DENSITY * math.pi * r**2, rel=1e-14)
        assert b.state.inertia[2] == pytest.approx(0.5 * b.state.mass * r**2, rel=1e-14)
        assert "".join(sorted(b.state.blockedDOFs)) == "".join(sorted(blocked))
        assert b.material is stuff or b.material.label == stuff.label and b.material.density == DENSITY


def cloud(z=0.0):
    made = pack.SpherePack()
    made.makeCloud((0, 0, z), (2, 1, z), rMean=0.05, rRelFuzz=0.3, num=60, seed=3)
    return made


@pytest.mark.parametrize("z", [0.0, 0.7])
def test_a_cloud(stuff, z):
    sp = cloud(z)
    rows = [(c[0], c[1], r) for c, r in sp]
    assert len({r for *_, r in rows}) > 50
    made = scene.disks(sp, stuff)
    check(made, rows, stuff)
    assert all(b.id < 0 or b.id is None for b in made)  # not in the scene
    O.bodies.append(made)
    begin(dt=1e-4)
    run(20)
    assert all(b.state.pos[2] == 0 for b in O.bodies)


def test_ids_of_a_cloud_that_is_in_the_scene(stuff):
    sp = cloud(0.3)
    ids = sp.toSimulation(material=FrictMat(density=10))
    made = scene.disks(ids, stuff)
    check(made, [(c[0], c[1], r) for c, r in sp], stuff)
    assert [b.id for b in made] == ids and len(O.bodies) == len(ids)
    check([O.bodies[i] for i in ids], [(c[0], c[1], r) for c, r in sp], stuff)


@pytest.mark.parametrize("maker, count", [(pack.regularOrtho, 50), (pack.regularHexa, 38)])
def test_regular_packings(stuff, maker, count):
    """In a box of one layer; a thicker one holds several, which are refused."""
    r = 0.1

    def filled(layers):
        box = pack.inAlignedBox((0, 0, -1.5 * layers * r), (2.01, 1.01, 1.5 * layers * r))
        return maker(box, radius=r, gap=0, material=stuff)

    bodies = filled(1)
    made = scene.disks(bodies)  # their own material
    check(made, [(b.state.pos[0], b.state.pos[1], r) for b in bodies], stuff)
    assert len(made) == count
    with pytest.raises(ValueError, match="do not lie in one plane"):
        scene.disks(filled(2))


def test_a_text_file(stuff, tmp_path):
    rows = [(0.0, 0.5, 0.2), (1.0, 0.25, 0.3), (2.5, -1.0, 0.4)]
    (tmp_path / "disks.txt").write_text("#x y z r\n" + "".join(f"{x} {y} 4.0 {r}\n" for x, y, r in rows))
    made = scene.disks(ymport.text(str(tmp_path / "disks.txt")), stuff, color=(1, 0, 0))
    check(made, rows, stuff)
    assert all(tuple(b.shape.color) == (1, 0, 0) for b in made)


@pytest.mark.parametrize("kind", [list, np.array, tuple])
@pytest.mark.parametrize("z", [None, 2.0])
def test_rows(stuff, kind, z):
    rows = [(0.0, 0.5, 0.2), (1.0, 0.25, 0.3)]
    given = [(x, y, r) if z is None else (x, y, z, r) for x, y, r in rows]
    check(scene.disks(kind(given), stuff, fixed=True), rows, stuff, "xyzXYZ")
    assert scene.disks(kind([]), stuff) == []


def test_a_label_is_a_material(stuff):
    stuff.label = "rock"
    assert scene.disks([(0, 0, 1)], "rock")[0].material.density == DENSITY


def test_what_is_blocked_stays_blocked(stuff):
    body = utils.sphere((0, 0, 0), 1, material=stuff, fixed=True)
    assert "x" in scene.disks([body])[0].state.blockedDOFs
    assert scene.disk((0, 0), 1, stuff).state.blockedDOFs == "zXY"


@pytest.mark.parametrize(
    "make, error, words",
    [
        (lambda m: scene.disks([(0, 0, 0, 1), (0, 0, 0.5, 1)], m), ValueError, "z is from 0 to 0.5 m"),
        (lambda m: scene.disks([(0, 0, -1.0)], m), ValueError, "sphere 0 has the radius -1 m"),
        (lambda m: scene.disks([(0, float("nan"), 1.0)], m), ValueError, "finite place"),
        (lambda m: scene.disks([(0, 0, 1.0)]), ValueError, "material = None"),
        (lambda m: scene.disks([(0, 0)], m), TypeError, "list holds no spheres"),
        (lambda m: scene.disks("spheres.txt", m), TypeError, "str holds no spheres"),
        (lambda m: scene.disks(scene.segments([(0, 0), (1, 0)], m), m), TypeError, "a body has a Segment"),
        (lambda m: scene.disks([utils.sphere((0, 0, 0), 1, material=m), 3], m), TypeError, "holds no spheres"),
    ],
)
def test_what_makes_no_disks_is_told(stuff, make, error, words):
    with pytest.raises(error, match=words):
        make(stuff)


def test_spheres_of_clumps_are_refused(stuff):
    O.bodies.appendClumped([utils.sphere((k, 0, 0), 1, material=stuff) for k in (0, 1)])
    with pytest.raises(ValueError, match="clumps"):
        scene.disks([0, 1], stuff)


@pytest.mark.parametrize(
    "centre, radius, words",
    [
        ((0, 0, 1.5), 0.5, "disks lie in the plane z = 0, and y is up"),
        ((0, 0), -0.5, "radius -0.5: give a positive radius"),
        ((0, 0), 0.0, "radius 0.0: give a positive radius"),
        ((0, 0), math.nan, "radius nan: give a positive radius"),
        ((0, 0), math.inf, "radius inf: give a positive radius"),
    ],
)
def test_what_is_no_disk_is_refused(stuff, centre, radius, words):
    with pytest.raises(ValueError, match=words):
        scene.disk(centre, radius, stuff)
    assert scene.disk((0, 1, 0), 0.5, stuff).state.pos[1] == 1
