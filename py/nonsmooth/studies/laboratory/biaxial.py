"""One biaxial test: compression by the platens at constant lateral pressure (Taboada and Estrada 2009, section 5.2,
Figures 9 and 10).

    ε₁ = 1 − H/H₀   axial strain, at the rate ε̇ = I/t_i with t_i = √(m/σ₃), I the inertial number,
    σ₁ = F/W        mean over both platens,            σ₃ on the sides, held,
    ε_v = A/A₀ − 1  volumetric strain, positive in dilation.

The platens reach their rate over the strain :data:`RAMP`: with v = ε̇ H₀ the sample's inertia takes ρ H v̇ ≈ σ₃ I²
(H/d)²/RAMP, half a per cent of σ₃ for the default I = 1e-4 and a sample 100 disks high. What remains of it, and of
waves, shows as the difference between the two platens, which each row has. A step is :attr:`BiaxialTest.step` t_i, so
that a test takes the same number of steps under any pressure.
"""

from __future__ import annotations

import math
import time
from pathlib import Path

import numpy as np

from yade import O

from ... import records
from ...course import driver
from ...measure import cycles
from ...records import checkpoints
from ...running.kept_runs import Progress
from ...system.whole_files import remove, remove_parts, whole
from ...world import tables
from ...world.stepping import advance
from . import membrane, sample
from .biaxial_test import COLUMNS, CYCLE, OF_SOLVER, PHASES, BiaxialTest, key_of
from .sample_course import SampleCourse, TestError

__all__ = ["COLUMNS", "OF_SOLVER", "ROW_STRAIN", "BiaxialCourse", "TestError", "keep_cycle", "run"]

RAMP = 0.002  # strain in which the platens reach their speed
ROW_STRAIN = 1e-4  # between two rows of series.csv
FILM = 100  # frames of a video, besides the first
SNAPSHOTS = (0.01, 0.02, 0.04)  # strains, besides the begin and the end
SWITCHES = 20  # times that the membrane is laid anew while soft contacts come to rest in it


class BiaxialCourse(SampleCourse):
    """Runs a test and writes its records into ``folder``."""

    COLUMNS, KEY, SOFT = COLUMNS, staticmethod(key_of), "a test of soft contacts"

    # ---- begin ----------------------------------------------------------------------------------
    @classmethod
    def begin(cls, test, folder, world=None):
        """Puts the sample into the scene, bonded and under its pressure; ``world``: a :class:`.worlds.Soft`, rigid
        contacts unless given.
        """
        began = time.monotonic()
        body = sample.Sample.build(
            test.shape,
            test.material,
            test.platen,
            test.confining,
            world,
            tolerance=min(test.tolerance, 1e-5),
            maxIterations=max(test.max_iterations, 1000),
            adhesion_range=test.adhesion_range,
        )
        engine, walls, flexible = body.engine, body.walls, test.sides == "flexible"
        unit, width = math.sqrt(body.mass / test.confining), walls.width()
        box = walls.height() * width
        state = {
            "unit_s": unit,
            "rate": test.inertia / unit,
            "height": walls.height(),
            "begin_time": O.time,
            "wall_s": 0.0,
            "wall_steps_s": 0.0,
        }
        course = cls(test, folder, body, state)
        walls.drive("top")
        if flexible:
            walls.remove("left", "right")
        if course.hard:
            engine.tolerance, engine.maxIterations = test.tolerance, test.max_iterations
            O.dt = test.step * unit
            state |= {"sweeps": engine.totalIterations, "unconverged": engine.unconverged}
        else:
            course._settle(unit)
        state["height"] = walls.height()
        area = course._area()
        if not flexible and test.platens != "smooth":
            # platens that drag must not load one side more than the other
            walls.free("left", walls.state("right").mass)
        state |= {
            "width": width,
            "area": area,
            "bonds": body.bonds,
            "begin": O.iter,
            "begin_time": O.time,
            "disks": body.count,
            "contacts": engine.contacts,
            "made_s": time.monotonic() - began,
            "fraction": body.disks_area() / (box if course.hard else area),
        }
        course.snapshot("begin")
        return course

    def _settle(self, unit):
        """Bonds soft contacts, at rest in the membrane where there is one.

        A membrane presses on other disks than a wall did: soft contacts feel a blow that would break bonds, so they are
        made when it has died away. In the hard world bonds come before the membrane, where they do not feel the change.
        """
        if self.test.sides == "flexible":
            for _ in range(SWITCHES):
                self._membrane()
                advance(round(sample.REST_UNITS / SWITCHES * unit / O.dt))
        self.sample.bonds = self.sample.engine.bond()

    @classmethod
    def resume(cls, test, folder):
        """From the checkpoint in ``folder``; TestError where there is none or it is another test's."""
        course = super().resume(test, folder)
        if test.sides == "flexible":
            course.state["pressed"] = []  # a saved scene keeps no permanent forces
            course._membrane()
        return course

    # ---- the course -----------------------------------------------------------------------------
    @property
    def strain(self):
        """Axial strain so far, compression positive."""
        return 1 - self.sample.walls.height() / self.state["height"]

    def run(self, progress=None):
        """Shears the sample to the end; ``progress``: called with the share done. Ctrl-C ends it after the next row,
        with a checkpoint where it has some.
        """
        self.progress = progress
        self.frame(0)
        driver.drive(self)

    def _over(self):
        return not self.strain < self.test.strain - 1e-9

    def _where(self):
        return f"at a strain of {self.state['strain']:.4f}"

    def _steps_in_a_row(self):
        return ROW_STRAIN / (self.state["rate"] * O.dt)

    def _drive(self, steps):
        s = self.state
        elapsed = (O.time - s["begin_time"]) * s["rate"]
        # the speed grows linearly with the time until half of twice RAMP's strain
        share = min(1.0, (elapsed + 0.5 * steps * s["rate"] * O.dt) / (2 * RAMP))
        self.sample.walls.drive("top", (0, -share * s["rate"] * s["height"]))

    def _look(self, made):
        s, test = self.state, self.test
        area = self._area()
        before, s["strain"] = s.get("strain", 0.0), self.strain
        self._row(area, *made)
        if test.forces_from is not None and s["strain"] >= test.forces_from - 1e-9:
            self.snapshot(f"{O.iter:09d}", CYCLE)
        for strain in SNAPSHOTS:
            if before < strain <= s["strain"] and strain < test.strain - 1e-9:
                self.snapshot(f"{100 * strain:g}")
        self.frame(int(FILM * s["strain"] / test.strain + 1e-9))
        if self.progress:
            self.progress(s["strain"] / test.strain)

    def _finish(self):
        self.snapshot("end")
        self._tick()

    def _area(self):
        """Area of the sample [m²]; a membrane is laid anew."""
        walls = self.sample.walls
        return self._membrane() if self.test.sides == "flexible" else walls.height() * walls.width()

    def _membrane(self):
        """Puts the pressure on the outermost disks; returns the sample's area [m²]."""
        body = self.sample
        t = tables.bodies(body.engine)
        try:
            found, area = membrane.forces(
                t["x"], t["y"], t["r"], body.walls.place("bottom")[1], body.walls.place("top")[1], self.test.confining
            )
        except membrane.MembraneError as error:
            raise TestError(f"at a strain of {self.strain:.4f}: {error}, or give --sides rigid") from None
        now = set(np.flatnonzero(np.any(found != 0, axis=1)).tolist())
        for k in self.state.get("pressed", ()):
            if k not in now:
                O.forces.setPermF(body.first_disk + k, (0, 0, 0))
        for k in sorted(now):
            O.forces.setPermF(body.first_disk + k, (float(found[k, 0]), float(found[k, 1]), 0))
        self.state["pressed"] = sorted(now)
        return area

    def _row(self, area, sums, solved):
        engine, s = self.sample.engine, self.state
        height = self.sample.walls.height()
        width = area / height
        sides = self.test.sides == "rigid"
        row = {
            "step": O.iter,
            "time_s": O.time - s["begin_time"],
            "strain": s["strain"],
            "volumetric_strain": area / s["area"] - 1,
            "sigma1_top_Pa": sums["top"] / width,
            "sigma1_bottom_Pa": sums["bottom"] / width,
            "sigma3_left_Pa": sums["left"] / height if sides else self.test.confining,
            "sigma3_right_Pa": sums["right"] / height if sides else self.test.confining,
            "inertial_number": s["rate"] * s["unit_s"],
            **tables.bonds(engine),
            "contacts": engine.contacts,
            "speed_mean_m_per_s": engine.meanSpeed,
            "overlap_worst_rel": engine.overlapWorst,
        }
        self.series.write(row | solved)

    # ---- records --------------------------------------------------------------------------------
    def frame(self, number):
        """Keeps disks and walls for the video as ``frames/NUMBER.npz``, a compact records.Snapshot, once for a
        ``number`` of :data:`FILM`.
        """
        if number <= self.state.get("frame", -1):
            return
        self.state["frame"] = number
        self._keep(f"frames/{number:04d}.npz", ("x", "y", "r", "angle"), compact=True)


def keep_cycle(folder, begin, end):
    """Of the forces of rows in a test's folder, keeps those of the cycle with the deepest drop between two strains, by
    the names ``begin``, ``peak`` and ``end``, and removes the others; all where there is no cycle. Returns the
    cycles.Cycle, or None."""
    folder = Path(folder)
    series = records.read_series(folder / "series.csv")
    chosen = cycles.deepest(series, begin, end)
    for name, row in zip(PHASES, (chosen.begin, chosen.peak, chosen.end) if chosen else ()):
        path = folder / CYCLE / f"{int(series['step'][row]):09d}.npz"
        if path.exists():  # not where a killed run has done so already
            path.replace(folder / CYCLE / f"{name}.npz")
    remove([path for path in whole(folder / CYCLE, "*.npz") if path.stem.isdecimal()], "rows that no picture shows")
    return chosen


def run(folder, world=None, **plain):
    """Runs the test given as plain data (see :meth:`BiaxialTest.of`) in the folder, from its checkpoint if it has one;
    returns numbers of the course.

    ``world``: a :class:`.worlds.Soft`, which has no checkpoints; rigid contacts unless given. ``wall_s`` counts all but
    making the sample, ``wall_steps_s`` the steps alone, without records and checkpoints [s]. The share done is kept in
    the file ``progress``.
    """
    test, folder = BiaxialTest.of(plain), Path(folder)
    remove_parts(folder, folder / "snapshots", folder / "frames", folder / CYCLE, folder / "checkpoint")
    resumes = world is None and checkpoints.exists(folder)
    course = BiaxialCourse.resume(test, folder) if resumes else BiaxialCourse.begin(test, folder, world)
    course.run(Progress(folder))
    if test.forces_from is not None:
        keep_cycle(folder, test.forces_from, test.strain)
    return course.numbers({"rate_per_s": course.state["rate"]})
