"""Figures of readings of what the paper leaves open: their numbers beside the paper's, and stress against strain for
bonds over several gaps.
"""

from pathlib import Path

import numpy as np

from ...figures import style
from ...measure import strength
from .reading_numbers import FIGURE_9, PAPER, SHIPPED, SHOWN, by_distance, series_of

__all__ = ["GAPS", "beside", "stress_strain", "stress_strain_of"]

APART = 0.17  # of a line, from its middle to the rows of smooth and of rough platens

#: Readings of the figure of stress against strain: those of a row have the bonds that its name says, over gaps up to
#: the Δ above each column.
GAPS = (0.015, 0.02, 0.025)
BONDS = {
    "bonds bear compression\n(as shipped)": ("gap-0.015", "gap-0.02", SHIPPED),
    "bonds close freely": ("closing-0.015", "closing-0.02", "closing-0.025"),
}
TALLEST = (0.01, 0.02)  # strains of the paper's peaks ([107])
END = 0.06  # strain at the right end, or where the tests end before


@style.styled
def beside(rows, path=None, pdf=False):
    """The numbers of each reading (rows of `laboratory.readings.run`), nearest first, a column for each number, what
    counts as the paper's as a band: means with their 95 % interval, of the peak's strain every sample. Filled: smooth
    platens; open: rough ones; square: others.
    """
    rows = by_distance(rows)
    lines = {name: k for k, name in enumerate(dict.fromkeys(row["name"] for row in rows))}
    fig = style.figure(13.0, 0.27 * len(lines) + 1.6, layout="constrained")
    columns = (*SHOWN, "strain_peak", "distance")
    for ax, name in zip(fig.subplots(1, len(columns), sharey=True), columns):
        _band(ax, name)
        for row in rows:
            marker, fill, apart = _mark(row)
            _numbers(ax, row, name, lines[row["name"]] + apart, marker, fill)
        ax.set_xlabel(_head(name))
        ax.grid(axis="y", color="#eeeeee", lw=0.7)
        ax.set_axisbelow(True)
    fig.axes[-1].set_xlim(0, None)
    first = fig.axes[0]
    first.set(ylim=(len(lines) - 0.5, -0.5))
    first.set_yticks(list(lines.values()), [style.plain(_label(rows, name)) for name in lines])
    for text, name in zip(first.get_yticklabels(), lines):
        text.set(color=_colour(name), fontweight="bold" if name == SHIPPED else "normal")
    handles = [
        first.plot([], [], marker, ls="", ms=4.5, color=style.INK, mfc=fill, label=label)[0]
        for label, marker, fill in (
            ("smooth platens", "o", style.INK),
            ("rough platens", "o", "white"),
            ("glued platens", "s", style.INK),
        )
    ]
    fig.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.35 / fig.get_figheight()))  # room for the legend
    fig.legend(handles=handles, loc="upper center", ncol=3)
    return style.save(fig, path, pdf)


def _colour(name):
    return style.LINES["orange"] if name == SHIPPED else style.INK


def _label(rows, name):
    return next(row["label"] for row in rows if row["name"] == name)


def _mark(row):
    """Marker of a row, its fill, and how far below the middle of its line it stands."""
    colour = _colour(row["name"])
    return {"smooth": ("o", colour, -APART), "rough": ("o", "white", APART)}.get(row["platens"], ("s", colour, 0.0))


def _head(name):
    if name == "distance":
        return "distance"
    # each word in a line
    return SHOWN[name][0].replace(" ", "\n") if name in SHOWN else "strain of\neach peak\n[%]"


def _band(ax, name):
    """What counts as the paper's."""
    if name == "strain_peak":
        wanted, octaves = PAPER[name]
        low, high = 100 * wanted / 2**octaves, 100 * wanted * 2**octaves
        ax.set(xscale="log", xlim=(0.05, 10))
        ticks = (0.1, 0.5, 2.0)
        ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        ax.minorticks_off()
    elif name == "distance":
        low, high = 0.0, 1.0
    else:
        wanted, allowed = PAPER[name]
        low, high = wanted - allowed, wanted + allowed
    ax.axvspan(low, high, color="#dcebf7", lw=0, zorder=0)


def _numbers(ax, row, name, y, marker, fill):
    colour = _colour(row["name"])
    if name == "strain_peak":
        strains = 100 * np.ravel(row[name])
        ax.plot(strains, [y] * len(strains), marker, ms=3, mew=0.6, color=colour, mfc=fill, alpha=0.6, zorder=3)
    elif row[name] is not None:
        half = row.get(f"{name}_95")
        if half is not None:
            ax.plot([row[name] - half, row[name] + half], [y, y], "-", color=colour, lw=0.8, alpha=0.5, zorder=2)
        ax.plot(row[name], y, marker, ms=4.5, color=colour, mfc=fill, zorder=3)


@style.styled
def stress_strain(curves, path=None, pdf=False):
    """Axial stress against axial strain of every sample, a panel for each Δ of :data:`GAPS` and each kind of
    :data:`BONDS`; dots: peaks, where they are not beyond the right end; the paper's range of peaks is a band.

    ``curves``: {reading: {seed: series}}, columns of `laboratory.biaxial.COLUMNS`, of all readings of :data:`BONDS`. A
    line is the mean over 0.2 % of strain, whose largest is the peak.
    """
    fig = style.figure(10.2, 5.8, layout="constrained")
    axes = fig.subplots(2, 3, sharex=True, sharey=True)
    colours = dict(zip(sorted({seed for one in curves.values() for seed in one}), style.line_colours(99)))
    for ax, gap in zip(axes[0], GAPS):
        ax.set_title(f"Δ = {gap:g} ℓ")
    for line, (words, readings) in zip(axes, BONDS.items()):
        for ax, name in zip(line, readings):
            ax.axvspan(100 * TALLEST[0], 100 * TALLEST[1], color="#dcebf7", lw=0, zorder=0)
            for seed, series in curves[name].items():
                begin, mean = strength.running_mean(
                    series["strain"], strength.axial_stress(series), strength.PEAK_WINDOW
                )
                middle, stress, k = 100 * (begin + strength.PEAK_WINDOW / 2), 1e-6 * mean, int(np.argmax(mean))
                shown = middle <= 100 * END
                ax.plot(middle[shown], stress[shown], lw=1, color=colours[seed], label=f"{seed}")
                if shown[k]:
                    ax.plot(middle[k], stress[k], "o", ms=4.5, color=colours[seed], mec="white", mew=0.6, zorder=4)
        line[0].set_ylabel(f"{words}\n\nσ₁ [MPa]")
    for ax in axes[1]:
        ax.set_xlabel("axial strain ε₁ [%]")
    last = min(END, *(series["strain"][-1] for of in curves.values() for series in of.values()))
    lowest = min(line.get_ydata().min() for ax in axes.flat for line in ax.lines)
    axes[0, 0].set(xlim=(0, 100 * last), ylim=(0.8 * lowest, None))  # room for words
    axes[0, 0].text(
        50 * sum(TALLEST),
        0.03,
        "peaks of\nthe paper",
        ha="center",
        transform=axes[0, 0].get_xaxis_transform(),
        color=style.WATER,
    )
    axes[0, 2].legend(title="packing", ncol=3, loc="lower right", bbox_to_anchor=(1.0, 0.0))
    return style.save(fig, path, pdf)


def stress_strain_of(rows, out):
    """Writes :func:`stress_strain` under 8 MPa for each kind of platens of which all readings of :data:`BONDS` are
    among the rows of ``laboratory.readings.run`` in the folder ``out``: between smooth ones as
    ``readings_stress_strain.png``, else with the platens behind. Returns the paths."""
    made, names = [], [name for one in BONDS.values() for name in one]
    for platens in dict.fromkeys(row["platens"] for row in rows):
        of = {r["name"]: r for r in rows if r["platens"] == platens and r["name"] in names and r["samples"]}
        if len(of) < len(names):
            continue
        curves = {
            name: {
                s["seed"]: series_of({"confining_Pa": FIGURE_9, "seed": s["seed"]}, Path(out) / row["folder"])
                for s in row["samples"]
            }
            for name, row in of.items()
        }
        behind = "" if platens == "smooth" else f"_{platens}"
        made.append(stress_strain(curves, Path(out) / f"readings_stress_strain{behind}.png"))
    return made
