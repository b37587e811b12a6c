"""Wall time for a second of simulation at the paper's scale, soft over hard, on several threads.

Both worlds hold the same disks at the same places: those of the benchmark's states
(:mod:`yade.nonsmooth.studies.slope.states`), the slope at rest under its weight, and on the move (backstop and plane
without strength, water table at 20 m, mean speed 5 m/s). The hard steps are timed from there. For soft contacts the
scene is built anew from these places and velocities, with the bonds that held; it runs :data:`RELAX_SECONDS`, in which
springs take up the weight, and is then timed. The soft step is a share of its stability limit.

Overlap has one definition: mean over contacts that touch or bear a force of the overlap over the mean diameter. Soft
overlaps fall as 1/E, so the stiffness of equal overlap is read from straight lines between logarithms, beyond the
stiffest along the last one; the cost grows as √E with the number of steps, see precision.soft_rate. Most rigid contacts
do not overlap at all, which a mean rewards; so the factor at equal largest overlap is given as well.
"""

from __future__ import annotations

import dataclasses
import time
from types import MappingProxyType

import numpy as np

from ...running.kept_runs import Progress, keep, kept
from ...system import keys, machine
from ..slope.measuring import MeasuringCourse
from . import losses, precision, slopes
from .cases import Case, CaseError, check_soft, moduli_of
from .summary import ROCK_STIFFNESS, clean

__all__ = ["DISKS", "STATES", "STIFFNESSES", "measure_hard", "measure_soft", "run", "summarise"]

SOURCE, DISKS = "jiufengershan", 20000  # the paper's slope
STATES = ("moving", "rest")
STIFFNESSES = (1e7, 1e8, 1e9, 1e10)  # Pa
RELAX_SECONDS = 1.0  # of simulation, soft
NOTED = 20  # steps between two notes of how far they are
WARM_UP, LOOKS = 10, 5  # steps before those that are timed; blocks of these, after each of which the overlap is taken


def measure_hard(folder, source, disks, state, steps):
    """Times hard steps from a saved state; returns mean overlap and wall time for a second of simulation."""
    from ...world import scene
    from ...world.stepping import advance
    from ..slope import states

    states.load(source, disks, state)
    advance(WARM_UP)
    solver = scene.contact_dynamics()
    sweeps = solver.totalIterations
    walls, overlaps, made, simulated = _timed(steps, solver)
    return _found(simulated / made, made, walls, overlaps, solver.contacts, solver.meanSpeed) | {
        "tolerance": solver.tolerance,
        "sweeps_mean": (solver.totalIterations - sweeps) / made,
    }


def measure_soft(
    folder, source, disks, state, stiffness, steps, damping, step_share, relax=RELAX_SECONDS, model="cohesion_moment"
):
    """The same on soft contacts with this Young's modulus [Pa]; ``damping``: of the integrator, ``step_share``: of the
    stability limit.
    """
    from yade import O

    from ...packing import files as packing_files
    from ...world import scene, tables, worlds
    from ...world.stepping import advance
    from ..slope import slope, states

    chosen = states.section_of(source, disks)
    states.load(source, disks, state)
    solver = scene.contact_dynamics()
    t, c, time_s = tables.bodies(solver), tables.contacts(solver), O.time
    height = next(e for e in O.engines if e.label == "porePressure").heightAt(O.time) if state == "moving" else 0.0
    first = int(t["id"][0])
    held = {(int(a) - first, int(b) - first) for a, b in zip(c["id1"][c["bonded"]], c["id2"][c["bonded"]])}
    layers = np.array([_layer(O.bodies[int(k)].material.label) for k in t["id"]])
    if state == "moving":
        chosen = _without_strength(chosen, states.WEAKENED)
    packed = packing_files.Packing(t["x"], t["y"], t["r"], layers)
    world = worlds.Soft(
        stiffness,
        (chosen.disks.d_min, chosen.disks.d_max),
        model=model,
        damping=damping,
        step_share=step_share,
        verlet=-chosen.numerics.verlet_distance,
    )
    built = slope.build(chosen, packed, world)
    order = slope.order_of(chosen, packed)
    for k, old in enumerate(order):
        body = O.bodies[built.first_disk + k].state
        body.vel, body.angVel = (t["vx"][old], t["vy"][old], 0), (0, 0, t["omega"][old])
    if chosen.water is not None:
        built.water.times, built.water.heights = [0.0], [height]
    bonds = _bond(built, order, held)
    relax_steps = max(1, round(relax / O.dt))
    note = Progress(folder)
    for k in range(0, relax_steps, NOTED):
        advance(min(NOTED, relax_steps - k))
        note(0.9 * k / relax_steps)
    walls, overlaps, made, simulated = _timed(steps, built.solver)
    return _found(simulated / made, made, walls, overlaps, built.solver.contacts, built.solver.meanSpeed) | {
        "bonds_made": bonds,
        "bonds_before": len(held),
        "state_time_s": time_s,
    }


def _timed(steps, solver):
    """Makes ``steps`` steps in LOOKS blocks; returns the mean wall time a step [s] of each block, the mean and the
    largest overlap after each, the number of steps, and the time that they simulated [s]."""
    from yade import O

    from ...world.stepping import advance

    part, walls, overlaps, first, begun = max(1, steps // LOOKS), [], [], O.iter, O.time
    for _ in range(LOOKS):
        began = time.perf_counter()
        advance(part)
        walls.append((time.perf_counter() - began) / part)
        overlaps.append((solver.overlapMean, solver.overlapWorst))
    return walls, overlaps, O.iter - first, O.time - begun


def _found(dt, steps, walls, overlaps, contacts, speed):
    # the median of the blocks, so that what else the machine did for a moment does not count
    wall = float(np.median(walls))
    return {
        "time_step_s": dt,
        "steps": steps,
        "wall_s_per_step": wall,
        "wall_s_per_step_blocks": walls,
        "rate": wall / dt,
        "overlap_mean_rel": float(np.mean([mean for mean, _ in overlaps])),
        "overlap_worst_rel": float(np.max([worst for _, worst in overlaps])),
        "contacts": contacts,
        "mean_speed_m_per_s": speed,
    }


def _layer(label):
    return int(label.rsplit("-", 1)[1])


def _without_strength(chosen, walls):
    """The section with walls that bear neither shear nor tension, as benchmark.states leaves them on the move. Their
    critical slip stays: the release of the water may be told by it."""
    made = dict(chosen.materials)
    changed = []
    for wall in chosen.walls:
        if wall.name in walls:
            name = f"{wall.material} without strength"
            made[name] = dataclasses.replace(
                chosen.materials[wall.material],
                name=name,
                friction=0.0,
                residual_friction=0.0,
                tensile_strength=0.0,
                residual_tensile_strength=0.0,
                bonded=False,
            )
            wall = dataclasses.replace(wall, material=name)
        changed.append(wall)
    return dataclasses.replace(chosen, walls=tuple(changed), materials=MappingProxyType(made))


def _bond(built, order, held):
    """Bonds the layers' close neighbours, and takes bonds away where there was none before; returns how many hold."""
    from yade import O
    from yade.wrapper import CohFrictPhys, InteractionLoop, Ip2_CohFrictMat_CohFrictMat_CohFrictPhys

    from ...world.soft.bonds import bonded

    built.solver.bond()
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    functors = [f for f in loop.physDispatcher.functors if isinstance(f, Ip2_CohFrictMat_CohFrictMat_CohFrictPhys)]
    number = 0
    for i in O.interactions:
        if not i.isReal or not bonded(i.phys):
            continue
        pair = tuple(int(order[k - built.first_disk]) if k >= built.first_disk else -1 for k in (i.id1, i.id2))
        if pair in held or pair[::-1] in held or -1 in pair:
            number += 1
        elif isinstance(i.phys, CohFrictPhys):
            functors[0].setCohesion(i, False, False)
        else:
            i.phys.isCohesive = False
    return number


def run(
    out,
    source,
    disks,
    threads,
    stiffnesses=STIFFNESSES,
    steps=300,
    damping=0.2,
    damping_moving=0.02,
    step_share=0.8,
    resume=False,
    progress=lambda share, doing: None,
    model="cohesion_moment",
):
    """Makes the states that are missing and measures both worlds, one process after the other on ``threads``; returns
    :func:`summarise` of it.

    ``stiffnesses``: Young's moduli [Pa]; ``steps``: that are timed, :data:`LOOKS` or more. Raises CaseError
    before anything runs for numbers that cannot be used, and benchmark.states.BenchmarkError where a measurement fails.
    """
    from ..slope import states

    stiffnesses = moduli_of(stiffnesses)
    check_soft(damping, damping_moving, step_share)
    for key, value, least in (("--disks", disks, 1), ("--threads", threads, 1), ("--steps", steps, LOOKS)):
        if value < least:
            raise CaseError(f"{key} {value}: give {least} or more")
    bonds, lost = losses.of_case(
        slopes, Case("soft", source, disks, 1, step_share, stiffness=stiffnesses[0], damping=damping, model=model)
    )
    subject = {"source": source, "disks": disks}
    made = not states.exist(source, disks)
    per_thousand = disks / 1000
    hard_s = 2 + 0.015 * steps * per_thousand
    soft_s = {
        e: 5 + 0.2 * per_thousand + (0.0012 * per_thousand) * (steps + RELAX_SECONDS * (e / 1e10) ** 0.5 * 5500)
        for e in stiffnesses
    }
    measuring = MeasuringCourse(
        out, (10 * per_thousand if made else 0) + len(STATES) * (hard_s + sum(soft_s.values())), progress
    )
    if made:
        measuring.call("states", 10 * per_thousand, states.make, subject, threads)
    found = {"hard": {}, "soft": {}}

    def once(name, seconds, function, arguments):
        key = keys.key_of(
            {
                "name": name,
                "threads": threads,
                "state": states.folder_of(states.section_of(source, disks)).name,
                **arguments,
            }
        )
        folder = measuring.home / name
        known = kept(folder, key, function) if resume else None
        if known is None:
            known = measuring.call(name, seconds, function, arguments, threads)
            keep(folder, key, known, function)
        return known

    for state in STATES:
        found["hard"][state] = once(f"hard-{state}", hard_s, measure_hard, {**subject, "state": state, "steps": steps})
        found["soft"][state] = [
            {
                "stiffness_Pa": e,
                **once(
                    f"soft-{e:g}-{state}".replace("+", ""),
                    soft_s[e],
                    measure_soft,
                    {
                        **subject,
                        "state": state,
                        "stiffness": e,
                        "steps": steps,
                        "damping": damping_moving if state == "moving" else damping,
                        "step_share": step_share,
                        "model": model,
                    },
                ),
            }
            for e in stiffnesses
        ]
    return summarise(found) | clean(
        {
            "scenario": "slope",
            "disks": disks,
            "threads": threads,
            "source": source,
            "damping": damping,
            "damping_moving": damping_moving,
            "step_share": step_share,
            "model": model,
            "bonds": bonds,
            "model_lacks": lost,
            "steps_timed": steps,
            "relax_s": RELAX_SECONDS,
            "machine": machine.describe(),
        }
    )


def summarise(found):
    """Factors of ``found``, {"hard": {state: numbers}, "soft": {state: [numbers by stiffness]}}; the headline ones are
    those of the moving slope.
    """
    states = {}
    for state, hard in found["hard"].items():
        soft = found["soft"][state]
        moduli, overlaps, rates, steps, walls = (
            [s[name] for s in soft]
            for name in ("stiffness_Pa", "overlap_mean_rel", "rate", "time_step_s", "wall_s_per_step")
        )
        modulus, _ = precision.loglog(hard["overlap_mean_rel"], overlaps, moduli)
        rate, beyond = precision.soft_rate(modulus, moduli, steps, walls)
        rock, rock_beyond = precision.soft_rate(ROCK_STIFFNESS, moduli, steps, walls)
        worst = precision.loglog(hard["overlap_worst_rel"], [s["overlap_worst_rel"] for s in soft], moduli)
        at_worst = precision.soft_rate(worst[0], moduli, steps, walls)
        fits = [precision.power_law(moduli, values) for values in (overlaps, rates)]
        states[state] = {
            "equal_worst_overlap": at_worst[0] / hard["rate"],
            "equal_worst_overlap_stiffness_Pa": worst[0],
            "equal_worst_overlap_extrapolated": at_worst[1],
            "equal_overlap": rate / hard["rate"],
            "equal_overlap_stiffness_Pa": modulus,
            "equal_overlap_extrapolated": beyond,
            "rock_stiffness": rock / hard["rate"],
            "rock_stiffness_extrapolated": rock_beyond,
            "overlap_power": fits[0].power if fits[0] else None,
            "rate_power": fits[1].power if fits[1] else None,
            "hard": hard,
            "soft": soft,
        }
    head = states["moving"]
    return clean(
        {
            "soft_over_hard_wall_equal_overlap": head["equal_overlap"],
            "soft_over_hard_wall_rock_stiffness": head["rock_stiffness"],
            "stiffness_equal_overlap_Pa": head["equal_overlap_stiffness_Pa"],
            "equal_overlap_extrapolated": head["equal_overlap_extrapolated"],
            "rock_stiffness_extrapolated": head["rock_stiffness_extrapolated"],
            "overlap_hard_rel": head["hard"]["overlap_mean_rel"],
            "states": states,
        }
    )
