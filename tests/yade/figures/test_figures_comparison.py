"""Figures of hard against soft, read from their artists. Needs no YADE."""

import numpy as np
import pytest
from matplotlib.patches import PathPatch
from shapely.geometry import Point, Polygon, box

import drawn
import synthetic_slope as synthetic

figures, style = (synthetic.load(name) for name in ("studies.comparison.figures", "figures.style"))
HARD, SOFT, GREY = "#0072b2", "#d55e00", "#777777"
MODULI = [1e7, 1e8, 1e9]


def test_stiffer_contacts_are_darker():
    light = [sum(int(figures.shade(e, MODULI)[k : k + 2], 16) for k in (1, 3, 5)) for e in MODULI]
    assert light[0] > light[1] > light[2] and figures.shade(1e7, [1e7]) == figures.SHADES[0]
    assert figures.shade(1e9, MODULI[::-1]) == figures.shade(1e9, MODULI)


def test_deposits_over_each_other():
    """Of the hard deposit alone, of the soft one alone, and of both: each where it is, in its colour."""
    hard, soft, begin = box(0, 0, 10, 4), box(6, 0, 20, 4), box(-30, 0, -20, 8)
    fig = figures.deposits_overlaid(
        hard,
        soft,
        begin,
        [("DP", [[-40.0, 10.0], [0.0, 0.0]], "slip"), ("SS", [[0.0, 0.0], [40.0, 0.0]], "ground")],
        0.2,
    )
    (ax,) = fig.axes
    told = drawn.legend(fig)
    assert (
        list(told) == ["both: 20 % of the area of either", "hard alone", "soft alone", "before"]
        and told["hard alone"] == HARD
        and told["soft alone"] == SOFT
    )
    filled = {drawn.colour(p): Polygon(p.get_path().vertices) for p in ax.patches if isinstance(p, PathPatch)}
    for fill, region in (
        (HARD, box(0, 0, 6, 4)),
        (SOFT, box(10, 0, 20, 4)),
        (told["both: 20 % of the area of either"], box(6, 0, 10, 4)),
    ):
        assert filled[fill].equals(region)
    (before,) = (p for p in ax.patches if p.get_facecolor()[3] == 0)
    assert Polygon(before.get_path().vertices).equals(begin) and before.get_linestyle() == (0, (4, 2))
    # 2 % of 50 m and 6 % of 8 m around all of them
    assert (*ax.get_xlim(), *ax.get_ylim()) == pytest.approx((-31, 21, -0.48, 8.48)) and ax.get_aspect() == 1
    assert {"DP", "SS"} & set(drawn.texts(ax))


def test_a_deposit_in_parts_with_a_hole_and_nothing_alone():
    ring = Polygon(Point(0, 0).buffer(5).exterior.coords, [Point(0, 0).buffer(2).exterior.coords])
    apart = ring.union(box(10, 0, 12, 1))
    fig = figures.deposits_overlaid(apart, apart, None, [], 1.0)
    fig.canvas.draw()
    picture = np.asarray(fig.canvas.buffer_rgba())  # holes are a matter of how a path is filled: look
    places = np.rint(fig.axes[0].transData.transform([(0, 0), (3.5, 0), (11, 0.5), (8, 0.5)])).astype(int)
    seen = [picture[len(picture) - 1 - up, across, :3].tolist() for across, up in places]
    grey = [0xB9, 0xB9, 0xC9]
    assert seen == [[255] * 3, grey, grey, [255] * 3]
    assert list(drawn.legend(fig)) == ["both: 100 % of the area of either", "hard alone", "soft alone"]


def test_courses_are_columns_times_their_factors():
    t = np.linspace(0, 1, 5)
    # no way of soft runs
    hard, soft = [{"time_s": t, "force": 1e6 * (1 + t), "way": t}], [
        {"time_s": t, "force": 1e6 * (2 + k + t)} for k in range(2)
    ]
    fig = figures.courses(
        [("hard", HARD, hard), ("soft", SOFT, soft)],
        [("force", "force [MN/m]", 1e-6), ("way", "way [m]", 1.0)],
        ("time_s", "time [ms]", 1e3),
    )
    force, way = fig.axes
    assert [ax.get_ylabel() for ax in fig.axes] == ["force [MN/m]", "way [m]"] and [
        ax.get_xlabel() for ax in fig.axes
    ] == ["", "time [ms]"]
    assert [(drawn.colour(one), drawn.points(one).tolist()) for one in force.lines] == [
        (fill, [[1e3 * a, pytest.approx(b + a)] for a in t]) for fill, b in ((HARD, 1), (SOFT, 2), (SOFT, 3))
    ]
    assert [drawn.points(one).tolist() for one in way.lines] == [[[1e3 * a, a] for a in t]]
    assert drawn.legend(force) == {"hard": HARD, "soft": SOFT}


def test_force_distribution_is_a_density_over_the_mean_force():
    """Half of the forces are half of the mean and half one and a half, both of them inside bins of a quarter."""
    forces = np.repeat([0.6e6, 1.4e6], 50)
    fig = figures.force_distribution(
        [("hard", HARD, forces), ("soft", SOFT, 3 * forces[:60]), ("none", SOFT, forces[:0])]
    )
    (ax,) = fig.axes
    hard, soft = ax.lines
    # 0.6 lies in the bin from 0.5 to 0.75, 1.4 in that from 1.25 to 1.5; half of them over a quarter is 2
    assert drawn.points(hard) == pytest.approx(np.array([[0.625, 2.0], [1.375, 2.0]])) and drawn.colour(hard) == HARD
    # 50 of 60 over the mean of 0.733 10⁶: 0.82; 10 of them: 1.91
    assert (
        drawn.points(soft) == pytest.approx(np.array([[0.875, 10 / 3], [1.875, 2 / 3]])) and drawn.colour(soft) == SOFT
    )
    assert drawn.legend(ax) == {"hard (100 contacts)": HARD, "soft (60 contacts)": SOFT} and ax.get_yscale() == "log"
    assert ax.get_xlabel() == "normal force over its mean, N/⟨N⟩"


def test_modes_of_broken_bonds():
    def counts(*parts):
        return dict(zip(("tension", "shear", "torque", "mixed"), parts))

    hard = counts([0.1, 0.2], [0.04, 0.04], [0.0, 0.0], [0.01, 0.03])
    soft = counts([0.3, 0.3], [0.1, 0.2], [0.02, 0.02], [0.05, 0.05])
    (ax,) = figures.modes([("hard", HARD, hard), ("soft", SOFT, soft)]).axes
    assert [t.get_text() for t in ax.get_xticklabels()] == [
        "tension",
        "shear",
        "torque",
        "several at once,\nor not known",
    ]
    assert ax.get_ylabel() == "broken bonds [% of those made]"
    assert drawn.legend(ax) == {"hard": HARD, "soft": SOFT}
    bars = [c for c in ax.containers if hasattr(c, "patches")]
    for group, fill, heights, spread, side in zip(
        bars,
        (HARD, SOFT),
        ((15, 4, 0, 2), (30, 15, 2, 5)),
        ((5 * 2**0.5, 0, 0, 2**0.5), (0, 5 * 2**0.5, 0, 0)),
        (-0.2, 0.2),
    ):
        assert {drawn.colour(bar) for bar in group} == {fill} and [bar.get_height() for bar in group] == pytest.approx(
            heights
        )
        assert [bar.get_x() + bar.get_width() / 2 for bar in group] == pytest.approx(
            [k + side for k in range(4)]
        ) and group[0].get_width() == pytest.approx(0.94 * 0.4)
        (whiskers,) = group.errorbar.lines[2]
        # standard deviation of two values
        assert [np.ptp(s[:, 1]) / 2 for s in whiskers.get_segments()] == pytest.approx(spread)
    (ax,) = figures.modes([("hard", HARD, counts([0.1], [0.1], [0.1], [0.1]))]).axes
    assert ax.containers[-1].errorbar is None  # one seed has no scatter


def test_overlaps_against_stiffness():
    (ax,) = figures.overlaps(
        MODULI, [1e-3, 1e-4, 1e-5], [3e-3, 3e-4, 3e-5], 0.0, 2e-4, when=("before", "on the way")
    ).axes
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_xscale(), ax.get_yscale()) == (
        "Young's modulus [Pa]",
        "mean overlap [mean diameters]",
        "log",
        "log",
    )
    assert drawn.points(drawn.line(ax, "soft, before")).tolist() == [[1e7, 1e-3], [1e8, 1e-4], [1e9, 1e-5]]
    assert drawn.points(drawn.line(ax, "soft, on the way")).tolist() == [[1e7, 3e-3], [1e8, 3e-4], [1e9, 3e-5]]
    assert (
        drawn.line(ax, "hard, before: 0.0e+00").get_ydata()[0] == 1e-12
        and drawn.line(ax, "hard, on the way: 2.0e-04").get_ydata()[0] == 2e-4
    )
    told = drawn.legend(ax)
    assert len(told) == 4 and all(fill == (HARD if name.startswith("hard") else SOFT) for name, fill in told.items())
    # dashed is at rest, in both worlds
    assert [drawn.line(ax, name).get_linestyle() for name in told] == ["-", "--", "-", "--"]


def test_cost_against_stiffness():
    wall, steps = figures.cost(MODULI, [1.0, 3.0, 10.0], [100, 320, 1000], 2.5, 125.0).axes
    for ax, values, level, label in (
        (wall, [1.0, 3.0, 10.0], 2.5, "wall time for a second of simulation [s]"),
        (steps, [100, 320, 1000], 125.0, "steps in a second of simulation"),
    ):
        assert drawn.points(drawn.line(ax, "soft")).tolist() == [
            list(pair) for pair in zip(MODULI, values)
        ] and drawn.levels(ax) == [(level, HARD)]
        assert drawn.legend(ax) == {"soft": SOFT, f"hard: {level:g}": HARD} and (ax.get_xlabel(), ax.get_ylabel()) == (
            "Young's modulus [Pa]",
            label,
        )


def test_cost_at_equal_overlap():
    def point(overlap, rate, stiffness=None):
        return {"overlap_mean_rel": overlap, "rate": rate, "stiffness_Pa": stiffness}

    soft = [point(1e-3, 3.0, 1e7), point(1e-4, 9.0, 1e8)]
    fig = figures.cost_and_overlap(
        [("at rest", point(1e-6, 5.0), soft, 16.0), ("on the move", point(1e-5, 4.0), soft, None)]
    )
    fig.draw_without_rendering()
    known, unknown = fig.axes
    assert [ax.get_title() for ax in (known, unknown)] == [
        "at rest",
        "on the move",
    ] and known.get_ylabel() == "wall time for a second of simulation [s]"
    for ax, overlap, rate in ((known, 1e-6, 5.0), (unknown, 1e-5, 4.0)):
        assert drawn.points(drawn.line(ax, "soft")).tolist() == [[1e-3, 3.0], [1e-4, 9.0]] and drawn.points(
            drawn.line(ax, "hard")
        ).tolist() == [[overlap, rate]]
        assert drawn.legend(ax) == {"soft": SOFT, "hard": HARD} and ax.get_xlabel() == "mean overlap [mean diameters]"
        assert drawn.text(ax, "E = 10 MPa").xy == (1e-3, 3.0) and drawn.text(ax, "E = 100 MPa").xy == (1e-4, 9.0)
    dashed, upright = known.lines[2:]
    # 16 times as long
    assert drawn.points(dashed).tolist() == [[1e-4, 9.0], [1e-6, 80.0]] and drawn.points(upright).tolist() == [
        [1e-6, 5.0],
        [1e-6, 80.0],
    ]
    words = drawn.text(known, "×")
    # half way on a logarithm
    assert words.get_text() == "× 16" and words.xy == (1e-6, pytest.approx(20.0)) and len(unknown.lines) == 2


def test_work_and_precision():
    hard = [(1.0, 0.1, "step × 2"), (2.0, 0.05, "step × 1"), (9.0, 0.0, "itself")]
    soft, aside = [(3.0, 0.2, "E = 10 MPa"), (8.0, float("nan"), "lost"), (9.0, None, "lost")], [(4.0, 0.3, "fragile")]
    both, alone = figures.work_precision(
        [("against hard", hard, soft, aside), ("against own", hard, soft, [])], 0.02
    ).axes
    for ax in (both, alone):
        assert drawn.points(drawn.line(ax, "hard")).tolist() == [[1.0, 0.1], [2.0, 0.05]] and drawn.points(
            drawn.line(ax, "soft")
        ).tolist() == [[3.0, 0.2]]
        assert drawn.levels(ax) == [(0.02, GREY)] and ax.get_xlabel() == "wall time of the run's steps [s]"
        assert drawn.line(ax, "hard").get_marker() == "o" and drawn.line(ax, "soft").get_marker() == "s"
        (grey,) = (p for p in ax.patches if drawn.colour(p) == "#eeeeee")  # from nothing to the scatter
        y = grey.get_patch_transform().transform_path(grey.get_path()).vertices[:, 1]
        assert y.max() == 0.02 and y.min() == 1e-12
        # words stand at their points, in the colour of their world
        named = {t.get_text(): (t.xy, t.get_color().lower()) for t in ax.texts if t.get_text() != "fragile"}
        assert named == {
            "step × 2": ((1.0, 0.1), HARD),
            "step × 1": ((2.0, 0.05), HARD),
            "E = 10 MPa": ((3.0, 0.2), SOFT),
        }
    other = drawn.line(both, "soft, other bonds")
    assert (
        drawn.points(other).tolist() == [[4.0, 0.3]]
        and drawn.colour(other) == SOFT
        and other.get_markerfacecolor() == "none"
    )
    assert drawn.text(both, "fragile").xy == (4.0, 0.3)
    # every point of both panels, which share the axis, is in sight: from the scatter to the fragile bonds
    assert both.get_ylim() == alone.get_ylim() == pytest.approx((0.4 * 0.02, 2.5 * 0.3)) and list(
        drawn.legend(alone)
    ) == ["hard", "soft", "scatter over seeds"]
    assert both.get_ylabel() == "error (see text)"


@pytest.mark.parametrize("chance", [None, float("nan")])
def test_without_a_scatter_there_is_no_band_of_it(chance):
    (ax,) = figures.work_precision([("made up", [(1.0, 0.1, "a")], [], [])], chance).axes
    assert not drawn.levels(ax) and not ax.patches and list(drawn.legend(ax)) == ["hard"]


def test_where_no_run_has_an_error_nothing_is_marked():
    (ax,) = figures.work_precision([("made up", [(1.0, None, "a")], [(1.0, 0.0, "b")], [])], None).axes
    assert not ax.lines and not ax.texts


def test_words_keep_off_the_line_of_the_scatter():
    """A line through the middle of a word, where the word would stand without it."""

    def drawn_with(level):
        points = [(1.0, 0.05, "word"), (2.0, 1e-3, "low"), (2.0, 1.0, "high")]
        (ax,) = figures.work_precision([("made up", points, [], [])], level).axes
        return ax, drawn.text(ax, "word").get_window_extent()

    ax, box = drawn_with(None)
    level = float(ax.transData.inverted().transform((box.xmin, 0.5 * (box.ymin + box.ymax)))[1])
    ax, box = drawn_with(level)  # the point is the same; panels with a legend of two lines may be moved by a pixel
    y = ax.transData.transform((1.0, level))[1]
    assert y < box.ymin or y > box.ymax


def test_convergence_of_soft_to_hard():
    rows = [
        ("front", [0.1, 0.01, None], 0.02, -0.5, 300.0),
        ("speed", [0.3, 0.2, float("nan")], None, None, None),
        ("overlap", [1e-2, 0.0, 1e-4], None, -1.0, 1e5),
        ("stress", [0.1, 0.1, 0.1], 0.05, None, 1.0),
    ]
    fig = figures.convergence(MODULI, rows)
    front, speed, overlap, stress, *rest = fig.axes
    assert [ax.get_title() for ax in fig.axes[:4]] == ["front", "speed", "overlap", "stress"] and not any(
        ax.get_visible() for ax in rest
    )

    def dots(ax):
        return [drawn.points(one).tolist() for one in ax.lines if one.get_marker() == "s"]

    assert (
        dots(front) == [[[1e7, 0.1], [1e8, 0.01]]]
        and dots(speed) == [[[1e7, 0.3], [1e8, 0.2]]]
        and dots(overlap) == [[[1e7, 1e-2], [1e9, 1e-4]]]
    )
    assert drawn.points(drawn.line(front, r"$\propto E^{-0.50}$"))[:, 1] == pytest.approx(
        [300 * e**-0.5 for e in MODULI]
    )
    assert drawn.points(drawn.line(overlap, r"$\propto E^{-1.00}$"))[:, 1] == pytest.approx([1e-2, 1e-3, 1e-4])
    assert (
        drawn.levels(front) == [(0.02, GREY)]
        and drawn.levels(stress) == [(0.05, GREY)]
        and not drawn.levels(speed)
        and speed.get_legend() is None
    )
    assert front.get_ylabel() == stress.get_ylabel() == "relative difference" and [
        ax.get_xlabel() for ax in fig.axes[:4]
    ] == ["", *["Young's modulus [Pa]"] * 3]


def test_correlation_of_the_force_network():
    (ax,) = figures.network(
        MODULI, [0.5, None, 0.9], [("hard, step × 2", 0.95), ("hard, step × 0.5", None), ("hard, tolerance × 10", 0.97)]
    ).axes
    soft = drawn.points(drawn.line(ax, "soft"))
    assert soft[[0, 2]].tolist() == [[1e7, 0.5], [1e9, 0.9]] and np.isnan(soft[1, 1])
    assert drawn.levels(ax) == [(0.95, HARD), (0.97, HARD)] and drawn.legend(ax) == {
        "soft": SOFT,
        "hard, step × 2": HARD,
        "hard, tolerance × 10": HARD,
    }
    assert ax.get_ylim()[1] == 1.02 and ax.get_ylabel() == "correlation of contact forces with the hard run's"
