"""Contact problems of single steps as arrays and files, and the solver without YADE.

A problem is what one step of :class:`ContactDynamicsEngine` has to solve: write it with ``engine.dump("step.h5")``,
read it here. :class:`ContactProblem` is one of disks in the plane, :class:`SpaceProblem` one of spheres, and of other
bodies, in space; all functions take both. The file's format stands in ``pkg/contact/plane/problem_file.hpp`` and
``pkg/contact/space/problem_file.hpp``. Needs NumPy and this project's module ``_nonsmooth_contact``, but no YADE::

    import nonsmooth.contact as contact
    problem = contact.load("step.h5")
    solution = contact.solve(problem, tolerance=1e-6, start="cold")
    print(solution.iterations, contact.residual(problem, solution.impulse).force_rms)
"""

from __future__ import annotations

import numbers
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .errors import UserError

__all__ = [
    "ContactProblem",
    "ProblemError",
    "Residual",
    "Solution",
    "SpaceProblem",
    "VelocityChanges",
    "load",
    "paths",
    "residual",
    "save",
    "solve",
    "velocity_changes",
]


class ProblemError(UserError, ValueError):
    """A problem or its file is not usable; the message says what is wrong."""


@dataclass(frozen=True)
class ContactProblem:
    """b bodies and c contacts; SI units, masses and impulses per metre of thickness, compression positive, contacts
    from i to j.
    """

    time_step: float  # h [s]
    inverse_mass: np.ndarray  # (b, 3): 1/m_x, 1/m_y [1/kg], 1/I [1/(kg m²)]; 0 where blocked
    free_velocity: np.ndarray  # (b, 3): velocities at the end of the step if no contact acted [m/s, m/s, rad/s]
    velocity: np.ndarray  # (b, 3): the step's solution
    body: np.ndarray  # (c, 2) int32: i, j
    normal: np.ndarray  # (c, 2)
    lever: np.ndarray  # (c, 4): λn_i, λt_i, λn_j, λt_j [m]
    bias: np.ndarray  # (c, 3): b_n, b_t [m/s], b_r [rad/s]
    adhesion: np.ndarray  # (c,): h F_a [N s]
    friction: np.ndarray  # (c,): μ_s
    rolling_arm: np.ndarray  # (c,): μ_r ℓ [m]
    length: np.ndarray  # (c,): ℓ [m]
    warm_start: np.ndarray  # (c, 3): impulses the step's solve began with [N s, N s, N m s]
    impulse: np.ndarray  # (c, 3): the step's solution
    position: np.ndarray | None = None  # (b, 2) [m], for the order of the sweep only
    play: np.ndarray | None = (
        None  # (c,): p = L/h [m/s] of bonds that close freely, 0 of others; None where there are none
    )


@dataclass(frozen=True)
class SpaceProblem:
    """The same in space: b bodies and c contacts; SI units, compression positive, contacts from i to j.

    Impulses and velocities are vectors of the world: f and m of a contact [N s, N m s], v and ω of a body
    [m/s, rad/s]. ``pkg/contact/space/problem.hpp`` has the equations.
    """

    time_step: float  # h [s]
    inverse_mass: np.ndarray  # (b, 3): 1/m_x, 1/m_y, 1/m_z [1/kg]; 0 where blocked
    inverse_inertia: np.ndarray  # (b, 6): xx, yy, zz, yz, zx, xy of the inverse tensor [1/(kg m²)]; 0 where blocked
    free_velocity: np.ndarray  # (b, 6): v, ω at the end of the step if no contact acted
    velocity: np.ndarray  # (b, 6): the step's solution
    body: np.ndarray  # (c, 2) int32: i, j
    normal: np.ndarray  # (c, 3)
    lever: np.ndarray  # (c, 2): λ_i, λ_j [m], the arms' parts along n: radius of i, minus radius of j
    bias: np.ndarray  # (c, 7): b_n [m/s], b_t (3) [m/s], b_w (3) [rad/s]
    adhesion: np.ndarray  # (c,): h F_a [N s]
    friction: np.ndarray  # (c,): μ_s
    rolling_arm: np.ndarray  # (c,): μ_r ℓ [m]
    twisting_arm: np.ndarray  # (c,): μ_tw ℓ [m]
    length: np.ndarray  # (c,): ℓ [m]
    warm_start: np.ndarray  # (c, 6): impulses the step's solve began with
    impulse: np.ndarray  # (c, 6): the step's solution
    position: np.ndarray | None = None  # (b, 3) [m], for the order of the sweep only
    aside: np.ndarray | None = None  # (c, 6): the arms' parts across n, of i and of j [m]; None where all are 0
    play: np.ndarray | None = None  # (c,): as in the plane [m/s]


@dataclass(frozen=True)
class Residual:
    """Distance from the graphs of the law (natural map), whoever found the impulses; rms and largest value over
    contacts.
    """

    relative: float  # rms over the rms impulse: what tolerances are given for
    force_rms: float  # [N]
    force_largest: float  # [N]
    speed_rms: float  # [m/s]
    speed_largest: float  # [m/s]
    # rms over contacts of what relative velocities miss, as a share of it and of the bodies' change of velocity [-]
    speed_share: float
    speed_share_largest: float
    # (c, 3): P − proj(P − (U + b)/W) of every contact [N s, N s, N m s]; in space (c, 6): f, m
    defect: np.ndarray


@dataclass(frozen=True)
class VelocityChanges:
    """What LMGC90's stopping tests look at, for impulses whoever found them: the changes of relative velocity that one
    more visit of each contact would make, in five dimensionless figures (``pkg/contact/plane/stopping.hpp``), and what each
    test compares with its tolerance.
    """

    velocity: float  # rms change of velocity over rms W P
    largest_velocity: float  # largest change over the same
    work: float  # rms of change times reaction, over the mean of P·W P
    largest_work: float
    drift: float  # mean of change times reaction, with its sign, over the same
    quad: float  # figure of the test "Quad"
    maxm: float  # of "Maxm"
    qm16: float  # of "QM/16"


@dataclass(frozen=True)
class Solution:
    """What a solve found: impulses, velocities, and how well they hold."""

    impulse: np.ndarray  # (c, 3), in space (c, 6)
    velocity: np.ndarray  # (b, 3), in space (b, 6)
    iterations: int
    in_single: int  # those of them in single precision
    restarts: int
    patches: int  # of contacts around mass jumps that were solved at once, each as often as it was
    converged: bool
    relative: float  # residual (natural map) of what is returned, whatever test stopped the solver
    # rms over contacts of the share of their speed that is left open (ϑ of pkg/contact/plane/residual.hpp) [-]
    speed_share: float
    speed_share_largest: float  # the largest of them, of a contact's point and without rolling
    seconds: float  # wall time of the solve, without the copying of arrays [s]


@dataclass(frozen=True)
class _Dimension:
    """What differs between the plane and space: columns of arrays (0: a list), and names in the module."""

    bodies: dict
    contacts: dict
    optional: dict  # arrays that may be None: (their rows, their columns)
    suffix: str = ""

    @property
    def arrays(self):
        """Names of what a solve reads."""
        solution = ("velocity", "warm_start", "impulse")
        return (*(name for name in (*self.bodies, *self.contacts) if name not in solution), "body", *self.optional)

    @property
    def impulse(self):
        return self.contacts["impulse"]

    def call(self, function, *arguments):
        import _nonsmooth_contact

        return getattr(_nonsmooth_contact, function + self.suffix)(*arguments)


CONTACT_ARRAYS = {
    "normal": 2,
    "lever": 4,
    "bias": 3,
    "adhesion": 0,
    "friction": 0,
    "rolling_arm": 0,
    "length": 0,
    "warm_start": 3,
    "impulse": 3,
}
SPACE_CONTACT_ARRAYS = {
    **CONTACT_ARRAYS,
    "normal": 3,
    "lever": 2,
    "bias": 7,
    "twisting_arm": 0,
    "warm_start": 6,
    "impulse": 6,
}
_PLANE = _Dimension(
    {"inverse_mass": 3, "free_velocity": 3, "velocity": 3},
    CONTACT_ARRAYS,
    {"position": ("inverse_mass", 2), "play": ("normal", 0)},
)
_SPACE = _Dimension(
    {"inverse_mass": 3, "inverse_inertia": 6, "free_velocity": 6, "velocity": 6},
    SPACE_CONTACT_ARRAYS,
    {"position": ("inverse_mass", 3), "aside": ("normal", 6), "play": ("normal", 0)},
    "_space",
)


def _dimension(problem) -> _Dimension:
    for kind, dimension in ((ContactProblem, _PLANE), (SpaceProblem, _SPACE)):
        if isinstance(problem, kind):
            return dimension
    raise ProblemError(f"{problem!r} is no contact problem: it must be a ContactProblem or a SpaceProblem")


def load(path) -> ContactProblem | SpaceProblem:
    """Reads a problem; raises ProblemError naming the file and what is missing or wrong in it."""
    import _nonsmooth_contact

    try:
        arrays = _nonsmooth_contact.load(os.fspath(path))
    except RuntimeError as error:
        raise ProblemError(str(error)) from None
    return {2: ContactProblem, 3: SpaceProblem}[arrays.pop("dimension")](**arrays)


def check(problem: ContactProblem | SpaceProblem, what="contact problem") -> ContactProblem | SpaceProblem:
    """Returns the problem if all arrays have the shapes and kinds of numbers they must have, and contacts name bodies
    that are there.

    Raises ProblemError naming the array otherwise. Values are :func:`solve`'s to refuse.
    """
    dimension = _dimension(problem)
    step = problem.time_step
    if not (isinstance(step, numbers.Real) and np.isfinite(step) and step > 0):
        raise ProblemError(f"{what}: time_step = {step!r}: it must be a positive number of seconds")
    for name in ("inverse_mass", "normal"):
        if np.ndim(getattr(problem, name)) == 0:
            raise ProblemError(f"{what}: {name} must be an array")
    bodies, contacts = len(problem.inverse_mass), len(problem.normal)
    rows = {name: (bodies, columns) for name, columns in dimension.bodies.items()}
    rows.update({name: (contacts, columns) for name, columns in dimension.contacts.items()})
    rows["body"] = (contacts, 2)
    for name, (of, columns) in dimension.optional.items():
        if getattr(problem, name) is not None:
            rows[name] = (len(getattr(problem, of)), columns)
    shapes = {name: shape if shape[1] else shape[:1] for name, shape in rows.items()}
    for name, shape in shapes.items():
        _checked(f"{what}: {name}", getattr(problem, name), shape, "iu" if name == "body" else "fiu")
    if contacts and not (0 <= np.min(problem.body) and np.max(problem.body) < bodies):
        k = int(np.argmax(((np.asarray(problem.body) < 0) | (np.asarray(problem.body) >= bodies)).any(axis=1)))
        raise ProblemError(
            f"{what}: body: contact {k} names bodies {tuple(np.asarray(problem.body)[k].tolist())}; there are {bodies}, counted from 0"
        )
    return problem


def _checked(what, value, shape, kinds):
    """The value as an array of that shape, whose numbers are of one of NumPy's kinds."""
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ProblemError(f"{what} is not an array ({error})") from None
    if array.shape != shape:
        raise ProblemError(f"{what} has the shape {array.shape} and must have {shape}")
    if array.dtype.kind not in kinds and array.size:
        raise ProblemError(f"{what} holds {array.dtype} and must hold {'numbers' if 'f' in kinds else 'whole numbers'}")
    return array


def save(path, problem: ContactProblem | SpaceProblem) -> Path:
    """Writes a problem beside and renames; returns the path."""
    path = Path(path)
    check(problem)
    try:
        _dimension(problem).call(
            "save",
            os.fspath(path),
            {
                **_arrays(problem, problem.impulse),
                "time_step": float(problem.time_step),
                "velocity": problem.velocity,
                "warm_start": problem.warm_start,
            },
        )
    except RuntimeError as error:
        raise ProblemError(str(error)) from None
    return path


def _arrays(problem, impulse):
    dimension = _dimension(problem)
    return {
        **{name: getattr(problem, name) for name in dimension.arrays},
        "impulse": _checked("impulse", impulse, (len(problem.normal), dimension.impulse), "fiu"),
    }


def _whole(name, value, least, most):
    if not isinstance(value, numbers.Integral) or isinstance(value, bool) or not least <= value <= most:
        raise ProblemError(f"{name} = {value!r}: it must be a whole number from {least} to {most}")
    return int(value)


def solve(
    problem: ContactProblem | SpaceProblem,
    method="accelerated",
    tolerance=1e-4,
    max_iterations=1000,
    check_every=10,
    threads=1,
    start="warm",
    stopping="naturalMap",
    path="best",
    precision="mixed",
) -> Solution:
    """Solves the problem with the project's solver.

    ``method``: "accelerated" or "gaussSeidel"; ``start``: "warm" (what the step began with), "cold" (zero) or impulses
    of shape (c, 3), in space (c, 6). ``stopping``: what ``tolerance`` is compared with: "naturalMap" (the residual) or one of LMGC90's
    tests, "Quad", "Maxm", "QM/16". ``path``: the loops of the sweep: "best" (four or eight contacts at a time, by the
    fastest instructions of this processor), one of :func:`paths` with the same bits, or "reference" (contact after
    contact, by the general formulas; the same solution to within the tolerance). ``precision``: "mixed" (sweeps in
    single precision where ``tolerance`` is 1e-5 or more and ``stopping`` "naturalMap"; what they find is held against
    the law, and swept on, in double precision) or "double". Raises ProblemError for settings without sense, and for
    numbers that are not finite or must not be negative, naming the body or contact.
    """
    import _nonsmooth_contact

    if isinstance(start, str):
        if start not in ("warm", "cold"):
            raise ProblemError(f"start = {start!r}: it must be 'warm', 'cold' or an array of impulses")
        start = problem.warm_start if start == "warm" else np.zeros_like(problem.warm_start)
    if (
        not isinstance(tolerance, numbers.Real)
        or isinstance(tolerance, bool)
        or not (np.isfinite(tolerance) and tolerance > 0)
    ):
        raise ProblemError(f"tolerance = {tolerance!r}: it must be a positive, finite number")
    for name, value in (("method", method), ("stopping", stopping), ("path", path), ("precision", precision)):
        if not isinstance(value, str):
            raise ProblemError(f"{name} = {value!r}: it must be a string")
    sweeps = _whole("max_iterations", max_iterations, 0, 2**31 - 1), _whole(
        "check_every", check_every, 1, _nonsmooth_contact.most_check_every
    )
    threads = _whole("threads", threads, 1, _nonsmooth_contact.most_threads)
    try:
        found = _dimension(problem).call(
            "solve",
            _arrays(check(problem), start),
            method,
            float(tolerance),
            *sweeps,
            threads,
            stopping,
            path,
            precision,
        )
    except ValueError as error:
        raise ProblemError(str(error)) from None
    return Solution(
        **{
            name: found[name]
            for name in (
                "impulse",
                "velocity",
                "iterations",
                "in_single",
                "restarts",
                "patches",
                "converged",
                "relative",
                "speed_share",
                "speed_share_largest",
                "seconds",
            )
        }
    )


def paths() -> tuple:
    """Names for :func:`solve`'s ``path`` on this processor: what it has of "avx512" and "avx2", the fastest first, then
    "portable" and "reference".
    """
    import _nonsmooth_contact

    return (*_nonsmooth_contact.kernels, "reference")


def residual(problem: ContactProblem | SpaceProblem, impulse=None) -> Residual:
    """Residual of impulses of shape (c, 3), in space (c, 6) (default: those in the problem), from velocities computed
    anew from them.
    """
    arrays = _arrays(check(problem), problem.impulse if impulse is None else impulse)
    r = _dimension(problem).call("residual", arrays)
    h = problem.time_step
    return Residual(
        r["relative"],
        r["rms"] / h,
        r["largest"] / h,
        r["speed_rms"],
        r["speed_largest"],
        r["speed_share"],
        r["speed_share_largest"],
        r["defect"],
    )


def velocity_changes(problem: ContactProblem | SpaceProblem, impulse=None) -> VelocityChanges:
    """Figures of LMGC90's stopping tests for impulses as :func:`residual` takes them (default: those in the problem),
    from velocities computed anew.
    """
    arrays = _arrays(check(problem), problem.impulse if impulse is None else impulse)
    return VelocityChanges(**_dimension(problem).call("velocity_changes", arrays))
