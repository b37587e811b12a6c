"""Contact parameters for a rock of which only macroscopic strengths are known.

Unknown: σ_ext, μ_s, and where residual strengths are wanted too, μ_r and σ_res. Measured by biaxial tests of samples
that stay the same from one trial to the next, so that differences are those of the material: c, φ at the peak, and
c_res, φ_res on the plateau. By dimensional analysis c is proportional to σ_ext as long as σ₃/σ_ext is kept, and φ
hardly depends on it; so logarithms of the parameters are used, with a Jacobian that begins as this guess and learns
from every trial (Broyden's update). `scipy.optimize.least_squares` chooses the trials. Samples are coarse first; fine
ones then correct what the size of the sample does, unless the search is a quick one. The first trial is what the table
of calibrated rocks (:mod:`..rocks`) says, where it holds.

How long a search takes is said before it starts: a test costs so many disks times steps, and a short test of a small
sample measures what one disk and step take on this machine.

How unique the answer is, trials say that are made for it: coarse samples, one parameter changed at a time. With J the
derivatives of the strengths, each in units of what it may miss, by the logarithms of the parameters, a parameter is
known to the relative error √((JᵀJ)⁻¹)ₖₖ if each strength is known to one such unit; the right singular vector of the
smallest singular value is the change that the strengths tell least about.
"""

from __future__ import annotations

import dataclasses
import json
import math
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from ...measure.statistics import half_width
from ...model import rocks
from ...system import keys
from ...system.whole_files import write_json
from . import biaxial_test, campaign, pressing

__all__ = [
    "BOUNDS",
    "DEGREES",
    "LEARN",
    "QUICK",
    "QUICK_TRIALS",
    "SCALE",
    "Calibration",
    "Wanted",
    "lasting",
    "uncertainty",
    "uniqueness",
]

# σ₃ over the wanted cohesion. Under three times the cohesion, 3 % of σ₁ (what samples of 5,000 disks differ by) are 15
# % of c; under half of it, 5 %.
PRESSURES = (0.5, 3.0, 12.0, 48.0)
PEAK_STRAIN = 0.03  # at the end of tests of which only the peak is wanted
QUICK = 1000  # disks of the samples of a quick search; the peak of 2,000 is the same (biaxial_effects.py)
QUICK_TRIALS = 4  # of a quick search at most; from the table two or three reach the tolerances
TIMED = (
    500,
    0.006,
)  # disks, and strain at the end, of the tests that measure what a step takes; sweeps a step are about as many until 3 %
BOUNDS = {
    "tensile_strength": (1e2, 1e9),
    "friction": (0.02, 2.0),
    "rolling_friction": (0.005, 0.6),
    "residual_share": (0.01, 1.0),
}
# first derivatives by logarithms: of ln c, φ [°], ln c_res, φ_res [°]; those of friction measured on 5,000 disks with
# μ_s from 0.21 to 0.3
SLOPES = {
    "tensile_strength": (1.0, 0.0, 1.0, 0.0),
    "friction": (0.75, 17.0, 0.0, 12.0),
    "rolling_friction": (0.2, 4.0, 0.0, 5.0),
    "residual_share": (0.0, 0.0, 1.0, 0.0),
}
SCALE = 0.02  # a misfit of 2 % counts as one
DEGREES = 0.7  # of angles, about the same
COARSE = 3.0  # what coarse samples may miss, in these units: fine ones differ from them by more
# of a trial's parameters: the last bits of exponentials and of linear algebra are a processor's own, and a test grows
# them
DIGITS = 4
PROBE = (
    0.3  # step (of logarithms) of the trials that measure derivatives: ten times the samples' scatter of some per cent
)
LEARN = (
    0.04  # smallest step (of logarithms) from which the Jacobian learns; what differs after a smaller one is scatter
)


@dataclass(frozen=True)
class Wanted:
    """Macroscopic strengths [Pa, degrees]; residual ones None where they do not matter."""

    cohesion: float
    friction_deg: float
    residual_cohesion: float | None = None
    residual_friction_deg: float | None = None

    @property
    def with_residual(self):
        """Whether residual strengths are wanted."""
        return self.residual_friction_deg is not None


class Calibration:
    """Searches a material; every trial is kept in ``out/trials.json`` and not computed again by a resumed search, which
    also goes on with the tests of a broken one.
    """

    def __init__(self, wanted, start, out, threads, say=print, resume=False, progress=lambda share, doing: None):
        """``start``: section.Material whose other parameters are kept; ``say``: called with a line of text for every
        trial; ``progress``: now and then with the share that is done of as many trials as there may be, and what is
        being done."""
        self.wanted, self.start, self.out, self.threads, self.say, self.resume, self.progress = (
            wanted,
            start,
            Path(out),
            threads,
            say,
            resume,
            progress,
        )
        self.names = ("tensile_strength", "friction") + (
            ("rolling_friction", "residual_share") if wanted.with_residual else ()
        )
        self.trials = []
        self.known = self._kept() if resume else []
        share = start.residual_tensile_strength / start.tensile_strength if start.tensile_strength > 0 else 0.25
        strength, friction = self._guess()
        first = {
            "tensile_strength": strength,
            "friction": friction,
            "rolling_friction": start.rolling_friction,
            "residual_share": max(share, 0.02),
        }
        self.x0 = np.log([first[name] for name in self.names])
        self.share = share
        self.jacobian, self.last = self._first_jacobian(), None
        self._done, self._whole = 0.0, 1.0  # disks of the trials behind us, and of all that may come

    def _guess(self):
        """σ_ext [Pa] and μ_s of the first trial: of the table of rocks where the other parameters are its own."""
        low, high = rocks.interval()
        if low <= self.wanted.friction_deg <= high and rocks.like_table(self.start):
            found = rocks.contacts(self.wanted.cohesion, self.wanted.friction_deg)
            return found.tensile_strength, found.friction
        return 1.1 * self.wanted.cohesion, self.start.friction

    def _first_jacobian(self):
        slopes = np.array([SLOPES[name] for name in self.names], float).T[: 4 if self.wanted.with_residual else 2]
        if self.wanted.with_residual:
            # its misfit is not in parts of itself but of the peak cohesion; where none is wanted a little is left to
            # begin with
            slopes[2] *= max(0.05, self.wanted.residual_cohesion / self.wanted.cohesion)
        return slopes

    # ---- parameters -----------------------------------------------------------------------------
    def parameters(self, x):
        """The parameters exp(x), a dictionary, to :data:`DIGITS` digits."""
        return {name: float(f"{value:.{DIGITS}g}") for name, value in zip(self.names, np.exp(x).tolist())}

    def material(self, x):
        """The start material with the :meth:`parameters` of x."""
        v = self.parameters(x)
        friction, rolling = v["friction"], v.get("rolling_friction", self.start.rolling_friction)
        return dataclasses.replace(
            self.start,
            name="calibrated",
            tensile_strength=v["tensile_strength"],
            residual_tensile_strength=v.get("residual_share", self.share) * v["tensile_strength"],
            friction=friction,
            residual_friction=friction,
            rolling_friction=rolling,
            residual_rolling_friction=rolling,
            envelope=None,
        )

    # ---- trials ---------------------------------------------------------------------------------
    def _kept(self):
        """Trials of an earlier search, an empty list where there are none; CampaignError for a file that cannot be
        read.
        """
        path = self.out / "trials.json"
        try:
            trials = json.loads(path.read_text())
            for trial in trials:
                trial["key"], [float(strength) for strength in trial["found"]]
            return trials
        except FileNotFoundError:
            return []
        except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
            raise campaign.CampaignError(
                f"{path}: the trials of the earlier search cannot be read ({error}); remove the file, and they are made again"
            ) from None

    def measure(self, x, disks, seeds):
        """c [Pa], φ [°], and where they are wanted c_res, φ_res of the material at ``x``, an array, with samples of so
        many disks.

        Raises campaign.CampaignError and pressing.SampleError where a test fails.
        """
        key = self._key(self.material(x), disks, seeds)
        for trial in self.trials + self.known:
            if trial["key"] == key:
                if trial not in self.trials:
                    self.trials.append(trial)
                return np.array(trial["found"])
        found = self.test(self.material(x), disks, seeds)[: len(self.jacobian)]
        self.trials.append(
            {"key": key, "parameters": self.parameters(x), "disks": disks, "seeds": list(seeds), "found": found}
        )
        write_json(self.out / "trials.json", self.trials)
        named = ", ".join(f"{name} {value:g}" for name, value in self.parameters(x).items())
        residual = f", c_res {1e-3 * found[2]:.1f} kPa, φ_res {found[3]:.2f}°" if len(found) > 2 else ""
        self.say(
            f"trial {len(self.trials)}, {disks} disks: {named} → c {1e-3 * found[0]:.1f} kPa, φ {found[1]:.2f}°{residual}"
        )
        return np.array(found)

    def _key(self, material, disks, seeds):
        """What a trial's strengths depend on."""
        return keys.run_key([dataclasses.asdict(test) for test in self._tests(material, disks, seeds)], __name__)

    @property
    def _strain(self):
        return biaxial_test.BiaxialTest.strain if self.wanted.with_residual else PEAK_STRAIN

    def _tests(self, material, disks, seeds):
        return [
            biaxial_test.BiaxialTest(material, p * self.wanted.cohesion, pressing.Shape(disks, seed), self._strain)
            for seed in seeds
            for p in PRESSURES
        ]

    def test(self, material, disks, seeds):
        """c [Pa], φ [°], and where they are wanted c_res, φ_res of a material, a list, from biaxial tests."""
        folder = self.out / f"trial-{self._key(material, disks, seeds)[:12]}"  # its checkpoints are its own
        measured = campaign.run(
            self._tests(material, disks, seeds), folder, self.threads, self.resume, self._show(disks * len(seeds))
        )
        s = campaign.summarise(material, measured, 0.0, self.threads)
        shutil.rmtree(folder, ignore_errors=True)
        found = [1e3 * s["cohesion_peak_kPa"], s["friction_peak_deg"]]
        return (
            found + [1e3 * s["cohesion_residual_kPa"], s["friction_residual_deg"]]
            if self.wanted.with_residual
            else found
        )

    def _show(self, disks):
        number, before, self._done = len(self.trials) + 1, self._done, self._done + disks
        return lambda share, doing: self.progress(
            min(1.0, (before + share * disks) / self._whole), f"trial {number}: {doing}"
        )

    # ---- how long it takes ----------------------------------------------------------------------
    def timed(self):
        """(seconds that a step takes for each disk of a test, seconds that a test takes besides), measured on this
        machine by short tests under the lowest and the highest pressure, as many at a time as there are threads. Raises
        as :meth:`measure` does."""
        disks, strain = TIMED
        tests = [
            biaxial_test.BiaxialTest(self.material(self.x0), p * self.wanted.cohesion, pressing.Shape(disks, 1), strain)
            for p in (PRESSURES[0], PRESSURES[-1])
        ]
        folder = self.out / "timed"
        pressing.prepare(tests[0].shape, folder / "pressing")
        began = time.monotonic()
        measured = campaign.run(tests, folder, self.threads)
        taken = (time.monotonic() - began) * min(self.threads, len(tests)) / len(tests)
        shutil.rmtree(folder, ignore_errors=True)
        steps = sum(m["wall_steps_s"] for m in measured)
        return steps / sum(m["steps"] * disks for m in measured), max(0.0, taken - steps / len(tests))

    def seconds(self, kinds, timed):
        """Seconds that trials take: ``kinds``, a list of (number of trials, disks, seeds); ``timed``: as :meth:`timed`
        returns it.
        """
        each, start = timed
        steps = self._strain / (biaxial_test.BiaxialTest.inertia * biaxial_test.BiaxialTest.step)
        found = 0.0
        for number, disks, seeds in kinds:
            tests = len(PRESSURES) * len(seeds)
            rounds = math.ceil(tests / min(self.threads, tests))  # on so many threads
            found += number * rounds * (start + disks * steps * each)
        return found

    def _say_how_long(self, coarse, fine, trials):
        """Says how long the search takes at least, and at most; pressing.SampleError for samples that are too small."""
        for disks, seeds in filter(None, (coarse, fine)):
            pressing.Shape(disks, seeds[0]).section()
        timed, unknown = self.timed(), 0 if fine is None else len(self.names)
        least = [(1 + unknown, *coarse)] + ([] if fine is None else [(1, *fine)])
        most = [(trials[0] + unknown, *coarse)] + ([] if fine is None else [(trials[1], *fine)])
        tests = len(PRESSURES) * len(coarse[1])
        sizes = f"{coarse[0]} disks" if fine is None else f"{coarse[0]} and {fine[0]} disks"
        number = [sum(n for n, *_ in kinds) for kinds in (least, most)]
        self.say(
            f"{number[0]} to {number[1]} trials of {tests} tests ({sizes}) on {self.threads} thread{'s' if self.threads > 1 else ''} take about "
            f"{lasting(self.seconds(least, timed))} to {lasting(self.seconds(most, timed))}: measured, a step takes {1e6 * timed[0]:.2g} µs for each disk"
        )

    def misfits(self, found):
        """What a trial misses, in units of SCALE and DEGREES, an array of two or four; ``found``: as :meth:`measure`
        returns it.
        """
        w = self.wanted
        parts = [math.log(max(found[0], 1e-3 * w.cohesion) / w.cohesion) / SCALE, (found[1] - w.friction_deg) / DEGREES]
        if w.with_residual:
            # a residual cohesion near zero is measured to some kPa, not to per cents
            parts += [
                (found[2] - w.residual_cohesion) / (SCALE * w.cohesion),
                (found[3] - w.residual_friction_deg) / DEGREES,
            ]
        return np.array(parts)

    def search(self, disks, seeds, x, trials, enough=1.0):
        """The best of at most ``trials`` trials from ``x`` with samples of one kind: (x, misfits); ends where no misfit
        exceeds ``enough``.

        ``x``: logarithms of the parameters, as :attr:`names` has them. Raises as :meth:`measure` does.
        """
        scale = np.array([1 / SCALE, 1 / DEGREES, 1 / SCALE, 1 / DEGREES])[: len(self.jacobian)]
        best = [None, None]
        low, high = (np.log([BOUNDS[name][k] for name in self.names]) for k in (0, 1))
        # what another kind of samples has taught is mostly their scatter
        self.jacobian, self.last = (self._first_jacobian(), None)

        def residuals(at):
            r = self.misfits(self.measure(at, disks, seeds))
            if self.last is not None:
                step, change = at - self.last[0], (r - self.last[1]) / scale
                if step @ step > LEARN**2:
                    self.jacobian = self.jacobian + np.outer(change - self.jacobian @ step, step) / (step @ step)
            self.last = (at.copy(), r)
            if best[1] is None or r @ r < best[1] @ best[1]:
                best[:] = at.copy(), r
            return r if np.abs(r).max() > enough else np.zeros_like(r)  # the samples tell no more

        least_squares(
            residuals,
            np.clip(x, low + 1e-6, high - 1e-6),
            jac=lambda at: self.jacobian * scale[:, None],
            bounds=(low, high),
            max_nfev=trials,
            ftol=1e-3,
            xtol=1e-3,
        )
        return best[0], best[1]

    def derivatives(self, disks, seeds, x):
        """Derivatives of the strengths, in units of SCALE and DEGREES, by the logarithms of the parameters at ``x``:
        shape (strengths, parameters), from trials.
        """
        here = self.misfits(self.measure(x, disks, seeds))
        high = np.log([BOUNDS[name][1] for name in self.names])
        columns = []
        for k in range(len(x)):
            beside = np.array(x, float)
            beside[k] += PROBE if x[k] + PROBE < high[k] else -PROBE
            # as it was made
            step = math.log(self.parameters(beside)[self.names[k]] / self.parameters(x)[self.names[k]])
            columns.append((self.misfits(self.measure(beside, disks, seeds)) - here) / step)
        return np.column_stack(columns)

    def run(self, coarse, fine=None, trials=(5, 4)):
        """Coarse search, trials for the derivatives there, then a fine search; ``coarse``, ``fine``: (disks, seeds).
        Without ``fine`` a quick search: the coarse samples alone, without the derivatives. Returns the material and a
        report, a dictionary. Says first how long it takes. Raises as :meth:`measure` does.
        """
        quick = fine is None
        self._say_how_long(coarse, fine, trials)
        sizes = [kind[0] * len(kind[1]) for kind in (coarse, fine) if kind]
        derived = 0 if quick else sizes[0] * len(self.names)
        self._whole = sizes[0] * trials[0] + derived + (0 if quick else sizes[1] * trials[1])
        x, misfit = self.search(*coarse, self.x0, trials[0], 1.0 if quick else COARSE)
        certain = {}
        if not quick:
            # what was spared is no work that is left
            self._whole = self._done + derived + sizes[1] * trials[1]
            certain = uniqueness(self.names, self.derivatives(*coarse, x))
            self._whole = self._done + sizes[1] * trials[1]
            x, misfit = self.search(*fine, x, trials[1])
        self.progress(1.0, "found")
        last = coarse if quick else fine
        material = self.material(x)
        found = next(t["found"] for t in self.trials if t["key"] == self._key(material, *last))
        return material, {
            "material": dataclasses.asdict(material),
            "wanted": dataclasses.asdict(self.wanted),
            "found": found,
            "quick": quick,
            "uncertainty_95": uncertainty(*last),
            "misfit_in_tolerances": misfit.tolist(),
            "tolerances": {"cohesion_rel": SCALE, "friction_deg": DEGREES},
            "reached": bool(np.abs(misfit).max() <= 1),
            "trials": self.trials,
            **certain,
            "given": "σ_ext and μ_s follow from c and φ for the given μ_r; another μ_r gives another μ_s with the same peak and another plateau"
            if not self.wanted.with_residual
            else "four parameters from four strengths",
        }


def uncertainty(disks, seeds):
    """How far peak strengths that samples of so many ``disks`` have, one for each of the ``seeds``, may be from the
    mean of all such samples: half of the 95 % intervals, a dictionary with ``cohesion_rel`` and ``friction_deg``.

    Samples scatter as those of the table of rocks do, less or more by the root of the number of disks; with it the
    table's give what the samples of Table 1 have.
    """
    known = rocks.table()["scatter"]
    factor = math.sqrt(known["disks"] / disks / len(seeds))
    return {
        name: half_width(factor * known[of], known["freedom"])
        for name, of in (("cohesion_rel", "cohesion_rel"), ("friction_deg", "friction_angle_deg"))
    } | {"samples": len(seeds), "disks": disks}


def lasting(seconds):
    """A time in words, to two digits: "40 s", "12 min", "2.1 h"."""
    for unit, name in ((3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * unit:
            return f"{seconds / unit:.{0 if seconds >= 9.95 * unit else 1}f} {name}"
    return f"{max(1.0, seconds):.0f} s"


def uniqueness(names, derivatives):
    """What strengths tell about parameters, a dictionary, from :meth:`Calibration.derivatives` (shape (strengths,
    parameters), as many of either).
    """
    _, singular, directions = np.linalg.svd(derivatives)
    errors = np.sqrt(np.diag(np.linalg.pinv(derivatives.T @ derivatives)))
    return {
        "parameters": list(names),
        "sensitivity": derivatives.tolist(),
        "singular_values": singular.tolist(),
        "parameter_error_rel": dict(zip(names, errors.tolist())),
        "least_certain_direction": dict(zip(names, directions[-1].tolist())),
    }
