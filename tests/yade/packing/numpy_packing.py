"""The oracle of packings' bits: how disks were freed of overlaps before ``pkg/packing`` did it, in NumPy and SciPy.
Every packing there is rests on what it did, to the last bit.
"""

import math

import numpy as np
from scipy.spatial import cKDTree

from nonsmooth import packing
from nonsmooth.model import geometry

TARGET, SWEEPS, SWAP_EVERY = packing.TARGET, 40_000, 20


def pack(section, seed):
    """x, y and r of a packing of a section that is no other one's mirror image and is similar to none."""
    rng = np.random.default_rng(seed)
    x, y, r, layer = packing._draw(section, rng)
    relaxer = Relaxer(x, y, r * (1 + packing.INFLATION), layer, packing._borders(section, layer), rng)
    relaxer.run()
    return relaxer.x, relaxer.y, relaxer.r / (1 + packing.INFLATION)


def together(tables):
    """Several tables of edges as one, in their order."""
    return geometry.Edges(
        *(
            np.concatenate([getattr(t, name) for t in tables])
            for name in ("start", "direction", "length", "convex_start", "convex_end")
        )
    )


def close_pairs(x, y, r, margin):
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


def close_edges(x, y, r, margin, table):
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


def edge_overlaps(x, y, r, disks, walls, table):
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


class Relaxer:
    """FIRE on the overlap energy of disks in a region, with swaps of like sizes within a layer."""

    def __init__(self, x, y, r, layer, borders, rng):
        self.x, self.y, self.r, self.layer, self.borders, self.rng = x, y, r, layer, borders, rng
        self.table = together([table for table, _ in borders])
        self.skin = 0.3 * 2 * r.min()
        self.x0 = None

    def _neighbours(self):
        """Find neighbours anew where disks have moved too far since the last time."""
        if self.x0 is not None:
            moved = np.max((self.x - self.x0) ** 2 + (self.y - self.y0) ** 2)
            if moved <= (self.skin / 2) ** 2:
                return
        self.i, self.j = close_pairs(self.x, self.y, self.r, self.skin)
        disks, walls, first = [], [], 0
        for table, acts in self.borders:
            near, edge = close_edges(self.x, self.y, self.r, self.skin, table)
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
        wall, nx, ny = edge_overlaps(self.x, self.y, self.r, self.disks, self.walls, self.table)
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

    def run(self, sweeps=SWEEPS):
        """Move the disks until no overlap exceeds the target, or the sweeps are used up."""
        n = len(self.x)
        mobility = self.r.mean() / self.r
        vx, vy = np.zeros(n), np.zeros(n)
        dt, mix, downhill = 0.2, 0.1, 0
        stride = 0.5 * self.r.min()
        for sweep in range(sweeps):
            self._neighbours()
            fx, fy, squeeze, worst = self._forces()
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
