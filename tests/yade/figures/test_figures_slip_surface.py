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


def test_walls_share_one_scale_of_temperature():
    """That of a has 15 to 65 °C, that of b 20 degrees more; both have friction from 0 to 1."""
    both = cells(("a", "b"))
    both["hottest_degC"] = both["hottest_degC"] + np.where(both["wall"] == "b", 20, 0)
    drawn_as = {ax.get_ylabel(): [] for ax in panels(figures.slip_surface(both))}
    for ax in panels(figures.slip_surface(both)):
        drawn_as[ax.get_ylabel()].append(ax.collections[0].get_clim())
    assert list(drawn_as.values()) == [[(15, 85), (0, 1)]] * 2
    # a millionth of a degree is no heat
    both["hottest_degC"] = 15 + 1e-6 * both["slip_m"]
    assert panels(figures.slip_surface(both))[0].collections[0].get_clim() == (15, 16)


def test_what_came_before_the_slope_settled_is_not_shown():
    """Slip of 3 m, 400 °C and a tenth of the friction, which were set back at 3 s; friction is by that of the first
    row. What moved before alone gives no figure.
    """
    settled = cells()
    early = settled["time_s"] < 3
    for name, values in (("slip_m", 3.0 + settled["time_s"]), ("hottest_degC", 400.0), ("friction", 0.04)):
        settled[name] = np.where(early & (settled["time_s"] > 0), values, settled[name])
    warm, left = panels(figures.slip_surface(settled))
    assert warm.collections[0].get_coordinates()[0, :, 0].tolist() == [*range(3, 10), 10]
    assert warm.collections[0].get_clim() == (15, 65) and warm.get_xlim() == pytest.approx((5 - 0.4, 10))
    assert left.collections[0].get_array().reshape(3, 7)[:, 0].tolist() == [1.0] * 3
    stood = settled | {"slip_m": np.where(early, settled["slip_m"], 0.0)}
    with pytest.raises(records.RecordsError, match="no cell has slipped"):
        figures.slip_surface(stood)
    # what has slid little since is shown, however much came before
    little = settled | {"slip_m": np.where(early, settled["slip_m"], 1e-4 * settled["slip_m"])}
    assert panels(figures.slip_surface(little))[0].get_xlim() == pytest.approx((5 - 0.4, 10))


def test_where_nothing_has_slipped_there_is_no_figure():
    still = cells()
    still["slip_m"] = 0 * still["slip_m"]
    with pytest.raises(records.RecordsError, match="no cell has slipped"):
        figures.slip_surface(still)
    with pytest.raises(records.RecordsError, match="slip_surface.csv"):
        figures.slip_surface({"wall": []})


# ---- slopes beside each other ---------------------------------------------------------------------


def run_of(decay, begin=10.0):
    """A slope that settles for 5 s, slides from ``begin`` on, and loses its friction as exp(−slip/decay)."""
    t = np.arange(0.0, 31.0)
    late = np.maximum(t - begin, 0)
    slip = np.where(t < 5, 7.0, late**2)
    return {
        "time_s": t,
        "stage": np.where(t < 5, 0, 2),
        "speed_mean_m_per_s": np.where(t < 5, 3.0, late),
        "cells_slip_m": slip,
        "cells_friction_rel": np.exp(-slip / decay),
    }


def test_slopes_that_heat_have_friction_by_slip_and_speed_by_time():
    """Those of one label have one colour and one word; what settling has slipped is left out."""
    fig = figures.heated_slopes([("thick", run_of(5.0)), ("thin", run_of(1.0, 12.0)), ("thick", run_of(4.0))])
    left, right = fig.axes
    assert left.get_xscale() == "log" and left.get_xlim()[0] == 0.01 and left.get_ylim() == (0, 1.05)
    assert [t.get_text() for t in right.get_legend().get_texts()] == ["thick", "thin"]
    one, other, third = left.lines
    assert drawn.colour(one) == drawn.colour(third) != drawn.colour(other) and len(right.lines) == 3
    assert drawn.points(one) == pytest.approx(
        np.array([(late**2, np.exp(-(late**2) / 5)) for late in np.arange(1.0, 21.0)])
    )
    # it moves at 0.1 m/s 0.1 s after it begins
    assert drawn.points(right.lines[1]) == pytest.approx(
        np.array([(late - 0.1, late) for late in np.arange(1.0, 19.0)])
    )
    assert right.get_xlim() == pytest.approx((0, 19.9))
    assert right.get_xlabel() == "time since it moved at 0.1 m/s [s]" and left.get_xlabel() == "mean slip [m]"
    assert left.get_ylabel() == "friction by that before slip" and right.get_ylabel() == "mean speed [m/s]"


def test_a_slope_without_a_slip_law_is_beside_them_dashed_and_by_its_speed_alone():
    told = {name: values for name, values in run_of(5.0, 12.0).items() if not name.startswith("cells_")}
    left, right = figures.heated_slopes([("heats", run_of(5.0)), ("is told", told)]).axes
    assert len(left.lines) == 1 and [line.get_linestyle() for line in right.lines] == ["-", "--"]
    assert drawn.points(right.lines[1]) == pytest.approx(
        np.array([(late - 0.1, late) for late in np.arange(1.0, 19.0)])
    )
    assert [t.get_text() for t in right.get_legend().get_texts()] == ["heats", "is told"]
    with pytest.raises(records.RecordsError, match="give at least one of a slope with a slip_law"):
        figures.heated_slopes([("is told", told)])


def test_friction_is_shown_until_the_slip_is_largest():
    """What slides on comes to cells that have slipped less, so that the mean falls."""
    back = run_of(5.0)
    back["cells_slip_m"] = np.where(back["time_s"] > 25, 50.0, back["cells_slip_m"])
    left, right = figures.heated_slopes([("a", back)]).axes
    assert drawn.points(left.lines[0])[-1][0] == 15.0**2 and len(drawn.points(right.lines[0])) == 20


def test_slopes_that_stand_are_left_out_and_alone_they_are_refused():
    still = run_of(5.0, begin=99.0)
    assert len(figures.heated_slopes([("a", still), ("b", run_of(5.0))]).axes[0].lines) == 1
    with pytest.raises(records.RecordsError, match="no slope has moved at 0.1 m/s; give at least one that did"):
        figures.heated_slopes([("a", still)])
