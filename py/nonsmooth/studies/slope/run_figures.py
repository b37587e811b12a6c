"""The figures of a run, drawn from its records: one by its name, or all with the video and the files for ParaView.
Needs no YADE.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from pathlib import Path

import numpy as np

from ... import figures, records
from ...figures import paraview, video
from ...measure import newmark
from ...measure.characteristic_times import chosen_rows
from ...model import roles, scales
from ...system import checks
from ...water import field_files, of_section, phreatic, section_seepage
from . import frames, results, run_files, verdict
from .columns import PERMANENT

__all__ = ["Drawing", "draw"]

PANELS = 4  # states of a field of water in its figure


class Drawing:
    """Draws the figures of the run in ``folder``, of a Section, with its ``summary``."""

    def __init__(self, folder, section, summary):
        self.folder, self.section, self.times = Path(folder), section, summary["times_s"]
        self.failed_dry = results.moved_before_water(summary)
        self.verdict = summary.get("verdict")  # versions before had none
        self.window = scales.of(section).mean_seconds

    @cached_property
    def every(self):
        """All rows of the series."""
        return records.read_series(self.folder / "series.csv")

    @cached_property
    def series(self):
        """Its rows from where the slope rests, or fails dry."""
        return chosen_rows(self.every, {"failed_dry": self.failed_dry})

    @cached_property
    def shots(self):
        """[(time [s], path)] of all snapshots: those at regular times, and of the characteristic ones."""
        return frames.of_run(self.folder, self.every)

    @cached_property
    def first(self):
        """The Snapshot before the water rises; None where the slope never stood then."""
        path = self.folder / run_files.BEGIN
        return records.read_snapshot(path) if path.exists() and self.failed_dry is None else None

    @cached_property
    def last(self):
        """That of the end; None where the run has not come so far."""
        path = self.folder / run_files.END
        return records.read_snapshot(path) if path.exists() else None

    @cached_property
    def video_shots(self):
        """Paths of the snapshots that the video has, one a frame."""
        return [path for _, path in frames.regular(self.shots, self.every, self.section, self.failed_dry)]

    def video(self, progress=None):
        """Writes ``avalanche.mp4`` into the folder: (its path, None), or (None, why there is none); None where the run
        has no snapshots.
        """
        if not self.video_shots:
            return None
        return video.write_mp4(
            self.video_shots,
            self.section,
            self.folder / "avalanche.mp4",
            series=self.series,
            times=self.times,
            window=self.window,
            progress=progress,
            free_surface=None if self.field is None else self.free_surface,
        )

    @cached_property
    def field(self):
        """The MeshField of the section's water in the time since t0; None where it has none, or none has acted."""
        path = self.folder / of_section.FILE
        if self.section.water_field is None or self.times["t0"] is None or not path.exists():
            return None
        return field_files.read(path)

    def free_surface(self, time):
        """Polylines of the water's free surface at a time [s] of the run."""
        since = time - self.times["t0"]
        return phreatic.lines(self.field.mesh, self.field.at(since)) if since > 0 else []

    def cases(self):
        """[(name, Snapshot)] at the characteristic times, and at the end of a slope that never fails or is stopped."""
        found = []
        for name, t in sorted(((name, t) for name, t in self.times.items() if t is not None), key=lambda item: item[1]):
            if name == "t0" and self.first is not None:
                found.append((name, self.first))
            elif self.shots:
                found.append((name, records.read_snapshot(frames.nearest(self.shots, t))))
        if self.times["t5"] is None and self.last is not None and not (found and found[-1][1].step == self.last.step):
            found.append((f"end, {self.verdict}" if self.verdict == verdict.STOOD else "end", self.last))
        return found

    def figure(self, name, path=None):
        """One of run_files.PICTURES: the matplotlib Figure, or the ``path`` that it is written to; None where the
        records do not show it. Raises records.RecordsError for another name."""
        if name not in run_files.PICTURES:
            raise records.RecordsError(f"figure {checks.shown(name)}: give one of {', '.join(run_files.PICTURES)}")
        if name == "forces":
            said = verdict.TITLES.get(self.verdict)
            return figures.forces_against_time(
                self.series, self.times, path, window=self.window, walls=self.section, verdict=said
            )
        if name == "energy":
            return figures.energy(records.since_settled(self.every), path, times=self.times)
        if name == "solver":
            return figures.solver(self.series, path, times=self.times)
        if name == "snapshots":
            cases = self.cases()
            surface = None if self.field is None else self.free_surface
            return figures.snapshots(cases, self.section, path, free_surface=surface) if cases else None
        if name == "water":
            return self._water(path)
        if name == "weakening":
            return self._weakening(path)
        if name == "slip_surface":
            return self._slip_surface(path)
        if name == "toe":
            return self._toe(path)
        if name == "shaking":
            return self._shaking(path)
        if self.first is None:
            return None
        if name == "erosion":
            return self._erosion(path)
        if name == "force_chains":
            return figures.force_chains(self.first, self.section, path, title="Initial state")
        if self.verdict == verdict.STOOD:  # nothing was deposited
            return None
        return figures.deposit(self.last, self.first, self.section, path) if self.last is not None else None

    def _water(self, path):
        """Pore pressures in the states of a field, at most :data:`PANELS` of them, with flow lines where it seeps."""
        if self.field is None:
            return None
        own = self.field.times[self.field.pressures.any(axis=1)]
        times = own[np.unique(np.linspace(0, len(own) - 1, min(PANELS, len(own))).round().astype(int))]
        flow = section_seepage.flow(self.section, self.field)
        return figures.pore_pressures(self.field, list(times), self.section, path, flow=flow)

    def _slip_surface(self, path):
        """Nothing where no wall has a slip law, or nothing has slid on one since the slope settled."""
        if not self.section.with_slip_law:
            return None
        cells = records.read_surfaces(self.folder / run_files.SURFACE)
        since = records.since_set_back(records.surface_arrays(cells))
        slid = any(one["slip_m"].any() for one in since.values())
        return figures.slip_surface(cells, path, times=self.times) if slid else None

    def _toe(self, path):
        """Nothing where there is no backstop, where the toe has few disks, and where the run has no snapshots of its
        failure.
        """
        seen = results.while_it_fails(self.folder, self.every, self.times) if self.section.of_role("backstop") else None
        envelope = self.section.envelope
        return seen and figures.toe(*seen, self.section, path, friction_deg=envelope and envelope.friction_deg)

    def _erosion(self, path):
        """Nothing where no window has taken disks out."""
        if not self.section.erosion:
            return None
        ledger = records.read_eroded(self.folder / run_files.LEDGER)
        if not len(ledger["disk"]):
            return None
        return figures.erosion(self.first, ledger, self.section, self.series, path, times=self.times)

    def _shaking(self, path):
        """Nothing where the ground does not shake, or t0 has not come. Beside the displacement along each slip surface
        that of Newmark's block on it, where one rests without shaking.
        """
        shaking, t0 = self.section.shaking, self.first and self.first.time_s
        if shaking is None or t0 is None:
            return None
        motion, t = shaking.motion, self.every["time_s"] - t0 - shaking.begin
        ground = np.unique(np.r_[motion.times, t[t > 0]])
        blocks = dict(_blocks(self.section, ground))
        names = sorted((name for name, _ in self.section.slip_surfaces), key=lambda name: name not in blocks)
        return figures.shaking(
            ground,
            motion.acceleration(ground),
            motion.velocity(ground),
            motion.displacement(ground),
            surfaces=[(name, t, self.every[records.column(PERMANENT.name, name)]) for name in names],
            blocks=[blocks[name] for name in names if name in blocks],
            title=f"{motion.name} ({motion.source})",
            path=path,
        )

    def _weakening(self, path):
        """Nothing where no wall weakens, or where the snapshots are of an earlier version and do not tell."""
        if not self.section.weakening or not self.shots or records.read_snapshot(self.shots[0][1]).weakened is None:
            return None
        cases = (records.read_snapshot(file) for _, file in self.shots)
        return figures.weakening(cases, self.section, path, times=self.times)


def _blocks(section, times):
    """(name, (label, times [s], displacement [m])) of Newmark's block on each slip surface, with the friction and the
    dip of that; none where it does not rest without shaking, has cohesion, or would be lifted off.
    """
    for one, (name, line) in zip(section.sliding, section.slip_surfaces):
        material, dip = section.materials[one.material], abs(roles.dip_of(*roles.chord([line])))
        if material.bonded and material.tensile_strength > 0:
            continue
        try:
            block = newmark.Block(dip, material.friction, gravity=section.gravity, side=section.side)
            slide = newmark.slide(block, section.shaking.motion)
        except newmark.NewmarkError:
            continue
        label = f"Newmark's block on {name}, μ = {material.friction:g}, {dip:.3g}°"
        yield name, (label, times, slide.at(times))


def draw(folder, section, summary, progress=None) -> tuple[list[Path], list[str]]:
    """Draws all figures that the records allow, and the video; returns their paths and notes on what could not be
    made.
    """
    drawing = Drawing(folder, section, summary)
    notes = []
    if drawing.failed_dry is not None:
        notes.append("no figures of force chains and deposit: the slope was on the move already when they would begin")
    if drawing.verdict == verdict.STOOD:
        notes.append("no figures of the toe's failure and of a deposit: the slope stood")
    made = [
        path
        for name in run_files.PICTURES
        if (path := drawing.figure(name, drawing.folder / f"{name}.png")) is not None
    ]
    if drawing.video_shots:
        with ThreadPoolExecutor(1) as beside:  # it mostly compresses, while the video is mostly drawn
            written = beside.submit(paraview.write_run, drawing.folder, section, drawing.shots)
            path, note = drawing.video(progress)
            made.append(written.result())
        (made if path else notes).append(path or note)
    return [Path(p) for p in made], notes
