"""What happens at the border of a body in which water seeps: reservoirs, heads, seepage faces, rain. What none of them
names is impervious.

Each condition has a ``line``, a polyline (k, 2) [m], and holds on the border's edges that lie on it. Rain may fall on
the line of any other; of all others no two may share an edge, and where they share a node they must agree.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..model import geometry
from ..system import checks
from .error import WaterError
from .mesh import array

__all__ = ["Applied", "ConditionError", "Head", "Inflow", "PressureHead", "Rain", "Reservoir", "SeepageFace", "apply"]


class ConditionError(WaterError):
    """A condition that lies on no border, contradicts another, or has a value without sense."""


@dataclass(frozen=True, eq=False)
class _Condition:
    line: object  # vertices (k, 2) [m]

    value = None  # name of the attribute that is its number
    least = -np.inf

    def __post_init__(self):
        where = f"{type(self).__name__}: line"
        line = array(where, self.line, 2, ConditionError)
        if len(line) < 2:
            raise ConditionError(f"{where} {checks.shown(self.line)}: give two points or more [m]")
        object.__setattr__(self, "line", line)
        if self.value:
            name, bound = f"{type(self).__name__}: {self.value}", ", 0 or more" * (self.least == 0)
            number = getattr(self, self.value)
            checks.number(name, number, ConditionError, f"give a finite number{bound}", least=self.least)


@dataclass(frozen=True, eq=False)
class Head(_Condition):
    """A hydraulic ``head`` [m] above y = 0 along the line."""

    head: float
    value = "head"


@dataclass(frozen=True, eq=False)
class PressureHead(_Condition):
    """A pressure of the height ``height`` [m] of water along the line, whatever its level: p/γ_w, as of an artesian
    base.
    """

    height: float
    value = "height"


@dataclass(frozen=True, eq=False)
class Reservoir(_Condition):
    """Open water up to y = ``level`` [m] along the line. Where the line rises above it, it is a seepage face.

    Nodes at or below the level have its head, so that the level counts to the length of an edge, but where a node lies
    on it (``points`` of :func:`~nonsmooth.water.mesher.triangulate`).
    """

    level: float
    value = "level"


@dataclass(frozen=True, eq=False)
class SeepageFace(_Condition):
    """Open air: water leaves where its pressure would rise above 0, and none comes in."""


@dataclass(frozen=True, eq=False)
class Inflow(_Condition):
    """Water that comes in with ``rate`` [m/s] along the normal, below 0 where it leaves; the pressure becomes what that
    needs.
    """

    rate: float
    value = "rate"


@dataclass(frozen=True, eq=False)
class Rain(_Condition):
    """Rain of ``rate`` [m/s] per horizontal metre, 0 or more. What the body does not take runs off: the line is a
    seepage face too.
    """

    rate: float
    value, least = "rate", 0


@dataclass(frozen=True)
class Applied:
    """Conditions as a mesh's nodes have them, arrays (n,): ``fixed``: whether the head is given, ``head`` [m], 0
    elsewhere; ``face``: the length [m] of border from which water may leave, 0 for none; ``inflow``: what rain and
    Inflow bring [m²/s]. ``heaviest``: the largest rate [m/s] of these.
    """

    fixed: np.ndarray
    head: np.ndarray
    face: np.ndarray
    inflow: np.ndarray
    heaviest: float


def apply(mesh, conditions) -> Applied:
    """The ``conditions`` at the nodes of a :class:`~nonsmooth.water.mesh.Mesh`.

    Raises ConditionError for what is no condition, for a line on no edge of the border, for two conditions on one edge
    or with two heads at one node, and where no condition lets the head be known.
    """
    count, border = len(mesh.nodes), mesh.border
    fixed, head, face, inflow = np.zeros(count, bool), np.zeros(count), np.zeros(count), np.zeros(count)
    owner, rained = np.full(len(border), -1), np.full(len(border), -1)
    open_air = np.zeros(len(border), bool)
    if not isinstance(conditions, (list, tuple)):
        raise ConditionError(
            f"conditions {checks.shown(conditions)}: give a list of Reservoir, Head, SeepageFace, Rain, …"
        )
    y = mesh.nodes[:, 1]
    along = np.diff(mesh.nodes[border], axis=1)[:, 0]
    length = geometry.distance(*along.T)
    for k, one in enumerate(conditions):
        if not isinstance(one, _Condition):
            raise ConditionError(f"conditions[{k}] {checks.shown(one)}: give Reservoir, Head, SeepageFace, Rain, …")
        edges = mesh.border_on(one.line)
        told = f"conditions[{k}], {type(one).__name__}"
        if not len(edges):
            a, b = one.line[0], one.line[-1]
            raise ConditionError(
                f"{told}: no edge of the border lies on its line from ({a[0]:.6g}, {a[1]:.6g}) to "
                f"({b[0]:.6g}, {b[1]:.6g}) m; give a line along the border"
            )
        taken = rained if isinstance(one, Rain) else owner
        twice = edges[taken[edges] >= 0]
        if len(twice):
            x, at = mesh.nodes[border[twice[0]]].mean(axis=0)
            raise ConditionError(
                f"{told}: conditions[{taken[twice[0]]}] lies on the border at ({x:.6g}, {at:.6g}) m too; "
                "give lines that share no edge"
            )
        taken[edges] = k
        nodes = np.unique(border[edges])
        if isinstance(one, (Inflow, Rain)):
            through = one.rate * (length[edges] if isinstance(one, Inflow) else np.maximum(-along[edges, 0], 0))
            np.add.at(inflow, border[edges], 0.5 * through[:, None])  # in the order of edges: the same bits
        if isinstance(one, (Reservoir, SeepageFace, Rain)):
            open_air[edges] = True
        if isinstance(one, Reservoir):
            nodes = nodes[y[nodes] <= one.level + mesh.tolerance]
        values = {
            Head: lambda: np.full(len(nodes), float(one.head)),
            Reservoir: lambda: np.full(len(nodes), float(one.level)),
            PressureHead: lambda: y[nodes] + one.height,
        }
        if type(one) in values:
            given = values[type(one)]()
            other = nodes[fixed[nodes] & (np.abs(head[nodes] - given) > mesh.tolerance)]
            if len(other):
                x, at = mesh.nodes[other[0]]
                raise ConditionError(
                    f"{told}: the node at ({x:.6g}, {at:.6g}) m has the head {head[other[0]]:.6g} m already; "
                    "give lines with one head where they meet"
                )
            fixed[nodes], head[nodes] = True, given
    np.add.at(face, border[open_air], 0.5 * length[open_air, None])
    if not fixed.any() and not face.any():
        raise ConditionError("conditions give no head anywhere: add a Reservoir, a Head or a SeepageFace")
    rates = [one.rate for one in conditions if isinstance(one, (Inflow, Rain))]
    return Applied(fixed, head, np.where(fixed, 0.0, face), inflow, max(rates, default=0.0))
