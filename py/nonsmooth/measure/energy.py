"""What the balance of energy leaves over, against all that a run has turned over. Needs no YADE."""

from __future__ import annotations

import numpy as np

from ..records import LOSSES

__all__ = ["balance_error", "dissipated", "turned_over"]


def dissipated(series):
    """All that was dissipated by the last row of the ``series``, a dict of columns [J/m]."""
    return float(sum(series[name][-1] for name in LOSSES))


def turned_over(series):
    """The larger of all that was dissipated and the largest kinetic energy [J/m]; ``series``: dict of columns from the
    row on in which the balance begins.
    """
    return max(dissipated(series), float(np.max(series["energy_kinetic_J"])))


def balance_error(series):
    """The error of the balance in each row as a share of what the whole run turns over, shape (rows,); 0 in a run that
    turns over nothing.

    The column ``energy_error_rel`` refers to what was turned over until its row (losses, kinetic energy, work of the
    water), of which a slope at rest has next to none.
    """
    until = sum(series[name] for name in LOSSES) + series["energy_kinetic_J"] + np.abs(series["energy_water_J"])
    turned = turned_over(series)
    return series["energy_error_rel"] * until / turned if turned > 0 else np.zeros(len(until))
