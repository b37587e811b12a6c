"""Courses of spheres that Ctrl-C ends, and their records without what a clock wrote."""
import pytest
from yade import O
from yade.nonsmooth.running import interrupts


def halt(monkeypatch, course, rows, said, run, *arguments, **named):
    """run(...), in which Ctrl-C comes in the row of this number of a ``course``, a class; ``said``: pattern of the message."""
    real, left = course._look, [rows]

    def look(self, made):
        real(self, made)
        left[0] -= 1
        if left[0] == 0:
            self._stop()

    with monkeypatch.context() as patched:
        patched.setattr(course, "_look", look)
        with pytest.raises(interrupts.Interrupted, match=said):
            run(*arguments, **named)
    O.reset()


def without_wall(path):
    """Lines of a series without their last column, the wall time."""
    return [line.rsplit(",", 1)[0] for line in path.read_text().splitlines()]
