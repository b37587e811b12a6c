"""The slope experiment in both worlds: one course (:mod:`yade.nonsmooth.experiment`), one set of rules
(:mod:`yade.nonsmooth.measure.characteristic_times`).
"""

from __future__ import annotations

import dataclasses
from dataclasses import asdict

import numpy as np

from ... import records
from ...measure import centroid, characteristic_times
from ...measure.surface import deposit_profile
from ...model import scales, section
from ...running.kept_runs import Progress
from .cases import Case, CaseError
from .outcomes import Cost, Outcome, Quantity

__all__ = ["DEFAULT_STIFFNESSES", "QUANTITIES", "disks_of", "forces_of", "measure", "prepare", "run", "section_of"]

#: Young's moduli [Pa], to a rock's. Under the slope's stress of some MPa contacts overlap by about 10 % of the radius
#: at the softest.
DEFAULT_STIFFNESSES = (1e7, 1e8, 1e9, 1e10)
BONDS = True  # the kind of bonds matters
# Pa, for all seeds: the softest of these decades with which the dry slope stands; with 1e8 its elastic strain breaks
# most bonds
ENSEMBLE_STIFFNESS = 1e9

QUANTITIES = (
    Quantity("water_at_failure_m", "water table at failure (t1)", "m"),
    Quantity("front_travel_m", "travel of the front", "m"),
    Quantity("centroid_travel_m", "travel of the centre of mass", "m"),
    Quantity("fb_force_at_failure_N_per_m", "normal force on FB at failure", "N/m"),
    Quantity("dp_shear_at_failure_N_per_m", "shear force on DP at failure", "N/m"),
    Quantity("fb_force_final_N_per_m", "normal force on FB at the end", "N/m"),
    Quantity("dp_shear_final_N_per_m", "shear force on DP at the end", "N/m"),
    Quantity("bonds_broken_share", "bonds broken, of those made", "1"),
    Quantity("deposit_thickness_max_m", "greatest thickness of the deposit", "m"),
    Quantity("speed_mean_max_m_per_s", "largest mean speed", "m/s"),
)


NAME, TITLE = "slope", "Rain-triggered rock slope"
SOURCE, DISKS = "jiufengershan", 3000
KEYS = ("water_at_failure_m",)  # quantities that are parts of the error, besides curves and deposit
CURVES = {
    "front": "the front's way",
    "centroid": "the centre of mass's way",
    "deposit": "the deposit (1 − common area)",
}
OVERLAP = "Mean overlap of the contacts that touch or bear a force, at walls too, in mean diameters of the pair (the disk's at a wall)."
OVERLAP_WHEN = ("at rest, before the water rises", "while moving")
COST_WHEN = "while the mass moves"


def section_of(case: Case):
    """The section of a case: its disks, its seed, and for a hard run its numerics."""
    s = section.load(case.source).with_disks(case.disks)
    n, stages = s.numerics, s.stages
    if case.world == "hard":
        n = dataclasses.replace(
            n,
            time_step=n.time_step * case.step,
            path=n.path and n.path * case.step,
            tolerance=n.tolerance * case.tolerance,
            tolerance_moving=n.tolerance_moving * case.tolerance,
        )
    if case.options.get("end") is not None:
        stages = dataclasses.replace(stages, end=dataclasses.replace(stages.end, time=case.options["end"]))
    return dataclasses.replace(s, seed=case.seed, numerics=n, stages=stages)


def disks_of(case: Case):
    """Materials of the disks, and their smallest and largest diameter [m]. Raises SectionError for a section that
    cannot be used.
    """
    s = section_of(case)
    return [s.materials[layer.material] for layer in s.layers], (s.disks.d_min, s.disks.d_max)


def prepare(case: Case):
    """Makes the packing of a case, unless it is in the cache; one that is pressed is made in the running scene, which
    it empties.
    """
    from ..slope import slope_packing

    slope_packing.of(section_of(case))


def run(folder, **plain):
    """Runs a case in the (empty) scene, its records below ``folder``; returns its course.State and counts as a
    dictionary.
    """
    from yade import O

    from ...world import worlds
    from ..slope import experiment

    case = Case(**plain)
    s, note = section_of(case), Progress(folder)
    world = None
    if case.world == "soft":
        world = worlds.Soft(
            case.stiffness,
            (s.disks.d_min, s.disks.d_max),
            model=case.model,
            damping=case.damping,
            step_share=case.step,
            fragile=case.fragile,
            verlet=-s.numerics.verlet_distance,
        )
    course = experiment.begin(
        s,
        folder,
        progress=lambda stage, now, foreseen: note(now / foreseen),
        world=world,
        damping_moving=case.damping_moving,
    )
    course.run()
    return {
        "state": asdict(course.state),
        "disks": course.slope.count,
        "steps": O.iter - course.state.first_step,
        "simulated_s": O.time,
        "overlap_worst_ever": course.slope.solver.overlapWorstEver,
    }


def measure(case: Case, folder, found) -> Outcome:
    """What the records of a finished run say; ``found``: what :func:`run` returned. Runs are aligned by when the slope
    begins to move.
    """
    s, state = section_of(case), found["state"]
    if "simulated_s" not in found:  # as of versions whose steps were all as long
        raise CaseError(f"{folder}: its result.json has no simulated_s; remove the folder and go on with --resume")
    series, second = (
        characteristic_times.chosen_rows(records.read_series(folder / "series.csv"), state),
        scales.of(s).mean_seconds,
    )
    times = characteristic_times.of_run(series, s, state)
    t, last = series["time_s"], float(series["time_s"][-1])

    def at(name, when, span=second):
        return None if when is None else characteristic_times.mean_of(series, name, when, span)

    begin, end = (
        records.read_snapshot(folder / name) if (folder / name).exists() else None for name in ("t0.npz", "end.npz")
    )
    after = t >= (times["t0"] or 0.0) - 1e-9
    failed_dry = state.get("failed_dry")
    front0 = series["front_m"][0] if failed_dry is not None else state["front0"]
    start = state["moving"] if state["moving"] is not None else times["t0"]
    moved = np.hypot(*(way - way[after][0] for way in centroid.path(series)))
    broken = records.broken_bonds(series)
    values = {
        # a slope that does not stand dry bears none
        "water_at_failure_m": at("water_m", times["t1"], 0.0) if failed_dry is None else 0.0,
        "front_travel_m": None if front0 is None else s.side * float(series["front_m"][-1] - front0),
        "centroid_travel_m": float(moved[-1]),
        "fb_force_at_failure_N_per_m": at("fb_normal_N_per_m", times["t1"]),
        "dp_shear_at_failure_N_per_m": at("dp_shear_N_per_m", times["t1"]),
        "fb_force_final_N_per_m": at("fb_normal_N_per_m", last, 2 * second),
        "dp_shear_final_N_per_m": at("dp_shear_N_per_m", last, 2 * second),
        "bonds_broken_share": broken / state["bonds_initial"] if state["bonds_initial"] else None,
        "deposit_thickness_max_m": None,
        "speed_mean_max_m_per_s": float(series["speed_mean_m_per_s"].max()),
    }
    notes = []
    if end is not None:
        _, base, surface = deposit_profile(end, s)
        values["deposit_thickness_max_m"] = float(np.nanmax(surface - base))
    if failed_dry is not None:
        notes.append(f"the slope failed dry, at {failed_dry:.1f} s")
    elif state["moving"] is None:
        notes.append("the slope did not begin to move")
    elif times["t5"] is None:
        notes.append(f"stopped at {last:.0f} s, before the mass was at rest")
    moving = (
        (t >= start) & (series["speed_mean_m_per_s"] > 0.1 * series["speed_mean_m_per_s"].max())
        if start is not None
        else np.zeros(len(t), bool)
    )
    rest = (t > (times["t0"] or last) - second) & (t <= (times["t0"] or last) + 1e-9)
    curves = {
        "abscissa": t[after] - (start if start is not None else t[after][0]),
        "front": s.side * (series["front_m"][after] - (series["front_m"][after][0] if front0 is None else front0)),
        "centroid": moved[after],
    }
    simulated = found["simulated_s"]
    rate = state["wall_moving_s"] / state["moving_s"] if state["moving_s"] else state["wall_steps_s"] / simulated
    return Outcome(
        case,
        values,
        curves,
        series,
        *(None if n is None else (n.x, n.y, n.r) for n in (begin, end)),
        forces={} if begin is None else forces_of(begin),
        overlap=_mean(series, moving if moving.any() else after),
        overlap_rest=_mean(series, rest if rest.any() else after),
        cost=Cost(found["steps"], simulated / found["steps"], state["wall_steps_s"], simulated, rate),
        notes=notes,
    )


def forces_of(snapshot):
    """Contacts of a snapshot under compression: {(disk, disk or −1 − wall): normal force [N/m]}."""
    pressed = snapshot.cn > 0
    ends = np.sort(np.column_stack((snapshot.ci[pressed], snapshot.cj[pressed])), axis=1).tolist()
    return dict(zip(map(tuple, ends), snapshot.cn[pressed].tolist()))


def _mean(series, chosen):
    return float(series["overlap_mean_rel"][chosen].mean())
