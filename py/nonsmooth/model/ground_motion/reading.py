"""Records of the motion of the ground from files: .AT2 of PEER, and CSV with units in its head.

A .AT2 file holds one component: some lines of words, of which the second names the record and another its unit, a line
with the number of values (NPTS) and the step [s] (DT) in one of several spellings, and the values, so many a line. A
CSV file has a head such as ``time_s,horizontal_m_per_s2,vertical_g``; lines that begin with # are comments.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ...system import checks
from ...system.text_files import read_lines
from .motion import COMPONENTS, LARGEST, STANDARD_GRAVITY, GroundMotion, GroundMotionError

__all__ = ["UNITS", "read"]

#: m/s² in each unit that an acceleration may be in.
UNITS = {"m/s2": 1.0, "g": STANDARD_GRAVITY, "cm/s2": 0.01, "gal": 0.01}
SUFFIXES = {name.replace("/", "_per_"): factor for name, factor in UNITS.items()}  # of the columns of a CSV
EXAMPLE = "time_s,horizontal_m_per_s2,vertical_g"

LARGEST_FILE = 200_000_000  # bytes; a record of an hour at 200 values a second has 11 million
HEADER = 10  # lines, in which NPTS and DT of a .AT2 must stand
LONGEST_STEP = 1.0  # s; of records some hundredths
MISSING, DOUBLE = 1.5, 0.5  # of the usual step: a longer one misses a value, a shorter one has one too many

NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
NO_NUMBERS = ("nan", "inf", "infinity")
KEYS = {name: re.compile(rf"\b{name}\s*[=:]\s*([^\s,;]*)", re.IGNORECASE) for name in ("NPTS", "DT")}
LATER = re.compile(r"\s*(\S+?)[\s,;]+(\S+?)[\s,;]+NPTS\s*[,;]?\s*DT\b", re.IGNORECASE)  # 3930 0.00500 NPTS, DT
AFTER_DT = re.compile(r"\bDT\s*[=:]\s*[^\s,;]*[\s,;]*([A-Za-z]*)", re.IGNORECASE)
SECONDS = ("", "s", "sec", "secs", "second", "seconds", "npts")
UNIT = re.compile(r"\bUNITS?\s*(?:OF|IN|[=:])?\s*([^\s,;:()]+)", re.IGNORECASE)


def read(path, vertical=None, unit=None, name=None, uneven=False) -> GroundMotion:
    """The GroundMotion of a record.

    ``path``: a .AT2 of the horizontal component, or a CSV; files of other names are what they look like. ``vertical``:
    the .AT2 of the vertical component, of as many values at the same step. ``unit``: of a .AT2 that does not say it,
    one of :data:`UNITS`. ``name``: of the record, the file's own where None. ``uneven``: whether the times of a CSV may
    be any that rise; otherwise a step of more than 1.5 or less than half of the usual one is refused as a gap or a line
    too many. The first value of a .AT2 is that at 0 s.

    Raises GroundMotionError with the file, the line, the value and the remedy for what is missing, damaged or does not
    fit together.
    """
    path = Path(checks.path("path", path, GroundMotionError, "give the path of a .AT2 or a CSV file"))
    if vertical is not None:
        vertical = Path(checks.path("vertical", vertical, GroundMotionError, "give the path of a .AT2 file"))
    if unit is not None and unit not in [*UNITS]:
        raise GroundMotionError(f"unit {checks.shown(unit)}: give one of {', '.join(UNITS)}")
    if not isinstance(uneven, bool):
        raise GroundMotionError(f"uneven {checks.shown(uneven)}: give True for a CSV whose steps differ, or False")
    if name is not None:
        checks.text("name", name, GroundMotionError, "give words, or None for the file's own")
    lines = _lines(path)
    if not _is_at2(path, lines):
        if vertical is not None:
            raise _wrong(
                vertical, f"comes beside the CSV file {path.name}", "give the vertical component as a column of it"
            )
        if unit is not None:
            raise _wrong(path, f"unit {unit!r}: a CSV file has its units in its head", "leave the unit out")
        times, columns = _csv(path, lines, uneven)
        return _motion(path, times, *columns, name=name or path.stem, source=path.name)
    if uneven:
        raise _wrong(path, "uneven True: a .AT2 file has one step, DT", "leave it out")
    step, values, title = _at2(path, lines, unit)
    source, upright = path.name, None
    if vertical is not None:
        other, upright, _ = _at2(vertical, _lines(vertical), unit)
        if len(upright) != len(values) or other != step:
            raise _wrong(
                vertical,
                f"{len(upright)} values at {other:g} s, and {path.name} has {len(values)} at {step:g} s",
                "give two components of one record",
            )
        source = f"{source}, {vertical.name}"
    return _motion(path, step * np.arange(len(values)), values, upright, name=name or title, source=source)


def _motion(path, *columns, **words):
    """The GroundMotion of what a file has. Raises GroundMotionError that names it."""
    try:
        return GroundMotion(*columns, **words)
    except GroundMotionError as error:
        raise GroundMotionError(f"{path}: {error}") from None


def _wrong(path, what, remedy, line=None):
    """A GroundMotionError of one line."""
    where = f"line {line}: " if line is not None else ""
    return GroundMotionError(" ".join(f"{path}: {where}{what}; {remedy}".split()))


def _lines(path):
    """Lines of a text file that has some. Raises GroundMotionError."""
    lines = read_lines(path, LARGEST_FILE, GroundMotionError, "a text file, .AT2 or CSV")
    for number, line in enumerate(lines, 1):
        if not line.replace("\t", "").isprintable():
            raise _wrong(path, "bytes that are no text, as of a binary file", "give a text file, .AT2 or CSV", number)
    if not any(map(str.strip, lines)):
        raise _wrong(path, "is empty", "give a .AT2 or a CSV file of a record")
    return lines


def _is_at2(path, lines):
    if path.suffix.lower() in (".at2", ".csv"):
        return path.suffix.lower() == ".at2"
    return any("NPTS" in line.upper() for line in lines[:HEADER])


def _number(path, number, text, what="value"):
    """A number as it stands in a line. Raises GroundMotionError for what is none."""
    if NUMBER.fullmatch(text):
        value = float(text)
        if np.isfinite(value):
            return value
    if text.lstrip("+-").lower() in NO_NUMBERS or NUMBER.fullmatch(text):
        raise _wrong(path, f"{what} {checks.shown(text)} is not finite", "repair the record there", number)
    raise _wrong(path, f"{what} {checks.shown(text)} is no number", "give numbers such as -0.0123 or -.123E-01", number)


def _acceleration(path, number, text, unit, factor):
    """An acceleration [m/s²] of one in a unit. Raises GroundMotionError for what can be none."""
    value = factor * _number(path, number, text, "acceleration")
    if abs(value) > LARGEST:
        raise _wrong(
            path,
            f"acceleration {checks.shown(text)} in {unit} is {value / STANDARD_GRAVITY:.3g} g, more than 10",
            "correct the unit, which is probably another one, or the value",
            number,
        )
    return value


# ---- .AT2 -------------------------------------------------------------------------------------------


def _at2(path, lines, unit):
    """Step [s], accelerations (n,) [m/s²] and name of a component."""
    number = next((k for k, line in enumerate(lines[:HEADER], 1) if "NPTS" in line.upper()), None)
    if number is None:
        remedy = "give a line such as NPTS= 4000, DT= .0050 SEC above the values"
        raise _wrong(path, f"none of its first {HEADER} lines has NPTS", remedy)
    count, step = _count_and_step(path, number, lines[number - 1])
    unit = _unit(path, lines[:number], unit)
    values = [
        _acceleration(path, k, text, unit, UNITS[unit])
        for k, line in enumerate(lines[number:], number + 1)
        for text in line.split()
    ]
    if len(values) != count:
        raise _wrong(
            path,
            f"NPTS says {count} values, and {len(values)} follow",
            "restore the lines that are missing, or correct NPTS",
            number,
        )
    title = " ".join(lines[1].split()) if number > 2 else ""
    return step, np.array(values), title or path.stem


def _count_and_step(path, number, line):
    """NPTS and DT [s] of their line."""
    found = [pattern.findall(line) for pattern in KEYS.values()]
    later = LATER.match(line)
    if all(len(one) == 1 for one in found):
        (count,), (step,) = found
        said = AFTER_DT.search(line).group(1)
        if said.lower() not in SECONDS:
            raise _wrong(path, f"DT is in {checks.shown(said)}", "give DT in seconds, as DT= .0050 SEC", number)
    elif later and not any(found):
        count, step = later.groups()
    else:
        told = checks.shown(line.strip())
        raise _wrong(path, f"NPTS and DT cannot be told from {told}", "give NPTS= 4000, DT= .0050 SEC", number)
    if not re.fullmatch(r"\d{1,9}", count, re.ASCII) or int(count) < 2:
        raise _wrong(path, f"NPTS {checks.shown(count)}", "give the number of values, 2 or more", number)
    seconds = _number(path, number, step, "DT")
    if not 0 < seconds <= LONGEST_STEP:
        raise _wrong(path, f"DT {step}", f"give the step in seconds, above 0 and at most {LONGEST_STEP:g}", number)
    return int(count), seconds


def _unit(path, header, stated):
    """The unit that the header has, or else the stated one."""
    for number, line in enumerate(header, 1):
        found = UNIT.search(line)
        if not found:
            continue
        word = found.group(1).rstrip(".")
        known = _known_unit(word)
        if re.search(r"\b(VELOCITY|DISPLACEMENT)\b", line, re.IGNORECASE):
            raise _wrong(path, f"holds no acceleration: {checks.shown(line.strip())}", "give the .AT2 file", number)
        if known is None:
            raise _wrong(path, f"the unit {checks.shown(word)} is not known", f"give one of {', '.join(UNITS)}", number)
        if stated is not None and UNITS[stated] != UNITS[known]:
            what = f"unit {stated!r}, and the file says {checks.shown(word)}"
            raise _wrong(path, what, "leave the unit out, or correct the file", number)
        return known
    if stated is None:
        raise _wrong(path, "does not say the unit of its values", f"give unit, one of {', '.join(UNITS)}")
    return stated


def _known_unit(word):
    """The unit of :data:`UNITS` that a word of a header is, as CM/SEC/SEC or M/S**2; None for others."""
    plain = word.lower().replace("sec", "s").replace("**", "").replace("^", "").replace("²", "2").replace("/s/s", "/s2")
    return plain if plain in UNITS else None


# ---- CSV --------------------------------------------------------------------------------------------


def _csv(path, lines, uneven):
    """Times (n,) [s] and both components (n,) [m/s²], None for a vertical one that is not there."""
    told = [(k, line) for k, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")]
    if not told:
        raise _wrong(path, "holds no record", f"give a head such as {EXAMPLE}, and a line for each time")
    head = _head(path, *told[0])
    rows = []
    for number, line in told[1:]:
        cells = [cell.strip() for cell in line.split(",")]
        if len(cells) != len(head):
            raise _wrong(
                path,
                f"{len(cells)} values under {len(head)} columns",
                "give one value for each column, with points in numbers and commas between them",
                number,
            )
        rows.append(
            [
                _number(path, number, text, "time")
                if kind == "time"
                else _acceleration(path, number, text, unit, SUFFIXES[unit])
                for text, (kind, unit) in zip(cells, head)
            ]
        )
    if len(rows) < 2:
        raise _wrong(path, f"{len(rows)} lines of values", "give two or more, one for each time")
    columns = {kind: np.array(values) for (kind, _), values in zip(head, zip(*rows))}
    _check_times(path, columns["time"], [number for number, _ in told[1:]], uneven)
    zero = np.zeros(len(rows))
    return columns["time"], (columns.get("horizontal", zero), columns.get("vertical", zero))


def _head(path, number, line):
    """[(what a column holds, its unit)] of a CSV's head: time, horizontal, vertical."""
    names = [name.strip(' "') for name in line.split(",")]
    found = []
    for name in names:
        kind, _, unit = name.partition("_")
        if kind == "time" and unit != "s":
            raise _wrong(
                path, f"column {checks.shown(name)}: times have the unit s", "give time_s, and seconds", number
            )
        if kind in COMPONENTS and unit not in SUFFIXES:
            told = ", ".join(f"{kind}_{suffix}" for suffix in SUFFIXES)
            raise _wrong(
                path, f"column {checks.shown(name)} has no unit of an acceleration", f"give one of {told}", number
            )
        if kind not in ("time", *COMPONENTS):
            raise _wrong(
                path, f"column {checks.shown(name)} is not known", f"give a head such as {EXAMPLE}, with commas", number
            )
        found.append((kind, unit))
    kinds = [kind for kind, _ in found]
    if len(set(kinds)) < len(kinds) or "time" not in kinds or len(kinds) < 2:
        what = f"the columns are {checks.shown(', '.join(names))}"
        raise _wrong(path, what, "give time_s and one or both components, each once", number)
    return found


def _check_times(path, times, numbers, uneven):
    """Raises GroundMotionError for times that do not rise, or, unless they may be ``uneven``, leave one out."""
    steps = np.diff(times)
    for k in np.flatnonzero(steps <= 0)[:1]:
        what = f"time {times[k + 1]:g} s comes after {times[k]:g} s"
        raise _wrong(path, what, "give times that rise, each once", numbers[k + 1])
    if uneven:
        return
    usual = float(np.median(steps))
    if usual > LONGEST_STEP:
        raise _wrong(
            path, f"steps of {usual:g} s", "give times in seconds, or uneven=True where the steps are meant", numbers[0]
        )
    for k in np.flatnonzero((steps > MISSING * usual) | (steps < DOUBLE * usual))[:1]:
        what = "a gap" if steps[k] > usual else "a value too many"
        raise _wrong(
            path,
            f"{what}: {steps[k]:g} s from {times[k]:g} s to {times[k + 1]:g} s, where steps are {usual:g} s",
            "mend the record, or give uneven=True where the steps are meant",
            numbers[k + 1],
        )
