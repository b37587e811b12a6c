"""What a process of a campaign does: one search for a factor of safety, from the packing on, or from its checkpoint. In
YADE.
"""

from __future__ import annotations

from ...model import section
from ...model.section import similar
from ...running import kept_runs
from . import search
from .asked import Asked

__all__ = ["run"]


def run(folder, data, quantities, materials, world, numbers, figures=True, like=None):
    """Searches the factor of safety of the section of the plain ``data`` in the folder, and returns the summary; the
    other arguments are fields of :class:`.asked.Asked`. ``figures``: draw them too; ``like``: see
    :func:`.slope.slope_run.run`.
    """
    made = section.of(data, str(folder))
    if like:
        made = similar.with_disks_of(made, section.of(like["data"], str(folder)), like["factor"])
    asked = Asked(made, quantities, materials, world, numbers)
    note = kept_runs.Progress(folder)
    summary = search.run(asked, folder, progress=lambda share, doing: note(share))
    if figures:
        from . import pictures  # brings matplotlib, which a run that draws nothing need not wait for

        pictures.draw(folder, made, summary)
    return summary
