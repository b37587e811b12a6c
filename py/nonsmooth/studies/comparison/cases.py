"""One run of a comparison, and the plan: which runs answer what.

The plan has five parts, all on the packing of the first seed but the first:

* ensemble: every seed, hard with the section's own numerics and soft with the ensemble's stiffness, in pairs of the
  same packing. It tells difference from scatter;
* sweep: all other stiffnesses, each with its own stable step. Soft runs cost with the root of the stiffness, so one
  seed has to do;
* numerics: hard runs with other time steps and tolerances, the finest of which is the reference of the hard world. The
  stiffest soft run is the reference of the soft one;
* bonds: a soft run whose bonds break at once where they reach a threshold, as YADE's do, instead of yielding there as
  in the hard law;
* damping: a soft run of the ensemble's stiffness whose damping stays what it was at rest, to show what damping does to
  the motion.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

from ...errors import UserError

__all__ = ["Case", "CaseError", "ComparisonPlan", "check_soft", "moduli_of", "modulus_label", "plan", "work_of"]

#: Time step and tolerance of hard runs, as multiples of the section's, coarse to fine; the last is the reference.
HARD_NUMERICS = ((2.0, 10.0), (2.0, 1.0), (1.0, 10.0), (0.5, 0.5))


class CaseError(UserError, RuntimeError):
    """A comparison that cannot be made; the message says why and what helps."""


def modulus_label(modulus):
    """Young's modulus [Pa] in words: "E = 100 MPa"."""
    if modulus is None:
        return "E not known"
    factor, prefix = next((f, p) for f, p in ((1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k"), (0, "")) if modulus >= f)
    return f"E = {modulus / (factor or 1):.3g} {prefix}Pa"


def moduli_of(stiffnesses, least=1):
    """Young's moduli [Pa], sorted, each once. Raises CaseError for one that is no number above 0, and for fewer
    than ``least``.
    """
    chosen = sorted(set(map(float, stiffnesses)))
    told = ", ".join(f"{e:g}" for e in chosen) or "nothing"
    if not all(0 < e < math.inf for e in chosen):
        raise CaseError(f"--stiffness {told}: give Young's moduli above 0 [Pa]")
    if len(chosen) < least:
        raise CaseError(
            f"--stiffness {told}: give {least} Young's moduli or more, or nothing can be said of their effect"
        )
    return chosen


def check_soft(damping, damping_moving, step_share):
    """Raises CaseError for dampings (``damping_moving`` may be None) and a share of the stable step that soft
    runs cannot have.
    """
    for key, value in (("--damping", damping), ("--damping-moving", damping_moving)):
        if value is not None and not 0 <= value < 1:
            raise CaseError(f"{key} {value:g}: give a number from 0 to less than 1")
    if not 0 < step_share <= 1:
        raise CaseError(f"--step-share {step_share:g}: give a number above 0, and no more than 1, the stability limit")


@dataclass(frozen=True)
class Case:
    """One run. ``world``: "hard" or "soft"; ``source``: section or material of the scenario; ``disks``: their number;
    ``seed``: of the packing.

    Hard: ``step``, ``tolerance``: factors on the scenario's own. Soft: ``stiffness``: Young's modulus [Pa]; ``step``:
    share of the stability limit; ``damping``, ``damping_moving``: non-viscous, at rest and while the mass moves (None:
    not told apart); ``model``: see :mod:`yade.nonsmooth.soft` (None: of spheres, which have one law); ``fragile``: bonds do not yield before they break.
    ``options``: what else the scenario takes.
    """

    world: str
    source: str
    disks: int
    seed: int
    step: float = 1.0
    tolerance: float = 1.0
    stiffness: float | None = None
    damping: float = 0.0
    damping_moving: float | None = None
    model: str | None = None
    fragile: bool = False
    options: dict = dataclasses.field(default_factory=dict)

    @property
    def name(self):
        """Name of the run's folder: what tells it from the others of a plan."""
        if self.world == "soft":
            extra = ("" if self.damping != self.damping_moving else f"-damping{self.damping:g}") + (
                "-fragile" if self.fragile else ""
            )
            return f"soft-{self.stiffness:.3g}Pa-seed{self.seed}{extra}".replace("+", "")
        return f"hard-step{self.step:g}-tolerance{self.tolerance:g}-seed{self.seed}"

    @property
    def label(self):
        """The same in words, without the seed."""
        if self.world == "soft":
            constant = f", damping {self.damping:g} throughout" if self.damping == self.damping_moving else ""
            return f"soft, {modulus_label(self.stiffness)}{constant}" + (", fragile bonds" if self.fragile else "")
        changed = [
            f"{name} × {factor:g}"
            for name, factor in (("step", self.step), ("tolerance", self.tolerance))
            if factor != 1
        ]
        return ", ".join(["hard", *changed])


@dataclass(frozen=True)
class ComparisonPlan:
    """Cases by what they are for; a case may serve several ends. ``ensemble``: pairs (hard, soft), one a seed."""

    ensemble: tuple[tuple[Case, Case], ...]
    sweep: tuple[Case, ...]
    numerics: tuple[Case, ...]
    damping: Case | None
    fragile: Case | None = None

    @property
    def cases(self):
        """All of them, once each."""
        pairs = [c for pair in self.ensemble for c in pair]
        return list(
            dict.fromkeys((*self.sweep, *self.numerics, *(c for c in (self.damping, self.fragile) if c), *pairs))
        )


def work_of(case):
    """Wall time to be expected, in units of the hard run's: a guess, for the order of runs and the progress bar."""
    if case.world == "soft":
        return (case.stiffness / 3e8) ** 0.5
    return 1 / case.step / case.tolerance**0.3


def plan(
    source,
    disks,
    seeds,
    stiffnesses,
    damping=0.2,
    damping_moving=0.02,
    step_share=0.8,
    ensemble=None,
    numerics=HARD_NUMERICS,
    damping_run=True,
    model="cohesion_moment",
    fragile=False,
    bonds_run=False,
    options=None,
) -> ComparisonPlan:
    """The runs of a comparison.

    ``stiffnesses``: Young's moduli [Pa]; ``ensemble``: the one of the ensemble (default: the upper of the middle ones);
    ``numerics``: pairs as HARD_NUMERICS; ``fragile``: of the soft bonds; ``bonds_run``: with one soft run of the other
    kind of bonds. Raises CaseError for lists and numbers that cannot be used.
    """
    chosen = moduli_of(stiffnesses, 2)
    if not seeds or len(set(seeds)) < len(seeds) or min(seeds) < 0:
        raise CaseError(
            f"--seeds {' '.join(map(str, seeds)) or 'nothing'}: give whole numbers from 0, each once, and one at least"
        )
    check_soft(damping, damping_moving, step_share)
    if ensemble is not None and not 0 < ensemble < math.inf:
        raise CaseError(f"--ensemble-stiffness {ensemble:g}: give a Young's modulus above 0 [Pa]")
    middle = float(ensemble) if ensemble is not None else chosen[len(chosen) // 2]
    if middle not in chosen:
        chosen = sorted((*chosen, middle))

    def soft(stiffness, seed, moving=damping_moving, fragile=fragile):
        return Case(
            "soft",
            source,
            disks,
            seed,
            step_share,
            stiffness=stiffness,
            damping=damping,
            damping_moving=moving,
            model=model,
            fragile=fragile,
            options=_Options(options or {}),
        )

    def hard(seed, step=1.0, tolerance=1.0):
        return Case("hard", source, disks, seed, step, tolerance, options=_Options(options or {}))

    first = seeds[0]
    return ComparisonPlan(
        tuple((hard(seed), soft(middle, seed)) for seed in seeds),
        tuple(soft(e, first) for e in chosen),
        (*(hard(first, *pair) for pair in numerics[:-1]), hard(first), *(hard(first, *pair) for pair in numerics[-1:])),
        soft(middle, first, damping) if damping_run and damping_moving not in (None, damping) else None,
        soft(middle, first, fragile=True) if bonds_run and not fragile and model == "cohesion_moment" else None,
    )


class _Options(dict):
    """A dictionary that a frozen case can be hashed with."""

    def __hash__(self):
        return hash(tuple(sorted(self.items())))
