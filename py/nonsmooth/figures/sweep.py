"""Figure of a sweep: results against a value that was varied, with their scatter over seeds."""

import textwrap
from collections import Counter

from matplotlib.lines import Line2D

from ..characteristic_times import reason_of
from . import given, style

#: Markers of verdicts (:data:`nonsmooth.verdict.MEANINGS`): filled where the slope moved off, open where it did not.
MARKERS = {
    "failed by water": ("s", True),
    "stood": ("o", False),
    "slid": ("P", False),
    "failed dry": ("v", True),
    "moved dry": ("D", True),
    "not at rest": ("^", False),
    "not over": ("d", False),
}
PLAIN = ("s", True)  # of results that have no verdict
PANEL, HEIGHT = 3.8, 4.8  # inches
APART = 0.012  # of the axis between verdicts at one value


@given.takes(rows=given.ROWS, names=given.CASES)
@style.styled
def means(rows, key, names, path=None, pdf=False):
    """Results against the values of ``key``, a panel for each of the ``names``; dots: runs, large markers: means over seeds with their 95 % interval, a kind of marker for each verdict.
    A panel says which runs have no such result, by their verdicts.

    ``rows``: of `campaign.means`; those that differ in other keys too are lines of their own. Values that are no numbers stand side by side.
    """
    fig = style.figure(PANEL * len(names) + 0.4, HEIGHT)
    panels = fig.subplots(1, len(names), squeeze=False)[0]
    fig.subplots_adjust(
        0.7 / fig.get_figwidth(), 1.15 / HEIGHT, 1 - 0.2 / fig.get_figwidth(), 1 - 0.95 / HEIGHT, wspace=0.32
    )
    groups = {}
    for row in rows:
        groups.setdefault(", ".join(f"{k} = {v}" for k, v in row["values"].items() if k != key), []).append(row)
    values = list(dict.fromkeys(str(row["values"][key]) for row in rows))
    numeric = all(isinstance(row["values"][key], (int, float)) for row in rows)
    verdicts = list(dict.fromkeys(row.get("verdict") for row in rows))
    verdicts.sort(key=lambda one: list(MARKERS).index(one) if one in MARKERS else len(MARKERS))
    place = {row["values"][key] if numeric else str(row["values"][key]): 0.0 for row in rows}
    place = {value: float(value) if numeric else k for k, value in enumerate(place)}
    ticks = sorted(place.values())
    logarithmic = numeric and ticks[0] > 0 and ticks[-1] >= 5 * ticks[0]
    colours = dict(zip(groups, style.line_colours(len(groups))))
    for ax, name in zip(panels, names):
        if logarithmic:
            ax.set_xscale("log")
        for label, chosen in groups.items():
            for verdict in verdicts:
                of = [row for row in chosen if row.get("verdict") == verdict]
                at = [place[row["values"][key] if numeric else str(row["values"][key])] for row in of]
                shift = APART * (verdicts.index(verdict) - (len(verdicts) - 1) / 2)
                x = [_beside(a, shift, ticks, logarithmic) for a in at]
                _draw(ax, x, [row["numbers"][name] for row in of], colours[label], MARKERS.get(verdict, PLAIN))
        ax.set(xlabel=style.plain(key), title=style.plain(name))
        ax.set_xticks(ticks, [f"{t:g}" for t in ticks] if numeric else [style.plain(v) for v in values])
        ax.minorticks_off()
        ax.set_xlim(*(_beside(end, way, ticks, logarithmic) for end, way in ((ticks[0], -0.08), (ticks[-1], 0.08))))
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
        _tell_absent(ax, rows, name)
        low, high = ax.get_ylim()
        if low > 0:
            ax.set_ylim(0, high)
    _legend(fig, colours, verdicts)
    return style.save(fig, path, pdf)


def _beside(value, shift, ticks, logarithmic):
    """A place a little beside a value, by a share of the axis."""
    span = ticks[-1] / ticks[0] if logarithmic else (ticks[-1] - ticks[0] or abs(ticks[0]) or 1.0)
    return value * span**shift if logarithmic else value + shift * span


def _draw(ax, x, found, colour, marker):
    """Runs and means of one group and one verdict."""
    shape, filled = marker
    for at, one in zip(x, found):
        each = [v for v in one["values"] if v is not None]
        if each:
            ax.plot([at] * len(each), each, shape, ms=3.5, color=colour, alpha=0.35, mew=0 if filled else 0.8,
                    mfc=colour if filled else "none")  # fmt: skip
    told = [(at, one["mean"], one["half_width"] or 0.0) for at, one in zip(x, found) if one["mean"] is not None]
    if told:
        at, mean, half = zip(*told)
        ax.errorbar(at, mean, half, fmt=f"{shape}-", ms=6, color=colour, mfc=colour if filled else "white", capsize=3, lw=1.2)  # fmt: skip


def _tell_absent(ax, rows, name):
    """Says how many runs have not this result, what became of them and, where that is known, why; in the middle of a panel where no run has it."""
    without, present = Counter(), 0
    for row in rows:
        for k, value in enumerate(row["numbers"][name]["values"]):
            if value is not None:
                present += 1
                continue
            why = reason_of(name, {time: each[k] for time, each in row.get("times_missing", {}).items()})
            without[": ".join(word for word in (row.get("verdict"), why) if word) or "without a value"] += 1
    if not without:
        return
    kinds = [f"{count} {kind}" for kind, count in without.items()]
    if present:
        told = textwrap.fill(f"not drawn, without this value: {'; '.join(kinds)}", 58)
        ax.text(0.5, -0.19, told, transform=ax.transAxes, ha="center", va="top", fontsize=8, color="#555555")
        return
    ax.set_yticks([])
    told = "\n".join(textwrap.fill(kind, 34) for kind in kinds)
    told = f"no run has this value:\n{told}"
    ax.text(0.5, 0.5, told, transform=ax.transAxes, ha="center", va="center", color="#555555")


def _legend(fig, colours, verdicts):
    """Colours are of other keys, markers of verdicts."""
    handles = [
        Line2D([], [], color=colour, lw=1.5, label=style.plain(label)) for label, colour in colours.items() if label
    ]
    for verdict in verdicts:
        if verdict is not None:
            shape, filled = MARKERS.get(verdict, PLAIN)
            handles.append(Line2D([], [], ls="", marker=shape, color="#444444", mfc="#444444" if filled else "white", label=verdict))  # fmt: skip
    if handles:
        fig.legend(handles=handles, loc="upper center", ncol=min(len(handles), 4), frameon=False)
