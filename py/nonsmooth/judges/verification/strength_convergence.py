"""The strength of a bonded sample against time step and tolerance."""

from __future__ import annotations

import math

import numpy as np

from ...system.whole_files import write_arrays
from .cases import run_cases
from .claims import Claims, Findings
from .refinement import Sweep, plus_minus, sheet
from .registry import check

STEPS = (20e-3, 10e-3, 5e-3, 2.5e-3, 1.25e-3)  # s
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7)
STEP, TOLERANCE = 10e-3, 1e-6  # of the shipped section
WIDTH, HEIGHT = 30.0, 60.0  # m, of the bonded sample: about 500 disks of 1 to 4 m
SPEED, RAMP = 0.05, 4.0  # m/s of the platen in compression, and seconds in which it is reached
PULL = 0.02  # m/s in tension


def strength(folder, seed, pull, time_step, tolerance, speed, strain):
    """Peak stress of a bonded sample of the shipped section's rock between two platens.

    ``pull``: 1 for tension, with platens glued on, 0 for compression; ``speed`` [m/s] of the upper platen, reached
    after a ramp; ``strain``: at the end. The curve goes to ``curve.npz`` in the folder.
    """
    from yade import O
    from yade.wrapper import NscdMat

    from ... import packing
    from ...model import section
    from ...world import scene

    sample = section.block(WIDTH, HEIGHT, seed=seed)
    made, m = packing.cached_pack(sample), sample.materials["rock"]
    rock = scene.material(m)
    glue = dict(tensileStrength=1e7, bondsToAll=True, bondCreationDistance=m.bond_creation_distance) if pull else {}
    platen = NscdMat(frictionAngle=math.atan(0.3), wall=True, **glue)
    O.materials.append((rock, platen))
    O.bodies.append([scene.disk((float(x), float(y)), float(r), rock) for x, y, r in zip(made.x, made.y, made.r)])
    bottom, top = (
        O.bodies.append(scene.segments(ends, platen, sense=1))[0]
        for ends in (((-WIDTH, 0), (2 * WIDTH, 0)), ((2 * WIDTH, HEIGHT), (-WIDTH, HEIGHT)))
    )
    O.engines = scene.engines(
        gravity=(0, 0, 0), reach=0.2, verlet=0.2 * float(made.r.min()), tolerance=tolerance, maxIterations=5000
    )
    O.dt = time_step
    engine = scene.contact_dynamics()
    O.step()
    bonds, sign = engine.bond(), 1 if pull else -1
    moving, start, rows = O.bodies[top].state, O.bodies[top].state.pos[1], []
    while abs(moving.pos[1] - start) < strain * HEIGHT:
        moving.vel = (0, sign * speed * min(1.0, O.time / RAMP), 0)
        O.step()
        # force on the platens, positive in the sense of the test
        rows.append(
            (O.time, abs(moving.pos[1] - start), -sign * O.forces.f(top)[1], sign * O.forces.f(bottom)[1], engine.bonds)
        )
    time, path, above, below, alive = np.array(rows).T
    force = 0.5 * (above + below)
    window = max(1, round(0.5 / time_step))  # the mean over half a second
    smooth = np.convolve(force, np.ones(window) / window, "valid")
    k = int(np.argmax(smooth))
    write_arrays(folder / "curve.npz", path=path, force=force, bonds=alive)
    middle = slice(k, k + window)
    return {
        "peak_Pa": smooth[k] / WIDTH,
        "path_m": float(path[middle].mean()),
        "work_J_per_m2": float(np.sum(force * np.diff(path, prepend=0))) / WIDTH,
        "imbalance": float(abs(above[middle].mean() - below[middle].mean())) / smooth[k],
        "bonds": bonds,
        "broken": int(bonds - alive[-1]),
        "disks": len(made),
        "sweeps": engine.totalIterations / engine.steps,
        "unconverged": engine.unconverged,
    }


@check("Strength of a bonded sample against time step and tolerance", subject="Convergence", seconds=250, quick=35)
def strength_convergence(bench):
    """A bond resists with an impulse of up to h F_a a step, so a bad choice of the time step h can lend a sample
    strength that is not in its bonds: Abramian and Staron (2020) show for Contact Dynamics that a larger h raises the
    effective cohesion. Bonds are also looked at once a step, so a bond that is being pulled apart at the speed u
    outlives its ellipse by up to u h. A loose tolerance goes the other way: what is not solved creeps, and fails early.
    What is claimed is the change from the finest value to the default, and from one value to the next up to ten times
    the default; a tolerance of a hundred times the default is run too, to show what it does.

    A sample of 30 m by 60 m, about 500 disks of the shipped section's rock, all bonded, is compressed between two
    platens at 0.05 m/s, and pulled at 0.02 m/s between platens that it is glued to. There is no gravity and no lateral
    pressure. The strength is the largest mean stress over half a second, taken as the mean of both platens. Inertia:
    the ramp of 4 s takes ρ H v̇ below 2 kPa. Changes are taken sample by sample, so that the scatter between samples,
    which is far larger, drops out. What remains is that a sample of rigid disks with friction has several ways to fail
    at nearly the same load; runs at half the platen's speed show how much that is.
    """
    seeds = (1,) if bench.quick else (1, 2, 3, 4)
    steps, tolerances = (STEPS[1:3], TOLERANCES[1:3]) if bench.quick else (STEPS, TOLERANCES)
    at = {(h, TOLERANCE) for h in steps} | {(STEP, r) for r in tolerances}
    cases = [
        dict(kind, seed=s, time_step=h, tolerance=r)
        for s in seeds
        for h, r in sorted(at, reverse=True)
        for kind in KINDS.values()
    ]
    if not bench.quick:
        cases += [
            dict(kind, speed=kind["speed"] / 2, seed=s, time_step=STEP, tolerance=TOLERANCE)
            for s in seeds
            for kind in KINDS.values()
        ]
    found = run_cases(bench, strength, cases)
    claims, panels, tables = [], [], []
    for name, kind in KINDS.items():
        for key, default, fixed in (
            ("time_step", STEP, {"tolerance": TOLERANCE}),
            ("tolerance", TOLERANCE, {"time_step": STEP}),
        ):
            sweep = Sweep.of(cases, found, key, "peak_Pa", default, **kind, **fixed)
            panels.append((sweep, 1e-3, f"change of strength in {name} [%]"))
            tables.append(
                (
                    f"{name.capitalize()}, mean of {len(seeds)} samples",
                    [
                        f"{sweep.varied} [{sweep.unit}]",
                        "strength [kPa]",
                        "its standard error",
                        "change from the finest [%]",
                    ],
                    list(sweep.rows(1e-3)),
                )
            )
            claims += _strength_claims(name, sweep, PRECISION[name])
    text = (
        "Change of the strength of bonded samples with the time step and the solver's tolerance; thin: single samples, thick: mean, "
        "dashed: the shipped section's value"
    )
    if not bench.quick:
        tables.append(_half_speed(cases, found))
    drawn = sheet(
        bench,
        "convergence_strength.png",
        "Strength of a bonded sample: change from the finest value",
        panels,
        relative=True,
    )
    return Findings(claims, plots=[(drawn, text)], tables=tables)


def _strength_claims(name, sweep, precision):
    scatter = (
        f"between samples the strength scatters by {100 * sweep.scatter():.0f} %"
        if len(sweep.values[sweep.default]) > 1
        else "one sample only"
    )
    claims = Claims()
    if sweep.finest < sweep.default:
        mean, error = sweep.change(sweep.default, sweep.finest)
        why = precision[2] + "; " + scatter
        what = f"strength in {name}, {sweep.varied} {sweep.default:g} over {sweep.finest:g}" + plus_minus(error)
        claims.near(what, 1 + mean, 1, why, absolute=precision[0], against="the finest")
    step, error = sweep.largest_step()
    why = (
        "the coarse values are meant to show where a trend begins; none is coarser than ten times the default; "
        + scatter
    )
    what = f"strength in {name}, largest change from one value of the {sweep.varied} to the next" + plus_minus(error)
    claims.near(what, 1 + step, 1, why, absolute=precision[1], against="the next finer")
    return claims


def _half_speed(cases, found):
    """Table of the strengths at half the platen's speed, which tells how much of a difference is the rate's."""
    rows = []
    for name, kind in KINDS.items():
        at = {
            speed: {
                c["seed"]: f["peak_Pa"]
                for c, f in zip(cases, found)
                if c["pull"] == kind["pull"]
                and c["speed"] == speed
                and (c["time_step"], c["tolerance"]) == (STEP, TOLERANCE)
            }
            for speed in (kind["speed"], kind["speed"] / 2)
        }
        whole, half = at.values()
        rows += [
            [name, str(s), f"{whole[s] / 1e3:.4g}", f"{half[s] / 1e3:.4g}", f"{100 * (half[s] / whole[s] - 1):+.2f}"]
            for s in whole
        ]
    return (
        "Half the speed of the platen",
        ["", "sample", "strength [kPa]", "at half the speed [kPa]", "change [%]"],
        rows,
    )


#: What is claimed of the strength: default against finest, one value against the next, and why.
PRECISION = {
    "compression": (
        0.02,
        0.05,
        "the sample fails along one of several paths, and anything that differs can lead to another one, whose strength is another by some per cent",
    ),
    "tension": (0.005, 0.01, "the first crack's load; a bond's yield force does not depend on the step"),
}
KINDS = {"compression": dict(pull=0, speed=SPEED, strain=0.002), "tension": dict(pull=1, speed=PULL, strain=0.001)}
