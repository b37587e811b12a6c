"""Figures of the slope in profile, read from their artists: states at the characteristic times, deposit. Needs no
YADE.
"""

import itertools
import re

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

records, figures, style, profiles, ground, fronts, measured = (
    synthetic.load(name)
    for name in (
        "records",
        "figures",
        "figures.style",
        "figures.profiles",
        "measure.ground",
        "measure.fronts",
        "measure.surface",
    )
)
SECTION = synthetic.Section()
# 3 : 4 : 5
WALLS = [
    ("DP", [[-100.0, 75.0], [0.0, 0.0]], "slip"),
    ("FB", [[0.0, 0.0], [3.0, 4.0]], "backstop"),
    ("SS", [[3.0, 4.0], [100.0, 4.0]], "ground"),
]
# dry, wet, released, of even and odd layers
OCHRE, BLUE, PINK = (("#b89b6a", "#ddc99d"), ("#1f5fa8", "#4a90d0"), ("#e06aa6", "#f5a9cd"))


# ---- at the characteristic times ------------------------------------------------------------------

STATE = dict(layer=[0, 1, 2, 3, 0, 1, 0, 1], wet=[0, 0, 0, 0, 1, 1, 1, 1], released=[0, 0, 0, 0, 0, 0, 1, 1])
FILLS = [OCHRE[0], OCHRE[1], OCHRE[0], OCHRE[1], *BLUE, *PINK]


def state(**changes):
    k = np.arange(8)
    made = STATE | {name: np.array(STATE[name], bool) for name in ("wet", "released")} | changes
    return synthetic.few(-10.0 * k - 2, 7.5 * k + 4, r=1 + 0.1 * k, **made)


@pytest.fixture(scope="module")
def two():
    return figures.snapshots([("t0", state(time_s=5.0)), ("on the way", state(time_s=61.26, water_m=12.0))], WALLS)


def test_wet_disks_are_blue_and_released_pink_in_shades_that_alternate_with_the_layers(two):
    for ax in two.axes:
        centres, radii, fills = drawn.disks(ax)
        assert (
            np.array_equal(centres, np.column_stack([state().x, state().y]))
            and np.array_equal(radii, state().r)
            and fills == FILLS
        )
    assert drawn.legend_patches(two.legends[0]) == [*OCHRE, *BLUE, *PINK]
    assert [t.get_text() for t in two.legends[0].get_texts()] == [
        "dry",
        "under pore pressure",
        "pore pressure released",
        "water table",
        "walls: DP, FB, SS",
    ]


def test_panels_follow_in_time_from_the_top_with_one_scale(two):
    upper, lower = two.axes
    assert upper.get_position().y0 >= lower.get_position().y1 - 1e-9
    assert (1 - upper.get_position().y1) * two.get_figheight() < 1  # inch: nothing but a margin stands above
    assert (upper.get_xlim(), upper.get_ylim()) == (lower.get_xlim(), lower.get_ylim())
    # wet is who is not released: 2 of 8
    assert drawn.texts(upper)[-2:] == ["$t_{0}$ = 5.0 s", "water begins to rise\nno water\nwet 25 %, released 25 %"]
    # panels have one scale, whose bar stands in the last
    bars = [[t for t in drawn.texts(ax) if re.fullmatch(r"[\d.]+ m", t)] for ax in (upper, lower)]
    assert [len(told) for told in bars] == [0, 1]
    assert "on the way: 61.3 s" in drawn.texts(lower) and "water table 12.00 m\nwet 25 %, released 25 %" in drawn.texts(
        lower
    )


@pytest.mark.parametrize(
    "label, meaning",
    [
        ("t0", "water begins to rise"),
        ("t1", "limit equilibrium"),
        ("t2", "triggering begins"),
        ("t3", "avalanche in motion"),
        ("t4", "during motion"),
        ("t5", "at rest"),
    ],
)
def test_each_characteristic_time_says_what_it_marks(label, meaning):
    """As section 6 of the paper has them."""
    (ax,) = figures.snapshots([(label, state(time_s=5.0))], WALLS).axes
    assert drawn.texts(ax)[-3:-1] == [f"$t_{{{label[1]}}}$ = 5.00 s", f"{meaning}\nno water\nwet 25 %, released 25 %"]


def test_the_water_table_stands_at_its_height_above_the_plane(two):
    for owner, count in (
        (two.axes[0], 0),
        (two.axes[1], 1),
        (two.axes[0].child_axes[0], 0),
        (two.axes[1].child_axes[0], 1),
    ):
        tables = [one for one in owner.lines if drawn.colour(one) == style.WATER]
        assert len(tables) == count
        for table in tables:  # 12 m along the normal (0.6, 0.8)
            assert drawn.points(table) == pytest.approx(np.array([[-100 + 7.2, 75 + 9.6], [7.2, 9.6]]), rel=1e-12)
    assert drawn.legend(two)["water table"] == style.WATER


def test_walls_are_drawn_and_named_with_the_ground_below_them(two):
    for ax in two.axes:
        lines = [
            drawn.points(one).tolist()
            for one in ax.lines
            if drawn.colour(one) == style.WALL and len(one.get_xdata()) == 2 and one.get_transform() == ax.transData
        ]
        assert [w for _, w, _ in WALLS] == [one for one in lines if one in [w for _, w, _ in WALLS]]
        below = [c for c in ax.collections if drawn.hexes(c.get_facecolor()) == [style.GROUND]]
        assert len(below) == 3
        for filled, (_, wall, _) in zip(below, WALLS):  # from the wall to below the picture
            corners = filled.get_paths()[0].vertices
            assert (
                all(any(np.allclose(corner, point) for corner in corners) for point in wall)
                and corners[:, 1].min() < ax.get_ylim()[0]
            )
    (inset,) = two.axes[0].child_axes
    assert (
        {"DP", "SS"} <= set(drawn.texts(two.axes[0]))
        and "FB" not in drawn.texts(two.axes[0])
        and "FB" in drawn.texts(inset)
    )


def test_the_close_up_shows_the_foot_from_where_its_frame_is():
    fig = figures.snapshots([("t0", state())], WALLS)
    (ax,), ((inset,),) = fig.axes, [fig.axes[0].child_axes]
    (frame,) = (patch for patch in ax.patches if not patch.get_fill())
    (x, y), (x0, x1), (y0, y1) = frame.get_xy(), inset.get_xlim(), inset.get_ylim()
    assert (
        (x, x + frame.get_width(), y, y + frame.get_height()) == pytest.approx((x0, x1, y0, y1), rel=1e-12)
        and x0 < 0 < x1
        and y0 < 0 < y1
    )
    # disks that could be seen, with their own colours
    centres, _, fills = drawn.disks(inset)
    assert (
        0 < len(centres) < 8
        and fills == [dict(zip(state().x, FILLS))[x] for x, _ in centres]
        and (np.abs(centres[:, 0] - (x0 + x1) / 2) < 0.6 * (x1 - x0)).all()
    )
    plain = figures.snapshots([("t0", state())], WALLS, close_up=False)
    assert not plain.axes[0].child_axes and "FB" in drawn.texts(plain.axes[0])


def test_no_snapshot_is_an_error():
    with pytest.raises(records.RecordsError, match="no snapshot"):
        figures.snapshots([], SECTION)


# ---- deposit --------------------------------------------------------------------------------------

# a floor at 20 m
LEVEL = [("DP", [[-100.0, 20.0], [0.0, 20.0]], "slip"), ("SS", [[0.0, 20.0], [300.0, 20.0]], "ground")]


def steps(*blocks, **changes):
    """Disks of half a metre on the floor: blocks of (x from, x to, height [m])."""
    x, y = (
        np.concatenate(part)
        for part in zip(
            *([g.ravel() for g in np.meshgrid(np.arange(a + 0.5, b), np.arange(20.5, 20 + h))] for a, b, h in blocks)
        )
    )
    return synthetic.few(x, y, r=np.full(len(x), 0.5), **changes)


@pytest.fixture(scope="module")
def slid():
    """A high block and a low one to the right of it become a low one and a high one, 100 m on: mirrored, so that a
    profile drawn mirrored would show.
    """
    before = steps((-90, -60, 12), (-60, -30, 6))
    after = steps((10, 40, 6), (40, 70, 12))
    after.layer[:] = (after.y > 24).astype(int) + (after.y > 28)
    return before, after, figures.deposit(after, before, LEVEL)


def test_the_deposit_lies_over_the_initial_surface(slid):
    before, after, fig = slid
    (ax,) = fig.axes
    centres, radii, fills = drawn.disks(ax)
    assert np.array_equal(centres, np.column_stack([after.x, after.y])) and np.array_equal(radii, after.r)
    told = drawn.legend(fig)
    assert list(told)[:3] == ["layer 3 (top)", "layer 2", "layer 1"] and fills == [
        told[("layer 1", "layer 2", "layer 3 (top)")[k]] for k in after.layer
    ]
    (initial,) = (one for one in ax.lines if one.get_linestyle() == "--" and len(one.get_xdata()) > 2)
    x, top = drawn.points(initial).T
    # bins of 3 m
    assert (
        top[x < -61.5] == pytest.approx(32)
        and top[x > -58.5] == pytest.approx(26)
        and -90 < x[0] < -87
        and -33 < x[-1] < -30
    )
    assert told["initial surface"] == drawn.colour(initial)


def test_ways_are_those_of_front_centre_and_thickness(slid):
    _, _, fig = slid
    (ax,) = fig.axes
    words = [t for t in drawn.texts(ax) if ":" in t]
    # the centre: (12 · -75 + 6 · -45)/18 = -65 before, (6 · 25 + 12 · 55)/18 = 45 after
    assert words == ["thickest: 12.0 m", "front: 100.0 m"]
    fig.canvas.draw()
    boxes = [one.get_window_extent() for one in ax.texts if ":" in one.get_text()]
    assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes, 2))
    (low, high, _, both), (start, end, _, on), (tail, head, _, way) = drawn.arrows(ax)
    assert both == "<|-|>" and low[0] == high[0] and 40 < low[0] < 70 and (low[1], high[1]) == pytest.approx((20, 32))
    # an arrow of a thickness reaches what it measures
    (long,) = (t for t in ax.texts if getattr(t, "arrow_patch", None) and t.arrowprops["arrowstyle"] == "<|-|>")
    assert (long.arrow_patch.shrinkA, long.arrow_patch.shrinkB) == (0, 0)
    # the front is 0.1 % of the area behind the last disk, which is in the last row
    assert on == way == "-|>" and (start[0], end[0]) == pytest.approx((-30, 70), abs=1e-9) and start[1] == end[1]
    assert tail == pytest.approx([-65, 25]) and head == pytest.approx([45, 25])
    open_mark, full = (one for one in ax.lines if one.get_marker() == "o")
    assert drawn.points(open_mark)[0] == pytest.approx(tail) and drawn.points(full)[0] == pytest.approx(head)
    assert open_mark.get_markerfacecolor() == "white" and full.get_markerfacecolor() == style.INK
    told = drawn.handles(fig)
    faces = [told[name].get_markerfacecolor() for name in ("centre of mass before", "and after: 110.0 m away")]
    assert faces == ["white", style.INK]


def test_the_centre_of_mass_weighs_disks_by_their_area():
    before, after = (synthetic.few([x, x + 10.0], [22.0, 32.0], r=[1.0, 3.0]) for x in (-80.0, 40.0))
    tail, head, _, _ = drawn.arrows(figures.deposit(after, before, LEVEL).axes[0])[2]
    # nine tenths on the way to the large one
    assert tail == pytest.approx([-71, 31]) and head == pytest.approx([49, 31])


def test_deposit_profile_measures_thickness_and_front():
    """A rectangle of disks, 20 m thick on level ground, with one disk flown far ahead."""
    gx, gy = np.meshgrid(np.arange(0.5, 200), np.arange(0.5, 20))
    x = np.r_[gx.ravel(), 900.0]
    s = synthetic.few(x, np.r_[gy.ravel(), 80.0], r=np.full(len(x), 0.5))
    at, base, surface = measured.deposit_profile(
        s, [("DP", [[-100.0, 0.0], [0.0, 0.0]], "slip"), ("SS", [[0.0, 0.0], [1000.0, 0.0]], "ground")]
    )
    there = np.isfinite(surface)
    assert surface[there] - base[there] == pytest.approx(20.0)
    assert 197 < at[there].max() < 203 and at[there].min() < 3  # bins of 3 m
    assert fronts.front(s) == pytest.approx(200, abs=1)  # a disk


@pytest.mark.parametrize("side", [1, -1])
def test_the_front_leaves_out_a_thousandth_of_the_area(side):
    """Of 2,001 disks of one size in a row the front is the edge of the third from the end, whoever asks: the two beyond
    are 0.9995 of a thousandth. Where they have more, the last one is the front.
    """
    x = np.r_[np.arange(1999.0), 1e5, 2e5]
    s = synthetic.few(side * x, 0 * x, r=np.full(2001, 0.5))
    assert fronts.front(s, side) == fronts.front_of(s.x, s.r, side) == side * 1998.5
    large = synthetic.few(side * x, 0 * x, r=np.r_[np.full(2000, 0.5), 0.9])
    assert fronts.front(large, side) == fronts.front_of(large.x, large.r, side) == side * (2e5 + 0.9)
    # another share, and some layers alone
    assert fronts.front(s, side, 0.99) == fronts.front_of(s.x, s.r, side, 0.99) == side * 1980.5
    of_two = synthetic.few(side * x, 0 * x, r=np.full(2001, 0.5), layer=np.where(x < 1000, 0, 1))
    assert fronts.front(of_two, side, layers=[0]) == side * (998.0 + 0.5)


def test_thickness_is_above_the_lowest_wall():
    s = synthetic.few(np.arange(0.5, 30), np.full(30, 12.0), r=np.full(30, 0.5))
    at, base, surface = measured.deposit_profile(
        s,
        [
            ("DP", [[0.0, 9.0], [30.0, 6.0]], "slip"),
            ("SS", [[0.0, 3.0], [15.0, 4.5]], "ground"),
            ("upright", [[5.0, 0.0], [5.0, 30.0]], "backstop"),
        ],
        bin_m=3,
    )
    assert surface == pytest.approx(12.5) and at == pytest.approx(np.arange(1.5, 30, 3))
    assert base == pytest.approx(np.where(at <= 15, 3 + 0.1 * at, 9 - 0.1 * at))


def mirror(walls):
    """The same walls with left and right exchanged, in their order from left to right."""
    return [(name, (np.array(points) * (-1, 1))[::-1], role) for name, points, role in reversed(walls)]


def test_bins_are_as_wide_as_asked_for_or_three_diameters():
    """Ten disks of 1 m from 0 to 20 m: four bins of 6 m, or 5 of 4 m."""
    s = synthetic.few(np.arange(1.0, 20, 2), np.full(10, 50.0))
    for bin_m, wide, count in ((None, 6.0, 4), (4.0, 4.0, 5)):
        x, _, surface = measured.deposit_profile(s, WALLS, bin_m)
        assert x == pytest.approx(wide * (np.arange(count) + 0.5)) and surface == pytest.approx(np.full(count, 51.0))


def test_a_mirrored_slope_gives_the_mirrored_profile_and_front():
    # no whole number of bins of 3.1 m: they begin at the crown's end on both sides
    s = steps((-90, -60, 12), (-60, -31, 6))
    walls = [("DP", [[-100.0, 8.0], [-50.0, 3.0]], "slip"), ("SS", [[-50.0, 3.0], [0.0, 4.0]], "ground")]
    here, there = measured.deposit_profile(s, walls, bin_m=3.1), measured.deposit_profile(
        synthetic.few(-s.x, s.y, r=s.r), mirror(walls), bin_m=3.1
    )
    for (one, other), sign in zip(zip(here, there), (-1, 1, 1)):
        assert np.array_equal(sign * other, one, equal_nan=True)  # to the last bit
    assert here[2][0] > here[2][15]
    assert fronts.front(synthetic.few(-s.x, s.y, r=s.r), side=-1.0) == -fronts.front(s) == pytest.approx(31, abs=0.2)


def test_an_obstacle_is_no_base():
    s = synthetic.few(np.arange(0.5, 30), np.full(30, 12.0), r=np.full(30, 0.5))
    walls = [("DP", [[0.0, 9.0], [30.0, 6.0]], "slip"), ("house", [[3.0, 1.0], [9.0, 1.0]], "obstacle")]
    assert measured.deposit_profile(s, walls, bin_m=3)[1] == pytest.approx(9 - 0.1 * np.arange(1.5, 30, 3))


# ---- the plane and the view -----------------------------------------------------------------------


def test_water_table_is_parallel_to_the_plane_at_its_height():
    plane = SECTION.walls[0][1]
    moved = ground.ground_of(SECTION).water_points(22.5) - plane
    assert moved == pytest.approx(22.5 * np.array([synthetic.NORMAL, synthetic.NORMAL]))
    # up, whichever end comes first
    assert ground.ground_of([("DP", plane[::-1], "slip")]).water_points(22.5) - plane[::-1] == pytest.approx(moved)
    assert ground.ground_of([("SS", plane, "ground")]).water_points(1.0) is None


def test_water_stands_above_a_plane_that_falls_to_either_side():
    """10 m along the normal (0.6, 0.8) of the plane from (-100, 75), or (-0.6, 0.8) from (100, 75), in whichever order
    its points are given.
    """
    for walls, wanted in ((WALLS, [(-94, 83), (6, 8)]), (mirror(WALLS), [(-6, 8), (94, 83)])):
        for order in (1, -1):
            found = ground.ground_of([(name, np.array(points)[::order], role) for name, points, role in walls])
            points = found.water_points(10.0)
            assert points[np.argsort(points[:, 0])] == pytest.approx(np.array(wanted, float))


def test_a_table_over_a_plane_of_its_own_dips_with_it():
    import dataclasses

    made = synthetic.load("model.section").load("jiufengershan")
    made = dataclasses.replace(made, water=dataclasses.replace(made.water, wall=None, point=(-100.0, 50.0), dip=10.0))
    (x0, y0), (x1, y1) = ground.ground_of(made).water_points(0.0)
    assert (x0, x1) == pytest.approx((-1400.371, 23.294)) and (y0, y1) == pytest.approx(
        [50 - np.tan(np.radians(10)) * (x + 100) for x in (x0, x1)]
    )
    up = ground.ground_of(made).water_points(7.0) - [[x0, y0], [x1, y1]]
    assert up == pytest.approx(7 * np.array([[np.sin(np.radians(10)), np.cos(np.radians(10))]] * 2))
    assert ground.ground_of(dataclasses.replace(made, water=None)).water_points(1.0) is None


# a valley: 3 : 4 down to the origin, 20 m of floor, 1 : 1 up to a crest
VALLEY = [("back", [[-80.0, 60.0], [0.0, 0.0]], "slip"), ("valley", [[0.0, 0.0], [20.0, 0.0], [60.0, 40.0]], "ground")]


def over(walls, normal):
    """The Ground with a water table from a plane of its own through the origin."""
    made = ground.ground_of(walls)
    way = np.array([[-50.0, 50.0 * normal[0] / normal[1]], [0.0, 0.0]])
    return ground.Ground(made.walls, made.side, (way, np.array(normal)))


def axes(x0, x1, y0, y1):
    ax = style.figure(6, 4).add_axes([0, 0, 1, 1])
    style.frame(ax, x0, x1, y0, y1)
    return ax


def drawn_table(line):
    """Both ends of what is seen of a line, of which nothing between them may be missing."""
    x, y = drawn.points(line).T
    (seen,) = np.nonzero(np.isfinite(y))
    assert np.array_equal(seen, np.arange(seen[0], seen[-1] + 1))
    return x[seen[[0, -1]]], y[seen[[0, -1]]]


def test_a_reservoir_ends_at_the_ground_on_both_sides():
    """Its level meets the slip surface and the far side of the valley; a picture that shows neither has it from side to
    side.
    """
    x, y = drawn_table(style.water_line(axes(-100, 100, -10, 60), over(VALLEY, (0.0, 1.0)), 30.0))
    assert y.tolist() == [30, 30]
    assert x == pytest.approx([-40, 50], abs=0.11)  # 2,001 places across 200 m
    x, _ = drawn_table(style.water_line(axes(-10, 15, -10, 60), over(VALLEY, (0.0, 1.0)), 30.0))
    assert x.tolist() == [-10, 15]
    # one that dips by 1 : 10 with the slope: 0.75 s = 30 + 0.1 s on the slip surface, x − 20 = 30 − 0.1 x before it
    tilted = over(VALLEY, np.array([0.1, 1.0]) / np.hypot(0.1, 1))
    assert tilted.table_slope == pytest.approx(-0.1)
    x, y = drawn_table(style.water_line(axes(-100, 100, -10, 60), tilted, 30.0 / np.hypot(0.1, 1) * 1.01))
    assert x == pytest.approx([-30.3 / 0.65, (20 + 30.3) / 1.1], abs=0.2)
    # where it follows a wall it is the moved wall, as ever
    assert drawn.points(style.water_line(axes(-100, 100, -10, 60), ground.ground_of(WALLS), 10.0)) == pytest.approx(
        ground.ground_of(WALLS).water_points(10.0)
    )


def test_the_ground_goes_on_to_the_sides_of_the_picture():
    found = ground.ground_of(VALLEY)
    left, right = found.beyond(-100.0, 100.0)
    # on at 3 : 4; the far side is as steep as 45°, so it goes on level
    assert left == pytest.approx(np.array([[-100, 75], [-80, 60]])) and right == pytest.approx(
        np.array([[60, 40], [100, 40]])
    )
    assert found.beyond(-50.0, 40.0) == []
    assert found.surface(np.array([-100.0, -40.0, 10.0, 40.0, 90.0])) == pytest.approx([75, 30, 0, 20, 40])
    # a mirrored valley goes on in the mirrored way
    right, left = ground.ground_of(mirror(VALLEY)).beyond(-100.0, 100.0)
    assert left == pytest.approx(np.array([[80, 60], [100, 75]])) and right == pytest.approx(
        np.array([[-100, 40], [-60, 40]])
    )
    # filled below: nothing but ground stands in the lower corners
    ax = axes(-100, 100, -10, 60)
    style.draw_walls(ax, found)
    ax.figure.canvas.draw()
    picture = np.asarray(ax.figure.canvas.buffer_rgba())
    for place in ((-95.0, -8.0), (95.0, -8.0)):
        across, up = np.rint(ax.transData.transform(place)).astype(int)
        assert "#{:02x}{:02x}{:02x}".format(*picture[-1 - up, across, :3]) == style.GROUND


def test_what_a_panel_says_lies_on_the_water_table(two):
    (lower,) = (ax for ax in two.axes if any("on the way" in t for t in drawn.texts(ax)))
    (water,) = (one for one in lower.lines if drawn.colour(one) == style.WATER)
    for begin in ("on the way", "water table 12"):
        assert drawn.text(lower, begin).get_zorder() > water.get_zorder()


def test_the_view_holds_all_disks_and_some_ground_before_the_foot():
    left, right = synthetic.few([-50.0, -10.0], [10.0, 40.0]), synthetic.few([-40.0, 120.0], [5.0, 30.0])
    x0, x1, y0, y1 = style.view([left, right], ground.ground_of(WALLS))
    # 1.2 % of 170 m on the left, 3 % on the right; 9 % of 35 m below, 3 % above
    assert (x0, x1, y0, y1) == pytest.approx((-50 - 2.04, 120 + 5.1, 5 - 3.15, 40 + 1.05))
    # 12 % of the 50 m before the foot behind it
    assert style.view([left], ground.ground_of(WALLS))[1] == pytest.approx(6 + 0.03 * 56)


@pytest.mark.parametrize("top, bottom, high", [(20.0, 0.33, 100.0), (50.0, 0.53, 100.0), (80.0, 0.6, 80 / 0.57)])
def test_a_close_up_stands_above_all_that_is_below_it(top, bottom, high):
    """In a panel of 200 m by 100 m from 44.5 % of its width to 79 %, on the side to which the slope falls: over a disk
    up to ``top``, 3 % of the panel's height above it, no lower than a third; where less than 35 % are left under 95 %,
    more sky."""
    disks = synthetic.few([-90.0, 0.0, 90.0], [90.0, top - 4.0, 90.0], r=[4.0] * 3)
    for walls, sign in ((WALLS, 1), (mirror(WALLS), -1)):
        flat = ground.ground_of(walls)
        assert flat.side == sign
        s = synthetic.few(sign * disks.x, disks.y, r=disks.r)
        view, (left, low, width, height) = profiles._room([s], flat, (-100.0, 100.0, 0.0, 100.0))
        assert view == (-100.0, 100.0, 0.0, pytest.approx(high))
        assert (left, width) == pytest.approx((0.445 if sign > 0 else 0.21, 0.345)) and (low, height) == pytest.approx(
            (bottom, 0.95 - bottom)
        )


def test_the_view_goes_with_the_slope():
    """30 m to the right and 200 m up."""
    left, right = synthetic.few([-50.0, -10.0], [10.0, 40.0]), synthetic.few([-40.0, 120.0], [5.0, 30.0])
    moved = [(name, np.array(points) + (30, 200), role) for name, points, role in WALLS]
    for cases in ([left], [left, right]):
        there = style.view([synthetic.few(s.x + 30, s.y + 200, r=s.r) for s in cases], ground.ground_of(moved))
        assert there == pytest.approx(np.add(style.view(cases, ground.ground_of(WALLS)), (30, 30, 200, 200)))


def test_the_view_of_a_mirrored_slope_is_the_mirrored_view():
    left, right = synthetic.few([-50.0, -10.0], [10.0, 40.0]), synthetic.few([-40.0, 120.0], [5.0, 30.0])
    for cases in ([left], [left, right]):
        x0, x1, y0, y1 = style.view(cases, ground.ground_of(WALLS))
        assert style.view([synthetic.few(-s.x, s.y) for s in cases], ground.ground_of(mirror(WALLS))) == (
            -x1,
            -x0,
            y0,
            y1,
        )


@pytest.mark.parametrize("wide, length", [(37.0, 5), (100.0, 20), (250.0, 50), (1600.0, 200)])
def test_scale_bar_is_as_long_as_it_says(wide, length):
    fig = style.figure(4, 2)
    ax = fig.add_axes([0, 0, 1, 1])
    style.frame(ax, -wide / 4, 3 * wide / 4, 0, wide / 2)
    style.scale_bar(ax, x=0.9, share=0.2)
    (bar,) = ax.lines
    assert (
        drawn.texts(ax) == [f"{length} m"]
        and np.ptp(bar.get_xdata()) * wide == pytest.approx(length)
        and max(bar.get_xdata()) == 0.9
    )
    assert bar.get_transform() == ax.transAxes


# ---- runouts --------------------------------------------------------------------------------------


def test_runouts_are_drawn_with_the_way_of_their_fronts():
    before, near, far = steps((-60, -30, 6)), steps((0, 40, 4)), steps((20, 90, 3))
    fig = figures.runouts([("loose", before, near), ("rigid", before, far)], LEVEL)
    for ax, last, words, ends in zip(
        fig.axes, (near, far), ("loose: front 70.0 m", "rigid: front 120.0 m"), ((-30, 40), (-30, 90))
    ):
        centres, _, fills = drawn.disks(ax)
        assert (
            np.array_equal(centres, np.column_stack([last.x, last.y]))
            and set(fills) == {style.LAYERS[0]}
            and words in drawn.texts(ax)
        )
        ((start, end, _, way),) = drawn.arrows(ax)
        assert way == "-|>" and (start[0], end[0]) == pytest.approx(ends, abs=1e-9)
    assert list(drawn.handles(fig)) == ["layer 1", "front of the mass, before and after"]
    upper, lower = fig.axes
    # one scale for all, below
    assert ["20 m" in drawn.texts(ax) for ax in (upper, lower)] == [False, True], drawn.texts(lower)
    assert upper.get_xlim() == lower.get_xlim() and upper.get_position().y0 >= lower.get_position().y1 - 1e-9
    with pytest.raises(records.RecordsError, match="no run to draw"):
        figures.runouts([], LEVEL)


def test_the_free_surface_of_a_field_takes_the_place_of_a_water_table():
    pieces = [np.array([[-50.0, 40.0], [0.0, 5.0]]), np.array([[0.0, 5.0], [50.0, 5.0]])]

    def surface(time):
        return pieces if time > 6 else []

    cases = [("t0", state(time_s=5.0)), ("on the way", state(time_s=61.26, water_m=12.0))]
    fig = figures.snapshots(cases, WALLS, free_surface=surface)
    drawn_lines = [line.get_xydata() for ax in fig.axes for line in ax.lines if line.get_color() == style.WATER]
    assert [len(line) for line in drawn_lines] == [0, 6] and np.isnan(drawn_lines[1][[2, 5]]).all()
    assert np.array_equal(drawn_lines[1][:2], pieces[0]) and np.array_equal(drawn_lines[1][3:5], pieces[1])
    told = "\n".join(text for ax in fig.axes for text in drawn.texts(ax))
    assert "mean head 12" in told and "water table" not in told
    assert "free surface" in [text.get_text() for text in fig.legends[0].get_texts()]
