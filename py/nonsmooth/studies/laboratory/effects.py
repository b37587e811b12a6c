"""What a biaxial test depends on besides the material: size of the sample, size of the disks, rate of loading and time
step.

The strength is the apparent angle of friction, sin φ = (σ₁ − σ₃)/(σ₁ + σ₃), of the peak and of the plateau under one
pressure. Of homothetic samples of one material Taboada and Estrada (2009, section 3.2.2) expect similar results; what
the rate and the step change is numerics.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path

from ...measure import strength
from ...measure.statistics import Estimate, over_seeds, told
from . import biaxial_test, campaign
from .pressing import Shape

__all__ = ["COUNT", "PRESSURE", "Effect", "effects", "run", "table"]

PRESSURE = 8e6  # Pa, of the paper's Figures 9 and 10
COUNT = 2000  # disks, where the size of the sample is not what varies


@dataclass(frozen=True)
class Effect:
    """A number that is varied: its ``name`` for folders, what it is in words, its values with their tests (dictionary),
    and the usual value.
    """

    name: str
    label: str
    tests: dict
    usual: float


def effects(material, seeds, count=COUNT, pressure=PRESSURE, **options):
    """The Effects that are looked at, each value with one BiaxialTest for each seed. ``options``: fields of BiaxialTest
    for all.
    """
    usual = biaxial_test.BiaxialTest(material, pressure, Shape(count, 0), **options)

    def tests(values, change):
        return {
            v: [change(dataclasses.replace(usual, shape=dataclasses.replace(usual.shape, seed=s)), v) for s in seeds]
            for v in values
        }

    def shaped(test, **fields):
        return dataclasses.replace(test, shape=dataclasses.replace(test.shape, **fields))

    return [
        Effect(
            "disks",
            "disks of the sample",
            tests([count // 4, count // 2, count, 2 * count], lambda t, n: shaped(t, count=n)),
            count,
        ),
        Effect(
            "diameter",
            "mean diameter [m]",
            tests([0.2, 2.0, 20.0], lambda t, d: shaped(t, d_min=d / 2, d_max=2 * d)),
            2.0,
        ),
        Effect(
            "inertia",
            "inertial number of the loading",
            tests(
                [4 * usual.inertia, 2 * usual.inertia, usual.inertia, usual.inertia / 2],
                lambda t, i: dataclasses.replace(t, inertia=i),
            ),
            usual.inertia,
        ),
        Effect(
            "step",
            "time step [t_i]",
            tests([2 * usual.step, usual.step, usual.step / 2], lambda t, h: dataclasses.replace(t, step=h)),
            usual.step,
        ),
    ]


def run(chosen, out, threads, resume=False, progress=lambda share, doing: None):
    """Runs the tests of Effects below ``out``; those that several effects share are run once. Returns rows, a list of
    dictionaries.

    A row has ``effect``, ``label``, ``value``, ``usual`` (bool), and for "peak" and "residual" ``…_deg`` (a list, one a
    seed), its ``…_mean_deg`` with
    ``…_95_deg`` (half of the 95 % interval over seeds, None for one seed), and ``…_change_rel``: mean relative change
    of σ₁ from the usual value, seed by seed, with half of its 95 % interval, ``…_change_95_rel``. ``fluctuation_rel``,
    ``fluctuation_95_rel`` and ``fluctuation_each_rel``: of the stress on the plateau (:mod:`fluctuations`), None where
    it is too short.
    """
    wanted = [(effect, value, group) for effect in chosen for value, group in effect.tests.items()]
    whole, done, known, rows = sum(_work(g) for _, _, g in wanted), 0.0, {}, []
    for effect, value, group in wanted:
        key = tuple(map(biaxial_test.key_of, group))
        if key not in known:
            size = _work(group)
            known[key] = campaign.run(
                group,
                Path(out) / f"{effect.name}-{value:g}",
                threads,
                resume,
                lambda share, doing, d=done, s=size: progress(
                    (d + s * share) / whole, f"{effect.label} {value:g}: {doing}"
                ),
            )
        done += _work(group)
        rows.append((effect, value, known[key]))
    return [
        _row(effect, value, measured, next(m for e, v, m in rows if e is effect and v == effect.usual))
        for effect, value, measured in rows
    ]


def _work(group):
    """About what tests cost: disks times steps."""
    return sum(t.shape.count * t.strain / (t.inertia * t.step) for t in group)


def _row(effect, value, measured, usual):
    row = {
        "effect": effect.name,
        "label": effect.label,
        "value": value,
        "usual": value == effect.usual,
        "seeds": [m["seed"] for m in measured],
        "wall_s": [m["wall_s"] for m in measured],
    }
    for kind in ("peak", "residual"):
        angles = [strength.apparent_deg(m[f"sigma3_{kind}_Pa"], m[f"sigma1_{kind}_Pa"]) for m in measured]
        change = [a[f"sigma1_{kind}_Pa"] / b[f"sigma1_{kind}_Pa"] - 1 for a, b in zip(measured, usual)]
        of_angle, of_change = Estimate.of(angles), Estimate.of(change)
        row |= {
            f"{kind}_deg": angles,
            f"{kind}_mean_deg": of_angle.mean,
            f"{kind}_95_deg": campaign.number(of_angle.half_width),
            f"{kind}_change_rel": of_change.mean,
            f"{kind}_change_95_rel": campaign.number(of_change.half_width),
        }
    swings = [m["stress_fluctuation_rel"] for m in measured]
    mean = over_seeds(swings)
    return row | {
        "fluctuation_each_rel": swings,
        "fluctuation_rel": mean["mean"],
        "fluctuation_95_rel": mean["half_width"],
    }


def table(rows):
    """(heads, lines) of texts for what :func:`run` returned: a line for each value."""
    heads = [
        "",
        "value",
        "peak φ [°]",
        "change of σ₁ [%]",
        "plateau φ [°]",
        "change of σ₁ [%]",
        "fluctuation of σ₁ [%]",
    ]
    lines = []
    for row in rows:
        line = [row["label"], f"{row['value']:g}" + (" (usual)" if row["usual"] else "")]
        for kind in ("peak", "residual"):
            line.append(told(row[f"{kind}_mean_deg"], row[f"{kind}_95_deg"], 1))
            line.append(
                "" if row["usual"] else told(row[f"{kind}_change_rel"], row[f"{kind}_change_95_rel"], 1, 100, "+")
            )
        lines.append([*line, told(row["fluctuation_rel"], row["fluctuation_95_rel"], 1, 100)])
    return heads, lines
