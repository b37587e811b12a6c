"""Packing files broken in many ways: each gives a packing of the section or a PackingError of one line that names the
file, within 20 s. Needs no YADE.

NONSMOOTH_FUZZ_PACKINGS: how many files (default: a share of CI's time); the same ones each time.
"""

import sys
import tempfile
from functools import cache
from pathlib import Path

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))
import fuzzing  # noqa: E402
from nonsmooth import packing, packing_files  # noqa: E402
from nonsmooth.packing import checks as packing_checks  # noqa: E402
from nonsmooth.section import load  # noqa: E402

WORDS = [
    "nan",
    "-inf",
    "1e308",
    "-1e308",
    "1e-320",
    "0",
    "-1",
    "1e7",
    "1_0",
    "0x10",
    "one",
    "9" * 400,
    "9" * 5000,
    "1.0.0",
    "٣",
    "1,5",
    "5.5",
    "",
    "#",
    "# disks: 3",
    "\x00",
    "\u2028",
    "\x1b[2J",
    "x" * 3000,
    "1 2 3 4 5 6",
]


@cache
def made():
    """A section with few disks, its packing, and the lines of its file."""
    section = load("jiufengershan").with_disks(600)
    disks = packing.pack(section, 1)
    with tempfile.TemporaryDirectory() as folder:
        packing.write_text(disks, Path(folder) / "p.txt")
        return section, disks, (Path(folder) / "p.txt").read_text().splitlines()


def outcome(raw, suffix, read):
    """The packing that ``read`` makes of a file, or None where it is refused as it should be."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"p.{suffix}"
        path.write_bytes(raw)
        with fuzzing.at_most(20):
            try:
                return read(path)
            except packing.PackingError as error:
                message = str(error)
                assert (
                    str(path) in message and "\n" not in message and message.isprintable() and len(message) < 1000
                ), message
                return None


LINE = st.integers(0, 601)
CHANGES = st.one_of(
    st.tuples(
        st.just("word"),
        LINE,
        st.integers(0, 3),
        st.one_of(st.sampled_from(WORDS), st.floats().map(repr), st.integers().map(str)),
    ),
    st.tuples(
        st.just("scale"),
        st.integers(0, 3),
        st.one_of(st.sampled_from([1.3, -1, 0, 1e-3, 1e3, 1e300, 0.99, 1.01]), st.floats(-3, 3)),
        st.none(),
    ),
    st.tuples(
        st.just("shift"),
        st.integers(0, 3),
        st.one_of(st.sampled_from([1, -1, 1e3, -1e9]), st.floats(-30, 30)),
        st.none(),
    ),
    st.tuples(st.just("take"), LINE, st.integers(1, 400), st.none()),
    st.tuples(st.just("twice"), LINE, st.integers(1, 50), st.none()),
    st.tuples(st.just("column"), st.integers(0, 3), st.none(), st.none()),
    st.tuples(st.just("cut"), st.integers(0, 40_000), st.none(), st.none()),
    st.tuples(st.just("put"), st.integers(0, 40_000), st.binary(min_size=1, max_size=5), st.none()),
)


def altered(lines, kind, at, what, word):
    """The file's lines after a change."""
    rows = [line.split() for line in lines]
    if kind == "word":
        if at < len(rows) and what < len(rows[at]):
            rows[at][what] = word
    elif kind == "take":
        del rows[at : at + what]
    elif kind == "twice":
        rows[at:at] = rows[at : at + what]
    elif kind == "column":
        rows = [row[:at] + row[at + 1 :] for row in rows]
    elif kind in ("scale", "shift"):
        for row in rows:
            try:
                row[at] = repr(float(row[at]) * what if kind == "scale" else float(row[at]) + what)
            except (ValueError, IndexError):
                continue
            if at == 3 and row[at].endswith(".0"):
                row[at] = row[at][:-2]
    return [" ".join(row) for row in rows]


@fuzzing.settings("NONSMOOTH_FUZZ_PACKINGS", 60, share=2 / 3)
@given(st.lists(CHANGES, min_size=1, max_size=3), st.booleans())
@example([("word", 5, 3, "9" * 30)], True)
@example([("word", 5, 3, "9" * 5000)], False)
@example([("word", 5, 0, "1e308")], True)
@example([("scale", 2, 1e300, None)], True)
@example([("scale", 0, 0, None), ("scale", 1, 0, None)], True)  # all at one place
def test_changed_text(changes, announced):
    section, _, lines = made()
    lines = lines if announced else lines[2:]
    raw = None
    for kind, at, what, word in changes:
        if kind in ("cut", "put"):
            raw = "\n".join(lines).encode() if raw is None else raw
            raw = raw[:at] + (what + raw[at:] if kind == "put" else b"")
        elif raw is None:
            lines = altered(lines, kind, at, what, word)
    raw = "\n".join(lines).encode() if raw is None else raw

    def read(path):
        found = packing.read_text(path)
        packing_checks.check(found, section, path)
        return found

    found = outcome(raw, "txt", read)
    if found is not None:  # what is taken can be run: measured by rules of its own
        assert (
            abs((found.r**2).sum() / (made()[1].r ** 2).sum() - 1) < 0.15
            and packing.overlaps(found).worst <= 0.02
            and set(found.layer.tolist()) <= set(range(5))
        )


@fuzzing.settings("NONSMOOTH_FUZZ_PACKINGS", 40, share=1 / 3)
@given(
    st.lists(
        st.tuples(
            st.sampled_from(["flip", "cut", "drop", "put"]),
            st.floats(0, 1),
            st.integers(0, 7),
            st.binary(min_size=1, max_size=9),
        ),
        min_size=1,
        max_size=3,
    )
)
def test_damaged_arrays(changes):
    """One that was made before, from the cache: what is taken is what was written."""
    disks = made()[1]
    with tempfile.TemporaryDirectory() as folder:
        packing.save(disks, Path(folder) / "p.npz")
        file = (Path(folder) / "p.npz").read_bytes()
    for kind, share, bit, what in changes:
        at = int(share * max(len(file) - 1, 0))
        if kind == "flip" and file:
            file = file[:at] + bytes([file[at] ^ (1 << bit)]) + file[at + 1 :]
        elif kind == "cut":
            file = file[:at]
        elif kind == "drop":
            file = file[:at] + file[at + 1 + bit :]
        elif kind == "put":
            file = file[:at] + what + file[at:]
    found = outcome(file, "npz", packing_files.load)
    assert found is None or found.checksum == disks.checksum


def test_every_bit_of_a_directory():
    """The end of an .npz says where its arrays are, and how packed: zipfile lets through what it makes of a damaged
    one.
    """
    small = packing.Packing(np.arange(20.0), np.zeros(20), np.full(20, 0.4), np.zeros(20))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "p.npz"
        packing.save(small, path)
        whole = path.read_bytes()
        for at in range(len(whole) - 380, len(whole)):
            for bit in range(8):
                path.write_bytes(whole[:at] + bytes([whole[at] ^ (1 << bit)]) + whole[at + 1 :])
                try:
                    assert packing_files.load(path).checksum == small.checksum
                except packing.PackingError as error:
                    assert str(path) in str(error) and "\n" not in str(error)
