"""What all figures share: they are returned or written, true to scale, under settings of their own. Needs no YADE."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

import drawn
import synthetic_slope as synthetic

records, figures = (synthetic.load(name) for name in ("records", "figures"))
style = synthetic.load("figures.style")
COLUMNS = synthetic.load("studies.slope.columns").COLUMNS
ground_of, UserError, RecordsError = (
    synthetic.load("measure.ground").ground_of,
    synthetic.load("errors").UserError,
    records.RecordsError,
)
SECTION = synthetic.Section()


@pytest.fixture(scope="module")
def series():
    return synthetic.series(COLUMNS, rows=50)


def test_a_figure_is_returned_or_written(tmp_path, series):
    fig = figures.energy(series)
    path = figures.energy(series, tmp_path / "e.png", pdf=True)
    assert (
        path == tmp_path / "e.png"
        and sorted(p.name for p in tmp_path.iterdir()) == ["e.pdf", "e.png"]
        and (tmp_path / "e.pdf").read_bytes().startswith(b"%PDF")
    )
    # 170 dots an inch, and the picture of the figure that is returned
    assert imread(path).shape[:2] == (round(170 * 6.6), 1700)
    style.save(fig, tmp_path / "again.png")
    # written outside the project's settings, where text may differ
    assert np.mean(imread(path) != imread(tmp_path / "again.png")) < 0.01
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordsError, match="cannot be written"):
        figures.energy(series, tmp_path / "file" / "f.png")


@pytest.mark.parametrize("name", ["energy", "energy.", "energy.final", "folder.d/energy", ".png"])
@pytest.mark.parametrize("draw", ["energy", "water_forces"])
def test_a_name_that_no_figure_has_is_refused_and_leaves_nothing(tmp_path, series, name, draw):
    """Without a suffix matplotlib adds one, to a file that nobody asked for."""
    with pytest.raises(RecordsError, match="^path .*: give the name of a PNG, as figure.png") as told:
        figures.energy(series, tmp_path / name) if draw == "energy" else figures.water_forces(20, path=tmp_path / name)
    assert "\n" not in str(told.value) and not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", [".pdf", ".svg", ".PNG"])
def test_other_kinds_of_files_are_what_they_are_called(tmp_path, series, suffix):
    path = figures.energy(series, tmp_path / f"e{suffix}")
    begins = {".pdf": b"%PDF", ".svg": b"<?xml", ".PNG": b"\x89PNG"}[suffix]
    assert [*tmp_path.iterdir()] == [path] and path.read_bytes().startswith(begins)


def test_disks_have_their_true_radii():
    """Two disks that touch meet on the picture, and cover the area they should."""
    fig = style.figure(4, 2, dpi=100)
    ax = fig.add_axes([0, 0, 1, 1])
    style.frame(ax, -4, 4, -2, 2)
    style.draw_disks(ax, synthetic.few([-1.0, 1.5], [0.0, 0.0], r=[1.0, 1.5]), np.tile([0.0, 0, 0, 1], (2, 1)))
    fig.canvas.draw()
    ink = 1 - np.asarray(fig.canvas.buffer_rgba())[..., 0] / 255
    assert ink.sum() == pytest.approx(np.pi * (1 + 1.5**2) * 50**2, rel=0.01)
    assert ink[100, 101:349].min() > 0.9 and ink[100, :99].max() == 0 and ink[100, 351:].max() == 0


def test_colours_stand_on_the_picture_where_the_disks_are():
    """One pixel at the centre of each disk, of a figure with other things in it: what is read from artists is what is
    seen.
    """
    x, y = np.array([-60.0, -40.0, -20.0]), np.array([60.0, 45.0, 30.0])
    s = synthetic.few(x, y, r=np.full(3, 4.0), wet=[False, True, True], released=[False, False, True])
    fig = figures.snapshots(
        [("t0", s)],
        [("DP", [[-100.0, 75.0], [0.0, 0.0]], "slip"), ("SS", [[0.0, 0.0], [60.0, 0.0]], "ground")],
        close_up=False,
    )
    fig.canvas.draw()
    picture = np.asarray(fig.canvas.buffer_rgba())
    across, up = np.rint(fig.axes[0].transData.transform(np.column_stack([x, y]))).astype(int).T
    seen = picture[picture.shape[0] - 1 - up, across, :3]
    assert [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in seen] == [style.DRY[0], style.WET[0], style.RELEASED[0]]


def test_many_disks_are_few_artists():
    """One collection, not one patch a disk: 20,000 disks would take minutes."""

    def count(n):
        return len(figures.snapshots([("t3", synthetic.few(-np.arange(n), np.arange(n)))], SECTION).findobj())

    assert count(2000) < count(20) + 10  # a name of a wall more or less in sight


def test_walls_in_all_their_forms():
    class Wall:
        name, vertices = "DP", ((0.0, 1.0), (1.0, 0.0))

    ((name, vertices, role, buried),) = ground_of([Wall()]).walls
    assert name == "DP" and vertices.tolist() == [[0, 1], [1, 0]] and role is None and not buried
    assert ground_of([("DP", vertices)]).walls[0].role is None
    told = ground_of(SECTION)
    assert (
        [wall.name for wall in told.walls] == ["DP", "FB", "SS"]
        and told.name("backstop") == "FB"
        and told.name("obstacle") == ""
    )
    assert np.array_equal(ground_of(SECTION.walls).walls[2].vertices, SECTION.walls[2][1]) and ground_of(told) is told
    assert told.foot.tolist() == [0, 0] and ground_of([("plane", [[3.0, 1.0], [1.0, 2.0]], "slip")]).foot.tolist() == [
        3,
        1,
    ]
    with pytest.raises(UserError, match="FB.*two points"):
        ground_of([("FB", [[0.0, 0.0]], "backstop")])


@pytest.mark.parametrize(
    "surfaces, side",
    [
        ([[[0, 1], [5, 0]]], 1),
        ([[[0, 0], [5, 1]]], -1),
        ([[[0, 0], [5, 0]]], 1),
        ([[[0, 9], [3, 5]], [[3, 5], [5, 5.5]]], 1),
        ([[[0, 5.5], [2, 5]], [[2, 5], [5, 9]]], -1),
    ],
)
def test_a_slope_falls_along_its_slip_surfaces(surfaces, side):
    assert ground_of([(str(k), np.array(points, float), "slip") for k, points in enumerate(surfaces)]).side == side


def test_ground_goes_on_as_its_last_wall_does_where_that_is_less_steep_than_45_degrees():
    """A fall of 1 in 2 on both sides; one of 3 in 2 goes on level; nothing where walls reach the limits, or are
    buried.
    """

    def beyond(points, *limits):
        return [p.tolist() for p in ground_of([("DP", points, "slip")]).beyond(*limits)]

    gentle, steep = [[0.0, 10.0], [10.0, 5.0]], [[0.0, 20.0], [10.0, 5.0]]
    assert beyond(gentle, -4.0, 14.0) == [[[-4, 12], [0, 10]], [[10, 5], [14, 3]]]
    assert beyond(steep, -4.0, 14.0) == [[[-4, 20], [0, 20]], [[10, 5], [14, 5]]]
    assert beyond(gentle, 0.0, 14.0) == [[[10, 5], [14, 3]]] and beyond(gentle, 1.0, 10.0) == []


def test_names_are_no_formulae():
    assert style.symbol("N'", "DP") == "$N'_{DP}$" and style.symbol("T", "a $ wall") == "$T$ (a \\$ wall)"
    fig = style.figure(2, 2)
    fig.text(0, 0, style.symbol("T", "x_1^{ $y$"))
    fig.canvas.draw()  # raises where a formula cannot be read


@pytest.mark.parametrize(
    "value, extent, digits, told",
    [
        (1234.4, 3000, 0, "1,234 m"),
        (22.51, 2010, 1, "22.5 m"),
        (27.34, 100, 0, "27.3 m"),
        (7.238, 20.1, 0, "7.24 m"),  # as many digits as of a slope a hundred times as large, or one more
        (0.2251, 20.1, 1, "0.225 m"),
        (0.3456, 6, 0, "0.35 m"),
        (0.35, 1, 0, "35.0 cm"),
        (0.0123, 0.1, 0, "12.3 mm"),
    ],
)
def test_lengths_have_the_unit_of_the_picture(value, extent, digits, told):
    assert style.length(value, extent, digits) == told


def test_times_and_forces_have_units_that_fit():
    assert [style.seconds(1.23456, longest) for longest in (100, 5, 1)] == ["1.2 s", "1.23 s", "1.235 s"]
    assert [style.force_unit(f) for f in (2e8, 1e6, 9e5, 1e3, 20.0, 0.0)] == [
        (1e6, "MN/m"),
        (1e6, "MN/m"),
        (1e3, "kN/m"),
        (1e3, "kN/m"),
        (1.0, "N/m"),
        (1.0, "N/m"),
    ]


@pytest.mark.parametrize(
    "value, expected", [(1.0, 1), (1.99, 1), (2.0, 2), (4.9, 2), (7.0, 5), (0.03, 0.02), (999.0, 500), (3.98e6, 2e6)]
)
def test_nice_numbers(value, expected):
    assert style.nice(value) == pytest.approx(expected)


def test_layers_get_darker_downwards_and_begin_anew_above_the_fifth():
    fills = drawn.hexes(style.layer_colours([0, 1, 2, 3, 4, 5]))
    assert fills == [*style.LAYERS, style.LAYERS[0]] and len(set(style.LAYERS)) == 5


def test_running_mean_stays_centred():
    x = np.linspace(0, 10, 101)
    # of a straight line it is the line itself, also at the ends, where a window cut on one side would lean; exact but
    # for rounding
    np.testing.assert_allclose(style.running_mean(x, 3 * x + 1, 2.0), 3 * x + 1, rtol=1e-12)
    # of a spike it is the spike's share of the window: 21 rows in the middle
    spike = np.zeros(101)
    spike[50] = 21.0
    np.testing.assert_allclose(style.running_mean(x, spike, 2.0)[[39, 40, 50, 60, 61]], [0, 1, 1, 1, 0], atol=1e-12)


def test_importing_needs_no_display_and_leaves_the_settings_alone(series):
    import matplotlib

    with matplotlib.rc_context({"font.size": 33, "lines.linewidth": 9}):
        fig = figures.energy(series)
        assert matplotlib.rcParams["font.size"] == 33
    assert fig.axes[0].title.get_fontsize() != 33 and {one.get_linewidth() for one in fig.axes[0].lines} == {1.5, 0.7}
    code = (
        "import sys; sys.path.insert(0, %r); import synthetic_slope as s; s.load('figures.video'); s.load('figures');"
        "assert 'matplotlib.pyplot' not in sys.modules and 'yade' not in sys.modules"
    )
    subprocess.run(
        [sys.executable, "-c", code % str(Path(__file__).resolve().parents[1])], check=True, env={"PATH": "/usr/bin"}
    )


def test_an_axis_of_a_sweep_goes_on_beside_its_ends():
    """By a share of the axis: of its length, of its factor where it is logarithmic, of the value where there is one
    alone, of 1 where that is nought.
    """
    beside = synthetic.load("figures.sweep")._beside
    assert (beside(2.0, -0.1, [2.0, 4.0], False), beside(4.0, 0.1, [2.0, 4.0], False)) == pytest.approx((1.8, 4.2))
    assert (beside(1.0, -0.5, [1.0, 10.0, 100.0], True), beside(100.0, 0.5, [1.0, 10.0, 100.0], True)) == pytest.approx(
        (0.1, 1000.0)
    )
    assert beside(-3.0, 0.1, [-3.0], False) == pytest.approx(-2.7) and beside(0.0, 0.1, [0.0], False) == 0.1
