"""What is asked of a search for the factor of safety, as checked data. Needs no YADE."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace

from ...course import strength_reduction
from ...errors import UserError
from ...model import materials as model_materials, rocks, scales
from ...model.materials import ENVELOPE, QUANTITIES, REDUCED
from ...model.section import Section, data as section_data
from ...system import checks, keys
from ...world import worlds

__all__ = ["Asked", "SafetyError", "standing"]

RISE = 2.0  # time in which the table rises to its height, in times of stillness of a slope


class SafetyError(UserError, ValueError):
    """A search for the factor of safety that cannot be made; the message says why and what helps."""


@dataclass(frozen=True)
class Asked:
    """A search. ``section``: the Section; ``quantities``: some of :data:`.materials.QUANTITIES`, which are divided;
    ``materials``: names of the section's materials in which they are, None: in all; ``world``: {} or {"name": "hard"}
    is rigid disks, {"name": "soft", "stiffness": …} springs, with other fields of :class:`.worlds.Soft` but the
    diameters; ``numbers``: of :func:`.strength_reduction.rules`, ``step``, ``within``, ``most``, ``least``.

    Raises SafetyError, StrengthReductionError, WorldError or SoftError, naming it, for what cannot be used, and
    SafetyError for a water table that never comes to stand (see :func:`standing`), and for an envelope to be divided
    in layers of rocks that the table does not have.
    """

    section: Section
    quantities: tuple = REDUCED
    materials: tuple | None = None
    world: dict = field(default_factory=dict)
    numbers: dict = field(default_factory=dict)

    def __post_init__(self):
        section = self.section
        if not isinstance(section, Section):
            remedy = "give a Section, as section.load('circle') returns one"
            raise SafetyError(f"section {checks.shown(section)}: {remedy}")
        self._set("quantities", QUANTITIES, self.quantities)
        if self.materials is not None:
            self._set("materials", tuple(section.materials), self.materials)
        for name, given in (("numbers", self.numbers), ("world", self.world)):
            if not isinstance(given, Mapping):
                raise SafetyError(f"{name} {checks.shown(given)}: give a dictionary, {{name: value}}")
        known = ("step", "within", "most", "least")
        for name in self.numbers:
            if name not in known:
                raise SafetyError(f"{name}: no number of a search; give some of {', '.join(known)}")
        self._check_envelope()
        self.rules()
        self.make_world()
        for wall in section.with_slip_law:
            raise SafetyError(
                f"{section.source}: wall {wall.name}: its friction is that of a slip law, which is not divided; give "
                "its material no slip_law"
            )
        if section.erosion:
            raise SafetyError(
                f"{section.source}: erosion: a search takes no disks out, and {section.erosion[0].name} would not act; "
                "leave `erosion` out, and give the shape that is left as layers"
            )
        if section.shaking is not None:
            raise SafetyError(
                f"{section.source}: shaking: a search does not shake the slope; leave `shaking` out, or run the section "
                "with its strengths divided (laboratory.materials.divided)"
            )
        water, hold = section.water, section.stages.water_hold
        if water is not None and water.rate > 0 and isinstance(hold, str):
            raise SafetyError(
                f"{section.source}: stages.water.hold {hold}: the table rises without end, and no slope rests under a "
                "load that grows; give a height [m] there, or --table, 0 for a dry slope"
            )
        if water is not None and water.rate > 0:
            (begins, height), longest = water.table[-1], section.stages.longest
            stands = begins + max(hold - height, 0.0) / water.rate
            if stands > longest:
                raise SafetyError(
                    f"{section.source}: stages.water.hold {hold:g}: at {water.rate:g} m/s the table stands there {stands:.3g} s "
                    f"after t0, and the run ends {longest:g} s after t0; give --table {hold:g}, or stages.end.time of "
                    f"{math.ceil(section.stages.dry + stands)} s and more"
                )

    def _set(self, name, known, given):
        remedy = f"give some of {', '.join(known)}, each once"
        if isinstance(given, str) or not isinstance(given, (list, tuple)) or not given:
            raise SafetyError(f"{name} {checks.shown(given)}: {remedy}")
        for one in given:
            if one not in known:
                raise SafetyError(f"{name}: {checks.shown(one)}: {remedy}")
        if len(set(given)) < len(given):
            raise SafetyError(f"{name} {', '.join(given)}: {remedy}")
        object.__setattr__(self, name, tuple(given))

    def _check_envelope(self):
        if ENVELOPE not in self.quantities:
            return
        if len(self.quantities) > 1:
            beside = ", ".join(name for name in self.quantities if name != ENVELOPE)
            raise SafetyError(
                f"quantities {', '.join(self.quantities)}: the envelope is friction and cohesion of the rock, and "
                f"stands alone; leave {beside} out"
            )
        for layer in self.section.layers:
            name = layer.material
            if name in self._chosen() and rocks.asked(self.section.materials[name]) is None:
                low, high = rocks.interval()
                raise SafetyError(
                    f"quantities envelope: {name}, of the layer {layer.name}, is no rock of the table of calibrated "
                    f"rocks; give it by cohesion [Pa] and friction_angle ({low:g} to {high:g} degrees), or divide "
                    f"{', '.join(REDUCED)}"
                )

    def _chosen(self):
        return self.section.materials if self.materials is None else self.materials

    def _reach(self):
        """The smallest and the largest factor that the table of calibrated rocks has for what is divided."""
        found = [self.section.materials[name] for name in self._chosen()]
        reach = [rocks.reach(m) for m in found if ENVELOPE in self.quantities and rocks.asked(m) is not None]
        return max((low for low, _ in reach), default=0.0), min((high for _, high in reach), default=math.inf)

    @property
    def hard(self) -> bool:
        """Whether contacts are rigid."""
        return self.world.get("name", "hard") == "hard"

    def make_world(self):
        """The :class:`.worlds.Soft`, or None for rigid disks with the section's numerics."""
        name = self.world.get("name", "hard")
        more = {key: value for key, value in self.world.items() if key != "name"}
        if name not in ("hard", "soft"):
            raise SafetyError(f"world {checks.shown(name)}: give hard or soft")
        if name == "hard":
            if more:
                raise SafetyError(
                    f"{', '.join(more)}: rigid disks have no such value; leave it out, or take world soft"
                )
            return None
        checks.number("stiffness", more.get("stiffness"), SafetyError, "give Young's modulus [Pa], above 0", above=0)
        s = self.section
        try:
            made = worlds.Soft(diameter=(s.smallest, s.largest), verlet=-s.numerics.verlet_distance, **more)
        except TypeError:
            raise SafetyError(f"world {checks.shown(more)}: give fields of worlds.Soft but the diameters") from None
        for layer in s.layers:
            made.equivalent(s.materials[layer.material])  # refuses what no soft contact has
        if s.interfaces:
            made.interface(None, None, None)
        return made

    def rules(self):
        """The :class:`.strength_reduction.Rules`; factors stay within what the table of calibrated rocks has where it
        is divided by.
        """
        made = strength_reduction.rules(self.section, scales.of(self.section), **self.numbers)
        low, high = self._reach()
        return replace(made, least=max(made.least, low), most=min(made.most, high))

    def strengths(self, factor) -> dict:
        """The materials of the section with what is asked for divided by a ``factor``: {name: section.Material}."""
        return {
            name: model_materials.divided(m, factor, self.quantities) if name in self._chosen() else m
            for name, m in self.section.materials.items()
        }

    @property
    def key(self) -> str:
        """What must agree between a checkpoint and the search that goes on from it."""
        s = self.section
        told = {
            "section": section_data.plain(s),
            "seed": s.seed,
            "quantities": list(self.quantities),
            "materials": None if self.materials is None else list(self.materials),
            "world": self.world,
            "rules": asdict(self.rules()),
        }
        return keys.key_of(told)


def standing(section, table=None) -> tuple[Section, str | None]:
    """The Section with a water table that comes to stand, at the height ``table`` [m] where that is given, and a note
    where this is not what the section says. Without one a table that would rise without end never rises.

    Raises SafetyError for a ``table`` where the section has no water, and for what is no height.
    """
    if section.water is None:
        if table:
            raise SafetyError(
                f"--table {table:g}: {section.source} has no water; add the key `water` to it, or leave --table out"
            )
        return section, None
    note = None
    if section.water_field is not None:
        if table is not None:
            raise SafetyError(
                f"--table {table:g}: {section.source} has no water table, but a field of water, whose last state "
                "stays; leave --table out"
            )
        return section, None
    if table is None:
        if section.water.rate == 0 or not isinstance(section.stages.water_hold, str):
            return section, None
        table = 0.0
        endless = "its water table rises without end, under which no slope rests"
        note = f"{section.source}: {endless}: dry; --table METRES lets it stand at a height"
    checks.number("--table", table, SafetyError, "give the height of the water table [m], 0 or more", least=0)
    rise = RISE * scales.of(section).still_seconds
    points = [[0.0, 0.0], [float(f"{rise:.3g}"), float(table)]] if table else [[0.0, 0.0]]
    made = section.with_values({"water.table": {"points": points}, "stages.water.hold": "never"})
    return replace(made, source=section.source), note
