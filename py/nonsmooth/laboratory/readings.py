"""What the paper leaves open, read in several ways: each reading as a rock in biaxial tests and as the slope under a rising water table. Needs no YADE.

Taboada and Estrada (2009) give neither the largest gap that is bonded, Δ, nor how a packing is made, when it is bonded, the lateral boundaries of the biaxial
tests or the shape of the slope's toe. A reading is the shipped section with some keys changed, and a sample of its rock made and tested in one way. Platens are rough where a reading does
not say otherwise: with smooth ones, the last that was tried, the reading is the nearest, and it is shipped. How near it is to the
paper is one number, the root mean square of :func:`misses`: differences from :data:`PAPER` by what they may be.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .. import keys, section, section_data, section_values, side_by_side
from ..campaign.sweep import FUNCTION
from ..statistics import over_seeds, told
from . import biaxial_test, campaign, pressing

__all__ = ["PAPER", "PRESSURES", "READINGS", "SHIPPED", "Reading", "misses", "run", "slope_of", "tests_of"]

#: {number: (of the paper, what a reading may differ by)}: Table 1, Figure 10 (the strain of the peak, as its binary logarithm), and [115].
PAPER = {
    "cohesion_peak_kPa": (88.0, 25.0),
    "friction_peak_deg": (38.5, 2.0),
    "cohesion_residual_kPa": (13.0, 13.0),
    "friction_residual_deg": (26.2, 2.0),
    "strain_peak": (0.01, 1.0),
    "water_highest_m": (22.5, 4.0),
}
PRESSURES = (0.5e6, 4e6, 8e6, 16e6)  # Pa; Figure 10 has the last three, the first tells the cohesion
FIGURE_10 = PRESSURES[1:]
END = 60.0  # s of simulation, by when the paper's slope has failed
LAYERS_ROCK = "rock"  # material of the shipped section's layers
SHIPPED = "smooth"  # of READINGS


@dataclass(frozen=True)
class Reading:
    """``label``: in words; ``keys``: of the section file, with dots; ``test``: fields of the biaxial Test and, as ``friction`` and ``count``, of its Shape; ``shape``: changes the plain data of
    a section in place."""

    label: str
    keys: dict = field(default_factory=dict)
    test: dict = field(default_factory=dict)
    shape: Callable | None = None


def _toe(thickness=65.0, inclination=90.0):
    """Gives the shipped slope a toe of so many metres normal to DP, and its backstop so many degrees to DP, measured in the mass."""

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
    """Gives the shipped slope layers of so many metres from DP upwards. Its surface is as before and cuts the upper ones, which thin out up the slope; where one would be thinner than
    ``thinnest`` [m], the largest disk, the layer below it reaches to the surface."""

    def change(data):
        beta = math.radians(section.of(data).dip)
        axes = np.array([[-math.cos(beta), math.sin(beta)], [math.sin(beta), math.cos(beta)]])  # up DP, and off it
        crown = axes @ data["layers"][0]["vertices"][-1]  # of DP
        foot, edge = (axes @ data["layers"][-1]["vertices"][k] for k in (1, 2))  # of the surface
        surface = lambda s: foot[1] + (edge[1] - foot[1]) * s / edge[0]  # noqa: E731
        face = lambda off: crown[0] + (edge[0] - crown[0]) * off / edge[1]  # noqa: E731
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


def _bonds(distance):
    return {f"materials.{name}.bond_creation_distance": distance for name in (LAYERS_ROCK, "fb")}


_ROCK = f"materials.{LAYERS_ROCK}."
_PACKED = {"disks.pressed": False, "stages.settle.bond": "before"}

READINGS = {
    "rough": Reading("rough platens"),
    "gap-0.005": Reading("Δ = 0.005", _bonds(0.005)),
    "gap-0.01": Reading("Δ = 0.01", _bonds(0.01)),
    "gap-0.015": Reading("Δ = 0.015", _bonds(0.015)),
    "gap-0.02": Reading("Δ = 0.02", _bonds(0.02)),
    "gap-0.03": Reading("Δ = 0.03", _bonds(0.03)),
    "gap-0.05": Reading("Δ = 0.05", _bonds(0.05)),
    "packed": Reading("not pressed", _PACKED, {"friction": None}),
    "packed-0.05": Reading("not pressed, Δ = 0.05", _PACKED | _bonds(0.05), {"friction": None}),
    "bonded-before": Reading("bonded before gravity", {"stages.settle.bond": "before"}),
    "ellipse-0.01": Reading("ellipse of axes 0.02 ℓ", {_ROCK + "bond_ellipse": [0.01, 0.01]}),
    "ellipse-0.04": Reading("ellipse of half axes 0.04 ℓ", {_ROCK + "bond_ellipse": [0.04, 0.04]}),
    "frictional": Reading("no strength left in tension", {_ROCK + "residual_tensile_strength": 0.0}),
    "no-rolling": Reading("no rolling friction left", {_ROCK + "residual_rolling_friction": 0.0}),
    "membrane": Reading("flexible sides", test={"sides": "flexible"}),
    SHIPPED: Reading("as shipped: smooth platens", test={"platens": "smooth"}),
    "glued": Reading("glued platens", test={"platens": "glued"}),
    "half": Reading("samples of half as many disks", test={"count": 0.5}),
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


def tests_of(reading, disks, seeds, strain=biaxial_test.Test.strain):
    """The biaxial Tests of a Reading: of its rock, one for each seed and for each of :data:`PRESSURES`."""
    fields = {"platens": "rough", **reading.test}
    count = round(disks * fields.pop("count", 1.0))
    shape = {"friction": fields.pop("friction")} if "friction" in fields else {}
    rock = section_of(reading).materials[LAYERS_ROCK]
    return [
        biaxial_test.Test(rock, p, pressing.Shape(count, seed, **shape), strain, **fields)
        for seed in seeds
        for p in PRESSURES
    ]


def run(
    chosen,
    out,
    slope_disks,
    sample_disks,
    seeds,
    strain=biaxial_test.Test.strain,
    threads=1,
    resume=False,
    progress=lambda share, doing: None,
):
    """Runs the tests and the slopes of ``chosen``, {name: Reading}, below the folder ``out``; those that several share are run once. Returns rows, a list of dictionaries.

    A row has ``name``, ``label``, for each number of :data:`PAPER` its mean over seeds, ``…_95`` (half of the 95 % interval, None for one seed) and ``…_each``, ``misses`` (see :func:`misses`)
    and their root mean square ``distance``. ``progress``: called with the share done and what is being done. Raises what campaign.run raises, and processes.RunError.
    """
    out, wanted = Path(out), {}
    for name, reading in chosen.items():
        tests = tests_of(reading, sample_disks, seeds, strain)
        data = [section_data.plain(slope_of(reading, slope_disks, seed)) for seed in seeds]
        wanted[name] = tests, data, tuple(map(biaxial_test.key_of, tests)), keys.key_of(data)
    # the first of those that share a key is run
    tested = {key: (name, tests) for name, (tests, _, key, _) in reversed(wanted.items())}
    sloped = {key: (name, data) for name, (_, data, _, key) in reversed(wanted.items())}
    measured, failed = {}, {}
    for k, (key, (name, tests)) in enumerate(tested.items()):
        shown = lambda share, doing, k=k, name=name: progress(  # noqa: E731
            0.6 * (k + share) / len(tested), f"{name}: {doing}"
        )
        found = campaign.run(tests, out / "samples" / name, threads, resume, shown)
        measured[key] = campaign.summarise(tests[0].material, found, threads=threads)
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
    shown = lambda share, ended: progress(0.6 + 0.4 * share, f"{ended} of {len(made)} slopes")  # noqa: E731
    found = iter(side_by_side.run(made, threads, resume, progress=shown, go_on=True))
    for key in sloped:
        failed[key] = [next(found) for _ in seeds]
    return [
        {"name": name, "label": chosen[name].label} | _row(measured[tested_key], failed[sloped_key], seeds)
        for name, (_, _, tested_key, sloped_key) in wanted.items()
    ]


def _row(samples, slopes, seeds):
    row = {}
    for name in list(PAPER)[:4]:
        middle, unit = name.rsplit("_", 1)
        row |= {name: samples[name], f"{name}_95": samples[f"{middle}_95_{unit}"]}
    peaks = [
        [t["strain_peak"] for t in samples["tests"] if t["seed"] == seed and t["confining_Pa"] in FIGURE_10]
        for seed in seeds
    ]
    # of one sample: the geometric mean over the pressures
    each = {
        "strain_peak": [float(np.exp(np.mean(np.log(p)))) for p in peaks],
        "water_highest_m": [s["water_highest_m"] for s in slopes],
    }
    for name, values in each.items():
        mean = over_seeds(values)
        row |= {name: mean["mean"], f"{name}_95": mean["half_width"], f"{name}_each": values}
    found = misses(row)
    return row | {
        "misses": found,
        "distance": None if None in found.values() else math.sqrt(np.mean(np.square(list(found.values())))),
    }


def misses(row):
    """{number: difference from the paper by what it may be} for a dictionary with the numbers of :data:`PAPER`; 1 and less is within it, None where a number is missing."""
    found = {}
    for name, (wanted, allowed) in PAPER.items():
        value = row[name]
        if value is not None:
            value = math.log2(value / wanted) if name == "strain_peak" else value - wanted
        found[name] = None if value is None else value / allowed
    return found


#: {number: (its head in a table, its factor, digits)}.
SHOWN = {
    "cohesion_peak_kPa": ("peak cohesion [kPa]", 1, 0),
    "friction_peak_deg": ("peak friction [°]", 1, 1),
    "cohesion_residual_kPa": ("residual cohesion [kPa]", 1, 0),
    "friction_residual_deg": ("residual friction [°]", 1, 1),
    "strain_peak": ("strain of the peak [%]", 100, 2),
    "water_highest_m": ("highest water [m]", 1, 1),
}


def table(rows):
    """(heads, lines) of texts for what :func:`run` returned: the paper, then a line for each reading, the nearest first."""

    def text(row, name):
        _, factor, digits = SHOWN[name]
        return told(row[name], row.get(f"{name}_95"), digits, factor)

    paper = {name: wanted for name, (wanted, _) in PAPER.items()}
    ordered = sorted(rows, key=lambda row: math.inf if row["distance"] is None else row["distance"])
    lines = [["the paper", *(text(paper, name) for name in SHOWN), ""]]
    lines += [
        [
            row["label"],
            *(text(row, name) for name in SHOWN),
            "–" if row["distance"] is None else f"{row['distance']:.2f}",
        ]
        for row in ordered
    ]
    return ["reading", *(head for head, _, _ in SHOWN.values()), "distance"], lines
