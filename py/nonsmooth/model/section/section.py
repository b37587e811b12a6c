"""A slope as data, and what follows from it. Needs no YADE."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...system import checks
from .. import free_surface, geometry, roles, stacks
from . import data as section_data, stated, values as section_values
from .erosion import Window
from .field_water import FieldWater
from .parts import Disks, Envelope, Interface, Layer, Material, Numerics, Stages, Wall, Water, normal_of
from .reader import SectionError
from .shaking import Shaking

__all__ = ["Section"]

# Walls order the disks along them, so a packing is looser there: as if a strip of this part of
# the mean size were void. Measured on packings of 3,000 and 21,000 disks.
BORDER_STRIP = 0.085

MOST_DISKS = 10_000_000  # what asks for more is a slip of the pen: a million takes 2 GB and some seconds a step


@dataclass(frozen=True)
class Section:
    """A checked section. `pressed`: its packing is pressed, see :mod:`.slope_packing`; `unusual`: keys of values that
    are meant, see :mod:`.section_units`; `erosion`: windows that take disks out; `source`: file read; `scale`:
    diameters by those of the file; `like`: a section that is packed instead, and the factor by which its disks are then
    as large (see :mod:`.similar`), or None; `given`: what it was made from, see :mod:`.stated`."""

    name: str
    description: str
    gravity: float
    walls: tuple[Wall, ...]
    layers: tuple[Layer, ...]
    materials: Mapping[str, Material]
    disks: Disks
    water: Water | FieldWater | None
    stages: Stages
    numerics: Numerics
    seed: int
    source: str
    interfaces: tuple[Interface, ...] = ()
    pressed: bool = False
    unusual: tuple[str, ...] = ()
    erosion: tuple[Window, ...] = ()
    shaking: Shaking | None = None
    scale: float = 1.0
    like: tuple[Section, float] | None = dataclasses.field(default=None, compare=False, repr=False)
    given: stated.Given | None = dataclasses.field(default=None, compare=False, repr=False)

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest box around walls and layers: (x_min, y_min, x_max, y_max) [m]."""
        v = np.vstack([item.points for item in (*self.walls, *self.layers)])
        return (*map(float, v.min(axis=0)), *map(float, v.max(axis=0)))

    @property
    def tolerance(self) -> float:
        """Distance [m] below which two points are one: a millionth of the section's size."""
        return 1e-6 * math.dist(self.bounds[:2], self.bounds[2:])

    @cached_property
    def outline(self):
        """Union of the layers, a shapely MultiPolygon."""
        return geometry.outline([layer.polygon for layer in self.layers], self.tolerance)

    @cached_property
    def packed_outline(self):
        """What is filled with disks, a shapely MultiPolygon: the :attr:`outline`, raised where it is pressed
        afterwards.
        """
        return free_surface.raised(self, free_surface.PRESSED) if self.pressed else self.outline

    @cached_property
    def growth(self) -> float:
        """Area that is filled with disks by that of the layers, to six digits."""
        if not self.pressed:
            return 1.0
        filled, asked = (
            math.fsum(geometry.area(np.asarray(p.exterior.coords)[:-1]) for p in geometry.parts(region))
            for region in (self.packed_outline, self.outline)
        )
        return float(f"{filled / asked:.6g}")

    @property
    def area(self) -> float:
        """Area of all layers [m²]."""
        return math.fsum(layer.area for layer in self.layers)  # not sum, which Python 3.12 made another sum

    @property
    def mass_size(self) -> float:
        """Size of the mass [m]: the root of the area of its layers, of all where none has this role."""
        return math.sqrt(math.fsum(layer.area for layer in self.layers if layer.role == "mass") or self.area)

    @cached_property
    def dip(self) -> float:
        """β [degrees] of the slope, positive down to the right: of its slip surfaces from end to end, see
        :mod:`.roles`.
        """
        return roles.dip_of(*roles.chord([points for _, points in self.slip_surfaces]))

    @property
    def side(self) -> float:
        """1 for a slope that falls to the right, −1 to the left."""
        return -1.0 if self.dip < 0 else 1.0

    @property
    def downslope(self) -> tuple[float, float]:
        """Unit vector down the slope."""
        b = math.radians(self.dip)
        return self.side * math.cos(b), -self.side * math.sin(b)

    @property
    def normal(self) -> tuple[float, float]:
        """Unit vector normal to the slope, upwards."""
        return normal_of(self.dip)

    def of_role(self, *wanted: str) -> tuple[Wall, ...]:
        """The walls that have one of these roles, in the order of the file."""
        return tuple(wall for wall in self.walls if wall.role in wanted)

    @property
    def sliding(self) -> tuple[Wall | Interface, ...]:
        """The slip surfaces: walls, then interfaces."""
        return (*self.of_role("slip"), *(i for i in self.interfaces if i.role == "slip"))

    @property
    def weakening(self) -> tuple[Wall | Interface, ...]:
        """The walls, then the interfaces, whose material weakens with slip."""
        return tuple(one for one in (*self.walls, *self.interfaces) if self.materials[one.material].slip_weakening)

    @property
    def with_slip_law(self) -> tuple[Wall, ...]:
        """The walls whose material has a slip law, which has cells along them."""
        return tuple(wall for wall in self.walls if self.materials[wall.material].slip_law is not None)

    @property
    def heated_surfaces(self) -> tuple[Wall, ...]:
        """Those of them that are slip surfaces."""
        return tuple(wall for wall in self.with_slip_law if wall.role == "slip")

    @cached_property
    def slip_surfaces(self) -> tuple[tuple[str, np.ndarray], ...]:
        """Name and line (n, 2) [m] of each slip surface, in the order of :attr:`sliding`."""
        return tuple((one.name, one.points if isinstance(one, Wall) else self.line_of(one)) for one in self.sliding)

    @cached_property
    def slip_levels(self) -> dict[str, int]:
        """How many slip surfaces lie below each, by its name, see :mod:`.stacks`; 0 for all where they lie side by
        side.
        """
        return dict(zip((name for name, _ in self.slip_surfaces), stacks.levels([p for _, p in self.slip_surfaces])))

    @property
    def lowest_surfaces(self) -> tuple[Wall | Interface, ...]:
        """The slip surfaces with no other below, which bear the mass between them."""
        return tuple(one for one in self.sliding if self.slip_levels[one.name] == 0)

    @property
    def stacked(self) -> tuple[str, ...]:
        """Names of all slip surfaces where some lie one above another, and each has columns of its own; empty where
        they lie side by side.
        """
        return tuple(self.slip_levels) if any(self.slip_levels.values()) else ()

    def borne_by(self, surface: str) -> np.ndarray:
        """The part of each layer of the mass that lies above a slip surface, (layers,); 0 for beds and obstacles. What
        the only one below all others bears is :attr:`borne`.
        """
        if [one.name for one in self.lowest_surfaces] == [surface]:
            return self.borne.astype(float)
        part = stacks.part_beside([layer.polygon for layer in self.layers], [dict(self.slip_surfaces)[surface]])
        return np.where([layer.role == "mass" for layer in self.layers], part, 0.0)

    @property
    def borne(self) -> np.ndarray:
        """Whether the lowest slip surfaces bear each layer, bool (layers,): those of the mass that do not lie below
        them.
        """
        lines = [dict(self.slip_surfaces)[one.name] for one in self.lowest_surfaces]
        below = stacks.part_beside([layer.polygon for layer in self.layers], lines, above=False)
        return np.array([layer.role == "mass" for layer in self.layers]) & (below < 0.5)

    @property
    def critical_slips(self) -> dict[str, float]:
        """Critical slip D_c [m] of each slip surface that weakens, by its name."""
        weak = {one.name: self.materials[one.material].slip_weakening for one in self.sliding}
        return {name: law.critical_slip for name, law in weak.items() if law}

    @property
    def water_table(self) -> Water | None:
        """The water where it is a table above a plane; None where it has a field of pressures, or is not there."""
        return self.water if isinstance(self.water, Water) else None

    @property
    def water_field(self) -> FieldWater | None:
        """The water where it has a field of pressures (:mod:`.section.water`); None where it is a table, or is not
        there.
        """
        return self.water if isinstance(self.water, FieldWater) else None

    @property
    def release_distance(self) -> float | None:
        """Way downslope [m] that releases a disk from water for good: the water's own, or where that is "critical_slip"
        the D_c of the slip surfaces that weaken (paper, section 5.4: one distance for both), of the water's plane where
        they have several. None without water, infinite where local dilatancy alone releases.
        """
        if self.water is None:
            return None
        if self.water.release is not None and self.water.release.by == "dilatancy":
            return math.inf
        if self.water.release_distance != "critical_slip":
            return self.water.release_distance
        slips = self.critical_slips
        return slips.get(self.water.wall) if len(set(slips.values())) > 1 else next(iter(slips.values()), None)

    def line_of(self, interface: Interface) -> np.ndarray:
        """The border of an interface's two layers from left to right, (n, 2) [m]; empty where they do not touch."""
        lower, upper = (self.layer(name).polygon for name in interface.between)
        return geometry.border(lower, upper, self.tolerance)

    def layer(self, name: str) -> Layer:
        """The layer called `name`; KeyError if there is none."""
        return next(layer for layer in self.layers if layer.name == name)

    def numbers_of(self, interface: Interface) -> tuple[int, int]:
        """Numbers, from 0, of the two layers of an interface, the lower one first."""
        names = [layer.name for layer in self.layers]
        return names.index(interface.between[0]), names.index(interface.between[1])

    @property
    def envelope(self) -> Envelope | None:
        """Measured strength of the rock of the lowest layer, which the report sets beside the toe's; None where the
        section has none.
        """
        return self.materials[self.layers[0].material].envelope

    def disks_of(self, layer: Layer) -> Disks:
        """The disks of a layer: its own, or those of the section."""
        return layer.disks or self.disks

    @property
    def mixed(self) -> bool:
        """Whether layers have disks of their own."""
        return any(layer.disks for layer in self.layers)

    @property
    def smallest(self) -> float:
        """Diameter [m] of the smallest disk."""
        return min(self.disks_of(layer).d_min for layer in self.layers)

    @property
    def largest(self) -> float:
        """Diameter [m] of the largest disk."""
        return max(self.disks_of(layer).d_max for layer in self.layers)

    def wall(self, name: str) -> Wall:
        """The wall called `name`; KeyError if there is none."""
        for wall in self.walls:
            if wall.name == name:
                return wall
        raise KeyError(f"no wall is called {name!r}; there are {', '.join(w.name for w in self.walls)}")

    @cached_property
    def _borders(self) -> tuple[float, ...]:
        """Length [m] of each layer's share of the outline, and of flat interfaces, to six digits: the next ones depend
        on the version of GEOS.
        """
        rim = self.outline.boundary.buffer(10 * self.tolerance)
        flat = [(i.between, self.line_of(i)) for i in self.interfaces if i.flat]
        inside = {
            layer.name: math.fsum(
                geometry.distance(*np.diff(line, axis=0).T).sum() for between, line in flat if layer.name in between
            )
            for layer in self.layers
        }
        return tuple(
            float(f"{layer.polygon.exterior.intersection(rim).length + inside[layer.name]:.6g}")
            for layer in self.layers
        )

    def disk_areas(self) -> tuple[float, ...]:
        """Area of disks [m²] in each layer that gives the packing fraction in the bulk.

        The packing fraction times the polygon's area, less a strip along the outline, which
        walls leave looser.
        """
        of = [self.disks_of(layer) for layer in self.layers]
        return tuple(
            d.packing_fraction * max(self.growth * layer.area - BORDER_STRIP * math.sqrt(d.mean_square) * border, 0)
            for d, layer, border in zip(of, self.layers, self._borders)
        )

    def disk_counts(self) -> tuple[int, ...]:
        """Number of disks in each layer; rounding is carried from layer to layer."""
        if self.mixed:
            ends = np.rint(
                np.cumsum(
                    [
                        a / (math.pi / 4 * self.disks_of(layer).mean_square)
                        for a, layer in zip(self.disk_areas(), self.layers)
                    ]
                )
            ).astype(int)
        else:
            ends = np.rint(np.cumsum(self.disk_areas()) / (math.pi / 4 * self.disks.mean_square)).astype(int)
        return tuple(int(n) for n in np.diff(ends, prepend=0))

    def with_disks(self, count: int) -> Section:
        """The same slope with about `count` disks, all diameters of its file scaled alike (paper, section 3.2.2).

        Raises SectionError where such disks are too large for the layers.
        """
        remedy = f"give a whole number from 1 to {MOST_DISKS}"
        if checks.number(f"{self.source}: disks", count, SectionError, remedy, least=1, most=MOST_DISKS) != int(count):
            raise SectionError(f"{self.source}: disks {count!r}: {remedy}")
        if self.like:
            made = self._packed_as(self.like[0].with_disks(count), self.like[1])
            return stated.keep_value(made, self, "disks.count", int(count))
        if self.disks.count:  # from the diameters that were given
            return self.with_values({"disks.count": int(count)})
        m = self.disks.mean_square
        phi = self.disks.packing_fraction
        if self.mixed:  # count = full / s² - strip / s
            of = [self.disks_of(layer) for layer in self.layers]
            inside = math.fsum(
                d.packing_fraction * self.growth * layer.area / (math.pi / 4 * d.mean_square)
                for d, layer in zip(of, self.layers)
            )
            strip = math.fsum(
                d.packing_fraction * BORDER_STRIP * b / (math.pi / 4 * math.sqrt(d.mean_square))
                for d, b in zip(of, self._borders)
            )
            s = (math.sqrt(strip**2 + 4 * count * inside) - strip) / (2 * count)
        else:
            strip = phi * BORDER_STRIP * math.sqrt(m) * math.fsum(self._borders)
            full = count * math.pi / 4 * m
            s = (math.sqrt(strip**2 + 4 * full * phi * self.growth * self.area) - strip) / (2 * full)
        disks = dataclasses.replace(self.disks.scaled(s), count=int(count))
        scaled = dataclasses.replace(
            self, disks=disks, layers=tuple(layer.with_disks(s) for layer in self.layers), scale=self.scale * s
        )
        scaled._check_room(f"{count} disks", "ask for more disks")
        if self.numerics.time_step > scaled.longest_step:
            raise SectionError(
                f"{self.source}: {count} disks: the smallest, {scaled.smallest:.4g} m, would fall past its own diameter in a step of "
                f"{self.numerics.time_step:g} s; lower numerics.time_step below {scaled.longest_step:.2g} s, or ask for fewer disks"
            )
        return stated.keep_value(scaled, self, "disks.count", int(count))

    def _packed_as(self, original: Section, factor: float) -> Section:
        layers = tuple(
            dataclasses.replace(mine, disks=theirs.with_disks(factor).disks)
            for mine, theirs in zip(self.layers, original.layers)
        )
        disks = original.disks.scaled(factor)
        return dataclasses.replace(self, disks=disks, layers=layers, scale=original.scale, like=(original, factor))

    def with_rock(self, rock: Material | Mapping) -> Section:
        """The same slope with all layers of `rock`; the names of their materials stay.

        `rock`: a Material, all of whose values count as given, or the plain data of one (`laboratory.materials.data`),
        whose residual values follow the peak where they are left out. Raises SectionError for a rock without density,
        and for what is no material.
        """
        if not isinstance(rock, (Material, Mapping)):
            remedy = "give a Material, or the plain data of one, as laboratory.materials.data('wwr') has it"
            raise SectionError(f"{self.source}: rock {checks.shown(rock)}: {remedy}")
        data = dict(rock) if isinstance(rock, Mapping) else section_data.material(rock)
        if "density" not in data:
            name = "rock" if isinstance(rock, Mapping) else rock.name
            raise SectionError(
                f"{name}: no density, and layers are to be made of it; add `density` (kg/m³, of the disks)"
            )
        data.pop("slip_weakening", None)
        return self.with_values({("materials", layer.material): data for layer in self.layers})

    def with_critical_slip(self, distance: float) -> Section:
        """The same slope with one critical distance D_c [m], as in the paper: of all its slip surfaces that weaken, and
        of the release from water.

        Raises SectionError where no slip surface weakens, and for what is no distance.
        """
        name = f"{self.source}: a critical slip of"
        checks.number(name, distance, SectionError, "give a distance above 0 [m]", above=0)
        slips = self.critical_slips
        if not slips:
            raise SectionError(
                f"{self.source}: a critical slip of {distance:g} m, and no slip surface weakens; add `slip_weakening` to the material of one that has no `slip_law`"
            )
        weak = {one.material for one in self.sliding if one.name in slips}
        values = {("materials", name, "slip_weakening", "critical_slip"): float(distance) for name in sorted(weak)}
        if self.water:
            values["water.release_distance"] = "critical_slip"
        return self.with_values(values)

    def with_values(self, values: Mapping, source: str | None = None) -> Section:
        """The same slope with other values, {key: value}: what a file that says them gives, so that what follows from
        them follows (:func:`.section_values.with_values`).

        A key is the way to a value in a section file with dots, ``materials.soil.friction``, ``walls.DP.material``, or
        its words, ``("materials", "soil", "friction")``. `source`: what messages begin with instead of the section's.
        Raises SectionError for a key that leads nowhere, and for what is no section.
        """
        return section_values.with_values(self, values, source)

    @property
    def longest_step(self) -> float:
        """Time step [s] in which a disk that has fallen by its own diameter, the smallest one, falls by as much
        again.
        """
        return math.sqrt(self.smallest / (2 * self.gravity))

    def _check_room(self, what: str, remedy: str) -> None:
        total = (
            sum(self.disk_counts()) if self.mixed else sum(self.disk_areas()) / (math.pi / 4 * self.disks.mean_square)
        )
        if total > MOST_DISKS:
            raise SectionError(
                f"{self.source}: {what}: {total:.2g} disks would fill the layers, more than {MOST_DISKS}; give larger diameters"
            )
        for polygon in geometry.parts(self.outline):
            largest = max(self.disks_of(layer).d_max for layer in self.layers if layer.polygon.intersects(polygon))
            if polygon.buffer(-largest / 2).is_empty or min(self.disk_counts()) < 1:
                x, y = polygon.representative_point().coords[0]
                raise SectionError(
                    f"{self.source}: {what}: disks of {largest:.4g} m have no room "
                    f"in the layers at ({x:.6g}, {y:.6g}); {remedy}"
                )

    def key(self, scope: str = "packing") -> str:
        """SHA-256 (hex) of all that determines a packing, the seed apart; names and comments do not.

        scope "packing": layers and disks; "settled": also walls, materials, gravity, numerics
        and the settling stage.
        """
        d = self.disks
        content = {
            "layers": [layer.vertices for layer in self.layers],
            "disks": [d.d_min, d.d_max, d.distribution, d.packing_fraction],
        }
        if self.mixed:
            content["disks"] = [
                [d.d_min, d.d_max, d.distribution, d.packing_fraction] for d in map(self.disks_of, self.layers)
            ]
        if self.pressed:
            content["pressed"] = [free_surface.PRESSED, [w.vertices for w in self.walls]]
        if any(i.flat for i in self.interfaces):
            content["flat"] = [[x.tolist() for x in self.line_of(i)] for i in self.interfaces if i.flat]
        if self.like:
            content["like"] = [self.like[0].key(), self.like[1]]
        if scope == "settled":
            plain = {
                name: {k: v for k, v in dataclasses.asdict(m).items() if k not in ("name", "envelope")}
                for name, m in self.materials.items()
            }
            content |= {
                "walls": [[w.vertices, plain[w.material]] for w in self.walls],
                "rock": [plain[layer.material] for layer in self.layers],
                "gravity": self.gravity,
                "numerics": dataclasses.asdict(self.numerics),
                "settle": dataclasses.asdict(self.stages.settle),
            }
            if self.interfaces:
                content["interfaces"] = [[self.numbers_of(i), plain[i.material]] for i in self.interfaces]
        elif scope != "packing":
            raise ValueError(f"scope {scope!r}; give packing or settled")
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
