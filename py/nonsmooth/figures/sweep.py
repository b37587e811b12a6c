"""Figure of a sweep: results against a value that was varied, with their scatter over seeds."""

import textwrap
from collections import Counter

from matplotlib.lines import Line2D

from ..measure.characteristic_times import reason_of
from ..model.section import values as section_values
from ..records import RecordsError
from ..system import checks
from . import given, style

__all__ = ["MARKERS", "means"]

#: Markers of verdicts (:data:`nonsmooth.studies.slope.verdict.MEANINGS`): filled where the slope moved off, open where
#: it did not.
MARKERS = {
    "failed by water": ("s", True),
    "failed by shaking": ("P", True),
    "stood": ("o", False),
    "slid": ("P", False),
    "failed dry": ("v", True),
    "moved dry": ("D", True),
    "not at rest": ("^", False),
    "not over": ("d", False),
    # of a search for a factor of safety
    "found": ("s", True),
    "stands": ("o", False),
    "falls": ("v", True),
}
PLAIN = ("s", True)  # of results that have no verdict
PANEL, HEIGHT, TOP, BOTTOM = (
    3.8,
    4.8,
    0.95,
    1.15,
)  # inches: of a panel's width and of all, and above and below the axes, where as little stands there as usual
LINE = 0.14  # inches, of the small text below a panel
LABEL = 46  # characters of a label below a panel, or in a line of the legend for each panel
DASHES = ("-", (0, (4, 1.5)), (0, (1, 1.2)), (0, (4, 1.2, 1, 1.2)))  # where there are more lines than colours
APART = 0.012  # of the axis between verdicts at one value


@given.takes(rows=given.ROWS, names=given.CASES)
@style.styled
def means(rows, key, names, path=None, pdf=False):
    """Results against the values of ``key``, a panel for each of the ``names``; dots: runs, large markers: means over
    seeds with their 95 % interval, a kind of marker for each verdict. A panel says which runs have no such result, by
    their verdicts.

    ``rows``: of `campaign.means`; those that differ in other keys too are lines of their own. Values that are no
    numbers stand side by side. Raises RecordsError for no rows, and for a key or a name that they have not.
    """
    _check(rows, key, names)
    fig = style.figure(PANEL * len(names) + 0.4, HEIGHT)
    panels = fig.subplots(1, len(names), squeeze=False)[0]
    groups, short = {}, section_values.short([k for k in rows[0]["values"] if k != key])
    for row in rows:
        groups.setdefault(", ".join(f"{short[k]} = {_text(row['values'][k])}" for k in short), []).append(row)
    values = list(dict.fromkeys(str(row["values"][key]) for row in rows))
    numeric = all(isinstance(row["values"][key], (int, float)) for row in rows)
    verdicts = list(dict.fromkeys(row.get("verdict") for row in rows))
    verdicts.sort(key=lambda one: list(MARKERS).index(one) if one in MARKERS else len(MARKERS))
    place = {row["values"][key] if numeric else str(row["values"][key]): 0.0 for row in rows}
    place = {value: float(value) if numeric else k for k, value in enumerate(place)}
    ticks = sorted(place.values())
    logarithmic = numeric and ticks[0] > 0 and ticks[-1] >= 5 * ticks[0]
    colours = style.line_colours(len(groups))
    looks = {label: (colours[k], DASHES[k // len(style.LINES) % len(DASHES)]) for k, label in enumerate(groups)}
    told, below = _broken(key), 0
    for ax, name in zip(panels, names):
        if logarithmic:
            ax.set_xscale("log")
        for label, chosen in groups.items():
            for verdict in verdicts:
                of = [row for row in chosen if row.get("verdict") == verdict]
                at = [place[row["values"][key] if numeric else str(row["values"][key])] for row in of]
                shift = APART * (verdicts.index(verdict) - (len(verdicts) - 1) / 2)
                x = [_beside(a, shift, ticks, logarithmic) for a in at]
                _draw(ax, x, [row["numbers"][name] for row in of], looks[label], MARKERS.get(verdict, PLAIN))
        ax.set(xlabel=style.plain(told), title=style.plain(name))
        ax.set_xticks(ticks, [f"{t:g}" for t in ticks] if numeric else [style.plain(v) for v in values])
        ax.minorticks_off()
        ax.set_xlim(*(_beside(end, way, ticks, logarithmic) for end, way in ((ticks[0], -0.08), (ticks[-1], 0.08))))
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
        below = max(below, _tell_absent(ax, rows, name, told.count("\n")))
        low, high = ax.get_ylim()
        if low > 0:
            ax.set_ylim(0, high)
    _make_room(fig, max(TOP, _legend(fig, looks, verdicts) + 0.5), BOTTOM + LINE * max(0, below - 3))
    return style.save(fig, path, pdf)


def _check(rows, key, names):
    """Raises RecordsError where there is nothing to draw, or a row has not what is asked for."""
    if not rows or not names:
        raise RecordsError(f"{'names' if rows else 'rows'} []: nothing to draw; give at least one")
    for part, asked in (("values", [key]), ("numbers", names)):
        for name in asked:
            if not all(name in row.get(part, {}) for row in rows):
                known = [one for one in rows[0].get(part, {}) if all(one in row.get(part, {}) for row in rows)]
                what = "key" if part == "values" else "names"
                raise RecordsError(
                    f"{what} {checks.shown(name)}: the rows have no such {part}; give {'some' if part == 'numbers' else 'one'} of {', '.join(known)}"
                )


def _text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def _broken(key):
    """A key that is too long for a line below a panel, broken at a dot."""
    at = key.rfind(".", 0, LABEL)
    return key if len(key) <= LABEL or at < 0 else f"{key[:at + 1]}\n{key[at + 1:]}"


def _make_room(fig, top, bottom):
    """Gives the figure these margins [inches] above and below the axes, whose size stays."""
    width, height = fig.get_figwidth(), HEIGHT - TOP - BOTTOM + top + bottom
    fig.set_figheight(height)
    fig.subplots_adjust(0.7 / width, bottom / height, 1 - 0.2 / width, 1 - top / height, wspace=0.32)


def _beside(value, shift, ticks, logarithmic):
    """A place a little beside a value, by a share of the axis."""
    span = ticks[-1] / ticks[0] if logarithmic else (ticks[-1] - ticks[0] or abs(ticks[0]) or 1.0)
    return value * span**shift if logarithmic else value + shift * span


def _draw(ax, x, found, look, marker):
    """Runs and means of one group and one verdict; ``look``: colour and dashes of its line."""
    (colour, dash), (shape, filled) = look, marker
    for at, one in zip(x, found):
        each = [v for v in one["values"] if v is not None]
        if each:
            ax.plot([at] * len(each), each, shape, ms=3.5, color=colour, alpha=0.35, mew=0 if filled else 0.8,
                    mfc=colour if filled else "none")  # fmt: skip
    told = [(at, one["mean"], one["half_width"] or 0.0) for at, one in zip(x, found) if one["mean"] is not None]
    if told:
        at, mean, half = zip(*told)
        ax.errorbar(at, mean, half, fmt=shape, ls=dash, ms=6, color=colour, mfc=colour if filled else "white", capsize=3, lw=1.2)  # fmt: skip


def _tell_absent(ax, rows, name, lower):
    """Says how many runs have not this result, what became of them and, where that is known, why; in the middle of a
    panel where no run has it. Returns how many lines stand below the panel, which begin ``lower`` lines further
    down."""
    without, present = Counter(), 0
    for row in rows:
        for k, value in enumerate(row["numbers"][name]["values"]):
            if value is not None:
                present += 1
                continue
            why = reason_of(name, {time: each[k] for time, each in row.get("times_missing", {}).items()})
            without[": ".join(word for word in (row.get("verdict"), why) if word) or "without a value"] += 1
    if not without:
        return lower
    kinds = [f"{count} {kind}" for kind, count in without.items()]
    if present:
        told = textwrap.fill(f"not drawn, without this value: {'; '.join(kinds)}", 58)
        ax.text(
            0.5, -0.19 - 0.06 * lower, told, transform=ax.transAxes, ha="center", va="top", fontsize=8, color="#555555"
        )
        return lower + told.count("\n") + 1
    ax.set_yticks([])
    told = "\n".join(textwrap.fill(kind, 34) for kind in kinds)
    told = f"no run has this value:\n{told}"
    ax.text(0.5, 0.5, told, transform=ax.transAxes, ha="center", va="center", color="#555555")
    return lower


def _legend(fig, looks, verdicts):
    """Colours are of other keys, markers of verdicts; as many beside each other as there is room for. Returns its
    height [inches].
    """
    longest = int(LABEL * fig.get_figwidth() / PANEL)
    handles = [
        Line2D([], [], color=colour, ls=dash, lw=1.5, label=style.plain(textwrap.fill(label, longest)))
        for label, (colour, dash) in looks.items()
        if label
    ]
    for verdict in verdicts:
        if verdict is not None:
            shape, filled = MARKERS.get(verdict, PLAIN)
            handles.append(Line2D([], [], ls="", marker=shape, color="#444444", mfc="#444444" if filled else "white", label=verdict))  # fmt: skip
    for columns in range(min(len(handles), 4), 0, -1):
        legend = fig.legend(handles=handles, loc="upper center", ncol=columns, frameon=False)
        box = legend.get_window_extent(fig.canvas.get_renderer())
        if columns == 1 or box.width <= fig.get_figwidth() * fig.dpi:
            return box.height / fig.dpi
        legend.remove()
    return 0.0
