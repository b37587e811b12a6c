"""Records of earthquakes from files: what is read, and what is refused in one line. All files are made up. Needs no
YADE.
"""

import random
import re

import numpy as np
import pytest

import synthetic_slope as package

motions, errors = package.load("model.ground_motion"), package.load("errors")
G = 9.80665
HEADER = ("MADE UP FOR A TEST", "NOWHERE 01/01/00, HILL, 090", "ACCELERATION TIME SERIES IN UNITS OF G")
NPTS = "NPTS=  {n}, DT=   .0050 SEC,"


def numbers(n=23, seed=1):
    return np.round(np.random.RandomState(seed).normal(scale=0.1, size=n), 7)


def at2(values=None, header=HEADER, npts=NPTS, row=5):
    """The text of a .AT2 file."""
    values = numbers() if values is None else values
    rows = ["".join(f"{value:15.7E}" for value in values[k : k + row]) for k in range(0, len(values), row)]
    return "\n".join([*header, npts.format(n=len(values)), *rows]) + "\n"


def csv(head="time_s,horizontal_m_per_s2,vertical_g", n=23, dt=0.01):
    h, v = numbers(n), numbers(n, 2)
    rows = [f"{k * dt:.4f},{a!r},{b!r}" for k, (a, b) in enumerate(zip(h.tolist(), v.tolist()))]
    return "\n".join([head, *rows]) + "\n"


@pytest.fixture
def read(tmp_path):
    """Reads a text, or bytes, as a file of a name."""

    def of(text, name="hill.AT2", **options):
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return motions.read(tmp_path / name, **options)

    return of


# ---- what is read ---------------------------------------------------------------------------------------


def test_an_at2_file_has_its_numbers_and_its_name(read):
    motion = read(at2())
    assert motion.horizontal == pytest.approx(G * numbers(), rel=1e-15) and not motion.vertical.any()
    assert motion.times == pytest.approx(0.005 * np.arange(23), abs=1e-15)
    assert motion.name == "NOWHERE 01/01/00, HILL, 090" and motion.source == "hill.AT2"


@pytest.mark.parametrize(
    "line",
    [
        "NPTS=  23, DT=   .0050 SEC,",
        "NPTS= 23, DT= .005 SEC",
        "NPTS=    23  DT=  0.0050 SEC,",
        "NPTS=23,DT=5.0E-03",
        "npts = 23, dt = 0.0050 sec",
        "NPTS: 23, DT: .005 s",
        "DT= .0050 SEC, NPTS= 23",
        "DT= .0050 NPTS= 23",
        "    23    0.0050    NPTS, DT",
        "  23   .0050   NPTS, DT",
        "23, 0.005, NPTS, DT",
        "NPTS=  23, DT=   .0050 SEC, FILTERED",
    ],
)
def test_the_number_and_the_step_in_all_their_spellings(read, line):
    motion = read(at2(npts=line))
    assert len(motion.times) == 23 and motion.times[1] == 0.005


@pytest.mark.parametrize(
    "told, factor",
    [
        ("ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.05 Hz LP=40.0 Hz", G),
        ("acceleration time series in units of g", G),
        ("ACCELERATION TIME SERIES IN UNITS OF CM/S/S", 0.01),
        ("ACCELERATION, UNITS: CM/SEC/SEC", 0.01),
        ("ACCELERATION UNITS = cm/sec**2", 0.01),
        ("UNITS OF GAL", 0.01),
        ("UNITS OF M/S^2", 1.0),
        ("ACCELERATION IN UNITS OF m/s2", 1.0),
    ],
)
def test_units_of_a_header(read, told, factor):
    motion = read(at2(header=(*HEADER[:2], told)))
    assert motion.horizontal == pytest.approx(factor * numbers(), rel=1e-14)


def test_a_unit_is_stated_where_the_file_has_none_and_may_agree_with_the_files(read):
    silent = at2(header=HEADER[:2])
    for unit, factor in motions.UNITS.items():
        assert read(silent, unit=unit).horizontal == pytest.approx(factor * numbers(), rel=1e-14)
    assert read(at2(), unit="g").horizontal == pytest.approx(G * numbers())
    with pytest.raises(motions.GroundMotionError, match="unit 'gal', and the file says 'G'; leave the unit out"):
        read(at2(), unit="gal")
    assert read(at2(header=(*HEADER[:2], "UNITS OF CM/S2")), unit="gal").horizontal[0] == pytest.approx(
        0.01 * numbers()[0]
    )


def test_rows_of_any_length_ends_of_lines_of_any_system_and_other_names(read):
    wanted = read(at2()).horizontal
    for text, name in (
        (at2(row=8), "a.AT2"), (at2(row=1), "a.at2"), (at2().replace("\n", "\r\n"), "a.AT2"), (at2() + "\n\n", "a.AT2"),
        (at2().replace("\n", "\r"), "a.AT2"), ("\ufeff" + at2(), "a.AT2"), (at2().replace(" ", "\t"), "a.AT2"),
        (at2(), "a.txt"), (at2(), "a"), (at2(header=("FIRST", *HEADER)), "a.AT2"),
    ):  # fmt: skip
        assert np.array_equal(read(text, name=name).horizontal, wanted), name


def test_a_name_is_the_files_where_the_header_has_none(read):
    assert read(at2(header=()), unit="g").name == "hill" and read(at2(), name="hill.AT2").name == HEADER[1]
    assert read(csv(), name="valley.csv").name == "valley"


def test_two_components(read, tmp_path):
    (tmp_path / "up.AT2").write_text(at2(numbers(seed=2)))
    motion = read(at2(), vertical=tmp_path / "up.AT2")
    assert motion.horizontal == pytest.approx(G * numbers()) and motion.vertical == pytest.approx(G * numbers(seed=2))
    assert motion.source == "hill.AT2, up.AT2"
    (tmp_path / "up.AT2").write_text(at2(numbers(22)))
    message = "up.AT2: 22 values at 0.005 s, and hill.AT2 has 23 at 0.005 s; give two components of one record$"
    with pytest.raises(motions.GroundMotionError, match=message):
        read(at2(), vertical=tmp_path / "up.AT2")
    (tmp_path / "up.AT2").write_text(at2(npts="NPTS= {n}, DT= .01 SEC"))
    with pytest.raises(motions.GroundMotionError, match="up.AT2: 23 values at 0.01 s, and hill.AT2 has 23 at 0.005 s"):
        read(at2(), vertical=tmp_path / "up.AT2")
    with pytest.raises(motions.GroundMotionError, match="up.AT2: comes beside the CSV file a.csv; give the vertical"):
        read(csv(), name="a.csv", vertical=tmp_path / "up.AT2")


def test_a_csv_has_its_units_in_its_head(read):
    motion = read("# made up\n\n" + csv(), name="a.csv")
    assert motion.horizontal == pytest.approx(numbers()) and motion.vertical == pytest.approx(G * numbers(seed=2))
    assert motion.times == pytest.approx(0.01 * np.arange(23))
    turned = read(csv("time_s, vertical_cm_per_s2 ,horizontal_gal"), name="a.csv")
    assert turned.vertical == pytest.approx(0.01 * numbers()) and turned.horizontal == pytest.approx(
        0.01 * numbers(23, 2)
    )
    one = read("time_s,vertical_g\n0,0.1\n0.01,0.2\n", name="a.txt")
    assert not one.horizontal.any() and one.vertical == pytest.approx([0.1 * G, 0.2 * G])
    assert read('"time_s","horizontal_g"\r\n0,1\r\n.5,-1\r\n', name="a.csv").times.tolist() == [0, 0.5]


def test_steps_that_differ_are_a_gap_unless_they_are_meant(read):
    """A step of one and a half and more misses a value, whatever digits the times are rounded to."""
    lines = csv().splitlines()
    cut = "\n".join([*lines[:8], *lines[9:]])
    with pytest.raises(
        motions.GroundMotionError,
        match="a.csv: line 9: a gap: 0.02 s from 0.06 s to 0.08 s, where steps are 0.01 s; mend",
    ):
        read(cut, name="a.csv")
    assert len(read(cut, name="a.csv", uneven=True).times) == 22
    more = "\n".join([*lines[:8], "0.0640,0,0", *lines[8:]])
    with pytest.raises(motions.GroundMotionError, match="line 9: a value too many: 0.004 s from 0.06 s to 0.064 s"):
        read(more, name="a.csv")
    rounded = "time_s,horizontal_g\n" + "".join(f"{round(k / 256, 3)},0.1\n" for k in range(50))
    assert len(read(rounded, name="a.csv").times) == 50
    slow = "time_s,horizontal_g\n0,1\n5,1\n"
    with pytest.raises(motions.GroundMotionError, match="steps of 5 s; give times in seconds, or uneven=True"):
        read(slow, name="a.csv")
    assert read(slow, name="a.csv", uneven=True).duration == 5


# ---- what is refused ------------------------------------------------------------------------------------

BAD_AT2 = [
    (at2(npts="NPTS= 24, DT= .005 SEC"), "line 4: NPTS says 24 values, and 23 follow; restore"),
    (at2(npts="NPTS= 22, DT= .005 SEC"), "line 4: NPTS says 22 values, and 23 follow"),
    (at2(npts="NPTS= 1, DT= .005 SEC"), "line 4: NPTS '1'; give the number of values, 2 or more"),
    (at2(npts="NPTS= -23, DT= .005 SEC"), "NPTS '-23'; give"),
    (at2(npts="NPTS= 23.0, DT= .005 SEC"), "NPTS '23.0'; give"),
    (at2(npts="NPTS= , DT= .005 SEC"), "NPTS ''; give"),
    (at2(npts="NPTS= 23, DT= -.005 SEC"), "line 4: DT -.005; give the step in seconds, above 0 and at most 1"),
    (at2(npts="NPTS= 23, DT= 0 SEC"), "DT 0; give the step"),
    (at2(npts="NPTS= 23, DT= 5 SEC"), "DT 5; give the step"),
    (at2(npts="NPTS= 23, DT= 5.0 MSEC"), "DT is in 'MSEC'; give DT in seconds"),
    (at2(npts="NPTS= 23, DT= NAN SEC"), "DT 'NAN' is not finite"),
    (at2(npts="NPTS= 23, DT= ,005 SEC"), "DT '' is no number"),
    (at2(npts="NPTS= 23"), "line 4: NPTS and DT cannot be told from 'NPTS= 23'; give NPTS= 4000, DT= .0050 SEC"),
    (at2(npts="NPTS= 23, NPTS= 23, DT= .005"), "NPTS and DT cannot be told from"),
    (at2(npts="23 POINTS AT .005 SEC"), "none of its first 10 lines has NPTS; give a line such as"),
    (at2(header=HEADER[:2]), "does not say the unit of its values; give unit, one of m/s2, g, cm/s2, gal"),
    (at2(header=(*HEADER[:2], "IN UNITS OF FT/S/S")), "line 3: the unit 'FT/S/S' is not known; give one of"),
    (at2(header=(*HEADER[:2], "VELOCITY TIME SERIES IN UNITS OF CM/S")), "line 3: holds no acceleration: 'VELOCITY"),
    (at2(header=(*HEADER[:2], "DISPLACEMENT TIME SERIES IN UNITS OF G")), "holds no acceleration"),
    (at2() + " END\n", "line 10: acceleration 'END' is no number; give numbers such as"),
    (at2().replace("E-", "D-"), "line 5: acceleration '1.6243450D-01' is no number"),
    (at2(np.r_[numbers(22), np.nan]), "line 9: acceleration 'NAN' is not finite; repair the record there"),
    (at2(np.r_[np.inf, numbers(22)]), "line 5: acceleration 'INF' is not finite"),
    (at2(np.r_[100.0, numbers(22)]), "line 5: acceleration '1.0000000E\\+02' in g is 100 g, more than 10; correct the unit"),
    (at2().replace("\n  ", "\n  1e400 ", 1), "acceleration '1e400' is not finite"),
    (at2().replace("\n  ", "\n  1_000 ", 1), "acceleration '1_000' is no number"),
    (at2().replace("\n  ", "\n  0.1-0.2 ", 1), "acceleration '0.1-0.2' is no number"),
    (at2().replace("\n  ", "\n  ******** ", 1), r"acceleration '\*+' is no number"),
    ("", "is empty; give a .AT2 or a CSV"),
    (" \n\n", "is empty"),
    (b"\x00\x01\x02" * 50, "line 1: bytes that are no text, as of a binary file"),
    (at2().encode("utf-16"), "byte 0 is no text|bytes that are no text"),
    (at2().encode()[:100] + b"\xff" + at2().encode()[100:], "byte 100 is no text; give a text file"),
]  # fmt: skip
HEAD = "time_s,horizontal_g\n"
BAD_CSV = [
    ("time,horizontal_g\n0,1\n1,1\n", "line 1: column 'time': times have the unit s; give time_s"),
    ("time_ms,horizontal_g\n0,1\n1,1\n", "column 'time_ms': times have the unit s"),
    ("time_s,horizontal\n0,1\n1,1\n", "line 1: column 'horizontal' has no unit of an acceleration; give one of horizontal_m_per_s2, horizontal_g"),
    ("time_s,vertical_m_per_s\n0,1\n1,1\n", "column 'vertical_m_per_s' has no unit"),
    ("time_s,accel_g\n0,1\n1,1\n", "column 'accel_g' is not known; give a head such as time_s,horizontal_m_per_s2,vertical_g"),
    ("time_s;horizontal_g\n0;1\n1;1\n", "column 'time_s;horizontal_g': times have the unit s"),
    ("time_s,horizontal_g,horizontal_gal\n0,1,1\n1,1,1\n", "the columns are 'time_s, horizontal_g, horizontal_gal'; give time_s and"),
    ("horizontal_g,vertical_g\n0,1\n1,1\n", "the columns are 'horizontal_g, vertical_g'; give time_s"),
    ("time_s\n0\n1\n", "the columns are 'time_s'; give time_s and"),
    ("0,1\n1,1\n", "line 1: column '0' is not known; give a head"),
    ("# nothing\n", "holds no record; give a head"),
    (HEAD, "0 lines of values; give two or more"),
    (HEAD + "0,1\n", "1 lines of values; give two or more"),
    (HEAD + "0,0.1\n0.1\n", "line 3: 1 values under 2 columns; give one value for each"),
    (HEAD + "0,0.1\n0,1,0,2\n", "line 3: 4 values under 2 columns; give one value"),
    (HEAD + "0,0.1\n0.1,\n", "line 3: acceleration '' is no number"),
    (HEAD + "0,0.1\n0.1,nan\n", "line 3: acceleration 'nan' is not finite; repair"),
    (HEAD + "0,0.1\nNaN,0.1\n", "line 3: time 'NaN' is not finite"),
    (HEAD + "0,0.1\n0.1,-\n", "line 3: acceleration '-' is no number"),
    (HEAD + "0,0.1\n# c\n\n0.1,12\n", "line 5: acceleration '12' in g is 12 g, more than 10; correct the unit"),
    (HEAD + "1e7,0.1\n10000000.1,0.1\n", r"times\[0\] 1e\+07: give s, at most 1e\+06"),
    (HEAD + "0,0.1\n0.2,0.1\n0.1,0.1\n", "line 4: time 0.1 s comes after 0.2 s; give times that rise"),
    (HEAD + "0,0.1\n0.2,0.1\n0.2,0.1\n", "line 4: time 0.2 s comes after 0.2 s"),
    (HEAD + "0,0.1\n0.1,0.1\n0.2,0.1\n0.5,0.1\n", "line 5: a gap: 0.3 s from 0.2 s to 0.5 s, where steps are 0.1 s"),
]  # fmt: skip


@pytest.mark.parametrize(
    "name, text, message", [("a.AT2", *one) for one in BAD_AT2] + [("a.csv", *one) for one in BAD_CSV]
)
def test_what_is_damaged_is_told_in_one_line(read, tmp_path, name, text, message):
    with pytest.raises(motions.GroundMotionError) as refusal:
        read(text, name=name)
    told = str(refusal.value)
    assert told.startswith(f"{tmp_path / name}: ") and "\n" not in told and re.search(message, told), told


def test_arguments_of_another_kind_and_files_that_cannot_be_read(tmp_path):
    for options, message in (
        (dict(path=None), "path None: give the path of a .AT2 or a CSV file"),
        (dict(path="x.AT2", unit="ft/s2"), "unit 'ft/s2': give one of m/s2, g, cm/s2, gal"),
        (dict(path="x.AT2", vertical=3), "vertical 3: give the path"),
        (dict(path="x.AT2", uneven=1), "uneven 1: give True"),
        (dict(path="x.AT2", name=3), "name 3: give words"),
        (dict(path=tmp_path / "none.AT2"), ".*none.AT2: cannot be read .No such file.*; give a text file"),
        (dict(path=tmp_path), ".*: cannot be read .Is a directory"),
        (dict(path="a\0b"), ".*cannot be read"),
        (dict(path="/dev/zero"), "/dev/zero: has no end"),
    ):
        with pytest.raises(motions.GroundMotionError, match=f"^{message}"):
            motions.read(**options)
    (tmp_path / "a.csv").write_text(csv())
    with pytest.raises(
        motions.GroundMotionError, match="unit 'g': a CSV file has its units in its head; leave the unit out"
    ):
        motions.read(tmp_path / "a.csv", unit="g")
    (tmp_path / "a.AT2").write_text(at2())
    with pytest.raises(motions.GroundMotionError, match="uneven True: a .AT2 file has one step, DT; leave it out"):
        motions.read(tmp_path / "a.AT2", uneven=True)


def spoiled(text, kind, dice):
    """A file in which one thing is wrong that can be seen, at a place by chance."""
    lines = text.splitlines()
    first = 4 if kind == "AT2" else 1
    k = dice.randrange(first, len(lines))
    words = lines[k].split() if kind == "AT2" else lines[k].split(",")
    w = dice.randrange(len(words))
    join = "  ".join if kind == "AT2" else ",".join

    def word(other):
        return "\n".join([*lines[:k], join([*words[:w], other, *words[w + 1 :]]), *lines[k + 1 :]])

    def head(*change):
        row, old, new = dice.choice(change)
        return "\n".join([*lines[:row], lines[row].replace(old, new), *lines[row + 1 :]])

    at2_heads = (
        (3, "NPTS", "POINTS"), (3, "23", "24"), (3, "23", "x"), (3, ".0050", "-.0050"), (3, ".0050", ""), (3, "DT", "STEP"),
        (3, "SEC", "MSEC"), (2, "UNITS OF G", "G"), (2, "OF G", "OF M/S"), (2, "ACCELERATION", "VELOCITY"),
    )  # fmt: skip
    csv_heads = (
        (0, "time_s", "time"), (0, "_m_per_s2", ""), (0, "vertical_g", "vertical"), (0, ",", ";"), (0, "vertical", "east"),
        (0, "time_s", "horizontal_g"), (0, "horizontal", "vertical"),
    )  # fmt: skip
    at = dice.randrange(len(text))
    ways = [
        lambda: word(dice.choice(["nan", "NaN", "inf", "-Infinity", "1e999"])),
        lambda: word(
            dice.choice(["x", "--1", "1.2.3", "1,5" if kind == "AT2" else "1;5", "0x1A", "1_0", "٣", "1e", "*****"])
        ),
        lambda: word(dice.choice(["9810", "-1e5", "1e300"])) if w > 0 or kind == "AT2" else word("x"),
        lambda: join([*words[:w], *words[w + 1 :]]).join(
            ["\n".join(lines[:k]) + "\n", "\n" + "\n".join(lines[k + 1 :])]
        ),
        lambda: word(words[w] + (" 0.1" if kind == "AT2" else ",0.1")),
        lambda: head(*(at2_heads if kind == "AT2" else csv_heads)),
        lambda: text[:at] + dice.choice(["\0", "\x07", "\x1b[2J"]) + text[at:],
        lambda: text.encode()[:at] + dice.choice([b"\xff", b"\xc3\x28", b"\x80"]) + text.encode()[at:],
        lambda: "\n".join(lines[: dice.randrange(first)]),
        lambda: text.encode(dice.choice(["utf-16", "utf-32"])),
    ]
    if kind == "AT2":
        ways.append(lambda: "\n".join([*lines[:k], *lines[k + 1 :]]))  # a row is lost
    else:
        inner = dice.randrange(2, len(lines) - 1)
        ways += [
            lambda: "\n".join([*lines[:inner], *lines[inner + 1 :]]),
            lambda: "\n".join([*lines[:inner], lines[inner], *lines[inner:]]),
            lambda: "\n".join([*lines[:inner], lines[inner + 1], lines[inner], *lines[inner + 2 :]]),
        ]
    return dice.choice(ways)()


@pytest.mark.parametrize("kind", ["AT2", "csv"])
def test_a_hundred_damaged_files_give_one_clean_line_each(read, tmp_path, kind):
    text = at2() if kind == "AT2" else csv()
    assert len(read(text, name=f"a.{kind}").times) == 23
    dice, seen = random.Random(5), set()
    while len(seen) < 100:
        damaged = spoiled(text, kind, dice)
        seen.add(damaged if isinstance(damaged, bytes) else damaged.encode())
        with pytest.raises(errors.UserError) as refusal:
            read(damaged, name=f"a.{kind}")
        told = str(refusal.value)
        assert told.startswith(f"{tmp_path / f'a.{kind}'}: ") and told.isprintable() and 30 < len(told) < 400, told
