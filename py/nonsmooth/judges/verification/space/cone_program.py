"""The contact law in space by convex programs that SciPy solves, for problems of a few contacts.

It shares no line with our solver and knows all four graphs of ``pkg/contact/space/law.hpp``, twisting too. With the
thresholds held at what the normal impulses of the iteration before make of them (Tresca's friction), impulses are the
minimum of a convex quadratic over a product of half-lines, discs and intervals::

    min ½ P·W P + q·P    over    N̂ ≥ 0,  |T| ≤ g_t,  |Γ| ≤ g_r,  |Σ| ≤ g_s ,       N̂ = N + h F_a

Where the thresholds that follow from N̂ are those that were held, that is the law: Haslinger's fixed point. Which
contacts are open, stick or slip is then known, and so are the equations of each row; a root of them is the answer to
rounding, and the inequalities, looked at again in the end, prove it.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from scipy import linalg, optimize

from ....contact import SpaceProblem

__all__ = ["ConeAnswer", "solve"]

NORMAL, SLIDING, ROLLING, TWISTING = 0, slice(1, 3), slice(3, 5), slice(5, 6)
PARTS = (SLIDING, ROLLING, TWISTING)
OPEN, STICK, SLIP = 0, 1, 2


@dataclass(frozen=True)
class ConeAnswer:
    """What the programs found."""

    impulse: np.ndarray  # (c, 6): f, m in the world [N s, N m s]
    velocity: np.ndarray  # (b, 6) [m/s, rad/s]
    state: np.ndarray  # (c, 3) of sliding, rolling and twisting: OPEN, STICK or SLIP
    violation: float  # largest miss of an equation or inequality of the law, in units of the rms of q [-]


def solve(problem: SpaceProblem, iterations=200, held=1e-9) -> ConeAnswer:
    """Solves the problem from no impulses.

    ``iterations``: at most so many programs, fewer where no threshold changes by more than ``held`` of the largest
    impulse. Raises ValueError for contacts with play, which the law of a convex program has not, and RuntimeError where
    the thresholds do not settle.
    """
    if problem.play is not None and np.any(problem.play):
        raise ValueError("a contact has play, which the convex programs do not know")
    jacobian, inverse, bias = _system(problem)
    count = len(problem.normal)
    product = jacobian @ inverse @ jacobian.T
    shift = np.zeros((count, 6))
    shift[:, NORMAL] = problem.adhesion
    q = jacobian @ problem.free_velocity.ravel() + bias - product @ shift.ravel()
    scale = _scales(product, count)
    speed = np.sqrt(np.mean((scale * q) ** 2)) or 1.0
    w, q = scale[:, None] * product * scale, scale * q / speed
    per = scale.reshape(count, 6)
    arms = np.column_stack([problem.friction, problem.rolling_arm, problem.twisting_arm])
    factor = arms * per[:, :1] / per[:, [1, 3, 5]]  # of thresholds over normal impulses
    p = _fixed_point(w, q, factor, iterations, held)
    state = _states(w, q, factor, p)
    p = optimize.least_squares(
        _misses, p.ravel(), args=(w, q, factor, state), xtol=1e-15, ftol=1e-15, gtol=1e-15
    ).x.reshape(count, 6)
    rows = p * per * speed - shift
    velocity = problem.free_velocity.ravel() + inverse @ jacobian.T @ rows.ravel()
    frames = _frames(problem.normal)
    impulse = np.zeros((count, 6))
    impulse[:, :3] = np.einsum("ck,ckd->cd", rows[:, :3], frames)
    impulse[:, 3:] = np.einsum("ck,ckd->cd", rows[:, [5, 3, 4]], frames)
    return ConeAnswer(impulse, velocity.reshape(-1, 6), state, _violation(w, q, factor, state, p))


def _frames(normal):
    """n, t1, t2 of each contact, (c, 3, 3)."""
    return np.array([np.vstack([n, linalg.null_space(n[None]).T]) for n in normal])


def _system(problem):
    """H (6c, 6b), M⁻¹ (6b, 6b) and b (6c,) in rows n, t1, t2, r1, r2, s of each contact."""
    bodies, count = len(problem.inverse_mass), len(problem.normal)
    aside = np.zeros((count, 6)) if problem.aside is None else problem.aside
    jacobian, bias = np.zeros((count, 6, bodies, 6)), np.zeros((count, 6))
    for k, frame in enumerate(_frames(problem.normal)):
        for side, sign in ((0, -1.0), (1, 1.0)):
            arm = problem.lever[k, side] * problem.normal[k] + aside[k, 3 * side : 3 * side + 3]
            body = problem.body[k, side]
            jacobian[k, :3, body, :3] += sign * frame
            jacobian[k, :3, body, 3:] += sign * np.cross(arm, frame)  # e·(ω × a) = ω·(a × e)
            jacobian[k, 3:, body, 3:] += sign * frame[[1, 2, 0]]
        bias[k] = [problem.bias[k, 0], *(frame[1:] @ problem.bias[k, 1:4]), *(frame[[1, 2, 0]] @ problem.bias[k, 4:])]
    inverse = np.zeros((bodies, 6, bodies, 6))
    for b, (mass, (xx, yy, zz, yz, zx, xy)) in enumerate(zip(problem.inverse_mass, problem.inverse_inertia)):
        inverse[b, :3, b, :3] = np.diag(mass)
        inverse[b, 3:, b, 3:] = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
    size = 6 * bodies
    return jacobian.reshape(6 * count, size), inverse.reshape(size, size), bias.ravel()


def _scales(product, count):
    """One a row: 1/√ of the mean of W's diagonal over the rows of one vector, 1 where that is 0; (6c,)."""
    diagonal, scale = np.diag(product).reshape(count, 6), np.ones((count, 6))
    for rows in (slice(0, 1), *PARTS):
        mean = diagonal[:, rows].mean(axis=1, keepdims=True)
        scale[:, rows] = np.where(mean > 0, 1 / np.sqrt(np.where(mean > 0, mean, 1)), 1)
    return scale.ravel()


def _fixed_point(w, q, factor, iterations, held):
    """Impulses whose thresholds are those that they were found with, (c, 6)."""
    count = len(factor)
    p = np.zeros((count, 6))
    normal = np.maximum(0, -q.reshape(count, 6)[:, NORMAL])
    for _ in range(iterations):
        p = _program(w, q, factor * normal[:, None], p)
        if np.abs(p[:, NORMAL] - normal).max() <= held * max(1.0, p[:, NORMAL].max()):
            return p
        normal = p[:, NORMAL]
    raise RuntimeError(f"thresholds have not settled after {iterations} programs")


def _program(w, q, thresholds, start):
    """The convex program for given thresholds (c, 3), from a first guess; what has none to speak of is held at 0."""
    count = len(thresholds)
    least = 1e-12 * max(1.0, thresholds.max())
    bounds, discs = [], []  # of each impulse, and of each vector of two
    for k in range(count):
        bounds.append((0, np.inf))
        for part, threshold in zip(PARTS, thresholds[k]):
            rows = range(6 * k + part.start, 6 * k + part.stop)
            alone = threshold <= least
            bounds += [(0, 0) if alone else (-threshold, threshold)] * len(rows)
            if len(rows) == 2 and not alone:
                discs.append((*rows, threshold))
    first, second, radius = (np.array(v) for v in zip(*discs)) if discs else (np.zeros(0, int),) * 2 + (np.zeros(0),)

    def room(p):
        return radius - (p[first] ** 2 + p[second] ** 2) / radius

    def slopes(p):
        rows, each = np.zeros((len(radius), len(p))), np.arange(len(radius))
        rows[each, first], rows[each, second] = -2 * p[first] / radius, -2 * p[second] / radius
        return rows

    with warnings.catch_warnings():  # a step that goes beyond a bound by rounding is clipped
        warnings.filterwarnings("ignore", "Values in x were outside bounds", RuntimeWarning)
        found = optimize.minimize(
            lambda p: 0.5 * p @ w @ p + q @ p,
            np.clip(start.ravel(), *np.transpose(bounds)),
            jac=lambda p: w @ p + q,
            bounds=bounds,
            constraints=[{"type": "ineq", "fun": room, "jac": slopes}] if discs else [],
            method="SLSQP",
            options={"ftol": 1e-16, "maxiter": 1000},
        )
    return found.x.reshape(count, 6)


def _states(w, q, factor, p, small=1e-6):
    """What each row does, (c, 3). ``small``: what the programs leave, of the largest impulse and velocity."""
    count = len(factor)
    u = (w @ p.ravel() + q).reshape(count, 6)
    state = np.full((count, 3), STICK)
    for column, part in enumerate(PARTS):
        threshold = factor[:, column] * p[:, NORMAL]
        slips = np.linalg.norm(p[:, part], axis=1) >= (1 - 1e-4) * threshold
        state[slips & (np.linalg.norm(u[:, part], axis=1) > small), column] = SLIP
        state[factor[:, column] == 0, column] = SLIP
    state[p[:, NORMAL] <= small * max(1.0, p.max())] = OPEN
    return state


def _misses(p, w, q, factor, state):
    """What the equations of each row's state miss, (6c,)."""
    count = len(factor)
    u, p = (w @ p + q).reshape(count, 6), p.reshape(count, 6)
    closed = state[:, 0] != OPEN
    missed = np.where(closed[:, None], u, p)
    for column, part in enumerate(PARTS):
        slips = state[:, column] == SLIP
        speed = np.linalg.norm(u[slips, part], axis=1)
        threshold = factor[slips, column] * p[slips, NORMAL]
        missed[slips, part] = p[slips, part] + (threshold / np.where(speed > 0, speed, 1))[:, None] * u[slips, part]
    return missed.ravel()


def _violation(w, q, factor, state, p):
    """The largest miss of an equation, or of the inequalities that a state takes for granted."""
    u = (w @ p.ravel() + q).reshape(p.shape)
    misses = [np.abs(_misses(p.ravel(), w, q, factor, state)).max(), (-p[:, NORMAL]).max(), (-u[:, NORMAL]).max()]
    for column, part in enumerate(PARTS):
        misses.append((np.linalg.norm(p[:, part], axis=1) - factor[:, column] * p[:, NORMAL]).max())
    return float(max(misses))
