"""A made-up run of the shipped section whose every answer is known: straight lines in time, so that a mean over a
second is a value half a second before.

Rows are 0.1 s apart, from 0.1 s to 100 s: settled at 5 s, t0 at 10 s, moving at 30.5 s, D_c reached at 35 s, at rest
from 85 s on. What a summary must not count, such as the settling, has values that would show.
"""

import dataclasses
import math

import numpy as np

import synthetic_slope as synthetic

records, section = synthetic.load("records"), synthetic.load("model.section")
COLUMNS, WALL_COLUMNS = (getattr(synthetic.load("studies.slope.columns"), name) for name in ("COLUMNS", "WALL_COLUMNS"))
SHIPPED = section.load("jiufengershan")
ROW, COUNT = 0.1, 1000
STATE = {
    "stage": "done",
    "settled": 5.0,
    "t0": 10.0,
    "moving": 30.5,
    "failed_dry": None,
    "front0": 100.0,
    "bonds_initial": 41000,
    "contacts_initial": 43000,
    "packing_fraction": 0.84,
    "wall_s": 321.0,
    "wall_packing_s": 12.5,
    "first_step": 1,
    "overlap_worst_ever": 0.03,
    "way_worst_ever": 0.4,
}
BIN = 12.0  # m, of the deposit's profile: three mean diameters


def series():
    """All columns: {name: array}."""
    t = np.arange(1, COUNT + 1) / 10

    def line(*points):
        return np.interp(t, *zip(*points))

    settling = t <= 5 + 1e-9
    share = line((30, 0), (85, 1))
    index = np.arange(1, COUNT + 1) - 50  # of the rows since it settled, from 1
    shear = np.select(
        [t <= 10, t <= 35, t <= 39, t <= 90],
        [440e6 + 2e6 * (10 - t), 440e6 - 3e6 * (t - 10), 365e6 * (1 - (t - 35) / 4), -20e6],
        -20e6 - 1e6 * (t - 90),
    )
    back = np.select(
        [t <= 10, t <= 30, t <= 40, t <= 45, t <= 90],
        [140e6 - 1e6 * (10 - t), 140e6 + 3e6 * (t - 10), 200e6, 300e6, 90e6],
        90e6 + 2e6 * (100 - t),
    )
    known = {
        "step": 50 * np.arange(1, COUNT + 1),
        "time_s": t,
        "stage": np.where(settling, 0, np.where(t <= 10 + 1e-9, 1, 2)),
        "water_m": 0.5 * np.clip(t - 10, 0, 20.5),
        "wet_disks": np.where(t > 15, 110, 0),
        "dp_shear_N_per_m": np.where(settling, 900e6, shear),
        "fb_normal_N_per_m": np.where(settling, 500e6, back),
        # by weakening 8 of the 765 disks that fit along DP; those before t0 are none of the water's
        "weakened_disks": np.select([settling, t < 9, t < 32 - 1e-9, t < 35 - 1e-9], [0, 50, 0, 7], 8),
        # it stirs, dips below 2 % of its maximum at 60 s, and comes to that for good shortly before it stands still
        "speed_mean_m_per_s": np.select(
            [settling, np.abs(t - 60.5) < 0.55], [45.0, 0.1], line((30.4, 0), (30.5, 0.25), (57, 30), (85.03, 0))
        ),
        "speed_max_m_per_s": np.where(settling, 999.0, line((30, 0), (50, 61.5), (85, 0))),
        "front_m": np.select([t < 0.15, t < 10.05], [50.0, 100.0], line((30, 100), (60, 1200), (85, 1100.5))),
        "centroid_x_m": np.select([t < 0.15, t < 9.95], [-510.0, -505.0], line((30, -500), (85, -300))),
        "centroid_y_m": np.select([t < 0.15, t < 9.95], [330.0, 310.0], line((30, 300), (85, 150))),
        "iterations": np.where(settling, 5000, np.where(t <= 57.5 + 1e-9, 10, 30)),
        "residual": np.where(settling, 1.0, 1e-8 * index),
        "residual_N_per_m": np.where(settling, 1e9, 3.0 * index),
        "tolerance": np.where(index <= 475, 1e-6, 2e-4),
        "overlap_worst_rel": np.select([settling, np.abs(t - 50) < 0.05], [0.5, 0.02], 0.01),
        "overlap_mean_rel": np.select(
            [settling, t < 9.05, t < 10.05, np.abs(t - 50) < 0.05], [0.4, 0.003, 0.001, 0.004], 0.002
        ),
        "energy_kinetic_J": np.where(settling, 9e9, line((30, 0), (55, 4e9), (85, 0))),
        "energy_water_J": np.where(t > 35, -3e9, 0.0),
        "energy_sliding_J": np.where(settling, 1e11, 6e9 * share),
        "energy_rolling_J": np.where(settling, 1e11, 1e9 * share),
        "energy_impact_J": np.where(settling, 1e11, 2e9 * share),
        "energy_bonds_J": np.where(settling, 1e11, 0.5e9 * share),
        "energy_correction_J": np.where(settling, 1e11, 1.9e8 * share),
        "energy_error_rel": np.select(
            [settling, np.abs(t - 31) < 0.05, np.abs(t - 70) < 0.05], [0.9, 0.02, -0.01], 0.0
        ),
    }
    return {name: known.get(name, np.zeros(COUNT)) for name in COLUMNS}


def pile(columns, section, bottom, heights, stray=()):
    """Arrays for write_snapshot: stacks of eleven disks of 2 m, one stack a bin of the profile, from ``bottom`` up to
    ``heights`` above the lowest wall in the middle of their bins; the first stack at x = ``columns``. ``stray``: (x, y)
    of single disks."""
    places = []
    for k, height in enumerate(heights):
        x = columns + BIN * k
        # of the highest disk's centre; bins begin at the first disk's left edge
        top = bottom(x - 2 + BIN / 2) + height - 2.0
        places += [(x, top - 3.0 * n) for n in range(11)]
    x, y = np.array(places + list(stray)).T
    zero = np.zeros(len(x))
    return {
        "x": x,
        "y": y,
        "r": np.full(len(x), 2.0),
        "angle": zero,
        "vx": zero,
        "vy": zero,
        "layer": zero.astype(int),
        "wet": zero > 0,
        "released": zero > 0,
    }


def plane(x):
    """Height of the shipped section's dipping plane."""
    return -548.303 / 1428.378 * x


def floor(x):
    """Height of its valley floor, from x = 473.3 m to 1000 m."""
    return 21.313


def begin():
    """Fifty stacks of 20 m on the plane: 12,000 m²."""
    return pile(-1000.0, SHIPPED, plane, [20.0] * 50)


def end():
    """Forty stacks on the valley floor, 30 m high but for one of 36 m: 14,472 m²; and a disk in the air over the
    last.
    """
    return pile(480.0, SHIPPED, floor, [30.0] * 12 + [36.0] + [30.0] * 27, stray=[(990.0, 300.0)])


def write(folder, columns=None, start=begin, stop=end):
    """A run's folder: its series, and its snapshots of t0 and of the end (None for one that it has not)."""
    columns = series() if columns is None else columns
    with records.SeriesWriter(folder / "series.csv", tuple(columns), overwrite=True) as writer:
        for row in zip(*(values.tolist() for values in columns.values())):
            writer.write(dict(zip(columns, row)))
    for name, made in (("t0.npz", start), ("end.npz", stop)):
        if made is not None:
            records.write_snapshot(folder / name, time_s=0.0, step=0, water_m=0.0, **made())
    return folder


def scaled(size):
    """The shipped section ``size`` times as large: walls, layers, disks, water, and times in proportion to √size."""
    time = math.sqrt(size)

    def stretch(vertices):
        return tuple((size * x, size * y) for x, y in vertices)

    walls, layers = (
        tuple(dataclasses.replace(item, vertices=stretch(item.vertices)) for item in items)
        for items in (SHIPPED.walls, SHIPPED.layers)
    )
    disks = dataclasses.replace(SHIPPED.disks, d_min=size * SHIPPED.disks.d_min, d_max=size * SHIPPED.disks.d_max)
    water = dataclasses.replace(SHIPPED.water, point=stretch([SHIPPED.water.point])[0])
    envelope = SHIPPED.materials["rock"].envelope
    rock = dataclasses.replace(
        SHIPPED.materials["rock"], envelope=dataclasses.replace(envelope, cohesion=size * envelope.cohesion)
    )
    return (
        dataclasses.replace(
            SHIPPED, walls=walls, layers=layers, disks=disks, water=water, materials={**SHIPPED.materials, "rock": rock}
        ),
        time,
    )
