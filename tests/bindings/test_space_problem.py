"""Problems in space through the face in Python: files, refusals, every path; and a cone program of SciPy that knows
nothing of the solver, for clusters of balls with sliding, rolling and twisting.
"""

from dataclasses import replace

import numpy as np
import pytest

from nonsmooth import contact

STEP, GRAVITY = 5e-3, 9.81


def cluster(count=4, seed=1, adhesion=0.0):
    """A few balls that lie on a floor and on each other, with velocities by chance."""
    dice = np.random.default_rng(seed)
    radius = dice.uniform(0.4, 0.5, count)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    out = 0.5 * (radius + np.roll(radius, 1)).max() / np.sin(np.pi / max(count - 1, 2))
    place = np.column_stack([out * np.cos(angle), out * np.sin(angle), radius])
    place[-1] = (0.03, 0.02, 1.1)  # one on top
    mass, inertia = 2500 * 4 / 3 * np.pi * radius**3, 0.4 * 2500 * 4 / 3 * np.pi * radius**5
    pairs, normals, levers, gaps = [], [], [], []
    for i in range(count):
        for j in range(i + 1, count):
            way = place[j] - place[i]
            distance = np.linalg.norm(way)
            if distance < 1.4 * (radius[i] + radius[j]):
                pairs.append((i, j))
                normals.append(way / distance)
                levers.append((radius[i], -radius[j]))
                gaps.append(0.0)
    for i in range(count - 1):
        pairs.append((count, i))
        normals.append((0, 0, 1))
        levers.append((0, -radius[i]))
        gaps.append(0.0)
    contacts = len(pairs)
    free = np.zeros((count + 1, 6))
    free[:count, 2] = -GRAVITY * STEP
    free[:count] += dice.normal(0, 0.05, (count, 6))
    sizes = np.array([abs(a - b) for a, b in levers])
    one = np.ones(contacts)
    inverse = np.append(1 / mass, 0)
    turning = np.append(1 / inertia, 0)
    return contact.SpaceProblem(
        time_step=STEP,
        inverse_mass=np.column_stack([inverse] * 3),
        inverse_inertia=np.column_stack([turning] * 3 + [0 * turning] * 3),
        free_velocity=free,
        velocity=np.zeros((count + 1, 6)),
        body=np.array(pairs, dtype=np.int32),
        normal=np.array(normals, dtype=float),
        lever=np.array(levers, dtype=float),
        bias=np.zeros((contacts, 7)),
        adhesion=adhesion * one,
        friction=0.3 * one,
        rolling_arm=0.05 * sizes,
        twisting_arm=0.04 * sizes,
        length=sizes,
        warm_start=np.zeros((contacts, 6)),
        impulse=np.zeros((contacts, 6)),
        position=np.vstack([place, np.zeros(3)]),
    )


def test_a_file_keeps_every_bit_and_its_dimension(tmp_path):
    problem = cluster()
    solution = contact.solve(problem, tolerance=1e-8)
    problem = replace(problem, impulse=solution.impulse, velocity=solution.velocity)
    count = len(problem.normal)
    rich = replace(
        problem,
        aside=np.linspace(0, 0.1, 6 * count).reshape(count, 6),
        play=np.linspace(0, 1, count),
        bias=np.linspace(-1, 1, 7 * count).reshape(count, 7),
        position=None,
    )
    for one in (problem, rich):
        back = contact.load(contact.save(tmp_path / "step.h5", one))
        assert isinstance(back, contact.SpaceProblem)
        for name, value in vars(one).items():
            assert np.array_equal(getattr(back, name), value), name


def test_every_path_and_any_threads_give_the_same_bits():
    problem = cluster(6)
    for tolerance in (1e-5, 1e-9):
        one = contact.solve(problem, max_iterations=50, tolerance=tolerance)
        for path in contact.paths()[:-1]:
            for threads in (1, 2):
                other = contact.solve(problem, max_iterations=50, tolerance=tolerance, path=path, threads=threads)
                assert np.array_equal(one.impulse, other.impulse), (tolerance, path, threads)
                assert np.array_equal(one.velocity, other.velocity), (tolerance, path, threads)


def test_the_residual_of_a_solution_is_that_which_the_solver_reports():
    problem = cluster(5)
    solution = contact.solve(problem, tolerance=1e-9)
    found = contact.residual(problem, solution.impulse)
    assert found.relative == pytest.approx(solution.relative, rel=1e-6, abs=1e-15)
    assert found.defect.shape == (len(problem.normal), 6)
    changes = contact.velocity_changes(problem, solution.impulse)
    assert 0 <= changes.quad < 1e-5
    assert contact.solve(problem, stopping="QM/16", tolerance=1e-6).converged


@pytest.mark.parametrize(
    "change, message",
    [
        ({"normal": np.ones((9, 3))}, "its length must be 1"),
        ({"twisting_arm": -np.ones(9)}, "twisting arm -1: it must not be negative"),
        ({"bias": np.full((9, 7), np.nan)}, "tangential bias .*: it must be finite"),
        ({"inverse_inertia": np.ones((5, 6)) * (1, 1, 1, 0, 0, 2)}, "no principal value may be negative"),
        ({"free_velocity": np.zeros((5, 3))}, r"free_velocity has the shape \(5, 3\) and must have \(5, 6\)"),
        ({"body": np.full((9, 2), 7, dtype=np.int32)}, r"names bodies \(7, 7\); there are 5, counted from 0"),
    ],
)
def test_what_cannot_be_used_is_refused_by_name(change, message):
    problem = cluster()
    assert problem.normal.shape == (9, 3)
    with pytest.raises(contact.ProblemError, match=message):
        contact.solve(replace(problem, **change))


def test_a_file_of_another_dimension_or_none_is_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = contact.save(tmp_path / "step.h5", cluster())
    with h5py.File(path, "a") as file:
        file.attrs["dimension"] = np.int32(4)
    with pytest.raises(contact.ProblemError, match="has the dimension 4: it must be 2 or 3"):
        contact.load(path)


def jacobian(problem):
    """(contacts, 6, bodies, 6): relative velocity of the points and of the turning, from all bodies' velocities."""
    contacts, bodies = len(problem.normal), len(problem.inverse_mass)
    h = np.zeros((contacts, 6, bodies, 6))
    for k, ((i, j), n, lever) in enumerate(zip(problem.body, problem.normal, problem.lever)):
        for b, arm, sign in ((i, lever[0] * n, -1), (j, lever[1] * n, 1)):
            h[k, :3, b, :3] = sign * np.eye(3)
            x, y, z = arm
            h[k, :3, b, 3:] = -sign * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])  # ω × a = −[a]× ω
            h[k, 3:, b, 3:] = sign * np.eye(3)
    return h.reshape(6 * contacts, 6 * bodies)


def frames(normals):
    """(contacts, 3, 3): rows n and two directions across it."""
    aside = np.where(np.abs(normals[:, :1]) < 0.8, (1.0, 0, 0), (0, 1.0, 0))
    across = np.cross(normals, aside)
    across /= np.linalg.norm(across, axis=1)[:, None]
    return np.stack([normals, across, np.cross(normals, across)], axis=1)


def cone_program(problem, thresholds):
    """The velocities that minimise energy over impulses inside thresholds that do not follow the pressure: a convex
    program, whose answer is one motion.

    Unknowns are those of rows that may bear something, in units in which W has a diagonal of one.
    """
    from scipy.optimize import minimize

    contacts = len(problem.normal)
    turn = np.zeros((contacts, 6, contacts, 6))
    for k, frame in enumerate(frames(problem.normal)):
        turn[k, :3, k, :3] = turn[k, 3:, k, 3:] = frame
    h = turn.reshape(6 * contacts, -1) @ jacobian(problem)
    inverse = np.hstack([problem.inverse_mass, problem.inverse_inertia[:, :3]]).ravel()
    slide, roll, spin = thresholds
    most = np.stack([np.full(contacts, np.inf), slide, slide, spin, roll, roll], axis=1).ravel()
    h, kind = h[most > 0], np.tile([0, 1, 1, 2, 3, 3], contacts)[most > 0]
    of = np.repeat(np.arange(contacts), 6)[most > 0]
    w = h @ (inverse[:, None] * h.T)
    unit = np.sqrt(np.diag(w))
    u = (h @ problem.free_velocity.ravel()) / unit
    w = w / np.outer(unit, unit)
    limits = []  # (rows, threshold), the rows' square at most the threshold's
    for k in range(contacts):
        for row, threshold in ((1, slide), (2, spin), (3, roll)):
            rows = np.flatnonzero((of == k) & (kind == row))
            if len(rows):
                limits.append((rows, threshold[k] * unit[rows[0]]))
    normal = np.flatnonzero(kind == 0)
    least = -problem.adhesion * unit[normal]

    def inside(x):
        return np.concatenate([x[normal] - least, [1 - (x[rows] ** 2).sum() / most**2 for rows, most in limits]])

    def slopes(x):
        result = np.zeros((len(normal) + len(limits), len(x)))
        result[np.arange(len(normal)), normal] = 1
        for k, (rows, most) in enumerate(limits, len(normal)):
            result[k, rows] = -2 * x[rows] / most**2
        return result

    size = 1 / np.abs(u).max() ** 2
    found = minimize(
        lambda x: size * (0.5 * x @ w @ x + u @ x),
        np.zeros(len(u)),
        jac=lambda x: size * (w @ x + u),
        constraints={"type": "ineq", "fun": inside, "jac": slopes},
        method="SLSQP",
        options={"maxiter": 3000, "ftol": 1e-18},
    )
    return (problem.free_velocity.ravel() + inverse * (h.T @ (found.x / unit))).reshape(-1, 6)


@pytest.mark.parametrize("count, seed, adhesion", [(3, 1, 0.0), (4, 2, 0.0), (4, 3, 2.0), (5, 4, 0.0)])
def test_a_cone_program_finds_the_same_motion(count, seed, adhesion):
    pytest.importorskip("scipy")
    problem = cluster(count, seed, adhesion)
    solution = contact.solve(problem, tolerance=1e-12, max_iterations=100_000)
    assert solution.converged
    along = np.einsum("kx,kx->k", problem.normal, solution.impulse[:, :3])
    pressed = along + problem.adhesion
    thresholds = [pressed * a for a in (problem.friction, problem.rolling_arm, problem.twisting_arm)]
    found = cone_program(problem, thresholds)
    assert np.abs(found - solution.velocity).max() < 1e-6
    # all rows are at work: somewhere each is at its threshold, and what twists is held by it
    twist = np.abs(np.einsum("kx,kx->k", problem.normal, solution.impulse[:, 3:]))
    assert (twist[pressed > 0] > 0.999 * thresholds[2][pressed > 0]).any()
    without = contact.solve(
        replace(problem, twisting_arm=0 * problem.twisting_arm), tolerance=1e-12, max_iterations=100_000
    )
    assert np.abs(without.velocity - solution.velocity).max() > 1e-4
