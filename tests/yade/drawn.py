"""What a figure shows, read from its artists in data units: lines, legends, texts, arrows, disks, bars, bands and
levels.

Colours are told as "#rrggbb". No picture is drawn.
"""

import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import to_hex
from matplotlib.patches import Patch


def keep(monkeypatch, style):
    """Figures that are saved from now on, by the name of their file: a dict; an empty file stands for each. ``style``:
    the module nonsmooth.figures.style.
    """
    kept = {}

    def save(fig, path=None, pdf=False, dpi=170):
        if path is None:
            return fig
        fig.draw_without_rendering()  # places and formulae that cannot be drawn show here
        kept[path.name] = fig
        path.touch()
        return path

    monkeypatch.setattr(style, "save", save)
    return kept


def colour(artist):
    """Of a line or a patch."""
    return to_hex(artist.get_color() if hasattr(artist, "get_color") else artist.get_facecolor())


def line(ax, label):
    """The one line with this label."""
    found = [one for one in ax.lines if one.get_label() == label]
    assert len(found) == 1, f"{len(found)} lines {label!r} among {[one.get_label() for one in ax.lines]}"
    return found[0]


def points(one):
    """Of a line: (n, 2)."""
    return np.column_stack([np.asarray(part, float) for part in one.get_data()])


def hexes(rgba):
    return [to_hex(c) for c in rgba]


def handles(owner):
    """{text: what stands before it} of the legends of axes or of a figure."""
    told = {}
    for one in owner.legends if hasattr(owner, "legends") else [owner.get_legend()]:
        marks = getattr(one, "legend_handles", None) or one.legendHandles  # the name until matplotlib 3.6
        for mark, words in zip(marks, one.get_texts(), strict=True):
            assert words.get_text() not in told
            told[words.get_text()] = mark
    return told


def legend(owner):
    """{text: colour} of the legends of axes or of a figure."""
    return {words: colour(mark) for words, mark in handles(owner).items()}


def legend_patches(one):
    """Colours of all patches in a legend, from the left."""
    return [colour(p) for p in one.findobj(Patch) if p is not one.legendPatch]


def texts(owner):
    """All words on axes or a figure that are not empty, without legends and labels of axes."""
    return [t.get_text() for t in owner.texts if t.get_text()]


def text(owner, begin):
    """The one text that begins so."""
    found = [t for t in owner.texts if t.get_text().startswith(begin)]
    assert len(found) == 1, f"{len(found)} texts {begin!r} among {texts(owner)}"
    return found[0]


def arrows(ax):
    """[(tail, head, colour, arrow style)] of the arrows without words, in the order drawn."""
    plain = [t for t in ax.texts if getattr(t, "arrowprops", None) and not t.get_text()]
    return [
        (np.array(t.xyann), np.array(t.xy), to_hex(t.arrowprops["color"]), t.arrowprops["arrowstyle"]) for t in plain
    ]


def disks(ax):
    """Disks of axes: (centres (n, 2), radii (n,), face colours)."""
    (found,) = (c for c in ax.collections if isinstance(c, EllipseCollection))
    assert np.array_equal(found._widths, found._heights)  # half widths; they have getters since matplotlib 3.10 only
    return found.get_offsets(), found._widths, hexes(found.get_facecolor())


def bars(ax):
    """{colour: corners (n, 4, 2)} of the bars of force chains."""
    told = {}
    for found in ax.collections:
        if isinstance(found, PolyCollection) and found.get_rasterized():
            (fill,) = set(hexes(found.get_facecolor()))
            assert fill not in told
            told[fill] = np.array([path.vertices[:4] for path in found.get_paths()]).reshape(-1, 4, 2)
    return told


def bands(ax):
    """[(from, to, colour)] of bands across axes (axvspan), in the order drawn."""
    told = []
    for patch in ax.patches:
        if patch.get_data_transform() == ax.get_xaxis_transform():
            x = patch.get_patch_transform().transform_path(patch.get_path()).vertices[:, 0]
            told.append((x.min(), x.max(), colour(patch)))
    return told


def uprights(ax):
    """{x: colour} of lines across axes from the bottom to the top (axvline)."""
    return {
        one.get_xdata()[0]: colour(one)
        for one in ax.lines
        if np.array_equal(one.get_ydata(), [0, 1]) and np.ptp(one.get_xdata()) == 0
    }


def levels(ax):
    """[(y, colour)] of lines across axes from the left to the right (axhline)."""
    return [
        (one.get_ydata()[0], colour(one))
        for one in ax.lines
        if np.array_equal(one.get_xdata(), [0, 1]) and np.ptp(one.get_ydata()) == 0
    ]
