"""Collapse of a column whose disks overlap to begin with: the profile must not know the time step."""

from __future__ import annotations

import math

import numpy as np

from ...figures import style
from ...measure import heap as measures
from ...studies.heaps.column import Column
from ...studies.heaps.grains import PATH_PER_STEP
from . import Claims, Findings, check
from .cases import folder_of, run_cases

SUBJECT = "Convergence"
WHEN = 0.66  # √(H/g), as the profile in the middle of a published collapse
OVERLAP = 0.1  # ℓ, the largest to begin with; with 0.01 a bias on the velocity cannot be told from chance
ASPECT = 2.0
TOLERANCE = 1e-5
POINTS = 2000  # at which two profiles are compared


def collapse(folder, disks, seed, path, overlap, rate):
    """A column at :data:`WHEN` after its release from rounded places; writes ``profile.npz`` (x and height of its
    surface before and then [m]).

    ``path``: time step as mean diameters at the speed of a fall from the top; ``overlap``: places are rounded so that
    disks overlap by up to this [ℓ], 0: not at all; ``rate``: share κ of the errors of position that a step takes back.
    """
    from yade import O

    from ...studies.heaps import course, preparation
    from ...system.whole_files import write_arrays
    from ...world import worlds
    from ...world.stepping import advance

    heap = Column(disks=disks, aspect=ASPECT, seed=seed)
    ready = preparation.prepared(heap)
    x, y = rounded(ready.x, ready.y, ready.r, overlap)
    world = worlds.Hard(time_step=heap.time_step(path), tolerance=TOLERANCE, options={"relaxationRate": rate})
    scene = course.HeapScene(heap, world, ready, preparation.put(heap, world, x, y, ready.r))
    before = measures.surface(x, y, ready.r, np.ones(len(x), bool))
    scene.release()
    unit = math.sqrt(ready.height / heap.gravity)
    advance(round(WHEN * unit / O.dt))
    t = preparation.disk_table(scene.stand)
    x1, height = measures.surface(t["x"], t["y"], t["r"], np.ones(len(t["x"]), bool))
    write_arrays(
        folder / "profile.npz", x0=before[0], height0=before[1], x=x1, height=height, places_x=t["x"], places_y=t["y"]
    )
    _, _, gap = measures.gaps(x, y, ready.r, 0.0)
    return {
        "disks": len(x),
        "overlap_first_rel": float(-gap.min() / heap.mean_diameter()) if len(gap) else 0.0,
        "time_s": O.time,
        "steps": O.iter,
        "top_m": float(height.max()),
        "front_m": float(x1.max()),
        "diameter_m": heap.mean_diameter(),
    }


def rounded(x, y, r, overlap):
    """Places on a grid so wide that the largest overlap of two disks is about ``overlap`` mean diameters; the disks as
    they are for 0.
    """
    if overlap == 0:
        return x, y
    # of two disks each coordinate is off by half a pitch at most, so their gap by 1.41 pitches at most; few come near
    # that
    pitch = overlap * 2 * float(np.mean(r))
    return tuple(np.round(a / pitch) * pitch for a in (x, y))


def area_between(a, b):
    """Area between two profiles (x, height [m]) as a share of the area below the second; where a profile has no points
    its height is 0.
    """
    at = np.linspace(min(a[0].min(), b[0].min()), max(a[0].max(), b[0].max()), POINTS)
    first, second = (np.interp(at, *profile, left=0, right=0) for profile in (a, b))
    return float(np.sum(np.abs(first - second)) / np.sum(second))


@check("Collapse of a column whose disks overlap, against the time step", subject=SUBJECT, seconds=300, quick=25)
def collapse_of_rounded_places(bench):
    """Places that were printed with a few digits make disks overlap. What takes that back must not push: a bias κ g/h
    on the velocity leaves the speed κ δ/h behind, so that a column falls wider and taller, and the more so the smaller
    the step. Displacements leave no velocity behind, and the profile during the fall must not depend on the step, nor
    on κ.

    A column of aspect ratio 2 rests in its box; its disks are moved to the points of a grid, so that they overlap by up
    to 0.1 mean diameters, released, and looked at after 0.66 √(H/g), with the usual step h (a tenth of a mean diameter
    at the speed of a fall from the top) and with h/4. Compared are surfaces averaged over two diameters: the area
    between them, as a share of the area below. Two runs with anything else between them show how far chance goes: the
    same column without overlaps.
    """
    disks, seeds = (1000, (1,)) if bench.quick else (3000, (1, 2))
    kinds = {
        "h": (PATH_PER_STEP, OVERLAP, 0.2),
        "h/4": (PATH_PER_STEP / 4, OVERLAP, 0.2),
        "h/4, nothing taken back": (PATH_PER_STEP / 4, OVERLAP, 0.0),
        "h, no overlaps": (PATH_PER_STEP, 0.0, 0.2),
        "h/4, no overlaps": (PATH_PER_STEP / 4, 0.0, 0.2),
    }
    cases = [
        dict(disks=disks, seed=s, path=path, overlap=overlap, rate=rate)
        for s in seeds
        for path, overlap, rate in kinds.values()
    ]
    found = run_cases(bench, collapse, cases)
    profiles, rows, share = {}, [], {}
    for c, f in zip(cases, found):
        with np.load(folder_of(bench, collapse, c) / "profile.npz", allow_pickle=False) as data:
            profiles[c["seed"], c["path"], c["overlap"], c["rate"]] = {name: data[name] for name in data.files}
    pairs = (
        ("h", "h/4"),
        ("h/4", "h/4, nothing taken back"),
        ("h, no overlaps", "h/4, no overlaps"),
        ("h", "h, no overlaps"),
    )
    for a, b in pairs:

        def of(s, kind):
            return (profiles[s, *kinds[kind]]["x"], profiles[s, *kinds[kind]]["height"])

        share[a, b] = [area_between(of(s, a), of(s, b)) for s in seeds]
        rows.append([f"{a} against {b}", *(f"{100 * v:.2f}" for v in share[a, b])])
    claims = Claims()
    why = (
        "five columns of 1,000 disks: 0.5 to 1.7 %, as without overlaps; a bias of a fifth of the overlap a step on "
        "the velocity gives 26 to 29 %"
    )
    for s, v in zip(seeds, share["h", "h/4"]):
        what = f"seed {s}: area between the profiles with h and h/4, of the area"
        claims.at_most(what, v, 0.05, why, against="the finer step")
    why = "a column without overlaps would prove nothing"
    first = max(f["overlap_first_rel"] for f in found)
    claims.at_most(f"largest overlap to begin with over {OVERLAP} ℓ, off by", abs(first / OVERLAP - 1), 0.5, why)
    caption = f"Surfaces of the column with seed {seeds[0]} at rest (grey) and after 0.66 √(H/g)"
    plot = _sheet(bench, profiles, kinds, seeds[0]), caption
    heads = ["", *(f"seed {s}" for s in seeds)]
    table = f"Area between two profiles [%], {disks:,} disks", heads, rows
    return Findings(claims, plots=[plot], tables=[table])


@style.styled
def _sheet(bench, profiles, kinds, seed):
    figure = style.figure(6.5, 3.6, layout="constrained")
    ax = figure.subplots()
    first = profiles[seed, *kinds["h"]]
    ax.plot(first["x0"], first["height0"], color="#999999", lw=1, label="at rest")
    for kind, look in (
        ("h", dict(color="#0072B2", lw=1.8)),
        ("h/4", dict(color="#D55E00", lw=1.2)),
        ("h/4, nothing taken back", dict(color="#000000", lw=0.8, ls="--")),
    ):
        ax.plot(profiles[seed, *kinds[kind]]["x"], profiles[seed, *kinds[kind]]["height"], label=kind, **look)
    ax.set(xlabel="x [m]", ylabel="height [m]", aspect="equal", xlim=(0, None), ylim=(0, None))
    ax.legend(frameon=False)
    style.save(figure, bench.folder / "collapse.png")
    return figure
