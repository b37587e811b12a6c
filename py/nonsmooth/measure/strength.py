"""Strength from the curves of biaxial tests: peak, plateau, dilatancy, and the envelope of Mohr's circles.

A circle of the stresses σ₁ ≥ σ₃ has its centre at s = (σ₁ + σ₃)/2 and the radius t = (σ₁ − σ₃)/2. The line τ = c + σ
tan φ touches it where

    t = c cos φ + s sin φ .

The envelope is the line that comes closest to touching all circles (Taboada and Estrada 2009, section 5.2, Figure 11):
least squares of the relative misses (t − c cos φ − s sin φ)/t, so that circles of low pressure, which alone tell the
cohesion, count as much as large ones. Neither c nor φ is let below zero.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import optimize

from .statistics import standard_error

__all__ = [
    "FIGURE_10",
    "ONSET",
    "ONSET_WINDOW",
    "PEAK_WINDOW",
    "PLATEAU",
    "SHORTEST",
    "SOFTENED",
    "Curve",
    "MohrEnvelope",
    "apparent_deg",
    "axial_stress",
    "curve",
    "envelope",
    "later_share",
    "lateral_stress",
    "mean_between",
    "onset",
    "running_mean",
]

PEAK_WINDOW = 2e-3  # strain over which the stress is averaged before its maximum is taken
# a peak's window begins where the stress has only begun to rise, so it tells less than a sample bears before it fails
ONSET, ONSET_WINDOW = 5e-3, 2e-4  # strain up to which a sample begins to fail; over which the stress is averaged then
DILATANCY_WINDOW = 5e-3  # strain around the peak over which the slope of the volume is taken
PLATEAU = 0.5  # share of a test's strain from which on the residual strength is the mean
# strain from which on the paper's tests are on their plateau (section 5.2); a mean that begins before is no residual
# strength
SOFTENED = 0.04
FIGURE_10 = (0.005, 0.02)  # strains between which the paper's curves have their peak, or a little more (Figure 10)
SHORTEST = PEAK_WINDOW / (1 - PLATEAU)  # strain of a test that has both a peak and a plateau to measure


@dataclass(frozen=True)
class Curve:
    """What one test says. Stresses [Pa]; ``confining`` as it was during peak or plateau; ``error``: standard error of
    the plateau's mean; ``dilatancy_deg``: NaN where fewer than three rows lie around the peak."""

    peak: float
    peak_strain: float
    peak_confining: float
    residual: float
    residual_error: float
    residual_confining: float
    dilatancy_deg: float
    imbalance: float  # largest difference between the platens around the peak and on the plateau, relative
    volumetric_end: float


def curve(series, plateau):
    """Figures of a test's series (columns as in `biaxial.COLUMNS`).

    ``plateau``: strains between which the residual strength is the mean. Raises ValueError where the test ends before
    the plateau has begun.
    """
    strain = np.asarray(series["strain"], float)
    if strain[-1] < plateau[0] + PEAK_WINDOW - 1e-8:
        raise ValueError(
            f"the test ended at a strain of {strain[-1]:.4f}, before the plateau, which begins at {plateau[0]:g}"
        )
    top, bottom = (np.asarray(series[f"sigma1_{name}_Pa"], float) for name in ("top", "bottom"))
    axial = axial_stress(series)
    lateral = lateral_stress(series)
    begin, mean = running_mean(strain, axial, PEAK_WINDOW)
    k = int(np.argmax(mean))
    middle = begin[k] + PEAK_WINDOW / 2
    at = np.abs(strain - middle) <= PEAK_WINDOW / 2 + 1e-12
    late = (strain >= plateau[0]) & (strain <= plateau[1] + 1e-9)
    blocks = [b.mean() for b in np.array_split(axial[late], 5)]
    around = np.abs(strain - middle) <= DILATANCY_WINDOW / 2
    # rows stand closer while the platens take up their speed; a row counts for the strain that it covers
    weight = np.sqrt(np.diff(strain, prepend=0.0)[around])
    slope = (
        np.polyfit(strain[around], np.asarray(series["volumetric_strain"], float)[around], 1, w=weight)[0]
        if around.sum() > 2
        else math.nan
    )

    def gap(where):
        return abs(top[where].mean() / bottom[where].mean() - 1)

    return Curve(
        peak=float(mean[k]),
        peak_strain=float(middle),
        peak_confining=float(lateral[at].mean()),
        residual=float(axial[late].mean()),
        residual_error=standard_error(blocks),
        residual_confining=float(lateral[late].mean()),
        # sin ψ = dε_v / (2 dε₁ + dε_v) in plane strain
        dilatancy_deg=math.degrees(math.asin(np.clip(slope / (2 + slope), -1.0, 1.0))),
        imbalance=float(max(gap(at), gap(late))),
        volumetric_end=float(series["volumetric_strain"][-1]),
    )


def onset(series) -> tuple[float, float, float]:
    """What a sample bears as it begins to fail: (σ₃, σ₁) [Pa] where σ₁, in means over :data:`ONSET_WINDOW` of strain,
    is the largest up to :data:`ONSET`, and the strain in the middle of that window. A slope that stands has not come
    farther on its curve.

    ``series``: of a test. Raises ValueError where the test ends before.
    """
    strain, axial = np.asarray(series["strain"], float), axial_stress(series)
    begin, mean = running_mean(strain, axial, ONSET_WINDOW)
    before = begin + ONSET_WINDOW <= ONSET + 1e-9
    if strain[-1] < ONSET - 1e-4:
        raise ValueError(f"the test ended at a strain of {strain[-1]:.4f}, before {ONSET:g}")
    k = int(np.argmax(mean[before]))
    middle = begin[k] + ONSET_WINDOW / 2
    at = np.abs(strain - middle) <= ONSET_WINDOW / 2 + 1e-12
    return float(lateral_stress(series)[at].mean()), float(mean[k]), float(middle)


def axial_stress(series):
    """σ₁ [Pa] of a test's rows, an array: mean of both platens."""
    return 0.5 * (np.asarray(series["sigma1_top_Pa"], float) + np.asarray(series["sigma1_bottom_Pa"], float))


def lateral_stress(series):
    """σ₃ [Pa] of a test's rows, an array: mean of both sides."""
    return 0.5 * (np.asarray(series["sigma3_left_Pa"], float) + np.asarray(series["sigma3_right_Pa"], float))


def running_mean(strain, values, window):
    """Means of ``values`` over ``window`` of strain: (the strains at which the windows begin, the means), arrays of m.

    ``strain``, ``values``: arrays of n, a row's strain at its end and the mean over what it covers; rows may cover more
    or less strain. Windows begin where rows do and are whole; none (m = 0) where ``strain`` ends before the first.
    """
    strain, values = np.asarray(strain, float), np.asarray(values, float)
    edges = np.concatenate(([0.0], strain))
    work = np.concatenate(([0.0], np.cumsum(values * np.diff(edges))))
    begin = edges[edges <= edges[-1] - window + 1e-12]
    return begin, (np.interp(begin + window, edges, work) - np.interp(begin, edges, work)) / window


def later_share(series) -> float | None:
    """The largest stress, in means as peaks are, between the strains of :data:`FIGURE_10` over the largest of all: 1
    where the peak lies there; None for a test that ends before.
    """
    begin, mean = running_mean(series["strain"], axial_stress(series), PEAK_WINDOW)
    middle = begin + PEAK_WINDOW / 2
    there = (middle >= FIGURE_10[0]) & (middle <= FIGURE_10[1])
    return float(mean[there].max() / mean.max()) if there.any() else None


def mean_between(series, low, high):
    """(σ₃, σ₁) [Pa], means over the strains from ``low`` to ``high`` of a test's series; None for a test that ends
    before ``high``, to half a row.
    """
    strain = np.asarray(series["strain"], float)
    there = (strain > low) & (strain <= high + 1e-9)
    covered = np.diff(strain, prepend=0.0)  # a row counts for the strain that it covers
    if strain[-1] < high - 0.5 * covered[-1]:
        return None
    both = lateral_stress(series), axial_stress(series)
    return tuple(float(np.average(stress[there], weights=covered[there])) for stress in both)


def apparent_deg(minor, major) -> float:
    """Angle of friction [°] of a rock without cohesion that fails under σ₃ = ``minor`` at σ₁ = ``major`` [Pa]: sin φ =
    (σ₁ − σ₃)/(σ₁ + σ₃).
    """
    return math.degrees(math.asin((major - minor) / (major + minor)))


@dataclass(frozen=True)
class MohrEnvelope:
    """Cohesion [Pa], angle of friction [°], and the relative miss of each circle."""

    cohesion: float
    friction_deg: float
    misses: tuple

    def strength(self, confining):
        """σ₁ [Pa] at failure under σ₃ [Pa] (scalar or array)."""
        sine = math.sin(math.radians(self.friction_deg))
        return (np.asarray(confining) * (1 + sine) + 2 * self.cohesion * math.sqrt(1 - sine * sine)) / (1 - sine)


def envelope(minor, major):
    """Envelope of the circles of ``minor`` (σ₃) and ``major`` (σ₁) [Pa], arrays of the same length, two or more.

    Raises ValueError where all σ₃ are the same.
    """
    minor, major = np.asarray(minor, float), np.asarray(major, float)
    if len(minor) < 2 or np.ptp(minor) == 0:
        raise ValueError(f"an envelope needs two confining pressures or more, not {sorted(set(minor.tolist()))}")
    s, t = 0.5 * (major + minor), 0.5 * (major - minor)
    # linear in c cos φ and sin φ; in units of the smallest centre, as they differ by orders of magnitude
    unit = s.min()
    rows = np.column_stack((unit / t, s / t))
    (a, sine), _ = optimize.nnls(rows, np.ones(len(t)))
    sine = min(float(sine), 0.999)
    cosine = math.sqrt(1 - sine * sine)
    misses = 1 - (a * unit + s * sine) / t
    return MohrEnvelope(float(a) * unit / cosine, math.degrees(math.asin(sine)), tuple(misses.tolist()))
