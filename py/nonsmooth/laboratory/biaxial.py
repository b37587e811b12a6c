"""One biaxial test: compression by the platens at constant lateral pressure (Taboada and Estrada 2009, section 5.2, Figures 9 and 10).

    ε₁ = 1 − H/H₀   axial strain, at the rate ε̇ = I/t_i with t_i = √(m/σ₃), I the inertial number,
    σ₁ = F/W        mean over both platens,            σ₃ on the sides, held,
    ε_v = A/A₀ − 1  volumetric strain, positive in dilation.

The platens reach their rate over the strain :data:`RAMP`: with v = ε̇ H the sample's inertia takes ρ H v̇ ≈ σ₃ I² (H/d)²/RAMP, half a per cent of σ₃ for
the default I = 1e-4 and a sample 100 disks high. What remains of it, and of waves, shows as the difference between the two platens, which each
row has. A step is :attr:`Test.step` t_i, so that a test takes the same number of steps under any pressure.
"""

from __future__ import annotations

import math
import time
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from .. import checkpoints, records, section, tables
from ..packing_files import write_atomically
from . import membrane, sample

RAMP = 0.002               # strain in which the platens reach their speed
ROW_STRAIN = 1e-4          # between two rows of series.csv
SNAPSHOTS = (0.01, 0.02, 0.04)  # strains, besides the begin and the end
CHECKPOINT_SECONDS = 60    # of wall time

COLUMNS = ("step", "time_s", "strain", "volumetric_strain", "sigma1_top_Pa", "sigma1_bottom_Pa", "sigma3_left_Pa", "sigma3_right_Pa", "inertial_number",
           "bonds_alive", "bonds_broken_tension", "bonds_broken_shear", "bonds_broken_torque", "bonds_broken_mixed", "contacts", "speed_mean_m_per_s",
           "iterations_mean", "residual_worst", "unconverged", "overlap_worst_rel")


class TestError(RuntimeError):
    """A test that cannot go on; the message says why and what helps."""

    __test__ = False  # no test of pytest's


@dataclass(frozen=True)
class Test:
    """What determines a test. ``confining``: σ₃ [Pa]; ``strain``: at the end.

    ``platens``: "smooth", "rough" (friction and rolling friction of the rock, no bonds) or "glued" (bonded as the rock is); ``sides``: "rigid" or
    "flexible"; ``inertia``: inertial number I of the loading; ``step``: time step in t_i; ``pressing_friction``: of contacts while the sample
    is made; ``bond_first``: bonds are made before the pressure grows.
    """

    __test__ = False

    material: section.Material
    confining: float
    shape: sample.Shape
    strain: float = 0.06
    platens: str = "smooth"
    sides: str = "rigid"
    inertia: float = 1e-4
    step: float = 0.1
    tolerance: float = 1e-5
    max_iterations: int = 1000
    pressing_friction: float = 0.0
    bond_first: bool = False

    @classmethod
    def of(cls, plain):
        """From the plain data that `asdict` makes of a test."""
        plain = dict(plain)
        m = dict(plain.pop("material"))
        m["bond_ellipse"] = tuple(m["bond_ellipse"])
        m["slip_weakening"] = None
        return cls(material=section.Material(**m), shape=sample.Shape(**plain.pop("shape")), **plain)

    @property
    def platen(self):
        """Material of the platens."""
        m = replace(self.material, name="platen", tensile_strength=0.0, residual_tensile_strength=0.0)
        if self.platens == "smooth":
            return replace(m, friction=0.0, residual_friction=0.0, rolling_friction=0.0, residual_rolling_friction=0.0)
        return m


class Course:
    """Runs a test and writes its records into ``folder``."""

    def __init__(self, test, folder, body, state):
        """``body``: the Sample in the scene; ``state``: dictionary of numbers that a checkpoint keeps."""
        self.test, self.folder, self.sample, self.state = test, Path(folder), body, state
        self.series = records.SeriesWriter(self.folder / "series.csv", COLUMNS, resume_from_step=state.get("row_step"), overwrite="row_step" not in state)
        self._saved = self._clock = time.monotonic()

    # ---- begin ----------------------------------------------------------------------------------
    @classmethod
    def begin(cls, test, folder):
        """Makes the sample: packed, pressed, bonded."""
        began = time.monotonic()
        body = sample.Sample.build(test.shape, test.material, test.platen, min(test.tolerance, 1e-5), max(test.max_iterations, 1000))
        engine, made = body.engine, 0
        if test.bond_first:
            body.scene.step()
            made = engine.bond()
        body.press(test.confining, test.pressing_friction)
        if not test.bond_first:
            made = engine.bond()
        body.step()
        unit = math.sqrt(body.mass / test.confining)
        disks = tables.bodies(engine)
        state = {"unit_s": unit, "rate": test.inertia / unit, "height": body.height(), "width": body.width(), "area": body.height() * body.width(), "bonds": made,
                 "begin": body.scene.iter, "begin_time": body.scene.time, "disks": body.count, "contacts": engine.contacts, "made_s": time.monotonic() - began,
                 "wall_s": 0.0, "sweeps": engine.totalIterations, "unconverged": engine.unconverged,
                 "fraction": float(np.sum(math.pi * disks["r"] ** 2)) / (body.height() * body.width())}
        engine.tolerance, engine.maxIterations = test.tolerance, test.max_iterations
        body.scene.dt = test.step * unit
        body.drive("top", (0, 0))
        course = cls(test, folder, body, state)
        if test.sides == "flexible":
            body.remove_sides()
            state["area"] = course._membrane()
        course.snapshot("begin")
        return course

    @classmethod
    def resume(cls, test, folder):
        """From the checkpoint in ``folder``; TestError where there is none or it is another test's."""
        content = checkpoints.read(Path(folder), key_of(test), TestError)
        body = sample.Sample(content["walls"], content["first_disk"], content["count"])
        body.pressure = test.confining
        course = cls(test, folder, body, content["state"])
        if test.sides == "flexible":
            course.state["pressed"] = []  # a saved scene keeps no permanent forces
            course._membrane()
        return course

    # ---- the course -----------------------------------------------------------------------------
    @property
    def strain(self):
        return 1 - self.sample.height() / self.state["height"]

    def run(self, progress=None):
        """Shears the sample to the end; ``progress``: called with the share done."""
        O, s, test, engine = self.sample.scene, self.state, self.test, self.sample.engine
        per_row = max(1, round(ROW_STRAIN / (s["rate"] * O.dt)))
        taken = [strain for strain in SNAPSHOTS if strain < test.strain - 1e-9]
        while self.strain < test.strain - 1e-9:
            sums, sweeps, worst, missed = {}, engine.totalIterations, 0.0, engine.unconverged
            for _ in range(per_row):
                elapsed = (O.time - s["begin_time"]) * s["rate"]
                # the speed grows linearly with the time until half of twice RAMP's strain
                share = min(1.0, (elapsed + 0.5 * s["rate"] * O.dt) / (2 * RAMP))
                self.sample.drive("top", (0, -share * s["rate"] * s["height"]))
                self.sample.step()
                worst = max(worst, engine.residual)
                for name, force in self.sample.wall_forces().items():
                    sums[name] = sums.get(name, 0.0) + force / per_row
            area = self._membrane() if test.sides == "flexible" else self.sample.height() * self.sample.width()
            before = s.get("strain", 0.0)
            s["strain"], s["row_step"] = self.strain, O.iter
            self._row(sums, area, (engine.totalIterations - sweeps) / per_row, worst, engine.unconverged - missed)
            for strain in taken:
                if before < strain <= s["strain"]:
                    self.snapshot(f"{100 * strain:g}")
            if progress:
                progress(s["strain"] / test.strain)
            if time.monotonic() - self._saved > CHECKPOINT_SECONDS:
                self.checkpoint()
        self.snapshot("end")
        self._count_time()
        self.series.close()

    def _membrane(self):
        """Puts the pressure on the outermost disks; returns the sample's area [m²]."""
        body, O = self.sample, self.sample.scene
        t = tables.bodies(body.engine)
        try:
            found, area = membrane.forces(t["x"], t["y"], t["r"], body.place("bottom")[1], body.place("top")[1], self.test.confining)
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

    def _row(self, sums, area, sweeps, worst, missed):
        engine, O, s = self.sample.engine, self.sample.scene, self.state
        height = self.sample.height()
        width = area / height
        sides = self.test.sides == "rigid"
        self.series.write({
            "step": O.iter, "time_s": O.time - s["begin_time"], "strain": s["strain"], "volumetric_strain": area / s["area"] - 1,
            "sigma1_top_Pa": sums["top"] / width, "sigma1_bottom_Pa": sums["bottom"] / width,
            "sigma3_left_Pa": sums["left"] / height if sides else self.test.confining, "sigma3_right_Pa": sums["right"] / height if sides else self.test.confining,
            "inertial_number": s["rate"] * s["unit_s"], "bonds_alive": engine.bonds, "bonds_broken_tension": engine.brokenTension,
            "bonds_broken_shear": engine.brokenShear, "bonds_broken_torque": engine.brokenTorque, "bonds_broken_mixed": engine.brokenMixed,
            "contacts": engine.contacts, "speed_mean_m_per_s": engine.meanSpeed, "iterations_mean": sweeps, "residual_worst": worst, "unconverged": missed,
            "overlap_worst_rel": engine.overlapWorst})

    # ---- records --------------------------------------------------------------------------------
    def snapshot(self, name):
        """Writes the present state with its forces as ``snapshots/NAME.npz``, a records.Snapshot; walls are numbered as in Sample.walls."""
        body = self.sample
        t, c = tables.bodies(body.engine), tables.contacts(body.engine)
        keep = (c["normal"] != 0) | c["bonded"]
        c = {key: values[keep] for key, values in c.items()}
        number = {i: k for k, i in enumerate(body.walls.values())}
        a, b = np.minimum(c["id1"], c["id2"]), np.maximum(c["id1"], c["id2"])
        folder = self.folder / "snapshots"
        folder.mkdir(parents=True, exist_ok=True)
        none = np.zeros(body.count, bool)
        records.write_snapshot(
            folder / f"{name}.npz", time_s=body.scene.time - self.state["begin_time"], step=body.scene.iter, water_m=0.0, layer=np.zeros(body.count, int), wet=none, released=none,
            **{key: t[key] for key in ("x", "y", "r", "angle", "vx", "vy")}, ci=b - body.first_disk,
            cj=np.array([-1 - number[i] if i in number else i - body.first_disk for i in a], int), cn=c["normal"], ct=c["tangential"], cbonded=c["bonded"], cx=c["x"], cy=c["y"])

    def checkpoint(self):
        """Saves all that :meth:`resume` needs."""
        self._count_time()
        self.series.sync()
        checkpoints.write(self.folder, key_of(self.test), {"walls": self.sample.walls, "first_disk": self.sample.first_disk, "count": self.sample.count, "state": self.state})
        self._saved = time.monotonic()

    def _count_time(self):
        now = time.monotonic()
        self.state["wall_s"] += now - self._clock
        self._clock = now


def key_of(test):
    """What a checkpoint and the test that goes on from it must agree on."""
    return checkpoints.key_of(asdict(test))


def run(folder, **plain):
    """Runs the test given as plain data (see :meth:`Test.of`) in the folder, from its checkpoint if it has one; returns numbers of the course.

    The share done is kept in the file ``progress``.
    """
    test, folder = Test.of(plain), Path(folder)
    course = Course.resume(test, folder) if checkpoints.exists(folder) else Course.begin(test, folder)
    shown = 0.0

    def progress(share):
        nonlocal shown
        if time.monotonic() - shown > 1:
            write_atomically(folder / "progress", f"{share:.4f}".encode())
            shown = time.monotonic()

    course.run(progress)
    s, engine = course.state, course.sample.engine
    steps = course.sample.scene.iter - s["begin"]
    return {"disks": s["disks"], "bonds": s["bonds"], "contacts": s["contacts"], "packing_fraction": s["fraction"], "height_m": s["height"], "width_m": s["width"],
            "rate_per_s": s["rate"], "inertial_number": test.inertia, "time_step_s": course.sample.scene.dt, "steps": steps, "simulated_s": course.sample.scene.time - s["begin_time"],
            "wall_making_s": s["made_s"], "wall_s": s["wall_s"], "sweeps_mean": (engine.totalIterations - s["sweeps"]) / steps,
            "unconverged": engine.unconverged - s["unconverged"], "overlap_worst_rel": engine.overlapWorstEver, "residual": engine.residual}
