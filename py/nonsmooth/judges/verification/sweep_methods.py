"""Ways to solve a contact problem, in NumPy, to be compared by their work: prototypes, and an oracle for the solver in
C++.

Each method is a generator: ``method(sweeps, p, v)`` begins with impulses ``p`` (c, 3) and the velocities ``v`` (b, 3)
that belong to them, and yields ``(work, p, v)`` after every iteration. Work is counted in sweeps, that is in visits of
every contact: about 100 floating-point operations each.

Sources: projected Gauss-Seidel and over-relaxation, Jean (1999); extrapolation with restarts, Nesterov (1983),
O'Donoghue and Candès (2015); a gradient of all contacts at once with Nesterov's extrapolation, Mazhar et al. (2015);
conjugate gradients on Gauss-Seidel, Silcowitz, Niebe and Erleben (2010); Anderson's extrapolation, Walker and Ni
(2011); alternating directions (ADMM), Boyd et al. (2011).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import splu

__all__ = ["METHODS", "Sweeps", "run"]

FLOPS = 100  # of one visit, see above
LOOK = 10  # sweeps between two looks at the residual
PATIENCE = 40  # sweeps between those that a restart compares, at most


class Sweeps:
    """A :class:`~nonsmooth.contact.ContactProblem` laid out for sweeps over colours: contacts of one colour share no
    body that moves.

    ``rows``: H of the contacts' rows n, t, r on bodies i and j, shape (2, 3, c, 3); ``inverse``: 1/W_kk of the rows,
    (c, 3).
    """

    def __init__(self, problem):
        self.problem, c = problem, len(problem.normal)
        self.i, self.j = problem.body.T
        (nx, ny), lever = problem.normal.T, problem.lever.T
        one, none = np.ones(c), np.zeros(c)

        def side(n, t):
            return np.array(
                [np.column_stack([nx, ny, n]), np.column_stack([-ny, nx, t]), np.column_stack([none, none, one])]
            )

        self.rows = np.array([-side(lever[0], lever[1]), side(lever[2], lever[3])])
        mass = problem.inverse_mass
        self.pushes = np.array([self.rows[0] * mass[self.i], self.rows[1] * mass[self.j]])
        delassus = (self.rows * self.pushes).sum(axis=(0, 3)).T
        safe = np.where(delassus > 0, delassus, 1)
        first = np.where(delassus[:, 0] > 0, 1 / safe[:, 0], 0)
        fallback = np.column_stack([np.zeros(c), first, first * problem.length**2])
        self.inverse = np.where(delassus > 0, 1 / safe, fallback)
        self.units = np.column_stack([one, one, 1 / problem.length])  # torques as forces
        self.colours = self._colours()

    def _colours(self):
        moves = self.problem.inverse_mass.any(axis=1)
        used = [0] * len(moves)
        found = []
        for a, b in self.problem.body.tolist():
            taken = (used[a] if moves[a] else 0) | (used[b] if moves[b] else 0)
            colour = (~taken & (taken + 1)).bit_length() - 1
            used[a] |= 1 << colour
            used[b] |= 1 << colour
            found.append(colour)
        found = np.array(found, int)
        return [np.flatnonzero(found == k) for k in range(found.max(initial=-1) + 1)]

    def velocities(self, p):
        """Velocities (b, 3) that impulses (c, 3) lead to."""
        v = self.problem.free_velocity.copy()
        for bodies, push in zip((self.i, self.j), self.pushes):
            np.add.at(v, bodies, np.einsum("rcd,cr->cd", push, p))
        return v

    def relative(self, v):
        """Relative velocities (c, 3), bias included."""
        return (
            np.einsum("rcd,cd->cr", self.rows[0], v[self.i])
            + np.einsum("rcd,cd->cr", self.rows[1], v[self.j])
            + self.problem.bias
        )

    def project(self, p, pressing=None):
        """Impulses moved onto their graphs' admissible sets, normal first. Thresholds are those of the normal impulses
        ``pressing`` (c,) or of the new ones.
        """
        q = self.problem
        n = np.maximum(p[:, 0], -q.adhesion)
        limits = np.maximum(
            0,
            np.column_stack([q.friction, q.rolling_arm])
            * (q.adhesion + (n if pressing is None else pressing))[:, None],
        )
        return np.column_stack([n, np.clip(p[:, 1:], -limits, limits)])

    def residual(self, p, v):
        """Natural map, rms over the rms impulse, as contact.residual has it. The thresholds are those of the present
        normal impulse.
        """
        image = self.project(p - self.inverse * self.relative(v), pressing=p[:, 0])
        return float(np.linalg.norm((p - image) * self.units) / max(np.linalg.norm(p * self.units), 1e-300))

    def sweep(self, p, v, relaxation=1.0, backward=False):
        """Visits every contact, in place."""
        q = self.problem
        for at in reversed(self.colours) if backward else self.colours:
            i, j = self.i[at], self.j[at]
            vi, vj = v[i], v[j]
            for row in range(3):
                u = (
                    (self.rows[0, row, at] * vi).sum(axis=1)
                    + (self.rows[1, row, at] * vj).sum(axis=1)
                    + q.bias[at, row]
                )
                new = p[at, row] - relaxation * self.inverse[at, row] * u
                if row == 0:
                    new = np.maximum(new, -q.adhesion[at])
                    pressed = q.adhesion[at] + new
                else:
                    limit = np.maximum(0, (q.friction if row == 1 else q.rolling_arm)[at] * pressed)
                    new = np.clip(new, -limit, limit)
                change = (new - p[at, row])[:, None]
                vi += change * self.pushes[0, row, at]
                vj += change * self.pushes[1, row, at]
                p[at, row] = new
            v[i], v[j] = vi, vj


def plain(s, p, v):
    """Sweeps one way, without extrapolation: yields (sweeps made, impulses, velocities) after each look."""
    while True:
        s.sweep(p, v)
        yield 1, p, v


def over_relaxed(s, p, v):
    """Sweeps with over-relaxation: yields (sweeps made, impulses, velocities) after each look."""
    while True:
        s.sweep(p, v, relaxation=1.3)
        yield 1, p, v


class _Restarts:
    """The solver's own rule (``pkg/contact/plane/solver.cpp``): restart where the residual is larger than two comparisons
    ago, or twice the least since the last restart; each restart moves the looks that are compared apart."""

    def __init__(self, residual):
        self.patience = 1
        self._begin(residual)

    def _begin(self, residual):
        self.last = self.before = self.least = residual
        self.looks = 0

    def ask(self, residual):
        self.least = min(self.least, residual)
        if residual > 2 * self.least:
            self.patience = max(1, self.patience // 2)
            self._begin(residual)
            return True
        self.looks += 1
        if self.looks < self.patience:
            return False
        grown = residual > self.before
        if grown:
            self.patience = min(2 * self.patience, PATIENCE // LOOK)
            self._begin(residual)
        else:
            self.before, self.last, self.looks = self.last, residual, 0
        return grown


def _extrapolated(s, p, v, iterate, work):
    """Nesterov's extrapolation of ``iterate(p, v)``, which changes them in place."""
    rule, theta, beta, done = _Restarts(s.residual(p, v)), 1.0, 0.0, 0
    p0, v0 = p.copy(), v.copy()
    while True:
        y, w = p + beta * (p - p0), v + beta * (v - v0)
        p0, v0 = p, v
        iterate(y, w)
        p, v = y, w
        done += 1
        following = 0.5 * (1 + np.sqrt(1 + 4 * theta**2))
        theta, beta = following, (theta - 1) / following
        if done % max(1, LOOK // work) == 0 and rule.ask(s.residual(p, v)):
            theta, beta = 1.0, 0.0
        yield work, p, v


def accelerated(s, p, v):
    """What the solver does."""
    yield from _extrapolated(s, p, v, s.sweep, 1)


def forth_and_back(s, p, v):
    """Sweeps over the contacts forth and back in turn: yields (sweeps made, impulses, velocities) after each look."""

    def both(p, v):
        s.sweep(p, v)
        s.sweep(p, v, backward=True)

    yield from _extrapolated(s, p, v, both, 2)


def gradient(s, p, v):
    """All contacts at once, with the longest step that cannot diverge, extrapolated."""
    x = np.random.default_rng(1).standard_normal(p.shape)
    root = np.sqrt(s.inverse)
    for _ in range(50):
        x = _symmetric(s, root, x / np.linalg.norm(x))
        largest = np.linalg.norm(x)

    def step(p, v):
        p[:] = s.project(p - s.inverse * s.relative(v) / largest)
        v[:] = s.velocities(p)

    yield from _extrapolated(s, p, v, step, 1)


def _symmetric(s, root, x):
    """D^-1/2 W D^-1/2 x with D the diagonal of the Delassus operator W."""
    free, bias = s.problem.free_velocity, s.problem.bias
    return root * (s.relative(s.velocities(root * x)) - bias - (s.relative(free) - bias))


def conjugate(s, p, v):
    """Nonsmooth nonlinear conjugate gradients (Fletcher and Reeves) whose gradient is what a sweep changes."""
    direction = way = None
    last = np.inf
    while True:
        q, w = p.copy(), v.copy()
        s.sweep(q, w)
        step, moved = q - p, w - v
        size = float(((step * s.units) ** 2).sum())
        share = size / last
        if direction is None or share > 1:
            direction, way = step, moved
            p, v = q, w
        else:
            p, v = q + share * direction, w + share * way
            direction, way = step + share * direction, moved + share * way
        last = max(size, 1e-300)
        yield 1, q, w


def anderson(s, p, v, depth=5):
    """The combination of the last sweeps' results whose changes cancel best."""
    results, changes, least = [], [], np.inf
    while True:
        q, w = p.copy(), v.copy()
        s.sweep(q, w)
        change = (q - p) * s.units
        size = np.linalg.norm(change)
        least = min(least, size)
        if size > 2 * least:
            results, changes, least = [], [], size
        results, changes = [*results, (q, w)][-depth - 1 :], [*changes, change][-depth - 1 :]
        p, v = q, w
        if len(changes) > 1:
            differences = np.array([(changes[-1] - c).ravel() for c in changes[:-1]])
            shares = np.linalg.lstsq(
                differences @ differences.T + 1e-14 * size**2 * np.eye(len(differences)),
                differences @ changes[-1].ravel(),
                rcond=None,
            )[0]
            p = q - sum(g * (q - old) for g, (old, _) in zip(shares, results[:-1]))
            v = w - sum(g * (w - old) for g, (_, old) in zip(shares, results[:-1]))
        yield 1, q, w


def alternating(s, p, v, weight=20.0):
    """ADMM: velocities from a linear system that is factorised once, impulses by projection; ``weight``: penalty in
    units of 1/W_kk.
    """
    q, c = s.problem, len(p)
    free = np.flatnonzero(q.inverse_mass.ravel() > 0)
    at = np.full(q.inverse_mass.size, -1)
    at[free] = np.arange(len(free))
    entries = [
        (np.repeat(3 * np.arange(c) + row, 3), at[(3 * bodies[:, None] + np.arange(3)).ravel()], h[row].ravel())
        for bodies, h in zip((s.i, s.j), s.rows)
        for row in range(3)
    ]
    line, column, value = (np.concatenate(part) for part in zip(*entries))
    inside = column >= 0
    h = coo_matrix((value[inside], (line[inside], column[inside])), shape=(3 * c, len(free))).tocsc()
    penalty = weight * s.inverse.ravel()
    mass = 1 / q.inverse_mass.ravel()[free]
    factors = splu(
        (diags(mass) + h.T @ diags(penalty) @ h).tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        options={"SymmetricMode": True},
        diag_pivot_thresh=0,
    )
    filled = np.diff(factors.L.indptr).astype(float)
    done = 2 * float((filled**2).sum()) / (FLOPS * c)  # the factorisation
    fixed = np.zeros(q.inverse_mass.size)
    driven = q.inverse_mass.ravel() == 0
    fixed[driven] = q.free_velocity.ravel()[driven]
    offset = s.relative(fixed.reshape(-1, 3)).ravel()  # bias, and what driven bodies add
    momentum = mass * q.free_velocity.ravel()[free]
    while True:
        u = s.relative(v)
        admissible = s.project(p - penalty.reshape(-1, 3) * u)
        target = u.ravel() + (admissible - p).ravel() / penalty
        w = fixed.copy()
        w[free] = factors.solve(momentum + h.T @ (p.ravel() + penalty * (target - offset)))
        v = w.reshape(-1, 3)
        p = p - (penalty * (s.relative(v).ravel() - target)).reshape(-1, 3)
        yield done + 4 * filled.sum() / (FLOPS * c) + 1, admissible, s.velocities(admissible)
        done = 0.0


#: The names that tables and figures give them.
METHODS = {
    "Gauss-Seidel": plain,
    "over-relaxed by 1.3": over_relaxed,
    "accelerated (shipped)": accelerated,
    "accelerated, forth and back": forth_and_back,
    "gradient of all at once, accelerated": gradient,
    "conjugate gradients": conjugate,
    "Anderson, depth 5": anderson,
    "ADMM": alternating,
}


def run(problem, method, start, tolerance, most):
    """Runs a method until its residual is below ``tolerance`` or it has done the work of ``most`` sweeps.

    ``start``: impulses (c, 3). Returns (curve, impulses): an array (n, 2) of work and residual, looked at every LOOK
    sweeps of work, and what was found last.
    """
    sweeps = Sweeps(problem)
    p = sweeps.project(np.array(start, float))
    v = sweeps.velocities(p)
    done, looked, curve = 0.0, 0, [(0.0, sweeps.residual(p, v))]
    for work, p, v in METHODS[method](sweeps, p, v):
        done += work
        if done // LOOK > looked:
            looked = done // LOOK
            curve.append((done, sweeps.residual(p, v)))
        if curve[-1][1] <= tolerance or done >= most or not np.isfinite(curve[-1][1]):
            return np.array(curve), p
