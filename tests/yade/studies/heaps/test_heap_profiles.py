"""Profiles of speed of made-up columns whose films are known, over seeds, and their figure. Needs no YADE."""

import shutil
from types import SimpleNamespace

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

profiles, grains, records, spreading = (
    synthetic.load(name) for name in ("studies.heaps.profiles", "studies.heaps.grains", "records", "figures.spreading")
)
D, COLUMNS, ROWS = 0.5, 100, 20  # m, disks side by side and above each other
WIDTH, HEIGHT, GRAVITY, PLACE = 50.0, 10.0, 10.0, -3.0  # m, m/s², m
UNIT = 10.0  # √(g H) [m/s]
WAY = 0.02  # m: the front's, so short that all disks stay together
FRAMES = 13  # each a twelfth of a second after the other


def speeds(x, y):
    """By the way back from the tip: a plug to a quarter of it, a simple shear to 60 %, and a layer that rests below
    half of the height, in units of the tip's speed.
    """
    behind, z = 1 - x / WIDTH, y / HEIGHT
    return np.select([behind < 0.25, behind < 0.6], [np.ones_like(z), z], np.maximum(0, 2 * z - 1))


def film(folder, factor=1.0):
    """A run whose front comes ``WAY`` far within a second, with ``factor`` times the speeds behind the first quarter;
    returns (heap, summary, folder).
    """
    folder.mkdir()
    i, j = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    x, y = (i.ravel() + 0.5) * D, (j.ravel() + 0.5) * D
    u = WAY * speeds(x, y) * np.where(x < 0.75 * WIDTH, factor, 1.0)
    times = np.arange(FRAMES) / (FRAMES - 1)
    for k, t in enumerate(times):
        records.write_snapshot(
            folder / "frames" / f"{k:08d}.npz", time_s=t, step=k, x=PLACE + x + u * t, y=y, r=np.full(len(x), 0.5 * D)
        )
    heap = SimpleNamespace(place=lambda: PLACE, gravity=GRAVITY, mean_diameter=lambda: D)
    told = {"runout_rel": WAY / WIDTH, "width_m": WIDTH, "height_m": HEIGHT, "fall_time_s": 0.25}
    return heap, told, folder


@pytest.fixture
def runs(tmp_path):
    return [film(tmp_path / "one"), film(tmp_path / "two", 0.8)]


def test_looks_are_those_around_the_time_when_the_front_has_come_so_far(runs):
    heap, told, folder = runs[0]
    for at, middle in (
        (0.5, 6.5 / 12),
        (0.8, 10.5 / 12),
        (0.95, 10.5 / 12),
    ):  # in spans of a twelfth; the last one ends the film
        seen = profiles.looks(profiles.study.film(folder), PLACE, told["runout_rel"], WIDTH, at)
        assert [one.time for one in seen] == pytest.approx([middle - 1 / 12, middle, middle + 1 / 12])
        assert [one.tip for one in seen] == pytest.approx([WIDTH + WAY * one.time for one in seen], rel=1e-9)
    # places from the wall, and speeds by differences
    one = seen[1]
    still = one.x - WAY * one.time * speeds(*_at_first())
    assert still == pytest.approx(_at_first()[0], abs=1e-5) and one.u == pytest.approx(
        WAY * speeds(*_at_first()), abs=1e-9
    )


def _at_first():
    i, j = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    return (i.ravel() + 0.5) * D, (j.ravel() + 0.5) * D


def test_each_place_has_its_regime_and_means_are_over_runs(runs, monkeypatch):
    monkeypatch.setattr(profiles, "LEAST", 0.001 * WAY)  # nothing is fast here
    found = profiles.over_runs(runs)
    assert [row["at"] for row in found] == list(profiles.AT)
    for row in found:
        assert row["length_rel"]["mean"] == pytest.approx(1.0, abs=1e-3)
        tip, middle, rear = row["places"]
        assert [p["behind"] for p in (tip, middle, rear)] == list(profiles.BEHIND)
        assert [p["regimes"] for p in (tip, middle, rear)] == [{"plug": 2}, {"simple shear": 2}, {"two layers": 2}]
        for place in (tip, middle, rear):
            assert place["z_d"] == [k + 0.5 for k in range(ROWS)] and place["height_d"]["mean"] == pytest.approx(ROWS)
        assert [one["mean"] for one in tip["speed_rel"]] == pytest.approx([WAY / UNIT] * ROWS)
        # the second run has four fifths of the speeds there; Student's t of two values is 12.706 standard errors, each
        # half of their distance
        z = (np.arange(ROWS) + 0.5) / ROWS
        assert [one["mean"] for one in middle["speed_rel"]] == pytest.approx(0.9 * WAY / UNIT * z)
        assert [one["half_width"] for one in middle["speed_rel"]] == pytest.approx(
            12.706 * 0.1 * WAY / UNIT * z, rel=1e-4
        )
        assert middle["fullness"]["mean"] == pytest.approx(0.5, abs=0.03) and rear["fullness"]["mean"] == pytest.approx(
            0.25, abs=0.03
        )
        # a tenth of the largest speed: a tenth of the height of what flows, to half a layer
        assert rear["border_rel"]["mean"] == pytest.approx(0.55, abs=0.025) and tip["border_rel"]["mean"] == 0.0
    assert found[0]["time_rel"]["values"] == pytest.approx([3.5 / 12 / 0.25] * 2)


def test_a_mass_that_hardly_moves_is_at_rest(runs):
    (row, *_) = profiles.over_runs(runs)  # 0.02 m/s beside 0.05 √(g d), 0.11 m/s
    assert all(place["regimes"] == {"at rest": 2} and place["border_rel"]["mean"] == 1.0 for place in row["places"])
    assert row["places"][0]["fullness"] == {"mean": None, "half_width": None, "values": [None, None]}


def test_a_run_of_an_earlier_version_is_refused(runs):
    shutil.rmtree(runs[1][2] / "frames")
    with pytest.raises(grains.HeapError, match="kept no places on its way"):
        profiles.over_runs(runs)


def test_the_figure_has_a_row_for_each_column_with_means_intervals_and_borders(runs, monkeypatch):
    monkeypatch.setattr(profiles, "LEAST", 0.001 * WAY)
    rows = profiles.over_runs(runs)
    (heap, told, folder), at = runs[0], 1
    look = profiles.looks(profiles.study.film(folder), PLACE, told["runout_rel"], WIDTH, profiles.AT[at])[1]
    border = (np.array([10.0, 40.0]), np.array([5.5, 0.0]))
    column = {
        "aspect": 0.2, "seeds": 2, "rows": rows, "shown": at, "look": look, "r": np.full(COLUMNS * ROWS, 0.25), "width": WIDTH, "speed": UNIT, "border": border,
    }  # fmt: skip
    fig = spreading.profiles([column])
    picture, *panels = fig.axes[:4]
    assert picture.get_title(loc="left") == "a = 0.2, 2 seeds: the first, at 2.2 T"
    assert drawn.points(drawn.line(picture, "border of what rests")) == pytest.approx(np.column_stack(border) / WIDTH)
    centres = drawn.disks(picture)[0]
    assert centres[:, 0] == pytest.approx(look.x / WIDTH)
    # where the profiles are taken, from the tip
    marks = sorted(one.get_xdata()[0] for one in picture.lines if len(set(one.get_xdata())) == 1)
    assert marks == pytest.approx(sorted((1 - share) * look.tip / WIDTH for share in profiles.BEHIND))
    regimes = ("plug", "simple shear", "two layers")
    assert [ax.get_title(loc="left") for ax in panels] == [
        f"{'abc'[m]}: {percent} % of the way from the tip" for m, percent in enumerate((10, 40, 75))
    ]
    for m, (ax, regime) in enumerate(zip(panels, regimes)):
        labels = list(drawn.legend(ax))
        assert labels[0] == f"0.25 of the run-out, 1.2 T\n   {regime}, 2 of 2" and len(labels) == 3
        for k, (row, label) in enumerate(zip(rows, labels)):
            place = row["places"][m]
            line = drawn.line(ax, label)
            assert drawn.colour(line) == spreading.TIMES[k].lower()
            means = [one["mean"] for one in place["speed_rel"]]
            assert drawn.points(line) == pytest.approx(np.column_stack([means, place["z_d"]]))
            height = place["border_rel"]["mean"] * place["height_d"]["mean"]
            dashes = [
                one for one in ax.lines if one.get_linestyle() == "--" and drawn.colour(one) == drawn.colour(line)
            ]
            assert [one.get_ydata()[0] for one in dashes] == pytest.approx([height])
    assert [ax.get_ylim() for ax in panels] == [
        pytest.approx((0, 1.75 * (0.5 + max(max(row["places"][m]["z_d"]) for row in rows)))) for m in range(3)
    ]
    # a mass that is lower than a disk has room for names all the same
    for row in rows:
        for place in row["places"]:
            place["z_d"] = [0.01 * z for z in place["z_d"]]
    assert [ax.get_ylim() for ax in spreading.profiles([column]).axes[1:4]] == [pytest.approx((0, 1.75))] * 3
    with pytest.raises(records.RecordsError, match="no columns to draw profiles of"):
        spreading.profiles([])
