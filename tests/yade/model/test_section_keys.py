"""Every key of a section file is followed to where it acts: a changed value is found there. The list of keys is the
schema's, so that a new one without a test fails.
"""
import atexit
import copy
import hashlib
import math
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path
from pathlib import Path

import meshio
import numpy as np
import pytest
import yaml
from slope_scenes import SMALL
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import experiment, packing, records, section
from yade.nonsmooth.measure import toe
from yade.nonsmooth.model import rocks
from yade.nonsmooth.studies.slope import results, slope
from yade.nonsmooth.studies.slope.water_release import WaterRelease
from yade.nonsmooth.water import field_files, of_section
from yade.nonsmooth.water.fields import MeshField
from yade.nonsmooth.water.mesh import grid
from yade.wrapper import GroundMotionEngine, NewtonIntegrator, NonsmoothTimeStepper, PlanarGridCollider

SCHEMA = yaml.safe_load((section.FOLDER / "section.schema.yaml").read_text())

# A block of seven bonded disks on the plane, which the water pushes down it, as hard as makes 3 m/s², for half a metre;
# friction then brings it to rest within two seconds.
CHANGED = {
    # a push that no water has, and strengths that do nothing
    ("unusual",): [
        "water.pressure_gradient",
        "materials.rock.residual_tensile_strength",
        "materials.dp.residual_tensile_strength",
        "materials.dp.slip_weakening.tensile_strength",
    ],
    ("water", "pressure_gradient"): [-9500.0, 4430.0],
    ("water", "table"): {"rate": 1000.0},
    ("water", "release_distance"): 0.5,
    ("water", "volume"): "disk",
    ("materials", "dp", "friction"): 0.6,
    ("materials", "dp", "tensile_strength"): 0.0,
    ("materials", "dp", "slip_weakening"): {
        "law": "step",
        "critical_slip": 50.0,
        "friction": 0.05,
        "tensile_strength": 0.0,
    },
    ("stages", "settle"): {"ramp": 0.1, "time_max": 0.5, "speed_rest": 1e-2, "bond": "before"},
    ("stages", "dry"): 0.1,
    ("disks", "diameter"): [1.0, 2.0],
}


def keys(schema=SCHEMA, way=()):
    """Ways to all keys of the schema that hold a value; ``*`` stands for any name and any number of a list."""
    if "$ref" in schema or schema.get("type") in ("string", "number", "integer", "boolean"):
        yield way
        return
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    inside = schema.get("items", {})
    if "array" in kinds and inside.get("type") == "object":
        yield from keys(inside, (*way, "*"))
        return
    if kinds != ["object"]:
        yield way
    for name, part in schema.get("properties", {}).items():
        yield from keys(part, (*way, name))
    if isinstance(schema.get("additionalProperties"), dict):
        yield from keys(schema["additionalProperties"], (*way, "*"))


def data(changes=()):
    """The small slope's data with the block's values and then these: {way: value}."""
    made = yaml.safe_load(SMALL.read_text())
    for way, value in {**CHANGED, **dict(changes)}.items():
        place = made
        for key in way[:-1]:
            place = place.setdefault(key, {}) if isinstance(place, dict) else place[key]
        if isinstance(value, dict):
            value = {key: inside for key, inside in value.items() if inside is not None}
        if value is None:
            place.pop(way[-1])
        else:
            place[way[-1]] = copy.deepcopy(value)
    return made


def read(folder, changes=()):
    path = folder / "slope.yaml"
    path.write_text(yaml.safe_dump(data(changes), sort_keys=False))
    return section.load(str(path))


def block():
    """Four disks on the plane, 10 m up from the foot, and three of the upper layer between them."""
    down, normal = (math.cos(math.radians(25)), -math.sin(math.radians(25))), (
        math.sin(math.radians(25)),
        math.cos(math.radians(25)),
    )
    places = [(10 + k, 0.5, 0) for k in range(4)] + [(10.5 + k, 0.5 + 0.5 * math.sqrt(3), 1) for k in range(3)]
    x, y = np.transpose([(-s * down[0] + h * normal[0], -s * down[1] + h * normal[1]) for s, h, _ in places])
    return packing.Packing(x, y, np.full(7, 0.5), np.array([layer for *_, layer in places]))


@dataclass
class Made:
    """A section, built or run, and what a test asks of it."""

    section: section.Section
    built: slope.Slope
    run: experiment.Experiment
    rows: list  # (time, stage, gravity, tolerance, height of the water, bonds) after each row

    def wall(self, name):
        return self.built.wall_material(name)

    def disk(self, number):
        return O.bodies[self.built.first_disk + number]

    def of(self, kind):
        return next((e for e in O.engines if isinstance(e, kind)), None)


@pytest.fixture
def make(tmp_path):
    """Builds the block's slope with changed values; with ``end`` [s] also runs it so far, with None to its end."""

    def made(changes=(), end=0.0):
        O.reset()
        chosen = read(tmp_path, changes)
        built, rows = slope.build(chosen, block()), []
        run = None
        if end != 0.0:
            run = experiment.Experiment(
                built,
                tmp_path,
                progress=lambda stage, now, _: rows.append(
                    (
                        now,
                        stage,
                        next(e for e in O.engines if isinstance(e, NewtonIntegrator)).gravity[1],
                        built.solver.tolerance,
                        built.water.height,
                        built.solver.bonds,
                    )
                ),
            )
            run.run(end)
        return Made(chosen, built, run, rows)

    yield made
    O.reset()


# ---- where values act -----------------------------------------------------------------------------


def radii(m):
    return packing.pack(m.section, 1).r


def settled(m):
    return m.run.state.settled


def seconds(value):
    return pytest.approx(value, abs=0.0201)  # looked at once a row


def passive(m):
    """What the report's figures of the toe are made from."""
    asked, before = [], toe.passive
    results.toe.passive = lambda *what: (asked.append(what[1:3]), before(*what))[1]
    try:
        results._passive(m.section, 0.82, 1.0, 1e5)
    finally:
        results.toe.passive = before
    return asked[0]


def walls_of(m):
    """Both ends of each wall's pieces."""
    found = {}
    for name, ids in m.built.walls.items():
        first, last = O.bodies[ids[0]], O.bodies[ids[-1]]
        ends = [
            b.state.pos + sign * b.shape.halfLength * (b.state.ori * Vector3(1, 0, 0))
            for b, sign in ((first, -1), (last, 1))
        ]
        found[name] = [tuple(round(float(c), 6) for c in tuple(e)[:2]) for e in ends]
    return found


def angle(mu):
    return pytest.approx(math.atan(mu), rel=1e-12)


DP, ROCK = ("materials", "dp"), ("materials", "rock")
ZONE = {
    "thickness": 0.01,
    "heat_capacity": 2.85e6,
    "thermal_diffusivity": 1.45e-7,
    "hydraulic_diffusivity": 7e-8,
    "pressurization_coefficient": 6.7e4,
    "weakening_temperature": 900.0,
    "weakened_friction": 0.1,
    "asperity_slip": 1e-5,
    "contact_strength": 3e9,
}


def heated(friction=0.4, **law):
    """The wall DP has a slip law."""
    law = {
        "bonded": False,
        "friction": 0.6 if law.get("set") == "marble" else friction,
        "rolling_friction": 0.1,
        "slip_law": law,
    }
    return {DP: law, ("water", "release_distance"): 1e5}


LIKE_ROCK = {"tensile_strength": 12e3, "friction": 0.4, "rolling_friction": 0.1, "density": 2000.0}
JOINT = {"friction": 0.15, "rolling_friction": 0.0, "bonded": False}
BETWEEN = {("materials", "joint"): JOINT, ("interfaces",): [{"between": ["L1", "L2"], "material": "joint"}]}
OWN = {"diameter": [0.3, 0.4], "distribution": "uniform_by_number", "packing_fraction": 0.7}
FAR = [{"name": "far", "material": "ss", "vertices": [[70.0, 30.0], [72.0, 30.0]], "apart": True}]
SEAT = [{"name": "seat", "material": "ss", "vertices": [[70.0, 40.0], [80.0, 38.0]], "apart": True}]
BASE = data()
DATA = Path(__file__).resolve().parents[2] / "data"
RECORD, UNEVEN = str(DATA / "four_values.at2"), str(DATA / "uneven.csv")  # 0, 2, -1, 0 at 0.1 s, without a unit
SHA256 = "db172bc1f0296fdba58cd446629229348cd070a1d7046ea0b52a649ad5dcf31c"  # of these, in m/s²
SHAKEN = {"file": RECORD, "unit": "m/s2"}
MADE_UP = {"peak": 2.0, "duration": 2.0, "frequency": 2.0}

LINES = [{"time": 0.0, "points": [[-40.0, 15.0], [5.0, 0.5]]}, {"time": 2.0, "points": [[-40.0, 15.0], [5.0, 1.5]]}]


def field_file(folder, factor=1.0):
    """A file of pressures over the small slope, whose name is always the same; its path."""
    mesh = grid(np.linspace(-50, 20, 8), np.linspace(-20, 35, 8))
    path = folder / "field.h5"
    field_files.write(MeshField(mesh, [1.0], [factor * 9810 * (9 - mesh.nodes[:, 0] - mesh.nodes[:, 1])]), path)
    return str(path)


FOLDER = Path(tempfile.mkdtemp(prefix="section-keys-"))
atexit.register(shutil.rmtree, FOLDER, True)
FIELD = field_file(FOLDER)
STATE = str(Path(FIELD).with_name("state.vtk"))
_MESH = grid(np.linspace(-50, 20, 8), np.linspace(-20, 35, 8))
meshio.Mesh(
    np.column_stack((_MESH.nodes, 0 * _MESH.nodes[:, 0])),
    [("triangle", _MESH.triangles)],
    {"p": 9810 * (9 - _MESH.nodes.sum(axis=1))},
).write(STATE)
AT = 9810 * (9 + 10 - 3)  # Pa, of these at the place of pressure()


def water(**keys):
    """Changes: this water instead of the table."""
    return {("water",): keys, ("stages", "water"): None}


def seeping(*states, **keys):
    """Changes: this seepage instead of the table."""
    return water(seepage={"size": 1.5, "conductivity": 1e-5, "states": list(states), **keys})


def border(kind, value, **place):
    return seeping({"time": 0.0, "boundaries": [{**(place or {"wall": "DP"}), kind: value}]})


def head(m, place=(-15.0, 9.2)):
    """Of the field that a run begins with, p/γ_w [m]."""
    return head_of(m.section, place)


def head_with(*states):
    """The same of the slope with this seepage."""
    return head_of(section_of(data(seeping(*states))))


def field_of(*states):
    return of_section.field(section_of(data(seeping(*states))))


def head_of(chosen, place=(-15.0, 9.2)):
    field = of_section.field(chosen)
    return float(np.ravel(field.mesh.at(field.at(0.0), np.array([place]), field.mesh.locate([place])))[0]) / 9810


LAKE = {"time": 0.0, "reservoir": 10.0}
TOP = [[-1.029, 4.893], [-34.31, 20.4122]]


def pressure(m, place=(-10.0, 3.0), time=0.0):
    """What the engine's field has at a place and a time after t0 [Pa]."""
    return float(m.run.slope.water.field.at(Vector3(*place, 0), m.run.state.t0 + time)[0])


OF_TABLE = {(*ROCK,): {"cohesion": 2e3, "friction_angle": 34.0, "density": 2500.0}}


def window(**keys):
    """Changes that give the block's slope a window which takes disks out, with these values."""
    one = {"name": "cut", "vertices": [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]], "begin": 0.1}
    return {("erosion",): [one | keys]}


def took(time, *points):
    """Whether the window takes points at a time [s since t0]."""
    return lambda m: m.section.erosion[0].takes(*np.transpose(points), time).tolist()


#: key: changes, where they are found, and what is found there; a list where a key acts in several places or takes
#: several kinds of values. The last item, where there is one, is how far the slope is run [s], None: to its end.
WHERE = {
    # and in summary.json, see test_whole_slope
    ("name",): ({("name",): "another"}, lambda m: m.section.name, "another"),
    ("description",): ({("description",): "free text"}, lambda m: m.section.description, "free text"),
    ("gravity",): ({("gravity",): 3.7}, lambda m: tuple(m.of(NewtonIntegrator).gravity), (0, -3.7, 0)),
    ("seed",): (
        {("seed",): 77, ("disks", "packing_fraction"): 0.7},
        lambda m: packing.pack(m.section).x.tolist(),
        lambda m: packing.pack(m.section, 77).x.tolist(),
    ),
    ("unusual",): (
        {
            ("unusual",): ["materials.rock.friction"],
            (*ROCK, "friction"): 9.0,
            (*ROCK, "residual_friction"): 0.4,
            ("water", "pressure_gradient"): "hydrostatic",
        },
        lambda m: (m.section.unusual, m.disk(0).material.frictionAngle),
        (("materials.rock.friction",), angle(9.0)),
    ),
    ("walls", "*", "name"): ({("walls", 2, "name"): "floor"}, lambda m: list(m.built.walls), ["DP", "FB", "floor"]),
    ("walls", "*", "material"): ({("walls", 2, "material"): "fb"}, lambda m: m.wall("SS").frictionAngle, angle(0.6)),
    ("walls", "*", "vertices"): (
        {("walls", 2, "vertices"): [[0.845, 1.8125], [50.0, 3.0]]},
        lambda m: walls_of(m)["SS"],
        [(0.845, 1.8125), (50.0, 3.0)],
    ),
    ("walls", "*", "role"): (
        {("walls", 1, "role"): "obstacle"},
        lambda m: [wall.role for wall in m.section.walls],
        ["slip", "obstacle", "ground"],
    ),
    ("walls", "*", "apart"): (
        {("walls",): BASE["walls"] + FAR},
        lambda m: (m.section.wall("far").apart, walls_of(m)["far"]),
        (True, [(70.0, 30.0), (72.0, 30.0)]),
    ),
    ("layers", "*", "name"): ({("layers", 0, "name"): "lowest"}, lambda m: m.section.layers[0].name, "lowest"),
    ("layers", "*", "material"): (
        {("materials", "other"): LIKE_ROCK, ("layers", 1, "material"): "other"},
        lambda m: [m.disk(k).material.density for k in range(7)].count(2000.0),
        3,
    ),
    ("layers", "*", "role"): [
        (
            {("layers", 1, "role"): "bed"},
            lambda m: (m.run.monitor.mass.tolist(), m.run.layers.tolist().count(1)),
            lambda m: ((m.run.layers == 0).tolist(), 3),
            0.02,
        ),
        (
            {("layers", 1, "role"): "obstacle"},
            lambda m: sorted(set(records.read_walls(m.run.folder / "walls.csv")["wall"])),
            ["DP", "FB", "L2", "SS"],
            0.02,
        ),
    ],
    ("layers", "*", "disks", "diameter"): (
        {("layers", 1, "disks"): OWN},
        lambda m: (m.section.smallest, m.section.disks_of(m.section.layers[1]).d_max),
        (0.3, 0.4),
    ),
    ("layers", "*", "disks", "distribution"): (
        {("layers", 1, "disks"): OWN},
        lambda m: (m.section.disks_of(m.section.layers[1]).mean_square, m.section.mixed),
        (pytest.approx((0.09 + 0.12 + 0.16) / 3), True),
    ),
    ("layers", "*", "disks", "packing_fraction"): (
        {("layers", 1, "disks"): OWN},
        lambda m: m.section.disk_areas()[1] / m.section.layers[1].area,
        pytest.approx(0.69, abs=0.01),
    ),
    # test_erosion_windows and test_eroding follow them further
    ("erosion", "*", "name"): (window(name="river"), lambda m: m.section.erosion[0].name, "river"),
    ("erosion", "*", "vertices"): (window(vertices=[[0, 0], [3, 0], [3, 3]]), took(1, (2, 1), (1, 2)), [True, False]),
    ("erosion", "*", "begin"): (window(begin=0.6), lambda m: m.section.erosion[0].begin, 0.6),
    ("erosion", "*", "end"): (window(end=0.3), lambda m: m.section.erosion[0].end, 0.3),
    ("erosion", "*", "velocity"): (window(end=3, velocity=[2, -1]), took(1.1, (2.5, -0.5), (1, 1)), [True, False]),
    ("erosion", "*", "path"): (
        window(end=3, path=[[0, 0, 0], [1, 4, 0]]),
        took(0.5, (3.5, 1), (1.5, 1)),
        [True, False],
    ),
    ("erosion", "*", "opening", "time"): (window(opening={"time": 0.4}), took(0.3, (1, 2.5), (1, 0.5)), [True, False]),
    ("erosion", "*", "opening", "direction"): (
        window(opening={"time": 0.4, "direction": [1, 0]}),
        took(0.3, (0.5, 1), (2.5, 1)),
        [True, False],
    ),
    ("erosion", "*", "layers"): (
        window(layers=["L2"]),
        lambda m: m.section.erosion[0].of_layers(m.section).tolist(),
        [False, True],
    ),
    ("erosion", "*", "hold"): (window(hold="never"), lambda m: m.section.erosion[0].hold, "never"),
    ("interfaces", "*", "name"): (
        {**BETWEEN, ("interfaces",): [{**BETWEEN[("interfaces",)][0], "name": "joint 7"}]},
        lambda m: m.section.interfaces[0].name,
        "joint 7",
    ),
    ("interfaces", "*", "between"): (
        BETWEEN,
        lambda m: (list(m.disk(0).material.interfaceLayers), m.section.interfaces[0].name),
        ([1], "L1-L2"),
    ),
    ("interfaces", "*", "material"): (
        BETWEEN,
        lambda m: m.disk(0).material.interfaceLaws[0].frictionAngle,
        angle(0.15),
    ),
    ("interfaces", "*", "role"): (
        {**BETWEEN, ("interfaces",): [{**BETWEEN[("interfaces",)][0], "role": "slip"}]},
        lambda m: [name for name, _ in m.section.slip_surfaces],
        ["DP", "L1-L2"],
    ),
    ("interfaces", "*", "flat"): (
        {**BETWEEN, ("interfaces",): [{**BETWEEN[("interfaces",)][0], "flat": False}]},
        lambda m: len(packing._borders(m.section, np.zeros(2))),
        1,
    ),
    # half of it, less the strip at the surface
    ("layers", "*", "vertices"): (
        {("layers", 1, "vertices"): [[0.845, 1.8125], [-0.092, 3.35275], [-34.7325, 19.50585], [-35.155, 18.5995]]},
        lambda m: m.section.disk_counts()[1] / m.section.disk_counts()[0],
        pytest.approx(0.44, abs=0.03),
    ),
    ("materials", "*", "bonded"): [
        ({(*ROCK, "bonded"): False}, lambda m: m.built.solver.bonds, 0, 0.02),
        ({}, lambda m: m.run.state.bonds_initial, 5, 0.02),  # three pairs below, two above; nothing across the layers
        (
            {(*DP, "bonded"): True, (*DP, "tensile_strength"): 1e3},
            lambda m: (m.wall("DP").bondsToAll, m.run.state.bonds_initial),
            (True, 9),
            0.02,
        ),
    ],
    # of the table of calibrated rocks
    ("materials", "*", "cohesion"): (
        {**OF_TABLE, (*ROCK, "cohesion"): 4e3},
        lambda m: m.disk(0).material.tensileStrength,
        rocks.contacts(4e3, 34.0).tensile_strength,
    ),
    ("materials", "*", "friction_angle"): (
        {**OF_TABLE, (*ROCK, "friction_angle"): 30.0},
        lambda m: m.disk(0).material.frictionAngle,
        angle(rocks.contacts(2e3, 30.0).friction),
    ),
    ("materials", "*", "tensile_strength"): [
        ({(*ROCK, "tensile_strength"): 7e3}, lambda m: m.disk(0).material.tensileStrength, 7e3),
        ({(*DP, "tensile_strength"): 3e3}, lambda m: m.wall("DP").tensileStrength, 3e3),
    ],
    ("materials", "*", "residual_tensile_strength"): [
        ({(*ROCK, "residual_tensile_strength"): 70.0}, lambda m: m.disk(0).material.residualTensileStrength, 70.0),
        ({(*DP, "residual_tensile_strength"): 30.0}, lambda m: m.wall("DP").residualTensileStrength, 30.0),
    ],
    # where no other is given
    ("materials", "*", "friction"): [
        ({(*ROCK, "friction"): 0.9}, lambda m: m.disk(0).material.frictionAngle, angle(0.9)),
        ({(*DP, "friction"): 0.7}, lambda m: m.wall("DP").frictionAngle, angle(0.7)),
        ({(*DP, "friction"): 0.7}, lambda m: m.wall("DP").residualFrictionAngle, angle(0.7)),
    ],
    ("materials", "*", "residual_friction"): [
        ({(*ROCK, "residual_friction"): 0.15}, lambda m: m.disk(0).material.residualFrictionAngle, angle(0.15)),
        ({(*DP, "residual_friction"): 0.25}, lambda m: m.wall("DP").residualFrictionAngle, angle(0.25)),
    ],
    ("materials", "*", "rolling_friction"): [
        ({(*ROCK, "rolling_friction"): 0.21}, lambda m: m.disk(0).material.rollingFriction, 0.21),
        (
            {(*DP, "rolling_friction"): 0.31},
            lambda m: (m.wall("DP").rollingFriction, m.wall("DP").residualRollingFriction),
            (0.31, 0.31),
        ),
    ],
    ("materials", "*", "residual_rolling_friction"): [
        ({(*ROCK, "residual_rolling_friction"): 0.03}, lambda m: m.disk(0).material.residualRollingFriction, 0.03),
        ({(*DP, "residual_rolling_friction"): 0.04}, lambda m: m.wall("DP").residualRollingFriction, 0.04),
    ],
    ("materials", "*", "bond_ellipse"): [
        (
            {(*ROCK, "bond_ellipse"): [0.011, 0.033]},
            lambda m: (m.disk(0).material.bondEllipseNormal, m.disk(0).material.bondEllipseTangential),
            (0.011, 0.033),
        ),
        (
            {(*DP, "bond_ellipse"): [0.012, 0.034]},
            lambda m: (m.wall("DP").bondEllipseNormal, m.wall("DP").bondEllipseTangential),
            (0.012, 0.034),
        ),
    ],
    ("materials", "*", "bond_creation_distance"): [
        ({(*ROCK, "bond_creation_distance"): 0.2}, lambda m: m.disk(0).material.bondCreationDistance, 0.2),
        # the collider knows contacts as far as they are bonded
        (
            {(*DP, "bond_creation_distance"): 0.3},
            lambda m: (m.wall("DP").bondCreationDistance, slope.hard(m.section).reach),
            (0.3, pytest.approx(0.31)),
        ),
    ],
    ("materials", "*", "bonds_close"): [
        ({(*ROCK, "bonds_close"): True}, lambda m: m.disk(0).material.bondsClose, True),
        (
            {(*DP, "bonds_close"): True},
            lambda m: (m.wall("DP").bondsClose, m.disk(0).material.bondsClose),
            (True, False),
        ),
    ],
    ("materials", "*", "restitution"): [
        ({(*ROCK, "restitution"): 0.4}, lambda m: m.disk(0).material.restitution, 0.4),
        ({(*DP, "restitution"): 0.3}, lambda m: m.wall("DP").restitution, 0.3),
    ],
    ("materials", "*", "density"): (
        {(*ROCK, "density"): 1900.0},
        lambda m: m.disk(0).state.mass,
        pytest.approx(1900 * math.pi / 4, rel=1e-12),
    ),
    ("materials", "*", "slip_weakening", "law"): (
        {(*DP, "slip_weakening", "law"): "exponential"},
        lambda m: m.wall("DP").weakening,
        "exponential",
    ),
    ("materials", "*", "slip_weakening", "critical_slip"): (
        {(*DP, "slip_weakening", "critical_slip"): 0.7},
        lambda m: m.wall("DP").criticalSlip,
        0.7,
    ),
    ("materials", "*", "slip_weakening", "friction"): (
        {(*DP, "slip_weakening", "friction"): 0.11},
        lambda m: m.wall("DP").weakenedFrictionAngle,
        angle(0.11),
    ),
    ("materials", "*", "slip_weakening", "tensile_strength"): (
        {(*DP, "slip_weakening", "tensile_strength"): 9.0},
        lambda m: m.wall("DP").weakenedTensileStrength,
        9.0,
    ),
    # test_heated_slopes follows them further
    ("materials", "*", "slip_law", "set"): (heated(set="marble"), lambda m: m.wall("DP").law[0], ("tabulated",)),
    ("materials", "*", "slip_law", "law"): (
        heated(law=["thermal_pressurization", "flash_heating"], parameters=ZONE),
        lambda m: m.wall("DP").law[0],
        ("thermal_pressurization", "flash_heating"),
    ),
    ("materials", "*", "slip_law", "parameters", "*"): (
        heated(set="vaiont", parameters={"thickness": 0.002}),
        lambda m: m.wall("DP").law[1]["thickness"],
        [0.002],
    ),
    ("materials", "*", "slip_law", "cell_length"): (
        heated(set="vaiont", cell_length=3.5),
        lambda m: m.wall("DP").cellLength,
        3.5,
    ),
    ("materials", "*", "envelope", "cohesion"): ({(*ROCK, "envelope", "cohesion"): 4e3}, passive, (4e3, 35.0)),
    ("materials", "*", "envelope", "friction_deg"): (
        {(*ROCK, "envelope", "friction_deg"): 30.0},
        passive,
        (10e3, 30.0),
    ),
    ("disks", "diameter"): (
        {("disks", "diameter"): [1.2, 1.8], ("disks", "packing_fraction"): 0.7},
        lambda m: (1.2 <= 2 * radii(m).min() < 1.22, 1.78 < 2 * radii(m).max() <= 1.8),
        (True, True),
    ),
    # by volume the median is 2 a b/(a + b) = 1.33 m, by number 1.5 m; the median of some 80 disks at even quantiles is
    # within 2 % of it
    ("disks", "distribution"): [
        ({("disks", "distribution"): kind}, lambda m: 2 * np.median(radii(m)), pytest.approx(median, rel=0.02))
        for kind, median in (("uniform_by_number", 1.5), ("uniform_by_volume", 4 / 3))
    ],
    ("disks", "packing_fraction"): [
        (
            {("disks", "packing_fraction"): 0.41},
            lambda m: sum(m.section.disk_counts()),
            lambda m: pytest.approx(0.5 * sum(section_of(BASE).disk_counts()), abs=1),
        ),
        ({("disks", "packing_fraction"): 0.5, ("water", "volume"): "bulk"}, lambda m: m.built.water.volumeFactor, 2.0),
    ],
    # filled higher by a share of the thickness below the surface, which is pressed down again
    ("disks", "pressed"): (
        {("disks", "pressed"): True},
        lambda m: (m.section.pressed, m.section.growth),
        (True, pytest.approx(1.011, abs=2e-3)),
    ),
    ("disks", "count"): (
        {("disks", "count"): 120, ("disks", "packing_fraction"): 0.75},
        lambda m: (sum(m.section.disk_counts()), len(radii(m))),
        (pytest.approx(120, abs=1), pytest.approx(120, abs=1)),
    ),
    ("water", "unit_weight"): [
        ({("water", "unit_weight"): 5000.0}, lambda m: m.built.water.unitWeight, 5000.0),
        (
            {("water", "unit_weight"): 5000.0, ("water", "pressure_gradient"): "parallel_seepage"},
            lambda m: m.built.water.pressureGradient.norm(),
            pytest.approx(5000 * math.cos(math.radians(25)), rel=1e-4),
        ),
    ],
    ("water", "plane"): [
        (
            {("walls",): BASE["walls"] + SEAT, ("water", "plane"): "seat"},
            lambda m: tuple(m.built.water.planePoint),
            (80.0, 38.0, 0),
        ),
        (
            {},
            lambda m: tuple(m.built.water.planeNormal),
            lambda m: pytest.approx((math.sin(math.radians(25)), math.cos(math.radians(25)), 0), abs=1e-4),
        ),
    ],
    ("water", "plane", "point"): (
        {("water", "plane"): {"point": [-3.0, 2.0], "dip": 10.0}},
        lambda m: tuple(m.built.water.planePoint),
        (-3.0, 2.0, 0.0),
    ),
    ("water", "plane", "dip"): (
        {("water", "plane"): {"point": [-3.0, 2.0], "dip": 10.0}},
        lambda m: tuple(m.built.water.planeNormal),
        pytest.approx((math.sin(math.radians(10)), math.cos(math.radians(10)), 0), rel=1e-12),
    ),
    ("water", "pressure_gradient"): [
        ({("water", "pressure_gradient"): [1.0, 2.0]}, lambda m: tuple(m.built.water.pressureGradient), (1, 2, 0)),
        (
            {("water", "pressure_gradient"): "hydrostatic"},
            lambda m: tuple(m.built.water.pressureGradient),
            (0, -9810, 0),
        ),
        (
            {("water", "pressure_gradient"): "parallel_seepage"},
            lambda m: tuple(m.built.water.pressureGradient),
            lambda m: pytest.approx(
                tuple(-9810 * math.cos(math.radians(m.section.dip)) * c for c in (*m.section.normal, 0)), rel=1e-12
            ),
        ),
        # what is pushed down the plane, to the right, slides, and what is pushed up it does not
        *(
            (
                {("water", "pressure_gradient"): [sign * 9500.0, 4430.0], ("stages", "end", "time"): 0.8},
                lambda m: m.disk(0).state.vel[0] > 0.1,
                slides,
                None,
            )
            for sign, slides in ((-1, True), (1, False))
        ),
    ],
    ("water", "phreatic", "lines", "*", "time"): (
        water(phreatic={"lines": LINES}),
        lambda m: (pressure(m, time=1.0), list(m.run.field.times)),
        (pytest.approx(9810 * (0.5 + 14.5 / 3 + 1 / 3 - 3)), [0.0, 2.0]),
        0.3,
    ),
    ("water", "phreatic", "lines", "*", "points"): (
        water(phreatic={"lines": LINES}),
        lambda m: (pressure(m), pressure(m, time=2.0)),
        (pytest.approx(9810 * (0.5 + 14.5 / 3 - 3)), pytest.approx(9810 * (1.5 + 13.5 / 3 - 3))),
        0.3,
    ),
    ("water", "phreatic", "flow"): (
        water(phreatic={"lines": LINES, "flow": "along"}),
        pressure,
        pytest.approx(9810 * (0.5 + 14.5 / 3 - 3) / (1 + (14.5 / 45) ** 2)),
        0.3,
    ),
    ("water", "field", "file"): (water(field={"file": FIELD}), lambda m: pressure(m, time=1.0), pytest.approx(AT), 0.3),
    ("water", "field", "sha256"): (
        water(field={"file": FIELD, "sha256": hashlib.sha256(Path(FIELD).read_bytes()).hexdigest()}),
        lambda m: m.section.water.digests,
        (hashlib.sha256(Path(FIELD).read_bytes()).hexdigest(),),
    ),
    ("water", "field", "states", "*", "time"): (
        water(field={"states": [{"time": 2.0, "file": STATE}], "name": "p"}),
        lambda m: pressure(m, time=1.0),
        pytest.approx(0.5 * AT),
        0.3,
    ),
    ("water", "field", "states", "*", "file"): (
        water(field={"states": [{"time": 0.0, "file": STATE}], "name": "p"}),
        pressure,
        pytest.approx(AT),
        0.3,
    ),
    ("water", "field", "states", "*", "sha256"): (
        water(
            field={
                "states": [{"time": 0.0, "file": STATE, "sha256": hashlib.sha256(Path(STATE).read_bytes()).hexdigest()}]
            }
        ),
        lambda m: m.section.water.digests,
        (hashlib.sha256(Path(STATE).read_bytes()).hexdigest(),),
    ),
    ("water", "field", "name"): (
        water(field={"file": STATE, "name": "p"}),
        lambda m: pressure(m),
        pytest.approx(AT),
        0.3,
    ),
    ("water", "field", "scale"): (
        water(field={"file": FIELD, "scale": 2.0}),
        lambda m: pressure(m, time=1.0),
        pytest.approx(2 * 9810 * (9 + 5 - 1.5)),
        0.3,
    ),
    ("water", "field", "stretch"): (
        water(field={"file": FIELD, "stretch": 4.0}),
        lambda m: pressure(m, time=1.0),
        pytest.approx(AT / 4),
        0.3,
    ),
    ("water", "field", "mirrored"): (
        water(field={"file": FIELD, "mirrored": True}, outside="dry"),
        lambda m: pressure(m, time=1.0),
        pytest.approx(9810 * (9 - 10 - 3) * 1.0),
        0.3,
    ),
    ("water", "seepage", "size"): (
        seeping(LAKE, size=0.7),
        lambda m: len(of_section.field(m.section).mesh.nodes) > 2 * len(field_of(LAKE).mesh.nodes),
        True,
    ),
    # twice the conductivity takes twice the rain
    ("water", "seepage", "conductivity"): (
        seeping({"time": 0.0, "rain": 2e-6}, conductivity=2e-5),
        head,
        lambda m: pytest.approx(head_with({"time": 0.0, "rain": 1e-6}), rel=1e-6),
    ),
    ("water", "seepage", "conductivity", "*"): (
        seeping(LAKE, conductivity={"L1": 1e-5, "L2": 1e-6}),
        lambda m: m.section.water.conductivity,
        (("L1", 1e-5, 1e-5, 0.0), ("L2", 1e-6, 1e-6, 0.0)),
    ),
    **{
        ("water", "seepage", "conductivity", "*", name): (
            seeping(LAKE, conductivity={"L1": 1e-5, "L2": {"along": 3e-6, "across": 1e-6, "dip": 25.0}}),
            lambda m, k=k: m.section.water.conductivity[1][k],
            value,
        )
        for k, (name, value) in enumerate((("along", 3e-6), ("across", 1e-6), ("dip", 25.0)), 1)
    },
    ("water", "seepage", "dry"): (
        seeping({"time": 0.0, "rain": 1e-6}, dry=0.3),
        lambda m: (m.section.water.dry, head(m) == head_with({"time": 0.0, "rain": 1e-6})),
        (0.3, False),
    ),
    ("water", "seepage", "states", "*", "time"): (
        seeping({**LAKE, "time": 2.0}),
        lambda m: list(of_section.field(m.section).times),
        [0.0, 2.0],
    ),
    ("water", "seepage", "states", "*", "reservoir"): (seeping(LAKE), head, pytest.approx(0.8, abs=1e-9)),
    ("water", "seepage", "states", "*", "rain"): (
        seeping({"time": 0.0, "rain": 1e-6}),
        lambda m: head(m) > head_with({"time": 0.0, "rain": 1e-7}),
        True,
    ),
    ("water", "seepage", "states", "*", "drained"): (
        seeping(LAKE, {"time": 1.0, "drained": False}),
        lambda m: float(of_section.field(m.section).pressure([[-5.0, 3.5]], 1.0)[0]) > 9810,
        True,
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "wall"): (
        border("head", 10.0, wall="DP"),
        head,
        pytest.approx(0.8, abs=0.5),
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "line"): (
        border("reservoir", 10.0, line=TOP),
        head,
        pytest.approx(0.8, abs=0.05),
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "head"): (
        border("head", 11.0),
        lambda m: head(m, (-15.0, 7.1)),
        pytest.approx(3.9, abs=0.2),
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "pressure_head"): (
        border("pressure_head", 2.0),
        lambda m: head(m, (-15.0, 7.1)),
        pytest.approx(2.0, abs=0.2),
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "reservoir"): (
        border("reservoir", 10.0, line=TOP),
        head,
        pytest.approx(0.8, abs=0.05),
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "inflow"): (
        border("inflow", 1e-6),
        lambda m: head(m, (-15.0, 7.1)) > 0.2,
        True,
    ),
    # water that comes in below cannot leave by the top
    ("water", "seepage", "states", "*", "boundaries", "*", "closed"): (
        seeping({"time": 0.0, "boundaries": [{"wall": "DP", "pressure_head": 6.0}, {"line": TOP, "closed": True}]}),
        lambda m: head(m, (-15.0, 10.0)) > 1.0,
        True,
    ),
    ("water", "seepage", "states", "*", "boundaries", "*", "seepage_face"): (
        seeping({"time": 0.0, "reservoir": 30.0, "boundaries": [{"line": TOP, "seepage_face": True}]}),
        lambda m: head(m, (-15.0, 11.4)) < 0.2,
        True,
    ),
    ("water", "outside"): (
        water(phreatic={"lines": [{"time": 0.0, "points": [[-20.0, 8.0], [5.0, 0.5]]}]}, outside="dry"),
        lambda m: tuple(m.run.slope.water.field.at(Vector3(-30.0, 0.0, 0), 1.0)),
        (None, None),
        0.3,
    ),
    # its old name, of the force per volume
    ("water", "gradient"): [
        (
            {("water", "pressure_gradient"): None, ("water", "gradient"): [1.0, 2.0]},
            lambda m: tuple(m.built.water.pressureGradient),
            (-1, -2, 0),
        ),
        (
            {("water", "pressure_gradient"): None, ("water", "gradient"): "buoyant"},
            lambda m: m.section.water.pressure_gradient,
            "parallel_seepage",
        ),
    ],
    ("water", "volume"): [
        ({("water", "volume"): "bulk"}, lambda m: m.built.water.volumeFactor, pytest.approx(1 / 0.82)),
        ({}, lambda m: m.built.water.volumeFactor, 1.0),
    ],
    # it rises from t0, a quarter of a second after the begin, at the begin of each step
    ("water", "table", "rate"): (
        {("water", "table"): {"rate": 0.25}, ("water", "pressure_gradient"): [0.0, -1e-6]},
        lambda m: m.built.water.height,
        lambda m: pytest.approx(0.25 * (O.time - O.dt - m.run.state.t0), abs=1e-9),
        1.0,
    ),
    ("water", "table", "points"): (
        {
            ("water", "table"): {"points": [[0, 0.5], [0.5, 1.5], [1.0, 1.0]]},
            ("water", "pressure_gradient"): [0.0, -1e-6],
        },
        lambda m: ([t - m.run.state.t0 for t in m.built.water.times], list(m.built.water.heights)),
        (pytest.approx([0, 0.5, 1.0], abs=1e-9), [0.5, 1.5, 1.0]),
        0.5,
    ),
    ("water", "release_distance"): [
        ({("water", "release_distance"): 0.25}, lambda m: m.built.water.releaseDistance, 0.25),
        ({("water", "release_distance"): "critical_slip"}, lambda m: m.built.water.releaseDistance, 50.0),
    ],
    ("water", "release", "by"): [
        ({("water", "release"): {"by": "dilatancy"}}, lambda m: m.built.water.releaseDistance, math.inf),
        ({("water", "release"): {"by": "slip_or_dilatancy"}}, lambda m: m.built.water.releaseDistance, 0.5),
        ({("water", "release"): {"by": "slip"}}, lambda m: m.built.water.releaseDistance, 0.5),
    ],
    ("water", "release", "dilation"): (
        {("water", "release"): {"by": "dilatancy", "dilation": 0.05}},
        lambda m: WaterRelease(m.built).rule.dilation,
        0.05,
    ),
    # d² of these disks has the mean 1 · 2
    ("water", "release", "over"): (
        {("water", "release"): {"by": "dilatancy", "over": 2}},
        lambda m: WaterRelease(m.built).reach,
        pytest.approx(2 * math.sqrt(2)),
    ),
    ("water", "release", "drainage_time"): (
        {("water", "release"): {"by": "dilatancy", "drainage_time": 7}},
        lambda m: WaterRelease(m.built).rule.drainage_time,
        7.0,
    ),
    **{
        ("shaking", key): (
            {("shaking",): SHAKEN | change},
            lambda m, found=found: found(m.of(GroundMotionEngine)),
            expected,
        )
        for key, change, found, expected in (
            ("file", {"file": RECORD}, lambda e: list(e.horizontal), pytest.approx([0.0, 2.0, -1.0, 0.0])),
            ("vertical_file", {"vertical_file": RECORD}, lambda e: list(e.vertical), pytest.approx([0, 2.0, -1.0, 0])),
            ("unit", {"unit": "gal"}, lambda e: list(e.horizontal), pytest.approx([0, 2e-2, -1e-2, 0])),
            ("uneven", {"file": UNEVEN, "unit": None, "uneven": True}, lambda e: list(e.times), [0.0, 0.5, 2.0]),
            ("baseline", {"baseline": "constant"}, lambda e: sum(e.horizontal), pytest.approx(-1 / 3, abs=1e-9)),
            ("peak", {"peak": 6.0}, lambda e: list(e.horizontal), pytest.approx([0, 6.0, -3.0, 0])),
            ("factor", {"factor": 0.5}, lambda e: list(e.horizontal), pytest.approx([0, 1.0, -0.5, 0])),
            ("stretch", {"stretch": 2.0}, lambda e: list(e.times), pytest.approx([0, 0.2, 0.4, 0.6])),
            ("reversed", {"reversed": True}, lambda e: list(e.horizontal), pytest.approx([0, -2.0, 1.0, 0])),
        )
    },
    ("shaking", "name"): (
        {("shaking",): SHAKEN | {"name": "a record"}},
        lambda m: m.section.shaking.motion.name,
        "a record",
    ),
    ("shaking", "sha256"): ({("shaking",): SHAKEN | {"sha256": SHA256}}, lambda m: m.section.shaking.record, SHA256),
    ("shaking", "begin"): (
        {("shaking",): SHAKEN | {"begin": 0.2}},
        lambda m: (m.built.shaking.begin - m.run.state.t0, m.built.shaking.dead),
        (pytest.approx(0.2, abs=1e-9), False),
        0.6,
    ),
    **{
        ("shaking", "synthetic", key): (
            {("shaking",): {"synthetic": MADE_UP | {key: value}}},
            lambda m, found=found: found(m.section.shaking.motion),
            expected,
        )
        for key, value, found, expected in (
            ("peak", 1.5, lambda g: g.peak_acceleration(), pytest.approx(1.5)),
            ("vertical_peak", 1.5, lambda g: g.peak_acceleration("vertical"), pytest.approx(1.5)),
            ("duration", 3.0, lambda g: g.duration, pytest.approx(3.0)),
            ("step", 0.02, lambda g: g.times[1], pytest.approx(0.02)),
            ("frequency", 3.0, lambda g: "3 Hz" in g.source, True),
            ("damping", 0.3, lambda g: "damping 0.3" in g.source, True),
            ("seed", 5, lambda g: "seed 5" in g.source, True),
        )
    },
    ("stages", "settle", "ramp"): (
        {("stages", "settle", "ramp"): 0.4},
        lambda m: [row[2] for row in m.rows],
        # of the begin of a row's last step; whole once it is settled
        lambda m: pytest.approx(
            [-9.81 * (min(1, (now - O.dt) / 0.4) if now < 0.4 - 1e-6 else 1) for now, *_ in m.rows], rel=1e-6
        ),
        0.6,
    ),
    ("stages", "settle", "time_max"): (
        {("stages", "settle"): {"ramp": 0.1, "time_max": 0.3, "speed_rest": 1e-12}},
        settled,
        seconds(0.3),
        0.5,
    ),
    ("stages", "settle", "speed_rest"): [
        ({("stages", "settle"): {"ramp": 0.1, "time_max": 0.3, "speed_rest": v}}, settled, seconds(t), 0.5)
        for v, t in ((10.0, 0.1), (1e-12, 0.3))
    ],
    ("stages", "settle", "bond"): [
        ({("stages", "settle", "bond"): kind}, lambda m: (m.rows[0][5], m.rows[-1][5] > 0), (found, True), 0.7)
        for kind, found in (("before", 5), ("after", 0))
    ],
    ("stages", "dry"): ({("stages", "dry"): 0.3}, lambda m: m.run.state.t0 - m.run.state.settled, seconds(0.3), 1.0),
    ("stages", "water", "hold"): [
        (
            {("stages", "water", "hold"): "motion"},
            lambda m: 0 < m.run.state.water_hold == m.rows[-1][4] < 100,
            True,
            1.0,
        ),
        (
            {("stages", "water", "hold"): "never"},
            lambda m: (m.run.state.water_hold, m.rows[-1][4] > 400, m.run.state.moving is not None),
            (None, True, True),
            1.0,
        ),
        ({("stages", "water", "hold"): 5.0}, lambda m: (m.run.state.water_hold, m.rows[-1][4]), (5.0, 5.0), 1.0),
    ],
    ("stages", "end", "time"): (
        {("stages", "end", "time"): 0.4},
        lambda m: (m.run.state.stage, O.time - m.run.state.settled),
        ("done", seconds(0.4)),
        None,
    ),
    # it loses 1.2 m/s a second of 1.7 m/s, so 0.014 of it in a row
    ("stages", "end", "rest_fraction"): [
        (
            {("stages", "end", "rest_fraction"): share},
            lambda m: (m.run.state.stage, at_rest(m)),
            lambda m, share=share: ("done", pytest.approx(share, abs=0.02)),
            None,
        )
        for share in (0.1, 0.5)
    ],
    ("stages", "end", "rest_hold"): (
        {("stages", "end", "rest_hold"): 0.5},
        lambda m: O.time - m.run.state.resting_since,
        seconds(0.5),
        None,
    ),
    ("numerics", "time_step"): (
        {("numerics", "time_step"): 2e-3},
        lambda m: (O.dt, m.of(NonsmoothTimeStepper).largest, m.of(NonsmoothTimeStepper).smallest),
        (2e-3, 2e-3, 2e-4),
    ),
    ("numerics", "path"): [
        ({("numerics", "path"): 0.3}, lambda m: m.of(NonsmoothTimeStepper).path, 0.3),
        ({("numerics", "path"): None}, lambda m: m.of(NonsmoothTimeStepper), None),
    ],
    ("numerics", "tolerance"): ({("numerics", "tolerance"): 3e-5}, lambda m: m.built.solver.tolerance, 3e-5),
    ("numerics", "tolerance_moving"): (
        {("numerics", "tolerance_moving"): 7e-3},
        lambda m: max(row[3] for row in m.rows),
        7e-3,
        1.0,
    ),
    ("numerics", "max_iterations"): ({("numerics", "max_iterations"): 55}, lambda m: m.built.solver.maxIterations, 55),
    ("numerics", "verlet_distance"): (
        {("numerics", "verlet_distance"): 0.35},
        lambda m: m.of(PlanarGridCollider).verletDist,
        -0.35,
    ),
}
CASES = [(key, *case) for key, cases in WHERE.items() for case in (cases if isinstance(cases, list) else [cases])]


def section_of(content):
    """A section of data, without a file of the test's own."""
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "s.yaml").write_text(yaml.safe_dump(content))
        return section.load(str(Path(folder) / "s.yaml"))


def at_rest(m):
    """Mean speed by its maximum where the rest was noticed first."""
    from yade.nonsmooth import records

    series = records.read_series(m.run.folder / "series.csv")
    k = np.searchsorted(series["time_s"], m.run.state.resting_since - 1e-9)
    return series["speed_mean_m_per_s"][k] / series["speed_mean_m_per_s"].max()


def test_every_key_of_the_schema_has_its_place():
    assert set(keys()) == set(WHERE)


@pytest.mark.filterwarnings("ignore:.*old name of pressure_gradient")
@pytest.mark.parametrize(
    "key, changes, found, expected, end",
    [(*case, 0.0)[:5] for case in CASES],
    ids=["-".join(case[0]) for case in CASES],
)
def test_a_key_acts(make, key, changes, found, expected, end):
    there = found(made := make(changes, end))
    assert there == (expected(made) if callable(expected) else expected)


#: Keys whose values leave a run what it is, bit for bit: a checkpoint of the old value may be resumed with the new one.
IDLE = {
    ("name",),
    ("description",),
    ("unusual",),
    ("walls", "*", "name"),
    ("walls", "*", "apart"),
    ("layers", "*", "name"),
    ("materials", "*", "envelope", "cohesion"),
    ("materials", "*", "envelope", "friction_deg"),
    ("shaking", "name"),
    ("shaking", "sha256"),
}


@pytest.mark.filterwarnings("ignore:.*old name of pressure_gradient")
@pytest.mark.parametrize("key", [key for key in WHERE if key not in IDLE], ids="-".join)
def test_a_checkpoint_belongs_to_a_value(tmp_path, key):
    """A run is not resumed with another value of any key that it depends on."""
    base = experiment.run_key(read(tmp_path))
    assert base == experiment.run_key(read(tmp_path))
    # some have the block's own value
    assert any(experiment.run_key(read(tmp_path, changes)) != base for k, changes, *_ in CASES if k == key)
