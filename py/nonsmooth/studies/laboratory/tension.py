"""One direct tension test: a bonded sample between two glued platens that are drawn apart, its sides free.

    ε = H/H₀ − 1      axial strain, at the rate ε̇ = I/t_i with t_i = √(m/σ_ext), I the inertial number,
    σ = −F/W₀         mean over both platens, tension positive.

Each platen moves at half of the speed v = ε̇ H₀, which it reaches over an opening of :data:`RAMP` half-axes of a mean
bond's ellipse: each half of the sample then takes ρ H v̇/2 ≈ σ_ext I² (H/d)³/(4 ε_n), a thousandth of σ_ext for the
default I and 8,000 disks. Rigid bonds yield at once, so that the stress is near its peak from there on, until the first
bonds leave their ellipses.

The parts next to the platens are grips, with bonds that are stronger than the rock's: disks lie in a layer along a flat
platen, and a layer comes off more easily than a rough cut. Platens and grips are tension_test.STRONG times as strong.
"""

from __future__ import annotations

import math
import time
from pathlib import Path

from yade import O

from ... import records
from ...course import driver
from ...records import LOSSES, checkpoints
from ...running.kept_runs import Progress
from ...system.whole_files import remove_parts
from ...world import tables
from . import sample
from .sample_course import SampleCourse
from .tension_test import COLUMNS, OF_RIGID, TensionTest, key_of

__all__ = ["ROWS", "TensionCourse", "run"]

RAMP = 0.5  # half-axes of a mean bond's ellipse in which the platens reach their speed
ROWS = 50  # of series.csv while the platens draw apart by such a half-axis
LATE = 10  # rows in which the stress must be as low as it is to have fallen
SNAPSHOTS = (0.5, 1.0, 2.0)  # openings in such half-axes, besides the begin, the peak and the end
_LOST = dict(zip(LOSSES, ("slidingLoss", "rollingLoss", "impactLoss", "debondingLoss")))  # attributes of the engine


class TensionCourse(SampleCourse):
    """Runs a test and writes its records into ``folder``."""

    COLUMNS, OF_RIGID, KEY, SOFT = COLUMNS, OF_RIGID, staticmethod(key_of), "a test of soft contacts"

    # ---- begin ----------------------------------------------------------------------------------
    @classmethod
    def begin(cls, test, folder, world=None):
        """Puts the sample into the scene, bonded, its sides free; ``world``: a :class:`.worlds.Soft`, rigid contacts
        unless given.
        """
        began = time.monotonic()
        body = sample.Sample.build(
            test.shape,
            test.material,
            test.platen,
            test.pressure,
            world,
            tolerance=min(test.tolerance, 1e-5),
            grips=test.grips,
            maxIterations=max(test.max_iterations, 1000),
            adhesion_range=test.adhesion_range,
        )
        engine, walls = body.engine, body.walls
        unit, width = math.sqrt(body.mass / test.material.tensile_strength), walls.width()
        box = width * walls.height()
        course = cls(test, folder, body, {"wall_s": 0.0, "wall_steps_s": 0.0})
        if not course.hard:
            body.bonds = engine.bond()
        walls.pressure = 0.0
        if not course.hard:
            for _ in range(round(sample.REST_UNITS * unit / O.dt)):  # free of the pressure, springs swing
                walls.step()
        walls.remove("left", "right")
        walls.drive("top")
        if course.hard:
            engine.tolerance, engine.maxIterations = test.tolerance, test.max_iterations
            O.dt = test.step * unit
            course.state |= {"sweeps": engine.totalIterations, "unconverged": engine.unconverged}
            course.state["lost"] = {name: getattr(engine, lost) for name, lost in _LOST.items()}
        height = walls.height()
        course.state |= {
            "unit_s": unit,
            "speed": test.inertia / unit * height,
            "height": height,
            "width": width,
            "bonds": body.bonds,
            "begin": O.iter,
            "begin_time": O.time,
            "disks": body.count,
            "contacts": engine.contacts,
            "made_s": time.monotonic() - began,
            "fraction": body.disks_area() / box,
            "work": 0.0,
            "peak": 0.0,
            "low": 0,
            "opening": 0.0,
        }
        course.snapshot("begin")
        return course

    # ---- the course -----------------------------------------------------------------------------
    def run(self, progress=None):
        """Draws the platens apart to the end; ``progress``: called with the share done, of the largest opening. Ctrl-C
        ends it after the next row, with a checkpoint where it has some.
        """
        self.progress = progress
        driver.drive(self)

    def _over(self):
        return self.broke or self.state["opening"] >= self.test.opening * self.test.diameter - 1e-9

    @property
    def broke(self):
        """Whether the stress has fallen to its small share of the peak."""
        return self.state["low"] >= LATE

    def _where(self):
        return f"at an opening of {self.state['opening']:.4g} m"

    def _steps_in_a_row(self):
        return self.test.yielding / ROWS / (self.state["speed"] * O.dt)

    def _drive(self, steps):
        s = self.state
        elapsed = (O.time - s["begin_time"]) * s["speed"]
        # the speed grows linearly with the time until half of twice RAMP's opening
        share = min(1.0, (elapsed + 0.5 * steps * s["speed"] * O.dt) / (2 * RAMP * self.test.yielding))
        self.speed = 0.5 * share * s["speed"]
        self.sample.walls.drive("top", (0, self.speed))
        self.sample.walls.drive("bottom", (0, -self.speed))

    def _passed(self, forces, steps):
        self.state["work"] -= (forces["top"] + forces["bottom"]) * self.speed * steps * O.dt

    def _look(self, made):
        s, test = self.state, self.test
        sums, solved = made
        before, s["opening"] = s["opening"], self.sample.walls.height() - s["height"]
        top, bottom = (-sums[name] / s["width"] for name in ("top", "bottom"))
        self._row(top, bottom, solved)
        stress = 0.5 * (top + bottom)
        if stress > s["peak"]:
            s["peak"] = stress
            self.snapshot("peak")
        s["low"] = s["low"] + 1 if 0 < s["peak"] and stress < test.fallen * s["peak"] else 0
        for part in SNAPSHOTS:
            if before < part * test.yielding <= s["opening"]:
                self.snapshot(f"{part:g}")
        if self.progress:
            self.progress(min(1.0, s["opening"] / (test.opening * test.diameter)))

    def _row(self, top, bottom, solved):
        engine, s = self.sample.engine, self.state
        row = {
            "step": O.iter,
            "time_s": O.time - s["begin_time"],
            "strain": s["opening"] / s["height"],
            "opening_m": s["opening"],
            "tension_top_Pa": top,
            "tension_bottom_Pa": bottom,
            "work_J": s["work"],
            **tables.bonds(engine),
            "contacts": engine.contacts,
            "speed_mean_m_per_s": engine.meanSpeed,
            "overlap_worst_rel": engine.overlapWorst,
        }
        if self.hard:
            row |= {name: getattr(engine, lost) - s["lost"][name] for name, lost in _LOST.items()}
        self.series.write(row | solved)

    def _finish(self):
        self.snapshot("end")
        records.write_breaks(self.folder / "breaks.csv", tables.breaks(self.sample.engine), self.sample.first_disk)
        self._tick()


def run(folder, world=None, **plain):
    """Runs the test given as plain data (see :meth:`TensionTest.of`) in the folder, from its checkpoint if it has one;
    returns numbers of the course, ``broke`` among them: whether the stress fell before the largest opening.

    ``world``: a :class:`.worlds.Soft`, which has no checkpoints; rigid contacts unless given. ``wall_s`` counts all but
    making the sample, ``wall_steps_s`` the steps alone, without records and checkpoints [s]. The share done is kept in
    the file ``progress``.
    """
    test, folder = TensionTest.of(plain), Path(folder)
    remove_parts(folder, folder / "snapshots", folder / "checkpoint")
    resumes = world is None and checkpoints.exists(folder)
    course = TensionCourse.resume(test, folder) if resumes else TensionCourse.begin(test, folder, world)
    course.run(Progress(folder))
    return course.numbers({"broke": course.broke, "speed_m_per_s": course.state["speed"]})
