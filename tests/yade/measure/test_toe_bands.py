"""Bands in a made-up toe whose disks turn along known lines, and their figure. Needs no YADE."""

import dataclasses
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import drawn  # noqa: E402
import known_slope  # noqa: E402
import synthetic_slope as synthetic  # noqa: E402

toe_bands, figures_toe, section, similar, style, records, results = (
    synthetic.load(name)
    for name in (
        "measure.toe_bands",
        "figures.toe",
        "model.section",
        "model.section.similar",
        "figures.style",
        "records",
        "studies.slope.results",
    )
)
SHIPPED = section.load("jiufengershan")
THRUST, BACK = 28.0, 40.0  # degrees to the slope
TURNED, TURNED_BACK = 0.3, 0.2  # rad, clockwise and counterclockwise


def snapshots(rise=THRUST, back=BACK):
    """The lowest 300 m of the shipped slope, 65 m thick, with disks of 2 m at random: at rest, and with two bands
    turned, 12 m and 16 m wide. The first goes through a point 60 m up the slope and 30 m off it, the second through one
    150 m up and 20 m off."""
    rng = np.random.default_rng(3)
    up, off = rng.uniform(0, 300, 6000), rng.uniform(1, 64, 6000)
    down, normal = np.array(SHIPPED.downslope), np.array(SHIPPED.normal)
    x, y = (off[:, None] * normal - up[:, None] * down).T

    def away(degrees, u, o):
        return np.cos(np.radians(degrees)) * (off - o) - np.sin(np.radians(degrees)) * (up - u)

    thrust, conjugate = np.abs(away(-rise, 60, 30)) < 6, np.abs(away(back, 150, 20)) < 8
    angle = 0.01 * rng.standard_normal(6000) - TURNED * thrust + TURNED_BACK * conjugate
    before = synthetic.few(x, y, r=np.ones(6000), time_s=10.0)
    return before, dataclasses.replace(before, angle=angle, time_s=12.0)


def mirrored(snapshot):
    return dataclasses.replace(snapshot, x=-snapshot.x, angle=-snapshot.angle)


def test_both_bands_are_found_with_their_inclination_and_width():
    thrust, conjugate = toe_bands.find(*snapshots(), SHIPPED)
    # angles are looked for by degrees, and a strip is as wide as a disk: 2 m
    assert thrust.inclination_deg == pytest.approx(THRUST, abs=3) and conjugate.inclination_deg == pytest.approx(
        BACK, abs=3
    )
    assert thrust.width == pytest.approx(6, abs=1) and conjugate.width == pytest.approx(8, abs=1.5)
    assert thrust.rotation == pytest.approx(-TURNED, rel=0.1) and conjugate.rotation == pytest.approx(
        TURNED_BACK, rel=0.15
    )
    # they rise, one towards the foot and the other away from it, and go through where they were put, to a strip
    down, normal = np.array(SHIPPED.downslope), np.array(SHIPPED.normal)
    for band, sense, (up, off) in ((thrust, 1, (60, 30)), (conjugate, -1, (150, 20))):
        way = np.array(band.direction)
        assert way @ normal > 0 and sense * (way @ down) > 0
        gap = np.array(band.through) - (off * normal - up * down)
        assert abs(gap[0] * way[1] - gap[1] * way[0]) < 3


def test_a_mirrored_toe_has_the_mirrored_bands():
    here = toe_bands.find(*snapshots(), SHIPPED)
    there = toe_bands.find(*map(mirrored, snapshots()), similar.mirrored(SHIPPED))
    for one, other in zip(here, there):
        assert other.inclination_deg == one.inclination_deg and other.width == pytest.approx(one.width, rel=1e-6)
        assert other.rotation == pytest.approx(-one.rotation, rel=1e-6)
        assert other.through == pytest.approx((-one.through[0], one.through[1]), abs=1e-6)


def test_a_summary_tells_the_bands_of_triggering_and_those_of_weakening_apart(tmp_path):
    """Of the known run: until t1 (29.1 s), and so until t2, two bands of 28° and 34° turn, which are conjugate by the
    rule of 10°; after t2, and so from t1 to t3, two others of 22° and 40°, which are not, three times as far."""
    begin, early = snapshots(28.0, 34.0)
    late = snapshots(22.0, 40.0)[1]
    angles = {"t0": begin.angle, "t1": early.angle, "t2": early.angle, "t3": early.angle + 3.0 * late.angle}

    def arrays(name):
        fields = ("x", "y", "r", "vx", "vy", "layer", "wet", "released")
        return {"angle": angles[name]} | {field: getattr(begin, field) for field in fields}

    known_slope.write(tmp_path, start=lambda: arrays("t0"), stop=None)
    (tmp_path / "snapshots").mkdir()
    series = records.read_series(tmp_path / "series.csv")
    for name, time in (("t1", 29.1), ("t2", 30.5), ("t3", 39.1)):
        step = int(series["step"][np.argmin(np.abs(series["time_s"] - time))])
        path = tmp_path / "snapshots" / f"{step:08d}.npz"
        records.write_snapshot(path, time_s=time, step=step, water_m=0.0, **arrays(name))
    found = results.summarise(tmp_path, SHIPPED, known_slope.STATE)
    assert [found["times_s"][name] for name in ("t1", "t2", "t3")] == pytest.approx([29.1, 30.5, 39.1])
    # angles are looked for by degrees, and a strip is as wide as a disk: 2 m, as above
    for name, rise, back, both, turned in (
        ("toe_bands_triggering", 28.0, 34.0, True, 1.0),
        ("toe_bands", 22.0, 40.0, False, 3.0),
    ):
        towards, away = (found[name][one] for one in ("towards_foot", "conjugate"))
        assert towards["inclination_deg"] == pytest.approx(rise, abs=3), name
        assert away["inclination_deg"] == pytest.approx(back, abs=3), name
        assert found[name]["both_conjugate"] is both
        # strips are a disk wide, so those at the edges of a band are half full
        assert towards["rotation_rad"] == pytest.approx(-TURNED * turned, rel=0.1)
        assert away["rotation_rad"] == pytest.approx(TURNED_BACK * turned, rel=0.15)
        assert found[name]["rankine_deg"] == pytest.approx(45 - 37.2 / 2)


def test_a_toe_that_does_not_turn_or_has_few_disks_has_none():
    before, after = snapshots()
    assert toe_bands.find(before, before, SHIPPED) == (None, None)
    few = [
        dataclasses.replace(
            s, **{k: getattr(s, k)[::50] for k in ("x", "y", "r", "angle", "vx", "vy", "layer", "wet", "released")}
        )
        for s in (before, after)
    ]
    assert toe_bands.find(*few, SHIPPED) == (None, None) and figures_toe.toe(*few, SHIPPED) is None
    # without the conjugate, none is made of the other's disks
    _, alone = snapshots()
    first = dataclasses.replace(alone, angle=np.minimum(alone.angle, 0.0))
    assert toe_bands.find(before, first, SHIPPED)[1] is None


def test_rankines_bands():
    assert toe_bands.rankine(30.0) == 30.0 and toe_bands.rankine(40.0) == 25.0


def test_the_toe_is_drawn_by_rotation_with_its_bands():
    before, after = snapshots()
    fig = figures_toe.toe(before, after, SHIPPED, friction_deg=40.0)
    fig.draw_without_rendering()
    toe, scale = (ax.get_position() for ax in fig.axes)
    assert 0.5 < scale.height / toe.height < 0.9 and toe.x1 <= scale.x0  # beside it, and not as high
    # the figure is as high by its width as what is shown, but for the scale beside it and the legend above
    shown = np.ptp(fig.axes[0].get_ylim()) / np.ptp(fig.axes[0].get_xlim())
    assert fig.get_figheight() == pytest.approx(0.86 * shown * fig.get_figwidth() + 0.7, rel=1e-6)
    ax = fig.axes[0]
    names = list(drawn.legend(ax))
    thrust, _ = toe_bands.find(before, after, SHIPPED)
    told = f"{thrust.inclination_deg:.0f}° to the slope, {thrust.width:.1f} d wide"
    assert names[0] == f"band that rises towards the foot: {told}"
    assert names[1].startswith("conjugate band: ") and names[2] == "Rankine: 45° − φ/2 = 25°"
    # four edges and two directions, each from the slip surface to the surface
    down, normal = np.array(SHIPPED.downslope), np.array(SHIPPED.normal)
    lines = [drawn.points(one) for one in ax.lines if len(one.get_xdata()) == 2 and one.get_linewidth() == 1.8]
    assert len(lines) == 6
    for ends in lines:
        assert ends @ normal == pytest.approx((0, 65), abs=1.5)
    # edges of bands are whole, the directions that Rankine has are dotted and orange
    looks = [(one.get_linestyle() == ":", one.get_color()) for one in ax.lines if one.get_linewidth() == 1.8]
    assert sorted(looks) == [(False, style.INK)] * 4 + [(True, style.LINES["orange"])] * 2
    # edges of a band are as far apart as it is wide, in mean diameters of the toe's disks
    size = 2 * np.sqrt(np.mean(before.r[toe_bands.toe(before, SHIPPED)[0]] ** 2))
    edges = [e for e, (dotted, _) in zip(lines, looks) if not dotted]
    for band, (one, other) in zip(toe_bands.find(before, after, SHIPPED), (edges[:2], edges[2:])):
        way = (one[1] - one[0]) / np.hypot(*(one[1] - one[0]))
        apart = abs(np.cross(way, other[0] - one[0]))
        assert apart == pytest.approx(band.width * size, rel=1e-9)
    slopes = sorted(np.degrees(np.arctan2(*(np.abs((e[1] - e[0]) @ way) for way in (normal, down)))) for e in lines)
    assert slopes[:2] == pytest.approx([25, 25], abs=1e-6) and slopes[2:4] == pytest.approx([THRUST] * 2, abs=3)
    # counterclockwise is red: of the conjugate, and blue of the other
    colours = drawn.disks(ax)[2]
    assert fig.axes[1].get_ylabel() == "rotation from 10.0 s to 12.0 s [rad], counterclockwise positive"
    inside = (
        (after.x > ax.get_xlim()[0] - 2)
        & (after.x < ax.get_xlim()[1] + 2)
        & (after.y > ax.get_ylim()[0] - 2)
        & (after.y < ax.get_ylim()[1] + 2)
    )
    angle = after.angle[inside]
    red, blue = (colours[int(np.argmin(np.abs(angle - value)))] for value in (TURNED_BACK, -TURNED))
    assert int(red[1:3], 16) > int(red[5:7], 16) + 40 and int(blue[5:7], 16) > int(blue[1:3], 16) + 40
    # without a backstop's rock of known friction there is no such line
    assert len(drawn.legend(figures_toe.toe(before, after, SHIPPED).axes[0])) == 2
