"""Figures and video: drawn for whole and for meagre data, true to scale, quick enough. Needs no YADE."""

import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
import synthetic_slope as synthetic  # noqa: E402

pytest.importorskip("matplotlib")
records, figures, video = (synthetic.load(name) for name in ("records", "figures", "video"))
style = synthetic.load("figures.style")
RecordsError = records.RecordsError
SECTION = synthetic.Section()


def snapshot(count=600, at=0.0, contacts=False, **changes):
    return records._snapshot({**synthetic.snapshot_arrays(count, at, contacts=contacts), **changes}, "made up")


@pytest.fixture(scope="module")
def series():
    return synthetic.series(records.COLUMNS, rows=600)


def is_picture(path):
    """A PNG of at least 150 dpi's worth of pixels that is not blank."""
    from matplotlib.image import imread

    pixels = imread(path)
    return pixels.shape[1] >= 1400 and pixels[..., :3].std() > 0.03


def test_force_chains(tmp_path):
    path = figures.force_chains(snapshot(contacts=True), SECTION, tmp_path / "f.png", pdf=True)
    assert is_picture(path) and (tmp_path / "f.pdf").read_bytes().startswith(b"%PDF")
    with pytest.raises(RecordsError, match="no contacts"):
        figures.force_chains(snapshot(), SECTION, tmp_path / "g.png")


def test_bars_join_centres_and_are_as_wide_as_the_force(tmp_path):
    forces = synthetic.load("figures.forces")
    s = snapshot(contacts=True)
    pairs = np.flatnonzero(s.cj >= 0)[:50]
    bars = forces.force_bars(s, pairs, reference=2e6, width=3.0)
    wide = np.hypot(*(bars[:, 0] - bars[:, 3]).T)
    assert wide == pytest.approx(3.0 * np.abs(s.cn[pairs]) / 2e6)
    assert (bars[:, 0] + bars[:, 3]) / 2 == pytest.approx(np.column_stack([s.x[s.ci[pairs]], s.y[s.ci[pairs]]]))
    assert (bars[:, 1] + bars[:, 2]) / 2 == pytest.approx(np.column_stack([s.x[s.cj[pairs]], s.y[s.cj[pairs]]]))
    wall = np.flatnonzero(s.cj < 0)[:20]
    ends = forces.force_bars(s, wall, 2e6, 3.0)[:, 1:3].mean(axis=1)
    assert ends == pytest.approx(np.column_stack([s.cx[wall], s.cy[wall]]))


@pytest.mark.parametrize(
    "times", [synthetic.TIMES, {}, None, {"t0": 5.0, "t1": None}, {**synthetic.TIMES, "t3": float("nan")}, SECTION]
)
def test_forces_against_time(tmp_path, series, times):
    assert is_picture(figures.forces_against_time(series, times, tmp_path / "f.png"))


def test_forces_of_a_single_row(tmp_path, series):
    one = {name: values[:1] for name, values in series.items()}
    assert is_picture(figures.forces_against_time(one, {}, tmp_path / "f.png"))


def test_series_without_rows_or_columns_say_so(tmp_path, series):
    with pytest.raises(RecordsError, match="no column.*dp_shear"):
        figures.forces_against_time({k: v for k, v in series.items() if "dp_shear" not in k}, {}, tmp_path / "f.png")
    with pytest.raises(RecordsError, match="no rows"):
        figures.energy({name: values[:0] for name, values in series.items()}, tmp_path / "f.png")
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordsError, match="cannot be written"):
        figures.energy(series, tmp_path / "file" / "f.png")


def test_snapshots_and_deposit(tmp_path):
    cases = [(name, snapshot(at=at)) for name, at in synthetic.TIMES.items()]
    assert is_picture(figures.snapshots(cases, SECTION, tmp_path / "s.png"))
    assert is_picture(figures.snapshots([("a state", cases[0][1])], SECTION.walls, tmp_path / "t.png", close_up=False))
    assert is_picture(figures.deposit(cases[-1][1], cases[0][1], SECTION, tmp_path / "d.png"))
    with pytest.raises(RecordsError, match="no snapshot"):
        figures.snapshots([], SECTION, tmp_path / "u.png")


def test_energy_and_solver(tmp_path, series):
    assert is_picture(figures.energy(series, tmp_path / "e.png", times=synthetic.TIMES))
    assert is_picture(figures.solver(series, tmp_path / "s.png", times=synthetic.TIMES))
    still = {name: np.zeros_like(values) for name, values in series.items()} | {"time_s": series["time_s"]}
    assert is_picture(figures.energy(still, tmp_path / "e.png"))
    assert is_picture(figures.solver(still, tmp_path / "s.png"))


def test_disks_have_their_true_radii(tmp_path):
    """Two disks that touch meet on the picture, and cover the area they should."""
    fig = style.figure(4, 2, dpi=100)
    ax = fig.add_axes([0, 0, 1, 1])
    style.frame(ax, -4, 4, -2, 2)
    zeros = np.zeros(2)
    s = snapshot(
        x=[-1.0, 1.5], y=[0.0, 0.0], r=[1.0, 1.5], angle=zeros, vx=zeros, vy=zeros, layer=[0, 0],
        wet=zeros > 0, released=zeros > 0,
    )  # fmt: skip
    style.draw_disks(ax, s, np.tile([0.0, 0, 0, 1], (2, 1)))
    fig.canvas.draw()
    ink = 1 - np.asarray(fig.canvas.buffer_rgba())[..., 0] / 255
    assert ink.sum() == pytest.approx(np.pi * (1 + 1.5**2) * 50**2, rel=0.01)
    assert ink[100, 101:349].min() > 0.9 and ink[100, :99].max() == 0 and ink[100, 351:].max() == 0


def test_deposit_profile_measures_thickness_and_front():
    """A rectangle of disks, 20 m thick on level ground, with one disk flown far ahead."""
    gx, gy = np.meshgrid(np.arange(0.5, 200), np.arange(0.5, 20))
    x, y = np.r_[gx.ravel(), 900.0], np.r_[gy.ravel(), 80.0]
    n = np.zeros(len(x))
    s = snapshot(x=x, y=y, r=n + 0.5, angle=n, vx=n, vy=n, layer=n, wet=n > 0, released=n > 0)
    walls = [("DP", [[-100.0, 0.0], [0.0, 0.0]]), ("SS", [[0.0, 0.0], [1000.0, 0.0]])]
    at, base, surface = figures.deposit_profile(s, walls)
    there = np.isfinite(surface)
    assert surface[there] - base[there] == pytest.approx(20.0)
    assert at[there].max() < 203
    assert figures.front(s) == pytest.approx(200, abs=1)


def test_water_table_is_parallel_to_the_plane_at_its_height():
    plane = SECTION.walls[0][1]
    moved = style.water_points(style.as_walls(SECTION), 22.5) - plane
    assert moved == pytest.approx(22.5 * np.array([synthetic.NORMAL, synthetic.NORMAL]))
    assert style.water_points([("SS", plane)], 1.0) is None


def test_walls_in_all_their_forms():
    class Wall:
        name, vertices = "DP", ((0.0, 1.0), (1.0, 0.0))

    assert style.as_walls([Wall()])[0][0] == "DP"
    assert style.as_walls(SECTION)[0][1].shape == (2, 2)
    with pytest.raises(RecordsError, match="FB.*two points"):
        style.as_walls([("FB", [[0.0, 0.0]])])


def test_running_mean_stays_centred():
    x = np.linspace(0, 10, 101)
    # of a straight line it is the line itself, also at the ends, where a window cut on one side would lean; exact but for rounding
    np.testing.assert_allclose(style.running_mean(x, 3 * x + 1, 2.0), 3 * x + 1, rtol=1e-12)
    # of a spike it is the spike's share of the window: 21 rows in the middle
    spike = np.zeros(101)
    spike[50] = 21.0
    np.testing.assert_allclose(style.running_mean(x, spike, 2.0)[[39, 40, 50, 60, 61]], [0, 1, 1, 1, 0], atol=1e-12)


def test_importing_needs_no_display_and_leaves_the_settings_alone(tmp_path, series):
    import matplotlib

    with matplotlib.rc_context({"font.size": 33}):
        figures.energy(series, tmp_path / "e.png")
        assert matplotlib.rcParams["font.size"] == 33
    code = (
        "import sys; sys.path.insert(0, %r); import synthetic_slope as s; s.load('video'); s.load('figures');"
        "assert 'matplotlib.pyplot' not in sys.modules and 'yade' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code % str(Path(__file__).parent)], check=True, env={"PATH": "/usr/bin"})


def test_twenty_thousand_disks_are_drawn_in_seconds(tmp_path):
    big = snapshot(20000, 60.0)
    start = time.process_time()
    figures.snapshots([("t3", big), ("t4", big)], SECTION, tmp_path / "s.png")
    assert time.process_time() - start < 10


@pytest.fixture(scope="module")
def frames(tmp_path_factory):
    folder = tmp_path_factory.mktemp("frames")
    return [
        records.write_snapshot(folder / f"{k:03d}.npz", **synthetic.snapshot_arrays(400, at, contacts=False))
        for k, at in enumerate(np.linspace(0, 92, 6))
    ]


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg")
@pytest.mark.parametrize("with_series", [False, True])
def test_video(tmp_path, frames, series, with_series):
    seen = []
    extra = {"series": series, "times": synthetic.TIMES} if with_series else {}
    path, note = video.write_mp4(frames, SECTION, tmp_path / "v.mp4", 10, progress=lambda *a: seen.append(a), **extra)
    assert note is None and path == tmp_path / "v.mp4" and seen[-1] == (6, 6)
    assert [p.name for p in tmp_path.iterdir()] == ["v.mp4"]
    if shutil.which("ffprobe"):
        asked = ["-show_entries", "stream=width,height,nb_frames", "-of", "csv=p=0"]
        answer = subprocess.run(["ffprobe", "-v", "error", *asked, str(path)], capture_output=True, text=True).stdout
        assert answer.strip().startswith("1280,720") and int(answer.strip().split(",")[2]) >= 6


def test_video_without_ffmpeg_is_a_note(tmp_path, frames, monkeypatch):
    monkeypatch.setattr(video.FFMpegWriter, "isAvailable", classmethod(lambda cls: False))
    path, note = video.write_mp4(frames, SECTION, tmp_path / "v.mp4", 10)
    assert path is None and "ffmpeg is not installed" in note


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg")
def test_a_video_that_fails_leaves_the_old_one(tmp_path, frames):
    old = tmp_path / "v.mp4"
    old.write_text("old")
    other = records.write_snapshot(tmp_path / "other.npz", **synthetic.snapshot_arrays(200, 0.0, contacts=False))
    with pytest.raises(RecordsError, match="other.npz.*one run"):
        video.write_mp4([frames[0], frames[1], other, frames[2], frames[3], frames[4]], SECTION, old, 10)
    assert old.read_text() == "old" and not list(tmp_path.glob(".*"))
    path, note = video.write_mp4(frames, SECTION, old / "v.mp4", 10)  # a file, and no folder
    assert path is None and "ffmpeg failed" in note
    with pytest.raises(RecordsError, match="no snapshots"):
        video.write_mp4([], SECTION, old, 10)
