"""Steps by O.run(), O.step(), the viewer and yade-batch go through a slope's course: a CourseRunner does between steps
what Experiment.run() does.

The engine of the scene holds the Experiment, as its attribute ``course``, so that each scene knows its own; one that is
loaded has an engine without.
"""

from __future__ import annotations

import time

from yade import O
from yade.wrapper import CourseRunner

from .error import ExperimentError

__all__ = ["attach", "come_to", "detach", "others", "row"]


def come_to(end):
    """Whether less than half a step is missing to the time ``end`` [s]."""
    return not O.time < end - 0.5 * O.dt


def others():
    """The scene's engines but for a CourseRunner."""
    return [e for e in O.engines if not isinstance(e, CourseRunner)]


def attach(course, command):
    """Makes a CourseRunner, through which the rows of an Experiment come, the first of O.engines; returns it.
    ``command``: Python that calls :func:`row`.
    """
    runner = CourseRunner(label="slopeCourse", command=command)
    runner.course = course
    O.engines = [runner, *others()]
    _wait(runner)
    return runner


def detach(course):
    """Takes the engine of an Experiment out again, where there is one; the row that it would have written as the next
    step begins is written now.
    """
    runner = next((e for e in O.engines if getattr(e, "course", None) is course), None)
    if runner is not None:
        if not runner.dead and come_to(runner.nextTime):
            _row_came(runner)
        O.engines = others()


def row():
    """What the engine calls. Raises ExperimentError where it has no Experiment, as after O.load()."""
    runner = next((e for e in O.engines if isinstance(e, CourseRunner) and hasattr(e, "course")), None)
    if runner is None:
        raise ExperimentError(
            "this process does not know the stages of this slope, as the scene was loaded without its run: continue "
            "with experiment.resume(section, folder).attach()"
        )
    _row_came(runner)


def _row_came(runner):
    """The steps up to a row have been made."""
    number, first, began = runner.waiting
    runner.course.row_came(number, O.time - first, time.perf_counter() - began)
    _wait(runner)
    if runner.dead:
        O.pause()


def _wait(runner):
    """For the next row, or, where the course is over, for none."""
    course = runner.course
    number = course.next_row()
    runner.waiting = number, O.time, time.perf_counter()
    runner.nextTime = number * course.scales.row_seconds
    runner.dead = course.reached()
