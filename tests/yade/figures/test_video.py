"""What the frames of the video show, and the file. Needs no YADE; one video is written."""

import contextlib
import shutil
import subprocess
import types

import numpy as np
import pytest
from matplotlib.collections import EllipseCollection

import drawn
import synthetic_slope as synthetic

records, video, film, style = (
    synthetic.load(name) for name in ("records", "figures.video", "figures.film", "figures.style")
)
RecordsError = records.RecordsError
WALLS = [
    ("DP", [[-100.0, 75.0], [0.0, 0.0]], "slip"),
    ("FB", [[0.0, 0.0], [3.0, 4.0]], "backstop"),
    ("SS", [[3.0, 4.0], [100.0, 4.0]], "ground"),
]
TIMES = {"t0": 5.0, "t1": 50.0, "t3": 60.0, "t5": 92.0}
X, Y = np.array([-60.0, -40.0, -20.0, 20.0]), np.array([70.0, 50.0, 30.0, 10.0])
# time [s], water [m], wet, released, way [m], speed [m/s] down the slope of three quarters
COURSE = (
    (0.0, 0.0, [0, 0, 0, 0], [0, 0, 0, 0], 0.0, 0.0),
    (55.04, 10.0, [1, 1, 0, 0], [0, 0, 0, 0], 0.0, 0.0),
    (80.0, 20.0, [1, 1, 1, 0], [0, 1, 1, 0], 30.0, 10.0),
)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder, made = tmp_path_factory.mktemp("frames"), []
    for k, (time, water, wet, released, way, speed) in enumerate(COURSE):
        s = synthetic.few(
            X + 0.8 * way,
            Y - 0.6 * way,
            r=[3.0, 3.0, 4.0, 5.0],
            layer=[0, 1, 0, 1],
            time_s=time,
            water_m=water,
            wet=np.array(wet, bool),
            released=np.array(released, bool),
            vx=np.full(4, 0.8 * speed),
            vy=np.full(4, -0.6 * speed),
        )
        made.append(records.write_snapshot(folder / f"{k}.npz", **vars(s)))
    return made


def series():
    t = np.linspace(0, 100, 101)
    return {
        "time_s": t,
        "dp_normal_effective_N_per_m": 1e6 * (900 - t),
        "dp_shear_N_per_m": 1e6 * (300 - 2 * t),
        "fb_normal_N_per_m": 1e6 * (100 + 3 * t),
    }


@pytest.fixture
def shown(monkeypatch, tmp_path):
    """A function that makes a video without ffmpeg: (figure, [what each frame showed]), with its picture (rows from the
    top).
    """
    monkeypatch.setattr(film.FFMpegWriter, "isAvailable", classmethod(lambda cls: True))

    class Kept:
        def __init__(self, **options):
            self.options = options

        @contextlib.contextmanager
        def saving(self, fig, path, dpi):
            told.fig, told.options = fig, self.options
            (tmp_path / path).touch()
            yield

        def add(self, picture):
            ax = told.fig.axes[0]
            (disks,) = (c for c in ax.collections if isinstance(c, EllipseCollection))
            (water,) = (one for one in ax.lines if drawn.colour(one) == style.WATER)
            cursor = [one.get_xdata()[0] for ax in told.fig.axes[1:] for one in ax.lines if one.get_linewidth() == 1.6]
            told.frames.append(
                types.SimpleNamespace(
                    words=drawn.texts(told.fig),
                    centres=np.array(disks.get_offsets()),
                    radii=np.array(disks._widths),
                    fills=drawn.hexes(disks.get_facecolor()),
                    water=drawn.points(water) if water.get_visible() else None,
                    cursor=cursor,
                    picture=np.array(picture, dtype=np.uint8),
                )
            )

    told = types.SimpleNamespace(fig=None, options=None, frames=[])
    monkeypatch.setattr(film, "_Writer", Kept)

    def make(files, **options):
        assert video.write_mp4(files, WALLS, tmp_path / "v.mp4", **options) == (tmp_path / "v.mp4", None)
        return told

    return make


def test_each_frame_shows_its_snapshot(shown, files):
    told = shown(files, fps=10)
    assert told.options["fps"] == 10 and len(told.frames) == 3
    first, wet, moving = told.frames
    assert [f.words for f in told.frames] == [
        ["t = 0.0 s", "water table 0.00 m    mean speed 0.0 m/s"],
        ["t = 55.0 s", "water table 10.00 m    mean speed 0.0 m/s"],
        ["t = 80.0 s", "water table 20.00 m    mean speed 10.0 m/s"],
    ]
    (d0, d1), (w0, w1), (r0, r1) = style.DRY, style.WET, style.RELEASED
    assert [f.fills for f in told.frames] == [
        [d0, d1, d0, d1],
        [w0, w1, d0, d1],
        [w0, r1, r0, d1],
    ] and wet.radii.tolist() == [3, 3, 4, 5]
    assert np.array_equal(first.centres, np.column_stack([X, Y])) and moving.centres == pytest.approx(
        np.column_stack([X + 24, Y - 18]), rel=1e-12
    )
    # along the normal (0.6, 0.8) of the plane
    assert (
        first.water is None
        and wet.water == pytest.approx(np.array([[-94, 83], [6, 8]]))
        and moving.water == pytest.approx(np.array([[-88, 91], [12, 16]]))
    )
    assert drawn.legend(told.fig) == {"dry": d0, "under pore pressure": w0, "released": r0} and len(told.fig.axes) == 1


def test_one_snapshot_makes_one_frame(shown, files):
    told = shown(files[1:2])
    assert [f.words for f in told.frames] == [["t = 55.0 s", "water table 10.00 m    mean speed 0.0 m/s"]]
    assert np.array_equal(told.frames[0].centres, np.column_stack([X, Y])) and told.frames[0].radii.tolist() == [
        3,
        3,
        4,
        5,
    ]


def test_frames_are_pictures_of_one_view(shown, files):
    """The colour at the centre of each disk on the picture, 1280 by 720, of each frame; where a disk was before there
    is none.
    """
    told = shown(files, fps=10)
    ax = told.fig.axes[0]
    assert ax.get_aspect() == 1 and {f.picture.shape for f in told.frames} == {(720, 1280, 4)}

    def at(frame, points):
        across, up = np.rint(ax.transData.transform(points)).astype(int).T
        return ["#{:02x}{:02x}{:02x}".format(*frame.picture[719 - u, a, :3]) for a, u in zip(across, up)]

    for frame in told.frames:
        assert at(frame, frame.centres[:3]) == frame.fills[:3]  # the fourth lies on the water table's line in the end
    assert at(told.frames[2], [(-40.0, 50.0)]) == ["#ffffff"] and at(told.frames[0], [(-40.0, 50.0)]) == [style.DRY[1]]
    # all of the first and the last snapshot are in sight
    everything = np.vstack([told.frames[0].centres, told.frames[2].centres])
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    assert (everything > (x0, y0)).all() and (everything < (x1, y1)).all()


def test_the_ground_has_no_end_within_a_frame(shown, files, monkeypatch):
    """A frame is wider than these walls, 90 m of them."""
    short = [("DP", [[-70.0, 52.5], [0.0, 0.0]], "slip"), ("SS", [[0.0, 0.0], [20.0, 0.0]], "ground")]
    monkeypatch.setitem(globals(), "WALLS", short)
    told = shown(files, fps=10)
    (x0, x1), picture = told.fig.axes[0].get_xlim(), told.frames[0].picture
    assert x0 < -80 and x1 > 30
    lowest = {"#{:02x}{:02x}{:02x}".format(*picture[-2, k, :3]) for k in (1, 300, 900, -2)}
    assert lowest == {style.GROUND}


def test_the_strip_of_forces_has_a_cursor_at_the_time_of_the_frame(shown, files):
    told = shown(files, fps=10, series=series(), times=TIMES)
    assert [f.cursor for f in told.frames] == [[0.0], [55.04], [80.0]]
    slope, strip = told.fig.axes
    assert (
        strip.get_xlabel() == "time [s]"
        and strip.get_ylabel() == "force [MN/m]"
        and strip.get_xlim() == (0, 100)
        and strip.get_position().y1 < slope.get_position().y0
    )
    t = series()["time_s"]
    forces = {
        "$N'_{DP}$  effective normal force on DP": 900 - t,
        "$T_{DP}$  shear force on DP": 300 - 2 * t,
        "$N'_{FB}$  normal force on FB": 100 + 3 * t,
    }
    for name, values in forces.items():
        assert drawn.points(drawn.line(strip, name)) == pytest.approx(np.column_stack([t, values]))
        assert drawn.legend(told.fig)[name] == drawn.colour(drawn.line(strip, name))
    levels = [one for one in strip.lines if len(set(one.get_ydata())) == 1 and list(one.get_xdata()) == [0, 1]]
    assert [set(one.get_ydata()) for one in levels] == [{0}]  # a line at no force, all across
    assert set(TIMES.values()) <= set(drawn.uprights(strip)) and {
        t.get_text(): 100 * t.get_position()[0] for t in strip.texts
    } == pytest.approx({f"$t_{{{name[1]}}}$": at for name, at in TIMES.items()})
    assert [band[:2] for band in drawn.bands(strip)] == [(5, 50), (60, 92)]  # t2 is not known


def test_forces_are_means_over_a_second_once_the_avalanche_moves(shown, files):
    t = np.linspace(0, 100, 1001)
    jumps = np.zeros(1001)
    jumps[200], jumps[750] = 22e6, 22e6  # 20 s, before t3, and 75 s
    told = shown(files, fps=10, series={"time_s": t, **{name: jumps for name, *_ in video.FORCES}}, times=TIMES)
    for label in (
        "$N'_{DP}$  effective normal force on DP",
        "$T_{DP}$  shear force on DP",
        "$N'_{FB}$  normal force on FB",
    ):
        force = drawn.points(drawn.line(told.fig.axes[1], label))[:, 1]
        assert force[[199, 200, 201]].tolist() == [0, 22, 0]
        assert force[[744, 745, 750, 755, 756]] == pytest.approx([0, 2, 2, 2, 0], abs=1e-9)  # 11 rows of 0.1 s


def test_a_wide_and_a_tall_slope_keep_equal_scales(shown, files, tmp_path):
    tall = [
        records.write_snapshot(tmp_path / f"{k}.npz", **vars(synthetic.few([-1.0, 2.0], [0.0, 500.0])))
        for k in range(2)
    ]
    for paths in (files, tall):
        ax = shown(paths, fps=10).fig.axes[0]
        box = ax.get_position()
        assert np.ptp(ax.get_xlim()) / (1280 * box.width) == pytest.approx(np.ptp(ax.get_ylim()) / (720 * box.height))


# ---- the file -------------------------------------------------------------------------------------


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg")
def test_video(tmp_path, files):
    seen = []
    path, note = video.write_mp4(
        files, WALLS, tmp_path / "v.mp4", 10, series=series(), times=TIMES, progress=lambda *a: seen.append(a)
    )
    assert note is None and path == tmp_path / "v.mp4" and seen == [(1, 3), (2, 3), (3, 3)]
    assert [p.name for p in tmp_path.iterdir()] == ["v.mp4"]
    if shutil.which("ffprobe"):
        asked = ["-show_entries", "stream=width,height,nb_frames,r_frame_rate", "-of", "csv=p=0"]
        answer = subprocess.run(["ffprobe", "-v", "error", *asked, str(path)], capture_output=True, text=True).stdout
        assert answer.strip() == "1280,720,10/1,18"  # the last frame stays for 1.5 s


def test_video_without_ffmpeg_is_a_note(tmp_path, files, monkeypatch):
    monkeypatch.setattr(film.FFMpegWriter, "isAvailable", classmethod(lambda cls: False))
    path, note = video.write_mp4(files, WALLS, tmp_path / "v.mp4", 10)
    assert path is None and "ffmpeg is not installed" in note


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg")
def test_a_video_that_fails_leaves_the_old_one(tmp_path, files):
    old = tmp_path / "v.mp4"
    old.write_text("old")
    other = records.write_snapshot(tmp_path / "other.npz", **synthetic.snapshot_arrays(200, 0.0, contacts=False))
    with pytest.raises(RecordsError, match="other.npz.*one run"):
        video.write_mp4([files[0], other, files[1]], WALLS, old, 10)
    assert old.read_text() == "old" and not list(tmp_path.glob(".*"))
    path, note = video.write_mp4(files, WALLS, old / "v.mp4", 10)  # a file, and no folder
    assert path is None and "ffmpeg failed" in note
    with pytest.raises(RecordsError, match="no snapshots"):
        video.write_mp4([], WALLS, old, 10)


def test_interfaces_and_their_names_lie_over_the_disks():
    """What moves is drawn anew over all that does not; an interface runs through the disks, and walls do not."""
    made = synthetic.load("model.section").load("interface")
    x, y = made.line_of(made.interfaces[0]).mean(axis=0)
    shot = synthetic.few([x - 200.0, x, x + 200.0], [y + 80.0, y, y - 70.0])
    ground = synthetic.load("measure.ground").ground_of(made)
    frames = video._Frames(ground, style.view([shot], ground), shot, (1280, 720), None, None, 1.0, 100.0)
    named = {one.get_text(): k for k, one in enumerate(frames.moving) if hasattr(one, "get_text") and one.get_text()}
    assert named["joint"] > frames.moving.index(frames.disks) and "base" not in named
    dotted = [one for one in frames.moving if one is not frames.water and hasattr(one, "get_xydata")]
    assert len(dotted) == 1 and dotted[0].get_xydata() == pytest.approx(made.line_of(made.interfaces[0]))
