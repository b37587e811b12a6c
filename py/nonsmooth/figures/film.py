"""Pictures one after the other, as a film: fixed artists are drawn once, and a file, MP4 by ffmpeg or GIF by Pillow, is
written whole or not at all. Needs no YADE.
"""

from __future__ import annotations

from pathlib import Path

from matplotlib.animation import FFMpegWriter, PillowWriter

from ..records import RecordsError
from ..system import checks
from ..system.whole_files import beside

__all__ = ["Stage", "check", "check_fps", "missing", "named", "write"]

HOLD = 1.5  # seconds for which the last picture stays
KINDS = (".mp4", ".gif")
LEAST_FPS, MOST_FPS = 0.1, 100  # frames a second: the clock of a GIF has hundredths of a second


class Stage:
    """A figure of which most artists stay: those in ``moving`` are drawn anew for each picture, on top of the picture
    of the others.
    """

    def __init__(self, fig, moving=()):
        self.fig, self.moving, self._fixed = fig, list(moving), None

    def set(self):
        """All that stays is on the figure: keeps its picture."""
        shown = [artist.get_visible() for artist in self.moving]
        for artist in self.moving:
            artist.set_visible(False)
        self.fig.canvas.draw()
        self._fixed = self.fig.canvas.copy_from_bbox(self.fig.bbox)
        for artist, was in zip(self.moving, shown):
            artist.set_visible(was)

    def picture(self):
        """The moving artists as they are now, on the others: bytes (RGBA)."""
        self.fig.canvas.restore_region(self._fixed)
        for artist in sorted(self.moving, key=lambda a: a.get_zorder()):
            (artist.axes or self.fig).draw_artist(artist)
        return self.fig.canvas.buffer_rgba()


class _Handed:
    """A writer that is handed finished pictures instead of drawing the figure again for each."""

    @property
    def frame_size(self):
        return self.fig.canvas.get_width_height()


class _Writer(_Handed, FFMpegWriter):
    def add(self, picture):
        self._proc.stdin.write(picture)


class _GifWriter(_Handed, PillowWriter):
    """Keeps pictures with 256 colours, one byte for each pixel; the first, with what stays, gives the colours of all,
    so that none flickers.
    """

    def setup(self, fig, outfile, dpi=None):
        super().setup(fig, outfile, dpi)
        self._kept = []

    def add(self, picture):
        from PIL import Image

        whole = Image.frombuffer("RGBA", self.frame_size, bytes(picture), "raw", "RGBA", 0, 1).convert("RGB")
        none = getattr(Image, "Dither", Image).NONE
        self._kept.append(
            whole.quantize(dither=none) if not self._kept else whole.quantize(palette=self._kept[0], dither=none)
        )

    def finish(self):
        if self._kept:
            first, *others = self._kept
            step = round(1000 / self.fps)
            first.save(
                self.outfile, save_all=True, append_images=others, loop=0,
                duration=[step] * len(others) + [step + round(1000 * HOLD)], format="GIF",
            )  # fmt: skip


def _writer(path, fps):
    if path.suffix.lower() == ".gif":
        return _GifWriter(fps=fps)
    # yuv420p plays everywhere; the last picture stays for a while
    return _Writer(
        fps=fps, codec="h264", bitrate=-1,
        extra_args=["-pix_fmt", "yuv420p", "-crf", "20", "-preset", "veryfast", "-threads", "1",
                    "-vf", f"tpad=stop_mode=clone:stop_duration={HOLD:g}", "-movflags", "+faststart"],
    )  # fmt: skip


def missing():
    """What an MP4 lacks here, in words; None where it can be written."""
    return None if FFMpegWriter.isAvailable() else "ffmpeg is not installed (apt install ffmpeg)"


def named(path):
    """The path of a film. Raises RecordsError for another suffix than .mp4 or .gif."""
    path = Path(checks.path("path", path, RecordsError, f"give the name of a file that ends in {' or '.join(KINDS)}"))
    if path.suffix.lower() not in KINDS:
        raise RecordsError(f"{path}: a video ends in {' or '.join(KINDS)}; give such a name")
    return path


def check(path):
    """The path of a film that can be made, before anything is computed for it. Raises RecordsError as :func:`named`,
    and for an MP4 without ffmpeg.
    """
    path = named(path)
    if path.suffix.lower() == ".mp4" and missing():
        raise RecordsError(f"{path}: {missing()}; install it, or give a name that ends in .gif, which needs none")
    return path


def check_fps(fps):
    """Raises RecordsError for a number of frames a second that no video has."""
    remedy = f"give frames a second, from {LEAST_FPS:g} to {MOST_FPS}"
    checks.number("fps", fps, RecordsError, remedy, least=LEAST_FPS, most=MOST_FPS)


def write(path, fig, pictures, fps):
    """Writes ``pictures``, bytes (RGBA) of a figure's canvas, one for each frame, ``fps`` a second; the file is
    replaced only by a whole one.

    Returns None, or a note why there is no file. What ``pictures`` raises goes on.
    """
    path = Path(path)
    if path.suffix.lower() != ".gif" and missing():
        return f"no video: {missing()}"
    try:
        with beside(path) as part:
            writer = _writer(path, fps)
            with writer.saving(fig, str(part), dpi=fig.dpi):
                for picture in pictures:
                    writer.add(picture)
    except (OSError, RuntimeError) as error:
        return f"no video: ffmpeg failed, or there is no place for it ({error})"
    except Exception as error:  # subprocess.CalledProcessError carries ffmpeg's words
        if isinstance(error, RecordsError) or not hasattr(error, "returncode"):
            raise
        return f"no video: ffmpeg failed ({str(getattr(error, 'stderr', None) or error)[-300:]})"
    return None
