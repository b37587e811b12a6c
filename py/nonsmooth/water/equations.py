"""The equations of steady seepage on linear triangles: each node's balance, its derivative, and Newton's steps."""

from __future__ import annotations

import math

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from . import phreatic

__all__ = ["TRIED", "Equations"]

TRIED = 25  # iterations at one conductivity of dry ground; those that end need 2 to 10
ROUGH = 1e-3  # of the body's size: change of the head at which a step on the way is ended
OPEN = 1e4  # κ of a seepage face times the length of its edges, by the conductivity behind it
PASSING = 4.0  # times the heaviest rain is what dry ground conducts downwards, at least
HALVINGS = 6  # of Newton's step, before one with the conductivity as it is (Picard's) takes its place


class Equations:
    """The equations of a mesh, of conductivities (m, 2, 2) and of :class:`~nonsmooth.water.conditions.Applied`.

    ``dry``: the conductivity of dry ground by that of wet. Where it rains, dry ground conducts more downwards than
    that, since rain falls through it to the free surface.
    """

    def __init__(self, mesh, conductivity, applied):
        self.mesh, self.conductivity, self.applied = mesh, conductivity, applied
        self.y, self.triangles = mesh.nodes[:, 1], mesh.triangles
        g = mesh.shape_gradients
        self.stiffness = mesh.area[:, None, None] * np.einsum("mia,mab,mjb->mij", g, conductivity, g)
        self.down = (mesh.area * conductivity[:, 1, 1])[:, None, None] * g[:, :, None, 1] * g[:, None, :, 1]
        # with a gradient below 1, or the pressure would rise above the free surface
        self.downwards = min(1.0, PASSING * applied.heaviest / float(conductivity[:, 1, 1].min()))
        self.rows = np.repeat(self.triangles, 3, axis=1).ravel()
        self.columns = np.tile(self.triangles, (1, 3)).ravel()
        self.free = np.flatnonzero(~applied.fixed)
        self.size = math.dist(mesh.bounds[:2], mesh.bounds[2:])
        # of the face: what conducts best behind each node, by the length of an edge there
        best = np.zeros(len(self.y))
        np.maximum.at(best, self.triangles, np.linalg.eigvalsh(conductivity)[:, -1:])
        self.open = OPEN * best * (applied.face > 0)
        self.highest = max(
            applied.head[applied.fixed].max(initial=-np.inf), self.y[applied.face > 0].max(initial=-np.inf)
        )

    def with_given(self, head):
        """Heads (n,) with those that conditions give in their places."""
        return np.where(self.applied.fixed, self.applied.head, head)

    def parts(self, head, dry):
        """Balance of each node [m²/s], (n,); wet share of the triangles, (m,), and its derivative by their three heads,
        (m, 3); the derivative by it of what flows into the body at their corners, (m, 3).
        """
        wet, change = phreatic.wet_share((head - self.y)[self.triangles])
        at = head[self.triangles]
        every = np.einsum("mij,mj->mi", self.stiffness, at)
        down = self.passing(dry) * np.einsum("mij,mj->mi", self.down, at)
        into = (dry + (1 - dry) * wet)[:, None] * every + (1 - wet)[:, None] * down
        balance = np.bincount(self.triangles.ravel(), into.ravel(), len(self.y))
        balance += self.open * np.maximum(head - self.y, 0) - self.applied.inflow
        return balance, wet, change, (1 - dry) * every - down

    def passing(self, dry):
        """What dry ground conducts downwards more than sideways, by its conductivity."""
        return max(self.downwards - dry, 0.0)

    def misfit(self, head, dry):
        """The norm of all balances, infinite where a head is none."""
        found = float(np.linalg.norm(self.parts(head, dry)[0][self.free]))
        return found if math.isfinite(found) else math.inf

    def flow(self, head, dry):
        """What flows through the body [m²/s]: half of what comes in and goes out at its border."""
        balance, _, _, _ = self.parts(head, dry)
        out = self.open * np.maximum(head - self.y, 0)
        return 0.5 * float(np.where(self.applied.fixed, np.abs(balance), np.abs(self.applied.inflow) + out).sum())

    def residual(self, head, dry):
        """The largest misfit of a node's balance, by the flow; where nothing flows, by what a gradient of 1e-9 would
        carry.
        """
        worst = float(np.abs(self.parts(head, dry)[0][self.free]).max(initial=0.0))
        return worst / max(self.flow(head, dry), 1e-9 * float(np.abs(self.conductivity).max()) * self.size)

    def step(self, parts, head, dry, newton):
        """Change of the head, of Newton's method or, without the wet share's derivative, of Picard's."""
        balance, wet, change, by_wet = parts
        entries = (dry + (1 - dry) * wet)[:, None, None] * self.stiffness
        if self.passing(dry):
            entries = entries + (self.passing(dry) * (1 - wet))[:, None, None] * self.down
        if newton:
            entries = entries + by_wet[:, :, None] * change[:, None, :]
        shape = (len(self.y), len(self.y))
        matrix = sparse.coo_matrix((entries.ravel(), (self.rows, self.columns)), shape).tocsr()
        matrix = (matrix + sparse.diags(self.open * (head > self.y))).tocsr()[self.free][:, self.free]
        found = np.zeros(len(self.y))
        found[self.free] = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A").solve(-balance[self.free])
        return found

    def newton(self, head, dry, tolerance):
        """Head and number of iterations at one conductivity of dry ground; None where :data:`TRIED` are too few.
        ``tolerance``: None where a rough solution will do.
        """
        for k in range(TRIED):
            parts = self.parts(head, dry)
            before = float(np.linalg.norm(parts[0][self.free]))
            try:
                step, damping = self.step(parts, head, dry, True), 1.0
            except RuntimeError:  # the matrix is singular
                return None
            small = float(np.abs(step).max(initial=0.0)) <= (tolerance or ROUGH) * self.size
            for _ in range(HALVINGS):
                if self.misfit(head + damping * step, dry) < (1 - 0.1 * damping) * before:
                    break
                damping /= 2
            else:
                if small:  # what is left is rounding, which no step makes less
                    return head, k
                step, damping = self.step(parts, head, dry, False), 0.5
            head = head + damping * step
            if small and damping == 1.0 and (not tolerance or self.residual(head, dry) <= tolerance):
                return head, k + 1
        return None
