"""The figure of cells along walls with slip laws, read from its artists. Needs no YADE."""

import numpy as np
import pytest

import drawn
import synthetic_slope as package

figures, records = (package.load(name) for name in ("figures", "records"))


def cells(walls=("DP",), hot=True):
    """Three cells of 4, 4 and 2 m on each wall at 0, 1, … 9 s; the second slips from 4 s on, heats and weakens."""
    rows = []
    for t in range(10):
        for name in walls:
            for k, length in enumerate((4.0, 4.0, 2.0)):
                slip = max(0.0, t - 4.0) if k == 1 else 0.0
                rows.append((name, k, float(t), length, slip, 0.4 * np.exp(-slip), 15 + 10 * slip if hot else np.nan))
    names = "wall cell time_s length_m slip_m friction hottest_degC".split()
    return dict(zip(names, map(np.array, zip(*rows))))


def panels(fig):
    return [ax for ax in fig.axes if ax.get_ylabel().startswith("way along")]


def test_cells_lie_where_they_are_and_have_their_colours():
    fig = figures.slip_surface(cells(), times={"t0": 1.0, "t2": 5.0})
    warm, left = panels(fig)
    (mesh,) = warm.collections
    corners = mesh.get_coordinates()
    assert corners[:, 0, 1].tolist() == [0, 4, 8, 10] and corners[0, :, 0].tolist() == [*range(10), 10]
    assert mesh.get_array().reshape(3, 10)[1].tolist() == [15.0] * 5 + [25.0, 35.0, 45.0, 55.0, 65.0]
    share = left.collections[0].get_array().reshape(3, 10)
    assert share[1].tolist() == pytest.approx(np.exp(-np.maximum(0, np.arange(10) - 4.0)).tolist())
    assert share[0].tolist() == [1.0] * 10
    assert warm.get_ylabel() == "way along DP [m]" and left.get_xlabel() == "time [s]"
    # from when something slides
    assert left.get_xlim() == pytest.approx((5 - 0.4, 10))
    assert [t for t in drawn.texts(warm) if t.startswith("$t")] == ["$t_{2}$"]


def test_each_wall_has_its_panels_and_a_law_without_heat_has_none_of_temperature():
    assert [ax.get_ylabel() for ax in panels(figures.slip_surface(cells(("a", "b"), hot=False)))] == [
        "way along a [m]",
        "way along b [m]",
    ]
    assert len(panels(figures.slip_surface(cells(("a", "b"))))) == 4


def test_where_nothing_has_slipped_there_is_no_figure():
    still = cells()
    still["slip_m"] = 0 * still["slip_m"]
    with pytest.raises(records.RecordsError, match="no cell has slipped"):
        figures.slip_surface(still)
    with pytest.raises(records.RecordsError, match="slip_surface.csv"):
        figures.slip_surface({"wall": []})
