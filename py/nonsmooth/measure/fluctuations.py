"""How the stress of a biaxial test fluctuates while the sample shears, its short contractions, and what breaks its
bonds (Taboada and Estrada 2009, 4.2.3 and 5.2).

A sheared sample dilates and contracts in turn: strong chains of contacts form and the sample dilates, then they fail,
the stress drops and the sample contracts [56]. The paper says of its tests that fluctuations shrink with the disks'
size while averages stay [107], that each contraction is about the volume of a disk of average size, and that
contractions go with stress drops [108].
"""

from __future__ import annotations

import math

import numpy as np

from .strength import axial_stress, running_mean

__all__ = ["MODES", "contractions", "fluctuation", "measure", "shares_of_breaks"]

WINDOW = 1e-2  # strain over which the stress is averaged, about which it fluctuates
LEAST = 0.1  # of a mean disk's area: smaller contractions are the platens' and the solver's
MODES = ("tension", "shear", "torque", "mixed")


def fluctuation(strain, stress):
    """Standard deviation of the stress of rows about its mean over one per cent of strain, by that mean; NaN for less
    strain than that. Arrays (n,).
    """
    strain, stress = np.asarray(strain, float), np.asarray(stress, float)
    begin, mean = running_mean(strain - strain[0], stress, WINDOW)
    if not len(begin):
        return math.nan
    middle = begin + 0.5 * WINDOW + strain[0]
    inside = (strain >= middle[0]) & (strain <= middle[-1])
    about = np.interp(strain[inside], middle, mean)
    return float(np.std(stress[inside] / about - 1)) if inside.any() else math.nan


def contractions(volumetric, least):
    """Phases in which the volume falls by more than ``least`` before it rises by as much: list of (first, last) rows,
    of the highest and the lowest volume. ``volumetric``: (n,).
    """
    found, high, low = [], 0, 0
    falling = False
    for k, v in enumerate(np.asarray(volumetric, float)):
        if not falling:
            if v >= volumetric[high]:
                high = k
            elif volumetric[high] - v > least:
                falling, low = True, k
        elif v <= volumetric[low]:
            low = k
        elif v - volumetric[low] > least:
            found.append((high, low))
            falling, high = False, k
    return found + [(high, low)] * falling


def shares_of_breaks(series, row=-1):
    """Shares of the bonds broken until a row that broke in each of :data:`MODES`; None where none has."""
    broken = np.array([float(series[f"bonds_broken_{mode}"][row]) for mode in MODES])
    return dict(zip(MODES, (broken / broken.sum()).tolist())) if broken.sum() > 0 else None


def measure(series, plateau, area, disk_area):
    """Figures of a test's plateau, a dictionary.

    ``series``: columns as in `biaxial.COLUMNS`; ``plateau``: its strains; ``area`` of the sample before, ``disk_area``:
    mean of its disks [m²]. ``stress_fluctuation_rel``; ``contractions_per_percent`` of axial strain;
    ``contraction_disks``: their mean size in areas of a mean disk, None without any; ``contraction_with_drop``: the
    share of them in which σ₁ falls, None without any; ``broken_shares``: see :func:`shares_of_breaks`, at the end.
    """
    strain = np.asarray(series["strain"], float)
    late = (strain >= plateau[0]) & (strain <= plateau[1] + 1e-9)
    strain, stress = strain[late], axial_stress(series)[late]
    volume = np.asarray(series["volumetric_strain"], float)[late] * area / disk_area
    phases = contractions(volume, LEAST) if len(volume) else []
    spread = fluctuation(strain, stress) if len(strain) else math.nan
    return {
        "stress_fluctuation_rel": spread if math.isfinite(spread) else None,
        "contractions_per_percent": len(phases) / (100 * np.ptp(strain)) if len(strain) > 1 else None,
        "contraction_disks": float(np.mean([volume[a] - volume[b] for a, b in phases])) if phases else None,
        "contraction_with_drop": float(np.mean([stress[b] < stress[a] for a, b in phases])) if phases else None,
        "broken_shares": shares_of_breaks(series),
    }
