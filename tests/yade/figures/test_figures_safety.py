"""Figures of a search for the factor of safety, read from their artists. Needs no YADE."""

from types import SimpleNamespace

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

safety, style, records = (synthetic.load(name) for name in ("figures.safety", "figures.style", "records"))


def trial(factor, verdict, mean, most):
    return dict(factor=factor, verdict=verdict, displacement_mean_m=mean, displacement_max_m=most, trial=1)


TRIALS = [
    dict(factor=1.0, verdict="stable", why="", trial=0),  # a loading has no displacement
    trial(1.1, "stable", 0.01, 0.03),
    trial(1.21, "failed", 3.0, 5.0),
    trial(1.155, "stable", 0.04, 0.2),
    trial(1.18, "failed", 2.5, 4.0),
]


def test_displacements_stand_over_the_factor_with_the_bracket_behind():
    fig = safety.displacements(TRIALS, (1.155, 1.18))
    (ax,) = fig.axes
    assert ax.get_xlabel() == "factor by which strengths are divided" and ax.get_ylabel() == "displacement [m]"
    course, *points = ax.lines
    assert drawn.points(course) == pytest.approx(np.array([[1.1, 0.01], [1.155, 0.04]]))  # in the order of factors
    told = [sorted(map(tuple, drawn.points(one).tolist())) for one in points]
    assert told == [
        [(1.1, 0.03), (1.155, 0.2)],
        [(1.1, 0.01), (1.155, 0.04)],
        [(1.18, 4.0), (1.21, 5.0)],
        [(1.18, 2.5), (1.21, 3.0)],
    ]
    assert drawn.bands(ax) == [(1.155, 1.18, safety.BRACKET)]
    assert list(drawn.handles(fig)) == ["came to rest", "failed", "largest of a disk", "bracket: 1.155 to 1.180"]


def test_a_slope_that_stands_for_ever_has_no_bracket():
    fig = safety.displacements(TRIALS[:2], (1.1, None))
    assert not fig.axes[0].patches and list(drawn.handles(fig)) == ["came to rest", "failed", "largest of a disk"]


def test_small_slopes_have_small_units():
    small = [trial(1.1, "stable", 2e-5, 4e-5)]
    fig = safety.displacements(small)
    assert fig.axes[0].get_ylabel() == "displacement [mm]"
    assert drawn.points(fig.axes[0].lines[0]) == pytest.approx(np.array([[1.1, 0.02]]))


def test_nothing_to_draw_is_refused():
    with pytest.raises(records.RecordsError, match="none has a displacement"):
        safety.displacements(TRIALS[:1])


def test_the_failing_mass_is_coloured_by_its_way():
    x, y = (g.ravel() for g in np.meshgrid(np.arange(10) + 0.5, np.arange(4) + 0.5))

    def shot(x, y):
        return records.Snapshot(0.0, 0, x, y, np.full(40, 0.5), water_m=0.0)

    upper = y > 2
    after = shot(x + np.where(upper, 2.5, 0.0), y)
    walls = [("base", np.array([[0.0, 0.0], [12.0, -0.1]]), "slip")]
    fig = safety.failing_mass_on_section(shot(x, y), after, walls, "made up")
    places, colours = drawn.disks(fig.axes[0])[0], drawn.disks(fig.axes[0])[-1]
    assert places == pytest.approx(np.column_stack([x, y]))  # as it began
    assert {c for c, up in zip(colours, upper) if not up} == {"#d9d3c6"}
    assert len({c for c, up in zip(colours, upper) if up}) == 1 and "#d9d3c6" not in {
        c for c, up in zip(colours, upper) if up
    }
    assert list(drawn.handles(fig)) == ["stays", "fails, and has moved by up to 2.5 m"]
    assert [t.get_text() for t in fig.texts] == ["made up"]


def test_factors_stand_over_the_number_of_disks():
    found = [
        {"label": "one", "published": 2.0, "disks": [500, 1000], "factors": [[1.8, 2.2], [2.0, 2.1]]},
        {"label": "two", "published": 1.0, "disks": [490, 1000], "factors": [[0.9], [0.95]]},
    ]
    fig = safety.by_disks(found)
    (ax,) = fig.axes
    assert drawn.levels(ax) == [(1.0, style.INK)]
    (band,) = ax.patches
    assert sorted(set(band.get_xy()[:, 1])) == [0.9, 1.1]
    means = {line.get_label(): drawn.points(line) for line in ax.lines if line.get_marker() == "s"}
    assert means["one"][:, 1] == pytest.approx([1.0, 1.025]) and means["two"][:, 1] == pytest.approx([0.9, 0.95])
    # slopes stand a little apart, around the number that they have
    assert means["one"][:, 0] * safety.APART == pytest.approx(means["two"][:, 0] * [500 / 490, 1.0])
    dots = sorted(v for line in ax.lines if line.get_marker() == "o" for v in line.get_ydata())
    assert dots == pytest.approx([0.9, 0.9, 0.95, 1.0, 1.05, 1.1])
    assert ax.get_xscale() == "log" and [t.get_text() for t in ax.get_xticklabels()] == ["490", "500", "1,000"]
