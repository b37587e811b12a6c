"""What a finished (or interrupted) run says: its summary. Needs its records alone, no YADE. Characteristic times:
:mod:`.characteristic_times`.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ... import records
from ...measure import centroid, energy, force_stages, layers, toe, toe_bands, travel
from ...measure.characteristic_times import (
    FASTER,
    NAMES as TIMES,
    RESTING,
    by_threshold,
    chosen_rows,
    mean_of,
    missing,
    of_run,
    weakening_begins,
)
from ...measure.fronts import front
from ...measure.ground import ground_of
from ...measure.surface import deposit_profile, on_ground
from ...model import scales
from ...system.whole_files import write_json
from . import frames, verdict
from .columns import PERMANENT
from .run_files import BEGIN, END, SERIES, SUMMARY, WALLS

__all__ = ["summarise", "moved_before_water", "numbers_of", "while_it_fails"]

ENTRAINED = 2.0  # mean diameters


def moved_before_water(summary):
    """When a run's slope moved before t0 [s], as course.State has it as ``failed_dry``; None for one that did not.
    ``summary``: that of :func:`summarise`, or of a version before.
    """
    before = summary["failed_dry_s"] if summary["failed_dry_s"] is not None else summary.get("moved_dry_s")
    return before if summary["times_s"]["t0"] is None else None


#: Names of the numbers that every summary has, beside those of its dictionaries.
NUMBERS = (
    "finished disks contacts_initial bonds_initial packing_fraction time_step_s path_rel steps simulated_s wall_s wall_packing_s threads iterations_mean tolerance "
    "tolerance_moving residual_p95 residual_N_per_m_p95 residual_p95_over_tolerance way_worst_rel overlap_worst_rel overlap_mean_rel failed_dry_s moved_dry_s water_at_failure_m "
    "water_highest_m fb_force_dry_N_per_m fb_force_at_failure_N_per_m fb_force_final_N_per_m dp_shear_dry_N_per_m dp_shear_at_failure_N_per_m dp_shear_final_N_per_m "
    "bonds_broken_at_failure_rel fb_force_highest_N_per_m "
    "weakening_begins_s triggering_s weakening_s motion_s front_travel_m centroid_travel_m speed_max_m_per_s speed_mean_max_m_per_s deposit_thickness_max_m "
    "deposit_thickness_ground_m mixing overturned_m bulking_factor "
    "energy_dissipated_J_per_m energy_correction_rel energy_error_rel"
).split()
#: Numbers of the motion in the summary of a section that shakes.
SHAKING = (
    "begin_s duration_s peak_acceleration_m_per_s2 peak_velocity_m_per_s arias_intensity_m_per_s drift_velocity_m_per_s "
    "drift_displacement_m"
).split()
PASSIVE = (
    "water_passive_m water_at_failure_over_passive passive_resistance_dry_N_per_m passive_force_N_per_m "
    "fb_force_at_failure_over_passive"
).split()
BED = ("entrained_kg_per_m", "bed_kg_per_m", "deposited_kg_per_m", "mass_kg_per_m")
EROSION = ("eroded_disks", "eroded_kg_per_m", "eroded_at_failure_kg_per_m", "energy_eroded_J_per_m")
#: Between which times bands of the toe are looked for: until the slip surface is weak, and as the paper's Figure 13 has
#: it, until the slope accelerates.
TOE_BANDS = {"toe_bands": ("t1", "t3"), "toe_bands_triggering": ("t0", "t2")}
BAND = ("inclination_deg", "width_d", "rotation_rad", "contrast")


def numbers_of(section) -> list[str]:
    """Names of all numbers that the summary of a Section's run may have, those of its dictionaries as ``times_s.t1``:
    known before anything runs.
    """
    found = [
        *NUMBERS,
        *travel.NAMES,
        *(f"times_s.{name}" for name in TIMES),
        *(f"force_stages.{name}" for name in force_stages.NAMES),
    ]
    found += [f"t2_by_speed_s.{percent}" for percent in FASTER] + [f"t5_by_speed_s.{percent}" for percent in RESTING]
    found += [f"energy_losses_J_per_m.{name.split('_')[1]}" for name in records.LOSSES]
    found += [f"sliding_on_walls_J_per_m.{wall.name}" for wall in section.walls]
    found += [f"heat_on_walls_J_per_m.{wall.name}" for wall in section.with_slip_law]
    if section.of_role("backstop"):
        for bands in TOE_BANDS:
            found += [f"{bands}.{one}.{name}" for one in ("towards_foot", "conjugate") for name in BAND]
            found += [f"{bands}.both_conjugate"] + [f"{bands}.rankine_deg"] * bool(section.envelope)
    if section.shaking is not None:
        found += [f"shaking.{name}" for name in SHAKING]
        found += [f"displacements_m.{name}" for name, _ in section.slip_surfaces]
    found += BED if any(layer.role == "bed" for layer in section.layers) else ()
    found += EROSION if section.erosion else ()
    return found + list(PASSIVE if _has_passive(section) else ())


def _has_passive(section):
    known = section.envelope is not None and section.water is not None and section.water.wall is not None
    return known and bool(section.of_role("backstop"))


def _difference(a, b):
    return None if a is None or b is None else a - b


def _passive(section, packing_fraction, water, force):
    """What the toe's passive strength says about the failure, see toe.py; nothing where the rock's envelope or the
    water's wall is not given, or no backstop.

    ``water`` [m], ``force`` [N/m]: height of the table and normal force on the backstop at failure, None where there
    was none.
    """
    envelope = section.envelope
    if not _has_passive(section):
        return {}
    found = toe.passive(
        section, envelope.cohesion, envelope.friction_deg, packing_fraction or section.disks.packing_fraction
    )
    values = (
        found.water_m,
        water / found.water_m if water is not None and found.water_m else None,
        found.resistance_dry,
        found.push_N_per_m,
        force / found.push_N_per_m if force is not None and found.push_N_per_m else None,
    )
    return dict(zip(PASSIVE, values, strict=True))


def _force_stages(series, section, times, second, leans):
    """The numbers of :mod:`.measure.force_stages`."""
    frictions = {section.materials[surface.material].friction for surface in section.lowest_surfaces}
    friction = frictions.pop() if len(frictions) == 1 else None
    found = force_stages.statements(
        series, times, friction, lambda name, end: mean_of(series, name, end, second), backstop=leans
    )
    return {k: v if v is not None and math.isfinite(v) else None for k, v in found.items()}


def while_it_fails(folder, every, times, first="t1", last="t3"):
    """Snapshots of two characteristic times between which the toe shears; None where the run has not both. ``every``:
    all rows of its series; ``times``: its characteristic times.
    """
    paths = {time: path for time, path in frames.of_run(folder, every)}
    if times["t0"] is not None and (begin := Path(folder) / BEGIN).exists():
        paths[times["t0"]] = begin
    found = [paths.get(times[name]) for name in (first, last)]
    return None if None in found else records.in_both(*map(records.read_snapshot, found))


def _toe_bands(folder, every, section, times, first, last):
    """Bands in the toe between two times (:mod:`.measure.toe_bands`) and Rankine's inclination; None where there is no
    backstop, or the run has not come so far.
    """
    seen = while_it_fails(folder, every, times, first, last) if section.of_role("backstop") else None
    if seen is None:
        return None
    envelope = section.envelope

    def plain(band):
        return band and {
            "inclination_deg": band.inclination_deg,
            "width_d": band.width,
            "rotation_rad": band.rotation,
            "contrast": band.contrast if math.isfinite(band.contrast) else None,
        }

    found = toe_bands.find(*seen, section)
    towards_foot, conjugate = map(plain, found)
    return {
        "towards_foot": towards_foot,
        "conjugate": conjugate,
        "both_conjugate": toe_bands.conjugate(*found) if toe_bands.tells(seen[0], section) else None,
        "rankine_deg": envelope and toe_bands.rankine(envelope.friction_deg),
    }


def _front_travel(section, series, front0, start, end):
    """How far the front went from its place ``front0`` [m] at the beginning, None where that is not known; where disks
    have been taken out, that of the disks that are left at the end.
    """
    if section.erosion and series["eroded_disks"][-1]:
        if start is None or end is None:
            return None
        first, last = (front(one, section.side, layers=ground_of(section).mass) for one in records.in_both(start, end))
        return section.side * (last - first)
    return section.side * float(series["front_m"][-1] - front0) if front0 is not None else None


def _of_erosion(section, every, failure):
    """The numbers of :data:`EROSION`; nothing for a section without windows. ``every``: all rows; ``failure``: when the
    slope moved off [s], None where it did not.
    """
    if not section.erosion:
        return {}
    last = {name: every[name][-1] for name in ("eroded_disks", "eroded_kg_per_m", "energy_eroded_J")}
    at = None if failure is None else float(every["eroded_kg_per_m"][np.argmin(np.abs(every["time_s"] - failure))])
    values = (int(last["eroded_disks"]), float(last["eroded_kg_per_m"]), at, float(last["energy_eroded_J"]))
    return dict(zip(EROSION, values, strict=True))


def _of_layers(section, start, end):
    """What became of the mass between two Snapshots, None for those that there are not: travel, mixing, and how far its
    layers are turned over. Disks that were taken out count at neither time.
    """
    if start is None or end is None:
        return dict.fromkeys((*travel.NAMES, "mixing", "overturned_m"))
    start, end = records.in_both(start, end)
    ground = ground_of(section)
    density = [section.materials[layer.material].density for layer in section.layers]
    return {
        **travel.travel(start, end, density, section.side, ground.mass),
        "mixing": layers.mixing(start, end, ground.mass),
        "overturned_m": layers.overturned_length(end, ground.mass),
    }


def _broken_by(series, time, bonds):
    """Bonds broken up to a time [s] by all that were made; None where there were none, or no such time."""
    if time is None or not bonds:
        return None
    row = int(np.searchsorted(series["time_s"], time + 1e-9)) - 1
    return records.broken_bonds(series, row) / bonds


def _highest_push(series, times, at):
    """The largest force on the backstops until t2, as a mean over a second [N/m]; None before that, or without one."""
    if None in (times["t0"], times["t2"]):
        return None
    t = series["time_s"]
    found = [at("fb_normal_N_per_m", when) for when in t[(t >= times["t0"]) & (t <= times["t2"])]]
    return None if None in found or not found else max(found)


def _last_of_walls(path, column):
    """{name: the last value of a column of ``walls.csv``}; empty where no wall has one."""
    if not path.exists():
        return {}
    walls = records.read_walls(path)
    last = dict(zip(walls["wall"].tolist(), walls[column].tolist()))  # the last row of each
    return {name: value for name, value in last.items() if math.isfinite(value)}


def _of_bed(section, start, end):
    """Masses [kg/m] that were entrained from a bed and that came to lie beyond the foot; nothing for a section without
    a bed, None before the end.

    Entrained is a disk of a bed that has gone farther than ENTRAINED mean diameters of it since t0; deposited is one of
    the mass whose centre is beyond the foot.
    """
    beds = [k for k, layer in enumerate(section.layers) if layer.role == "bed"]
    if not beds:
        return {}
    if start is None or end is None:
        return dict.fromkeys(BED)
    start, end = records.in_both(start, end)
    density = np.array([section.materials[layer.material].density for layer in section.layers])
    size = np.array([math.sqrt(section.disks_of(layer).mean_square) for layer in section.layers])
    weight, ground = density[end.layer] * math.pi * end.r**2, ground_of(section)
    bed, mass = np.isin(end.layer, beds), np.isin(end.layer, ground.mass)
    moved = np.hypot(end.x - start.x, end.y - start.y) > ENTRAINED * size[end.layer]
    beyond = section.side * (end.x - ground.foot[0]) > 0
    return dict(
        zip(BED, (float(weight[chosen].sum()) for chosen in (bed & moved, bed, mass & beyond, mass)), strict=True)
    )


def _of_shaking(section, series):
    """Of a section that shakes: numbers of the motion, and the displacement along each slip surface [m] so far."""
    if section.shaking is None:
        return {}
    motion = section.shaking.motion
    return {
        "shaking": {"record": f"{motion.name} ({motion.source})"}
        | dict(
            zip(
                SHAKING,
                (
                    section.shaking.begin,
                    motion.duration,
                    motion.peak_acceleration(),
                    motion.peak_velocity(),
                    motion.arias_intensity(),
                    motion.drift.velocity[0],
                    motion.drift.displacement[0],
                ),
                strict=True,
            )
        ),
        "displacements_m": {
            name: float(series[records.column(PERMANENT.name, name)][-1]) for name, _ in section.slip_surfaces
        },
    }


def summarise(folder, section, state, threads=None) -> dict:
    """Reads the records in ``folder``, writes and returns ``summary.json``. Values that the run has not reached are
    null.
    """
    folder = Path(folder)
    every, failed_dry = records.read_series(folder / SERIES), state.get("failed_dry")
    if not len(every["step"]):
        raise records.RecordsError(f"{folder / 'series.csv'}: has no rows yet; let the run go on with --resume")
    series, balanced = chosen_rows(every, state), records.since_settled(every)  # energies begin anew then
    times, begins = of_run(series, section, state), weakening_begins(series, section, state)
    last, second = float(series["time_s"][-1]), scales.of(section).mean_seconds
    leans = bool(section.of_role("backstop"))  # or its force has no meaning

    def at(name, end, span=second):
        return None if end is None or not (leans or name != "fb_normal_N_per_m") else mean_of(series, name, end, span)

    t0, t1 = times["t0"], times["t1"]
    finished = state["stage"] == "done"
    begin = t0 if t0 is not None else last if failed_dry is None else 0.0
    front0 = state["front0"] if failed_dry is None else series["front_m"][0]
    after = series["time_s"] >= begin - 1e-9
    start = records.read_snapshot(folder / BEGIN) if (folder / BEGIN).exists() else None
    end = records.read_snapshot(folder / END) if (folder / END).exists() else None
    moved = None
    thickness = on_the_ground = bulking = None
    if start is not None and end is not None:
        areas = []
        for snapshot in (start, end):
            x, base, surface = deposit_profile(snapshot, section)
            height = surface - base
            areas.append(float(np.nansum(height)) * float(x[1] - x[0]))
        thickness = float(np.nanmax(height))
        spread = height[on_ground(x, section) & ~np.isnan(height)]
        on_the_ground = float(spread.max()) if len(spread) else 0.0
        # neither where it had loosened before, nor where a part is gone
        bulking = areas[1] / areas[0] if failed_dry is None and end.number is None else None
        moved = math.hypot(*(way[-1] - way[after][0] for way in centroid.path(series)))
    counted = all(name in every for name in records.LOSSES)  # soft contacts sum up no energies, and have no solver
    turned = energy.turned_over(balanced) if counted else 0.0
    found = verdict.of(every, section, state, times, None if start is None else len(start.x))
    summary = {
        "section": section.name,
        "verdict": found.kind,
        "verdict_says": found.says,
        "finished": finished,
        "disks": int(len(start.x)) if start is not None else None,
        "contacts_initial": state["contacts_initial"],
        "bonds_initial": state["bonds_initial"],
        "packing_fraction": state["packing_fraction"],
        "time_step_s": section.numerics.time_step,
        "path_rel": section.numerics.path,
        "steps": int(series["step"][-1] - state["first_step"]),
        "simulated_s": last - (state["settled"] or 0.0),
        "wall_s": state["wall_s"],
        "wall_packing_s": state["wall_packing_s"],
        "threads": threads,
        "iterations_mean": float(np.mean(series["iterations"])) if counted else None,
        "tolerance": section.numerics.tolerance,
        "tolerance_moving": section.numerics.tolerance_moving,
        "residual_p95": float(np.percentile(series["residual"], 95)) if counted else None,
        "residual_N_per_m_p95": float(np.percentile(series["residual_N_per_m"], 95)) if counted else None,
        "residual_p95_over_tolerance": float(np.percentile(series["residual"] / series["tolerance"], 95))
        if counted
        else None,
        "overlap_worst_rel": float(np.max(series["overlap_worst_rel"])),
        "overlap_mean_rel": float(np.max(series["overlap_mean_rel"])),
        "failed_dry_s": found.before if found.kind == verdict.DRY else None,
        "moved_dry_s": found.before if found.kind == verdict.MOVED else None,
        "times_s": times,
        "times_missing": missing(series, section, state),
        "water_at_failure_m": at("water_m", t1, 0.0) if found.before is None else None,
        "water_highest_m": float(np.max(series["water_m"])) if t0 is not None else None,
        "fb_force_dry_N_per_m": at("fb_normal_N_per_m", t0),
        "fb_force_at_failure_N_per_m": at("fb_normal_N_per_m", t1),
        "fb_force_final_N_per_m": at("fb_normal_N_per_m", last, 2 * second) if finished else None,
        "fb_force_highest_N_per_m": _highest_push(series, times, at),
        "bonds_broken_at_failure_rel": _broken_by(series, t1, state["bonds_initial"]),
        "dp_shear_dry_N_per_m": at("dp_shear_N_per_m", t0),
        "dp_shear_at_failure_N_per_m": at("dp_shear_N_per_m", t1),
        "dp_shear_final_N_per_m": at("dp_shear_N_per_m", last, 2 * second) if finished else None,
        "weakening_begins_s": begins,
        "triggering_s": _difference(times["t3"], times["t2"]),
        "weakening_s": _difference(times["t3"], begins),
        "motion_s": _difference(times["t5"], times["t3"]),
        "front_travel_m": _front_travel(section, series, front0, start, end),
        "centroid_travel_m": moved,
        "speed_max_m_per_s": float(np.max(series["speed_max_m_per_s"])),
        "speed_mean_max_m_per_s": float(np.max(series["speed_mean_m_per_s"])),
        "deposit_thickness_max_m": thickness,
        "deposit_thickness_ground_m": on_the_ground,
        "bulking_factor": bulking,
        "energy_dissipated_J_per_m": energy.dissipated(series) if counted else None,
        "energy_losses_J_per_m": {name.split("_")[1]: float(series[name][-1]) for name in records.LOSSES}
        if counted
        else None,
        "sliding_on_walls_J_per_m": _last_of_walls(folder / WALLS, "energy_sliding_J"),
        "heat_on_walls_J_per_m": _last_of_walls(folder / WALLS, "heat_J"),
        "energy_correction_rel": None
        if not counted
        else float(series["energy_correction_J"][-1]) / turned
        if turned > 0
        else 0.0,
        "energy_error_rel": float(np.max(np.abs(energy.balance_error(balanced)))) if counted else None,
    }
    summary["way_worst_rel"] = state.get("way_worst_ever")  # of a disk in a step, in its radii; soft disks have none
    summary["overlap_worst_rel"] = max(summary["overlap_worst_rel"], state.get("overlap_worst_ever", 0.0))
    summary |= _of_layers(section, start, end) | by_threshold(series, section, times)
    summary["force_stages"] = _force_stages(series, section, times, second, leans)
    for name, between in TOE_BANDS.items():
        summary[name] = _toe_bands(folder, every, section, times, *between)
    summary |= _of_bed(section, start, end) | _of_shaking(section, every)
    summary |= _of_erosion(section, every, state["moving"])
    summary |= _passive(
        section, state["packing_fraction"], summary["water_at_failure_m"], summary["fb_force_at_failure_N_per_m"]
    )
    clean = {k: (None if isinstance(v, float) and not math.isfinite(v) else v) for k, v in summary.items()}
    write_json(folder / SUMMARY, clean)
    return clean
