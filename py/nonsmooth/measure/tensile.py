"""Tensile strength from the curve of a direct tension test: peak, its strain, and the work until the break."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .strength import running_mean

__all__ = ["PEAK_WINDOW", "TensileCurve", "curve", "tension"]

PEAK_WINDOW = 0.1  # half-axes of a mean bond's ellipse over which the stress is averaged before its maximum is taken


@dataclass(frozen=True)
class TensileCurve:
    """What one test says. ``peak`` [Pa] at ``strain`` and at the ``opening`` of the platens [m]; ``end_rel``: the
    stress of the last row over the peak; ``imbalance``: largest difference of the platens in a row, over the peak;
    ``work`` [J/m²] of the platens on the width of the sample.
    """

    peak: float
    strain: float
    opening: float
    end_rel: float
    imbalance: float
    work: float


def tension(series):
    """σ [Pa] of a test's rows, an array, tension positive: mean of both platens."""
    return 0.5 * (np.asarray(series["tension_top_Pa"], float) + np.asarray(series["tension_bottom_Pa"], float))


def curve(series, yielding, width):
    """Figures of a test's series (columns as in `tension_test.COLUMNS`).

    ``yielding``: half-axis of a mean bond's ellipse [m]; ``width`` of the sample [m]. Raises ValueError where the test
    ends before the first window.
    """
    opening, stress = np.asarray(series["opening_m"], float), tension(series)
    begin, mean = running_mean(opening, stress, PEAK_WINDOW * yielding)
    if not len(begin):
        raise ValueError(
            f"the test ended at an opening of {opening[-1]:g} m, before {PEAK_WINDOW * yielding:g} m, over which a "
            "peak is a mean"
        )
    k = int(np.argmax(mean))
    middle = begin[k] + 0.5 * PEAK_WINDOW * yielding
    top, bottom = (np.asarray(series[f"tension_{name}_Pa"], float) for name in ("top", "bottom"))
    return TensileCurve(
        peak=float(mean[k]),
        strain=float(middle * series["strain"][-1] / opening[-1]),
        opening=float(middle),
        end_rel=float(stress[-1] / mean[k]),
        imbalance=float(np.max(np.abs(top - bottom)) / mean[k]),
        work=float(series["work_J"][-1] / width),
    )
