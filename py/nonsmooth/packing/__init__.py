"""Packings: layers filled with disks, made, measured, written, read and cached.

`pack` fills a section's layers without overlap, just short of touching; gravity, friction and
the last settling are the simulation's business. Disks are drawn uniform by volume (Taboada and
Estrada 2009, section 5.1) at low-discrepancy places, so that density and sizes are even at once,
and freed of overlaps (:mod:`.packing.relaxation`).

SI units. A packing that cannot be made, read or written raises `PackingError`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..model import free_surface, geometry
from ..model.section import similar
from ..system import cache, keys
from . import relaxation
from .files import FORMAT, Packing, PackingError, load, read_text, save, write_text

__all__ = [
    "CACHE",
    "FORMAT",
    "Overlaps",
    "Packing",
    "PackingError",
    "cache_path",
    "cached_pack",
    "load",
    "overlaps",
    "pack",
    "packing_fraction",
    "read_text",
    "save",
    "write_text",
]

CACHE = cache.Cache("packings", Packing)

# Disks are packed with radii this much larger than they get, so that overlaps left are gaps in the end.
INFLATION = 5e-4
TARGET = 0.8 * INFLATION  # worst overlap, relative to the mean diameter, at which the minimisation ends


@dataclass(frozen=True)
class Overlaps:
    """Overlaps by mean diameter: `worst` of any pair or wall, `mean` over the `pairs` with a gap below 2 %."""

    worst: float
    mean: float
    pairs: int


def pack(section, seed: int | None = None, progress=None) -> Packing:
    """Fill the layers of `section` with disks.

    `seed`: whole number, default the section's; the same seed gives the same bits. `progress`:
    called now and then with a share done, 0 to 1. Returns a Packing whose disks lie wholly
    inside the layers' outline, overlap nowhere by more than 1e-3 of their diameter, and stay
    within about a diameter of their layer. Takes about half a second for
    3,000 disks, 3.5 s for 21,000.
    Layers that will be pressed are filled a little higher (:attr:`.section.Section.packed_outline`).
    A slope that falls to the left gets the mirrored disks of its mirrored section, a similar one those of its original
    (`Section.like`). Raises PackingError where the disks do not go in.
    """
    if section.like:
        original, factor = section.like
        return similar.scaled_packing(pack(original, section.seed if seed is None else seed, progress), factor)
    if section.side < 0:
        return similar.mirrored_packing(pack(similar.mirrored(section), seed, progress))
    rng = np.random.default_rng(section.seed if seed is None else seed)
    x, y, r, layer = _draw(section, rng)
    disks = relaxation.disks(x, y, r * (1 + INFLATION), layer, _borders(section, layer))
    relaxation.relax(disks, TARGET, rng, progress)
    packing = Packing(disks.x, disks.y, disks.r / (1 + INFLATION), layer)
    found = overlaps(packing, section.packed_outline)
    inside = np.zeros(len(packing), bool)
    for polygon in geometry.parts(section.packed_outline):
        inside |= geometry.contains(polygon, packing.x, packing.y)
    if found.worst > 1e-3 or found.mean > 1e-5 or not inside.all():
        raise PackingError(
            f"{section.source}: {len(packing)} disks do not fit at a packing fraction of "
            f"{section.disks.packing_fraction:g} (worst overlap {found.worst:.1e} of a diameter, "
            f"{np.count_nonzero(~inside)} outside); lower disks.packing_fraction, widen disks.diameter "
            "or take more disks"
        )
    if progress:
        progress(1.0)
    return packing


def _draw(section, rng):
    """Places (uniform in each layer), radii and layer numbers, before overlaps are removed."""
    from scipy.stats import qmc  # as much as the rest of a start costs, and most starts pack nothing

    counts = section.disk_counts()
    polygons = [layer.polygon for layer in section.layers]
    origin, u, v, box = _box(section.outline)
    # shifted (Cranley and Patterson 1976) and not scrambled: versions of SciPy scramble differently
    sampler, shift = qmc.Halton(3, scramble=False), rng.random(3)
    xs, ys, qs = ([np.empty(0)] * len(counts) for _ in range(3))
    while any(len(q) < n for q, n in zip(qs, counts)):
        h = sampler.random(int(1.1 * sum(counts) * box / section.area) + 100) + shift
        h -= h >= 1
        px, py = (origin + h[:, :1] * u + h[:, 1:2] * v).T
        for k, polygon in enumerate(polygons):
            here = geometry.contains(polygon, px, py)
            xs[k], ys[k], qs[k] = (np.concatenate((a[k], b[here])) for a, b in ((xs, px), (ys, py), (qs, h[:, 2])))
    radii = []
    for q, n, layer in zip(qs, counts, section.layers):
        rank = np.argsort(np.argsort(q[:n], kind="stable"), kind="stable")
        radii.append(section.disks_of(layer).diameters((rank + rng.random(n)) / n) / 2)
    x, y = (np.concatenate([a[:n] for a, n in zip(s, counts)]) for s in (xs, ys))
    return x, y, np.concatenate(radii), np.repeat(np.arange(len(counts)), counts)


def _borders(section, layer):
    """Tables of edges, each with the disks that they act on (bool by disk, None: all): of the layers' outline, and on
    both sides of each flat interface.
    """
    found = [(geometry.edges(section.packed_outline), None)]
    for interface in section.interfaces:
        if interface.flat and len(line := section.line_of(interface)):
            if section.pressed:
                line = free_surface.lifted(section, line, free_surface.PRESSED)
            above, below = geometry.sides(line)
            lower, upper = (layer == k for k in section.numbers_of(interface))
            found += [(above, upper), (below, lower)]
    return found


def _box(region):
    """The box around a region along its longest edge: a corner, its sides (vectors) [m], and its area [m²]."""
    table = geometry.edges(region)
    t = table.direction[np.argmax(table.length)]
    n = np.array((-t[1], t[0]))
    along, off = (table.start[:, 0] * a[0] + table.start[:, 1] * a[1] for a in (t, n))
    size, width = along.max() - along.min(), off.max() - off.min()
    return along.min() * t + off.min() * n, size * t, width * n, size * width


def overlaps(packing: Packing, region=None) -> Overlaps:
    """Overlaps of the disks with each other and, given a (multi-)polygon, with its border."""
    x, y, r = packing.x, packing.y, packing.r
    i, j = relaxation.close_pairs(x, y, r, 0.02 * 2 * r.max())
    size = r[i] + r[j]
    gap = geometry.distance(x[i] - x[j], y[i] - y[j]) / size - 1
    near = np.maximum(-gap[gap < 0.02], 0)
    worst = near.max(initial=0)
    if region is not None:
        disks, _, wall, _, _ = relaxation.pushes(x, y, r, 0.0, geometry.edges(region))
        worst = max(worst, (wall / (2 * r[disks])).max(initial=0))
    return Overlaps(float(worst), float(near.mean()) if len(near) else 0.0, len(near))


def packing_fraction(packing: Packing, polygon, margin: float | None = None) -> float | None:
    """Share of the bulk's area that disks cover.

    `polygon`: shapely (multi-)polygon, or vertices (n, 2) [m]; the bulk is what is left of it
    without a border of `margin` [m], by default the largest diameter, so a surface that has
    settled by less than that does no harm. Circles across the border are cut by area; accurate
    to 1e-4. None where layers of a few disks have no bulk; raises PackingError where nothing is
    left within a margin that is given.
    """
    region = polygon if hasattr(polygon, "buffer") else geometry.Polygon(polygon)
    border = 2 * float(packing.r.max()) if margin is None else float(margin)
    bulk = region.buffer(-border, join_style=2)
    if bulk.is_empty and margin is None:
        return None
    if bulk.is_empty:
        raise PackingError(f"nothing of the layers is left within a margin of {margin:.4g} m; give a smaller margin")
    return geometry.area_inside(packing.x, packing.y, packing.r, bulk) / bulk.area


def cache_path(section, seed: int | None = None):
    """Where the packing of `section` and `seed` is kept, in :data:`CACHE`. Other code makes its own."""
    key = keys.key_of([section.key(), keys.made_by(__name__)])
    return CACHE.path(key, f"-{section.seed if seed is None else seed}")


def cached_pack(section, seed: int | None = None, progress=None) -> Packing:
    """`pack`, or what it made before for the same layers, disks and seed (see `cache_path`)."""
    return CACHE.of(cache_path(section, seed), lambda: pack(section, seed, progress))
