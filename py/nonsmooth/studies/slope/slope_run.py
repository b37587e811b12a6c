"""What a process of a campaign does: one slope, from its packing to its rest, or from its checkpoint on. In YADE."""

from __future__ import annotations

from ...model import section
from ...model.section import similar
from ...records import checkpoints
from ...running import kept_runs
from . import experiment

__all__ = ["run"]


def run(folder, data, end=None, figures=False, like=None):
    """Runs the section of the plain ``data`` in the folder until it is over, or to ``end`` [s] of simulated time, and
    returns its summary; see experiment.begin.

    ``like``: where it is packed as another one, ``data`` of that and the ``factor`` by which it is larger.
    """
    made = section.of(data, str(folder))
    if like:
        made = similar.with_disks_of(made, section.of(like["data"], str(folder)), like["factor"])
    note = kept_runs.Progress(folder)
    start = experiment.resume if checkpoints.exists(folder) else experiment.begin
    course = start(made, folder, progress=lambda stage, now, foreseen: note(now / max(foreseen, now)))
    if not course.reached(end):  # else it was killed after its last checkpoint
        course.run(end=end, stands=True)
    summary = course.summarise(threads=1)
    if figures:
        course.draw()
    return summary
