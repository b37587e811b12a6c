"""Cycles of stress in a sheared sample: it builds up while the sample dilates, then strong chains of contacts fail, it
drops, and the sample contracts (Taboada and Estrada 2009, [56], Figure 6).

A cycle is a rise of the deviator stress σ₁ − σ₃ by more than :data:`LEAST` of its mean on the plateau, and a drop by as
much within :data:`SHORT` rows. A row takes √(m/σ₃), the time in which the pressure moves a disk by its own size, so a
collapse takes some of them. Where the stress falls slowly before it drops, that belongs to the time before, and where
it falls slowly only, that is no drop.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .fluctuations import contractions
from .strength import axial_stress

__all__ = ["LEAST", "NUMBERS", "Cycle", "deepest", "deviator", "find", "measure"]

LEAST = 0.05  # of the mean deviator stress: smaller waves are no reorganisation of the whole sample
SHORT = 5  # rows, of a drop at most, and of the unstable phase that follows it
SHARP = 0.8  # of a drop within so many rows: what it does in the fewest rows, without the slow falls before and after
ENERGY = "energy_kinetic_J"

#: Numbers of :func:`measure`.
NUMBERS = (
    "cycles_per_percent",
    "cycle_build_strain",
    "cycle_drop_strain",
    "cycle_drop_rel",
    "cycle_dilates",
    "cycle_contracts",
    "cycle_contracts_by_chance",
    "cycle_both",
    "cycle_energy_build_rel",
    "cycle_energy_drop_rel",
)


@dataclass(frozen=True)
class Cycle:
    """Rows of a series: ``begin``, where the stress begins to build up; ``peak``, the last one before the drop; ``end``
    of the drop.
    """

    begin: int
    peak: int
    end: int


def deviator(series):
    """σ₁ − σ₃ of a test's rows [Pa], (n,): means over both platens and both sides. ``series``: columns as in
    `biaxial.COLUMNS`.
    """
    sides = (np.asarray(series[f"sigma3_{side}_Pa"], float) for side in ("left", "right"))
    return axial_stress(series) - 0.5 * sum(sides)


def find(stress, least):
    """The :class:`Cycle` s in a stress [Pa], (n,): rises, and the steepest drop in the falls after them, of more than
    ``least`` [Pa] each. That of the last one may go on at the end.
    """
    stress, found, begin = np.asarray(stress, float), [], 0
    for high, low in contractions(stress, least):
        first = begin + int(np.argmin(stress[begin : high + 1]))
        peak, end = _steepest(stress, high, low)
        if min(stress[high] - stress[first], stress[peak] - stress[end]) > least:
            found.append(Cycle(first, peak, end))
            begin = end
    return found


def _steepest(stress, high, low):
    """The rows, of those from ``high`` to ``low``, between which the stress drops within :data:`SHORT` rows: by
    :data:`SHARP` of the most that it does so, and more, in the fewest rows; of several the deepest.
    """
    pairs = [(a, b) for a in range(high, low) for b in range(a + 1, min(a + SHORT, low) + 1)]
    most = max(stress[a] - stress[b] for a, b in pairs)
    sharp = [(a, b) for a, b in pairs if stress[a] - stress[b] >= SHARP * most]
    return min(sharp, key=lambda pair: (pair[1] - pair[0], stress[pair[1]] - stress[pair[0]]))


def deepest(series, begin, end):
    """The cycle with the deepest drop that lies between two strains, by rows of the whole series; None where there is
    none.
    """
    strain = np.asarray(series["strain"], float)
    rows = np.flatnonzero((strain >= begin - 1e-9) & (strain <= end + 1e-9))
    stress = deviator(series)
    found = find(stress[rows], LEAST * float(np.mean(stress[rows]))) if len(rows) else []
    if not found:
        return None
    best = max(found, key=lambda one: stress[rows[one.peak]] - stress[rows[one.end]])
    return Cycle(*(int(rows[k]) for k in (best.begin, best.peak, best.end)))


def measure(series, plateau):
    """Numbers of the cycles on a test's plateau, a dictionary by :data:`NUMBERS`; None where there is no cycle.

    ``series``: columns as in `biaxial.COLUMNS`; ``plateau``: its strains. ``cycles_per_percent`` of strain;
    ``cycle_build_strain``, ``cycle_drop_strain``: mean strains of both phases; ``cycle_drop_rel``: mean drop, of the
    mean deviator stress. ``cycle_dilates``: share of the cycles in which the volume grows while the stress builds up;
    ``cycle_contracts``: in which it falls below that of the peak in the drop or the :data:`SHORT` rows after it, beside
    ``cycle_contracts_by_chance``, the share of all rows that are followed by such a fall within as many rows;
    ``cycle_both``: with both. ``cycle_energy_build_rel``, ``cycle_energy_drop_rel``: mean kinetic energy while the
    stress builds up, and in drops and the rows after them, by that on the plateau (None for a series of earlier
    versions, without it).
    """
    strain = np.asarray(series["strain"], float)
    late = (strain >= plateau[0]) & (strain <= plateau[1] + 1e-9)
    found = dict.fromkeys(NUMBERS)
    if np.count_nonzero(late) < 2:
        return found
    strain, stress = strain[late], deviator(series)[late]
    volume = np.asarray(series["volumetric_strain"], float)[late]
    mean = float(np.mean(stress))
    cycles = find(stress, LEAST * mean)
    found["cycles_per_percent"] = len(cycles) / (100 * float(np.ptp(strain)))
    if not cycles:
        return found
    begin, peak, end = (np.array([getattr(one, name) for one in cycles]) for name in ("begin", "peak", "end"))
    settled = np.minimum(end + SHORT, len(volume) - 1)

    def falls(first, last):
        return volume[first : last + 1].min() < volume[first]

    dilates, contracts = volume[peak] > volume[begin], np.array([falls(a, b) for a, b in zip(peak, settled)])
    rows = round(float(np.mean(settled - peak)))
    found |= {
        "cycle_build_strain": float(np.mean(strain[peak] - strain[begin])),
        "cycle_drop_strain": float(np.mean(strain[end] - strain[peak])),
        "cycle_drop_rel": float(np.mean(stress[peak] - stress[end])) / mean,
        "cycle_dilates": float(np.mean(dilates)),
        "cycle_contracts": float(np.mean(contracts)),
        "cycle_contracts_by_chance": float(np.mean([falls(k, k + rows) for k in range(len(volume) - rows)])),
        "cycle_both": float(np.mean(dilates & contracts)),
    }
    if ENERGY in series:
        energy = np.asarray(series[ENERGY], float)[late]

        # a row is what it covers, so that of a peak is the last of the build-up
        def phase(first, last):
            return np.concatenate([energy[a + 1 : b + 1] for a, b in zip(first, last)])

        for name, rows in (("build", phase(begin, peak)), ("drop", phase(peak, settled))):
            found[f"cycle_energy_{name}_rel"] = float(np.mean(rows) / np.mean(energy))
    return found
