"""Figures of a slope beside its control runs, and of columns of disks that are followed, read from their artists. Needs
no YADE.
"""

import dataclasses

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

records, controls, markers, toes, toe = (
    synthetic.load(name) for name in ("records", "figures.controls", "figures.markers", "figures.toe", "measure.toe")
)
style = synthetic.load("figures.style")
SECTION = synthetic.Section()
T = np.arange(0, 601) / 10
TIMES = {"t0": 10.0, "t1": 28.0, "t2": 30.0, "t3": 36.0, "t4": 45.0, "t5": 58.0}


def line(*points):
    return np.interp(T, *zip(*points))


def series(far=300.0, **changes):
    """The centre of mass goes 3 : 4 : 5 from 30 s to 50 s; water from 0 to 20 m in 10 s to 30 s, which lifts 10 MN/m a
    metre; dry forces on FB and DP 100 and 400 MN/m, μ 0.3, N 1,500 MN/m.
    """
    water = line((10, 0), (30, 20))
    made = {
        "time_s": T,
        "centroid_x_m": line((30, 0), (50, 0.8 * far)),
        "centroid_y_m": line((30, 0), (50, -0.6 * far)),
        "water_m": water,
        "dp_normal_total_N_per_m": 1500e6 + 0 * T,
        "dp_water_N_per_m": 10e6 * water,
        "fb_normal_N_per_m": 100e6 + 2e6 * water,
        "dp_shear_N_per_m": 400e6 - 2e6 * water,
        "speed_mean_m_per_s": line((28, 0), (36, 8), (45, 20), (60, 0)),
    }
    return made | changes


def colour_of(name):
    return style.LINES[name].lower()


# ---- with and without -----------------------------------------------------------------------------
def test_ways_of_all_packings_and_deposits_of_the_first():
    start, end = (synthetic.few([0.0, 5.0], [0.0, y], layer=[0, 4]) for y in (20.0, 3.0))
    cases = [
        (
            "as shipped",
            [(series(), 10.0), (series(200.0), 20.0)],
            start,
            dataclasses.replace(end, time_s=61.0),
            SECTION,
        ),
        ("a control", [(series(7.0), 10.0)], start, end, SECTION),
    ]
    fig = controls.with_and_without(cases)
    ax, *below = fig.axes
    assert drawn.legend(ax) == {"as shipped": colour_of("orange"), "a control": colour_of("blue")}
    (first, second, control) = ax.lines
    for one, t0, far in ((first, 10.0, 300.0), (second, 20.0, 200.0), (control, 10.0, 7.0)):
        t, way = drawn.points(one).T
        assert t[0] == 0.0 and t[-1] == pytest.approx(60.0 - t0) and way[-1] == pytest.approx(far)
        assert np.interp(40.0 - t0, t, way) == pytest.approx(far / 2)
    assert [drawn.colour(one) for one in ax.lines] == [colour_of("orange")] * 2 + [colour_of("blue")]
    assert len(below) == 2 and below[0].get_position().y0 > below[1].get_position().y0
    for axes, snapshot in zip(below, (end, end)):
        centres, radii, fills = drawn.disks(axes)
        assert centres.tolist() == [[0.0, 0.0], [5.0, 3.0]] and radii.tolist() == [1.0, 1.0]
        assert fills == [style.LAYERS[0], style.LAYERS[4]]
    assert [drawn.text(axes, "a").get_text() for axes in below] == ["as shipped, at 61 s", "a control, at 0 s"]
    assert len({axes.get_xlim() for axes in below}) == 1  # to one scale
    with pytest.raises(records.RecordsError, match="give at least one case"):
        controls.with_and_without([])


# ---- forces against water -------------------------------------------------------------------------
def test_forces_against_the_water_stand_beside_the_equations():
    limit = toe.Toe(20.0, 65.0, 100e6, 190e6, 150e6, softening=1e5)
    cases = [(series(), TIMES, 0.3), (series(fb_normal_N_per_m=120e6 + 2e6 * series()["water_m"]), TIMES, 0.3)]
    ax = controls.forces_against_water([*cases, (series(), dict.fromkeys(TIMES), 0.3)], toe=limit).axes[0]
    lines = [drawn.points(one) for one in ax.lines if one.get_marker() != "o"]
    dots = [drawn.points(one)[0].tolist() for one in ax.lines if one.get_marker() == "o"]
    ends = [one[[0, -1], 1].tolist() for one in lines]
    # each packing, FB and DP, from t0 to t2 [MN/m]; t1 is at 18 m
    assert ends[:4] == pytest.approx(np.array([[100, 140], [400, 360], [120, 160], [400, 360]]))
    assert dots == pytest.approx(np.array([[18, 136], [18, 364], [18, 156], [18, 364]]))
    # (19): 400 − 0.3 · 200; (20): 0.3 (1500 − 200); (21): the mean of 100 and 120, + 0.3 · 200; Rankine: 190 − 0.1 h²
    assert ends[4:] == pytest.approx(np.array([[400, 340], [450, 390], [110, 170], [190, 150]]))
    assert all(one[-1, 0] == pytest.approx(20.0) for one in lines)
    assert "Rankine's passive limit of the toe" in drawn.legend(ax)
    assert "Rankine's passive limit of the toe" not in drawn.legend(controls.forces_against_water(cases).axes[0])
    # names are the walls' own
    named = [("creek bed", [[-9.0, 9.0], [0.0, 0.0]], "slip"), ("dam", [[0.0, 0.0], [1.0, 1.0]], "backstop")]
    told = list(drawn.legend(controls.forces_against_water(cases, walls=named).axes[0]))
    assert told[:2] == ["shear force on creek bed, each packing", "force on dam, each packing"]
    with pytest.raises(records.RecordsError, match="no slope came to accelerate"):
        controls.forces_against_water([(series(), dict.fromkeys(TIMES), 0.3)])


def test_the_resistance_of_a_toe_is_what_its_passive_state_says():
    """At the height where push and resistance are equal, and without water."""
    section = synthetic.load("model.section").load("jiufengershan")
    found = toe.passive(section, 85.9e3, 37.2, 0.84)
    assert found.resistance(0.0) == found.resistance_dry
    assert found.resistance(found.water_m) == pytest.approx(found.push_N_per_m, rel=1e-9)
    assert found.resistance(np.array([0.0, 10.0]))[1] < found.resistance_dry


# ---- speeds ---------------------------------------------------------------------------------------
def summary(**changes):
    begun = {"50": 28.1, "100": 28.2, "200": 28.4, "300": 28.6, "400": None, "500": 29.0}
    return {"times_s": TIMES, "t2_by_speed_s": begun, "t5_by_speed_s": {"2": 59.7, "5": 59.3, "10": 58.5}} | changes


def test_speeds_with_the_times_that_other_thresholds_give():
    later = summary(t2_by_speed_s=summary()["t2_by_speed_s"] | {"50": 27.1})
    cases = [(series(), summary()), (series(), later), (series(), summary(times_s=TIMES | {"t3": None}))]
    left, right = controls.speeds(cases).axes
    dots = {tuple(drawn.points(one)[0].round(9)) for one in left.lines if one.get_marker() == "o"}
    assert dots == {(-7.9, 0.1), (-8.9, 0.1), (-7.8, 0.2), (-7.6, 0.4), (-7.4, 0.6), (-7.0, 1.0)}
    dots = {tuple(drawn.points(one)[0].round(9)) for one in right.lines if one.get_marker() == "o"}
    assert dots == {(23.7, 0.4), (23.3, 1.0), (22.5, 2.0)}
    assert list(drawn.legend(left)) == [
        "0.1 m/s: 8.4 s before $t_3$",
        "0.2 m/s: 7.8 s before $t_3$",
        "0.4 m/s: 7.6 s before $t_3$",
        "0.6 m/s: 7.4 s before $t_3$",
        "1 m/s: 7.0 s before $t_3$",
    ]
    assert list(drawn.legend(right))[0] == "2 % of the largest: 23.7 s after $t_3$"
    # two packings have a t3
    curves = [one for one in right.lines if one.get_marker() != "o" and len(one.get_xdata()) == len(T)]
    assert len(curves) == 2 and drawn.points(curves[0])[:, 0] == pytest.approx(T - 36.0)
    # of a slope a quarter as large speeds are half of these
    small = controls.speeds(cases[:1], moving=0.1).axes[0]
    assert list(drawn.legend(small))[0] == "0.05 m/s: 7.9 s before $t_3$"
    with pytest.raises(records.RecordsError, match="no slope came into motion"):
        controls.speeds(cases[2:])


# ---- columns of disks -----------------------------------------------------------------------------
def block(**changes):
    """Disks of 2 m in ten columns and five layers, on level ground."""
    x, y = (v.ravel() for v in np.meshgrid(1.0 + 2.0 * np.arange(100), 1.0 + 2.0 * np.arange(5)))
    return synthetic.few(x, y, layer=np.repeat(np.arange(5), 100), **changes)


def test_columns_are_thin_and_at_equal_distances():
    """Of 200 m in four parts: three disks wide, in the middles of the parts, at 25, 75, 125 and 175 m; of a slope,
    normal to it.
    """
    walls = [("G", np.array([[-10.0, 0.0], [300.0, 0.0]]), "slip")]
    column = markers.columns(block(), walls, 4)
    x = block().x
    for k, middle in enumerate((25.0, 75.0, 125.0, 175.0)):
        low, high = x[column == k].min(), x[column == k].max()
        assert 4.0 <= high - low <= 6.0 and abs((low + high) / 2 - middle) <= 2.0  # to the disks' places
        assert np.count_nonzero(column == k) in (15, 20)
    section = synthetic.load("model.section").load("jiufengershan")
    snapshot = synthetic.load("records.snapshots").checked(synthetic.snapshot_arrays(2000, contacts=False), "made up")
    column = markers.columns(snapshot, section)
    along = snapshot.x * section.downslope[0] + snapshot.y * section.downslope[1]
    assert all(np.ptp(along[column == k]) <= 6 * snapshot.r.mean() for k in range(16))
    assert set(column) == set(range(-1, 16)) and np.count_nonzero(column >= 0) < 0.3 * len(column)


def test_the_same_disks_are_strong_in_all_panels():
    start = block()
    section = synthetic.load("model.section").load("jiufengershan")
    later = dataclasses.replace(start, x=start.x + 40.0 * start.y, time_s=50.0)
    fig = markers.markers([("t0", start), ("t4", later), ("the end", later)], section, number=4)
    column = markers.columns(start, section, 4)
    for ax in fig.axes:
        fills = drawn.disks(ax)[2]
        strong = [k for k, fill in enumerate(fills) if fill.lower() in {c.lower() for c in markers.MARKERS}]
        assert strong == np.flatnonzero(column >= 0).tolist()
        assert all(fills[k].lower() == markers.MARKERS[column[k]].lower() for k in strong)
    # layers are pale, and five
    assert len({fill for k, fill in enumerate(fills) if column[k] < 0}) == 5
    told = [next(t for t in drawn.texts(ax) if t.endswith(" s")) for ax in fig.axes]
    assert told == ["$t_{0}$, water begins to rise: 0 s", "$t_{4}$, during motion: 50 s", "the end: 50 s"]
    assert list(drawn.handles(fig))[0].startswith("disks that lay in thin columns")
    with pytest.raises(records.RecordsError, match="no snapshot to draw"):
        markers.markers([], section)


# ---- toes -----------------------------------------------------------------------------------------
def test_toes_of_several_packings_have_one_scale_of_colours():
    """Of few disks too, where no bands can be told. One has turned by 0.4 rad, the other by 0.1."""
    section = synthetic.load("model.section").load("jiufengershan")
    rng = np.random.default_rng(5)
    up, off = rng.uniform(0, 190, 200), rng.uniform(1, 64, 200)
    x, y = (off[:, None] * np.array(section.normal) - up[:, None] * np.array(section.downslope)).T
    before = synthetic.few(x, y, r=np.full(200, 2.0))
    cases = [
        (f"packing {k}", before, dataclasses.replace(before, angle=np.full(200, angle)), section)
        for k, angle in enumerate((0.4, -0.1))
    ]
    fig = toes.toes(cases)
    panels, bar = fig.axes[:-1], fig.axes[-1]
    assert [ax.get_title(loc="left") for ax in panels] == ["packing 0", "packing 1"]
    assert bar.get_xlabel() == "rotation [rad], counterclockwise positive"
    assert bar.get_xlim() == pytest.approx((-0.2, 0.2))  # the round number below 0.4
    red, blue = (drawn.disks(ax)[2][0] for ax in panels)
    assert int(red[1:3], 16) > int(red[5:7], 16) and int(blue[5:7], 16) > int(blue[1:3], 16)
    assert not any(one.get_linestyle() == "--" for ax in panels for one in ax.lines)
    with pytest.raises(records.RecordsError, match="no toe to draw"):
        toes.toes([])
