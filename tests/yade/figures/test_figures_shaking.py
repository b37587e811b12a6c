"""The figure of a slope under an earthquake, read from its artists. Needs no YADE."""

import numpy as np
import pytest

import drawn
import synthetic_slope as package

figures, records, motions, style = (
    package.load(name) for name in ("figures", "records", "model.ground_motion", "figures.style")
)
T = np.linspace(0, 4, 41)
MOTION = motions.GroundMotion([0, 1, 2, 3, 4], [0, 2.0, -5.0, 1.0, 0], [0, 1.0, 0, -1.0, 0])
GROUND = (T, MOTION.acceleration(T), MOTION.velocity(T), MOTION.displacement(T))
SURFACES = [("DP", T, 0.1 * T), ("upper $plane", T[:21], 0.3 * T[:21])]
BLOCKS = [("block, μ = 0.5", T, 0.2 * T)]


def test_the_motion_is_above_and_the_slips_below_it():
    fig = figures.shaking(*GROUND, SURFACES, BLOCKS, title="a $record")
    assert [ax.get_ylabel() for ax in fig.axes] == [
        "acceleration\n[m/s²]", "velocity\n[m/s]", "displacement\n[m]", "slip [m]"
    ]  # fmt: skip
    for ax, values in zip(fig.axes, GROUND[1:]):
        for k, name in enumerate(("horizontal", "vertical")):
            assert drawn.points(drawn.line(ax, name)) == pytest.approx(np.column_stack((T, values[:, k])))
    assert fig.axes[0].get_title(loc="left") == r"a \$record" and fig.axes[3].get_xlabel() == "time [s]"
    assert all(ax.get_xlim() == (0, 4) for ax in fig.axes)
    assert list(drawn.legend(fig.axes[0])) == ["horizontal", "vertical"]
    assert "5.00 m/s²" in drawn.texts(fig.axes[0])  # the peak, to whichever side
    (peak,) = (drawn.points(one) for one in fig.axes[0].lines if one.get_marker() == "o")
    assert peak.tolist() == [[2.0, -5.0]]


def test_slips_are_full_lines_and_their_blocks_broken_ones_of_the_same_colour():
    ax = figures.shaking(*GROUND, SURFACES, BLOCKS).axes[3]
    told = drawn.legend(ax)
    assert list(told) == ["DP: 0.4 m", r"upper \$plane: 0.6 m", "block, μ = 0.5: 0.8 m"]
    lines = [drawn.line(ax, label) for label in told]
    for one, (_, t, slip) in zip(lines, (*SURFACES, *BLOCKS)):
        assert drawn.points(one) == pytest.approx(np.column_stack((t, slip)))
    assert [one.is_dashed() for one in lines] == [False, False, True]
    first, second, block = told.values()
    assert block == first != second
    assert drawn.levels(ax) == [(0, "#999999")] == drawn.levels(ax.figure.axes[0])


def test_what_is_left_at_the_end_of_the_record_is_told():
    place = MOTION.drift.displacement[0]
    (told,) = drawn.texts(figures.shaking(*GROUND).axes[2])
    assert told == f"left at the end, horizontally: −2 m/s, {place:.2g} m".replace("-", "−") and place < 0


def test_one_component_and_no_slips():
    flat = [GROUND[0], *(values[:, 0] for values in GROUND[1:])]
    without = [GROUND[0], *(values * [1, 0] for values in GROUND[1:])]
    for ground in (flat, without):
        fig = figures.shaking(*ground)
        assert len(fig.axes) == 3 and fig.axes[0].get_legend() is None and fig.axes[2].get_xlabel() == "time [s]"
        assert fig.axes[0].get_xlim() == (0, 4)
        assert [one.get_label() for one in fig.axes[1].lines if not one.get_label().startswith("_")] == ["horizontal"]


def test_slips_that_go_on_after_the_record_are_shown_to_their_end():
    fig = figures.shaking(*GROUND, [("DP", [0.0, 9.0], [0.0, 1.0])])
    assert fig.axes[0].get_xlim() == (0, 9)


@pytest.mark.parametrize(
    "given, message",
    [
        (dict(time="x"), "time 'x': give finite numbers"),
        (dict(time=T[:-1]), r"acceleration .*: give finite numbers, an array \(n,\) or \(n, 2\), with n = 40"),
        (
            dict(velocity=np.zeros((41, 3))),
            r"velocity .*: give finite numbers, an array \(n,\) or \(n, 2\), with n = 41",
        ),
        (dict(displacement=np.full(41, np.nan)), "displacement .*: give finite numbers"),
        (dict(surfaces=["DP"]), r"surfaces \['DP'\]: give a list of cases, each \(label, time, slip\)"),
        (dict(surfaces=3), "surfaces 3: give a list of cases"),
        (dict(blocks=[("b", T, T[:-1])]), r"blocks, slip of 'b' .*: give finite numbers, an array \(n,\), with n = 41"),
        (dict(surfaces=[("b", [1, [2, 3]], T)]), "surfaces, time of 'b' .*: give finite numbers"),
        (dict(path=3), "path 3: give the name of a PNG"),
    ],
)
def test_what_cannot_be_drawn_is_told(given, message):
    names = ("time", "acceleration", "velocity", "displacement")
    with pytest.raises(records.RecordsError, match=f"^{message}"):
        figures.shaking(**{**dict(zip(names, GROUND)), **given})


def test_it_is_written(tmp_path):
    assert figures.shaking(*GROUND, SURFACES, BLOCKS, path=tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"
    assert [one.name for one in tmp_path.iterdir()] == ["a.png"]
