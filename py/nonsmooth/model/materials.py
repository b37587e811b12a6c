"""Materials of laboratory tests: those of the paper's Table 1 by name, others from a file.

A material file is YAML with the keys that a material has in a section file, as ``friction: 0.3``; see
``sections/jiufengershan.yaml``.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path

import yaml

from ..system import checks
from ..system.whole_files import write_atomically
from . import rocks, section
from .section import building as section_building, units as section_units, values as section_values
from .section.folder import SCHEMA
from .section.reader import Document, SectionError, read

__all__ = ["ENVELOPE", "QUANTITIES", "REDUCED", "SHIPPED", "bare", "data", "divided", "load", "of", "save", "smooth"]

#: Names of the paper's Table 1, with the materials of the shipped section that hold their parameters.
SHIPPED = {"wwr": "rock", "dp": "dp", "fb": "fb", "ss": "ss"}


def load(name_or_path, option="--material"):
    """A section.Material by its name in :data:`SHIPPED`, or from a material file. ``option``: by which a command was
    given it, for messages.

    Raises SectionError, naming file, line, key, value and remedy.
    """
    name, document = _document(name_or_path, option)
    return section_building.material_from(name, document.data, document)


def data(name_or_path, option="--rock") -> dict:
    """The plain data of a material, nothing filled in: what its file, or that of the shipped section, says. Arguments,
    and what it raises, as of :func:`load`.
    """
    return _document(name_or_path, option)[1].data


def _document(name_or_path, option):
    """The name of a material and its checked Document."""
    what = f"give one of {', '.join(SHIPPED)}, or the path of a material file"
    name = str(checks.path("material", name_or_path, SectionError, what))
    if name in SHIPPED:
        return name, Document(name, section_values.given(section.load("jiufengershan"))["materials"][SHIPPED[name]])
    path = Path(name)
    if path.suffix not in (".yaml", ".yml") and not path.exists():
        raise SectionError(f"{option} {name}: neither a file nor one of {', '.join(SHIPPED)}; give a name or a path")
    document = read(path, SCHEMA, part=("properties", "materials", "additionalProperties"))
    section_units.check_material(document)
    if section_building.material_from(path.stem, document.data, document).density is None:
        document.refuse((), "the key 'density' is missing", "add it (kg/m³, of the disks)")
    return path.stem, document


@checks.takes(
    SectionError, material=checks.kind(section.Material, "give a section.Material, as load('wwr') returns one")
)
def bare(material):
    """The material without what rules nothing in a test: what was measured before, and what slip does to walls."""
    return dataclasses.replace(material, slip_weakening=None, slip_law=None, envelope=None)


def smooth(material):
    """The material without friction and without bonds."""
    strengths = ("tensile_strength", "friction", "rolling_friction")
    none = dict.fromkeys([*strengths, *(f"residual_{name}" for name in strengths)], 0.0)
    return dataclasses.replace(material, bonded=False, **none)


#: The strength of samples, which :func:`divided` divides by the table of calibrated rocks (:mod:`.rocks`).
ENVELOPE = "envelope"
#: Strengths that :func:`divided` can divide.
QUANTITIES = ("friction", "rolling_friction", "cohesion", "tension", ENVELOPE)
REDUCED = QUANTITIES[:3]  # usually


def divided(material, factor, quantities=REDUCED):
    """The section.Material with some of its :data:`QUANTITIES` divided by a ``factor``: of a bond, of a contact without
    one, and what slip leaves.

    A contact slides at μ_s (F_a + N), F_a = σ ℓ, so its cohesion is the product μ_s F_a: divided with the friction, it
    leaves the adhesion F_a as it is, as the apex of Mohr's line stays where c and tan φ fall together; divided alone it
    divides F_a, and friction alone multiplies it. "tension" divides F_a besides. The torque of rolling goes with the
    same F_a: μ_r ℓ (F_a + N).

    "envelope", which comes alone, divides c and tan φ of samples: a material of the table of calibrated rocks
    (:func:`.rocks.asked`) gets the contacts that the table has for them, as of :func:`.rocks.reduced`; any other, as
    that of a wall, is divided by :data:`REDUCED`, as a wall's c and tan φ are those of its contacts. ValueError for a
    factor beyond the table.
    """
    if ENVELOPE in quantities:
        if rocks.asked(material) is not None:
            return rocks.reduced(material, factor)
        quantities = REDUCED
    friction = factor if "friction" in quantities else 1.0
    rolling = factor if "rolling_friction" in quantities else 1.0
    adhesion = friction / (factor if "cohesion" in quantities else 1.0)
    adhesion = adhesion / (factor if "tension" in quantities else 1.0)
    weak = material.slip_weakening
    if weak is not None:
        weak = dataclasses.replace(
            weak, friction=weak.friction / friction, tensile_strength=weak.tensile_strength * adhesion
        )
    return dataclasses.replace(
        material,
        friction=material.friction / friction,
        residual_friction=material.residual_friction / friction,
        rolling_friction=material.rolling_friction / rolling,
        residual_rolling_friction=material.residual_rolling_friction / rolling,
        tensile_strength=material.tensile_strength * adhesion,
        residual_tensile_strength=material.residual_tensile_strength * adhesion,
        slip_weakening=weak,
    )


def of(plain):
    """A bare material from the plain data that `asdict` makes of it."""
    return section.Material(**{**plain, "bond_ellipse": tuple(plain["bond_ellipse"])})


def save(material, path, comment=""):
    """Writes a material file; ``comment``: text for its head."""
    plain = {
        k: v
        for k, v in dataclasses.asdict(material).items()
        if k not in ("name", "slip_weakening", "slip_law") and v is not None
    }
    plain["bond_ellipse"] = list(plain["bond_ellipse"])
    head = "".join(f"# {line}\n" for line in comment.splitlines())
    write_atomically(Path(path), (head + yaml.safe_dump(plain, sort_keys=False, allow_unicode=True)).encode())
