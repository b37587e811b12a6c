"""What many runs of scenes of spheres say: means over seeds beside the published laws, as a dictionary, tables and
figures.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ... import records
from ...figures import biaxial, spheres as figures, triaxial as tested
from ...measure import power_laws, sphere_laws as laws, triaxial as measures
from ...measure.statistics import over_seeds, told
from ..laboratory import campaign
from . import places
from .grains import SpheresError
from .triaxial import TriaxialTest

__all__ = ["calibrated", "draw", "summarise", "table"]

#: Numbers of each kind that are taken over seeds, with digits and words for tables.
VALUES = {
    "column": (
        ("aspect", 2, "a"),
        ("runout_rel", 2, "run-out"),
        ("runout_95_rel", 2, "of 95 % of the mass"),
        ("final_height_rel", 2, "height"),
        ("repose_deg", 1, "angle [°]"),
    ),
    "hopper": (
        ("rate_rel", 2, "rate [ρ√g d^2.5]"),
        ("beverloo_rel", 2, "Beverloo"),
        ("by_beverloo", 2, "by Beverloo"),
        ("discharged_share", 2, "share out"),
    ),
    "drum": (("tilt_deg", 1, "tilt [°]"), ("tilt_swing_deg", 1, "swing [°]"), ("tilt_surface_deg", 1, "surface [°]")),
    "pile": (("repose_deg", 1, "repose [°]"), ("final_height_rel", 2, "height"), ("lost_spheres", 0, "lost")),
    "triaxial": (
        ("isotropic_solid_fraction", 3, "Φ pressed"),
        ("isotropic_coordination", 2, "z pressed"),
        ("peak_deg", 1, "φ peak [°]"),
        ("critical_deg", 1, "φ critical [°]"),
        ("solid_fraction_end", 3, "Φ end"),
        ("coordination_end", 2, "z end"),
        ("contacts_difference_rel", 3, "contacts by plates − 1"),
    ),
}
#: What tells cases of a kind apart, besides their seeds.
LABELS = {"column": "aspect", "hopper": "opening", "drum": "froude", "pile": None, "triaxial": None}
OTHERS = ("friction", "rolling_friction", "friction_share", "pressure", "inertia")  # ... where they differ


def summarise(found):
    """``summary.json`` of {name: numbers of a run}: the ``runs``; ``groups``: runs that differ by their seeds alone,
    each with ``asked`` (its parameters), ``seeds``, ``world`` and means over the seeds with half of their 95 %
    interval; of columns ``fits`` of run-out and height; of triaxial tests under several pressures ``envelopes``;
    ``tables`` for documentation pages.
    """
    if not found:
        raise SpheresError("there are no runs: give one or more")
    groups = _groups(found)
    summary = {"kind": _kind(found), "runs": found, "groups": groups}
    if summary["kind"] == "column":
        summary["fits"] = _fits(found)
    if summary["kind"] == "triaxial":
        summary["envelopes"] = _envelopes(found)
    summary["tables"] = _tables(summary)
    return summary


def _kind(found):
    return next(iter(found.values()))["scene"]["kind"]


def _groups(found):
    by = {}
    for one in found.values():
        asked = {key: value for key, value in one["scene"].items() if key != "seed"}
        by.setdefault(
            (tuple(sorted(asked.items())), one["world"], tuple(map(str, one["settings"].items()))), []
        ).append(one)
    made = []
    for (asked, world, _), runs in by.items():
        group = {"asked": dict(asked), "world": world, "seeds": [one["scene"]["seed"] for one in runs]}
        group["spheres"] = round(float(np.mean([one["spheres"] for one in runs])))
        group["ended"] = sum(one["ended"] for one in runs)
        group |= {name: over_seeds([one[name] for one in runs]) for name, _, _ in VALUES[_kind(found)]}
        group["overlap_worst_rel"] = max(one["overlap_worst_rel"] for one in runs)
        group["steps"] = over_seeds([one["steps"] for one in runs])
        group["wall_s"] = over_seeds([one["wall_s"] for one in runs])
        made.append(group)
    return made


def _fits(found):
    """Power laws of the run-out below and above the aspect ratio where the law of Lube et al. changes, and of the
    height above; None where there are too few aspect ratios.
    """
    fits = {}
    for name, key, law in (("runout", "runout_rel", laws.RUNOUT[0]), ("height", "final_height_rel", laws.HEIGHT[0])):
        ended = [one for one in found.values() if one["ended"] and one[key] is not None]
        a, values = ([one[what] for one in ended] for what in ("aspect", key))
        try:
            pair = power_laws.exponents(a, values, law.change) if ended else (None, None)
        except power_laws.PowerLawError:  # one that did not spread
            pair = (None, None)
        for where, fit, (factor, exponent) in zip(("below", "above"), pair, law.pieces):
            fits[f"{name}_{where}"] = (
                None
                if fit is None
                else {
                    **fit.plain(),
                    "change": law.change,
                    "published_factor": factor,
                    "published_exponent": exponent,
                    "source": law.source,
                }
            )
    return fits


def _envelopes(found):
    """Of triaxial tests that differ by pressure and seed alone, under two pressures or more: a list of the laboratory's
    summaries, see :func:`.laboratory.campaign.summarise`, each with what was ``asked`` and the ``world``.
    """
    by = {}
    for one in found.values():
        asked = {key: value for key, value in one["scene"].items() if key not in ("seed", "pressure", "kind")}
        by.setdefault((tuple(sorted(asked.items())), one["world"]), []).append(one)
    made = []
    for (asked, world), runs in by.items():
        if len({one["scene"]["pressure"] for one in runs}) > 1:
            material = TriaxialTest(**dict(asked)).material()
            whole = campaign.summarise(material, [_circles(one) for one in runs])
            made.append({"asked": dict(asked), "world": world} | whole)
    return made


def _circles(one):
    """A run's circles of the peak and of the critical state, as the laboratory has them."""
    strain = one["scene"]["strain"]
    return {
        "confining_Pa": one["scene"]["pressure"],
        "seed": one["scene"]["seed"],
        "residual_between_strains": (measures.PLATEAU * strain, strain),
        **{f"sigma{k}_peak_Pa": one[f"sigma{k}_peak_Pa"] for k in (1, 3)},
        **{f"sigma{k}_residual_Pa": one[f"sigma{k}_critical_Pa"] for k in (1, 3)},
    }


def calibrated(summary, angle):
    """The friction with which the critical state of triaxial tests has an ``angle`` [°], for each set of a
    :func:`summarise` that differs by friction and seed alone: a list of what was ``asked``, the ``world``, ``angle_deg``
    and ``friction``, None where the tests do not have the angle between them.
    """
    by = {}
    for group in summary["groups"]:
        asked = {key: value for key, value in group["asked"].items() if key != "friction"}
        by.setdefault((tuple(sorted(asked.items())), group["world"]), []).append(group)
    return [
        {
            "asked": dict(asked),
            "world": world,
            "angle_deg": angle,
            "friction": measures.friction_at(
                [group["asked"]["friction"] for group in groups],
                [group["critical_deg"]["mean"] for group in groups],
                angle,
            ),
        }
        for (asked, world), groups in by.items()
    ]


def _label(group, groups):
    asked = group["asked"]
    names = [LABELS[asked["kind"]]] if LABELS[asked["kind"]] else []
    names += [n for n in OTHERS if len({one["asked"].get(n) for one in groups}) > 1]
    names = names or ["friction"]
    words = [f"{name.replace('_', ' ')} {asked[name]:g}" for name in names]
    if len({one["world"] for one in groups}) > 1:
        words.append(group["world"])
    return ", ".join(words)


def _tables(summary):
    """[title, header, rows of texts]."""
    groups, kind = summary["groups"], summary["kind"]
    header = [
        "case",
        "spheres",
        "seeds",
        *(words for _, _, words in VALUES[kind]),
        "worst overlap [ℓ]",
        "wall time [s]",
    ]
    if kind == "column":
        header[-2:-2] = [f"{law.source.split(' (')[0]}" for law in laws.RUNOUT]
    rows = []
    for group in groups:
        row = [_label(group, groups), str(group["spheres"]), str(len(group["seeds"]))]
        row += [told(group[name]["mean"], group[name]["half_width"], digits) for name, digits, _ in VALUES[kind]]
        if kind == "column":
            row += [f"{float(law(group['aspect']['mean'])):.2f}" for law in laws.RUNOUT]
        row += [f"{group['overlap_worst_rel']:.1e}", told(group["wall_s"]["mean"], None, 0)]
        rows.append(row)
    names = {"column": "Columns", "hopper": "Hoppers", "drum": "Drums", "pile": "Piles", "triaxial": "Triaxial tests"}
    return [[f"{names[kind]}: means over seeds with half of their 95 % intervals", header, rows]]


def table(summary):
    """The groups, and the fits of columns, as text."""
    from tabulate import tabulate

    lines = [tabulate(rows, headers=header) for _, header, rows in summary["tables"]]
    for where, fit in summary.get("fits", {}).items():
        if fit:
            sure = "" if fit["exponent_95"] is None else f" ± {fit['exponent_95']:.2f}"
            name, side = where.split("_")
            lines.append(
                f"{name} {side} a = {fit['change']:g}: {fit['factor']:.2f} a^({fit['exponent']:.3f}{sure}), {fit['points']} runs. {fit['source']}: {fit['published_factor']:g} a^{fit['published_exponent']:.3g}"
            )
    edgeless = [name for name, one in summary["runs"].items() if one.get("runout_rel", 0) is None]
    if edgeless:
        lines.append(
            f"no run-out, as the mass is nowhere half a mean diameter high: {', '.join(edgeless)} (without friction it spreads without end)"
        )
    for one in summary.get("envelopes", ()):
        for kind, words in (("peak", "peak"), ("residual", "critical state")):
            if one[f"friction_{kind}_deg"] is not None:
                lines.append(
                    f"friction {one['asked']['friction']:g}, {one['world']}, envelope of the {words}: c′ = {one[f'cohesion_{kind}_kPa']:.2g} kPa, φ′ = {one[f'friction_{kind}_deg']:.1f}°"
                )
    for one in summary.get("calibration", ()):
        found = "give more of --friction" if one["friction"] is None else f"friction {one['friction']:.3g}"
        lines.append(f"critical state of {one['angle_deg']:g}°, {one['world']}: {found}")
    unended = [name for name, one in summary["runs"].items() if not one["ended"] and summary["kind"] != "drum"]
    if unended:
        lines.append(f"did not come to their end: {', '.join(unended)}")
    return "\n".join(lines)


def draw(summary, out):
    """Figures of a study in the folder ``out``: of each run ``runs/NAME/course.png``, and of all of them KIND.png where
    there is something to compare; returns their paths.
    """
    out, kind, drawn = Path(out), summary["kind"], []
    for name, one in summary["runs"].items():
        folder = out / "runs" / name
        seen = places.read_all(folder)
        drawn.append(figures.course(seen, one, folder / "course.png"))
    if kind == "column" and len({group["asked"]["aspect"] for group in summary["groups"]}) > 1:
        drawn.append(figures.runout(summary["groups"], out / "column.png"))
    if kind == "hopper":
        series = {name: records.read_series(out / "runs" / name / "series.csv") for name in summary["runs"]}
        drawn.append(figures.discharge(series, summary, out / "hopper.png"))
    if kind == "drum":
        series = {name: records.read_series(out / "runs" / name / "series.csv") for name in summary["runs"]}
        drawn.append(figures.tilts(series, summary, out / "drum.png"))
    if kind == "pile" and len(summary["groups"]) > 1:
        drawn.append(figures.reposes(summary["groups"], out / "pile.png"))
    if kind == "triaxial":
        series = {name: records.read_series(out / "runs" / name / "series.csv") for name in summary["runs"]}
        drawn.append(tested.curves(series, summary, out / "triaxial_curves.png"))
        if len({group["asked"]["friction"] for group in summary["groups"]}) > 1:
            drawn.append(tested.angles(summary["groups"], out / "triaxial.png"))
        for k, one in enumerate(summary["envelopes"]):
            drawn.append(biaxial.mohr(one, out / f"envelope{k + 1 if k else ''}.png"))
    return drawn
