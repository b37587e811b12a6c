"""The solver's face in Python without YADE: what it refuses, and that a file and a solve keep every bit. Needs the
build's folder ``python`` on PYTHONPATH.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from nonsmooth import contact

DATA = Path(__file__).resolve().parents[1] / "data"


@pytest.fixture
def problem():
    return contact.load(DATA / "slope_t1.h5")


def changed(array, at, value):
    array = np.array(array, dtype=np.result_type(array, np.asarray(value)))
    array[at] = value
    return array


def test_a_file_keeps_every_bit(problem, tmp_path):
    back = contact.load(contact.save(tmp_path / "again.h5", problem))
    for name, value in vars(problem).items():
        assert np.array_equal(getattr(back, name), value), name
    assert [path.name for path in tmp_path.iterdir()] == ["again.h5"]
    without = contact.load(contact.save(tmp_path / "again.h5", replace(problem, position=None)))
    assert without.position is None
    assert problem.play is None
    count = len(problem.normal)
    closing = replace(problem, play=np.linspace(0, 1, count), adhesion=np.ones(count))
    back = contact.load(contact.save(tmp_path / "closing.h5", closing))
    assert np.array_equal(back.play, closing.play)
    one, other = contact.solve(closing, max_iterations=20), contact.solve(back, max_iterations=20)
    struts = contact.solve(replace(closing, play=None), max_iterations=20)
    assert np.array_equal(one.impulse, other.impulse) and not np.array_equal(one.impulse, struts.impulse)


def test_a_link_is_replaced_and_not_followed(problem, tmp_path):
    victim = tmp_path / "victim"
    victim.write_text("precious")
    (tmp_path / "step.h5").symlink_to(victim)
    contact.save(tmp_path / "step.h5", problem)
    assert victim.read_text() == "precious" and not (tmp_path / "step.h5").is_symlink()
    with pytest.raises(contact.ProblemError, match=r"cannot be written \(No such file or directory\); choose a folder"):
        contact.save(tmp_path / "nowhere" / "step.h5", problem)


def test_every_path_and_any_threads_give_the_same_bits(problem):
    for tolerance in (1e-5, 1e-9):  # in single precision and not
        one = contact.solve(problem, max_iterations=50, tolerance=tolerance)
        for path in contact.paths()[:-1]:
            for threads in (1, 2):
                other = contact.solve(problem, max_iterations=50, tolerance=tolerance, path=path, threads=threads)
                told = (tolerance, path, threads)
                assert np.array_equal(one.impulse, other.impulse) and np.array_equal(one.velocity, other.velocity), told


def test_precision_is_what_was_asked_for(problem):
    for precision, tolerance, single in (("mixed", 1e-4, True), ("mixed", 1e-9, False), ("double", 1e-4, False)):
        found = contact.solve(problem, start="cold", tolerance=tolerance, precision=precision)
        assert found.in_single == (found.iterations if single else 0) and found.iterations > 0
        # the same formula by other code
        assert contact.residual(problem, found.impulse).relative == pytest.approx(found.relative, rel=1e-6)


@pytest.mark.parametrize(
    "name, at, value, words",
    [
        ("position", (5, 0), np.nan, r"body 5 has the position \(nan, .*\): it must be finite"),
        ("position", (0, 1), -np.inf, r"body 0 has the position \(.*, -inf\)"),
        ("inverse_mass", (3, 2), np.nan, "body 3 has a velocity or mass that is not finite"),
        ("inverse_mass", (3, 0), -1.0, "body 3 has the inverse mass .*: none may be negative"),
        ("free_velocity", (3, 2), np.inf, "body 3 has a velocity or mass that is not finite"),
        ("normal", (7, 0), np.nan, "contact 7 between bodies .* has the normal x nan"),
        ("normal", (7,), (3.0, 4.0), r"contact 7 .* has the normal \(3, 4\): its length must be 1"),
        ("lever", (7, 3), np.inf, "has the lever t of j inf"),
        ("bias", (7, 1), np.nan, "has the tangential bias nan"),
        ("adhesion", 7, -1.0, "has the adhesion -1: it must not be negative"),
        ("friction", 7, -0.5, "has the friction -0.5: it must not be negative"),
        ("rolling_arm", 7, np.nan, "has the rolling arm nan: it must be finite"),
        ("length", 7, 0.0, "has the length 0: it must be positive"),
        ("warm_start", (7, 2), np.nan, "has the rolling impulse nan"),
        ("body", (7, 1), 10**6, r"body: contact 7 names bodies \(\d+, 1000000\); there are \d+, counted from 0"),
        ("body", (7, 0), 2**32, "body: contact 7 names bodies"),  # a number that 32 bits would make into 0
        ("body", (7, 0), 1.5, "body holds float64 and must hold whole numbers"),
        ("friction", 7, 1j, "friction holds complex128 and must hold numbers"),
    ],
)
def test_values_are_refused_by_name(problem, name, at, value, words):
    bad = replace(problem, **{name: changed(getattr(problem, name), at, value)})
    with pytest.raises(contact.ProblemError, match=words):
        contact.solve(bad)


def test_a_contact_of_a_body_with_itself_is_refused(problem):
    i = int(problem.body[7, 0])
    with pytest.raises(contact.ProblemError, match="contact 7 .* is one of a body with itself"):
        contact.solve(replace(problem, body=changed(problem.body, (7, 1), i)))


@pytest.mark.parametrize(
    "name, value, words",
    [
        ("friction", ["rough"] * 2589, "friction holds <U5 and must hold numbers"),
        ("friction", None, r"friction has the shape \(\) and must have \(2589,\)"),
        ("lever", np.zeros((2589, 3)), r"lever has the shape \(2589, 3\) and must have \(2589, 4\)"),
        ("lever", [[1, 2], [3]], "lever (is not an array|has the shape)"),
        ("normal", 1.0, "normal must be an array"),
        ("position", np.zeros((2, 2)), "position has the shape"),
        ("play", np.zeros(7), r"play has the shape \(7,\) and must have \(2589,\)"),
        ("time_step", 0.0, "time_step = 0.0: it must be a positive number of seconds"),
        ("time_step", "soon", "time_step = 'soon'"),
    ],
)
def test_arrays_of_another_kind_are_refused(problem, name, value, words):
    for use in (contact.solve, contact.residual, contact.velocity_changes):
        with pytest.raises(contact.ProblemError, match=words):
            use(replace(problem, **{name: value}))


@pytest.mark.parametrize(
    "settings, words",
    [
        ({"tolerance": float("inf")}, "tolerance = inf: it must be a positive, finite number"),
        ({"tolerance": float("nan")}, "tolerance = nan"),
        ({"tolerance": 0}, "tolerance = 0:"),
        ({"tolerance": "small"}, "tolerance = 'small'"),
        ({"max_iterations": -1}, "max_iterations = -1: it must be a whole number from 0 to 2147483647"),
        ({"max_iterations": 2**40}, "max_iterations = 1099511627776"),
        ({"check_every": 0}, "check_every = 0: it must be a whole number from 1 to 1000000"),
        ({"check_every": 2.5}, "check_every = 2.5"),
        ({"threads": 0}, "threads = 0: it must be a whole number from 1 to 1024"),
        ({"threads": 100000}, "threads = 100000: it must be a whole number from 1 to 1024"),
        ({"method": 3}, "method = 3: it must be a string"),
        ({"method": "newton"}, "method = 'newton': it must be 'accelerated' or 'gaussSeidel'"),
        ({"stopping": "soon"}, "stopping = 'soon': it must be 'naturalMap'"),
        ({"precision": "half"}, "precision = 'half': it must be 'mixed' or 'double'"),
        ({"path": "fast"}, "path = 'fast': it must be 'best'"),
        ({"start": "hot"}, "start = 'hot': it must be 'warm', 'cold' or an array"),
        ({"start": np.zeros((3, 3))}, r"impulse has the shape \(3, 3\) and must have \(2589, 3\)"),
    ],
)
def test_settings_are_refused_by_name(problem, settings, words):
    with pytest.raises(contact.ProblemError, match=words):
        contact.solve(problem, **settings)
