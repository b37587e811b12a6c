"""Figures of forces, read from their artists: chains in the slope, and sums on its walls against time. Needs no
YADE.
"""

import dataclasses

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

records, figures, forces, style = (
    synthetic.load(name) for name in ("records", "figures", "figures.forces", "figures.style")
)
RecordsError = records.RecordsError
WALLS = [
    ("DP", [[-100.0, 50.0], [0.0, 0.0]], "slip"),
    ("FB", [[0.0, 0.0], [4.0, 8.0]], "backstop"),
    ("SS", [[4.0, 8.0], [60.0, 8.0]], "ground"),
]
BLUE, RED = "#1f5fa8", "#d62728"  # compression, tension
exact = dict(rel=1e-12)  # rounding


# ---- chains ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def slope():
    """Six disks: five at the foot, pressed, pulled and on DP, and one at the top."""
    x, y = [-3.0, -5.0, -1.0, -4.0, 1.0, -80.0], [3.0, 4.0, 4.0, 6.0, 5.0, 43.0]
    contacts = [(0, 1, 4e6), (1, 3, -1e6), (2, 4, 2e6), (0, -1, 3e6, -3.5, 1.75), (4, -2, -0.5e6, 2.0, 4.0)]
    return synthetic.few(x, y, contacts, layer=[0, 0, 1, 2, 2, 1], r=[1.0, 1.0, 1.2, 0.9, 1.0, 1.0])


@pytest.fixture(scope="module")
def chains(slope):
    return figures.force_chains(slope, WALLS)


def test_compression_is_blue_and_tension_red_from_centre_to_centre(slope, chains):
    assert {k: v for k, v in drawn.legend(chains).items() if k in ("compression", "tension")} == {
        "compression": BLUE,
        "tension": RED,
    }
    for window in chains.axes[1:]:
        bars = drawn.bars(window)
        begin, end = (lambda b: (b[:, 0] + b[:, 3]) / 2), (lambda b: (b[:, 1] + b[:, 2]) / 2)
        centre = np.column_stack([slope.x, slope.y])
        assert begin(bars[BLUE]) == pytest.approx(centre[[0, 2, 0]], **exact) and end(bars[BLUE]) == pytest.approx(
            np.array([centre[1], centre[4], [-3.5, 1.75]]), **exact
        )
        assert begin(bars[RED]) == pytest.approx(centre[[1, 4]], **exact) and end(bars[RED]) == pytest.approx(
            np.array([centre[3], [2.0, 4.0]]), **exact
        )


def test_bars_are_as_wide_as_the_scale_says(chains):
    """A force in MN/m beside its bar in the scale, and a contact's bar: the same width for each newton."""
    widths = {
        sign: [np.hypot(*(bar[0] - bar[3])) for bar in drawn.bars(chains.axes[2])[fill]]
        for sign, fill in ((1, BLUE), (-1, RED))
    }
    per_force = np.r_[widths[1], widths[-1]] / np.array([4e6, 2e6, 3e6, 1e6, 0.5e6])
    # the strongest but 0.5 % is 0.6 of a median diameter, of 2 m, wide
    assert per_force == pytest.approx(0.6 * 2 / np.quantile([4e6, 2e6, 3e6, 1e6, 0.5e6], 0.995), rel=1e-9)
    window = chains.axes[2]
    points = (
        72 * chains.get_figwidth() * window.get_position().width / np.ptp(window.get_xlim())
    )  # a metre in the window
    told = {
        float(words.removesuffix(" MN/m")): mark.get_linewidth()
        for words, mark in drawn.handles(chains).items()
        if words.endswith(" MN/m")
    }
    # the largest round force that is not above the largest drawn, and two below
    assert list(told) == [2.0, 1.0, 0.5]
    # the window's shape and that of its limits agree to a per cent
    for force, wide in told.items():
        assert wide / points == pytest.approx(1e6 * force * per_force[0], rel=0.01)
    assert not [t for t in window.texts if "MN" in t.get_text()]  # nothing lies on the chains


def test_the_second_window_is_a_close_up_also_of_few_disks():
    """600 disks, eight in the slope's height: 26 diameters would be nearly all of the first window."""
    few = records.Snapshot(**synthetic.snapshot_arrays(600))
    wide, tight = (np.ptp(ax.get_xlim()) for ax in figures.force_chains(few, synthetic.Section()).axes[1:])
    assert 2.5 <= wide / tight * (1 + 1e-9)


def test_both_windows_have_the_shape_of_their_axes(chains):
    """Equal scales: what is shown is as high by its width as the axes are, to a per cent, as the frame takes no room;
    the foot is near the lower edge.
    """
    for window, below in zip(chains.axes[1:], (0.07, 0.13)):
        height, wide = np.ptp(window.get_ylim()), np.ptp(window.get_xlim())
        place = window.get_position(original=True)
        assert height / wide == pytest.approx(
            place.height * chains.get_figheight() / (place.width * chains.get_figwidth()), rel=0.01
        )
        assert window.get_ylim()[0] == pytest.approx(-below * height, rel=1e-9)


def test_windows_go_with_the_slope_wherever_its_foot_is(slope, chains):
    """A foot that is no origin, as far to the right as it is not high."""
    moved = [(name, np.array(points) + (137.0, 20.0), role) for name, points, role in WALLS]
    contacts = [(0, 1, 4e6), (1, 3, -1e6), (2, 4, 2e6)]
    there = synthetic.few(slope.x + 137.0, slope.y + 20.0, contacts, layer=slope.layer, r=slope.r)
    for before, after in zip(chains.axes, figures.force_chains(there, moved).axes):
        assert np.array(after.get_xlim()) - before.get_xlim() == pytest.approx([137, 137], abs=1e-9)  # rounding
        assert np.array(after.get_ylim()) - before.get_ylim() == pytest.approx([20, 20], abs=1e-9)


def test_the_whole_slope_is_drawn_by_layers(slope, chains):
    top = chains.axes[0]
    centres, radii, fills = drawn.disks(top)
    assert np.array_equal(centres, np.column_stack([slope.x, slope.y])) and np.array_equal(radii, slope.r)
    told = drawn.legend(top)
    assert list(told) == ["3 (top)", "2", "1"] and fills == [
        told[name] for name in ("1", "1", "2", "3 (top)", "3 (top)", "2")
    ]

    def light(c):
        return sum(int(c[k : k + 2], 16) for k in (1, 3, 5))

    assert light(told["1"]) < light(told["2"]) < light(told["3 (top)"])
    assert drawn.texts(chains) == ["t = 0.000 s: 6 disks, 5 contacts, 2 of them in tension"]
    later = dataclasses.replace(slope, time_s=31.25)
    for title, begins in ((None, "t = 31.2 s: 6 disks"), ("Initial state", "Initial state: 6 disks")):
        assert drawn.texts(figures.force_chains(later, WALLS, title=title))[0].startswith(begins)


def test_the_first_window_is_as_wide_as_the_mass_is_high_at_the_foot():
    """1.35 times the height by 4.1 and 4.95, that of its axes; of disks that are small beside it."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(-99.5, 0.0, 1.0), np.arange(0.5, 50.0, 1.0)))
    many = synthetic.few(x, y, [(0, 1, 4e6)], r=np.full(len(x), 0.4))
    window = figures.force_chains(many, WALLS).axes[1]
    assert np.ptp(window.get_xlim()) == pytest.approx(1.35 * 49.5 * 4.95 / 4.1, rel=1e-9)


def test_windows_show_all_disks_that_reach_into_them(slope):
    """Also those whose centres lie outside; what is two radii off is not drawn."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(-99.5, 60.0, 2.1), np.arange(0.5, 60.0, 2.1)))
    many = synthetic.few(x, y, [(0, 1, 4e6)])
    for window in figures.force_chains(many, WALLS).axes[1:]:
        (x0, x1), (y0, y1) = window.get_xlim(), window.get_ylim()
        centres = drawn.disks(window)[0]
        away = np.hypot(x - np.clip(x, x0, x1), y - np.clip(y, y0, y1))
        shown = {tuple(c) for c in centres}
        assert {(a, b) for a, b, far in zip(x, y, away) if far < 1.0} <= shown
        assert (
            len(shown) < len(x) and max(np.hypot(a - np.clip(a, x0, x1), b - np.clip(b, y0, y1)) for a, b in shown) < 3
        )


def test_the_scale_of_a_window_is_a_round_length_of_a_sixth_at_most(chains):
    for window in chains.axes[1:]:
        (bar,) = [one for one in window.lines if one.get_transform() == window.transAxes and one.get_linewidth() == 3]
        long = np.ptp(bar.get_xdata()) * np.ptp(window.get_xlim())
        assert 0.17 / 2.6 < np.ptp(bar.get_xdata()) <= 0.17  # the next round one is 2.5 times as long at most
        (words,) = [t for t in drawn.texts(window) if t.endswith(" m")]
        assert float(words.removesuffix(" m")) == pytest.approx(long, rel=1e-9)


def test_windows_are_where_their_frames_are(chains):
    top, *windows = chains.axes
    frames = [patch for patch in top.patches if not patch.get_fill()]
    for letter, frame, window in zip("ab", frames, windows, strict=True):
        box = (*window.get_xlim(), *window.get_ylim())
        x, y = frame.get_xy()
        assert (x, x + frame.get_width(), y, y + frame.get_height()) == pytest.approx(box, **exact)
        assert letter in drawn.texts(window) and drawn.text(top, letter).get_position() == pytest.approx(
            (x, y), **exact
        )
        assert box[0] < 0 < box[1] and box[2] < 0 < box[3]  # the foot is at the origin
    # all of the first frame and all centres are in sight, with 2 % of the slope's width, from -80 m to 1 m, beside them
    (left, low), width = frames[0].get_xy(), frames[0].get_width()
    assert top.get_xlim() == pytest.approx((min(-80, left) - 0.02 * 81, max(1, left + width) + 0.02 * 81), **exact)
    assert top.get_ylim() == pytest.approx((min(3, low) - 0.02 * 81, 43 + 0.02 * 81), **exact)
    # a on the left, both below
    assert (
        windows[0].get_position().x1 < windows[1].get_position().x0
        and windows[0].get_position().y1 < top.get_position().y0
    )


@pytest.mark.parametrize("side", [1, -1])
def test_names_of_walls_do_not_cover_each_other_nor_the_scale(slope, side):
    """Three walls that end at one foot, with long names: each has its name or none, and none lies on another, on the
    letter or on the scale.
    """
    low = [(name, np.array(points) * (side, 1), role) for name, points, role in WALLS]
    long = [(f"the {role} called {name}", points, role) for name, points, role in low]
    more = [("a second slip surface", np.array([[-100.0, 49.0], [0.0, -1.0]]) * (side, 1), "slip")]
    mirrored = dataclasses.replace(slope, x=side * slope.x, cx=side * slope.cx)
    fig = figures.force_chains(mirrored, long + more)
    for window in fig.axes[1:]:
        renderer = fig.canvas.get_renderer()
        boxes = [one.get_window_extent(renderer) for one in window.texts]
        assert len(boxes) >= 4  # the letter, the scale and two names
        edges = window.get_window_extent()
        assert all(edges.x0 <= box.x0 and box.x1 <= edges.x1 for box in boxes)
        assert not [(a, b) for k, a in enumerate(boxes) for b in boxes[:k] if a.overlaps(b)]


def test_bars_of_many_disks_join_centres_and_are_as_wide_as_the_force():
    s = records.Snapshot(**synthetic.snapshot_arrays(600))
    pairs, wall = np.flatnonzero(s.cj >= 0)[:50], np.flatnonzero(s.cj < 0)[:20]
    bars = forces.force_bars(s, pairs, reference=2e6, width=3.0)
    assert np.hypot(*(bars[:, 0] - bars[:, 3]).T) == pytest.approx(3.0 * np.abs(s.cn[pairs]) / 2e6)
    assert (bars[:, 0] + bars[:, 3]) / 2 == pytest.approx(np.column_stack([s.x[s.ci[pairs]], s.y[s.ci[pairs]]]))
    assert (bars[:, 1] + bars[:, 2]) / 2 == pytest.approx(np.column_stack([s.x[s.cj[pairs]], s.y[s.cj[pairs]]]))
    assert forces.force_bars(s, wall, 2e6, 3.0)[:, 1:3].mean(axis=1) == pytest.approx(
        np.column_stack([s.cx[wall], s.cy[wall]])
    )


def test_windows_look_at_the_lowest_disk_where_none_is_near_the_foot():
    high = synthetic.few([-80.0, -78.0, -60.0], [50.0, 50.0, 40.0], [(0, 1, 1e6)], r=[1.0, 1.0, 2.0])
    for s, x, y in ((high, -60.0, 38.0), (synthetic.few([-50.0], [40.0], [(0, -1, 1e6, -50.0, 39.0)]), -50.0, 39.0)):
        for window in figures.force_chains(s, WALLS).axes[1:]:
            assert window.get_xlim()[0] < x < window.get_xlim()[1] and window.get_ylim()[0] < y < window.get_ylim()[1]


def test_chains_without_contacts_say_so():
    with pytest.raises(RecordsError, match="no contacts"):
        figures.force_chains(synthetic.few([0.0, 2.0], [1.0, 1.0]), WALLS)


# ---- against time ---------------------------------------------------------------------------------

TIMES = {"t0": 10.0, "t1": 40.0, "t2": 50.0, "t3": 60.0, "t4": 70.0, "t5": 90.0}
TOTAL, EFFECTIVE, PORE = "$N_{DP}$  total", "$N'_{DP}$  effective", "$U_{DP}$  water pressure"
SHEAR, BACK = "$T_{DP}$  shear on DP", "$N'_{FB}$  normal on FB"
SHEAR_CHANGE, BACK_CHANGE = "$\\Delta T_{DP}$  since $t_0$", "$\\Delta N'_{FB}$  since $t_0$"
# the columns in MN/m, each a straight line, which a running mean leaves as it is
STRAIGHT = {
    "dp_normal_total_N_per_m": (1000, 2),
    "dp_normal_effective_N_per_m": (700, 1),
    "dp_water_N_per_m": (300, 1),
    "dp_shear_N_per_m": (250, -3),
    "fb_normal_N_per_m": (100, 4),
}


def straight(**changes):
    t = np.linspace(0, 100, 1001)
    return {
        "time_s": t,
        "water_m": 0.2 * t,
        **{name: 1e6 * (a + b * t) for name, (a, b) in STRAIGHT.items()},
        **changes,
    }


@pytest.fixture(scope="module")
def courses():
    return figures.forces_against_time(straight(), TIMES)


def panels(fig):
    """The two panels of the whole run, those of the enlarged part, and the axes of the water table: by their labels."""
    whole = [ax for ax in fig.axes if ax.get_ylabel() == "force [MN/m]"]
    water = [ax for ax in fig.axes if any("$h_w$" in one.get_label() for one in ax.lines)]
    close = [ax for ax in fig.axes if ax not in whole + water and any("DP" in one.get_label() for one in ax.lines)]
    return whole, close, water


def test_each_force_is_its_column_in_meganewtons(courses):
    whole, close, water = panels(courses)

    def at(a, b):
        return a + b * straight()["time_s"]

    for upper, lower in (whole, close):
        for ax, label, values in (
            (upper, TOTAL, at(1000, 2)),
            (upper, EFFECTIVE, at(700, 1)),
            (upper, PORE, at(300, 1)),
            (lower, SHEAR, at(250, -3)),
            (lower, BACK, at(100, 4)),
            (lower, SHEAR_CHANGE, at(30, -3)),
            (lower, BACK_CHANGE, at(-40, 4)),
        ):  # 0 at t0, 10 s
            got = drawn.points(drawn.line(ax, label))
            assert got[:, 0] == pytest.approx(straight()["time_s"]) and got[:, 1] == pytest.approx(
                values, abs=1e-6
            ), label  # sums over 1000 rows of 1e9 N/m
    assert len(water) == 2
    for ax in water:
        assert drawn.points(drawn.line(ax, "$h_w$  water table (right axis)"))[:, 1] == pytest.approx(
            0.2 * straight()["time_s"]
        )
    assert water[1].get_ylabel() == "water table above DP [m]" and water[1].yaxis.get_label_position() == "right"
    assert [ax.get_xlabel() for ax in (whole[1], close[1])] == ["time [s]", "time [s], failure and triggering enlarged"]


def test_legends_have_the_colours_of_their_lines_and_of_the_sketch(courses):
    whole, _, water = panels(courses)
    told = drawn.legend(courses)
    lines = [one for ax in (*whole, water[1]) for one in ax.lines if not one.get_label().startswith("_")]
    assert told == {one.get_label(): drawn.colour(one) for one in lines} and len(told) == 8
    assert len({told[name] for name in (TOTAL, EFFECTIVE, PORE)}) == 3 and told[SHEAR] != told[BACK]
    # changes have the colour of what changes, and are dashed
    assert told[SHEAR] == told[SHEAR_CHANGE] and told[BACK] == told[BACK_CHANGE]
    assert [drawn.line(whole[1], name).get_linestyle() for name in (SHEAR, SHEAR_CHANGE, BACK, BACK_CHANGE)] == [
        "-",
        "--",
        "-",
        "--",
    ]
    sketch = courses.axes[0]
    by_name = {t.get_text(): t.get_color() for t in sketch.texts if t.get_text()}
    for name, label in (("$N_{DP}$", TOTAL), ("$T_{DP}$", SHEAR), ("$N'_{FB}$", BACK)):
        assert style.to_rgba_array([by_name[name]])[0] == pytest.approx(style.to_rgba_array([told[label]])[0])
    assert style.to_rgba_array([by_name["$h_w$"]])[0] == pytest.approx(style.to_rgba_array([style.WATER])[0])


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_sketch_has_the_water_table_of_the_slope(side):
    """Parallel to the surface where it follows it; level where it is a reservoir's, from the surface to the backstop,
    or beyond the toe where there is none.
    """

    def table(**options):
        ax = style.figure(3, 2).add_axes([0, 0, 1, 1])
        forces._sketch(ax, side, "DP", wet=True, **options)
        (one,) = (line for line in ax.lines if drawn.colour(line) == style.WATER)
        return drawn.points(one) * (side, 1)

    down = -np.tan(np.radians(21))
    (a, b), (c, d) = table(back="FB"), table(back="FB", rise=0.0)
    assert (b - a)[1] / (b - a)[0] == pytest.approx(down, rel=1e-9)
    assert c[1] == d[1] and c[1] == pytest.approx(down * c[0], rel=1e-9) and d[0] == pytest.approx(1.6 / 2.6, abs=0.01)
    a, b = table(back="", rise=-0.1)
    assert b[0] > 2 and (b - a)[1] / (b - a)[0] == pytest.approx(-0.1, rel=1e-9)
    assert forces.ground_of(synthetic.load("model.section").load("chair")).table_slope == 0  # a reservoir
    assert forces.ground_of(WALLS).table_slope is None


@pytest.mark.parametrize("side", [1, -1])
def test_the_sketch_falls_to_the_side_that_the_slope_falls_to(side):
    """On the picture, whatever the axes' own direction: the crown is above, on the other side."""
    walls = [(name, np.array(points) * (side, 1), role) for name, points, role in WALLS]
    sketch = figures.forces_against_time(straight(), TIMES, walls=walls).axes[0]
    (rock,) = (p for p in sketch.patches if drawn.hexes([p.get_facecolor()]) == ["#ead9b5"])
    corners = sketch.transData.transform(rock.get_xy())
    crown, foot = corners[np.argmax(corners[:, 1])], corners[np.argmin(corners[:, 1])]
    assert side * (foot[0] - crown[0]) > 50 and crown[1] > foot[1] + 20  # pixels of a sketch some 280 wide


def test_the_sketch_shows_what_the_walls_exert_on_the_mass(courses):
    """The plane pushes up along its normal and holds the mass back, up the slope; the backstop pushes back towards the
    slope.
    """
    sketch = courses.axes[0]
    turn = np.radians(21)
    normal, down = np.array([np.sin(turn), np.cos(turn)]), np.array([np.cos(turn), -np.sin(turn)])
    found = drawn.arrows(sketch)
    ways = {fill: (head - tail) / np.hypot(*(head - tail)) for tail, head, fill, _ in found}
    assert all(mark == "-|>" for *_, mark in found) and len(found) == 3
    blue, orange, green = (style.LINES[name].lower() for name in ("blue", "orange", "green"))
    # the sketch rounds the directions to three digits
    assert ways[blue] @ normal == pytest.approx(1, abs=1e-3) and ways[orange] @ -down == pytest.approx(1, abs=1e-3)
    # the backstop leans back, its normal a little steeper than the slope
    assert ways[green] @ -down == pytest.approx(1, abs=1e-2)
    (rock,) = (p for p in sketch.patches if drawn.hexes([p.get_facecolor()]) == ["#ead9b5"])
    assert sketch.get_ylim()[0] < rock.get_xy()[:, 1].min() and rock.get_xy()[:, 1].max() < sketch.get_ylim()[1]
    tips = {fill: head for _, head, fill, _ in found}
    assert tips[blue] @ normal == pytest.approx(0, abs=0.01)  # on the plane


def test_times_stand_at_their_places(courses):
    whole, close, _ = panels(courses)
    for ax, inside in [(ax, TIMES.values()) for ax in whole] + [(ax, (40.0, 50.0, 60.0)) for ax in close]:
        assert set(drawn.uprights(ax)) == set(inside)
    for ax in (whole[0], close[0]):  # labels above the upper panels
        x0, x1 = ax.get_xlim()
        places = {t.get_text(): x0 + t.get_position()[0] * (x1 - x0) for t in ax.texts}
        assert places == pytest.approx({f"$t_{{{name[1]}}}$": at for name, at in TIMES.items() if x0 <= at <= x1})
    assert not drawn.texts(whole[1])
    # 0.45 of the 20 s between t1 and t3 on both sides
    assert [ax.get_xlim() for ax in whole] == [(0, 100)] * 2 and [ax.get_xlim() for ax in close] == [
        pytest.approx((31, 69))
    ] * 2


def test_phases_are_coloured_and_named(courses):
    expected = [(10, 40, "#dcebf7"), (40, 50, "#fff3c4"), (50, 60, "#fbd9c0"), (60, 90, "#efe3ee")]
    whole, close, _ = panels(courses)
    for ax in whole:
        assert drawn.bands(ax) == expected
    for ax in close:  # cut off at its limits
        assert drawn.bands(ax) == [
            (pytest.approx(31), 40, "#dcebf7"),
            *expected[1:3],
            (60, pytest.approx(69), "#efe3ee"),
        ]
    strips = [
        {t.get_text(): t.get_position()[0] for t in ax.texts}
        for ax in courses.axes
        if not ax.axison and ax is not courses.axes[0]
    ]
    # names stand in the middle of their phases, where there is room
    assert strips == [
        pytest.approx(
            {"water table rises": 25, "failure": 45, "avalanche motion": 75}
            | ({"triggering": 55} if "triggering" in strips[0] else {})
        ),
        pytest.approx({"failure": 45, "triggering": 55}),
    ]


def test_a_slope_that_does_not_weaken_moves_from_t2_on():
    times = {"t0": 10.0, "t1": 40.0, "t2": 50.0, "t3": None, "t4": 70.0, "t5": 90.0}
    ax = style.figure(8, 3).add_subplot()
    ax.set_xlim(0, 100)
    style.shade_phases(ax, times)
    wanted = [(10, 40, "#dcebf7"), (40, 50, "#fff3c4"), (50, 90, "#efe3ee")]
    assert drawn.bands(ax) == wanted
    style.shade_phases(ax, times | {"t5": None})  # it goes on
    assert drawn.bands(ax)[3:] == wanted[:2]


def test_zero_of_the_water_table_is_that_of_the_forces_and_all_means_are_in_sight(courses):
    whole, close, water = panels(courses)
    for upper, table in zip((whole[0], close[0]), water):
        assert upper.get_ylim() == pytest.approx((-72, 1272))  # 6 % beyond 0 and 1200 MN/m
        low, high = table.get_ylim()
        assert high == pytest.approx(25) and low / high == pytest.approx(-72 / 1272)  # a quarter more than 20 m
    # from ΔT, -270 at the end, to N_FB, 500, and 6 % of 770 beyond
    assert whole[1].get_ylim() == close[1].get_ylim() == pytest.approx((-270 - 46.2, 500 + 46.2))


def test_means_begin_when_the_avalanche_moves():
    """A jump of one row is seen whole before t3; behind it a line shows its part of the mean over the window, with the
    jump pale behind.
    """
    fb = np.zeros(1001)
    fb[200], fb[750] = 42e6, 42e6  # 20 s and 75 s
    fig = figures.forces_against_time(straight(fb_normal_N_per_m=fb), TIMES, window=2.0)
    whole, _, _ = panels(fig)
    mean = drawn.points(drawn.line(whole[1], BACK))[:, 1]
    assert mean[200] == pytest.approx(42) and mean[199] == mean[201] == 0
    assert mean[[739, 740, 750, 760, 761]] == pytest.approx([0, 2, 2, 2, 0], abs=1e-9)  # 21 rows of 0.1 s
    pale = [one for one in whole[1].lines if one.get_alpha() == 0.25]
    assert len(pale) == 2 and all(one.get_xdata()[0] > 60 for one in pale)
    (jump,) = (one for one in pale if drawn.colour(one) == style.LINES["green"].lower())
    assert dict(drawn.points(jump).tolist())[75.0] == pytest.approx(42)
    assert any(
        said.startswith("per metre of width. From $t_3$ on: lines are means over 2 s") for said in drawn.texts(fig)
    )


@pytest.mark.parametrize(
    "times, columns, said",
    [
        ({}, 1, "Every value is shown."),
        (None, 1, "Every value is shown."),
        ({"t0": 10.0, "t1": None}, 1, "Every value is shown."),
        ({**TIMES, "t3": float("nan")}, 1, "Every value is shown."),
        (type("Section", (), {"times": TIMES}), 2, "means over 1 s"),
    ],
)
def test_times_that_are_not_known_are_left_out(times, columns, said):
    fig = figures.forces_against_time(straight(), times)
    whole, close, water = panels(fig)
    assert (
        len(whole) == 2
        and len(close) == 2 * (columns - 1)
        and len(water) == columns
        and any(said in words for words in drawn.texts(fig))
    )
    change = drawn.points(drawn.line(whole[1], SHEAR_CHANGE))[:, 1]
    # without t0 since the first row
    assert change == pytest.approx((30 if times else 0) - 3 * straight()["time_s"], abs=1e-6)


def test_a_single_row_and_none():
    one = {name: values[500:501] for name, values in straight().items()}
    whole, _, _ = panels(figures.forces_against_time(one, {}))
    assert drawn.points(drawn.line(whole[1], BACK)).tolist() == [[50.0, 300.0]] and whole[
        1
    ].get_xlim() == pytest.approx((50, 50))
    with pytest.raises(RecordsError, match="no column.*dp_shear"):
        figures.forces_against_time({k: v for k, v in one.items() if "dp_shear" not in k}, {})
    with pytest.raises(RecordsError, match="no rows"):
        figures.forces_against_time({name: values[:0] for name, values in one.items()}, {})


def test_labels_of_close_times_stand_apart_in_their_order():
    fig = figures.forces_against_time(straight(), {"t0": 10.0, "t1": 50.0, "t2": 50.2, "t3": 50.4, "t5": 90.0})
    ax = panels(fig)[0][0]
    at = {t.get_text(): t.get_position()[0] for t in ax.texts}
    # the gap of 0.022, nearly reached by pushing
    assert list(at) == [f"$t_{{{k}}}$" for k in (0, 1, 2, 3, 5)] and np.diff(list(at.values())).min() > 0.0219
    assert at["$t_{2}$"] == pytest.approx(0.502, abs=1e-3) and at["$t_{0}$"] == pytest.approx(0.1)
