"""Made-up records that look like a run on the paper's slope, for developing and testing figures without YADE.

Nothing here is computed by mechanics: disks lie on a jittered lattice, forces and motion follow simple formulae.
"""

import importlib
import sys
import types
from pathlib import Path

import numpy as np

_SOURCE = Path(__file__).resolve().parents[2] / "py" / "nonsmooth"


def load(name):
    """A module of py/nonsmooth without its ``__init__`` (which may need YADE)."""
    if "nonsmooth_files" not in sys.modules:
        package = types.ModuleType("nonsmooth_files")
        package.__path__ = [str(_SOURCE)]
        sys.modules["nonsmooth_files"] = package
    return importlib.import_module("nonsmooth_files." + name)


DIP = np.radians(21)
DOWN = np.array([np.cos(DIP), -np.sin(DIP)])
NORMAL = np.array([np.sin(DIP), np.cos(DIP)])
LENGTH = 1500.0
LEVEL = 60.7  # top of the backstop, where SS begins
TIMES = {"t0": 5.0, "t1": 50.0, "t2": 52.5, "t3": 57.0, "t4": 70.0, "t5": 92.0}


class Section:
    """Stands for the scenario's section: walls, layers and characteristic times."""

    walls = [
        ("DP", np.array([-LENGTH * DOWN, [0.0, 0.0]]), "slip"),
        ("FB", np.array([[0.0, 0.0], 65 * NORMAL]), "backstop"),
        ("SS", np.array([65 * NORMAL, [700.0, 35.0], [1800.0, 60.0]]), "ground"),
    ]
    times = TIMES

    def __init__(self):
        def thickness(s):
            return 65 - 23 * s / LENGTH

        ends = (0.0, LENGTH)
        self.layers = [
            (
                f"layer {k + 1}",
                np.array(
                    [-s * DOWN + thickness(s) * k / 5 * NORMAL for s in ends]
                    + [-s * DOWN + thickness(s) * (k + 1) / 5 * NORMAL for s in ends[::-1]]
                ),
            )
            for k in range(5)
        ]


def _lattice(count, rng):
    """Slope coordinates s (up from the foot), n (above DP), radius and layer of about ``count`` disks."""
    pitch = np.sqrt(LENGTH * 53.5 / count * 2 / np.sqrt(3))
    row = pitch * np.sqrt(3) / 2
    rows, columns = int(65 / row), int(LENGTH / pitch)
    j, i = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    s = (i + 0.5 + 0.5 * (j % 2)).ravel() * pitch
    n = (j + 0.5).ravel() * row
    keep = (n < 65 - 23 * s / LENGTH - row / 3) & (s < LENGTH - pitch / 2)
    s, n = s[keep], n[keep]
    r = pitch * np.where(rng.random(len(s)) < 0.25, rng.uniform(0.3, 0.45, len(s)), rng.uniform(0.46, 0.55, len(s)))
    s, n = s + rng.normal(0, 0.06 * pitch, len(s)), n + rng.normal(0, 0.06 * pitch, len(s))
    n = np.maximum(n, r)
    s = np.maximum(s, r)
    layer = np.clip((5 * n / (65 - 23 * s / LENGTH)).astype(int), 0, 4)
    return s, n, r, layer


def _contacts(x, y, r, s, n, rng):
    """Pairs that nearly touch, with forces that grow with depth and towards the foot; a few in tension."""
    cell = 2.2 * r.max()
    key = np.floor(np.column_stack([x, y]) / cell).astype(np.int64)
    key = (key[:, 0] - key[:, 0].min() + 1) * 100003 + key[:, 1] - key[:, 1].min() + 1
    order = np.argsort(key, kind="stable")
    pairs = []
    for shift in (0, 1, 100003, 100002, 100004):
        a = np.searchsorted(key[order], key + shift, "left")
        b = np.searchsorted(key[order], key + shift, "right")
        for k in range(int((b - a).max())):
            i = np.flatnonzero(a + k < b)
            j = order[a[i] + k]
            ok = (i < j) if shift == 0 else (i != j)
            pairs.append(np.column_stack([i[ok], j[ok]]))
    i, j = np.vstack(pairs).T
    d = np.hypot(x[i] - x[j], y[i] - y[j])
    near = d < 1.08 * (r[i] + r[j])
    i, j, d = i[near], j[near], d[near]
    along = ((x[j] - x[i]) * DOWN[0] + (y[j] - y[i]) * DOWN[1]) / d
    depth = np.maximum(65 - 23 * s[i] / LENGTH - n[i], 1)
    stress = 21e3 * depth * (1 - along**2) + (19e3 * 55 + 1.2e6 * np.exp(-s[i] / 150)) * along**2
    cn = stress * 2 * r[i] * rng.exponential(1.0, len(i))
    pulled = rng.random(len(i)) < 0.06
    cn[pulled] = -rng.uniform(0, 1e5, pulled.sum()) * 2 * r[i][pulled]
    cx, cy = x[i] + (x[j] - x[i]) * r[i] / (r[i] + r[j]), y[i] + (y[j] - y[i]) * r[i] / (r[i] + r[j])
    for wall, (distance, direction) in enumerate(((n, -NORMAL), (s, DOWN))):
        k = np.flatnonzero(distance < 1.15 * r)
        load = 21e3 * 60 if wall == 0 else 2e6
        i, j = np.r_[i, k], np.r_[j, np.full(len(k), -1 - wall)]
        cn = np.r_[cn, load * 2 * r[k] * rng.exponential(1.0, len(k))]
        cx, cy = np.r_[cx, x[k] + r[k] * direction[0]], np.r_[cy, y[k] + r[k] * direction[1]]
    return {
        "ci": i,
        "cj": j,
        "cn": cn,
        "ct": 0.2 * cn * rng.uniform(-1, 1, len(cn)),
        "cbonded": j >= 0,
        "cx": cx,
        "cy": cy,
    }


def snapshot_arrays(count=3000, time=0.0, contacts=True, seed=1):
    """Arrays for ``write_snapshot`` at a time of the made-up avalanche."""
    rng = np.random.default_rng(seed)
    s, n, r, layer = _lattice(count, rng)
    share = np.clip((time - TIMES["t2"]) / (TIMES["t5"] - TIMES["t2"]), 0, 1)
    moved = 1000 * share**1.6 * (1 - 0.35 * share) / 0.65
    water = float(np.clip((time - TIMES["t0"]) * 0.5, 0, 22.5 + 0.1 * (time > TIMES["t1"])))
    position = -s[:, None] * DOWN + n[:, None] * NORMAL
    mobile = (
        position[:, 1] > LEVEL * np.clip(1 + 0.1 * position[:, 0] / 100, 0.2, 1) - 5
        if moved > 0
        else np.zeros(len(s), bool)
    )
    # Mobile disks follow the bed: DP down to the level of SS, then SS; they thicken at first and spread at the front.
    reach = LEVEL / np.sin(DIP)
    q = -s - n * np.tan(DIP) * 0 + moved * (0.75 + 0.35 * (1 - s / LENGTH))
    flat = q > -reach
    x = np.where(flat, (q + reach) - reach * np.cos(DIP), q * np.cos(DIP))
    bed = np.where(flat, LEVEL - 0.02 * np.maximum(x, 0), -q * np.sin(DIP))
    swell = np.where(flat, 1 + 0.5 * np.exp(-((x - 100) ** 2) / 5e4), 1.0) * (1 - 0.25 * share * (q > 0))
    folded = 6 * share * np.sin(q / 45) * flat
    moving = np.column_stack(
        [
            x + np.where(flat, 0, n * np.sin(DIP)),
            bed + np.maximum(n * swell * np.where(flat, 1, np.cos(DIP)) + folded, r),
        ]
    )
    position = np.where(mobile[:, None], moving, position)
    speed = np.where(mobile, 60 * np.sin(np.pi * np.sqrt(share)), 0.0) if share < 1 else np.zeros(len(s))
    under = (n < water) & (water > 0)
    released = under & mobile & (moved * (0.4 + s / LENGTH) > 5)
    arrays = {
        "time_s": time, "step": int(round(time / 0.005)), "water_m": water, "x": position[:, 0], "y": position[:, 1], "r": r,
        "angle": rng.uniform(-1, 1, len(s)) * share, "vx": speed * DOWN[0], "vy": speed * DOWN[1], "layer": layer,
        "wet": under & ~released, "released": released, "ever_wet": under, "weakened": (mobile & (moved > 5))[:, None],
    }  # fmt: skip
    if contacts:
        arrays.update(_contacts(position[:, 0], position[:, 1], r, s, n, rng))
    return arrays


def few(x, y, contacts=(), **changes):
    """A Snapshot of disks given one by one, at time 0 without water: of radius 1 m, in layer 0, dry and at rest unless
    ``changes`` say so.

    ``contacts``: (i, j, normal force [N/m]), or for wall number k (i, -1 - k, normal force, x, y of the point).
    """
    zero, no = np.zeros(len(x)), np.zeros(len(x), bool)
    arrays = {
        "time_s": 0.0,
        "step": 0,
        "water_m": 0.0,
        "x": np.array(x, float),
        "y": np.array(y, float),
        "r": zero + 1.0,
        "angle": zero,
        "vx": zero,
        "vy": zero,
        "layer": zero.astype(int),
        "wet": no,
        "released": no,
        **{name: np.asarray(value) for name, value in changes.items()},
    }
    if contacts:
        points = [c[3:] or (0.5 * (x[c[0]] + x[c[1]]), 0.5 * (y[c[0]] + y[c[1]])) for c in contacts]
        ci, cj, cn = (np.array(part) for part in zip(*(c[:3] for c in contacts)))
        arrays |= {
            "ci": ci,
            "cj": cj,
            "cn": cn.astype(float),
            "ct": 0.1 * cn,
            "cbonded": cj >= 0,
            "cx": np.array(points, float)[:, 0],
            "cy": np.array(points, float)[:, 1],
        }
    return load("records.snapshots").checked(arrays, "made up")


def series(columns, rows=4000, seed=2):
    """A made-up series with all ``columns``: dict of arrays."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 100, rows)
    t1, t2, t3, t5 = (TIMES[k] for k in ("t1", "t2", "t3", "t5"))
    h = np.clip((t - TIMES["t0"]) * 0.5, 0, 22.5) + np.clip((t - t1) * 0.5, 0, 1.2)
    drop = np.clip((t - t2) / (t3 - t2), 0, 1)
    run = np.clip((t - t3) / (t5 - t3), 0, 1)
    active = (t > t3) & (t < t5)

    def noise(scale):
        return 1 + scale * active * rng.standard_normal(rows)

    pore = 13.7e6 * h * (1 - drop)
    total = 1540e6 * (1 + 0.03 * drop) * (1 - 0.75 * run) * noise(0.12)
    effective = total - pore
    shear = np.where(t < t2, 0.3 * effective, 0.3 * (1540e6 - 13.7e6 * 23.5) * (1 - drop)) + 15e6 * (
        drop > 0.9
    ) * noise(2)
    shear = np.where(t > t5, -25e6, shear)
    back = 591e6 - 0.3 * (1540e6 - 13.7e6 * np.minimum(h, 22.5))
    back = np.where(t > t2, back + (260e6 - back) * np.sqrt(run), back) * noise(0.3)
    speed = 45 * np.sin(np.pi * np.sqrt(run)) * (run < 1) + 12 * drop * (run < 0.3) * (1 - run / 0.3)
    potential = 1.7e8 * 9.81 * (350 - 250 * run**1.3)
    kinetic = 0.6 * (potential[0] - potential) * (1 - run)
    lost = potential[0] - potential - kinetic + 3e9 * drop
    fill = {
        "step": np.arange(rows) * 5, "time_s": t, "water_m": h, "dp_normal_total_N_per_m": total,
        "dp_normal_effective_N_per_m": effective, "dp_water_N_per_m": pore, "dp_shear_N_per_m": shear,
        "fb_normal_N_per_m": back, "speed_mean_m_per_s": speed, "speed_max_m_per_s": 2 * speed,
        "iterations": np.round(40 + 160 * active + rng.exponential(15, rows)), "residual": 1e-5 * np.exp(rng.normal(-0.5, 0.5, rows)),
        "tolerance": np.full(rows, 1e-5),
        "overlap_worst_rel": 0.004 + 0.006 * active * rng.random(rows), "overlap_mean_rel": 1e-4 + 2e-4 * active * rng.random(rows),
        "energy_kinetic_J": kinetic, "energy_potential_J": potential, "energy_water_J": 3e9 * drop,
        "energy_sliding_J": 0.5 * lost, "energy_rolling_J": 0.1 * lost, "energy_impact_J": 0.4 * lost, "energy_bonds_J": 5e8 * drop,
        "energy_correction_J": 1e8 * run, "energy_error_rel": 0.004 * run + 0.001 * rng.random(rows),
    }  # fmt: skip
    return {name: fill.get(name, np.zeros(rows)) for name in columns}
