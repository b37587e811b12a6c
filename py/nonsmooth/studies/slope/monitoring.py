"""What is seen of a slope while it runs: what its course decides by, the row of its series, its snapshots."""

from __future__ import annotations

import math

import numpy as np

from yade import O

from ... import course, packing, records
from ...course.triggers import shaking
from ...measure import surface_slip
from ...measure.fronts import front_of
from ...measure.pressure_heads import SlipHeads
from ...model import scales
from ...records.columns import without
from ...world import tables
from . import slope
from .columns import COLUMNS, ERODING, OF_SHAKING, OF_SURFACES, PERMANENT, RELEASED
from .eroding import Eroding
from .error import ExperimentError
from .surface_series import SurfaceSeries
from .wall_series import WallSeries

__all__ = ["OF_SOLVER", "SlopeMonitor"]

ROUNDING = 1e-9  # of the energy that disks had which were taken out
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

    ``field``: the section's pore pressures in the time since t0, a MeshField, or None;
    ``walls``: its WallSeries, once :meth:`open_walls` has been called; ``eroding``: its Eroding, once
    :meth:`open_ledger` has, where the section has windows that take disks out; ``surfaces``: its SurfaceSeries, once
    :meth:`open_surfaces` has, where walls have slip laws; ``columns``: those of the rows, {name:
    Column}; ``hard``: whether its disks are rigid; ``by_dilatancy``: whether local dilatancy releases its water;
    ``mass``: which disks are of the mass, bool (count,), None: all. ``disks`` and ``t`` are the table of
    :func:`.tables.bodies`, of those that are there.
    """

    def __init__(self, built, layers=None, field=None):
        self.slope, self.section, self.walls = built, built.section, None
        self.field = field
        self._slip_heads = None if field is None else SlipHeads(field, built.section)
        self.layers = slope.layers_of(built) if layers is None else layers
        self.hard = slope.is_hard(built)
        # disks of the mass, where others are bed or obstacles
        mass = np.array([layer.role == "mass" for layer in self.section.layers])
        self.mass = None if mass.all() else mass[self.layers]
        self._density = np.array([self.section.materials[layer.material].density for layer in self.section.layers])
        # disks whose water slip surfaces bear: the lowest of them; and in part, each that has columns of its own
        self._borne = None if self.section.borne.all() else self.section.borne[self.layers]
        self._borne_by = {name: self.section.borne_by(name)[self.layers] for name in self.section.stacked}
        own = records.own_columns(self.section.stacked)
        self.columns = (COLUMNS if self.hard else without(COLUMNS, OF_SOLVER)) | {
            name: COLUMNS[records.stem(name)]._replace(name=name) for name in own
        }
        self.columns |= ERODING if self.section.erosion else {}
        self.eroding = self.surfaces = None
        self._begin = self._surfaces = None  # the Snapshot of t0, and its slip surfaces
        if self.section.shaking is not None:
            names = [records.column(PERMANENT.name, name) for name, _ in self.section.slip_surfaces]
            self.columns = self.columns | OF_SHAKING | {name: PERMANENT._replace(name=name) for name in names}
        self.by_dilatancy = self.section.water is not None and self.section.water.release is not None
        if self.by_dilatancy:
            self.columns = self.columns | {RELEASED.name: RELEASED}
        self.columns |= OF_SURFACES if self.section.heated_surfaces else {}

    def open_walls(self, path, mark=None):
        """Opens the file of walls, and returns its WallSeries; ``mark``: of a checkpoint."""
        # soft steps are thousands a row, and as cheap as a look at the walls
        row = scales.of(self.section).row_seconds
        period = 1 if self.hard else max(1, int(row / O.dt / FORCE_SAMPLES))
        self.walls = WallSeries(self.slope, self.layers, path, period, mark)
        return self.walls

    def open_ledger(self, path, mark=None):
        """Opens the ledger of disks that windows take out, where the section has some; returns its Eroding, or None."""
        if self.section.erosion:
            self.eroding = Eroding(self.slope, self.layers, self.mass, path, mark)
        return self.eroding

    def open_surfaces(self, path, mark=None):
        """Opens the file of cells along walls with slip laws, where there are some; returns its SurfaceSeries, or
        None.
        """
        if self.section.with_slip_law:
            self.surfaces = SurfaceSeries(self.slope, path, mark)
        return self.surfaces

    def take_out(self, due, disks):
        """Lets the windows that are ``due`` take disks out, see :meth:`.eroding.Eroding.take`; returns by how much the
        mass's centre jumps, (x, y) [m].
        """
        left = self.eroding.take(due, disks)
        of_mass = np.ones(len(left), bool) if self.mass is None else self._there(self.mass, disks)
        if left.all():
            return 0.0, 0.0
        weight = self._density[self._there(self.layers, disks)] * disks["r"] ** 2
        before, after = (
            [np.average(disks[axis][rows], weights=weight[rows]) for axis in ("x", "y")]
            for rows in (of_mass, of_mass & left)
        )
        return float(after[0] - before[0]), float(after[1] - before[1])

    def _there(self, values, disks):
        """Values of all disks, (count, …), as those of the ones that are there."""
        return values if len(disks["id"]) == self.slope.count else values[disks["id"] - self.slope.first_disk]

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
            None if self.section.water_table is None else water.height,
            self._coming(state),
            way=0.0 if state.centre is None else abs(self.centroid(disks)[0] - state.centre) / self.section.mass_size,
            broken=(e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed) / made if made else 0.0,
            wet=water.wetCount if water else 0,
            top=self._top(disks),
            outside=self._outside(state, e),
            more=more,
        )

    def _coming(self, state):
        """Whether states of a field of water are to come."""
        if self.field is None or (state.t0 is not None and course.field_begin(state, self.section) is None):
            return False
        return state.t0 is None or O.time < state.t0 + self.field.times[-1]

    def water_height(self, state):
        """Of the water table above its plane [m], 0 where it is dry; of a field of pressures their mean head on the
        slip surfaces.
        """
        if self._slip_heads is None:
            return self.slope.water.height if self.slope.water else 0.0
        begin = course.field_begin(state, self.section)
        return 0.0 if begin is None else self._slip_heads.mean(O.time - begin)

    def _top(self, t):
        """Height of the highest disk's centre above the water's plane [m]; the table acts on those whose centres are
        below it.
        """
        water = self.section.water_table
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
        shaken = shaking.began(self.section, course.loads_since(state), O.time)
        brought = 0.0 if state.stage == "settle" else abs(self._brought(e))
        return brought + abs(e.wallWork) + (0.0 if wet or shaken else abs(e.externalWork))

    def _brought(self, e):
        """What others than windows brought [J/m]: what the engine counts, less that of disks which were taken out, to
        rounding.
        """
        if self.eroding is None or not self.eroding.disks:
            return e.broughtEnergy
        rest = e.broughtEnergy + self.eroding.energy
        return rest if abs(rest) > ROUNDING * self.eroding.turned else 0.0

    def mean_speed(self, t):
        """Of the disks of the mass [m/s]; ``t``: the disks' table."""
        return (
            self.slope.solver.meanSpeed
            if self.mass is None
            else float(np.mean(np.hypot(t["vx"], t["vy"])[self._there(self.mass, t)]))
        )

    def centroid(self, t):
        """Of the mass, (x, y) [m]."""
        if self.mass is None:
            return self.slope.solver.centroid[0], self.slope.solver.centroid[1]
        mass = self._there(self.mass, t)
        return tuple(float(np.average(t[name][mass], weights=t["r"][mass] ** 2)) for name in ("x", "y"))

    def front(self, t):
        """Of the mass [m]."""
        chosen = slice(None) if self.mass is None else self._there(self.mass, t)
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
        count = self.slope.count - (self.eroding.disks if self.eroding else 0)
        if len(t["x"]) != count:
            raise ExperimentError(
                f"at t = {O.time:.3f} s the scene has {len(t['x'])} disks, and the slope {count}: its records have a row for each from its beginning on. Let a script that drives a slope "
                "push disks or move walls, and neither erase nor add disks; without some from the beginning, give a packing without them (packing.read_text), and let windows of the section take them out in its course (erosion)"
            )
        x0, y0, x1, y1 = self.section.bounds
        margin = 0.1 * max(x1 - x0, y1 - y0)
        out = ~((t["x"] > x0 - margin) & (t["x"] < x1 + margin) & (t["y"] > y0 - margin) & (t["y"] < y1 + margin))
        if out.any():
            k = int(np.flatnonzero(out)[0])
            raise ExperimentError(
                f"disk {int(t['id'][k]) - self.slope.first_disk} left the section at t = {O.time:.3f} s: it is at ({t['x'][k]:.1f}, {t['y'][k]:.1f}) m; close the walls of "
                f"{self.section.source} there, or lower numerics.time_step. What was written until now stays in {folder}"
            )

    def row(self, state, disks):
        """The row of the series, {column: value}; writes that of the walls."""
        e, water, section = self.slope.solver, self.slope.water, self.section
        self.walls.there = self._there(np.arange(self.slope.count), disks)
        forces, of_surfaces = self.walls.take()
        of_cells = self.surfaces.take() if self.surfaces is not None else {}
        dp, fb, ss = forces["slip"], forces["backstop"], forces["ground"]
        total = water.totalForce if water else (0.0, 0.0, 0.0)
        normal = (section.water_table or section).normal
        lift = total[0] * normal[0] + total[1] * normal[1] if water else 0.0
        u = lift * self._share(disks, self._borne, state) if water else 0.0
        slip, (x, y) = self.walls.slip(), self.centroid(disks)
        row = {
            "step": O.iter,
            "time_s": O.time,
            "stage": course.STAGES.index(state.stage),
            "water_m": self.water_height(state),
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
        if self.eroding is not None:
            row |= self.eroding.columns(state)
        if self.by_dilatancy:
            row[RELEASED.name] = self._released(disks)
        for name, force in of_surfaces.items():
            share = lift * self._share(disks, self._borne_by[name], state) if water else 0.0
            row |= self._of_surface(name, force, share)
        if section.shaking is not None:
            row |= self._of_shaking(disks)
        row |= of_cells
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
            slipped = surface_slip.displacements(
                self._surfaces, self._begin, t["x"], t["y"], t["id"] - self.slope.first_disk
            )
        return values | {records.column(PERMANENT.name, name): value for name, value in slipped.items()}

    def _share(self, t, part, state):
        """The part of the water's force that acts on what slip surfaces bear: these disks, or this part of each (None:
        all). Forces go with areas, and in a field with the pressure's gradient along the slope's normal.
        """
        if part is None:
            return 1.0
        wet, part = tables.water(self.slope.water, self.slope.first_disk, self.slope.count)[0], self._there(part, t)
        if self.by_dilatancy:
            wet = wet * (1 - self._shares())
        wet = self._there(wet, t) * t["r"] ** 2
        begin = course.field_begin(state, self.section)
        if begin is not None:
            gradient = self.field.gradient(np.column_stack((t["x"], t["y"])), O.time - begin, outside="dry")
            wet = wet * (gradient[:, 0] * self.section.normal[0] + gradient[:, 1] * self.section.normal[1])
        whole = wet.sum()
        return float((wet[part] if part.dtype == bool else wet * part).sum() / whole) if whole else 0.0

    def _shares(self):
        """Released share of the pressure on each disk."""
        return tables.released_shares(self.slope.water, self.slope.first_disk, self.slope.count)

    def _released(self, t):
        """The value of RELEASED."""
        ever = tables.water(self.slope.water, self.slope.first_disk, self.slope.count)[2]
        area, shares = self._there(ever, t) * t["r"] ** 2, self._there(self._shares(), t)
        return float((area * shares).sum() / area.sum()) if area.any() else 0.0

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

    def snapshot(self, path, state, contacts=False):
        """Writes the present ``state``; with ``contacts`` also the forces."""
        path.parent.mkdir(parents=True, exist_ok=True)
        built, water = self.slope, self.slope.water
        t = tables.bodies(built.solver)
        first, count = built.first_disk, built.count
        arrays = {name: t[name] for name in ("x", "y", "r", "angle", "vx", "vy")}
        of_water = zip(("wet", "released", "ever_wet"), tables.water(water, first, count))
        arrays |= {name: self._there(values, t) for name, values in of_water}
        if self.by_dilatancy:
            arrays["released_share"] = self._there(self._shares(), t)
        arrays["weakened"] = self._there(self.walls.weakened(), t)
        numbers = t["id"] - first
        if contacts:
            wall_numbers = {i: k for k, ids in enumerate(built.walls.values()) for i in ids}
            arrays.update(tables.loaded_contacts(built.solver, first, wall_numbers))
        if len(numbers) != count:
            arrays["number"] = numbers
            for name in ("ci", "cj") if contacts else ():  # rows of this snapshot
                disk = arrays[name] >= 0
                arrays[name][disk] = np.searchsorted(numbers, arrays[name][disk])
        layers, height = self._there(self.layers, t), self.water_height(state)
        records.write_snapshot(path, time_s=O.time, step=O.iter, layer=layers, water_m=height, **arrays)
