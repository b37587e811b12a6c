"""A scene that is drawn in one line: what is there is on the axes, in its place, whoever's contacts it has."""
import math

import drawn
import meshio
import numpy as np
import pytest
import shell
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from yade import O, utils
from yade.nonsmooth import figures, paraview, records, scene, scene_arrays
from yade.nonsmooth.figures import scene as scenes, style
from yade.wrapper import (
    Bo1_Sphere_Aabb,
    CohFrictMat,
    ForceResetter,
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom6D,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    NscdMat,
)

from contact_scenes import begin, material

pytestmark = pytest.mark.usefixtures("empty")


def of(ax, kind):
    return [c for c in ax.collections if type(c) is kind]


def held():
    """Three bonded disks on a floor, with a loose one on top; a fixed one holds two by bonds."""
    stuff = material(0.5, layer=1, tensileStrength=1e5, bondCreationDistance=0.01)
    rough = NscdMat(frictionAngle=0.4, wall=True)
    O.materials.append((stuff, rough))
    O.bodies.append(scene.segments([(-4, 0), (4, 0), (4, 6)], rough))
    stack = O.bodies.append([scene.disk((-2, 0.5 + k), 0.5, stuff) for k in range(3)])
    hung = O.bodies.append([scene.disk((1, 4.0 - k), 0.5, stuff, fixed=k == 0) for k in range(3)])
    loose = O.bodies.append(scene.disk((-2, 3.52), 0.5, stuff))
    begin(dt=1e-3, reach=0.1, tolerance=1e-8)
    O.step()
    assert scene.contact_dynamics().bond() == 4
    O.run(400, wait=True)
    return [*stack, *hung, loose]


def test_disks_walls_bonds_and_forces_are_where_they_are():
    ids = held()
    found = scene_arrays.read(O)
    assert (
        found.fixed.tolist() == [False] * 3 + [True] + [False] * 3
        and len(set(found.material)) == 1
        and found.r.tolist() == [0.5] * 7
    )
    assert np.array(sorted(w.ravel().tolist() for w in found.walls)) == pytest.approx(
        np.array([(4.0, 0.0, -4.0, 0.0), (4.0, 6.0, 4.0, 0.0)]), abs=1e-12
    )
    weight = 2500 * math.pi / 4 * 9.81
    forces = {(int(i), int(j)): f for i, j, f in zip(found.ci, found.cj, found.cn)}
    # contacts of the stack bear one to four disks; of those that hang the upper bond bears two, the lower one, in
    # tension. The solver's tolerance
    wanted = {
        (0, -1): 4 * weight,
        (0, 1): 3 * weight,
        (1, 2): 2 * weight,
        (2, 6): weight,
        (3, 4): -2 * weight,
        (4, 5): -weight,
    }
    assert set(forces) == set(wanted) and [forces[k] for k in wanted] == pytest.approx(list(wanted.values()), rel=1e-3)
    assert {(int(i), int(j)) for i, j in zip(found.ci[found.bonded], found.cj[found.bonded])} == {
        (0, 1),
        (1, 2),
        (3, 4),
        (4, 5),
    }

    ax = figures.draw(O).axes[0]
    centres, radii, colours = drawn.disks(ax)
    assert np.allclose(centres, [tuple(O.bodies[i].state.pos)[:2] for i in ids]) and radii.tolist() == [0.5] * 7
    assert colours[3] == scenes.FIXED != colours[0] == scenes.MATERIALS[0]
    walls, bonds = of(ax, LineCollection)
    assert len(walls.get_segments()) == 2 and len(bonds.get_segments()) == 4
    pressed, pulled = of(ax, PolyCollection)
    assert (len(pressed.get_paths()), len(pulled.get_paths())) == (4, 2)
    assert drawn.hexes(pressed.get_facecolor()) == [style.COMPRESSION.lower()] and drawn.hexes(
        pulled.get_facecolor()
    ) == [style.TENSION.lower()]
    wide = [np.hypot(*(path.vertices[3] - path.vertices[0])) for path in pressed.get_paths()]
    assert sorted(np.array(wide) / min(wide)) == pytest.approx([1, 2, 3, 4], rel=1e-3)  # as wide as the force is large
    assert not of(figures.draw(O, forces=False).axes[0], PolyCollection)


def test_materials_are_told_apart_in_the_order_in_which_they_come():
    """Of two that were appended to the scene, and of two that were not and have their names alone."""
    appended, named = [material(0.5), material(0.5)], [material(0.5, label="upper"), material(0.5, label="lower")]
    O.materials.append(appended)
    order = [*named, *appended, *named[::-1]]
    O.bodies.append([scene.disk((2.0 * k, 0.0), 0.5, one) for k, one in enumerate(order)])
    assert scene_arrays.read(O).material.tolist() == [0, 1, 2, 3, 1, 0]


@pytest.mark.parametrize("colours", [True, False])
def test_a_scene_that_is_kept_in_a_file_is_the_same(colours, tmp_path):
    held()
    if colours:
        O.bodies[2].shape.color = (0.1, 0.2, 0.3)
        for b in list(O.bodies)[3:]:
            b.shape.color = (0.7, 0.2, 0.3)
    O.bodies.append(utils.wall((0, -1, 0), axis=1, material=O.materials[1]))
    one = scene_arrays.read(O)
    scene_arrays.save(one, tmp_path / "scene.npz")
    other = scene_arrays.load(tmp_path / "scene.npz")
    assert list(vars(one)) == list(vars(other)) and one.axes == other.axes and len(one.cn)
    for name, value in vars(one).items():
        if value is None:
            assert getattr(other, name) is None, name
        else:
            assert np.array_equal(np.array(value), np.array(getattr(other, name))), name
    (tmp_path / "scene.npz").write_bytes(b"no archive")
    with pytest.raises(records.RecordsError, match="is no scene that can be read"):
        scene_arrays.load(tmp_path / "scene.npz")


def test_soft_scenes_and_yades_own_walls_are_drawn():
    stuff = CohFrictMat(young=1e7, poisson=0.3, density=2500, frictionAngle=0.5, normalCohesion=1e6, shearCohesion=1e6)
    O.bodies.append([utils.sphere((0, 0.999 * k, 0), 0.5, material=stuff) for k in range(2)])
    O.bodies.append(
        utils.box((0, -1.0, 0), (2, 0.5, 1), orientation=utils.Quaternion((0, 0, 1), math.pi / 2), material=stuff)
    )
    O.bodies.append(utils.wall((3, 0, 0), axis=0, material=stuff))
    O.bodies.append(utils.wall((0, 0, -1), axis=2, material=stuff))  # not seen along z
    O.bodies.append(utils.facet([(-3, 0, -1), (-3, 2, -1), (-3, 1, 1)], material=stuff))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom6D()],
            [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
        ),
    ]
    O.dt = 1e-6
    O.step()
    found = scene_arrays.read(O)
    assert found.bonded.tolist() == [True] and found.cn[0] > 0  # overlapping springs push
    assert found.axes == [(0, 3.0)]
    ends = np.concatenate(found.walls)
    assert len(found.walls) == 4 + 3 and ends[:, 0].min() == -3
    boxed = np.concatenate(found.walls[:4])  # a quarter turn makes it 1 m wide and 4 m high
    assert (
        np.ptp(boxed[:, 0]) == pytest.approx(1.0)
        and np.ptp(boxed[:, 1]) == pytest.approx(4.0)
        and boxed[:, 1].mean() == pytest.approx(-1.0)
    )
    assert len(figures.draw(O).axes) == 1


def test_walls_of_a_scene_are_written_for_paraview(tmp_path):
    """Those of VTKRecorder's users, who get disks and contacts from it, and no Segment."""
    held()
    O.bodies.append(utils.wall((0, -1, 0), axis=1, material=O.materials[1]))
    found = meshio.read(paraview.write_scene_walls(O, tmp_path / "walls.vtu"))
    assert [block.type for block in found.cells] == ["line"]
    lines = found.points[found.cells[0].data][:, :, :2]
    assert lines[:2] == pytest.approx(np.array(scene_arrays.read(O).walls))
    # a wall along an axis has no ends: it is drawn across all disks and walls, and a tenth beyond
    assert (
        lines[2, :, 1].tolist() == [-1, -1]
        and sorted(lines[2, :, 0]) == pytest.approx([-4 - 0.1 * 8, 4 + 0.1 * 8])
        and len(lines) == 3
    )
    O.bodies.append(utils.wall((5, 0, 0), axis=0, material=O.materials[1]))
    found = meshio.read(paraview.write_scene_walls(O, tmp_path / "walls.vtu"))
    lines = found.points[found.cells[0].data][:, :, :2]
    (upright,) = [line for line in lines if (line[:, 0] == 5).all()]
    # those of the level wall's ends are across, and not up: from the lowest to the highest of disks and segments
    known = np.concatenate(
        [
            *scene_arrays.read(O).walls,
            *(
                [[b.state.pos[0], b.state.pos[1] + s * b.shape.radius]]
                for b in O.bodies
                if hasattr(b.shape, "radius")
                for s in (1, -1)
            ),
        ]
    )
    low, high = known[:, 1].min(), known[:, 1].max()
    assert sorted(upright[:, 1]) == pytest.approx([low - 0.1 * (high - low), high + 0.1 * (high - low)])


def test_an_empty_scene_is_refused_and_axes_of_ones_own_are_taken(tmp_path):
    with pytest.raises(records.RecordsError, match="no disk in the scene"):
        figures.draw(O)
    O.bodies.append(scene.disk((0, 0), 1.0, FrictMat()))
    assert (
        figures.draw(O, tmp_path / "scene.png") == tmp_path / "scene.png"
        and (tmp_path / "scene.png").stat().st_size > 1000
    )
    mine = style.figure(4, 2)
    left, right = mine.subplots(1, 2)
    assert figures.draw(O, ax=right) is mine and of(right, EllipseCollection) and not left.collections
    assert right.get_xlim()[0] < -1 and right.get_xlim()[1] > 1


def test_the_script_of_the_documentation_draws_the_law_and_a_lesson(tmp_path):
    script = shell.ROOT / "doc" / "examples" / "pictures.py"
    done = shell.run("yade-nonsmooth", script, tmp_path, "law", "beam", "--threads", 1)
    assert done.returncode == 0, done.stderr
    made = {path.name: path.stat().st_size for path in tmp_path.iterdir()}
    assert set(made) == {
        "contact_law.png",
        "bond_zone.png",
        "water_forces.png",
        "lesson_beam-1.png",
        "lesson_beam-2.png",
    }
    assert min(made.values()) > 10_000
