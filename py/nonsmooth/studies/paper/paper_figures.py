"""The figures of the shipped slope and its control runs, drawn from the records of their runs. Needs no YADE."""

from __future__ import annotations

from pathlib import Path

from ... import figures
from ...measure import toe
from ...model import scales
from ..slope.results import while_it_fails
from .paper_slopes import SHIPPED, VARIANTS

__all__ = ["CONTROLS", "draw"]

#: Variants that stand beside the shipped slope in the first figure, as far as they have run.
CONTROLS = ("no-weakening", "no-release")
#: Those whose release stands beside that of the shipped slope in another, and when they are drawn [s] after t2.
RELEASES, RELEASED = ("dilatancy", "slip-or-dilatancy"), 10.0


def draw(found, out) -> list:
    """Draws what the runs ``found`` (:func:`.campaign.paper_slopes.run`) show into the folder ``out``; returns the
    pictures' paths. Without the shipped slope there is none.
    """
    runs, out = found.get(SHIPPED, []), Path(out)
    if not runs:
        return []
    made = [figures.with_and_without(_beside(found), out / "paper_controls.png")]
    released = _releases(found)
    if len(released) > 1:
        made.append(figures.releases(released, out / "paper_release.png"))
    first = runs[0]
    moved = [run for run in runs if run.summary["times_s"]["t2"] is not None]
    if moved:
        dp = first.section.lowest_surfaces[0]
        friction = first.section.materials[dp.material].friction
        cases = [(run.series, run.summary["times_s"], friction) for run in moved]
        made.append(figures.forces_against_water(cases, out / "paper_forces.png", toe=_toe(first), walls=first.section))

    def turned(run):
        return while_it_fails(run.folder, run.series, run.summary["times_s"], "t0", "t2")

    seen = [(run, pair) for run in moved if (pair := turned(run)) is not None]
    if seen:
        cases = [(f"packing {run.section.seed}", *pair, run.section) for run, pair in seen]
        envelope = first.section.envelope
        made.append(figures.toes(cases, out / "paper_toes.png", friction_deg=envelope and envelope.friction_deg))
    times = first.summary["times_s"]
    if times["t0"] is not None and times["t4"] is not None:
        last = ("the end", first.snapshot("end")) if times["t5"] is None else ("t5", first.snapshot(times["t5"]))
        cases = [("t0", first.snapshot("t0")), ("t4", first.snapshot(times["t4"])), last]
        made.append(figures.markers(cases, first.section, out / "paper_markers.png"))
    if any(run.summary["times_s"]["t3"] is not None for run in runs):
        cases = [(run.series, run.summary) for run in runs]
        speed = scales.of(first.section).moving_speed
        made.append(figures.speeds(cases, out / "paper_speeds.png", moving=speed))
    return made


def _beside(found):
    """Cases of figures.with_and_without: the shipped slope and its controls."""
    cases = []
    for name in (SHIPPED, *CONTROLS):
        runs = [run for run in found.get(name, ()) if run.summary["times_s"]["t0"] is not None]
        if runs:
            lines = [(run.series, run.summary["times_s"]["t0"]) for run in runs]
            cases.append(
                (VARIANTS[name].label, lines, runs[0].snapshot("t0"), runs[0].snapshot("end"), runs[0].section)
            )
    return cases


def _releases(found):
    """Cases of figures.releases, of those whose first packing has accelerated."""
    cases = []
    for name in (SHIPPED, *RELEASES):
        runs = found.get(name, ())
        if runs and runs[0].summary["times_s"]["t2"] is not None:
            lines = [(run.series, run.summary["times_s"]) for run in runs]
            shot = runs[0].snapshot(runs[0].summary["times_s"]["t2"] + RELEASED)
            cases.append((VARIANTS[name].label, lines, shot, runs[0].section))
    return cases


def _toe(run):
    """The toe's strength by the rock's envelope; None where the section has none."""
    envelope = run.section.envelope
    if envelope is None:
        return None
    packed = run.summary["packing_fraction"] or run.section.disks.packing_fraction
    return toe.passive(run.section, envelope.cohesion, envelope.friction_deg, packed)
