"""Steady seepage with a free surface: Darcy's law on linear triangles (doc/theory/seepage).

The head h solves div(k_r K grad h) = 0. A triangle conducts as the share of its area that lies below the free surface,
where p > 0, and :data:`DRY` of the rest: the mesh stays, and the free surface is found in it. Water leaves a seepage
face by a one-way law, κ max(h − y, 0), with a κ so large that h = y there.

Newton's method solves it, with the share's exact derivative. It begins with a body that conducts as well where it is
dry, which needs no free surface, and lets this conductivity fall by steps (:data:`DROP`), each from the solution
before; a step that does not converge is halved. Where water falls through dry ground, as below a seam of clay, it may
not converge; then all is done again with dry ground that conducts more downwards (:data:`FALLING`). A last step is
solved until the equations hold to rounding, so that what comes in is what leaves.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..model import geometry
from ..system import checks
from . import phreatic
from .conditions import apply
from .equations import TRIED, Equations
from .error import WaterError
from .mesh import Mesh

__all__ = ["DRY", "Seepage", "SeepageError", "Unconverged", "course", "solve", "tensor", "tensors"]

DRY = 1e-3  # conductivity of what lies above the free surface, by that below it
DROP = 0.5  # decades by which it falls in a step of the way there ...
SHORTEST = 1e-3  # ... and the smallest, before it is given up
FALLING = 0.1  # of the conductivity: what dry ground conducts downwards where nothing converges with less


class SeepageError(WaterError):
    """Seepage that cannot be computed: a conductivity without sense, or conditions that do not hold together."""


class Unconverged(SeepageError):
    """The iteration has not come to its end: ``residual`` (of a node's balance, by the flow through the body), and
    ``iterations``.
    """

    def __init__(self, message, residual, iterations):
        super().__init__(message)
        self.residual, self.iterations = residual, iterations


@dataclass(frozen=True, eq=False)
class Seepage:
    """Seepage in a body.

    ``head``: h [m] at the nodes, (n,); ``wet``: the share of each triangle that lies below the free surface, (m,);
    ``flux``: Darcy's flux [m/s] in each, (m, 2); ``exchanged``: what comes in [m²/s] at each node through reservoirs,
    heads and seepage faces, below 0 where it leaves, (n,); ``given``: the same of rain and Inflow; ``iterations``, and
    the ``residual``: the largest misfit of a node's balance, by the flow through the body.
    """

    mesh: Mesh
    head: np.ndarray
    wet: np.ndarray
    flux: np.ndarray
    exchanged: np.ndarray
    given: np.ndarray
    iterations: int
    residual: float

    @property
    def pressure_head(self) -> np.ndarray:
        """h − y = p/γ_w [m] at the nodes, (n,); below 0 above the free surface."""
        return self.head - self.mesh.nodes[:, 1]

    def pressure(self, unit_weight) -> np.ndarray:
        """Pore pressure [Pa] at the nodes, (n,), 0 above the free surface: suction is left out. ``unit_weight``: γ_w
        [N/m³].
        """
        return np.maximum(unit_weight * self.pressure_head, 0.0)

    def inflow_on(self, line) -> float:
        """What comes in through reservoirs, heads and seepage faces on a part of the border, a polyline (k, 2) [m], in
        m²/s, below 0 where it leaves: the sum of all nodes on it, ends included. Rain that runs off counts as leaving.

        Raises SeepageError for a line on no edge of the border.
        """
        edges = self.mesh.border_on(line)
        if not len(edges):
            raise SeepageError(f"line {checks.shown(line)}: lies on no edge of the border; give a line along it")
        return math.fsum(self.exchanged[np.unique(self.mesh.border[edges])].tolist())

    @property
    def through(self) -> float:
        """All that comes in [m²/s], which is all that leaves."""
        return math.fsum(np.maximum((self.exchanged, self.given), 0).ravel().tolist())

    def discharge(self, line) -> float:
        """What flows across a polyline (k, 2) [m] from its left to its right, in m²/s: the integral of the flux, to the
        accuracy of the mesh. What lies outside the body carries nothing.
        """
        flux, total = self.flux, []
        for a, b in zip(*geometry.pieces([line])):
            share, where = phreatic.crossed(self.mesh, a, b)
            right = np.array([b[1] - a[1], a[0] - b[0]])
            total += (share * (flux[where] @ right)).tolist()
        return math.fsum(total)

    def phreatic_line(self) -> list[np.ndarray]:
        """The free surface, where p = 0: polylines (k, 2) [m], the longest first, each from left to right."""
        return phreatic.lines(self.mesh, self.pressure_head)

    def exit_point(self, line) -> tuple[float, float] | None:
        """The highest place (x, y) [m] at which water leaves through a seepage face, a polyline (k, 2) [m]; None where
        none leaves.
        """
        if np.ptp(self.head) <= 1e-3 * self.mesh.tolerance:  # still water, but for rounding
            return None
        nodes = np.unique(self.mesh.border[self.mesh.border_on(line)])
        out = nodes[self.exchanged[nodes] < -1e-9 * self.through]
        return tuple(self.mesh.nodes[out[np.argmax(self.mesh.nodes[out, 1])]].tolist()) if len(out) else None


def tensor(along, across, dip=0.0) -> np.ndarray:
    """The conductivity (2, 2) [m/s] of ground that conducts ``along`` [m/s] in the direction of its bedding and
    ``across`` [m/s] it; ``dip``: of the bedding [degrees], positive down to the right.

    Raises SeepageError for conductivities that are not above 0.
    """
    for name, value in (("along", along), ("across", across)):
        checks.number(name, value, SeepageError, "give a conductivity above 0 [m/s]", above=0)
    angle = math.radians(checks.number("dip", dip, SeepageError, "give degrees, positive down to the right"))
    way, normal = np.array([math.cos(angle), -math.sin(angle)]), np.array([math.sin(angle), math.cos(angle)])
    return along * np.outer(way, way) + across * np.outer(normal, normal)


def solve(mesh, conductivity, conditions, *, dry=DRY, start=None, tolerance=1e-9) -> Seepage:
    """Steady seepage in a :class:`~nonsmooth.water.mesh.Mesh` under :mod:`~nonsmooth.water.conditions`.

    ``conductivity`` [m/s]: a number or a :func:`tensor` for all, a list of these with one for each layer, or an array
    (m, 2, 2); ``dry``: see :data:`DRY`; ``start``: heads (n,) [m] from which the iteration begins, as of a state that
    is near (then the way by steps is tried only where that does not converge); ``tolerance``: of a node's balance, by
    the flow through the body, and of the head's last change, by the body's size.

    Raises SeepageError for a conductivity that is not positive, ConditionError for conditions, and Unconverged.
    """
    if not isinstance(mesh, Mesh):
        raise SeepageError(
            f"mesh {checks.shown(mesh)}: give a Mesh, as mesher.of_section(...) and mesh.grid(...) make one"
        )
    dry = checks.number("dry", dry, SeepageError, "give a share above 0 and up to 1", above=0, most=1)
    tolerance = checks.number("tolerance", tolerance, SeepageError, "give 1e-12 to 1e-3", least=1e-12, most=1e-3)
    problem = Equations(mesh, tensors(conductivity, mesh), apply(mesh, conditions))
    if start is not None:
        head = np.array(start, float)
        if head.shape != problem.y.shape or not np.isfinite(head).all():
            raise SeepageError(
                f"start of shape {head.shape}: give a finite head for each of {len(problem.y)} nodes [m]"
            )
        found = problem.newton(problem.with_given(head), dry, tolerance)
        if found:
            return _result(problem, *found, dry)
    try:
        return _result(problem, *_by_steps(problem, dry, tolerance), dry)
    except Unconverged:
        if problem.downwards >= FALLING:
            raise
    problem.downwards = FALLING
    return _result(problem, *_by_steps(problem, dry, tolerance), dry)


def course(mesh, conductivity, states, **options) -> list[Seepage]:
    """The steady states of a course, as of a reservoir that is drawn down slowly: one :class:`Seepage` for each list of
    conditions in ``states``, each computed from the one before. ``options``: as of :func:`solve`.

    Nothing is stored in the pores: what lies behind a state is forgotten. A drawdown that is fast against k/n is none
    of these.
    """
    found = []
    for conditions in states:
        found.append(solve(mesh, conductivity, conditions, start=found[-1].head if found else None, **options))
    return found


def _by_steps(problem, dry, tolerance):
    """Head and iterations; the conductivity of dry ground falls from 1 to ``dry``."""
    level, drop, total = 1.0, DROP, 0
    head = problem.with_given(np.full(len(problem.y), problem.highest))
    reached = False
    while True:
        aim = level if not reached else max(dry, level * 10.0**-drop)
        last = aim <= dry
        found = problem.newton(head, aim, tolerance if last else None)
        if found:
            head, level, reached = found[0], aim, True
            total, drop = total + found[1], min(DROP, 2 * drop)
            if last:
                return head, total
            continue
        total, drop = total + TRIED, drop / 2
        if drop < SHORTEST or not reached:
            residual = problem.residual(head, dry)
            raise Unconverged(
                f"the seepage did not converge: after {total} iterations a node's balance is off by {residual:.1e} of "
                f"the flow, with dry ground at {level:.2g} of the conductivity; give a finer mesh where water leaves, "
                f"or a larger dry share (dry={dry:g})",
                residual,
                total,
            )


def _result(problem, head, iterations, dry):
    balance, wet, _, _ = problem.parts(head, dry)
    out = -problem.open * np.maximum(head - problem.y, 0)
    rise = problem.mesh.gradient(head)
    flux = -(dry + (1 - dry) * wet)[:, None] * np.einsum("mij,mj->mi", problem.conductivity, rise)
    flux[:, 1] -= problem.passing(dry) * (1 - wet) * problem.conductivity[:, 1, 1] * rise[:, 1]
    exchanged = np.where(problem.applied.fixed, balance, out)
    return Seepage(
        problem.mesh, head, wet, flux, exchanged, problem.applied.inflow, iterations, problem.residual(head, dry)
    )


def tensors(conductivity, mesh):
    """Conductivities (m, 2, 2) [m/s] of the triangles of a mesh, of what :func:`solve` takes."""
    count = len(mesh.triangles)
    layers = int(mesh.layer.max()) + 1

    def told(k):
        return f"conductivity of layer {k}" + (f" ({mesh.names[k]})" if k < len(mesh.names) else "")

    if not isinstance(conductivity, (list, tuple)):
        every = np.ndim(conductivity) == 3
        return np.broadcast_to(_tensor("conductivity", conductivity, count if every else 1), (count, 2, 2))
    if len(conductivity) != layers:
        raise SeepageError(
            f"conductivity has {len(conductivity)} entries: give one number or tensor [m/s], or one for each of "
            f"{layers} layers"
        )
    return np.array([_tensor(told(k), one)[0] for k, one in enumerate(conductivity)])[mesh.layer]


def _tensor(name, value, count=1):
    """Conductivities (count, 2, 2), checked to be symmetric and positive."""
    try:
        found = np.asarray(value, float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.ndim == 0:
        found = found * np.eye(2)
    found = found.reshape(-1, 2, 2) if found.size == 4 * count else np.full((1, 2, 2), np.nan)
    good = np.isfinite(found).all() and np.allclose(found, found.swapaxes(1, 2), rtol=1e-9, atol=0)
    if not good or np.linalg.eigvalsh(found).min() <= 0:
        raise SeepageError(
            f"{name} {checks.shown(value)}: give a number above 0 [m/s], or a tensor of seepage.tensor(...)"
        )
    return found
