"""The driver of every course: it makes the steps up to a row, lets the study look at them, keeps checkpoints, and hears
Ctrl-C where the records are whole.

A study is a :class:`Course`: it says how the steps of a row are made, what a row sees and writes, and when the course
is over. Nothing here depends on wall time but when checkpoints are written, which no result shows.
"""

from __future__ import annotations

import time

from ..running import interrupts

__all__ = ["Course", "drive"]

CHECKPOINT_SECONDS = 90  # of wall time between two checkpoints, at least ...
CHECKPOINT_SHARE = 0.02  # ... and so many that they take this part of it at most


class Course:
    """What a study gives the driver. ``files``: the SeriesWriters that a row goes into; ``spent``: a mapping whose
    ``wall_s`` and ``wall_steps_s`` [s] grow, of all that is done and of the steps alone.

    A study defines ``_over``, ``_steps`` and ``_look``, and where it has checkpoints ``_save`` and ``_where``. Steps
    leave O.bodies and O.interactions behind (``advance(..., view=False)``); both are up to date when :func:`drive`
    ends, by an error too.
    """

    #: What has no checkpoints, in words, as "a slope of soft contacts"; None where there are some.
    unsaved = None

    def __init__(self, *files, spent=None):
        self.files, self.spent = files, {"wall_s": 0.0, "wall_steps_s": 0.0} if spent is None else spent
        self._clock = self._saved = time.monotonic()
        self._saving = 0.0

    # ---- the study's ----------------------------------------------------------------------------
    def _over(self) -> bool:
        """Whether no row comes any more."""
        raise NotImplementedError

    def _steps(self):
        """Makes the steps up to the next row, and nothing else; returns what ``_look`` wants to know of them."""
        raise NotImplementedError

    def _look(self, made):
        """Writes a row of the scene as it is, decides, tells how far the course is; ``made``: what ``_steps``
        returned.
        """
        raise NotImplementedError

    def _where(self) -> str:
        """Where the course is, in words, as "at 2.5 s of simulated time"."""
        return "before its end"

    def _count(self, simulated, seconds):
        """Adds what the steps of a row simulated, and took [s]."""
        self.spent["wall_steps_s"] += seconds

    def _spend(self, seconds):
        """Adds wall time, of all that is done [s]."""
        self.spent["wall_s"] += seconds

    def _save(self):
        """Writes the checkpoint; the rows are on the disk."""

    def _finish(self):
        """What comes after the last row."""

    # ---- the driver's ---------------------------------------------------------------------------
    def _pass_row(self, made, simulated, seconds):
        """The steps of a row have been made, by whomever: see ``_steps``, ``_count``."""
        self._count(simulated, seconds)
        self._look(made)
        if time.monotonic() - self._saved > max(CHECKPOINT_SECONDS, self._saving / CHECKPOINT_SHARE):
            self.checkpoint()

    def checkpoint(self):
        """Saves all that a resume needs; an earlier checkpoint is there until the new one is whole."""
        now = self._tick()
        for file in self.files:
            file.sync()
        self._save()
        self._saved = time.monotonic()
        self._saving = self._saved - now

    def _tick(self):
        """Adds the wall time since the last call, see ``_spend``; returns what the clock says [s]."""
        now = time.monotonic()
        self._spend(now - self._clock)
        self._clock = now
        return now

    def _open(self):
        """Files that an earlier part of the run has closed take rows again; the time since then is not the run's."""
        if any(file.closed for file in self.files):
            self._clock = time.monotonic()
        for file in self.files:
            file.reopen()

    def _close(self):
        """The files take no rows until ``_open``."""
        for file in self.files:
            file.close()

    def _stop(self):
        self.checkpoint()
        self._close()
        kept = (
            "the checkpoint is written, go on with --resume"
            if self.unsaved is None
            else f"{self.unsaved} has no checkpoint, run it again"
        )
        raise interrupts.Interrupted(f"{self._where()}; {kept}")


def drive(course):
    """Goes through a Course to its end. Ctrl-C ends it after the next row, with a checkpoint where it has some, by
    raising interrupts.Interrupted; it can then go on, as after an error.
    """
    from yade import O
    from yade.wrapper import ContactDynamicsEngine

    course._open()
    with interrupts.noted() as interrupted:
        try:
            while not course._over():
                first, began = O.time, time.perf_counter()
                made = course._steps()
                course._pass_row(made, O.time - first, time.perf_counter() - began)
                if interrupted():
                    course._stop()
            course._finish()
            course._close()
        finally:
            ContactDynamicsEngine().view()  # the scene's, whoever asks
