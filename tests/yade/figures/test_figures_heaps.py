"""Figures of columns and piles, read from their artists. Needs no YADE."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

columns, scaling, style, records, moving = (
    synthetic.load(name)
    for name in ("figures.columns", "measure.power_laws", "figures.style", "records", "figures.moving")
)


def block(left, wide, high):
    """Disks of half a metre on a square lattice from x = ``left``: they touch."""
    return tuple(g.ravel() for g in np.meshgrid(left + 0.5 + np.arange(wide), 0.5 + np.arange(high), indexing="ij"))


@pytest.fixture(scope="module")
def fallen():
    """A block of 5 by 8 m becomes one of 10 by 4 m, both from x = 0; one disk has rolled ahead, to 30 m. Who was on the
    left is on the right.
    """
    (x, y), (far, low) = block(0, 5, 8), block(0, 10, 4)
    far[-1], low[-1] = 30.0, 0.5
    return [0.5, 2.5], [(x, y), (far[::-1], low[::-1])], np.full(40, 0.5)


def run_of(places, r, height, place=0.0, runout=1.0):
    """As a campaign.HeapRun: of a box 5 m wide that stands at ``place``, whose centre of mass has sunk to ``height`` of
    that of the release within 10 s, four T.
    """
    return SimpleNamespace(
        summary=dict(width_m=5.0, fall_time_s=2.5, runout_rel=runout),
        series=dict(time_s=np.array([0.0, 10.0]), centroid_y_m=np.array([4.0, 4.0 * height])),
        places=lambda: ([0.5, 2.5], places, r),
        heap=SimpleNamespace(place=lambda: place),
    )


def test_runs_stand_below_each_other_to_one_scale_and_their_falls_in_one_panel(fallen):
    _, (before, after), r = fallen
    shorter = tuple(0.5 * np.array(one) for one in after)
    runs = {"rigid": run_of([before, after], r, 0.4), "soft": run_of([before, shorter], 0.5 * r, 0.6, runout=0.5)}
    fig = columns.beside(runs)
    upper, lower, falls = fig.axes
    assert [ax.get_title(loc="left") for ax in (upper, lower)] == ["rigid", "soft"]
    # the connected mass of both, 10 m of 5 m; the disk ahead is out of sight
    assert upper.get_xlim() == lower.get_xlim() == pytest.approx((-0.06, 2.06)) and upper.get_ylim() == lower.get_ylim()
    for ax, (x, y) in ((upper, after), (lower, shorter)):
        assert drawn.disks(ax)[0] == pytest.approx(np.column_stack([x, y]) / 5)
    assert {line.get_label(): drawn.points(line).tolist() for line in falls.lines} == {
        "rigid: run-out 1.00": [[0.0, 1.0], [4.0, pytest.approx(0.4)]],
        "soft: run-out 0.50": [[0.0, 1.0], [4.0, pytest.approx(0.6)]],
    }
    # a box that does not begin at 0, as a pile's: the same picture
    moved = [(x - 2.5, y) for x, y in (before, after)]
    again = columns.beside({"pile": run_of(moved, r, 0.4, place=-2.5)})
    assert drawn.disks(again.axes[0])[0] == pytest.approx(drawn.disks(upper)[0])
    with pytest.raises(records.RecordsError, match="no runs to set beside each other"):
        columns.beside({})


@pytest.mark.parametrize("width, unit", [(5.0, "L_0"), (None, "m")])
def test_a_collapse_is_drawn_from_above_down_to_one_scale(fallen, width, unit):
    times, places, r = fallen
    fig = columns.collapse(times, places, r, 1.25, width=width, gate=[5.0])
    upper, lower = fig.axes
    scale = width or 1.0
    # the last is the end
    assert drawn.texts(upper) == ["t = 0.4 T (0.50 s)"] and drawn.texts(lower) == ["at rest (2.50 s)"]
    assert upper.get_ylabel() == lower.get_ylabel() == ("$y/L_0$" if width else "$y$ [m]")
    assert (
        lower.get_xlabel() == ("$x/L_0$" if width else "$x$ [m]") + "          $T=\\sqrt{H_0/g}=1.25$ s"
        and upper.get_xlabel() == ""
    )
    assert upper.get_position().y0 > lower.get_position().y1 and upper.get_xlim() == lower.get_xlim()
    # from 0 to 10 m, and 6 % more on the right, of which a hundredth stands on the left; the disk ahead is out of sight
    assert upper.get_xlim() == pytest.approx((-0.01 * 10.6 / scale, 0.99 * 10.6 / scale))
    size = [
        (
            np.ptp(ax.get_xlim()) / (ax.get_position().width * fig.get_figwidth()),
            np.ptp(ax.get_ylim()) / (ax.get_position().height * fig.get_figheight()),
        )
        for ax in fig.axes
    ]
    assert size[0] == pytest.approx([size[0][0]] * 2) and size[1] == pytest.approx(size[0])
    for ax, (x, y) in zip(fig.axes, places):
        centres, radii, _ = drawn.disks(ax)
        assert centres == pytest.approx(np.column_stack([x, y]) / scale) and radii == pytest.approx(r / scale)
        assert drawn.uprights(ax) == {5.0 / scale: style.LINES["grey"]} and drawn.levels(ax) == [(0, style.WALL)]
    for ax, wide, high in ((upper, 5, 8), (lower, 10, 4)):
        (outline,) = (drawn.points(one) for one in ax.lines if len(one.get_xdata()) > 2)
        assert outline[:, 0].min() > 0 and wide - 2 < scale * outline[:, 0].max() < wide  # windows of two diameters
        # the top of disks of half a metre side by side: 1 - π/4 of their size below the highest points, on the mean
        # over whole disks
        assert scale * outline[:, 1][:-1] == pytest.approx(high - 0.5 + math.pi / 8, abs=0.05)


def test_disks_keep_the_colour_of_where_they_began(fallen):
    times, places, r = fallen
    fig = columns.collapse(times, places, r, 1.0)
    began, ended = (drawn.disks(ax)[2] for ax in fig.axes)
    assert began == ended
    # five stripes from the left, each an eighth of 40
    assert [began[8 * k : 8 * k + 8] for k in range(5)] == [[fill] * 8 for fill in style.LAYERS]
    with pytest.raises(records.RecordsError, match="no places"):
        columns.collapse([], [], r, 1.0)


def test_runout_and_height_with_fits_and_published_laws():
    a = np.array([0.5, 0.7, 1.0, 1.4, 2.8, 4.0, 8.0])
    runout, height = 2 * scaling.RUNOUT[0](a), 0.5 * a**0.25
    group = {
        "aspect": a,
        "runout": runout,
        "height": height,
        "fits": {"runout": (scaling.fit(a[:4], runout[:4]), None), "height": (None, scaling.fit(a[1:], height[1:]))},
        "changes": {"runout": 2.0, "height": 0.7},
    }
    fig = columns.runout(
        {
            "ours": group,
            "theirs": group | {"runout": runout / 2, "fits": {"runout": (None, None), "height": (None, None)}},
        }
    )
    fig.draw_without_rendering()  # formulae that cannot be read show here
    left, right = fig.axes
    assert (left.get_title(loc="left"), left.get_ylabel()) == ("Runout", "$(L_f-L_0)/L_0$")
    assert (right.get_title(loc="left"), right.get_ylabel()) == ("Final height", "$H_f/L_0$")
    for ax, values, name in ((left, runout, "runout"), (right, height, "height")):
        low, high = ax.get_ylim()
        assert ax.get_yticks().tolist() == [t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if low <= t <= high]
        assert ax.get_xticks().tolist() == [0.5, 1, 2, 5]
        assert ax.get_xlabel() == "aspect ratio $a=H_0/L_0$" and ax.get_xscale() == ax.get_yscale() == "log"
        ours, theirs = drawn.line(ax, "ours"), drawn.line(ax, "theirs")
        assert drawn.points(ours) == pytest.approx(np.column_stack([a, values])) and drawn.points(theirs)[
            :, 1
        ] == pytest.approx(values / (2 if name == "runout" else 1))
        assert drawn.legend(ax)["ours"] == drawn.colour(ours) != drawn.colour(theirs)
        for law in scaling.RUNOUT if name == "runout" else scaling.HEIGHT:
            fill = drawn.colour(drawn.line(ax, law.source))
            parts = [drawn.points(one) for one in ax.lines if drawn.colour(one) == fill]
            assert len(parts) == 2 and parts[0][1, 0] == parts[1][0, 0] == law.change
            for part, (factor, power) in zip(parts, law.pieces):
                assert part[:, 1] == pytest.approx(factor * part[:, 0] ** power)
            assert (parts[0][0, 0], parts[1][1, 0]) == pytest.approx((0.85 * 0.5, 1.15 * 8))
    fit = drawn.line(left, "fit: $5.00\\,a^{1.00\\pm0.00}$")
    assert (
        drawn.points(fit) == pytest.approx(np.array([[0.5, 2.5], [1.4, 7.0]]))
        and drawn.colour(fit) == drawn.legend(left)["ours"]
    )
    fit = drawn.line(right, "fit: $0.50\\,a^{0.25\\pm0.00}$")
    assert drawn.points(fit) == pytest.approx(np.array([[0.7, 0.5 * 0.7**0.25], [8.0, 0.5 * 8**0.25]]))
    assert [f"{t:g}" for t in left.get_xticks()] == ["0.5", "1", "2", "5"]


@pytest.mark.parametrize("aspects", [[0.5, 1.0], [0.5, 8.0], [4.0, 8.0]])
def test_each_published_law_has_its_name_once(aspects):
    """Also where all columns are lower than the change of exponent, or higher."""
    a = np.array(aspects)
    group = {
        "aspect": a,
        "runout": 2 * a,
        "height": a**0.3,
        "fits": {"runout": (None, None), "height": (None, None)},
        "changes": {"runout": 2.0, "height": 1.0},
    }
    for ax in columns.runout({"ours": group}).axes:
        lines = {drawn.colour(one) for one in ax.lines if one.get_linestyle() not in ("None", "-")}
        told = [(words, mark) for words, mark in drawn.handles(ax).items() if words != "ours"]
        assert len(told) == 2 and {drawn.colour(mark) for _, mark in told} == lines


def test_a_film_of_a_collapse_has_its_colours_floor_and_gate(fallen, monkeypatch, tmp_path):
    told = {}
    monkeypatch.setattr(moving, "write", lambda frames, path, **how: told.update(frames=frames, **how) or path)
    times, places, r = fallen
    assert columns.film(times, places, r, 1.25, tmp_path / "c.mp4", gate=[5.0]) == tmp_path / "c.mp4"
    (_, before), (_, after) = told["frames"]
    assert [t for t, _ in told["frames"]] == times and np.array_equal(after.x, places[1][0])
    # as in the figure: five stripes from the left, kept by the disks
    assert np.array_equal(before.colour, after.colour)
    assert drawn.hexes(before.colour) == [fill for fill in style.LAYERS for _ in range(8)]
    assert before.axes == after.axes == [(1, 0.0)] and after.walls == []
    (gate,) = before.walls
    assert gate.tolist() == [[5, 0], [5, 8]]
    x0, x1, y0, y1 = told["view"]  # the mass, 10 m long and 8 m high; the disk at 30 m is out of sight
    assert -1 < x0 < 0 and 10 < x1 < 11 and y0 < 0 and 8 < y1 < 9
    assert told["words"](2.5, None).startswith("2.0 T")
    with pytest.raises(records.RecordsError, match="no places"):
        columns.film([], [], r, 1.0, tmp_path / "c.mp4")
