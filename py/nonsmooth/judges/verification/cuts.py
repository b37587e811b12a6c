"""Vertical cuts in the paper's rock: the height to which they stand, against that of the rock's measured strengths."""

from __future__ import annotations

import shutil

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from ...figures import style
from ...measure.vertical_cut import vertical_cut
from ...system import whole_files
from .cases import folder_of, run_cases
from .claims import Claims, Findings
from .registry import check

__all__ = ["block", "cut", "vertical_cuts"]

BLUE, GREY = "#0072B2", "#777777"
#: Of the paper's rock, by its samples (page "The laboratory"): envelope [Pa, degrees], tensile strength [Pa], disks'
#: density [kg/m³] and packing fraction.
COHESION, FRICTION, TENSION, DENSITY, PHI, G = 85.9e3, 37.2, 75.1e3, 2500.0, 0.84, 9.81
ROCK = dict(
    tensile_strength=100e3,
    residual_tensile_strength=25e3,
    friction=0.3,
    rolling_friction=0.1,
    bond_ellipse=[0.02, 0.02],
    bond_creation_distance=0.025,
)
#: By the predicted height: depth of rock, width behind the face and before it, height of the window above the ground.
DEEP, BEHIND, BEFORE, ABOVE = 2.0, 1.2, 0.4, 0.05
#: A block that stands free: height and width, by the predicted height; time [s] in which its weight grows.
TALL, WIDE, GROWS = 2.0, 1.0, 40.0
DIG = 1.0  # m/s, how fast a cut gets deeper
STANDS, FAILS, DEEPEST = 0.9, 1.15, 1.9  # depths of cuts, by the predicted height; the last is a search


def predicted():
    """The height [m] to which a vertical cut of the rock stands, by its measured strengths."""
    return vertical_cut(COHESION, FRICTION, TENSION, DENSITY * G * PHI).height


def _made(disks, seed, walls, outline, stages, **keys):
    """A Section of the rock in an outline, on floors that are as strong as it."""
    from ...model import section

    smooth = dict(bonded=False, friction=0.0, rolling_friction=0.0)
    return section.of(
        name="cut",
        walls=walls,
        layers=[dict(name="rock", material="rock", vertices=outline)],
        materials=dict(rock=ROCK | dict(density=DENSITY), floor=ROCK, smooth=smooth),
        disks=dict(
            diameter=[1.0, 4.0], distribution="uniform_by_volume", packing_fraction=PHI, count=disks, pressed=True
        ),
        stages=stages,
        seed=seed,
        **keys,
    )


def cut(folder, disks, seed, depth):
    """A cut that is dug from the top down in a box of rock, to a ``depth`` by the predicted height, until it rests or
    has failed: what became of it, and how deep it was when it moved, by the predicted height (None where it stands).
    """
    from ...studies.slope import experiment

    h = predicted()
    left, right, bottom, top = -BEHIND * h, BEFORE * h, -DEEP * h, ABOVE * h
    opening = (depth * h + top) / DIG
    made = _made(
        disks,
        seed,
        walls=[
            dict(name="back", role="ground", material="smooth", vertices=[[left, 4 * top], [left, bottom]]),
            dict(name="floor", role="slip", material="floor", vertices=[[left, bottom], [right, bottom]]),
            dict(name="front", role="ground", material="smooth", vertices=[[right, bottom], [right, 4 * top]]),
        ],
        outline=[[left, bottom], [right, bottom], [right, 0], [left, 0]],
        stages=dict(
            settle=dict(ramp=2.0, time_max=10.0, speed_rest=2e-3),
            dry=0.5,
            end=dict(time=opening + 40.0, rest_fraction=0.02, rest_hold=2.0),
        ),
        erosion=[
            dict(
                name="cut",
                vertices=[[0, -depth * h], [1.1 * right, -depth * h], [1.1 * right, top], [0, top]],
                begin=0.5,
                end=0.5 + opening,
                opening=dict(time=opening),
            )
        ],
    )
    course = experiment.begin(made, folder)
    course.run(stands=True)
    summary, state = course.summarise(), course.state
    deep = None
    if state.moving is not None:
        window = made.erosion[0]
        open_then = window.open_share(min(state.moving - state.t0, window.end))
        deep = open_then * (depth + ABOVE) - ABOVE
    shutil.rmtree(folder / "checkpoint", ignore_errors=True)
    return {
        "verdict": summary["verdict"],
        "depth_rel": deep,
        "disks": summary["disks"],
        "bonds": summary["bonds_initial"],
    }


def block(folder, disks, seed):
    """A block of the rock that stands free on its floor, and gets heavier until it moves: the height of a cut under
    full weight to which that weight belongs, by the predicted height (None where it stands).
    """
    from yade import O

    from ... import records
    from ...model import scales
    from ...studies.slope import experiment

    h = predicted()
    half, tall = 0.5 * WIDE * h, TALL * h
    made = _made(
        disks,
        seed,
        walls=[dict(name="floor", role="slip", material="floor", vertices=[[-2.5 * h, 0], [2.5 * h, 0]])],
        outline=[[-half, 0], [half, 0], [half, tall], [-half, tall]],
        stages=dict(
            settle=dict(ramp=GROWS, time_max=GROWS + 5.0, speed_rest=2e-3),
            dry=0.5,
            end=dict(time=GROWS, rest_fraction=0.02, rest_hold=2.0),
        ),
    )
    course = experiment.begin(made, folder)
    while O.time < GROWS and course.state.failed_dry is None:
        course.run(O.time + 1.0)
    series = records.read_series(folder / "series.csv")
    moves = np.flatnonzero(series["speed_mean_m_per_s"] >= scales.of(made).moving_speed)
    shutil.rmtree(folder / "checkpoint", ignore_errors=True)
    return {"height_rel": None if not len(moves) else float(series["time_s"][moves[0]] / GROWS * TALL)}


def _failing(folder, axes, title):
    """Draws the disks of a run when it moves, darker the farther they have gone."""
    from ... import records
    from ...studies.slope import run_files

    begin = records.read_snapshot(folder / run_files.BEGIN)
    kept = [p for p in whole_files.list_of(folder / "snapshots") if p.suffix == ".npz" and p.stem.isdecimal()]
    shots = sorted(kept, key=lambda p: int(p.stem))
    for path in shots:
        s = records.read_snapshot(path)
        way = np.hypot(s.x - begin.x[s.number], s.y - begin.y[s.number])
        if np.mean(way) > 0.2:
            break
    style.draw_disks(axes, s, colormaps["YlOrRd"](np.minimum(way / 3.0, 1.0)), edge=GREY, width=0.1)
    h = predicted()
    for height in (STANDS, 1.0, FAILS):
        axes.axhline(-height * h, color=BLUE, lw=1.2 if height == 1.0 else 0.6, ls="-" if height == 1.0 else "--")
    axes.set(xlim=(-BEHIND * h, BEFORE * h), ylim=(-DEEP * h, 0.1 * h), xlabel="x [m]", ylabel="y [m]", title=title)
    axes.set_aspect("equal")


def _told(height):
    return "-" if height is None else f"{height:.2f}"


@check("Vertical cuts in the paper's rock", subject="Slopes", seconds=400, quick=40)
def vertical_cuts(bench):
    """A cut in rock of the cohesion c, the angle of friction φ and the tensile strength σ_t stands to H_c − z_t, and to
    0.966 H_c at most, with H_c = (4c/γ) tan(45° + φ/2) and the crack z_t = (2c/γ) tan(45° + φ/2) − σ_t/(γ K_a). With what
    its samples have, 85.9 kPa, 37.2° and 75.1 kPa, this is 31.6 m for the paper's rock. Cuts are dug from the top down,
    1 m each second, in a box of this rock twice as deep: to 0.9 and to 1.15 of that height, and on until they fail.

    Beside them a block of the same rock stands free on its floor, 63 m high and half as wide, and its weight grows. By
    the same formulas it fails under the weight at which a cut of its height would. How high cuts stand beyond 0.9 is
    told, and not claimed: see the page on erosion.
    """
    disks, seeds = (400, (1,)) if bench.quick else (1000, (1, 2, 3))
    depths = (STANDS, DEEPEST) if bench.quick else (STANDS, FAILS, DEEPEST)
    cases = [dict(disks=disks, seed=seed, depth=depth) for seed in seeds for depth in depths]
    found = {(c["seed"], c["depth"]): one for c, one in zip(cases, run_cases(bench, cut, cases))}
    blocks = [one["height_rel"] for one in run_cases(bench, block, [dict(disks=disks, seed=seed) for seed in seeds])]
    claims, rows = Claims(against="limit equilibrium"), []
    heights = [found[seed, DEEPEST]["depth_rel"] for seed in seeds]
    for seed, height, free in zip(seeds, heights, blocks):
        stood = float(found[seed, STANDS]["verdict"] == "stood")
        claims.near(f"packing {seed}: a cut of 0.9 of the height stands", stood, 1, "asked for", absolute=0)
        why = "a few dozen disks are its height: the fewer, the higher it stands"
        what = f"packing {seed}: height of a free block that fails, by the predicted"
        claims.between(what, np.nan if free is None else free, 0.8, 1.45, why)
        at = "-" if bench.quick else found[seed, FAILS]["verdict"]
        rows.append((str(seed), found[seed, STANDS]["verdict"], at, _told(height), _told(free)))
    heads = ("packing", "cut to 0.9", "cut to 1.15", "cut fails at", "free block fails at")
    figure = Figure(figsize=(3.4 * len(seeds), 5.4), layout="constrained")
    for axes, seed in zip(np.atleast_1d(figure.subplots(1, len(seeds))), seeds):
        case = dict(disks=disks, seed=seed, depth=DEEPEST)
        _failing(folder_of(bench, cut, case), axes, f"packing {seed}")
    caption = (
        "Cuts that fail; colours: how far disks have gone, up to 3 m. Lines: 0.9, 1 and 1.15 of the predicted height."
    )
    title = f"Heights of vertical cuts, by the predicted {predicted():.1f} m, {disks:,} disks"
    numbers = {"heights_rel": heights, "blocks_rel": blocks}
    remark = (
        f"Wanted is that cuts fail by {FAILS:g} of the predicted height. They failed at "
        f"{', '.join(map(_told, heights))} of it: nothing is claimed of that."
    )
    return Findings(claims, plots=[(figure, caption)], tables=[(title, heads, rows)], remarks=[remark], numbers=numbers)
