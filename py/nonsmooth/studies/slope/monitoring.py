"""What is seen of a slope while it runs: what its course decides by, the row of its series, its snapshots."""

from __future__ import annotations

import math

import numpy as np

from yade import O

from ... import course, packing, records
from ...course import triggers
from ...measure import surface_slip
from ...measure.fronts import front_of
from ...model import scales
from ...records.columns import without
from ...world import tables
from . import slope
from .columns import COLUMNS, OF_SHAKING, PERMANENT, RELEASED
from .error import ExperimentError
from .wall_series import WallSeries

__all__ = ["OF_SOLVER", "SlopeMonitor"]

FORCE_SAMPLES = 100  # of the forces on walls in a row, with soft contacts; each step with hard ones

#: Columns that only a run of rigid disks has: of the contact solver, and of the energies that it sums up.
OF_SOLVER = (
    "iterations",
    "residual",
    "residual_N_per_m",
    "tolerance",
    "energy_water_J",
    "energy_walls_J",
    *records.LOSSES,
    "energy_correction_J",
    "energy_error_rel",
)


class SlopeMonitor:
    """Of a built :class:`~nonsmooth.studies.slope.slope.Slope` and its disks' ``layers`` (count,), unless given as the
    scene has them.

    ``walls``: its WallSeries, once :meth:`open_walls` has been called; ``columns``: those of the rows, {name: Column};
    ``hard``: whether its disks are rigid; ``by_dilatancy``: whether local dilatancy releases its water; ``mass``: which
    disks are of the mass, bool (count,), None: all. ``disks`` and ``t`` are the table of :func:`.tables.bodies`.
    """

    def __init__(self, built, layers=None):
        self.slope, self.section, self.walls = built, built.section, None
        self.layers = slope.layers_of(built) if layers is None else layers
        self.hard = slope.is_hard(built)
        # disks of the mass, where others are bed or obstacles
        mass = np.array([layer.role == "mass" for layer in self.section.layers])
        self.mass = None if mass.all() else mass[self.layers]
        # disks whose water slip surfaces bear: the lowest of them; and in part, each that has columns of its own
        self._borne = None if self.section.borne.all() else self.section.borne[self.layers]
        self._borne_by = {name: self.section.borne_by(name)[self.layers] for name in self.section.stacked}
        own = records.own_columns(self.section.stacked)
        self.columns = (COLUMNS if self.hard else without(COLUMNS, OF_SOLVER)) | {
            name: COLUMNS[records.stem(name)]._replace(name=name) for name in own
        }
        self._begin = self._surfaces = None  # the Snapshot of t0, and its slip surfaces
        if self.section.shaking is not None:
            names = [records.column(PERMANENT.name, name) for name, _ in self.section.slip_surfaces]
            self.columns = self.columns | OF_SHAKING | {name: PERMANENT._replace(name=name) for name in names}
        self.by_dilatancy = self.section.water is not None and self.section.water.release is not None
        if self.by_dilatancy:
            self.columns = self.columns | {RELEASED.name: RELEASED}

    def open_walls(self, path, mark=None):
        """Opens the file of walls, and returns its WallSeries; ``mark``: of a checkpoint."""
        # soft steps are thousands a row, and as cheap as a look at the walls
        row = scales.of(self.section).row_seconds
        period = 1 if self.hard else max(1, int(row / O.dt / FORCE_SAMPLES))
        self.walls = WallSeries(self.slope, self.layers, path, period, mark)
        return self.walls

    def note_begin(self, path):
        """Reads the snapshot of t0, from which on ways are counted."""
        if self.section.shaking is not None:
            self._begin = records.read_snapshot(path)
            self._surfaces = surface_slip.surfaces(self.section, self._begin)

    # ---- what the course decides by ----------------------------------------------------------
    def seen(self, state, disks, more):
        """What :func:`.course.slope.after` decides by, a course.Seen; ``more``: whether a script may do more to it."""
        e, water, made = self.slope.solver, self.slope.water, state.bonds_initial
        return course.Seen(
            O.time,
            O.dt,
            self.mean_speed(disks),
            water.height if water else None,
            way=0.0 if state.centre is None else abs(self.centroid(disks)[0] - state.centre) / self.section.mass_size,
            broken=(e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed) / made if made else 0.0,
            wet=water.wetCount if water else 0,
            top=self._top(disks),
            outside=self._outside(state, e),
            more=more,
        )

    def _top(self, t):
        """Height of the highest disk's centre above the water's plane [m]; the table acts on those whose centres are
        below it.
        """
        water = self.section.water
        if water is None:
            return -math.inf
        (x, y), (nx, ny) = water.point, water.normal
        return float(np.max((t["x"] - x) * nx + (t["y"] - y) * ny))

    def _outside(self, state, e):
        """Energy that came from elsewhere than weight and water [J/m]: of walls that move, of what a script did between
        steps since the slope settled (until then gravity, which grows, is counted there too) and, as long as all is
        dry and nothing shakes, of forces that others put on disks. None with soft contacts, which nobody counts. It is 0 to the last bit
        where nobody has done anything."""
        if not self.hard:
            return None
        wet = state.wet or (self.slope.water is not None and self.slope.water.wetCount > 0)
        shaken = triggers.begun(self.section, course.loads_since(state), O.time)
        brought = 0.0 if state.stage == "settle" else abs(e.broughtEnergy)
        return brought + abs(e.wallWork) + (0.0 if wet or shaken else abs(e.externalWork))

    def mean_speed(self, t):
        """Of the disks of the mass [m/s]; ``t``: the disks' table."""
        return (
            self.slope.solver.meanSpeed if self.mass is None else float(np.mean(np.hypot(t["vx"], t["vy"])[self.mass]))
        )

    def centroid(self, t):
        """Of the mass, (x, y) [m]."""
        if self.mass is None:
            return self.slope.solver.centroid[0], self.slope.solver.centroid[1]
        return tuple(float(np.average(t[name][self.mass], weights=t["r"][self.mass] ** 2)) for name in ("x", "y"))

    def front(self, t):
        """Of the mass [m]."""
        chosen = slice(None) if self.mass is None else self.mass
        return front_of(t["x"][chosen], t["r"][chosen], self.section.side)

    def packing_fraction(self):
        """Packing fraction of the settled bulk; None where the layers are too thin to have one."""
        x, y, r = (tables.bodies(self.slope.solver)[name] for name in ("x", "y", "r"))
        return packing.packing_fraction(packing.Packing(x, y, r, self.layers), self.section.outline)

    # ---- records ------------------------------------------------------------------------------
    def inside(self, t, folder):
        """Raises ExperimentError where a disk of the table ``t`` has left the section's box, and where a script has
        erased or added some; ``folder``: the run's.
        """
        if len(t["x"]) != self.slope.count:
            raise ExperimentError(
                f"at t = {O.time:.3f} s the scene has {len(t['x'])} disks, and the slope {self.slope.count}: its records have a row for each from its beginning on. Let a script that drives a slope "
                "push disks or move walls, and neither erase nor add disks; without some from the beginning, give a packing without them (packing.read_text)"
            )
        x0, y0, x1, y1 = self.section.bounds
        margin = 0.1 * max(x1 - x0, y1 - y0)
        out = ~((t["x"] > x0 - margin) & (t["x"] < x1 + margin) & (t["y"] > y0 - margin) & (t["y"] < y1 + margin))
        if out.any():
            k = int(np.flatnonzero(out)[0])
            raise ExperimentError(
                f"disk {k} left the section at t = {O.time:.3f} s: it is at ({t['x'][k]:.1f}, {t['y'][k]:.1f}) m; close the walls of "
                f"{self.section.source} there, or lower numerics.time_step. What was written until now stays in {folder}"
            )

    def row(self, state, disks):
        """The row of the series, {column: value}; writes that of the walls."""
        e, water, section = self.slope.solver, self.slope.water, self.section
        forces, of_surfaces = self.walls.take()
        dp, fb, ss = forces["slip"], forces["backstop"], forces["ground"]
        total = water.totalForce if water else (0.0, 0.0, 0.0)
        lift = total[0] * section.water.normal[0] + total[1] * section.water.normal[1] if water else 0.0
        u = lift * self._share(disks, self._borne) if water else 0.0
        slip, (x, y) = self.walls.slip(), self.centroid(disks)
        row = {
            "step": O.iter,
            "time_s": O.time,
            "stage": course.STAGES.index(state.stage),
            "water_m": water.height if water else 0.0,
            "dp_normal_total_N_per_m": dp[0] + u,
            "dp_normal_effective_N_per_m": dp[0],
            "dp_water_N_per_m": u,
            "dp_shear_N_per_m": dp[1],
            "fb_normal_N_per_m": fb[0],
            "fb_shear_N_per_m": fb[1],
            "ss_normal_N_per_m": ss[0],
            "ss_shear_N_per_m": ss[1],
            "dp_normal_peak_N_per_m": dp[2],
            "fb_normal_peak_N_per_m": fb[2],
            "ss_normal_peak_N_per_m": ss[2],
            "wet_disks": water.wetCount if water else 0,
            "released_disks": water.releasedCount if water else 0,
            "speed_mean_m_per_s": self.mean_speed(disks),
            "speed_max_m_per_s": e.maxSpeed,
            "front_m": self.front(disks),
            "centroid_x_m": x,
            "centroid_y_m": y,
            **tables.bonds(e),
            "contacts": e.contacts,
            "slip_mean_dp_m": slip.mean,
            "weakened_disks": slip.weakened,
            "overlap_worst_rel": e.overlapWorst,
            "overlap_mean_rel": e.overlapMean,
            "energy_kinetic_J": e.kineticEnergy,
            "energy_potential_J": e.potentialEnergy,
        }
        if self.by_dilatancy:
            row[RELEASED.name] = self._released(disks)
        for name, force in of_surfaces.items():
            share = lift * self._share(disks, self._borne_by[name]) if water else 0.0
            row |= self._of_surface(name, force, share)
        if section.shaking is not None:
            row |= self._of_shaking(disks)
        return row | self._of_solver(state, e) if self.hard else row

    def _of_surface(self, name, force, u):
        """The columns of one of several slip surfaces one above another: its normal and shear force and peak, and the
        water's on what it bears [N/m].
        """
        slip = self.walls.slip(name)
        values = (force[0] + u, force[0], u, force[1], force[2], slip.mean, slip.weakened)
        return {records.column(column, name): value for column, value in zip(records.OWN, values, strict=True)}

    def _of_shaking(self, t):
        """The columns of a slope that is shaken."""
        x, y, _ = self.slope.shaking.acceleration
        values = {"ground_acceleration_x_m_per_s2": x, "ground_acceleration_y_m_per_s2": y}
        if self._surfaces is None:  # before t0
            slipped = dict.fromkeys((name for name, _ in self.section.slip_surfaces), 0.0)
        else:
            slipped = surface_slip.displacements(self._surfaces, self._begin, t["x"], t["y"])
        return values | {records.column(PERMANENT.name, name): value for name, value in slipped.items()}

    def _share(self, t, part):
        """The part of the water's force that acts on what slip surfaces bear: these disks, or this part of each (None:
        all). Forces go with areas.
        """
        if part is None:
            return 1.0
        wet = tables.water(self.slope.water, self.slope.first_disk, self.slope.count)[0] * t["r"] ** 2
        if self.by_dilatancy:
            wet = wet * (1 - self._shares())
        return float((wet[part] if part.dtype == bool else wet * part).sum() / wet.sum()) if wet.any() else 0.0

    def _shares(self):
        """Released share of the pressure on each disk."""
        return tables.released_shares(self.slope.water, self.slope.first_disk, self.slope.count)

    def _released(self, t):
        """The value of RELEASED."""
        area = tables.water(self.slope.water, self.slope.first_disk, self.slope.count)[2] * t["r"] ** 2
        return float((area * self._shares()).sum() / area.sum()) if area.any() else 0.0

    def _of_solver(self, state, e):
        """The columns of OF_SOLVER."""
        losses = e.slidingLoss + e.rollingLoss + e.debondingLoss + e.impactLoss
        # gravity grows: no balance yet
        turned = losses + e.kineticEnergy + abs(e.externalWork) if state.stage != "settle" else 0.0
        return {
            "iterations": e.iterations,
            "residual": e.residual,
            "residual_N_per_m": e.residualForce,
            "tolerance": e.tolerance,
            "energy_water_J": e.externalWork,
            "energy_walls_J": e.wallWork,
            "energy_sliding_J": e.slidingLoss,
            "energy_rolling_J": e.rollingLoss,
            "energy_impact_J": e.impactLoss,
            "energy_bonds_J": e.debondingLoss,
            "energy_correction_J": e.correctionEnergy,
            "energy_error_rel": e.energyError / turned if turned > 0 else 0.0,
        }

    def snapshot(self, path, contacts=False):
        """Writes the present state; with ``contacts`` also the forces."""
        path.parent.mkdir(parents=True, exist_ok=True)
        built, water = self.slope, self.slope.water
        t = tables.bodies(built.solver)
        first, count = built.first_disk, built.count
        arrays = {name: t[name] for name in ("x", "y", "r", "angle", "vx", "vy")}
        arrays["wet"], arrays["released"], arrays["ever_wet"] = tables.water(water, first, count)
        if self.by_dilatancy:
            arrays["released_share"] = self._shares()
        arrays["weakened"] = self.walls.weakened()
        if contacts:
            wall_numbers = {i: k for k, ids in enumerate(built.walls.values()) for i in ids}
            arrays.update(tables.loaded_contacts(built.solver, first, wall_numbers))
        records.write_snapshot(
            path, time_s=O.time, step=O.iter, layer=self.layers, water_m=water.height if water else 0.0, **arrays
        )
