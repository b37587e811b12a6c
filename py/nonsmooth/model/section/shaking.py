"""The earthquake of a section: a motion of the ground from a record or made up, and when it begins. Needs no YADE."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from .. import ground_motion
from ..ground_motion import GroundMotion, GroundMotionError, synthetic

__all__ = ["FILE", "Shaking", "check_end", "complete", "kept", "made", "mirrored", "plain"]

FILE = "shaking.csv"  # of a run: the record as it shakes the slope
RECORD = ("file", "vertical_file", "unit", "name", "uneven", "sha256")  # keys of a record that is read


@dataclass(frozen=True)
class Shaking:
    """How the ground shakes: its ``motion``, a GroundMotion whose time 0 is ``begin`` [s] after t0.

    ``said``: the keys and values of a section file that make it; ``digest``: SHA-256 (hex) of its values, and
    ``record`` that of the record as it was read, None of a synthetic motion.
    """

    motion: GroundMotion = field(compare=False, repr=False)
    begin: float
    digest: str
    said: Mapping = field(compare=False, repr=False)
    record: str | None = field(compare=False, default=None, repr=False)

    @property
    def end(self) -> float:
        """When the record is over [s since t0]."""
        return self.begin + self.motion.duration


def complete(document) -> None:
    """Fills in what other keys follow from when a section is mirrored or made larger, and where its record's files
    are: paths of a section file are those from its own folder.
    """
    raw = document.data.get("shaking")
    if raw is None:
        return
    for key in ("file", "vertical_file"):
        if key in raw:
            raw[key] = document.beside(raw[key])
    raw.setdefault("stretch", 1.0)
    raw.setdefault("reversed", False)


def made(document) -> Shaking | None:
    """The Shaking of a section's data, None without; SectionError for a record that cannot be read or made."""
    raw = document.data.get("shaking")
    if raw is None:
        return None
    keys = [name for name in ("file", "synthetic") if name in raw]
    if len(keys) != 1:
        document.refuse(
            ("shaking",),
            f"has {'both' if keys else 'neither'} `file` {'and' if keys else 'nor'} `synthetic`",
            "give the file of a record, or the numbers of a synthetic one",
        )
    if "synthetic" in raw:
        for name in RECORD[1:]:
            if name in raw:
                document.refuse(("shaking", name), "belongs to a record of a file", "leave it out with `synthetic`")
    if "peak" in raw and "factor" in raw:
        document.refuse(("shaking", "factor"), "stands beside `peak`", "give one of the two")
    try:
        record = _record(raw)
        read = _digest(record) if "file" in raw else None
        if raw.get("sha256", read) != read:
            document.refuse(
                ("shaking", "sha256"),
                f"{raw['sha256']} is not that of the values of {raw['file']}, {read}",
                "give the record that was meant, or leave `sha256` out",
            )
        motion = _changed(record, raw)
    except GroundMotionError as error:
        document.refuse(("shaking", keys[0]), str(error), "see the page 'Earthquakes'")
    return Shaking(motion, float(raw.get("begin", 0.0)), _digest(motion), dict(raw), read)


def _record(raw):
    """The motion as it was read or made up."""
    if "file" in raw:
        return ground_motion.read(
            raw["file"],
            vertical=raw.get("vertical_file"),
            unit=raw.get("unit"),
            name=raw.get("name"),
            uneven=raw.get("uneven", False),
        )
    said = dict(raw["synthetic"])
    return synthetic.stochastic(
        said.pop("peak"), said.pop("duration"), said.pop("frequency"), said.pop("seed", 1), **said
    )


def _changed(motion, raw):
    """What the section makes of it."""
    if "baseline" in raw:
        motion = motion.corrected(raw["baseline"])
    if "peak" in raw:
        motion = motion.scaled(peak=raw["peak"])
    if raw.get("factor", 1.0) != 1.0:
        motion = motion.scaled(factor=raw["factor"])
    if raw.get("stretch", 1.0) != 1.0:
        motion = motion.stretched(raw["stretch"])
    if raw.get("reversed", False):
        motion = motion.reversed()
    return motion if motion.times[0] == 0.0 else motion.starting(0.0)


def _digest(motion):
    values = b"".join(part.tobytes() for part in (motion.times, motion.horizontal, motion.vertical))
    return hashlib.sha256(values).hexdigest()


def plain(shaking) -> dict:
    """The keys and values of a section file that gives this Shaking. Of a record that was read they have its SHA-256,
    so that what is kept by these values is not taken for what another content of the file would give.
    """
    known = {"sha256": shaking.record} if shaking.record else {}
    return {**shaking.said, "begin": shaking.begin, **known}


def kept(shaking, folder) -> dict:
    """The same for a section that is written into the ``folder`` of a run: a record that was read is written there too,
    as it shakes the slope, so that the run does not depend on the file that it came from.
    """
    if "synthetic" in shaking.said:
        return plain(shaking)
    ground_motion.write_csv(shaking.motion, Path(folder) / FILE)
    return {
        "file": FILE,
        "name": shaking.motion.name,
        "uneven": True,
        "sha256": shaking.digest,
        "stretch": 1.0,
        "reversed": False,
        "begin": shaking.begin,
    }


def mirrored(raw) -> dict:
    """The data of a shaking for a mirrored section: the ground goes to the other side."""
    return {**raw, "reversed": not raw.get("reversed", False)}


def check_end(section, document) -> None:
    """Raises SectionError where a section's run ends before its record does."""
    shaking, stages = section.shaking, section.stages
    if shaking is None or stages.dry + shaking.end <= stages.end.time:
        return
    least = math.ceil(stages.dry + shaking.end)
    document.refuse(
        ("shaking",),
        f"goes on until {shaking.end:g} s after t0, which is {stages.dry:g} s after settling, and the run ends at "
        f"{stages.end.time:g} s after settling",
        f"give stages.end.time of {least:g} s and more",
    )
