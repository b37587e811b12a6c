"""Videos of any scene: which frames are kept, what each of them shows, and the file."""
import contextlib
import json
import math
import subprocess
import types

import drawn
import numpy as np
import pytest
import shell
from matplotlib.collections import EllipseCollection, PolyCollection
from PIL import Image
from yade import O, utils
from yade.nonsmooth import figures, records, scene, scene_arrays
from yade.nonsmooth.figures import film, moving, style
from yade.nonsmooth.world.stepping import advance
from yade.wrapper import FrictMat, NewtonIntegrator, NscdMat

from contact_scenes import begin, material

pytestmark = pytest.mark.usefixtures("empty")
G = 9.81


def falling(height=100.0, dt=1e-2, colours=(None, None)):
    """Two disks that fall freely from the height, side by side; the scene's gravity is 9.81 m/s²."""
    stuff = material(0.5, layer=0)
    O.materials.append(stuff)
    ids = O.bodies.append([scene.disk((3 * k, height), 0.5, stuff, color=c) for k, c in enumerate(colours)])
    begin(dt=dt)
    return ids


def resting(count=3):
    """A stack of disks on a floor, the lowest contact of which bears them all."""
    stuff, rough = material(0.5, layer=0), NscdMat(frictionAngle=0.4, wall=True)
    O.materials.append((stuff, rough))
    O.bodies.append(scene.segments([(-4, 0), (4, 0)], rough))
    O.bodies.append([scene.disk((0, 0.5 + k), 0.5, stuff) for k in range(count)])
    begin(dt=1e-3, tolerance=1e-8)


@pytest.fixture
def shown(monkeypatch):
    """What the frames of a video show, as drawn, without a file: list of namespaces."""
    told = []

    class Kept:
        def __init__(self, **options):
            self.fps = options["fps"]

        @contextlib.contextmanager
        def saving(self, fig, path, dpi):
            self.fig = fig
            open(path, "w").close()
            yield

        def add(self, picture):
            ax = self.fig.axes[0]
            (disks,) = (c for c in ax.collections if isinstance(c, EllipseCollection))
            bars = [c for c in ax.collections if isinstance(c, PolyCollection)]
            told.append(
                types.SimpleNamespace(
                    fig=self.fig,
                    centres=np.array(disks.get_offsets()),
                    fills=drawn.hexes(disks.get_facecolor()),
                    wide=sorted(np.hypot(*(p.vertices[3] - p.vertices[0])) for c in bars for p in c.get_paths()),
                    words=drawn.texts(self.fig),
                    limits=(*ax.get_xlim(), *ax.get_ylim()),
                    legend={
                        t.get_text(): h.get_linewidth()
                        for t, h in zip(ax.get_legend().get_texts(), ax.get_legend().get_lines())
                    }
                    if ax.get_legend()
                    else {},
                    picture=np.array(picture, dtype=np.uint8),
                    fps=self.fps,
                )
            )

    monkeypatch.setattr(film, "_writer", lambda path, fps: Kept(fps=fps))
    monkeypatch.setattr(film.FFMpegWriter, "isAvailable", classmethod(lambda cls: True))
    return told


def fallen(time):
    """Way of a free fall from rest after a time [s], with steps of 10 ms: speeds are those of a step's end."""
    return 0.5 * G * time * (time + 1e-2)


def test_a_fall_is_filmed_at_equal_times_with_one_view(shown, tmp_path):
    falling()
    assert figures.animate(O, tmp_path / "fall.mp4", seconds=2.0, frames=8, fps=10) == tmp_path / "fall.mp4"
    assert O.time == pytest.approx(2.0) and len(shown) == 9 and {f.fps for f in shown} == {10}
    for k, frame in enumerate(shown):
        assert frame.centres[:, 1] == pytest.approx([100 - fallen(0.25 * k)] * 2, abs=1e-9)
        assert frame.words == [f"t = {0.25 * k:.2f} s", "2 disks"]
    assert len({f.limits for f in shown}) == 1 and len({f.picture.shape for f in shown}) == 1
    x0, x1, y0, y1 = shown[0].limits
    assert x0 < -0.5 and x1 > 3.5 and y0 < 100 - fallen(2.0) - 0.5 and y1 > 100.5
    # each picture has the disks where they are, and nothing where they were
    first, last = shown[0], shown[-1]

    def at(frame, place):
        across, up = np.rint(frame.fig.axes[0].transData.transform(place)).astype(int)
        return "#{:02x}{:02x}{:02x}".format(*frame.picture[-1 - up, across, :3])

    for frame in (first, last):
        assert [at(frame, place) for place in frame.centres] == frame.fills
    assert at(last, first.centres[0]) == at(first, last.centres[0]) == "#ffffff"


def test_the_scale_of_forces_is_one_for_all_frames_and_told(shown, tmp_path):
    """A stack bears the weight of one, two and three disks; then a fourth falls on it."""
    resting()
    with figures.record(O, tmp_path / "stack.mp4", period=0.05):
        O.run(100, wait=True)
        O.bodies.append(scene.disk((0, 4.0), 0.5, O.materials[0]))
        O.run(900, wait=True)
    weight = 2500 * math.pi / 4 * G
    before, after = shown[2], shown[-1]
    assert len(before.centres) == 3 and len(after.centres) == 4
    assert np.array(before.wide) / before.wide[0] == pytest.approx([1, 2, 3], rel=1e-3)
    assert np.array(after.wide) / before.wide[0] == pytest.approx([1, 2, 3, 4], rel=1e-3)
    # the legend's bar is as wide as a force of its size is in the picture
    ((words, points),) = after.legend.items()
    assert words.startswith("compression ") and {json.dumps(f.legend) for f in shown} == {json.dumps(after.legend)}
    newtons = float(words.split()[1]) * {"kN": 1e3, "MN": 1e6, "N": 1}[words.split()[2]]
    ax = after.fig.axes[0]
    pixels = points * after.fig.dpi / 72
    metres = pixels * (after.limits[1] - after.limits[0]) / ax.get_window_extent().width
    assert metres / newtons == pytest.approx(before.wide[0] / weight, rel=1e-3)


def test_a_recorder_keeps_a_bounded_number_of_frames_at_equal_times():
    falling()
    made = figures.record(O, most=10)
    O.run(137, wait=True)
    times = [t for t, _ in made.frames]
    # periods of 1, 2, 4, 8, 16 steps: of 137 the last is the one that needs ten frames or fewer
    assert made.period == pytest.approx(0.16) and times == pytest.approx([0.16 * k for k in range(9)], abs=1e-9)
    for t, s in made.frames:
        assert s.y == pytest.approx([100 - fallen(t)] * 2, abs=1e-9)


def test_a_recorder_keeps_a_bounded_number_of_bytes():
    falling()
    one = scene_arrays.read(O).nbytes
    made = figures.record(O, period=0.01, memory=7.5 * one)
    O.run(100, wait=True)
    # periods of 1, 2, 4, 8, 16 steps: seven frames fit
    assert [t for t, _ in made.frames] == pytest.approx([0.16 * k for k in range(7)]) and made.period == pytest.approx(
        0.16
    )


def test_frames_do_not_drift_where_the_period_is_no_multiple_of_the_step():
    falling()
    made = figures.record(O, period=0.025)
    O.run(100, wait=True)
    times = np.array([t for t, _ in made.frames])
    assert times == pytest.approx(0.025 * np.arange(41), abs=0.0051)  # to half a step each


def test_filming_changes_no_bit():
    def run(filmed):
        O.reset()
        resting(5)
        if filmed:
            figures.record(O, period=0.01)
        O.run(200, wait=True)
        return [tuple(b.state.pos) + tuple(b.state.vel) for b in O.bodies]

    assert run(False) == run(True)


def test_a_scene_that_begins_anew_begins_the_film_anew():
    with figures.recording(O, period=0.05) as made:
        falling()
        O.run(50, wait=True)
        assert len(made.frames) == 11
        O.reset()
        falling(height=7.0)
        O.run(10, wait=True)
        assert [s.y[0] < 8 for _, s in made.frames] == [True] * 3
        O.engines = [e for e in O.engines if not hasattr(e, "command")]  # as a script that sets its engines again
        O.step()
        assert sum(getattr(e, "command", None) == made.engine.command for e in O.engines) == 1
    assert not any(hasattr(e, "command") for e in O.engines)


def test_what_is_filmed_is_taken_out_again_and_nothing_is_written_where_the_block_raises(shown, tmp_path):
    falling()
    usual = type(O).run
    old = tmp_path / "fall.mp4"
    old.write_text("old")
    with pytest.raises(ZeroDivisionError):
        with figures.recording(O, old):
            O.run(5, wait=True)
            1 / 0
    assert old.read_text() == "old" and [p.name for p in tmp_path.iterdir()] == ["fall.mp4"]
    assert type(O).run is usual and not any(hasattr(e, "command") for e in O.engines)


def test_no_video_is_written_of_a_scene_that_still_runs(tmp_path):
    falling()
    made = figures.record(O)
    made._O = types.SimpleNamespace(running=True, time=O.time, dt=O.dt)  # as between O.run() and O.wait()
    with pytest.raises(records.RecordsError, match="fall.gif: the scene still runs; call O.wait"):
        made.write(tmp_path / "fall.gif")
    assert not list(tmp_path.iterdir())


def test_bodies_own_colours_are_taken_where_they_were_chosen(shown, tmp_path):
    red, blue = (0.9, 0.1, 0.1), (0.1, 0.1, 0.9)
    falling(colours=(red, blue, red, blue))
    assert drawn.disks(figures.draw(O).axes[0])[2] == ["#e61a1a", "#1a1ae6"] * 2  # no forces are drawn on them
    assert drawn.disks(figures.draw(O, colours="materials").axes[0])[2] == [figures.scene.MATERIALS[0]] * 4
    figures.animate(O, tmp_path / "fall.mp4", seconds=0.1, frames=2)
    assert shown[-1].fills == ["#e61a1a", "#1a1ae6"] * 2
    O.reset()
    falling()  # YADE's random colours
    assert (
        scene_arrays.read(O).colour is None
        and drawn.disks(figures.draw(O).axes[0])[2] == [figures.scene.MATERIALS[0]] * 2
    )
    with pytest.raises(records.RecordsError, match="give bodies a color"):
        figures.draw(O, colours="bodies")


def test_the_view_is_around_what_moves_and_not_along_a_floor_of_disks():
    stuff = material(0.5, layer=0)
    O.materials.append(stuff)
    O.bodies.append([scene.disk((k, -0.5), 0.5, stuff, fixed=True) for k in range(-50, 51)])
    O.bodies.append([scene.disk((k, 0.5), 0.5, stuff) for k in range(10)])
    x0, x1, y0, _ = figures.draw(O).axes[0].get_xlim() + figures.draw(O).axes[0].get_ylim()
    # 10 m of disks, a fifth of it on both sides, and 6 % of all this around
    assert (x0, x1) == pytest.approx((-0.5 - 2 - 0.84, 9.5 + 2 + 0.84)) and y0 < -1
    O.reset()
    O.materials.append(stuff)
    O.bodies.append([scene.disk((k, 0), 0.5, stuff, fixed=True) for k in range(3)])
    assert figures.draw(O).axes[0].get_xlim() == pytest.approx((-0.5 - 0.18, 2.5 + 0.18))


def test_a_view_of_ones_own_is_kept(shown, tmp_path):
    falling()
    figures.animate(O, tmp_path / "fall.mp4", seconds=0.1, frames=2, view=(-1, 4, 90, 101))
    assert {f.limits for f in shown} == {(-1, 4, 90, 101)}
    ax = figures.draw(O, view=(0, 1, 2, 3)).axes[0]
    assert (*ax.get_xlim(), *ax.get_ylim()) == (0, 1, 2, 3)


@pytest.mark.parametrize(
    "view, pixels",
    [
        ((0, 10, 0, 90), (480, 720 + 44)),  # as high as a picture may be, and no narrower than 480 pixels
        ((0, 120, 0, 20), (1280, 214 + 44)),  # as wide, of 213.3 pixels: the next even number
        ((0, 101, 0, 61), (1194, 720 + 44)),  # 1192.1 pixels
    ],
)
def test_a_video_is_as_large_as_may_be_in_even_numbers_of_pixels(view, pixels, shown, tmp_path):
    falling()
    figures.animate(O, tmp_path / "fall.mp4", seconds=0.1, frames=1, view=view)
    assert {f.picture.shape[1::-1] for f in shown} == {pixels}


@pytest.mark.parametrize(
    "how, words",
    [
        (dict(path="fall.avi"), "fall.avi: a video ends in .mp4 or .gif"),
        (dict(seconds=0), "seconds 0: give a time above 0 s"),
        (dict(seconds=math.nan), "seconds nan"),
        (dict(seconds="2"), "seconds '2': give a time above 0 s"),
        (dict(frames=0), "frames 0: give a whole number"),
        (dict(frames=10_001), "frames 10001: give a whole number from 1 to 10000"),
        (dict(frames=10, period=0.1), "frames 10 and period 0.1: .* give one of them"),
        (dict(period=-1.0), "period -1.0: the time between two frames is above 0 s"),
        (dict(fps=0), "fps 0: give frames a second"),
        (dict(fps=1e9), "fps 1000000000.0: give frames a second, from 0.1 to 100"),
        (dict(fps=None), "fps None: give frames a second"),
        (dict(seconds=None), "seconds None: give a time above 0 s"),
        (dict(frames=True), "frames True: give a whole number"),
        (dict(path=3), "path 3: give the name of a file that ends in .mp4 or .gif"),
        (dict(view=(1, 0, 0, 1)), r"view \(1, 0, 0, 1\): give \(x0, x1, y0, y1\) in metres"),
        (dict(view="all"), "view 'all'"),
        (dict(colours="red"), "colours 'red': give 'bodies' or 'materials'"),
    ],
)
def test_what_cannot_be_filmed_is_refused_before_a_step(how, words):
    falling()
    with pytest.raises(records.RecordsError, match=words):
        figures.animate(O, **how)
    assert O.iter == 0


def test_a_scene_that_cannot_be_filmed_is_refused():
    with pytest.raises(records.RecordsError, match="no disk in the scene"):
        figures.animate(O, seconds=1)
    falling()
    O.dt = 0
    with pytest.raises(records.RecordsError, match="O.dt = 0: set the time step"):
        figures.animate(O, seconds=1)
    O.reset()
    with pytest.raises(records.RecordsError, match="no frame has been kept"):
        figures.record(O).write("x.gif")
    for options in (dict(most=1), dict(memory=0), dict(period=math.inf)):
        with pytest.raises(records.RecordsError):
            figures.record(O, **options)


def test_without_ffmpeg_an_mp4_is_refused_with_the_remedy_and_a_gif_is_made(monkeypatch, tmp_path):
    monkeypatch.setattr(film.FFMpegWriter, "isAvailable", classmethod(lambda cls: False))
    falling()
    with pytest.raises(records.RecordsError, match="ffmpeg is not installed .* a name that ends in .gif"):
        figures.animate(O, tmp_path / "fall.mp4", seconds=0.1)
    assert O.iter == 0
    path = figures.animate(O, tmp_path / "fall.gif", seconds=0.5, frames=5)
    picture = Image.open(path)
    assert picture.n_frames == 6 and [p.name for p in tmp_path.iterdir()] == ["fall.gif"]
    times = []
    for k in range(picture.n_frames):
        picture.seek(k)
        times.append(picture.info["duration"])
    assert times == [40] * 5 + [1540]  # the last one stays
    html = figures.animate(O, seconds=0.1, frames=2)._repr_html_()
    assert html.startswith('<img src="data:image/gif;base64,R0lG')  # what a GIF begins with


@pytest.mark.skipif(film.missing() is not None, reason="no ffmpeg")
def test_a_video_is_a_file_that_plays_and_a_notebook_shows(tmp_path):
    falling()
    path = figures.animate(O, tmp_path / "fall.mp4", seconds=0.5, frames=5)
    asked = ["-show_entries", "stream=nb_frames,codec_name", "-of", "csv=p=0"]
    answer = subprocess.run(["ffprobe", "-v", "error", *asked, str(path)], capture_output=True, text=True).stdout
    assert answer.strip() == f"h264,{6 + 38}"  # and 1.5 s of the last one at 25 a second
    html = figures.animate(O, seconds=0.1, frames=2)._repr_html_()
    assert html.startswith("<video controls") and "data:video/mp4;base64," in html


def test_any_script_is_filmed_as_it_is(tmp_path):
    script = tmp_path / "own.py"
    script.write_text(
        """import sys
from yade.nonsmooth.scene import disk, engines, segments
ground = NscdMat(frictionAngle=0.4, wall=True)
rock = NscdMat(density=2500, frictionAngle=0.4)
O.materials.append([ground, rock])
O.bodies.append(segments([(-2, 0), (2, 0)], ground, sense=1))
O.bodies.append(disk((0, 2.0), 0.5, rock))
O.dt = 5e-3
O.engines = engines(gravity=(0, -9.81, 0)) + [PyRunner(command="count()", iterPeriod=10)]
calls = []
def count():
    calls.append(O.iter)
O.run(100, wait=True)
print("argv", sys.argv[1:], "calls", len(calls))
sys.exit(0)
"""
    )
    done = shell.run(
        "film.py",
        "--out",
        tmp_path / "own.gif",
        "--frames",
        12,
        "--threads",
        1,
        script,
        "--level",
        "3",
        cwd=tmp_path,
        limit=120,
    )
    assert done.returncode == 0, done.stderr
    assert "argv ['--level', '3'] calls 9" in done.stdout and f"video: {tmp_path}/own.gif" in done.stdout
    assert 6 <= Image.open(tmp_path / "own.gif").n_frames <= 13
    refused = shell.run("film.py", "--out", "own.avi", script, cwd=tmp_path, limit=120)
    assert refused.returncode == 1 and refused.stderr.strip().splitlines()[-1].startswith(
        "error: own.avi: a video ends in"
    )


def test_options_of_the_command_reach_the_film(in_process, monkeypatch, tmp_path):
    told = {}

    def write(frames, path, fps, **drawn):
        told.update(times=[t for t, _ in frames], path=path, fps=fps, drawn=drawn)
        return path

    monkeypatch.setattr(moving, "write", write)
    script = tmp_path / "own.py"
    script.write_text(
        """from yade.nonsmooth.scene import disk, engines
rock = NscdMat(density=2500, frictionAngle=0.4)
O.materials.append(rock)
O.bodies.append(disk((0, 2.0), 0.5, rock))
O.dt = 5e-3
O.engines = engines(gravity=(0, -9.81, 0))
O.run(100, wait=True)
"""
    )
    words = ("--out", tmp_path / "own.gif", "--period", 0.1, "--fps", 10, "--no-forces", script)
    done = in_process("film.py", *words)
    assert done.status == 0, done.err
    assert told["times"] == pytest.approx([0, 0.1, 0.2, 0.3, 0.4, 0.5]) and told["fps"] == 10
    assert told["drawn"] == {"forces": False} and told["path"] == tmp_path / "own.gif"
    for bad, said in (
        (("--frames", 1, script), "--frames: 1 is no video"),
        ((tmp_path / "none.py",), "none.py cannot be read"),
    ):
        done = in_process("film.py", *bad)
        assert done.status == 2 and said in done.last


@pytest.mark.parametrize(
    "dt, seconds, options, frames",
    [
        (1e-2, 0.1, {}, 11),  # a frame a step, where there are fewer steps than frames
        (2e-3, 0.1, {}, 51),
        (1e-3, 0.05, {}, 51),
        (1e-3, 0.1, dict(period=1.0), 1),  # what has been reached is added where it is written
        (1e-2, 0.1, dict(period=1e-3), 11),
        (1e-3, 0.5, dict(frames=7), 8),
        (1e-2, 0.1, dict(frames=1), 2),
    ],
)
def test_a_scene_is_run_for_the_seconds_that_were_asked_for(dt, seconds, options, frames):
    falling(dt=dt)
    made = figures.animate(O, seconds=seconds, **options)
    assert O.time == pytest.approx(seconds, abs=0.51 * dt) and len(made.frames) == frames
