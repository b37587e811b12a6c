"""Slopes that shake: blocks against closed forms, a section's block against Newmark's, the frame of the ground against
walls that move.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from matplotlib.figure import Figure

from yade import O
from yade.wrapper import GroundMotionEngine

from ... import figures, records
from ...measure import newmark
from ...model import section
from ...model.ground_motion import GroundMotion
from ...studies.slope import experiment, run_files
from ...system.whole_files import empty
from ...world import shaking, tables
from ...world.stepping import advance
from .claims import Claims, Findings
from .registry import check
from .small_scenes import G, begin, disk, material, wall

BLUE, RED, GREY = "#0072B2", "#D55E00", "#777777"
DIP = math.radians(30)
ALONG, NORMAL = (math.cos(DIP), -math.sin(DIP)), (math.sin(DIP), math.cos(DIP))
STEP = 2e-3  # s
HALF_A_STEP = "each slide begins and ends up to a step of 2 ms late"
TOLERANCE = 1e-8  # of steps that are compared in two frames: what a solve leaves over differs between them
#: Of one cycle of a sine of 1 g and 1 Hz: yield [g] and slip [m].
CYCLE = ((0.1, 1.182179), (0.2, 0.891448), (0.4, 0.466652), (0.6, 0.195903), (0.8, 0.046665))


def pulse(amplitude, length):
    """A rectangular pulse [g] over so many seconds; its flanks last a microsecond."""
    flank = 1e-6
    return np.array([0, flank, length, length + flank]), amplitude * np.array([0, 1, 1, 0])


def sine(amplitude, length, periods):
    """So many periods of a sine [g] over so many seconds."""
    t = np.linspace(0, length, 4001)
    return t, amplitude * np.sin(2 * math.pi * periods * t / length)


def slip_of_pulse(a, n, length):
    """Newmark's slip [m] under a pulse of ``a`` g where it yields at ``n`` g: V²/(2 g n)(1 − n/a), V = a g T."""
    return (a * G * length) ** 2 / (2 * G * n) * (1 - n / a)


def slip_of_half_sine(a, n, length):
    """The same under half a sine: it slides from asin(n/a) on; velocity and way in closed form, until it stops."""
    w = math.pi / length
    first = math.asin(n / a) / w

    def speed(t):
        return G * (a / w * (math.cos(w * first) - math.cos(w * t)) - n * (t - first))

    def way(t):
        return G * (
            a / w * (math.cos(w * first) * (t - first) - (math.sin(w * t) - math.sin(w * first)) / w)
            - n * (t - first) ** 2 / 2
        )

    if speed(length) > 0:  # it stops after the pulse
        return way(length) + speed(length) ** 2 / (2 * G * n)
    low, high = math.pi / w / 2, length
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if speed(middle) > 0 else (low, middle)
    return way(low)


def slide(n, record, moves, until):
    """Times [s] and slip [m] of a disk that does not roll on a plane of 30° that is shaken along itself, up first;
    ``moves``: "frame" or "walls".
    """
    O.reset()
    stuff = material((n + math.sin(DIP)) / math.cos(DIP))
    ends = [tuple(60 * sign * c for c in ALONG) for sign in (-1, 1)]
    plane = wall(ends, stuff)
    block = disk(*(0.5 * c for c in NORMAL), stuff, blocked="zXYZ")
    t, a = record
    ground = GroundMotionEngine(
        times=(t + 0.1).tolist(), horizontal=(-G * a * ALONG[0]).tolist(), vertical=(-G * a * ALONG[1]).tolist()
    )
    if moves == "walls":
        ground.ids = [piece.id for piece in plane]
    begin(gravity=(0, -G, 0), dt=STEP, before=[ground])

    def place():
        return sum((p - q) * c for p, q, c in zip(block.state.pos, plane[0].state.pos, ALONG))

    first, found = place(), [(0.0, 0.0)]
    while O.time < until:
        advance(10)
        found.append((O.time, place() - first))
    return np.array(found).T


@check("Blocks on a plane that shakes", subject="Slopes", seconds=5)
def shaken_blocks(bench):
    """A block on a plane of the dip β = 30°, which is shaken along itself by a record a(t), yields where it is driven up
    by more than N g, with μ = (N + sin β)/cos β; it then slides down with the acceleration a − N g until it stops
    (Newmark 1965). Under a rectangular pulse of A g over T it slides by ½ A g T² (A/N − 1); under half a sine the
    velocity is g[(A/w)(cos w t₁ − cos w t) − N (t − t₁)] from t₁ = asin(N/A)/w on; under one cycle of a sine of 1 g and
    1 Hz by the figures of the table. The disk does not roll. Both ways to shake it are the same problem in two frames:
    the frame of the ground, where it bears −m a, and walls that move with the ground.
    """
    cases = [
        *((f"pulse of {a:g} g over {T:g} s, N = {n:g}", n, pulse(a, T), slip_of_pulse(a, n, T), 0.1 + a * T / n + 0.3)
          for a, n, T in ((0.5, 0.1, 0.2), (1, 0.5, 0.3), (0.4, 0.2, 1))),
        *((f"half a sine of {a:g} g over {T:g} s, N = {n:g}", n, sine(a, T, 0.5), slip_of_half_sine(a, n, T), 2.0)
          for a, n, T in ((0.5, 0.1, 0.2), (1, 0.5, 0.3), (1, 0.8, 0.5))),
        *((f"a cycle of a sine of 1 g, 1 Hz, N = {n:g}", n, sine(1, 1, 1), exact, 5.5 if n < 0.2 else 2.6)
          for n, exact in CYCLE),
    ]  # fmt: skip
    claims, table = Claims(), []
    figure = Figure(figsize=(8.4, 3.6), layout="constrained")
    axes, compared = figure.subplots(1, 2)
    for k, (name, n, record, exact, until) in enumerate(cases):
        bench.progress(name)
        found = {moves: slide(n, record, moves, until) for moves in ("frame", "walls")}
        frame, walls = (found[moves][1][-1] for moves in ("frame", "walls"))
        claims.near(f"{name}: slip in the frame of the ground [m]", frame, exact, HALF_A_STEP, relative=0.01)
        off = abs(walls - frame) / exact
        claims.at_most(f"{name}: of walls that move, off that by", off, 1e-6, "the same problem but for rounding")
        table.append((name, f"{exact:.6f}", f"{frame:.6f}", f"{walls:.6f}"))
        compared.plot(k + 1, frame / exact - 1, "o", color=BLUE)
        compared.plot(k + 1, walls / exact - 1, "x", color=RED)
        if "cycle" in name:
            (line,) = axes.plot(*found["frame"], lw=1.4, label=f"N = {n:g}")
            axes.axhline(exact, color=line.get_color(), lw=0.7, ls=":")
    axes.set(xlabel="time [s]", ylabel="slip [m]", title="A cycle of a sine; dotted: closed forms")
    axes.legend()
    compared.set(xlabel="case, as in the table", ylabel="slip, off its closed form", ylim=(-0.012, 0.012))
    compared.set_title("o frame of the ground, x walls")
    compared.axhline(0, color=GREY, lw=0.6)
    heads = ("motion", "closed form [m]", "frame [m]", "walls [m]")
    return Findings(
        claims,
        plots=[(figure, "Slip of the block, and what it is off the closed forms.")],
        tables=[("Slip of blocks.", heads, table)],
    )


def bonded_block():
    """A bonded block of disks on a plane of 30° that friction alone holds, under a made-up earthquake."""
    c, s = math.cos(DIP), math.sin(DIP)

    def at(along, height):
        return [round(along * c + height * s, 6), round(-along * s + height * c, 6)]

    return section.of(
        name="block",
        walls=[dict(name="plane", role="slip", material="plane", vertices=[at(-12, 0), at(12, 0)])],
        layers=[dict(name="block", material="rock", vertices=[at(-6, 0), at(0, 0), at(-1.2, 2), at(-6, 2)])],
        materials=dict(
            rock=dict(
                tensile_strength=1e8, friction=1.0, rolling_friction=1.0, bond_creation_distance=0.2, density=2500.0
            ),
            plane=dict(bonded=False, friction=0.75, rolling_friction=0.1),
        ),
        disks=dict(diameter=[0.6, 1.0], packing_fraction=0.75),
        shaking=dict(synthetic=dict(peak=7.0, vertical_peak=2.0, duration=8.0, frequency=2.0, seed=3), begin=0.5),
        stages=dict(
            settle=dict(ramp=0.2, time_max=1.0, speed_rest=1e-3),
            dry=0.1,
            end=dict(time=20.0, rest_fraction=0.02, rest_hold=0.2),
        ),
        numerics=dict(time_step=STEP, tolerance=1e-6, tolerance_moving=1e-5, max_iterations=1000, verlet_distance=0.6),
    )


@check("A slope's block under an earthquake", subject="Slopes", seconds=5)
def shaken_slope(bench):
    """A bonded block on a plane of 30° with μ = 0.75 (a yield of 0.146 g along the plane), as a section with the key
    ``shaking``: filtered noise of 7 m/s² with a vertical component. Its displacement in the series is that of Newmark's
    block under the same record at each row, and at the end.
    """
    made, folder = bonded_block(), bench.folder / "block"
    O.reset()
    empty(folder)
    course = experiment.begin(made, folder)
    course.run(stands=True)
    series = records.read_series(folder / "series.csv")
    t = series["time_s"] - records.read_snapshot(folder / run_files.BEGIN).time_s - made.shaking.begin
    motion = made.shaking.motion
    exact = newmark.slide(newmark.Block(30, 0.75, gravity=made.gravity), motion)
    slip, after = series["displacement_m:plane"], t > 0
    claims = Claims(against="Newmark's block")
    claims.near("slip at the end [m]", slip[-1], exact.permanent, HALF_A_STEP, relative=0.01)
    worst = np.abs(slip[after] - exact.at(t[after])).max() / exact.permanent
    claims.at_most("largest difference in a row, by the slip at the end", worst, 0.015, HALF_A_STEP)
    times = np.unique(np.r_[motion.times, t[after]])
    ground = motion.acceleration(times), motion.velocity(times), motion.displacement(times)
    blocks = [("Newmark's block", times, exact.at(times))]
    plot = figures.shaking(times, *ground, surfaces=[("plane", t, slip)], blocks=blocks, title=motion.source)
    return Findings(claims, plots=[(plot, "The motion of the ground, and the slip of the block beside Newmark's.")])


@check("The frame of the ground, and walls that move", subject="Slopes", seconds=20, quick=8)
def shaken_frames(bench):
    """A slope of 500 disks, at rest, is shaken in both ways from the same state. Places against the walls are the same
    problem in each step, so they differ by rounding, which the collisions of a moving mass let grow. It is told when
    they are 1e-6 and 1e-3 of a mean diameter apart.
    """
    made = dataclasses.replace(section.load("circle").with_disks(500), water=None)
    size = math.sqrt(made.disks.mean_square)
    t = np.linspace(0, 4, 401)
    motion = GroundMotion(t, 3 * np.sin(2 * math.pi * t), 1.5 * np.sin(3 * math.pi * t), name="two sines")
    folder = bench.folder / "frames"
    O.reset()
    empty(folder)
    course = experiment.begin(made, folder)
    while course.state.t0 is None:
        course.run(O.time + 0.5)
    start = str(folder / "rest.yade.bz2")
    O.save(start)
    walls = [i for ids in course.slope.walls.values() for i in ids]
    ways = {}
    for moves in ("frame", "walls"):
        bench.progress(moves)
        O.load(start)
        O.engines = [e for e in O.engines if type(e).__name__ != "CourseRunner"]
        ground = shaking.ground_motion(motion, walls=walls if moves == "walls" else ())
        solver = next(k for k, e in enumerate(O.engines) if type(e).__name__ == "ContactDynamicsEngine")
        O.engines = [*O.engines[:solver], ground, *O.engines[solver:]]
        engine = next(e for e in O.engines if type(e).__name__ == "ContactDynamicsEngine")
        engine.tolerance, engine.maxIterations = TOLERANCE, 3000
        first, stood, rows = O.time, O.bodies[walls[0]].state.pos, []
        for _ in range(20 if bench.quick else 50):
            advance(until=first + 0.1 * (len(rows) + 1))
            table = tables.bodies(engine)
            gone = np.array(O.bodies[walls[0]].state.pos - stood)[:2]
            rows.append((O.time - first, np.column_stack((table["x"], table["y"])) - gone))
        ways[moves] = rows
    times = np.array([time for time, _ in ways["frame"]])
    apart = np.array([np.abs(a - b).max() / size for (_, a), (_, b) in zip(ways["frame"], ways["walls"], strict=True)])
    mean = [float(np.abs((rows[-1][1] - rows[0][1]).mean(axis=0)).max()) for rows in ways.values()]
    claims = Claims()
    claims.at_most("largest difference after 0.1 s, in mean diameters", apart[0], 1e-8, "what is left of the solve")
    why = "rounding and what is left of the solve, as the sliding mass lets it grow"
    claims.at_most("the same in the end", apart[-1], 0.02, why)
    claims.at_least("mean way of the disks [m]", mean[0], 0.05, "else nothing would have moved")
    why = "the two are other runs by then, of one mean over 500 disks"
    claims.near("the same of walls that move [m]", mean[1], mean[0], why, relative=0.05)
    remarks = []
    for limit in (1e-6, 1e-3):
        reached = times[apart >= limit]
        said = f"after {reached[0]:.1f} s" if len(reached) else f"not within {times[-1]:.0f} s"
        remarks.append(f"The two are {limit:g} mean diameters apart {said}.")
    figure = Figure(figsize=(6, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.semilogy(times, np.maximum(apart, 1e-17), color=BLUE, lw=1.4)
    axes.set(xlabel="time since it shakes [s]", ylabel="largest difference of places [mean diameters]")
    return Findings(claims, plots=[(figure, "How far the two frames are apart.")], remarks=remarks)
