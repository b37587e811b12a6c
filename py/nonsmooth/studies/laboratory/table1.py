"""The macroscopic strengths of the paper's Table 1 beside ours: of the rock, by biaxial tests, and of the walls, by
slides on them. Needs no YADE.

Taboada and Estrada (2009), sections 5.2 and 5.3, Table 1. DP is shipped without bonds, as section 5.3 calls it
cohesionless; its row of the table is also measured with bonds of the 100 kPa that the table gives it.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path

from ...measure import statistics
from ...model import materials
from . import biaxial_test, campaign, pressing, wall_shear

__all__ = ["PAPER", "rows", "run", "table"]

#: {row: {figure: value}}: cohesion [kPa] and friction [°], peak and residual; what the table leaves open is not there.
PAPER = {
    "WWR": {"cohesion_peak": 88.0, "friction_peak": 38.5, "cohesion_residual": 13.0, "friction_residual": 26.2},
    "DP": {"friction_peak": 16.7, "cohesion_residual": 0.0, "friction_residual": 16.7},
    "DP, bonded": {"cohesion_peak": 30.0, "friction_peak": 16.7, "cohesion_residual": 0.0, "friction_residual": 16.7},
    "FB": {"cohesion_peak": 70.0, "friction_peak": 35.0, "cohesion_residual": 0.0, "friction_residual": 26.6},
    "SS": {"cohesion_residual": 0.0, "friction_residual": 11.3},
}
FIGURES = {
    "cohesion_peak": "peak cohesion [kPa]",
    "friction_peak": "peak friction [°]",
    "cohesion_residual": "residual cohesion [kPa]",
    "friction_residual": "residual friction [°]",
}
BONDED = 1e5  # Pa, of DP's bonds in Table 1


def walls():
    """{row: Material} of the walls that are slid on."""
    dp, fb, ss = (materials.load(name) for name in ("dp", "fb", "ss"))
    return {
        "DP": dp,
        "DP, bonded": dataclasses.replace(dp, name="dp-bonded", bonded=True, tensile_strength=BONDED),
        "FB": fb,
        "SS": ss,
    }


def run(
    out,
    disks,
    seeds,
    pressures,
    slide_seeds,
    slide_pressures,
    strain=biaxial_test.BiaxialTest.strain,
    material="wwr",
    threads=1,
    resume=False,
    progress=lambda share, doing: None,
):
    """Makes all tests below the folder ``out``, and returns what JSON can hold: ``rock`` (campaign.summarise),
    ``walls`` {row: [wall_shear.strength_of, one a seed]}, and ``rows`` (see :func:`rows`).

    ``disks``: of a sample; ``seeds``, ``pressures`` [Pa]: of the biaxial tests, which go to ``strain``;
    ``slide_seeds``, ``slide_pressures`` [Pa]: of the slides. ``progress``: called with the share done and what is being
    done. Raises what campaign.run and wall_shear.run raise.
    """
    out, rock = Path(out), materials.load(material)
    tests = [
        biaxial_test.BiaxialTest(rock, p, pressing.Shape(disks, seed), strain)
        for seed in seeds
        for p in sorted(pressures)
    ]
    measured = campaign.run(tests, out / "rock", threads, resume, lambda share, doing: progress(0.9 * share, doing))
    groups = {
        row: [[wall_shear.SlideTest(m, p, seed) for p in slide_pressures] for seed in slide_seeds]
        for row, m in walls().items()
    }
    flat = [test for one in groups.values() for group in one for test in group]
    slides = iter(
        wall_shear.run(flat, out / "walls", threads, resume, lambda share, doing: progress(0.9 + 0.1 * share, doing))
    )
    told = {
        "disks": disks,
        "seeds": list(seeds),
        "pressures_Pa": sorted(pressures),
        "slide_seeds": list(slide_seeds),
        "slide_pressures_Pa": list(slide_pressures),
        "rock": campaign.summarise(rock, measured, threads=threads),
        "walls": {
            row: [wall_shear.strength_of(group, [next(slides) for _ in group]) for group in one]
            for row, one in groups.items()
        },
    }
    return told | {"rows": rows(told)}


def rows(told):
    """[{"row", "figure", "mean", "half_95", "paper"}] of what :func:`run` found, in the order of Table 1; half of the
    95 % interval over seeds is None for one seed, ``paper`` None where the table leaves it open, ``mean`` where it was
    not measured."""
    found = []
    for row, paper in PAPER.items():
        for figure in FIGURES:
            unit = "kPa" if figure.startswith("cohesion") else "deg"
            if row == "WWR":
                mean, half = (told["rock"].get(f"{figure}{middle}_{unit}") for middle in ("", "_95"))
            else:
                values = statistics.Estimate.of([one[f"{figure}_{unit}"] for one in told["walls"][row]])
                mean, half = values.mean, campaign.number(values.half_width)
            found.append({"row": row, "figure": figure, "mean": mean, "half_95": half, "paper": paper.get(figure)})
    return found


def table(found):
    """(heads, rows) of texts for what :func:`rows` returned: a line for each row of Table 1."""

    def text(one):
        if one["mean"] is None:
            return "not measured"
        return (
            f"{round(one['mean'], 1) + 0.0:.1f}"
            + ("" if one["half_95"] is None else f" ± {one['half_95']:.1f}")
            + (" (–)" if one["paper"] is None else f" ({one['paper']:g})")
        )

    return ["", *(f"{name}, ours (paper)" for name in FIGURES.values())], [
        [row, *(text(one) for one in found if one["row"] == row)] for row in PAPER
    ]
