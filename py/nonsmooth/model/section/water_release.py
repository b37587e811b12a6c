"""What releases the water of a section around a disk, beside its way downslope. Needs no YADE."""

from __future__ import annotations

import dataclasses

from .parts import Release

__all__ = ["plain", "read"]


def read(water, document) -> Release | None:
    """The Release of the data of a section's ``water``, None where slip alone releases; SectionError for values that do
    nothing then.
    """
    raw = water.get("release", {"by": "slip"})
    if raw["by"] != "slip":
        return Release(raw["by"], **{k: float(v) for k, v in raw.items() if k != "by"})
    for key in (key for key in raw if key != "by"):
        document.refuse(
            ("water", "release", key),
            f"{raw[key]:g} does nothing where slip releases the water",
            "leave it out, or give `by: dilatancy` or `by: slip_or_dilatancy`",
        )
    return None


def plain(release) -> dict:
    """The keys and values of a section file that give this Release, in a dictionary of its key; empty without one."""
    told = {} if release is None else {k: v for k, v in dataclasses.asdict(release).items() if v is not None}
    return {"release": told} if told else {}
