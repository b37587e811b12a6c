"""What the courses of all tests of a sample share: forces on the walls in a row, snapshots, and checkpoints."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from yade import O
from yade.wrapper import ContactDynamicsEngine

from ... import records
from ...course import driver
from ...errors import UserError
from ...records import checkpoints
from ...records.columns import without
from ...world import tables
from .biaxial_test import OF_SOLVER
from .sample import Sample
from .walls import Walls

__all__ = ["SampleCourse", "TestError"]

SAMPLES = 20  # of the forces on the walls in a row, with soft contacts; each step with hard ones


class TestError(UserError, RuntimeError):
    """A test that cannot go on; the message says why and what helps."""

    __test__ = False  # no test of pytest's


class SampleCourse(driver.Course):
    """Runs a test of a Sample between its walls, and writes its records into ``folder``.

    A test defines the class attributes below, ``_steps_in_a_row``, ``_drive`` and what a driver.Course asks for besides
    ``_steps`` and ``_save``.
    """

    #: Of ``series.csv``, {name: Column}; names of those that rigid contacts alone have, :data:`OF_SOLVER` among them.
    COLUMNS, OF_RIGID = {}, OF_SOLVER
    #: What a checkpoint and the test that goes on from it must agree on, a function of the test.
    KEY = None
    #: What has no checkpoints, in words.
    SOFT = None

    def __init__(self, test, folder, body, state):
        """``body``: the Sample in the scene; ``state``: dictionary of numbers that a checkpoint keeps."""
        self.test, self.folder, self.sample, self.state = test, Path(folder), body, state
        self.hard, self.progress = isinstance(body.engine, ContactDynamicsEngine), None
        self.unsaved = None if self.hard else self.SOFT
        self.series = records.SeriesWriter(
            self.folder / "series.csv",
            self.COLUMNS if self.hard else without(self.COLUMNS, self.OF_RIGID),
            resume_from=state.pop("series", None),
            overwrite=True,
        )
        super().__init__(self.series, spent=state)

    @classmethod
    def resume(cls, test, folder):
        """From the checkpoint in ``folder``; TestError where there is none or it is another test's."""
        content = checkpoints.read(Path(folder), cls.KEY(test), TestError)
        walls = Walls(content["walls"], content["pressure"])
        body = Sample(walls, content["first_disk"], content["count"])
        return cls(test, folder, body, content["state"] | {"series": content["series"]})

    def numbers(self, own):
        """What a run of it returns: numbers of its sample and its course, with the test's ``own`` among them."""
        s, engine = self.state, self.sample.engine
        steps = O.iter - s["begin"]
        found = {name: s[name] for name in ("disks", "bonds", "contacts", "wall_s", "wall_steps_s")} | {
            "packing_fraction": s["fraction"],
            "height_m": s["height"],
            "width_m": s["width"],
            **own,
            "inertial_number": self.test.inertia,
            "time_step_s": O.dt,
            "steps": steps,
            "simulated_s": O.time - s["begin_time"],
            "wall_making_s": s["made_s"],
            "overlap_worst_rel": engine.overlapWorstEver,
        }
        if not self.hard:
            return found
        return found | {
            "sweeps_mean": (engine.totalIterations - s["sweeps"]) / steps,
            "unconverged": engine.unconverged - s["unconverged"],
            "residual": engine.residual,
        }

    # ---- a row ----------------------------------------------------------------------------------
    def _steps_in_a_row(self):
        """How many steps a row is long, a number that is rounded."""
        raise NotImplementedError

    def _drive(self, steps):
        """Gives the driven walls their velocities for the next ``steps`` steps."""
        raise NotImplementedError

    def _passed(self, forces, steps):
        """Looks at the ``forces`` {wall: N/m} of the last of ``steps`` steps at one velocity."""

    def _steps(self):
        """Those of a row; returns the mean force on each wall [N/m], and what the solver's columns hold."""
        engine, walls = self.sample.engine, self.sample.walls
        # soft steps are thousands a row
        least = 1 if self.hard else SAMPLES
        per_row = max(least, round(self._steps_in_a_row()))
        parts = [len(p) for p in np.array_split(np.arange(per_row), per_row if self.hard else SAMPLES)]
        sums, worst, kinetic = {}, 0.0, 0.0
        if self.hard:
            sweeps, missed = engine.totalIterations, engine.unconverged
        for part in parts:
            self._drive(part)
            for _ in range(part):
                walls.step()
            if self.hard:
                worst = max(worst, engine.residual)
                kinetic += engine.kineticEnergy / per_row
            forces = walls.forces()
            for name, force in forces.items():
                sums[name] = sums.get(name, 0.0) + force / len(parts)
            self._passed(forces, part)
        if not self.hard:
            return sums, {}
        solved = ((engine.totalIterations - sweeps) / per_row, worst, engine.unconverged - missed, kinetic)
        return sums, dict(zip(OF_SOLVER, solved, strict=True))

    # ---- records --------------------------------------------------------------------------------
    def snapshot(self, name, folder="snapshots"):
        """Writes the present state with its forces as ``NAME.npz`` of a ``folder``, a records.Snapshot; walls are
        numbered as in Walls.ids.
        """
        body = self.sample
        numbers = {i: k for k, i in enumerate(body.walls.ids.values())}
        loaded = tables.loaded_contacts(body.engine, body.first_disk, numbers)
        self._keep(f"{folder}/{name}.npz", ("x", "y", "r", "angle", "vx", "vy"), **loaded)

    def _keep(self, name, disks, **more):
        t = tables.bodies(self.sample.engine)
        records.write_snapshot(
            self.folder / name,
            time_s=O.time - self.state["begin_time"],
            step=O.iter,
            walls=self.sample.walls.lines(),
            **{key: t[key] for key in disks},
            **more,
        )

    def _save(self):
        checkpoints.write(
            self.folder,
            self.KEY(self.test),
            {
                "walls": self.sample.walls.ids,
                "pressure": self.sample.walls.pressure,
                "first_disk": self.sample.first_disk,
                "count": self.sample.count,
                "state": self.state,
                "series": self.series.mark(),
            },
        )
