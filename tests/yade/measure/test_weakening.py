"""Where slip surfaces are weakened: as a measure of snapshots, in profile, and in the course of time. Needs no YADE."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

records, figures, style, measured, section, similar = (
    synthetic.load(name)
    for name in ("records", "figures", "figures.style", "measure.weakening", "model.section", "model.section.similar")
)
DOWN, NORMAL = np.array([0.8, -0.6]), np.array([0.6, 0.8])  # of a slope of 3 : 4 : 5 that falls to the right
PLANE = [[-48.0, 36.0], [0.0, 0.0]]  # 60 m, of ten bins of three mean diameters of 2 m


def on_plane(*places, weak=(), apart=1.0, side=1.0, **changes):
    """Disks of 1 m of radius at distances from the upper end, ``apart`` from the plane; those with the numbers ``weak``
    are weakened on it.
    """
    at = np.array([PLANE[0] + s * DOWN + apart * NORMAL for s in places])
    return synthetic.few(side * at[:, 0], at[:, 1], weakened=np.isin(np.arange(len(places)), weak)[:, None], **changes)


def shares(snapshot, line=PLANE, column=0, side=1.0):
    """{number of the bin: share} where disks are."""
    _, share = measured.weakened_share(snapshot, line, column, side)
    return {k: float(one) for k, one in enumerate(share) if not np.isnan(one)}


# ---- the measure ------------------------------------------------------------------------------------
def test_shares_are_those_of_the_disks_in_each_bin():
    shot = on_plane(1.0, 5.9, 6.1, 11.0, 40.0, weak=(1, 4))
    edges, share = measured.weakened_share(shot, PLANE, 0)
    assert edges == pytest.approx(np.arange(0, 61, 6), abs=1e-12) and share.shape == (10,)
    assert shares(shot) == {0: 0.5, 1: 0.0, 6: 1.0}


def test_disks_off_the_surface_and_beyond_its_ends_are_not_on_it():
    assert shares(on_plane(10.0, weak=(0,), apart=1.49)) == {1: 1.0}  # a quarter of the mean diameter: 0.5 m
    assert shares(on_plane(10.0, weak=(0,), apart=1.51)) == {}
    assert shares(on_plane(0.1, 59.9)) == {0: 0.0, 9: 0.0} and shares(on_plane(-0.1, 60.1)) == {}


def test_places_go_on_over_the_vertices_of_a_surface():
    """20 m down at 45 degrees, then 10 m level, with corners that disks may stand behind of."""
    r = 0.5**0.5
    line = [[-20 * r, 20 * r], [0.0, 0.0], [10.0, 0.0]]
    on = np.array([[-20 * r + 7 * r + r, 20 * r - 7 * r + r], [6.0, 1.0], [-0.3, 1.2]])  # at 7 m, at 26 m, near 20 m
    shot = synthetic.few(*on.T, weakened=[[False, True], [False, False], [True, False]])
    assert shares(shot, line, column=1) == {1: 1.0, 3: 0.0, 4: 0.0}
    assert shares(shot, line, column=0) == {1: 0.0, 3: 1.0, 4: 0.0}
    assert shares(shot, line[::-1]) == shares(shot, line)  # whichever way its vertices go


def test_a_mirrored_slope_has_the_same_shares():
    places, weak = (3.0, 20.0, 21.0, 44.0), (1, 3)
    mirrored = [[-x, y] for x, y in PLANE]
    assert shares(on_plane(*places, weak=weak, side=-1.0), mirrored, side=-1.0) == shares(on_plane(*places, weak=weak))


def test_stretches_are_bins_of_which_half_is_weakened_joined():
    edges = np.arange(0.0, 8.0)
    share = np.array([0.5, 1.0, 0.49, np.nan, 0.0, 1.0, 0.7])
    assert measured.stretches(edges, share) == [(0.0, 2.0), (5.0, 7.0)]
    assert measured.stretches(edges, np.full(7, np.nan)) == []


def test_a_stretch_has_the_vertices_between():
    line = [[0.0, 10.0], [0.0, 0.0], [10.0, 0.0]]
    assert measured.stretch(line, 4.0, 15.0).tolist() == [[0, 6], [0, 0], [5, 0]]
    assert measured.stretch(line, 12.0, 15.0).tolist() == [[2, 0], [5, 0]]
    assert measured.stretch([[0.0, 0.0], [10.0, 10.0]], 0.0, 50**0.5, side=-1.0) == pytest.approx(
        np.array([[10, 10], [5, 5]])
    )


# ---- in profile -------------------------------------------------------------------------------------
#: Stands for a section: a plane that weakens, and a valley that does not.
SLOPE = SimpleNamespace(
    walls=[("SS", [[0.0, 0.0], [40.0, 0.0]], "ground"), ("DP", PLANE, "slip")], weakening=[SimpleNamespace(name="DP")]
)


def red(ax):
    return [drawn.points(one) for one in ax.lines if drawn.colour(one) == style.WEAKENED]


def test_the_weakened_part_of_a_slip_surface_is_red_in_profile_and_close_up():
    shot = on_plane(1.0, 7.0, 13.0, 50.0, weak=(1, 2))
    fig = figures.snapshots([("t2", on_plane(1.0, 7.0)), ("t3", shot)], SLOPE)
    before, after = fig.axes
    assert red(before) == [] and drawn.legend(fig)["weakened"] == style.WEAKENED
    for ax in (after, after.child_axes[0]):
        (part,) = red(ax)
        assert part == pytest.approx(np.array([PLANE[0] + s * DOWN for s in (6, 18)]), rel=1e-12)


def test_nothing_is_red_where_nobody_told():
    old = dataclasses.replace(on_plane(1.0, 7.0, weak=(0, 1)), weakened=None)
    for cases, walls in (([("t3", old)], SLOPE), ([("t3", on_plane(1.0, 7.0, weak=(0, 1)))], SLOPE.walls)):
        fig = figures.snapshots(cases, walls)
        assert red(fig.axes[0]) == [] and "weakened" not in drawn.legend(fig)


@pytest.mark.parametrize("name", section.shipped())
def test_each_surface_of_a_section_that_weakens_has_its_column(name):
    """Walls, then interfaces, of this slope and of the mirrored one."""
    for made in (section.load(name), similar.mirrored(section.load(name))):
        ground, lines = synthetic.load("measure.ground").ground_of(made), dict(made.slip_surfaces)
        assert {k: wall.name for k, wall in ground.weakening.items()} == {
            k: one.name for k, one in enumerate(made.weakening)
        }
        # slip surfaces all of them, in those that are shipped, and all of those but of slopes that stand, or that heat
        none = name in ("priest", "acads_1a", "acads_1c", "griffiths_lane", "vaiont", "jiufengershan_heated")
        assert {wall.name for wall in ground.weakening.values()} == (set() if none else set(lines))
        assert all(np.array_equal(wall.vertices, lines[wall.name]) for wall in ground.weakening.values())


# ---- in the course of time --------------------------------------------------------------------------
COURSE = [
    on_plane(1.0, 7.0, 55.0, time_s=10.0),
    on_plane(1.0, 7.0, 55.0, weak=(0,), time_s=11.0),
    on_plane(7.0, 9.0, 55.0, weak=(0,), time_s=14.0),
]


def cells(ax):
    """Edges of times and places, and values (times, places) of what is drawn."""
    (mesh,) = ax.collections
    corners = mesh.get_coordinates()
    values = np.ma.filled(mesh.get_array().astype(float), np.nan).reshape(corners.shape[0] - 1, -1)
    return corners[0, :, 0], corners[:, 0, 1], values.T


def test_cells_are_shares_in_time_and_place():
    fig = figures.weakening(iter(COURSE), SLOPE, times={"t1": 10.5, "t2": 11.0, "t3": None})
    (ax,) = fig.axes
    times, places, values = cells(ax)
    assert times.tolist() == [10.0, 10.5, 12.5, 14.0] and places == pytest.approx(np.arange(0, 61, 6))
    wanted = np.full((3, 10), np.nan)
    wanted[0, [0, 1, 9]], wanted[1, [0, 1, 9]], wanted[2, [1, 9]] = 0, (1, 0, 0), (0.5, 0)
    assert np.array_equal(values, wanted, equal_nan=True)
    assert ax.get_ylim() == (60.0, 0.0)  # the upper end is at the top
    assert ax.get_ylabel() == "along DP,\nfrom its upper end [m]" and ax.get_xlabel() == "time [s]"
    assert drawn.texts(ax) == ["$t_{1}$", "$t_{2}$"]
    colours = drawn.legend(ax)
    assert [colours["slip below $D_c$"], colours["slip beyond $D_c$:\nweakened"]] == [style.STRONG, style.WEAKENED]
    (mesh,) = ax.collections
    assert mesh.norm(0.0) == 0 and mesh.norm(1.0) == 1
    assert drawn.hexes([mesh.cmap(0.0), mesh.cmap(1.0)]) == [style.STRONG, style.WEAKENED]


def test_each_surface_has_a_panel_in_its_own_unit():
    short = [[0.0, 0.0], [1.2, -0.9]]  # 1.5 m
    slope = SimpleNamespace(
        walls=[("long", PLANE, "slip"), ("short", short, "slip")],
        weakening=[SimpleNamespace(name="long"), SimpleNamespace(name="short")],
    )
    shot = synthetic.few([-40.0, 1.0], [31.5, 0.5], weakened=[[True, False], [False, True]])
    long, brief = figures.weakening([shot], slope).axes
    assert (long.get_ylabel(), brief.get_ylabel()) == (
        "along long,\nfrom its upper end [m]",
        "along short,\nfrom its upper end [cm]",
    )
    assert (long.get_xlabel(), brief.get_xlabel()) == ("", "time [s]") and long.get_legend() and not brief.get_legend()
    assert np.nanmax(cells(long)[2]) == 1 and cells(brief)[2].tolist() == [[1.0]]
    assert cells(brief)[1] == pytest.approx([0, 150])


def test_what_cannot_be_drawn_is_an_error():
    for cases, walls in (([], SLOPE), (COURSE, SLOPE.walls)):
        with pytest.raises(records.RecordsError, match="no snapshot to draw, or no wall|does not tell"):
            figures.weakening(cases, walls)
    for told in (None, np.zeros((3, 2), bool)):
        with pytest.raises(records.RecordsError, match="does not tell which disks are weakened"):
            figures.weakening([dataclasses.replace(COURSE[0], weakened=told)], SLOPE)


def test_the_foot_that_is_not_weakened_is_what_lies_below_the_lowest_weakened_bin():
    edges = np.arange(0.0, 60.0, 10.0)  # five bins
    assert measured.foot_length(edges, np.array([1, 1, 0.6, 0.4, np.nan])) == 20.0
    assert measured.foot_length(edges, np.array([1, 0, 0, 0, 0.5])) == 0.0
    assert measured.foot_length(edges, np.zeros(5)) == 50.0
