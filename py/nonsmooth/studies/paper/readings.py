"""What the paper leaves open, read in several ways: each reading as a rock in biaxial tests and as the slope under a
rising water table. Needs no YADE.

Taboada and Estrada (2009) give neither the largest gap that is bonded, Δ, nor how a packing is made, when it is bonded,
the lateral boundaries of the biaxial tests or the shape of the slope's toe. A reading is the shipped section with some
keys changed, and a sample of its rock made and tested in one way. Its sample is tested between smooth and between rough
platens, of which the paper says nothing either; a reading that is itself about the sample's boundary stands once. What
is measured of a reading, and how near it is to the paper, says :mod:`.reading_numbers`.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...campaign.sweep import FUNCTION
from ...model import section
from ...model.section import data as section_data, values as section_values
from ...running import side_by_side
from ...system import keys
from ..laboratory import biaxial_test, campaign, pressing
from . import reading_numbers
from .reading_numbers import PRESSURES, SHIPPED

__all__ = ["PLATENS", "READINGS", "Reading", "run", "slope_of", "tests_of"]

PLATENS = ("smooth", "rough")  # between which the samples of a reading are tested
END = 60.0  # s of simulation, by when the paper's slope has failed
LAYERS_ROCK = "rock"  # material of the shipped section's layers


@dataclass(frozen=True)
class Reading:
    """``label``: in words; ``keys``: of the section file, with dots; ``test``: fields of the biaxial Test and, as
    ``count``, ``friction`` and ``aspect``, of its Shape; ``shape``: changes the plain data of a section in place;
    ``platens``: between which its samples are tested."""

    label: str
    keys: dict = field(default_factory=dict)
    test: dict = field(default_factory=dict)
    shape: Callable | None = None
    platens: tuple = PLATENS


def _toe(thickness=65.0, inclination=90.0):
    """Gives the shipped slope a toe of so many metres normal to DP, and its backstop so many degrees to DP, measured in
    the mass.
    """

    def change(data):
        beta, theta = math.radians(section.of(data).dip), math.radians(inclination)
        up = np.array([-math.cos(beta), math.sin(beta)])
        normal = np.array([math.sin(beta), math.cos(beta)])
        top = thickness * (up / math.tan(theta) + normal)
        old = np.array(next(w for w in data["walls"] if w["name"] == "FB")["vertices"][-1])
        for item in (*data["walls"], *data["layers"]):
            for k, vertex in enumerate(item["vertices"]):
                share = float(np.dot(vertex, old) / np.dot(old, old))
                if np.allclose(vertex, share * old, atol=1e-2):  # on the backstop
                    item["vertices"][k] = [round(float(v), 6) for v in share * top]

    return change


def _layers(thickness, thinnest=4.0):
    """Gives the shipped slope layers of so many metres from DP upwards. Its surface is as before and cuts the upper
    ones, which thin out up the slope; where one would be thinner than ``thinnest`` [m], the largest disk, the layer
    below it reaches to the surface."""

    def change(data):
        beta = math.radians(section.of(data).dip)
        axes = np.array([[-math.cos(beta), math.sin(beta)], [math.sin(beta), math.cos(beta)]])  # up DP, and off it
        crown = axes @ data["layers"][0]["vertices"][-1]  # of DP
        foot, edge = (axes @ data["layers"][-1]["vertices"][k] for k in (1, 2))  # of the surface

        def surface(s):
            return foot[1] + (edge[1] - foot[1]) * s / edge[0]

        def face(off):
            return crown[0] + (edge[0] - crown[0]) * off / edge[1]

        bottoms = np.arange(0.0, foot[1] - thinnest, thickness)
        ends = (foot[1] - bottoms - thinnest) * edge[0] / (foot[1] - edge[1])  # where each is the thinnest
        made = []
        for k, (off, end) in enumerate(zip(bottoms, ends)):
            above, reach = (bottoms[k + 1], ends[k + 1]) if k + 1 < len(bottoms) else (foot[1], 0.0)
            line = [(0.0, off), (0.0, above)]
            if reach >= edge[0]:  # the layer above goes to the crown
                line += [(face(above), above), (face(off), off)]
            else:
                line += [(reach, above), (reach, surface(reach))] if reach else []
                line += [tuple(edge), (face(off), off)] if end >= edge[0] else [(end, surface(end)), (end, off)]
            vertices = np.round(np.array(line) @ axes, 3).tolist()
            made.append(data["layers"][0] | {"name": f"L{k + 1}", "vertices": vertices})
        data["layers"] = made

    return change


def _bonds(distance, closes=False):
    """Bonds over gaps up to a ``distance`` [ℓ]; ``closes``: they close freely."""
    keys_of = {"bond_creation_distance": distance, **({"bonds_close": True} if closes else {})}
    return {f"materials.{name}.{key}": value for name in (LAYERS_ROCK, "fb") for key, value in keys_of.items()}


_ROCK = f"materials.{LAYERS_ROCK}."
_PACKED = {"disks.pressed": False, "stages.settle.bond": "before"}

READINGS = {
    SHIPPED: Reading("as shipped"),
    "gap-0.005": Reading("Δ = 0.005", _bonds(0.005)),
    "gap-0.01": Reading("Δ = 0.01", _bonds(0.01)),
    "gap-0.015": Reading("Δ = 0.015", _bonds(0.015)),
    "gap-0.02": Reading("Δ = 0.02", _bonds(0.02)),
    "gap-0.03": Reading("Δ = 0.03", _bonds(0.03)),
    "gap-0.05": Reading("Δ = 0.05", _bonds(0.05)),
    "closing-0.015": Reading("bonds that close, Δ = 0.015", _bonds(0.015, closes=True)),
    "closing-0.02": Reading("bonds that close, Δ = 0.02", _bonds(0.02, closes=True)),
    "closing-0.025": Reading("bonds that close, Δ = 0.025", _bonds(0.025, closes=True)),
    "packed": Reading("not pressed", _PACKED, {"friction": None}),
    "packed-0.05": Reading("not pressed, Δ = 0.05", _PACKED | _bonds(0.05), {"friction": None}),
    "bonded-before": Reading("bonded before gravity", {"stages.settle.bond": "before"}),
    "ellipse-0.01": Reading("half axes 0.01 ℓ: whole axes, or in mean radii", {_ROCK + "bond_ellipse": [0.01, 0.01]}),
    "ellipse-0.015": Reading("half axes 0.015 ℓ: in the smaller disk", {_ROCK + "bond_ellipse": [0.015, 0.015]}),
    "ellipse-0.04": Reading("half axes 0.04 ℓ", {_ROCK + "bond_ellipse": [0.04, 0.04]}),
    "frictional": Reading("no strength left in tension", {_ROCK + "residual_tensile_strength": 0.0}),
    "residual-0.025": Reading("residual strength over gaps up to Δ, in samples", test={"adhesion_range": 0.025}),
    "no-rolling": Reading("no rolling friction left", {_ROCK + "residual_rolling_friction": 0.0}),
    "membrane": Reading("flexible sides", test={"sides": "flexible"}, platens=("rough",)),
    "glued": Reading("glued platens", platens=("glued",)),
    "half": Reading("samples of half as many disks", test={"count": 0.5}),
    "aspect-1.5": Reading("samples 1.5 times as high as wide", test={"aspect": 1.5}),
    "aspect-3": Reading("samples 3 times as high as wide", test={"aspect": 3.0}),
    "toe-67.5": Reading("toe of 67.5 m", shape=_toe(67.5)),
    "layers-13.5": Reading("layers of 13.5 m, cut by the surface", shape=_layers(13.5)),
    "volume-bulk": Reading("water acts on the volume of the bulk", {"water.volume": "bulk"}),
    "backstop-70": Reading("FB 70° to DP", shape=_toe(inclination=70.0)),
    "backstop-110": Reading("FB 110° to DP", shape=_toe(inclination=110.0)),
    "backstop-loose": Reading("FB without bonds", {"materials.fb.bonded": False}),
    "DP-bonded": Reading(
        "DP bonded, as in Table 1", {"materials.dp.bonded": True, "materials.dp.tensile_strength": 1e5}
    ),
}


def section_of(reading):
    """The shipped section as a Reading has it, as if its file said so."""
    data = section_values.given(section.load("jiufengershan"))
    for key, value in reading.keys.items():
        section_values.put(data, key, value)
    if reading.shape:
        reading.shape(data)
    return section.of(data, reading.label)


def slope_of(reading, disks, seed):
    """The Section of a Reading with about so many disks."""
    return dataclasses.replace(section_of(reading), seed=seed).with_disks(disks)


def tests_of(reading, disks, seeds, platens, strain=biaxial_test.BiaxialTest.strain, pressures=PRESSURES):
    """The biaxial Tests of a Reading between ``platens`` (see biaxial_test.BiaxialTest): of its rock, one for each seed
    and for each of the ``pressures`` [Pa].
    """
    fields = dict(reading.test)
    count = round(disks * fields.pop("count", 1.0))
    shape = {key: fields.pop(key) for key in ("friction", "aspect") if key in fields}
    rock = section_of(reading).materials[LAYERS_ROCK]
    return [
        biaxial_test.BiaxialTest(rock, p, pressing.Shape(count, seed, **shape), strain, platens, **fields)
        for seed in seeds
        for p in pressures
    ]


def run(
    chosen,
    out,
    slope_disks,
    sample_disks,
    seeds,
    platens=PLATENS,
    strain=biaxial_test.BiaxialTest.strain,
    pressures=PRESSURES,
    slopes=True,
    threads=1,
    resume=False,
    progress=lambda share, doing: None,
):
    """Runs the tests and the slopes of ``chosen``, {name: Reading}, below the folder ``out``; those that several share
    are run once. Returns rows, a list of dictionaries, one for each reading and each of the ``platens`` between which
    its samples are tested; a reading that stands once is tested between its own.

    ``pressures`` [Pa]; ``slopes``: whether the slopes, of about ``slope_disks``, are made and run. What a row would
    take from other tests, or from slopes, is None in it.

    A row has ``name``, ``label``, ``platens``, ``folder`` (of its tests, below ``out``), and what
    :func:`.reading_numbers.row` says. ``progress``: called with the share done and what is being done. Raises what
    campaign.run raises, and processes.RunError.
    """
    out, wanted = Path(out), {}
    for name, reading in chosen.items():
        data = [section_data.plain(slope_of(reading, slope_disks, seed)) for seed in seeds] if slopes else None
        sloped_key = keys.key_of(data)
        for p in reading.platens:
            if p in platens or len(reading.platens) == 1:
                tests = tests_of(reading, sample_disks, seeds, p, strain, pressures)
                wanted[name, p] = tests, data, tuple(map(biaxial_test.key_of, tests)), sloped_key
    # the first of those that share a key is run
    tested = {key: (name, tests) for name, (tests, _, key, _) in reversed(wanted.items())}
    sloped = {key: (name, data) for (name, _), (_, data, _, key) in reversed(wanted.items())} if slopes else {}
    measured, failed = {}, {}
    share_of_tests = 0.6 if sloped else 1.0
    for k, (key, (name, tests)) in enumerate(tested.items()):

        def shown(share, doing, k=k, name=name):
            return progress(share_of_tests * (k + share) / len(tested), f"{', '.join(name)}: {doing}")

        folder = Path("samples", *name)
        found = campaign.run(tests, out / folder, threads, resume, shown)
        measured[key] = folder.as_posix(), campaign.summarise(tests[0].material, found, threads=threads)
    made = [
        side_by_side.Run(
            f"{name}, seed {seed}",
            out / "slopes" / name / f"seed{seed}",
            FUNCTION,
            {"data": one, "end": END},
            keys.key_of([one, END]),
        )
        for name, data in sloped.values()
        for seed, one in zip(seeds, data)
    ]

    def shown(share, ended):
        return progress(0.6 + 0.4 * share, f"{ended} of {len(made)} slopes")

    found = iter(side_by_side.run(made, threads, resume, progress=shown, go_on=True) if made else ())
    for key in sloped:
        failed[key] = [next(found) for _ in seeds]
    rows = []
    for (name, p), (_, _, tested_key, sloped_key) in wanted.items():
        folder, samples = measured[tested_key]
        told = {"name": name, "label": chosen[name].label, "platens": p, "folder": folder}
        rows.append(told | reading_numbers.row(samples, out / folder, failed.get(sloped_key, ())))
    return rows
