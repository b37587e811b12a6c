"""The course of a slope experiment: bond, load, rest dry, raise the water, follow the avalanche until it rests.

Everything that decides the course stands in :class:`State`, which goes into checkpoints; nothing depends on wall time. Rules:

* bonds are made in the packing as it is, without load; then gravity grows to its value during ``stages.settle.ramp``;
* settled: the mean speed is below ``stages.settle.speed_rest``, or ``time_max`` has passed; the dry rest begins;
* failed dry: the mean speed has reached 2 m/s before t0, or is 0.2 m/s then, or comes to that without having been below 0.02 m/s since. The water does not
  rise, or no further; the slope is followed until it rests;
* t0: the dry rest ends, the water begins to rise;
* moving: the mean speed reaches 0.2 m/s: the slope no longer just follows the water. With ``water.hold: motion`` the table stays where it
  is from here on, and the solver's tolerance is ``tolerance_moving``, until the mean speed is down to a tenth of its maximum; from there
  it falls with the speed, down to ``tolerance``. A slope that comes to rest again without having got going does not count as moving: the
  table then goes on rising;
* still: the slope does not move and its water table has stood at one height for 5 s: the tolerance is a quarter of ``tolerance``, since
  nothing but the solver's error is left to move a disk, and over a minute a looser solve breaks a bond or two that bear all they can;
* a step is ``numerics.time_step``, or as short as the speeds of contacts want it (NonsmoothTimeStepper, where the section gives a ``path``);
* rows and snapshots are of the first steps that end at, or less than half a step before, whole multiples of their distance in time, from the beginning
  on; forces on walls are means over the steps since the row before, and the largest;
* speeds and times in this list are those of the shipped section, and scaled for another (:mod:`.scales`);
* with soft contacts there is no tolerance: what goes from one value to another while the slope moves is the integrator's damping (``damping_moving``);
* end: the mean speed has been below ``rest_fraction`` of its maximum for ``rest_hold`` seconds, or ``end.time`` has passed.
"""

from __future__ import annotations

import math
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import ContactDynamicsEngine, NewtonIntegrator

from . import checkpoints, interrupts, packing, records, results, scales, slope, tables
from .errors import UserError
from .figures.profiles import front_of
from .stepping import advance
from .wall_forces import WallForces

__all__ = ["Experiment", "ExperimentError", "State", "COLUMNS"]

FORCE_SAMPLES = 100      # of the forces on walls in a row, with soft contacts; each step with hard ones
FRAME_ROWS = 5           # between two snapshots, for the video and the figures
CHECKPOINT_SECONDS = 90  # of wall time between two checkpoints, at least ...
CHECKPOINT_SHARE = 0.02  # ... and so many that they take this part of it at most
SLOW_FRACTION = 0.1      # of the largest mean speed, see above
STILL_SHARE = 0.25       # the tolerance of a slope that is still, of itself
STAGES = ("settle", "dry", "water")  # by their number in the series

COLUMNS = tuple(records.COLUMNS)
#: Columns that only a run of rigid disks has: of the contact solver, and of the energies that it sums up.
OF_SOLVER = ("iterations", "residual", "residual_N_per_m", "tolerance", "energy_water_J", "energy_walls_J", "energy_sliding_J", "energy_rolling_J",
             "energy_impact_J", "energy_bonds_J", "energy_correction_J", "energy_error_rel")


class ExperimentError(UserError, RuntimeError):
    """The run cannot go on; the message says why and what helps."""


@dataclass
class State:
    """Where the experiment stands; times in s of the simulation, None while they have not come."""

    stage: str = "settle"  # settle, dry, water, done
    settled: float | None = None
    t0: float | None = None
    moving: float | None = None
    failed_dry: float | None = None  # the slope did not wait for the water
    stood: bool = False  # at t0 or since, before it moved
    water_hold: float | None = None
    table: float = 0.0  # height of the water table ...
    table_since: float = 0.0  # ... and the time since when it has been there
    water_delay: float = 0.0  # how long the table stood still while the slope moved and came to rest again
    front0: float | None = None
    speed_max: float = 0.0
    resting_since: float | None = None
    bonds_initial: int = 0
    contacts_initial: int = 0
    packing_fraction: float | None = 0.0
    frames: int = 0
    overlap_mean_worst: float = 0.0
    wall_s: float = 0.0
    wall_packing_s: float = 0.0
    wall_steps_s: float = 0.0  # of wall_s: steps alone, without records ...
    wall_moving_s: float = 0.0  # ... and of these, the ones of the water stage
    moving_s: float = 0.0  # ... and how much they simulated
    first_step: int = 0


class Experiment:
    """Runs a built :class:`~nonsmooth.slope.Slope` and writes its records into ``folder``.

    ``progress``: called with (stage, seconds simulated, seconds foreseen) after every row. ``damping_moving``: of soft contacts, instead of
    their world's while the slope moves. A slope of soft contacts has no checkpoints. ``state``, ``mark``: of a checkpoint, see :func:`resume`; without
    them the records of an earlier run in ``folder`` are removed.
    """

    def __init__(self, built, folder, state=None, layers=None, progress=None, damping_moving=None, mark=None):
        self.slope, self.section, self.folder = built, built.section, Path(folder)
        self.state = state or State()
        self.layers = slope.layers_of(built) if layers is None else layers
        self.progress = progress or (lambda *_: None)
        self.scales = scales.of(self.section)
        self.forces = WallForces(built.walls)
        self.hard = isinstance(built.solver, ContactDynamicsEngine)
        # soft steps are thousands a row, and as cheap as a look at the walls
        self._every = 1 if self.hard else max(1, int(self.scales.row_seconds / O.dt / FORCE_SAMPLES))
        self.columns = COLUMNS if self.hard else tuple(name for name in COLUMNS if name not in OF_SOLVER)
        if state is None:
            checkpoints.forget(self.folder)  # before anything is written that it would not belong to
            results.forget(self.folder)
        self.series = records.SeriesWriter(
            self.folder / "series.csv", self.columns, resume_from=mark, overwrite=True)
        if state is not None:
            results.forget_later(self.folder, state.stage, O.iter)
        self._clock = time.monotonic()
        self._saved, self._saving = self._clock, 0.0
        self.newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))
        self.damping = (self.newton.damping, self.newton.damping if damping_moving is None else damping_moving)
        if state is None:
            self._begin()

    # ---- the course ---------------------------------------------------------------------------
    def run(self, end=None):
        """Runs until the experiment is over, or until ``end`` [s] of simulated time.

        Ctrl-C ends it after the next row, with a checkpoint, by raising interrupts.Interrupted.
        """
        with interrupts.noted() as interrupted:
            self._run(end, interrupted)

    def _run(self, end, interrupted):
        while self.state.stage != "done" and (end is None or O.time < end - 0.5 * O.dt):
            # to a multiple of the rows' distance, so that rows fall on the same steps after a resume
            row = math.floor((O.time + 0.5 * O.dt) / self.scales.row_seconds) + 1
            first, began = O.time, time.perf_counter()
            while O.time < row * self.scales.row_seconds - 0.5 * O.dt:
                if self.state.stage == "settle":
                    self.newton.gravity = self._gravity(O.time)
                before = O.time
                advance()
                if O.iter % self._every == 0:
                    self.forces.add(O.time - before)
            self._count(O.time - first, time.perf_counter() - began)
            self._advance(row)
            if interrupted():
                self.checkpoint()
                self.series.close()
                kept = "the checkpoint is written, go on with --resume" if self.hard else "a slope of soft contacts has no checkpoint, run it again"
                raise interrupts.Interrupted(f"at {O.time:.1f} s of simulated time; {kept}")
        self.checkpoint()
        self.series.close()

    def _count(self, simulated, seconds):
        s = self.state
        s.wall_steps_s += seconds
        if s.moving is not None:
            s.wall_moving_s += seconds
            s.moving_s += simulated

    def _advance(self, row):
        solver, s = self.slope.solver, self.state
        disks = tables.bodies(solver)
        self._inside(disks)
        if s.stage != "water" and s.failed_dry is None and solver.meanSpeed >= self.scales.going_speed:
            s.failed_dry = O.time
        s.speed_max = max(s.speed_max, solver.meanSpeed) if s.stage == "water" or s.failed_dry is not None else 0.0
        s.overlap_mean_worst = max(s.overlap_mean_worst, solver.overlapMean)
        self.series.write(self._row(disks))
        if (s.stage != "settle" or s.failed_dry is not None) and row % FRAME_ROWS == 0:
            self.snapshot(self.folder / "snapshots" / f"{O.iter:08d}.npz")
            s.frames += 1
        getattr(self, f"_{s.stage}")()
        self.progress(s.stage, O.time, self._foreseen())
        if time.monotonic() - self._saved > max(CHECKPOINT_SECONDS, self._saving / CHECKPOINT_SHARE):
            self.checkpoint()

    def _begin(self):
        """The first steps, without gravity; bonds the packing as it is, unless that comes after gravity has grown."""
        s, solver = self.state, self.slope.solver
        self.newton.gravity = self._gravity(0.0)
        advance()  # makes the interactions
        s.first_step = O.iter
        if self.section.stages.settle.bond == "before":
            s.bonds_initial = solver.bond()
        advance()
        s.contacts_initial = solver.contacts

    def _gravity(self, time):
        """Gravity [m/s²] at a time [s]: it grows linearly during the ramp of the settling stage."""
        ramp = self.section.stages.settle.ramp
        share = min(1.0, time / ramp) if ramp > 0 else 1.0
        return Vector3(0, -share * self.section.gravity, 0)

    def _settle(self):
        stage, s = self.section.stages.settle, self.state
        resting = self.slope.solver.meanSpeed <= stage.speed_rest or O.time >= stage.time_max - 0.5 * O.dt
        if O.time < stage.ramp or not (resting or s.failed_dry is not None):  # one that has failed is not waited for
            return
        s.packing_fraction = self._fraction() if s.failed_dry is None else None
        if stage.bond == "after":
            s.bonds_initial, s.contacts_initial = self.slope.solver.bond(), self.slope.solver.contacts
        s.settled, s.stage = O.time, "dry"
        s.table_since = O.time
        self.slope.solver.forgetEnergies()
        for name in self.slope.walls:
            material = self.slope.wall_material(name)
            if hasattr(material, "forgetSlip"):
                material.forgetSlip()
        if self.slope.water:
            self.slope.water.forgetReleases()
        self.checkpoint()

    def _dry(self):
        s = self.state
        if O.time < s.settled + self.section.stages.dry - 0.5 * O.dt:
            return
        s.t0, s.stage = O.time, "water"
        disks = tables.bodies(self.slope.solver)
        s.front0 = front_of(disks["x"], disks["r"])
        self.snapshot(self.folder / "t0.npz", contacts=True)
        speed = self.slope.solver.meanSpeed
        if s.failed_dry is None and speed >= self.scales.moving_speed:
            s.failed_dry = O.time
        s.stood = speed < self.scales.stopped_speed
        if s.failed_dry is not None:
            s.moving, s.water_hold = s.failed_dry, 0.0
        elif self.slope.water:
            self._raise_water()
        self.checkpoint()

    def _raise_water(self):
        """Gives the water engine the section's table, from t0 and the delay on."""
        s, w = self.state, self.section.water
        times, heights = (list(map(float, v)) for v in zip(*w.table))
        if w.rate:
            span = self.section.stages.end.time
            times.append(times[-1] + span)
            heights.append(heights[-1] + w.rate * span)
        self.slope.water.times = [s.t0 + s.water_delay + t for t in times]
        self.slope.water.heights = heights

    def _water(self):
        s, stages, solver, water = self.state, self.section.stages, self.slope.solver, self.slope.water
        s.stood = s.stood or solver.meanSpeed < self.scales.stopped_speed
        if s.moving is None and solver.meanSpeed >= self.scales.moving_speed:
            s.moving = O.time
            if not s.stood:
                s.failed_dry = O.time
                if water:
                    self._hold(water.height)
            elif water and stages.water_hold == "motion":
                self._hold(water.height)
        elif (s.moving is not None and s.failed_dry is None and solver.meanSpeed < self.scales.stopped_speed
              and s.speed_max < self.scales.going_speed):
            if water and stages.water_hold == "motion":
                s.water_delay += O.time - s.moving
                s.water_hold = None
                self._raise_water()
            s.moving = None
        if water and s.water_hold is None and not isinstance(stages.water_hold, str) and water.height >= stages.water_hold:
            self._hold(float(stages.water_hold))
        resting = s.moving is not None and solver.meanSpeed < stages.end.rest_fraction * s.speed_max
        if not resting:
            s.resting_since = None
        elif s.resting_since is None:
            s.resting_since = O.time
        # reactions at rest depend on how the mass came to rest, so more care while it slows down
        flowing = 0.0 if s.moving is None else min(1.0, solver.meanSpeed / (SLOW_FRACTION * s.speed_max))
        height = water.height if water else 0.0
        if height != s.table:
            s.table, s.table_since = height, O.time
        still = s.moving is None and O.time - s.table_since >= self.scales.still_seconds
        self._care(flowing, still)
        over = O.time >= s.settled + stages.end.time - 0.5 * O.dt
        if over or (resting and O.time - s.resting_since >= stages.end.rest_hold - 0.5 * O.dt):
            s.stage = "done"
            self.snapshot(self.folder / "end.npz", contacts=True)

    def _care(self, flowing, still):
        """How exactly contacts are computed; ``flowing``: from 0 at rest to 1 on the move."""
        if self.hard:
            numerics = self.section.numerics
            self.slope.solver.tolerance = max((STILL_SHARE if still else 1.0) * numerics.tolerance, flowing * numerics.tolerance_moving)
        else:
            self.newton.damping = (1 - flowing) * self.damping[0] + flowing * self.damping[1]

    def _hold(self, height):
        self.state.water_hold = height
        self.slope.water.times = [O.time]
        self.slope.water.heights = [height]

    def _fraction(self):
        """Packing fraction of the settled bulk; None where the layers are too thin to have one."""
        x, y, r = (tables.bodies(self.slope.solver)[name] for name in ("x", "y", "r"))
        try:
            return packing.packing_fraction(packing.Packing(x, y, r, self.layers), self.section.outline)
        except packing.PackingError:
            return None

    def _foreseen(self):
        """Simulated time at which the run may end [s]: an estimate for the progress bar."""
        s, stages = self.state, self.section.stages
        if s.stage == "done":
            return O.time
        settled = s.settled if s.settled is not None else max(8.0, O.time)
        if s.moving is not None:
            return max(min(s.moving + 55.0, settled + stages.end.time), O.time)
        rate = self.section.water.rate if self.section.water else 0
        rise = 25.0 / rate if rate and stages.water_hold == "motion" else stages.end.time
        return max(min(settled + stages.dry + rise + 55.0, settled + stages.end.time), O.time)

    # ---- records ------------------------------------------------------------------------------
    def _inside(self, t):
        """Raises where a disk of the table ``t`` has left the section's box."""
        x0, y0, x1, y1 = self.section.bounds
        margin = 0.1 * max(x1 - x0, y1 - y0)
        out = ~((t["x"] > x0 - margin) & (t["x"] < x1 + margin) & (t["y"] > y0 - margin) & (t["y"] < y1 + margin))
        if out.any():
            k = int(np.flatnonzero(out)[0])
            raise ExperimentError(
                f"disk {k} left the section at t = {O.time:.3f} s: it is at ({t['x'][k]:.1f}, {t['y'][k]:.1f}) m; close the walls of "
                f"{self.section.source} there, or lower numerics.time_step. What was written until now stays in {self.folder}")

    def _row(self, disks):
        e, water, section = self.slope.solver, self.slope.water, self.section
        forces = self.forces.take()
        zero = (0.0, 0.0, 0.0)
        base = section.water.wall if section.water and section.water.wall else "DP"
        dp, fb, ss = forces.get(base, zero), forces.get("FB", zero), forces.get("SS", zero)
        total = water.totalForce if water else (0.0, 0.0, 0.0)
        u = total[0] * section.normal[0] + total[1] * section.normal[1]
        weak = self.slope.wall_material(base) if base in self.slope.walls else None
        slip = hasattr(weak, "meanSlip")
        row = {
            "step": O.iter, "time_s": O.time, "stage": STAGES.index(self.state.stage), "water_m": water.height if water else 0.0,
            "dp_normal_total_N_per_m": dp[0] + u, "dp_normal_effective_N_per_m": dp[0], "dp_water_N_per_m": u, "dp_shear_N_per_m": dp[1],
            "fb_normal_N_per_m": fb[0], "fb_shear_N_per_m": fb[1], "ss_normal_N_per_m": ss[0], "ss_shear_N_per_m": ss[1],
            "dp_normal_peak_N_per_m": dp[2], "fb_normal_peak_N_per_m": fb[2], "ss_normal_peak_N_per_m": ss[2],
            "wet_disks": water.wetCount if water else 0, "released_disks": water.releasedCount if water else 0,
            "speed_mean_m_per_s": e.meanSpeed, "speed_max_m_per_s": e.maxSpeed, "front_m": front_of(disks["x"], disks["r"]),
            "centroid_x_m": e.centroid[0], "centroid_y_m": e.centroid[1], "bonds_alive": e.bonds,
            "bonds_broken_tension": e.brokenTension, "bonds_broken_shear": e.brokenShear,
            "bonds_broken_torque": e.brokenTorque, "bonds_broken_mixed": e.brokenMixed, "contacts": e.contacts,
            "slip_mean_dp_m": weak.meanSlip() if slip else 0.0, "weakened_disks": weak.weakenedCount() if slip else 0,
            "overlap_worst_rel": e.overlapWorst, "overlap_mean_rel": e.overlapMean,
            "energy_kinetic_J": e.kineticEnergy, "energy_potential_J": e.potentialEnergy,
        }
        return row | self._of_solver(e) if self.hard else row

    def _of_solver(self, e):
        """The columns of OF_SOLVER."""
        losses = e.slidingLoss + e.rollingLoss + e.debondingLoss + e.impactLoss
        turned = losses + e.kineticEnergy + abs(e.externalWork) if self.state.stage != "settle" else 0.0  # gravity grows: no balance yet
        return {
            "iterations": e.iterations, "residual": e.residual, "residual_N_per_m": e.residualForce, "tolerance": e.tolerance,
            "energy_water_J": e.externalWork, "energy_walls_J": e.wallWork, "energy_sliding_J": e.slidingLoss, "energy_rolling_J": e.rollingLoss,
            "energy_impact_J": e.impactLoss, "energy_bonds_J": e.debondingLoss,
            "energy_correction_J": e.correctionEnergy, "energy_error_rel": e.energyError / turned if turned > 0 else 0.0,
        }

    def snapshot(self, path, contacts=False):
        """Writes the present state; with ``contacts`` also the forces."""
        path.parent.mkdir(parents=True, exist_ok=True)
        built, water = self.slope, self.slope.water
        t = tables.bodies(built.solver)
        first, count = built.first_disk, built.count
        arrays = {name: t[name] for name in ("x", "y", "r", "angle", "vx", "vy")}
        arrays["wet"], arrays["released"] = tables.water(water, first, count)
        if contacts:
            wall_numbers = {i: k for k, ids in enumerate(built.walls.values()) for i in ids}
            arrays.update(tables.loaded_contacts(built.solver, first, wall_numbers))
        records.write_snapshot(path, time_s=O.time, step=O.iter, layer=self.layers, water_m=water.height if water else 0.0, **arrays)

    # ---- checkpoints --------------------------------------------------------------------------
    def checkpoint(self):
        """Saves all that :func:`resume` needs; an earlier checkpoint is there until the new one is whole. With soft contacts the records alone."""
        now = time.monotonic()
        self.state.wall_s += now - self._clock
        self._clock = now
        self.series.sync()
        records.write_breaks(self.folder / "breaks.csv", tables.breaks(self.slope.solver), self.slope.first_disk)
        if self.hard:
            checkpoints.write(self.folder, run_key(self.section), {
                "walls": self.slope.walls, "first_disk": self.slope.first_disk, "count": self.slope.count, "state": asdict(self.state),
                "series": self.series.mark()})
        self._saved = time.monotonic()
        self._saving = self._saved - now


def run_key(section):
    """What must agree between a checkpoint and the section it is resumed with."""
    return checkpoints.key_of({"key": section.key("settled"), "water": asdict(section.water) if section.water else None, "stages": asdict(section.stages),
                               "seed": section.seed})


def resume(section, folder, progress=None):
    """An :class:`Experiment` that goes on from the checkpoint in ``folder``.

    Raises ExperimentError where there is none, where it is damaged, or where it belongs to another section, and RecordsError where the series is not as it
    was then. Nothing has been written then.
    """
    content = checkpoints.read(folder, run_key(section), ExperimentError)
    try:
        state, mark = State(**content["state"]), content["series"]
    except (KeyError, TypeError) as error:
        raise ExperimentError(f"{folder}: the checkpoint cannot be read ({error}); remove {folder}/checkpoint and run without --resume") from None
    built = slope.find(section, content["walls"], content["first_disk"], content["count"])
    return Experiment(built, folder, state=state, progress=progress, mark=mark)
