"""What a study of columns or piles says: fitted exponents beside the published ones, as a dictionary, a table and
figures.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ...figures import columns as figures, spreading
from ...measure import heap as measures, power_laws as scaling, velocity_profiles
from ...measure.statistics import told
from . import profiles, study

__all__ = [
    "CHANGES",
    "by_front",
    "counts",
    "draw_collapse",
    "draw_profiles",
    "film_collapse",
    "group",
    "profiles_by_aspect",
    "profiles_table",
    "summarise",
    "table",
]

#: Aspect ratios between the two fits: where Staron and Hinch's laws change.
CHANGES = {"runout": scaling.RUNOUT[0].change, "height": scaling.HEIGHT[0].change}
GAPS, SHARES = (0.005, 0.01, 0.05, 0.2, 0.5), (0.95, 0.99)  # of other fronts
_VALUES = {"runout": "runout_rel", "height": "final_height_rel"}


def _arrays(found):
    runs = [run for run in found.values() if run["rested"]]
    return np.array([run["aspect"] for run in runs]), {
        name: np.array([run[key] for run in runs]) for name, key in _VALUES.items()
    }


def _fits(found):
    a, values = _arrays(found)
    fits = {}
    for name, change in CHANGES.items():
        try:
            fits[name] = scaling.exponents(a, values[name], change)
        except scaling.PowerLawError:  # a front that did not leave the gate
            fits[name] = (None, None)
    return fits


def summarise(found):
    """``summary.json`` of {name: summary of a run}: the runs, each with the ``disks`` that it has, ``disks_fewest`` of
    all of them, and ``fits`` of runout and height below and above the aspect ratios :data:`CHANGES`.

    A fit has ``factor``, ``exponent`` with half of its 95 % interval, the numbers of ``points``, and ``published`` with
    ``off_rel``, the exponent's relative difference from each published one. Runs that did not come to rest are left
    out.
    """
    fits = {}
    for name, pair in _fits(found).items():
        laws = scaling.RUNOUT if name == "runout" else scaling.HEIGHT
        for k, fit in enumerate(pair):
            where = f"{name}_{'above' if k else 'below'}"
            fits[where] = (
                None
                if fit is None
                else {
                    **fit.plain(),
                    "change": CHANGES[name],
                    "published": [
                        {
                            "source": law.source,
                            "factor": law.pieces[k][0],
                            "exponent": law.pieces[k][1],
                            "off_rel": fit.exponent / law.pieces[k][1] - 1,
                        }
                        for law in laws
                    ],
                }
            )
    return {
        "runs": found,
        "fits": fits,
        "at_rest": sum(run["rested"] for run in found.values()),
        "disks_fewest": min(run["disks"] for run in found.values()),
    }


def counts(found):
    """How many disks the runs have, in words: "2000 disks", or the fewest and the most."""
    fewest, most = (pick(run["disks"] for run in found.values()) for pick in (min, max))
    return f"{fewest} disks" if fewest == most else f"{fewest} to {most} disks"


def by_front(found, folders):
    """Exponents of the runout for other fronts, a list of dictionaries with ``front`` in words, ``below`` and ``above``
    (None where there is no fit).

    ``folders``: {name: folder of the run}. Fronts: the connected mass over other gaps than :data:`measures.TOUCH`, and
    the x that holds a share of the disks' area.
    """
    a, rows = [], []
    for name, run in found.items():
        if not run["rested"]:
            continue
        _, places, r = study.frames(folders[name])
        (x, y), place, width = places[-1], places[0][0].min() - r[places[0][0].argmin()], run["width_m"]
        order = np.argsort(x)
        share = np.cumsum(r[order] ** 2) / np.sum(r**2)
        a.append(run["aspect"])
        rows.append(
            [(measures.fronts(x, r, measures.connected(x, y, r, gap))[1] - place) / width - 1 for gap in GAPS]
            + [(x[order][np.searchsorted(share, q)] - place) / width - 1 for q in SHARES]
        )
    names = [f"gaps below {100 * g:g} % of a diameter" for g in GAPS] + [f"{100 * q:g} % of the mass" for q in SHARES]
    found = []
    for k, name in enumerate(names):
        values = np.array([row[k] for row in rows])
        fits = scaling.exponents(a, values, CHANGES["runout"]) if (values > 0).all() else (None, None)
        found.append(
            {"front": name, **{side: None if f is None else f.exponent for side, f in zip(("below", "above"), fits)}}
        )
    return found


SHOWN = 1  # of profiles.AT: the time whose picture stands beside the profiles
PIECES = 30  # of a column's length, of each of which the border of what rests is drawn


def _by_aspect(cases):
    """{aspect ratio asked for: names of the runs, one a seed}."""
    found = {}
    for name, (heap, _) in cases.items():
        found.setdefault(heap.aspect, []).append(name)
    return found


def profiles_by_aspect(cases, found, folders):
    """Profiles of speed of columns that came to rest (profiles.over_runs), a list of dictionaries with ``aspect``, that
    of the box, ``seeds``, how many, and ``rows``.

    ``cases``: {name: (heap, world)}; ``found``: {name: summary of a run}; ``folders``: {name: its folder}. Raises
    HeapError where a run kept no places.
    """
    made = []
    for aspect, names in _by_aspect(cases).items():
        rested = [(cases[name][0], found[name], folders[name]) for name in names if found[name]["rested"]]
        if rested:
            made.append({"aspect": aspect, "seeds": len(rested), "rows": profiles.over_runs(rested)})
    return made


def profiles_table(by_aspect):
    """[caption, heads, rows] of texts: the regimes of what :func:`profiles_by_aspect` returned, with the share of the
    height that rests, by time and place.
    """
    rows = []
    for one in by_aspect:
        for row in one["rows"]:
            cells = []
            for place in row["places"]:
                kinds = sorted(place["regimes"].items(), key=lambda item: -item[1])
                cells.append(
                    ", ".join(name if n == one["seeds"] else f"{name} ({n})" for name, n in kinds) or "no disks"
                )
                rest = place.get("border_rel")
                cells[-1] += f"; {told(rest['mean'], rest['half_width'], 2)}" if rest else ""
            rows.append(
                [
                    f"{one['aspect']:g}",
                    f"{row['at']:g}",
                    told(row["time_rel"]["mean"], row["time_rel"]["half_width"], 1),
                    *cells,
                ]
            )
    heads = [
        "a",
        "run-out done",
        "time [T]",
        *(f"{100 * share:g} % of the way from the tip" for share in profiles.BEHIND),
    ]
    return ["Regimes (seeds, where they differ) and the share of the height that rests", heads, rows]


def draw_profiles(by_aspect, cases, found, folders, path=None):
    """The figure of what :func:`profiles_by_aspect` returned, with the same arguments: the matplotlib Figure, or the
    ``path`` that it is written to.
    """
    drawn = []
    for one in by_aspect:
        name = next(name for name in _by_aspect(cases)[one["aspect"]] if found[name]["rested"])
        heap, run, film = cases[name][0], found[name], study.film(folders[name])
        seen = profiles.looks(film, heap.place(), run["runout_rel"], run["width_m"], profiles.AT[SHOWN])
        look, r, layer = seen[len(seen) // 2], film[2], heap.mean_diameter()
        speed = math.sqrt(heap.gravity * run["height_m"])
        edges = np.linspace(0, look.tip, PIECES + 1)
        height = velocity_profiles.borders(
            look.x, look.y, r, look.u, edges, layer, profiles.slowest(heap.gravity, layer)
        )
        drawn.append(
            {**one, "shown": SHOWN, "look": look, "r": r, "width": run["width_m"], "speed": speed, "border": (0.5 * (edges[1:] + edges[:-1]), height)}
        )  # fmt: skip
    return spreading.profiles(drawn, path)


def group(found):
    """A group for :func:`yade.nonsmooth.figures.columns.runout`."""
    a, values = _arrays(found)
    return {"aspect": a, **values, "fits": _fits(found), "changes": CHANGES}


def table(found, summary):
    """The runs and the fits as text."""
    lines = [
        "run                    disks      a   runout/L0   height/L0   repose [°]   time/T     steps   wall [s]   worst overlap"
    ]
    for name, r in found.items():
        angles = " ".join("-" if a is None else f"{a:.1f}" for a in r["repose_deg"])
        lines.append(
            f"{name:20s} {r['disks']:7d} {r['aspect']:6.2f} {r['runout_rel']:11.3f} {r['final_height_rel']:11.3f} {angles:>12s} {r['time_s'] / r['fall_time_s']:8.1f} "
            f"{r['steps']:9d} {r['wall_s']:10.1f} {r['overlap_worst_rel']:15.1e}{'' if r['rested'] else '  did not come to rest'}"
        )
    short = [
        f"{name} has {r['disks']} of {r['disks_asked']}"
        for name, r in found.items()
        if r["disks"] < (r.get("disks_asked") or 0)
    ]
    if short:
        lines.append(f"fewer disks than asked for, as their boxes are small: {', '.join(short)}")
    for where, fit in summary["fits"].items():
        if fit:
            sure = "" if fit["exponent_95"] is None else f" ± {fit['exponent_95']:.2f}"
            beside = "; ".join(
                f"{p['source']}: {p['factor']:g} a^{p['exponent']:.3g}, {100 * p['off_rel']:+.0f} %"
                for p in fit["published"]
            )
            name, side = where.split("_")
            lines.append(
                f"{name} {side} a = {fit['change']:g}: {fit['factor']:.2f} a^({fit['exponent']:.3f}{sure}), {fit['points']} runs. {beside}"
            )
    return "\n".join(lines)


def _gates(heap):
    """x [m] of the sides that are taken away."""
    place = heap.place()
    return [x for x, side in ((place, "left"), (place + heap.box()[0], "right")) if side in heap.gates()]


def draw_collapse(heap, run, folder, path=None):
    """The collapse of a run, from its ``folder`` and its summary ``run``: the matplotlib Figure, or the ``path`` that
    it is written to.
    """
    times, places, r = study.frames(folder)
    return figures.collapse(times, places, r, run["fall_time_s"], path, width=run["width_m"], gate=_gates(heap))


def film_collapse(heap, run, folder):
    """``collapse.mp4`` of a run in its folder; returns the path, None where a run of an earlier version has kept no
    frames. Raises RecordsError where ffmpeg is missing.
    """
    folder = Path(folder)
    times, places, r = study.film(folder)
    return (
        figures.film(times, places, r, run["fall_time_s"], folder / "collapse.mp4", gate=_gates(heap))
        if times
        else None
    )
