"""Damaged and made-up contact-problem files: each is refused by one message that names the file, or read and solved
right.

Runs without YADE, with the folder ``python`` of the build on PYTHONPATH; ``NONSMOOTH_FUZZ`` is the number of files.
Files are read in a process of its own, which a crash or a hang would end, and what it prints beside its answers (HDF5's
stacks of errors, tracebacks) counts as a failure too.
"""

import json
import os
import queue
import subprocess
import sys
import threading

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

FILES = int(os.environ.get("NONSMOOTH_FUZZ", "200"))
LIMIT = 20  # s for one file
SWEEPS = 20  # whether they solve it or not

WORKER = f"""
import json, sys
import numpy as np
import nonsmooth.contact as contact
for line in sys.stdin:
    path, answer = line.rstrip("\\n"), {{}}
    try:
        problem = contact.load(path)
        answer["loaded"] = len(problem.normal)
        solution = contact.solve(problem, max_iterations={SWEEPS}, tolerance=1e-9)
        answer["reported"], answer["independent"] = solution.relative, contact.residual(problem, solution.impulse).relative
    except contact.ProblemError as error:
        answer["refused"] = str(error)
    except BaseException as error:
        answer["unexpected"] = repr(error)
    print(json.dumps(answer), flush=True)
"""


class Reader:
    """The process that reads files."""

    def __init__(self):
        self.process = subprocess.Popen(
            [sys.executable, "-c", WORKER],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.answers, self.complaints = queue.Queue(), []
        threading.Thread(target=self._collect, daemon=True).start()
        threading.Thread(target=lambda: self.complaints.extend(self.process.stderr), daemon=True).start()

    def _collect(self):
        for line in self.process.stdout:
            self.answers.put(line)
        self.answers.put("")  # it has ended

    def ask(self, path):
        print(path, file=self.process.stdin, flush=True)
        try:
            line = self.answers.get(timeout=LIMIT)
        except queue.Empty:
            self.close()
            raise AssertionError(f"no answer within {LIMIT} s") from None
        assert line, f"the process ended with status {self.process.wait()}: {''.join(self.complaints)}"
        return json.loads(line)

    def close(self):
        self.process.kill()
        self.process.wait()


def _column(disks=12):
    """Disks on top of each other, each a little into the one below, on a fixed one, as arrays."""
    n = disks
    return {
        "bodies/inverse_mass": np.vstack([np.zeros(3), np.tile([1e-3, 1e-3, 8e-3], (n, 1))]),
        "bodies/free_velocity": np.vstack([np.zeros(3), np.tile([0.01, -0.05, 0], (n, 1))]),
        "bodies/velocity": np.zeros((n + 1, 3)),
        "bodies/position": np.column_stack([np.zeros(n + 1), 0.999 * np.arange(n + 1)]),
        "contacts/body": np.column_stack([np.arange(n), np.arange(1, n + 1)]).astype(np.int32),
        "contacts/normal": np.tile([0.0, 1.0], (n, 1)),
        "contacts/lever": np.tile([0, 0.5, 0, -0.5], (n, 1)),
        "contacts/bias": np.tile([-0.04, 0, 0], (n, 1)),
        "contacts/adhesion": np.full(n, 0.1),
        "contacts/friction": np.full(n, 0.3),
        "contacts/rolling_arm": np.full(n, 0.1),
        "contacts/length": np.ones(n),
        "contacts/warm_start": np.full((n, 3), 0.5),
        "contacts/impulse": np.zeros((n, 3)),
    }


NAMES = tuple(_column())


def _write(path, compressed):
    with h5py.File(path, "w") as file:
        file.attrs["format"], file.attrs["dimension"], file.attrs["time_step"] = np.int32(2), np.int32(2), 5e-3
        for name, values in _column().items():
            file.create_dataset(name, data=values, **({"compression": "gzip", "shuffle": True} if compressed else {}))


# ---- damages to the bytes of a file: from content and arguments to other content --------------------


def flip(content, at, value):
    at = int(at * len(content))
    return content[:at] + bytes([value]) + content[at + 1 :]


def zero(content, at, length):
    at = int(at * len(content))
    return content[:at] + bytes(len(content[at : at + length])) + content[at + length :]


def cut(content, at):
    return content[: int(at * len(content))]


def insert(content, at, extra):
    at = int(at * len(content))
    return content[:at] + extra + content[at:]


# ---- damages made by HDF5 in a sound file -----------------------------------------------------------


def without(file, name):
    if name in file:
        del file[name]


def instead(file, name, content):
    """Other values or a link in place of a dataset."""
    without(file, name)
    file[name] = content


def claimed(file, name, rows):
    """A dataset that says it has so many rows and holds none."""
    columns = _column()[name].shape[1:]
    without(file, name)
    file.create_dataset(name, (rows, *columns), _column()[name].dtype, chunks=(1, *columns))


def value(file, name, at, number):
    flat = _column()[name].ravel()
    flat[int(at * (flat.size - 1))] = number
    instead(file, name, flat.reshape(_column()[name].shape))


def attribute(file, name, content):
    if name in file.attrs:
        del file.attrs[name]
    if content is not None:
        file.attrs[name] = content


def damaged(path, compressed=False, inside=(), bytewise=()):
    """A file of the column with these damages, each a function and its arguments."""
    _write(path, compressed)
    with h5py.File(path, "r+") as file:
        for change, *arguments in inside:
            change(file, *arguments)
    content = path.read_bytes()
    for change, *arguments in bytewise:
        content = change(content, *arguments)
    path.write_bytes(content)
    return path


places = st.floats(0, 1)
names = st.sampled_from(NAMES)
numbers = st.one_of(st.floats(allow_nan=True, allow_infinity=True), st.sampled_from([1e308, -1e308, 5e-324, 0.0, -1.0]))
arrays = st.one_of(
    st.tuples(st.integers(0, 14), st.integers(0, 5)).map(np.zeros),
    st.integers(0, 14).map(np.ones),
    st.just(np.float64(1)),
    st.just("text"),
    st.just(np.zeros((12, 3), complex)),
    st.just(np.array([b"a", b"b"])),
    st.just(np.zeros((13, 3), np.int64)),
    st.just(np.zeros((12, 2), np.uint64) + 2**63),
    st.just(np.zeros((12, 2))),
    st.just(np.zeros((2, 2, 2, 2, 2, 2, 2, 2, 2))),
    st.just(np.zeros(3, [("a", "f8"), ("b", "i4")])),
    st.just(np.zeros((13, 3), ">f4")),
)
links = st.sampled_from(
    [h5py.SoftLink("/contacts/impulse"), h5py.SoftLink("/nowhere"), h5py.ExternalLink("/dev/zero", "/x")]
)
attributes = st.one_of(
    st.none(),
    st.integers(-(2**40), 2**40),
    numbers,
    st.just("one"),
    st.just(np.zeros(3)),
    st.just(np.zeros(0)),
    st.just(1 + 2j),
)
inside = st.one_of(
    st.tuples(st.just(without), st.sampled_from((*NAMES, "bodies", "contacts"))),
    st.tuples(st.just(instead), names, st.one_of(arrays, links)),
    st.tuples(st.just(claimed), names, st.sampled_from([1, 13, 10**6, 10**9, 10**12, 2**62])),
    st.tuples(st.just(value), names.filter(lambda name: name != "contacts/body"), places, numbers),
    st.tuples(st.just(value), st.just("contacts/body"), places, st.integers(-(2**31), 2**31 - 1)),
    st.tuples(st.just(attribute), st.sampled_from(["format", "dimension", "time_step"]), attributes),
)
bytewise = st.one_of(
    st.tuples(st.just(flip), places, st.integers(0, 255)),
    st.tuples(st.just(flip), st.floats(0, 0.15), st.integers(0, 255)),
    st.tuples(st.just(zero), places, st.integers(1, 4000)),
    st.tuples(st.just(cut), places),
    st.tuples(st.just(insert), places, st.binary(min_size=1, max_size=50)),
)


@pytest.fixture(scope="module")
def reader():
    process = Reader()
    yield process
    process.close()


def _judge(answer, path, complaints):
    """Fails unless it is a message or a right result."""
    assert "unexpected" not in answer, answer
    assert not complaints, "".join(complaints)
    if "refused" in answer:
        text = answer["refused"]
        assert text.startswith("contact problem") and "\n" not in text and len(text) < 500, text
        assert "loaded" in answer or str(path) in text, text  # what is wrong with the file names it
        return
    reported, independent = answer["reported"], answer["independent"]
    # one formula, summed in two orders; what overflows has no residual in either
    assert reported == pytest.approx(independent, rel=1e-6, abs=1e-9) or not (
        np.isfinite(reported) and np.isfinite(independent)
    ), answer


def test_an_undamaged_file_is_read_and_solved(reader, tmp_path):
    for compressed in (False, True):
        path = tmp_path / f"{compressed}.h5"
        _write(path, compressed)
        answer = reader.ask(path)
        assert answer["loaded"] == 12 and 0 < answer["reported"] < 1, answer
        _judge(answer, path, reader.complaints)


@settings(max_examples=FILES, derandomize=True, deadline=None, database=None, suppress_health_check=list(HealthCheck))
@given(
    compressed=st.booleans(),
    changes=st.one_of(
        st.tuples(st.lists(inside, min_size=1, max_size=2), st.just([])),
        st.tuples(st.lists(inside, max_size=1), st.lists(bytewise, min_size=1, max_size=4)),
    ),
)
def test_damaged_files_are_refused_or_solved(reader, tmp_path_factory, compressed, changes):
    path = damaged(tmp_path_factory.getbasetemp() / "damaged.h5", compressed, *changes)
    _judge(reader.ask(path), path, reader.complaints)


@pytest.mark.parametrize(
    "words, change",
    [
        (
            "/contacts/normal says that it has 1000000000000 rows, which are not in the file",
            (claimed, "contacts/normal", 10**12),
        ),
        ("/bodies/velocity says that it has 12 rows, which are not in the file", (claimed, "bodies/velocity", 12)),
        ("/contacts/body must hold whole numbers", (instead, "contacts/body", np.zeros((12, 2)))),
        ("/contacts/friction must hold floating-point numbers", (instead, "contacts/friction", "text")),
        ("/contacts/friction has 11 rows where 12 are needed", (instead, "contacts/friction", np.zeros(11))),
        ("/contacts/friction must have 1 column(s)", (instead, "contacts/friction", np.zeros((12, 1)))),
        ("has no dataset /contacts/normal", (without, "contacts")),
        ("has no dataset /contacts/lever", (instead, "contacts/lever", h5py.SoftLink("/nowhere"))),
        ("contact 11 names body 13: there are 13, counted from 0", (value, "contacts/body", 1, 13)),
        ("contact 11 names body -1", (value, "contacts/body", 1, -1)),
        ("is not a contact problem of format 1 or 2, but of 3", (attribute, "format", 3)),
        ("has the dimension 4: it must be 2 or 3", (attribute, "dimension", 4)),
        ("has no attribute dimension", (attribute, "dimension", None)),
        ("/contacts/normal must have 3 column(s)", (attribute, "dimension", 3)),
        ("has no usable attribute format", (attribute, "format", "one")),
        ("has no attribute format", (attribute, "format", None)),
        ("has no usable attribute time_step", (attribute, "time_step", np.zeros(3))),
        ("has the time_step nan: it must be positive and finite", (attribute, "time_step", float("nan"))),
        # by the solver
        ("body 0 has the position (nan, 0): it must be finite", (value, "bodies/position", 0, float("nan"))),
    ],
)
def test_messages(reader, tmp_path, words, change):
    path = damaged(tmp_path / "step.h5", inside=[change])
    answer = reader.ask(path)
    assert words in answer.get("refused", ""), answer
    _judge(answer, path, reader.complaints)


def test_half_a_file_is_none(reader, tmp_path):
    path = damaged(tmp_path / "step.h5", bytewise=[(cut, 0.5)])
    assert f"{path}: cannot be read as an HDF5 file" in reader.ask(path)["refused"]
