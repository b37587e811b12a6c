"""Packings: layers filled with disks, made, measured, written, read and cached.

`pack` fills a section's layers without overlap, just short of touching; gravity, friction and
the last settling are the simulation's business. Disks are drawn uniform by volume (Taboada and
Estrada 2009, section 5.1) at low-discrepancy places, so that density and sizes are even at once,
and freed of overlaps by minimising the harmonic overlap energy (FIRE; Bitzek et al. 2006). That
alone jams near a fraction of 0.84, so disks of nearly the same size, one squeezed and one less so,
change places on the way: the sizes stay, and the energy falls.

SI units. A packing that cannot be made, read or written raises `PackingError`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..model import free_surface, geometry
from ..model.section import similar
from ..system import cache, keys
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
SWEEPS = 40_000  # most FIRE steps
SWAP_EVERY = 20


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
    within about a diameter of their layer. Takes about 2 s for 3,000 disks, 10 s for 21,000.
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
    relaxer = _Relaxer(x, y, r * (1 + INFLATION), layer, _borders(section, layer), rng)
    relaxer.run(progress)
    packing = Packing(relaxer.x, relaxer.y, relaxer.r / (1 + INFLATION), layer)
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


def _close_pairs(x, y, r, margin):
    """Pairs (i, j) with a gap below `margin`, sorted; size classes keep the search narrow."""
    group = np.frexp(r / r.min())[1]
    places = np.column_stack((x, y))
    members = [np.flatnonzero(group == g) for g in np.unique(group)]
    trees = [cKDTree(places[m]) for m in members]
    found_i, found_j = [], []
    for a, (m, tree) in enumerate(zip(members, trees)):
        for b in range(a, len(members)):
            reach = r[m].max() + r[members[b]].max() + margin
            if a == b:
                i, j = tree.query_pairs(reach, output_type="ndarray").T
            else:
                near = tree.sparse_distance_matrix(trees[b], reach, output_type="ndarray")
                i, j = near["i"], near["j"]
            i, j = m[i], members[b][j]
            keep = geometry.distance(x[i] - x[j], y[i] - y[j]) < r[i] + r[j] + margin
            found_i.append(np.minimum(i, j)[keep])
            found_j.append(np.maximum(i, j)[keep])
    i, j = np.concatenate(found_i), np.concatenate(found_j)
    order = np.lexsort((j, i))
    return i[order], j[order]


def _close_edges(x, y, r, margin, table):
    """Pairs (disk, edge) with a gap below `margin`; also disks a little beyond the edge."""
    disks, walls = [], []
    for e, (start, t, length) in enumerate(zip(table.start, table.direction, table.length)):
        dx, dy = x - start[0], y - start[1]
        along, off = dx * t[0] + dy * t[1], dy * t[0] - dx * t[1]
        reach = r + margin
        near = np.flatnonzero((off < reach) & (off > -reach) & (along > -reach) & (along < length + reach))
        disks.append(near)
        walls.append(np.full(near.shape, e))
    return np.concatenate(disks), np.concatenate(walls)


def _edge_overlaps(x, y, r, disks, walls, table):
    """Overlap and its direction into the region (arrays) of each pair (disk, edge)."""
    start, t, length = table.start[walls], table.direction[walls], table.length[walls]
    dx, dy = x[disks] - start[:, 0], y[disks] - start[:, 1]
    along, off = dx * t[:, 0] + dy * t[:, 1], dy * t[:, 0] - dx * t[:, 1]
    nx, ny = -t[:, 1], t[:, 0]
    overlap = r[disks] - off
    # Next to a convex corner the edge goes on as a line; at a reflex one the corner itself pushes.
    before, after = (along < 0) & ~table.convex_start[walls], (along > length) & ~table.convex_end[walls]
    corner = before | after
    if corner.any():
        cx = dx - np.where(after, length, 0) * t[:, 0]
        cy = dy - np.where(after, length, 0) * t[:, 1]
        dist = np.maximum(geometry.distance(cx, cy), 1e-12)
        nx, ny = np.where(corner, cx / dist, nx), np.where(corner, cy / dist, ny)
        overlap = np.where(corner, np.where(after & (off > 0), r[disks] - dist, 0), overlap)
    return np.maximum(overlap, 0), nx, ny


class _Relaxer:
    """FIRE on the overlap energy of disks in a region, with swaps of like sizes within a layer."""

    def __init__(self, x, y, r, layer, borders, rng):
        self.x, self.y, self.r, self.layer, self.borders, self.rng = x, y, r, layer, borders, rng
        self.table = geometry.together([table for table, _ in borders]) if len(borders) > 1 else borders[0][0]
        self.skin = 0.3 * 2 * r.min()
        self.x0 = None

    def _neighbours(self):
        """Find neighbours anew where disks have moved too far since the last time."""
        if self.x0 is not None:
            moved = np.max((self.x - self.x0) ** 2 + (self.y - self.y0) ** 2)
            if moved <= (self.skin / 2) ** 2:
                return
        self.i, self.j = _close_pairs(self.x, self.y, self.r, self.skin)
        disks, walls, first = [], [], 0
        for table, acts in self.borders:
            near, edge = _close_edges(self.x, self.y, self.r, self.skin, table)
            keep = slice(None) if acts is None else acts[near]
            disks.append(near[keep])
            walls.append(edge[keep] + first)
            first += len(table.length)
        self.disks, self.walls = np.concatenate(disks), np.concatenate(walls)
        self.x0, self.y0 = self.x.copy(), self.y.copy()
        self.reach = self.r[self.i] + self.r[self.j]

    def _forces(self):
        """Forces (stiffness 1), the squeeze on each disk, and the worst overlap by mean diameter."""
        n = len(self.x)
        dx, dy = self.x[self.i] - self.x[self.j], self.y[self.i] - self.y[self.j]
        square = dx * dx + dy * dy
        a = np.flatnonzero(square < self.reach**2)
        i, j, reach, dist = self.i[a], self.j[a], self.reach[a], np.sqrt(square[a])
        overlap = reach - dist
        f = overlap / np.maximum(dist, 1e-12)
        fx, fy = f * dx[a], f * dy[a]
        wall, nx, ny = _edge_overlaps(self.x, self.y, self.r, self.disks, self.walls, self.table)
        ax = np.bincount(i, fx, n) - np.bincount(j, fx, n) + 2 * np.bincount(self.disks, wall * nx, n)
        ay = np.bincount(i, fy, n) - np.bincount(j, fy, n) + 2 * np.bincount(self.disks, wall * ny, n)
        squeeze = np.bincount(i, overlap, n) + np.bincount(j, overlap, n) + 2 * np.bincount(self.disks, wall, n)
        worst = max((2 * overlap / reach).max(initial=0), (wall / (2 * self.r[self.disks])).max(initial=0))
        return ax, ay, squeeze, worst

    def _swap(self, squeeze):
        """Exchange places of disks of like size in a layer where the larger one is squeezed more."""
        order = np.lexsort((self.r, self.layer))
        n = len(order)
        stride = int(self.rng.integers(1, max(2, n // 50)))
        first = int(self.rng.integers(0, 2 * stride))
        k = np.arange(first, n - stride)
        k = k[((k - first) // stride) % 2 == 0]
        small, large = order[k], order[k + stride]
        # Growth squeezes the small one in turn; asking for more gain than this packs far more slowly.
        gain = squeeze[large] - squeeze[small] > self.r[large] - self.r[small]
        gain &= self.layer[small] == self.layer[large]
        small, large = small[gain], large[gain]
        if len(small):
            self.r[small], self.r[large] = self.r[large], self.r[small]
            self.x0 = None

    def run(self, progress=None):
        """Move the disks until no overlap exceeds the target, or the sweeps are used up."""
        n = len(self.x)
        mobility = self.r.mean() / self.r
        vx, vy = np.zeros(n), np.zeros(n)
        dt, mix, downhill, shown = 0.2, 0.1, 0, 0.0
        stride = 0.5 * self.r.min()
        for sweep in range(SWEEPS):
            self._neighbours()
            fx, fy, squeeze, worst = self._forces()
            if progress and sweep % 100 == 0:
                shown = max(shown, min(0.99, math.log(2 / max(worst, TARGET)) / math.log(2 / TARGET)))
                progress(shown)
            if worst < TARGET:
                return
            if sweep % SWAP_EVERY == SWAP_EVERY - 1:
                self._swap(squeeze)
                mobility = self.r.mean() / self.r
            ax, ay = fx * mobility, fy * mobility
            # Sums of products, not np.dot: a threaded BLAS would make bits depend on the machine's load.
            if np.sum(fx * vx + fy * vy) > 0:
                downhill += 1
                ratio = mix * math.sqrt(np.sum(vx * vx + vy * vy) / np.sum(ax * ax + ay * ay))
                vx, vy = (1 - mix) * vx + ratio * ax, (1 - mix) * vy + ratio * ay
                if downhill > 5:
                    dt, mix = min(1.1 * dt, 1.0), 0.99 * mix
            else:
                vx[:], vy[:] = 0, 0
                dt, mix, downhill = max(0.5 * dt, 0.05), 0.1, 0
            vx += dt * ax
            vy += dt * ay
            longest = dt * math.sqrt(np.max(vx * vx + vy * vy))
            if longest > stride:
                vx *= stride / longest
                vy *= stride / longest
            self.x = self.x + dt * vx
            self.y = self.y + dt * vy


def overlaps(packing: Packing, region=None) -> Overlaps:
    """Overlaps of the disks with each other and, given a (multi-)polygon, with its border."""
    x, y, r = packing.x, packing.y, packing.r
    i, j = _close_pairs(x, y, r, 0.02 * 2 * r.max())
    size = r[i] + r[j]
    gap = geometry.distance(x[i] - x[j], y[i] - y[j]) / size - 1
    near = np.maximum(-gap[gap < 0.02], 0)
    worst = near.max(initial=0)
    if region is not None:
        table = geometry.edges(region)
        disks, walls = _close_edges(x, y, r, 0.0, table)
        wall = _edge_overlaps(x, y, r, disks, walls, table)[0]
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
