"""What changes a slope's load by the clock, in s since t0: earthquakes (:mod:`.shaking`) and windows that take disks out
of it (:mod:`.erosion`). Needs no YADE.

Triggers act alone or together, and follow each other as their times say. A slope whose triggers are not all over is not
at rest for good, however still it stands, and its run goes on. None acts before t0, nor on a slope that had failed by
then, by its dry weight. The water table is not among them: it also stops where the slope moves
(:func:`.slope.water_table`).

Each kind is a module with two functions of a State, of what a row sees of the slope, and of the Section:

* ``over(state, seen, section)``: whether it neither acts nor may any more;
* ``acting(state, seen, section)``: whether it acts.

A new kind is such a module, and a name in :data:`KINDS`.
"""

from . import erosion, shaking

__all__ = ["KINDS", "acting", "over"]

KINDS = (shaking, erosion)


def over(state, seen, section) -> bool:
    """Whether no trigger acts on a slope, or may any more; ``state``: a State, ``seen``: a Seen."""
    return all(kind.over(state, seen, section) for kind in KINDS)


def acting(state, seen, section) -> bool:
    """Whether a trigger acts on it."""
    return any(kind.acting(state, seen, section) for kind in KINDS)
