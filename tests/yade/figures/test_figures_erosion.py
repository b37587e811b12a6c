"""The figure of what windows have taken out of a slope, read from its artists. Needs no YADE."""

import numpy as np
import pytest
from matplotlib.collections import EllipseCollection

import drawn
import synthetic_slope as package

figures, records, section, data, style = (
    package.load(name) for name in ("figures", "records", "model.section", "model.section.data", "figures.style")
)
UNDERCUT = section.load("undercut")
TWO = section.of(
    data.plain(UNDERCUT)
    | {
        "erosion": [
            *data.plain(UNDERCUT)["erosion"],
            {"name": "a $cut", "vertices": [[0, 0], [3, 0], [3, 9]], "begin": 5},
        ]
    }
)
X = np.arange(6.0)
INITIAL = records.Snapshot(3.0, 9, X, 20 + X, np.full(6, 0.5), layer=np.zeros(6, int))
LEDGER = {
    "window": np.array(["river", "river", "a $cut"]),
    "disk": np.array([5, 3, 1]),
    "time_s": np.array([5.0, 9.0, 8.0]),
    "window_time_s": np.array([2.0, 6.0, 5.0]),
    "mass_kg_per_m": np.array([2000.0, 3000.0, 500.0]),
}
T = np.linspace(3, 12, 10)
SERIES = {"time_s": T, "speed_mean_m_per_s": 0.1 * T}


def test_disks_that_were_taken_have_the_colour_of_their_time():
    ax = figures.erosion(INITIAL, LEDGER, TWO, SERIES).axes[0]
    (disks,) = (c for c in ax.collections if isinstance(c, EllipseCollection))
    colours = disks.get_facecolors()
    assert len(colours) == 6 and len({tuple(c) for c in colours[[0, 2, 4]]}) == 1  # pale
    first, later, last = colours[5], colours[1], colours[3]
    assert len({tuple(c) for c in (first, later, last, colours[0])}) == 4


def test_the_bar_of_lengths_is_a_fifteenth_and_more_of_the_picture():
    ax = figures.erosion(INITIAL, LEDGER, TWO, SERIES).axes[0]
    (bar,) = (line for line in ax.lines if line.get_zorder() == 7)
    x0, x1 = ax.get_xlim()
    length = float(np.ptp(bar.get_xdata())) * (x1 - x0)
    assert length == pytest.approx(style.nice(0.15 * (x1 - x0)))


def test_windows_stand_where_they_began_and_where_they_took_their_last_disk():
    ax = figures.erosion(INITIAL, LEDGER, TWO, SERIES).axes[0]
    outlines = [drawn.points(line) for line in ax.lines if line.get_zorder() == 6]
    river, cut = TWO.erosion
    told = [river.outline(river.begin), river.outline(6.0), cut.outline(5.0)]
    assert [len(one) for one in outlines] == [5, 5, 4]
    assert all(np.allclose(one[:-1], other) for one, other in zip(outlines, told))


def test_mass_by_windows_is_in_tonnes_beside_the_speed():
    fig = figures.erosion(INITIAL, LEDGER, TWO, SERIES, times={"t0": 3.0, "t2": 8.0})
    below, beside = (next(ax for ax in fig.axes if ax.get_ylabel().startswith(name)) for name in ("taken", "mean"))
    handles = list(drawn.handles(below))
    assert handles == ["river: 2 disks, 5 t/m", r"a \$cut: 1 disks, 0.5 t/m", "mean speed"]
    steps = [drawn.points(line) for line in below.lines if len(line.get_xdata()) in (3, 4)]
    assert [one.tolist() for one in steps] == [
        [[3.0, 0.0], [5.0, 2.0], [9.0, 5.0], [12.0, 5.0]],
        [[3.0, 0.0], [8.0, 0.5], [12.0, 0.5]],
    ]
    assert drawn.points(beside.lines[0])[:, 1] == pytest.approx(0.1 * T)
    assert below.get_ylabel() == "taken out [t/m]" and beside.get_ylabel() == "mean speed [m/s]"


def test_a_window_that_took_nothing_is_drawn_all_the_same():
    one = {name: values[:2] for name, values in LEDGER.items()}
    fig = figures.erosion(INITIAL, one, TWO, SERIES)
    below = next(ax for ax in fig.axes if ax.get_ylabel().startswith("taken"))
    assert r"a \$cut: 0 disks, 0 t/m" in drawn.handles(below)
    empty = {name: values[:0] for name, values in LEDGER.items()}
    with pytest.raises(style.RecordsError, match="the ledger is empty"):
        figures.erosion(INITIAL, empty, TWO, SERIES)


def test_centres_and_fronts_are_of_what_is_left():
    """The three disks ahead are taken out: the front of the others has not gone back, nor has their centre."""
    ground = [("slip", np.array([[-5.0, 20.0], [9.0, 15.0]]), "slip")]
    left = records.Snapshot(
        9.0, 99, X[:3] + 1.0, 20 + X[:3], np.full(3, 0.5), layer=np.zeros(3, int), number=np.arange(3)
    )  # fmt: skip
    for fig in (figures.deposit(left, INITIAL, ground), figures.runouts([("one", INITIAL, left)], ground)):
        told = " ".join(drawn.texts(fig.axes[0]))
        assert "front: 1.0 m" in told or "front 1.0 m" in told or "1 m" in told, told
        assert "−" not in told and "-" not in told


def test_energy_that_left_is_drawn_where_there_is_some():
    names = [
        "potential", "sliding", "rolling", "impact", "kinetic", "water", "bonds", "correction"
    ]  # fmt: skip
    series = {f"energy_{name}_J": np.linspace(0, k + 1, 10) for k, name in enumerate(names)}
    series |= {"time_s": T, "energy_error_rel": np.zeros(10)}
    assert "left with disks taken out" not in drawn.handles(figures.energy(series).axes[0])
    series["energy_eroded_J"] = np.linspace(0, 7, 10)
    line = drawn.line(figures.energy(series).axes[0], "left with disks taken out")
    assert drawn.points(line)[-1].tolist() == [12.0, 7.0]
