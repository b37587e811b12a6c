"""What all water of a section has that is no table above a plane: a field of pressures. Needs no YADE."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import ClassVar

from .parts import Release

__all__ = ["FieldWater", "rising"]


@dataclass(frozen=True)
class FieldWater:
    """Water with a pressure of its own at each place: `unit_weight` γ_w [N/m³]; `volume`: "disk" or "bulk", on which
    −∇p acts; `release_distance`, `release`: as of :class:`.parts.Water`; `outside`: "refuse" a field that does not
    cover the layers, or take it for "dry" there.
    """

    unit_weight: float
    volume: str
    release_distance: str | float
    outside: str
    release: Release | None

    wall: ClassVar[None] = None  # of a plane, as of parts.Water
    rate: ClassVar[float] = 0.0

    @property
    def key(self) -> dict:
        """What tells it from other water, wherever its files are."""
        return {name: value for name, value in dataclasses.asdict(self).items() if name != "files"}


def rising(document, keys, entries) -> None:
    """Raise SectionError for the first of `entries`, a list below the key path `keys`, whose time does not follow the
    one before.
    """
    for k, (before, after) in enumerate(zip(entries, entries[1:]), 1):
        if after["time"] <= before["time"]:
            document.refuse(
                (*keys, k, "time"),
                f"the time {after['time']:g} s does not follow {before['time']:g} s",
                "give the times in rising order",
            )
