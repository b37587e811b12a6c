"""Water in sections that run: still water on a submerged face, states in time, seepage along a slope and up through
grains.
"""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from yade import O

from .... import figures, records
from ....model import section
from ....studies.safety import search
from ....studies.safety.asked import Asked
from ....studies.slope import experiment, run_files
from ....system.whole_files import empty
from ....water import field_files, forces, mesh
from ....water.fields import MeshField, PhreaticLine
from ....world import tables
from ..claims import Claims, Findings
from ..registry import check

__all__ = [
    "CRITICAL",
    "bank",
    "displaced",
    "floating_grains",
    "grains",
    "lakes",
    "parallel_seepage",
    "slab",
    "states_in_time",
    "still_water_on_a_face",
    "uplift",
]

BLUE, RED, GREY = "#0072B2", "#D55E00", "#777777"
GAMMA, G, PHI = 9810.0, 9.81, 0.84
ROUNDING = "rounding"
NUMERICS = dict(time_step=5e-3, tolerance=1e-6, tolerance_moving=1e-5, max_iterations=2000, verlet_distance=0.6)
STRONG = dict(tensile_strength=1e8, friction=1.0, rolling_friction=1.0, bond_creation_distance=0.2, density=2500.0)
SMOOTH = dict(bonded=False, friction=0.0, rolling_friction=0.0)


def stages(end, hold=0.5):
    """Of a small section: loaded within half a second, t0 a tenth after its rest."""
    return dict(
        settle=dict(ramp=0.3, time_max=0.5, speed_rest=1e-3),
        dry=0.1,
        end=dict(time=end, rest_fraction=0.02, rest_hold=hold),
    )


# ---- a bank under a lake -----------------------------------------------------------------------------
def bank(water, end=20.0):
    """A Section: a bank of bonded rock, 8 m high with a face of 39°, between a smooth wall and open ground."""
    return section.of(
        name="bank",
        walls=[
            dict(name="back", role="ground", material="smooth", vertices=[[-20, 12], [-20, 0]]),
            dict(name="floor", role="slip", material="floor", vertices=[[-20, 0], [20, 0]]),
        ],
        layers=[dict(name="bank", material="rock", vertices=[[-20, 0], [0, 0], [-10, 8], [-20, 8]])],
        materials=dict(rock=STRONG, smooth=SMOOTH, floor=dict(bonded=False, friction=0.5, rolling_friction=0.1)),
        disks=dict(diameter=[0.6, 1.0], packing_fraction=PHI),
        water=water,
        stages=stages(end),
        numerics=NUMERICS,
    )


def lakes(level, folder):
    """{kind: ``water`` of a section}: still water up to a ``level`` [m], in each way to say it; files go into
    ``folder``.
    """
    grid = mesh.grid(np.linspace(-25, 25, 11), np.linspace(-2, 14, 9))
    path = field_files.write(MeshField(grid, [0.0], [GAMMA * (level - grid.nodes[:, 1])]), folder / "still.h5")
    states = [{"time": 0.0, "reservoir": level}]
    return {
        "phreatic": {"phreatic": {"lines": [{"time": 0.0, "points": [[-20, level], [20, level]]}]}},
        "field": {"field": {"file": str(path)}},
        "seepage": {"seepage": {"size": 1.0, "conductivity": {"bank": {"along": 1e-5, "across": 1e-6}}, "states": states}},
        "table": {
            "plane": "floor",
            "pressure_gradient": "hydrostatic",
            "table": {"points": [[0.0, level], [1.0, level]]},
        },
    }  # fmt: skip


def displaced(course, level):
    """γ_w times the bulk [N/m] of the disks of an Experiment whose centres lie below a ``level`` [m], and the numbers of
    these and of all disks.
    """
    t = tables.bodies(course.slope.solver)
    below = t["y"] < level
    bulk = math.pi * math.fsum(t["r"][below] ** 2) / course.section.disks.packing_fraction
    return GAMMA * bulk, int(below.sum()), len(below)


def uplift(course):
    """The force (x, y) [N/m] of the water on all disks of an Experiment in its last step."""
    return np.array(tuple(course.slope.water.totalForce)[:2])


@check("Still water on a submerged face", subject="Water", seconds=15)
def still_water_on_a_face(bench):
    """A bank of rock in a lake, its face under water to 5 m of 8, as a section with each kind of water: a phreatic
    line, a file, seepage and a table. Still water has p = γ_w (Y − y), so −∇p on a disk's share of the bulk, A/φ, is
    γ_w A/φ upwards, in the ground, in the water and between. The sum is the weight of the bulk that gives way, and has
    no part sideways: the load on the submerged face is in it. The floor bears that much less than the bank's weight.
    """
    level, claims, plots = 5.0, Claims(), []
    for kind, water in lakes(level, bench.folder).items():
        bench.progress(kind)
        folder = bench.folder / kind
        O.reset()
        empty(folder)
        course = experiment.begin(bank({"volume": "bulk", **water}), folder)
        course.run(end=1.2)
        weight, below, count = displaced(course, level)
        force = uplift(course)
        claims.near(f"{kind}: uplift, by the weight displaced", force[1] / weight, 1, ROUNDING, absolute=1e-10)
        claims.near(f"{kind}: force sideways, by that", force[0] / weight, 0, ROUNDING, absolute=1e-10)
        claims.near(f"{kind}: wet disks", course.slope.water.wetCount, below, "those below the level", absolute=0)
        walls = records.read_walls(folder / "walls.csv")
        floor = walls["normal_N_per_m"][walls["wall"] == "floor"][-1]
        whole = G * sum(O.bodies[i].state.mass for i in range(course.slope.first_disk, course.slope.first_disk + count))
        what = f"{kind}: what the floor bears, by weight less uplift"
        claims.near(what, floor / (whole - weight), 1, "a rest to the solver's tolerance", absolute=2e-3)
        if not plots:
            figure = Figure(figsize=(7, 2.6), layout="constrained")
            axes = figure.add_subplot()
            axes.axhspan(0, level, color=BLUE, alpha=0.15, lw=0)
            figures.draw(O, ax=axes, view=(-20.5, 8, -0.5, 9))
            plots.append((figure, f"The bank, with water to {level:g} m, and the forces of its contacts."))
    return Findings(claims, plots=plots)


# ---- states in time ----------------------------------------------------------------------------------
LEVELS = ((0.4, 2.0), (1.0, 6.5), (1.6, 3.0))  # of the lake: times since t0 [s], and heights [m]
TIMES = (0.1, 0.25, 0.4, 0.7, 0.95, 1.0, 1.3, 1.55, 2.0)  # s since t0


def level_at(time):
    """The level [m] at a ``time`` [s] from the first state on."""
    return float(np.interp(time, *np.transpose(LEVELS)))


def courses(folder):
    """{kind: (``water`` of a section, PhreaticLine or MeshField of the same pressures from the first state on)} of a
    course of states: the lake, by phreatic lines, and a slope of the pressure that turns, by a file, which go into
    ``folder``.
    """
    times = [time for time, _ in LEVELS]
    flat = [[[-20.0, y], [20.0, y]] for _, y in LEVELS]
    lines = [{"time": time, "points": line} for time, line in zip(times, flat)]
    grid = mesh.grid(np.linspace(-25, 25, 11), np.linspace(-2, 14, 9))
    x, y = grid.nodes.T
    turning = MeshField(grid, times, [GAMMA * (9 + tilt * x - y) for tilt in (0.0, 0.2, -0.1)])
    path = field_files.write(turning, folder / "turning.h5")
    return {
        "phreatic": ({"phreatic": {"lines": lines}}, PhreaticLine(flat, times)),
        "field": ({"field": {"file": str(path)}}, turning),
    }


@check("States of water, between their times", subject="Water", seconds=15)
def states_in_time(bench):
    """Between two states pressures are linear in time; until the first one they grow from none at t0, and the last one
    stays. A bank in a lake whose level is 2, 6.5 and 3 m at 0.4, 1 and 1.6 s, and the same bank under pressures of a
    file that turn: at each time the engine's force on all disks is that which these pressures have at the places of
    the disks, −∇p A/φ, with the level or the gradient interpolated by hand.
    """
    claims, figure = Claims(), Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for (kind, (water, known)), colour in zip(courses(bench.folder).items(), (BLUE, RED)):
        folder = bench.folder / f"course-{kind}"
        O.reset()
        empty(folder)
        course = experiment.begin(bank({"volume": "bulk", **water}), folder)
        while course.state.t0 is None:
            course.run(O.time + 0.05)
        t0, worst, found = course.state.t0, 0.0, []
        for time in TIMES:
            course.run(t0 + time - 0.02)
            while O.time - t0 < time - 1e-9:
                O.step()
            t = tables.bodies(course.slope.solver)
            since = O.time - t0
            O.step()
            first = min(since / LEVELS[0][0], 1.0)  # the share of the first state
            own = max(since, LEVELS[0][0])
            expected = first * forces.on_disks(
                known, t["x"], t["y"], t["r"], own, area="bulk", packing_fraction=PHI, outside="dry"
            )
            if kind == "phreatic":  # the level itself, by hand
                height = level_at(own)
                lift = first * GAMMA * math.pi * math.fsum(t["r"][t["y"] < height] ** 2) / PHI
                whole = np.array([0.0, lift])
            else:
                whole = expected.sum(axis=0)
            worst = max(worst, float(np.abs(uplift(course) - whole).max() / np.abs(whole).max()))
            found.append((since, uplift(course), whole))
        claims.at_most(f"{kind}: largest difference, by the force", worst, 1e-10, ROUNDING)
        times = [time for time, *_ in found]
        for axis, mark in ((1, "o"), (0, "s")):
            axes.plot(times, [force[axis] / 1e6 for _, force, _ in found], mark, color=colour, ms=4)
            label = f"{kind}, {'up' if axis else 'sideways'}"
            line = [whole[axis] / 1e6 for *_, whole in found]
            axes.plot(times, line, color=colour, lw=0.8, ls="-" if axis else ":", label=label)
    axes.set(xlabel="time since $t_0$ [s]", ylabel="force on all disks [MN/m]")
    axes.legend(frameon=False, fontsize=8)
    return Findings(claims, plots=[(figure, "Dots: the engine's force. Lines: of the pressures, between these times.")])


# ---- seepage along a slope ---------------------------------------------------------------------------
DIP = math.radians(15)
LONG, THICK, FRICTION = 30.0, 5.0, 0.6


def on_plane(s, h):
    """The place [m] s down the plane and h above it."""
    return [s * math.cos(DIP) + h * math.sin(DIP), -s * math.sin(DIP) + h * math.cos(DIP)]


def slab(kind, share, folder):
    """A Section: a bonded slab on a plane of 15°, 5 m thick, in which water flows along the plane, up to a ``share`` of
    the thickness; ``kind``: of the section's water. Files go into ``folder``.
    """
    up, foot = share * THICK, on_plane(LONG, 0)

    def above(place, height):  # on a vertical end
        return [place[0], place[1] + height / math.cos(DIP)]

    head = on_plane(0, 0)
    top = on_plane(0, THICK) if kind == "seepage" else above(head, THICK)
    line = [above(head, up), above(foot, up)]
    if kind == "phreatic":
        water = {"phreatic": {"flow": "along", "lines": [{"time": 1.0, "points": line}]}}
    elif kind == "field":
        x0, y0 = on_plane(-6, -1)
        x1, y1 = on_plane(LONG + 6, -1)
        grid = mesh.grid(np.linspace(x0, x1, 41), np.linspace(y1, y0 + THICK + 3, 41))
        x, y = grid.nodes.T
        deep = line[0][1] - (x - line[0][0]) * math.tan(DIP) - y
        field = MeshField(grid, [1.0], [GAMMA * deep * math.cos(DIP) ** 2])
        water = {"field": {"file": str(field_files.write(field, folder / f"along-{share:g}.h5"))}}
    elif kind == "seepage":  # lines of equal head are normal to the plane; the flux is the same everywhere
        conducts = 1e-5
        boundaries = [
            {"line": [head, top], "head": on_plane(0, up)[1]},
            {"line": [foot, above(foot, up)], "inflow": -conducts * math.sin(DIP) * math.cos(DIP)},
        ]
        states = [{"time": 1.0, "boundaries": boundaries}]
        water = {"seepage": {"size": 0.8, "conductivity": conducts, "states": states}}
    else:
        water = {"plane": "plane", "table": {"points": [[0.0, 0.0], [1.0, up]]}}
    corners = [head, foot, above(foot, THICK), top]
    plane = [on_plane(-15, 0), on_plane(LONG + 15, 0)]
    return section.of(
        name="slab",
        walls=[dict(name="plane", role="slip", material="plane", vertices=plane)],
        layers=[dict(name="slab", material="rock", vertices=corners)],
        materials=dict(rock=STRONG, plane=dict(bonded=False, friction=FRICTION, rolling_friction=0.1)),
        disks=dict(diameter=[0.6, 1.0], packing_fraction=PHI),
        water={"volume": "bulk", **water},
        stages=stages(20.0),
        numerics=NUMERICS,
    )


@check("Seepage along a slope: the factor of safety", subject="Water", seconds=60, quick=30)
def parallel_seepage(bench):
    """A long slab without cohesion on a plane of the dip β = 15° with tan φ = 0.6; water flows along the plane, up to
    the share m of the slab's thickness. Then −∇p is γ_w cos β along the normal where it is wet, and

        F = (1 − m γ_w/γ) tan φ/tan β .

    The slab is bonded, so that its ends count for nothing. A search by strength reduction finds F for m = 1, with the
    same water said in four ways, and for less of it. Of seepage the heads are computed: the upper end of the slab, which
    is normal to the plane, has one head, and through the lower one flows k sin β cos β per metre.
    """
    cases = [("table", 1.0), ("phreatic", 1.0), ("field", 1.0), ("seepage", 1.0)]
    cases += [("phreatic", 0.5)] + ([] if bench.quick else [("seepage", 0.5), ("table", 0.25), ("phreatic", 0.02)])
    claims, figure, density = Claims(), Figure(figsize=(5.2, 3.4), layout="constrained"), STRONG["density"]
    axes, weight = figure.add_subplot(), PHI * density * G
    shares = np.linspace(0, 1, 11)
    axes.plot(shares, (1 - shares * GAMMA / weight) * FRICTION / math.tan(DIP), color=GREY, label="closed form")
    marks = {"table": "s", "phreatic": "o", "field": "^", "seepage": "x"}
    for kind, share in cases:
        bench.progress(f"{kind}, water in {100 * share:g} % of the slab")
        folder = bench.folder / f"{kind}-{share:g}"
        O.reset()
        empty(folder)
        asked = Asked(slab(kind, share, bench.folder), materials=("plane",), numbers={"within": 0.005})
        found = search.run(asked, folder)
        exact = (1 - share * GAMMA / weight) * FRICTION / math.tan(DIP)
        why = "asked for; the bracket is 0.5 % wide, and half a disk at the water's surface is wet or dry"
        claims.near(f"{kind}, m = {share:g}: factor of safety", found["factor"], exact, why, relative=0.02)
        axes.plot(share, found["factor"], marks[kind], color=BLUE, mfc="none", label=kind if share == 1 else None)
    axes.set(xlabel="share of the slab that is wet, m", ylabel="factor of safety")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Factors of safety that searches found, and the closed form.")])


# ---- seepage up through grains -----------------------------------------------------------------------
CRITICAL = PHI * 2500.0 / 1000.0 - 1  # γ'/γ_w of the bulk
HIGH = 6.0
RISE = (
    0.5,
    6.5,
    1.15,
)  # from no flow at the first time [s since t0] to this share of the critical gradient at the second


def grains():
    """A Section: loose disks 6 m high in a box with smooth sides, and water that comes in at its floor, ever faster."""
    first, last, most = RISE
    states = [
        {"time": time, "reservoir": HIGH, "boundaries": [{"wall": "floor", "pressure_head": HIGH * (1 + gradient)}]}
        for time, gradient in ((first, 0.0), (last, most * CRITICAL))
    ]
    return section.of(
        name="grains",
        walls=[
            dict(name="left", role="ground", material="smooth", vertices=[[-3, 12], [-3, 0]]),
            dict(name="floor", role="slip", material="floor", vertices=[[-3, 0], [3, 0]]),
            dict(name="right", role="ground", material="smooth", vertices=[[3, 0], [3, 12]]),
        ],
        layers=[dict(name="grains", material="grains", vertices=[[-3, 0], [3, 0], [3, HIGH], [-3, HIGH]])],
        materials=dict(
            grains=dict(bonded=False, friction=0.4, rolling_friction=0.0, density=2500.0),
            smooth=SMOOTH,
            floor=dict(bonded=False, friction=0.4, rolling_friction=0.0),
        ),
        disks=dict(diameter=[0.4, 0.7], packing_fraction=PHI),
        water={"volume": "bulk", "seepage": {"size": 1.0, "conductivity": 1e-4, "states": states}},
        stages=stages(last + 2.0),
        numerics=NUMERICS,
    )


@check("Grains float at the critical gradient", subject="Water", seconds=10)
def floating_grains(bench):
    """Loose grains in a box, and water that rises through them with the gradient i, which grows in time. Their share of
    the bulk bears −∇p = γ_w (1 + i) upwards, and weighs γ: so the floor bears 1 − γ_w (1 + i)/γ of the weight, and
    nothing at the critical gradient i_c = γ'/γ_w = 1.1. Above it they rise.
    """
    folder = bench.folder / "grains"
    O.reset()
    empty(folder)
    course = experiment.begin(grains(), folder)
    first, last, most = RISE
    course.run(end=None, stands=True)
    series, walls = records.read_series(folder / "series.csv"), records.read_walls(folder / "walls.csv")
    t0 = records.read_snapshot(folder / run_files.BEGIN).time_s
    mine = walls["wall"] == "floor"
    time, floor = walls["time_s"][mine] - t0, walls["normal_N_per_m"][mine]
    count = course.slope.count
    weight = G * sum(O.bodies[i].state.mass for i in range(course.slope.first_disk, course.slope.first_disk + count))
    rows = np.diff(series["time_s"][-2:])[0]
    middle = time - 0.5 * rows  # of the row, over which the force is a mean
    gradient = most * CRITICAL * np.clip((middle - first) / (last - first), None, 1.0)
    flows = (middle > first + rows) & (gradient < 0.97 * CRITICAL)
    slope, rest = np.polyfit(gradient[flows], floor[flows] / weight, 1)
    claims, still = Claims(), 1 - 1000.0 / (PHI * 2500.0)
    why = "a rest to the solver's tolerance"
    claims.near("i at which the floor bears nothing, by i_c", -rest / slope / CRITICAL, 1, "asked for", relative=0.02)
    claims.near("the floor's part of the weight in still water", rest, still, why, relative=5e-3)
    off = np.abs(floor[flows] / weight - still * (1 - gradient[flows] / CRITICAL)).max()
    claims.at_most("largest difference from the closed form, by the weight", off, 5e-3, why)
    height = np.interp(time, series["time_s"] - t0, series["centroid_y_m"])
    begin, size = height[flows][0], math.sqrt(course.section.disks.mean_square)
    before = np.abs(height[flows] - begin).max() / size
    claims.at_most("rise of the grains until 0.97 i_c, in mean diameters", before, 1e-2, "they rest")
    claims.at_least("the same at the end", (height[-1] - begin) / size, 0.3, "they float away")
    figure = Figure(figsize=(6.2, 3.2), layout="constrained")
    axes = figure.add_subplot()
    shown = middle > first
    axes.plot(
        gradient[shown] / CRITICAL, floor[shown] / weight, ".", color=BLUE, ms=4, label="floor's force, by the weight"
    )
    axes.plot([0, 1, most], [still, 0, 0], color=GREY, lw=0.8, label="closed form")
    axes.plot(
        gradient[shown] / CRITICAL, (height[shown] - begin) / size, color=RED, lw=1, label="rise, in mean diameters"
    )
    axes.set(xlabel="gradient, by the critical one", ylim=(-0.05, 1.0))
    axes.legend(frameon=False, fontsize=8)
    return Findings(claims, plots=[(figure, "What the floor bears, and how high the grains have risen.")])
