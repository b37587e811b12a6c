"""Sections: the slope to be computed, read from a YAML file and checked before anything runs.

`load` gives a `Section` or raises `SectionError` with one message that names the file, the
line, the key, the value and the remedy. SI units throughout (m, s, kg, N, Pa; a slice 1 m
thick), x to the right, y up. The format is explained in `sections/jiufengershan.yaml`, the
slope of Taboada and Estrada (2009), sections 5 and 6.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

import numpy as np
from shapely.geometry import Polygon

from . import geometry, roles, section_defaults
from .section_reader import SectionError, read, take

__all__ = ["Disks", "End", "Envelope", "Interface", "Layer", "Material", "Numerics", "Section", "SectionError", "Settle",
           "SlipWeakening", "Stages", "Wall", "Water", "load", "of", "shipped"]

FOLDER = Path(__file__).resolve().parent / "sections"

# Walls order the disks along them, so a packing is looser there: as if a strip of this part of
# the mean size were void. Measured on packings of 3,000 and 21,000 disks.
BORDER_STRIP = 0.085

MOST_DISKS = 10_000_000  # what asks for more is a slip of the pen: a million takes 2 GB and some seconds a step


@dataclass(frozen=True)
class SlipWeakening:
    """Strength of a wall beyond the slip `critical_slip` D_c [m] (paper, section 5.3).

    `law`: "step", "linear" or "exponential"; `friction` and `tensile_strength` [Pa] are what is left in the end.
    """

    law: str
    critical_slip: float
    friction: float = 0.0
    tensile_strength: float = 0.0


@dataclass(frozen=True)
class Envelope:
    """Macroscopic peak strength of a material as biaxial tests measured it: `cohesion` [Pa], `friction_deg` [degrees]."""

    cohesion: float
    friction_deg: float


@dataclass(frozen=True)
class Material:
    """Contact parameters (paper, section 2.2 and Table 1): strengths in Pa, lengths in units of ℓ."""

    name: str
    friction: float
    residual_friction: float
    rolling_friction: float
    residual_rolling_friction: float
    tensile_strength: float = 0.0
    residual_tensile_strength: float = 0.0
    bond_ellipse: tuple[float, float] = (0.02, 0.02)
    bond_creation_distance: float = 0.02
    restitution: float = 0.0
    density: float | None = None
    bonded: bool = True
    slip_weakening: SlipWeakening | None = None
    envelope: Envelope | None = None

    @property
    def critical_slip(self) -> float:
        """D_c [m]; infinite without slip weakening."""
        return self.slip_weakening.critical_slip if self.slip_weakening else math.inf


@dataclass(frozen=True)
class Wall:
    """A polyline with a material; `vertices`: tuple of (x, y) [m], the mass on their left. Joints with other walls are bit-identical.

    `role`: "slip", "backstop", "ground" or "obstacle", see :mod:`.roles`.
    """

    name: str
    material: str
    vertices: tuple[tuple[float, float], ...]
    apart: bool = False
    role: str | None = None

    @property
    def points(self) -> np.ndarray:
        """Vertices as an array (n, 2) [m]."""
        return np.array(self.vertices)


@dataclass(frozen=True)
class Layer:
    """A polygon to be filled with disks; `vertices`: tuple of (x, y) [m], not closed.

    `role`: "mass", "bed" (erodible ground, counted apart) or "obstacle"; `disks`: its own, or None for those of the section.
    """

    name: str
    material: str
    vertices: tuple[tuple[float, float], ...]
    role: str = "mass"
    disks: Disks | None = None

    @property
    def points(self) -> np.ndarray:
        """Vertices as an array (n, 2) [m]."""
        return np.array(self.vertices)

    @property
    def polygon(self) -> Polygon:
        """The layer as a shapely polygon."""
        return Polygon(self.vertices)

    @property
    def area(self) -> float:
        """Area [m²]."""
        return geometry.area(self.vertices)

    def with_disks(self, factor: float) -> Layer:
        """The same layer with its own disks, where it has some, `factor` times as large."""
        d = self.disks
        return self if d is None else dataclasses.replace(self, disks=dataclasses.replace(d, d_min=d.d_min * factor, d_max=d.d_max * factor))


@dataclass(frozen=True)
class Interface:
    """Contacts of the disks of two layers, whose law is that of a `material`; `between`: names of the layers, the lower one first; `role`: "slip" or None;
    `flat`: disks are packed on their sides of the border, so that those of the two layers do not interlock."""

    name: str
    between: tuple[str, str]
    material: str
    role: str | None = None
    flat: bool = True


@dataclass(frozen=True)
class Disks:
    """Diameters `d_min` to `d_max` [m], distribution, packing fraction, and the count asked for (or None)."""

    d_min: float
    d_max: float
    distribution: str
    packing_fraction: float
    count: int | None = None

    @property
    def mean_square(self) -> float:
        """Mean of d² [m²] over the disks by number."""
        a, b = self.d_min, self.d_max
        return a * b if self.distribution == "uniform_by_volume" else (a * a + a * b + b * b) / 3

    def diameters(self, quantile) -> np.ndarray:
        """Diameters [m] at `quantile` (array of numbers from 0 to 1) of the distribution by number."""
        q, a, b = np.asarray(quantile, float), self.d_min, self.d_max
        if self.distribution == "uniform_by_volume":  # density ~ d^-2 in two dimensions
            return 1 / (1 / a - q * (1 / a - 1 / b))
        return a + q * (b - a)


@dataclass(frozen=True)
class Water:
    """Water table above a plane (paper, sections 3.4, 5.4).

    `point` (x, y) [m] on the plane; `dip` β [degrees], positive down to the right; `gradient`
    (x, y) [N/m³], force per volume on a wet disk; `volume` "disk" or "bulk"; `table`: points
    (t, h) [s, m]; `rate` [m/s], the rise after the last point; `release_distance` [m];
    `wall`: name of the wall the plane was given by, or None.
    """

    unit_weight: float
    point: tuple[float, float]
    dip: float
    gradient: tuple[float, float]
    volume: str
    table: tuple[tuple[float, float], ...]
    rate: float
    release_distance: float
    wall: str | None = None

    @property
    def normal(self) -> tuple[float, float]:
        """Unit vector normal to the plane, upwards."""
        return _normal(self.dip)

    def height(self, t):
        """Height [m] of the table above the plane at the time t [s] (scalar or array) since t0."""
        times, heights = np.array(self.table).T
        t = np.asarray(t, float)
        h = np.interp(t, times, heights) + self.rate * np.maximum(t - times[-1], 0)
        return h if h.ndim else float(h)


@dataclass(frozen=True)
class Settle:
    """Settling: at most `time_max` [s], until the mean speed is below `speed_rest` [m/s].

    Gravity grows to its value during the first `ramp` [s]. `bond`: "before" it grows, or "after" the packing has come to rest under it.
    """

    ramp: float
    time_max: float
    speed_rest: float
    bond: str = "before"


@dataclass(frozen=True)
class End:
    """End: at `time` [s] after bonding at the latest.

    Or `rest_hold` [s] after the mean speed fell below `rest_fraction` of its maximum.
    """

    time: float
    rest_fraction: float
    rest_hold: float


@dataclass(frozen=True)
class Stages:
    """Course of the experiment; `dry` [s]; `water_hold`: "motion", "never" or a height [m]."""

    settle: Settle
    dry: float
    water_hold: str | float
    end: End


@dataclass(frozen=True)
class Numerics:
    """`time_step` [s], at most so long that disks in contact go the `path` against each other in mean diameters (None: always as long); relative
    `tolerance`, and `tolerance_moving` while the slope moves, `max_iterations` a step, `verlet_distance` in smallest radii.
    """

    time_step: float
    tolerance: float
    tolerance_moving: float
    max_iterations: int
    verlet_distance: float
    path: float | None = None


@dataclass(frozen=True)
class Section:
    """A checked section. `source`: file read; `scale`: diameters by those of the file; `like`: a section that is packed instead, and the factor by which its disks are
    then as large (see :mod:`.similar`), or None."""

    name: str
    description: str
    gravity: float
    walls: tuple[Wall, ...]
    layers: tuple[Layer, ...]
    materials: Mapping[str, Material]
    disks: Disks
    water: Water | None
    stages: Stages
    numerics: Numerics
    seed: int
    source: str
    interfaces: tuple[Interface, ...] = ()
    scale: float = 1.0
    like: tuple[Section, float] | None = dataclasses.field(default=None, compare=False, repr=False)

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

    @property
    def area(self) -> float:
        """Area of all layers [m²]."""
        return math.fsum(layer.area for layer in self.layers)  # not sum, which Python 3.12 made another sum

    @cached_property
    def dip(self) -> float:
        """β [degrees] of the slope, positive down to the right: of its slip surfaces from end to end, see :mod:`.roles`."""
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
        return _normal(self.dip)

    def of_role(self, *wanted: str) -> tuple[Wall, ...]:
        """The walls that have one of these roles, in the order of the file."""
        return tuple(wall for wall in self.walls if wall.role in wanted)

    @cached_property
    def slip_surfaces(self) -> tuple[tuple[str, np.ndarray], ...]:
        """Name and line (n, 2) [m] of each slip surface: walls, then interfaces."""
        return (*((wall.name, wall.points) for wall in self.of_role("slip")),
                *((i.name, self.line_of(i)) for i in self.interfaces if i.role == "slip"))

    def line_of(self, interface: Interface) -> np.ndarray:
        """The border of an interface's two layers from left to right, (n, 2) [m]; empty where they do not touch."""
        lower, upper = (self.layer(name).polygon for name in interface.between)
        return geometry.border(lower, upper, self.tolerance)

    def layer(self, name: str) -> Layer:
        """The layer called `name`; KeyError if there is none."""
        return next(layer for layer in self.layers if layer.name == name)

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
        """Length [m] of each layer's share of the outline, and of flat interfaces, to six digits: the next ones depend on the version of GEOS."""
        rim = self.outline.boundary.buffer(10 * self.tolerance)
        flat = [(i.between, self.line_of(i)) for i in self.interfaces if i.flat]
        inside = {layer.name: math.fsum(geometry.distance(*np.diff(line, axis=0).T).sum() for between, line in flat if layer.name in between) for layer in self.layers}
        return tuple(float(f"{layer.polygon.exterior.intersection(rim).length + inside[layer.name]:.6g}") for layer in self.layers)

    def disk_areas(self) -> tuple[float, ...]:
        """Area of disks [m²] in each layer that gives the packing fraction in the bulk.

        The packing fraction times the polygon's area, less a strip along the outline, which
        walls leave looser.
        """
        of = [self.disks_of(layer) for layer in self.layers]
        return tuple(d.packing_fraction * max(layer.area - BORDER_STRIP * math.sqrt(d.mean_square) * border, 0)
                     for d, layer, border in zip(of, self.layers, self._borders))

    def disk_counts(self) -> tuple[int, ...]:
        """Number of disks in each layer; rounding is carried from layer to layer."""
        if self.mixed:
            ends = np.rint(np.cumsum([a / (math.pi / 4 * self.disks_of(layer).mean_square) for a, layer in zip(self.disk_areas(), self.layers)])).astype(int)
        else:
            ends = np.rint(np.cumsum(self.disk_areas()) / (math.pi / 4 * self.disks.mean_square)).astype(int)
        return tuple(int(n) for n in np.diff(ends, prepend=0))

    def with_disks(self, count: int) -> Section:
        """The same slope with about `count` disks, all diameters scaled alike (paper, section 3.2.2).

        Raises SectionError where such disks are too large for the layers.
        """
        if isinstance(count, bool) or not 1 <= count <= MOST_DISKS or int(count) != count:
            raise SectionError(f"{self.source}: {count!r} disks; give a whole number from 1 to {MOST_DISKS}")
        if self.like:
            original, factor = self.like[0].with_disks(count), self.like[1]
            disks = dataclasses.replace(original.disks, d_min=factor * original.disks.d_min, d_max=factor * original.disks.d_max)
            layers = tuple(dataclasses.replace(mine, disks=theirs.with_disks(factor).disks) for mine, theirs in zip(self.layers, original.layers))
            return dataclasses.replace(self, disks=disks, layers=layers, scale=original.scale, like=(original, factor))
        m = self.disks.mean_square
        phi = self.disks.packing_fraction
        if self.mixed:  # count = full / s² - strip / s
            of = [self.disks_of(layer) for layer in self.layers]
            inside = math.fsum(d.packing_fraction * layer.area / (math.pi / 4 * d.mean_square) for d, layer in zip(of, self.layers))
            strip = math.fsum(d.packing_fraction * BORDER_STRIP * b / (math.pi / 4 * math.sqrt(d.mean_square)) for d, b in zip(of, self._borders))
            s = (math.sqrt(strip**2 + 4 * count * inside) - strip) / (2 * count)
        else:
            strip = phi * BORDER_STRIP * math.sqrt(m) * math.fsum(self._borders)
            full = count * math.pi / 4 * m
            s = (math.sqrt(strip**2 + 4 * full * phi * self.area) - strip) / (2 * full)
        disks = dataclasses.replace(self.disks, d_min=self.disks.d_min * s, d_max=self.disks.d_max * s,
                                    count=int(count))
        scaled = dataclasses.replace(self, disks=disks, layers=tuple(layer.with_disks(s) for layer in self.layers), scale=self.scale * s)
        scaled._check_room(f"{count} disks", "ask for more disks")
        if self.numerics.time_step > scaled.longest_step:
            raise SectionError(f"{self.source}: {count} disks: the smallest, {scaled.smallest:.4g} m, would fall past its own diameter in a step of "
                               f"{self.numerics.time_step:g} s; lower numerics.time_step below {scaled.longest_step:.2g} s, or ask for fewer disks")
        return scaled

    def with_rock(self, rock: Material) -> Section:
        """The same slope with all layers of `rock`; the names of their materials stay. Raises SectionError for a rock without density."""
        if rock.density is None:
            raise SectionError(f"{rock.name}: no density, and layers are to be made of it; add `density` (kg/m³, of the disks)")
        names = {layer.material for layer in self.layers}
        made = {k: dataclasses.replace(rock, name=k, slip_weakening=None) if k in names else m for k, m in self.materials.items()}
        return dataclasses.replace(self, materials=MappingProxyType(made))

    @property
    def longest_step(self) -> float:
        """Time step [s] in which a disk that has fallen by its own diameter, the smallest one, falls by as much again."""
        return math.sqrt(self.smallest / (2 * self.gravity))

    def _check_room(self, what: str, remedy: str) -> None:
        total = sum(self.disk_counts()) if self.mixed else sum(self.disk_areas()) / (math.pi / 4 * self.disks.mean_square)
        if total > MOST_DISKS:
            raise SectionError(f"{self.source}: {what}: {total:.2g} disks would fill the layers, more than {MOST_DISKS}; give larger diameters")
        for polygon in geometry.parts(self.outline):
            largest = max(self.disks_of(layer).d_max for layer in self.layers if layer.polygon.intersects(polygon))
            if polygon.buffer(-largest / 2).is_empty or min(self.disk_counts()) < 1:
                x, y = polygon.representative_point().coords[0]
                raise SectionError(f"{self.source}: {what}: disks of {largest:.4g} m have no room "
                                   f"in the layers at ({x:.6g}, {y:.6g}); {remedy}")

    def key(self, scope: str = "packing") -> str:
        """SHA-256 (hex) of all that determines a packing, the seed apart; names and comments do not.

        scope "packing": layers and disks; "settled": also walls, materials, gravity, numerics
        and the settling stage.
        """
        d = self.disks
        content = {"layers": [layer.vertices for layer in self.layers],
                   "disks": [d.d_min, d.d_max, d.distribution, d.packing_fraction]}
        if self.mixed:
            content["disks"] = [[d.d_min, d.d_max, d.distribution, d.packing_fraction] for d in map(self.disks_of, self.layers)]
        if any(i.flat for i in self.interfaces):
            content["flat"] = [[x.tolist() for x in self.line_of(i)] for i in self.interfaces if i.flat]
        if self.like:
            content["like"] = [self.like[0].key(), self.like[1]]
        if scope == "settled":
            plain = {name: {k: v for k, v in dataclasses.asdict(m).items() if k not in ("name", "envelope")}
                     for name, m in self.materials.items()}
            content |= {"walls": [[w.vertices, plain[w.material]] for w in self.walls],
                        "rock": [plain[layer.material] for layer in self.layers], "gravity": self.gravity,
                        "numerics": dataclasses.asdict(self.numerics),
                        "settle": dataclasses.asdict(self.stages.settle)}
            if self.interfaces:
                number = {layer.name: k for k, layer in enumerate(self.layers)}
                content["interfaces"] = [[[number[name] for name in i.between], plain[i.material]] for i in self.interfaces]
        elif scope != "packing":
            raise ValueError(f"scope {scope!r}; give packing or settled")
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _normal(dip: float) -> tuple[float, float]:
    """Unit vector normal to a plane that dips by so many degrees, upwards."""
    b = math.radians(dip)
    return math.sin(b), math.cos(b)


def shipped() -> list[str]:
    """Names of the sections that come with the package."""
    return sorted(p.stem for p in FOLDER.glob("*.yaml") if not p.stem.endswith(".schema"))


def load(path_or_name) -> Section:
    """Read and check a section: the path of a YAML file, or the name of a shipped one.

    Raises SectionError (a ValueError) with file, line, key, value and remedy.
    """
    path = Path(path_or_name)
    try:
        # a folder of results may have the name of a shipped section
        given = path.suffix in (".yaml", ".yml") or (path.exists() and not path.is_dir()) or path.name != str(path_or_name)
    except (OSError, ValueError) as error:  # a name that no system takes
        raise SectionError(f"{str(path)[:60]!r}: no path ({getattr(error, 'strerror', None) or error}); give a path or one of: {', '.join(shipped())}") from None
    if not given:
        if path.name not in shipped():
            raise SectionError(f"{path}: neither a file nor a shipped section; give a path or one of: "
                               f"{', '.join(shipped())}")
        path = FOLDER / f"{path.name}.yaml"
    return _build(read(path, FOLDER / "section.schema.yaml"), str(path))


def of(data: Mapping | None = None, source: str = "section", **keys) -> Section:
    """A Section from data of Python: a dictionary with the keys of a section file, or these as keywords. Points may be tuples or arrays.

    Checked as a file is: raises SectionError with key, value and remedy, after `source`.
    """
    return _build(take({**(data or {}), **keys}, source, FOLDER / "section.schema.yaml"), source)


def _build(document, source: str) -> Section:
    """Section from a document that meets the schema; the checks that a schema cannot make."""
    from . import section_checks

    section_checks.check_extent(document)
    raw = document.data = section_defaults.filled(document.data)
    walls = section_checks.walls(document)
    size = raw["disks"]
    disks = Disks(*map(float, size["diameter"]), size["distribution"], float(size["packing_fraction"]))
    layers = tuple(Layer(v["name"], v["material"], _points(v["vertices"]), v.get("role", "mass"), _own(v.get("disks"), disks)) for v in raw["layers"])
    interfaces = tuple(Interface(v.get("name", "-".join(v["between"])), tuple(v["between"]), v["material"], v.get("role"), v.get("flat", True))
                       for v in raw.get("interfaces", ()))
    stages = raw["stages"]
    section = Section(
        name=raw["name"], description=raw.get("description", "").strip(), gravity=float(raw["gravity"]),
        walls=walls, layers=layers,
        materials=MappingProxyType({k: material_from(k, v) for k, v in raw["materials"].items()}),
        disks=disks, water=None,
        stages=Stages(Settle(**{k: v if k == "bond" else float(v) for k, v in stages["settle"].items()}), float(stages["dry"]),
                      stages.get("water", {}).get("hold", "motion"), End(**_floats(stages["end"]))),
        numerics=Numerics(**raw["numerics"]), seed=raw["seed"], source=source, interfaces=interfaces)
    section_checks.check(section, document)
    if "water" in raw:
        section = dataclasses.replace(section, water=_water(raw["water"], section, document))
    section = dataclasses.replace(section, walls=roles.assigned(section))
    section_checks.check_roles(section, document)
    if "count" in size:
        section = section.with_disks(size["count"])
    return section


def _own(raw, disks: Disks) -> Disks | None:
    """A layer's own disks: what it says, and the section's `disks` for the rest."""
    if raw is None:
        return None
    low, high = map(float, raw.get("diameter", (disks.d_min, disks.d_max)))
    return Disks(low, high, raw.get("distribution", disks.distribution), float(raw.get("packing_fraction", disks.packing_fraction)))


def _points(vertices) -> tuple[tuple[float, float], ...]:
    return tuple((float(x), float(y)) for x, y in vertices)


def _floats(mapping) -> dict:
    return {k: float(v) for k, v in mapping.items()}


def material_from(name: str, raw: dict) -> Material:
    raw = dict(raw)
    raw.setdefault("residual_friction", raw["friction"])
    raw.setdefault("residual_rolling_friction", raw["rolling_friction"])
    if "bond_ellipse" in raw:
        raw["bond_ellipse"] = tuple(map(float, raw["bond_ellipse"]))
    if "slip_weakening" in raw:
        raw["slip_weakening"] = SlipWeakening(**raw["slip_weakening"])
    if "envelope" in raw:
        raw["envelope"] = Envelope(**_floats(raw["envelope"]))
    return Material(name, **{k: float(v) if isinstance(v, int) and not isinstance(v, bool) else v
                             for k, v in raw.items()})


def _water(raw: dict, section: Section, document) -> Water:
    plane, wall = raw["plane"], None
    if isinstance(plane, str):
        names = [w.name for w in section.walls]
        if plane not in names:
            document.refuse(("water", "plane"), f"no wall is called {plane!r}",
                            f"give one of {', '.join(names)}, or {{point: [x, y], dip: degrees}}")
        wall = section.wall(plane)
        if not geometry.straight(wall.vertices, section.tolerance):
            document.refuse(("water", "plane"), f"the wall {plane} is not straight",
                            "give a straight wall, or {point: [x, y], dip: degrees}")
        dx, dy = wall.points[-1] - wall.points[0]
        if dx == 0:
            document.refuse(("water", "plane"), f"the wall {plane} is vertical",
                            "give a plane that dips less than 90 degrees")
        point, dip = min(wall.vertices, key=lambda p: p[1]), roles.dip_of(dx, dy)
    else:
        point, dip = tuple(map(float, plane["point"])), float(plane["dip"])
    gradient = raw["gradient"]
    if gradient == "buoyant":  # eq. 18
        b = math.radians(dip)
        gradient = tuple(float(raw["unit_weight"] * math.cos(b) * n) for n in (math.sin(b), math.cos(b)))
    table = raw["table"]
    points = _points(table.get("points", [[0.0, 0.0]]))
    for i, (before, after) in enumerate(zip(points, points[1:]), 1):
        if after[0] <= before[0]:
            document.refuse(("water", "table", "points", i), f"the time {after[0]:g} s does not follow {before[0]:g} s",
                            "give the times in rising order")
    return Water(float(raw["unit_weight"]), point, dip, tuple(map(float, gradient)), raw["volume"], points,
                 float(table.get("rate", 0.0)), float(raw["release_distance"]), wall.name if wall else None)
