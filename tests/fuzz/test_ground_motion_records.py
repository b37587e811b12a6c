"""Records of earthquakes broken in many ways: each gives a GroundMotion or a GroundMotionError of one line that names
the file, within 20 s. Needs no YADE.

NONSMOOTH_FUZZ_MOTIONS: how many files (default: a share of CI's time); the same ones each time.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))
import fuzzing  # noqa: E402
from nonsmooth import ground_motion  # noqa: E402

AT2 = (
    "MADE UP FOR A TEST\nNOWHERE, HILL, 090\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  12, DT=   .0050 SEC,\n"
    + "  -.1234567E-01   .2345678E-01   .1000000E+00  -.3000000E+00\n" * 3
)
CSV = "# made up\ntime_s,horizontal_m_per_s2,vertical_g\n" + "".join(f"{k / 100},{k / 10},-0.0{k}\n" for k in range(12))
PARTS = st.one_of(
    st.binary(max_size=6),
    st.sampled_from(
        [b",", b";", b"\n", b"\r", b"\t", b" ", b"#", b'"', b"=", b"NPTS", b"DT", b"-", b"e9", b"nan", b"\x00", b"\xff\xfe",
         b"UNITS OF", b"\xe2\x80\xa8", b"\xd9\xa3", b"time_s", b"1e-320", b"9" * 400, b"_", b"0x"]
    ),
)  # fmt: skip
CHANGES = st.lists(
    st.tuples(st.sampled_from(["put", "drop", "cut", "twice"]), st.integers(0, 400), st.integers(1, 80), PARTS),
    min_size=1,
    max_size=4,
)


def changed(raw, changes):
    for kind, at, length, part in changes:
        at = min(at, len(raw))
        if kind == "put":
            raw = raw[:at] + part + raw[at:]
        elif kind == "drop":
            raw = raw[:at] + raw[at + length :]
        elif kind == "cut":
            raw = raw[:at]
        else:
            raw = raw[: at + length] + raw[at:]
    return raw


def check(raw, name):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_bytes(raw)
        with fuzzing.at_most(20):
            try:
                made = ground_motion.read(path)
            except ground_motion.GroundMotionError as error:
                message = str(error)
                assert message.startswith(f"{path}: ") and message.isprintable() and 40 < len(message) < 800, message
                return
        assert (np.diff(made.times) > 0).all() and np.isfinite(made.drift.displacement).all() and made.describe()


@fuzzing.settings("NONSMOOTH_FUZZ_MOTIONS", 150)
@given(st.sampled_from(["a.AT2", "a.csv", "a"]), st.booleans(), CHANGES)
def test_changed_bytes(name, at2, changes):
    check(changed((AT2 if at2 else CSV).encode(), changes), name)


@fuzzing.settings("NONSMOOTH_FUZZ_MOTIONS", 50, share=1 / 3)
@given(st.sampled_from(["a.AT2", "a.csv"]), st.binary(max_size=200))
def test_any_bytes(name, raw):
    check(raw, name)
