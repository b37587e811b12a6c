"""Section files broken in many ways: each gives a Section or a SectionError of one line that names the file, within
20 s. Needs no YADE.

NONSMOOTH_FUZZ_SECTIONS: how many files (default: a share of CI's time); the same ones each time.
"""

import copy
import sys
import tempfile
from pathlib import Path

import yaml
from hypothesis import given
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))
import fuzzing  # noqa: E402
from nonsmooth.section import FOLDER, Section, SectionError, load  # noqa: E402

TEXT = (FOLDER / "jiufengershan.yaml").read_text(encoding="utf-8")
DATA = yaml.safe_load(TEXT)

# What people and scripts write by mistake, and what breaks programs. Text that begins with @ goes into the file as it
# is.
HOSTILE = [
    None,
    True,
    "",
    "x",
    "DP",
    "rock",
    [],
    {},
    [[]],
    [1],
    [1, 2, 3],
    {"x": 1},
    0,
    1,
    -1,
    2,
    300.0,
    0.5,
    -0.0,
    1e-300,
    5e-324,
    1e-6,
    1e6,
    1e18,
    1e19,
    1e308,
    -1e308,
    float("inf"),
    float("-inf"),
    float("nan"),
    2**31,
    2**63,
    10**12,
    10**400,
    -(10**400),
    "@" + "9" * 5000,
    "@0x10",
    "@1_000",
    "@1:30",
    "@010",
    "@.5e3",
    "@1e400",
    "@!!int x",
    "@!!binary AAAA",
    "@!!set {a, b}",
    "@2020-01-02",
    "@*rock",
    "@*nothing",
    "@&again [*again]",
    "@&rock {}",
    "@<<",
    "@- 1",
    "@? [1]",
    "@{[1]: 2}",
    "@{a: 1, a: 2}",
    "@" + "[" * 60 + "]" * 60,
    "@" + "[" * 3000,
    "@!!python/object:os.system x",
    "\x1b[2J",
    "a\nb",
    "\u2028",
    "long " * 50,
    [1e7, 1e7],
    [0.0, 0.0],
    [[0, 0], [1, 0]],
    [[0.0, 0.0], [1e-9, 0.0], [0.0, 1e-9]],
    "motion",
    "linear",
    "uniform_by_number",
    "@\ud7ff",
]


def places(value, path=()):
    """Paths of all keys and items, depth first."""
    found = []
    for key, below in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        found += [(*path, key), *places(below, (*path, key))]
    return found


PLACES = places(DATA)
NUMBERS = st.one_of(st.floats(), st.integers(), st.floats(-10, 10), st.integers(0, 10))
VALUES = st.one_of(st.sampled_from(HOSTILE), NUMBERS, st.text(max_size=20))
CHANGES = st.one_of(
    st.tuples(st.just("set"), st.sampled_from(PLACES), VALUES),
    st.tuples(
        st.just("scale"),
        st.sampled_from(PLACES),
        st.one_of(st.floats(-2, 3), st.sampled_from([1e-3, 1e3, -1, 0, 1e-9, 1e9])),
    ),
    st.tuples(st.just("take"), st.sampled_from(PLACES), st.none()),
    st.tuples(st.just("twice"), st.sampled_from(PLACES), st.none()),
    st.tuples(st.just("swap"), st.sampled_from(PLACES), st.sampled_from(PLACES)),
    st.tuples(
        st.just("turn"),
        st.sampled_from([p for p in PLACES if p[-1] in ("vertices", "walls", "layers", "diameter")]),
        st.none(),
    ),
)
BYTES = st.one_of(
    st.tuples(st.just("cut"), st.integers(0, len(TEXT)), st.none()),
    st.tuples(
        st.just("put"),
        st.integers(0, len(TEXT)),
        st.one_of(
            st.binary(max_size=6), st.sampled_from([b"\t", b"\x00", b"\xff\xfe", b": ", b"- ", b"&rock ", b"*rock "])
        ),
    ),
    st.tuples(st.just("drop"), st.integers(0, len(TEXT)), st.integers(1, 200)),
)


def holder(data, path):
    """The list or map with the last key of a path, and that key; None where an earlier change has taken it away."""
    for key in path[:-1]:
        try:
            data = data[key]
        except (KeyError, IndexError, TypeError):
            return None, None
    there = (
        path[-1] in data
        if isinstance(data, dict)
        else isinstance(data, list) and isinstance(path[-1], int) and path[-1] < len(data)
    )
    return (data, path[-1]) if there else (None, None)


def scaled(value, factor):
    """All numbers of a value by a factor."""
    if isinstance(value, list):
        return [scaled(v, factor) for v in value]
    return value * factor if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def change(data, kind, path, what):
    place, key = holder(data, path)
    if place is None:
        return
    if kind == "set":
        place[key] = what
    elif kind == "scale":
        place[key] = scaled(place[key], what)
    elif kind == "take":
        del place[key]
    elif kind == "twice":
        if isinstance(place, list):
            place.insert(key, copy.deepcopy(place[key]))
        else:
            place[f"{key}-2"] = copy.deepcopy(place[key])
    elif kind == "swap":
        other, its = holder(data, what)
        if other is not None:
            place[key], other[its] = copy.deepcopy(other[its]), copy.deepcopy(place[key])
    elif isinstance(place[key], list):
        place[key].reverse()


def written(data):
    """YAML with what begins with @ as it is."""

    class Dumper(yaml.SafeDumper):
        def ignore_aliases(self, data):
            return True

    raw = {}

    def put(dumper, text):
        if not text.startswith("@"):
            return yaml.SafeDumper.represent_str(dumper, text)
        raw[f"RAW{len(raw)}WAR"] = text[1:]
        return dumper.represent_scalar("tag:yaml.org,2002:str", f"RAW{len(raw) - 1}WAR")

    Dumper.add_representer(str, put)
    text = yaml.dump(data, Dumper=Dumper, sort_keys=False, allow_unicode=True)
    for mark, own in raw.items():
        text = text.replace(mark, own)
    return text


def check(raw: bytes):
    """One line that names the file, or a section that keeps its own rules."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "slope.yaml"
        path.write_bytes(raw)
        with fuzzing.at_most(20):
            try:
                made = load(path)
                assert isinstance(made, Section)
                counts = made.disk_counts()
                assert min(counts) >= 1 and sum(counts) <= 10_000_000 and made.dip > -0.01 and made.key("settled")
            except SectionError as error:
                message = str(error)
                assert (
                    str(path) in message and "\n" not in message and message.isprintable() and 20 < len(message) < 1500
                ), message


@fuzzing.settings("NONSMOOTH_FUZZ_SECTIONS", 150)
@given(st.lists(CHANGES, min_size=1, max_size=4))
def test_changed_values(changes):
    data = copy.deepcopy(DATA)
    for kind, path, what in changes:
        change(data, kind, path, what)
    check(written(data).encode("utf-8", "surrogatepass"))


@fuzzing.settings("NONSMOOTH_FUZZ_SECTIONS", 50, share=1 / 3)
@given(st.lists(BYTES, min_size=1, max_size=3))
def test_changed_bytes(changes):
    raw = TEXT.encode()
    for kind, at, what in changes:
        raw = (
            raw[:at] if kind == "cut" else raw[:at] + what + raw[at:] if kind == "put" else raw[:at] + raw[at + what :]
        )
    check(raw)
