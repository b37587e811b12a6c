"""Forces on a section's walls and the slip along them: a row for each wall in ``walls.csv``, and sums by the walls' roles."""

from __future__ import annotations

from typing import NamedTuple

from yade import O

from . import records, roles
from .wall_forces import WallForces

__all__ = ["Slip", "WallSeries"]


class Slip(NamedTuple):
    """``mean`` [m] of the disks that ``touched`` walls, how many of them are ``weakened``; whether slip ``counts`` there."""

    mean: float
    weakened: int
    touched: int
    counts: bool


class WallSeries:
    """Of a built :class:`~nonsmooth.slope.Slope`; ``path``: the file; ``period``: see :class:`.wall_forces.WallForces`; ``mark``: of a checkpoint."""

    def __init__(self, slope, path, period, mark=None):
        self._slope, self._side = slope, slope.section.side
        self._of_role = {role: [wall.name for wall in slope.section.of_role(role)] for role in roles.ROLES}
        # a role that several walls share has a sum, and a peak, of its own
        shared = {(role,): [i for name in names for i in slope.walls[name]] for role, names in self._of_role.items() if len(names) > 1}
        self._forces = WallForces({**slope.walls, **shared}, period)
        self.file = records.SeriesWriter(path, tuple(records.WALL_COLUMNS), resume_from=mark, overwrite=True)

    def forget(self):
        """Begins anew."""
        self._forces.forget()

    def take(self):
        """Writes the rows of the time since the last call. Returns {role: (normal force, shear force where walls hold the mass back, peak of the normal force)}
        [N/m], zero where no wall has that role."""
        forces = {name: (normal, self._side * shear, peak) for name, (normal, shear, peak) in self._forces.take().items()}
        self.file.write(*(self._row(name, *forces[name]) for name in self._slope.walls))
        return {role: forces[names[0] if len(names) == 1 else (role,)] if names else (0.0, 0.0, 0.0) for role, names in self._of_role.items()}

    def slip(self, role="slip"):
        """The Slip of disks along the walls of a role."""
        return self._slip(self._of_role[role])

    def _slip(self, names):
        weak = [m for m in map(self._slope.wall_material, names) if hasattr(m, "meanSlip")]
        counts = [m.slippedCount() for m in weak]
        touched = sum(counts)
        mean = weak[0].meanSlip() if len(weak) == 1 else sum(m.meanSlip() * n for m, n in zip(weak, counts)) / touched if touched else 0.0
        return Slip(mean, sum(m.weakenedCount() for m in weak), touched, bool(weak))

    def _row(self, name, normal, shear, peak):
        mean, weakened, touched, counts = self._slip([name])
        slip = (mean, weakened, weakened / touched if touched else 0.0) if counts else (None, None, None)
        return dict(zip(records.WALL_COLUMNS, (O.iter, O.time, name, normal, shear, peak, *slip), strict=True))
