"""How a slip surface loses its strength as it heats, from a slope's series and the cells along its walls. Needs no YADE.

Slip, and what is left of friction, are means over the cells of slip surfaces by the load that they bear (columns
``cells_slip_m`` and ``cells_friction_rel`` of the series), since the slope settled. Time counts from where the disks' mean speed passes
:data:`BEGIN`, as creep before it has no beginning.
"""

from __future__ import annotations

import math

import numpy as np

from ..records import RecordsError, since_settled, surface_arrays
from ..system import checks

__all__ = ["BEGIN", "SHARES", "begin", "heats", "lost", "numbers", "of_cells", "rows", "temperatures"]

BEGIN = 0.1  # m/s
#: Shares of the friction before slip that :func:`numbers` tells of.
SHARES = (0.5, 0.1, 0.05)
COLUMNS = ("time_s", "cells_slip_m", "cells_friction_rel", "speed_mean_m_per_s")


def _passed(values, level):
    """Where a column first comes to a level: (number of the row after it, the part of the way from the row before to
    that row); None where it does not.
    """
    there = np.flatnonzero(values >= level)
    if not len(there):
        return None
    k = int(there[0])
    return (k, 1.0) if k == 0 else (k, float((level - values[k - 1]) / (values[k] - values[k - 1])))


def _at(values, place):
    k, part = place
    return float(values[k] if k == 0 else values[k - 1] + part * (values[k] - values[k - 1]))


def heats(series) -> bool:
    """Whether a series is that of a slope whose slip surface has a slip law."""
    return "cells_friction_rel" in series


def rows(series) -> dict:
    """The rows of a series since the slope settled, which set slip back to 0: {name: array}. Raises RecordsError for a
    series of a slope whose slip surfaces have no slip law.
    """
    missing = [name for name in COLUMNS if name not in series]
    if missing:
        raise RecordsError(
            f"the series has no column {missing[0]}; give that of a slope whose slip surface has a slip_law"
        )
    return since_settled(series)


def begin(series) -> float | None:
    """When the mean speed passes :data:`BEGIN` for the last time before it is largest [s], between two rows; None where
    it does not, and for a slope that moved so fast as soon as it had settled. Takes the series of any slope.
    """
    series = since_settled(series)
    speed = series["speed_mean_m_per_s"][: int(np.argmax(series["speed_mean_m_per_s"])) + 1]
    first = int(np.flatnonzero(speed < BEGIN).max(initial=0))
    place = _passed(speed[first:], BEGIN)
    return None if place is None or place[0] == 0 else _at(series["time_s"][first:], place)


def lost(series, share) -> dict | None:
    """Where a ``share`` of the friction before slip is left first: ``time_s``, ``after_s``, since :func:`begin`,
    ``slip_m``, the mean slip, and ``speed_m_per_s``, the mean speed of the disks; None where more is left.
    """
    series = rows(series)
    start, place = begin(series), _passed(-series["cells_friction_rel"], -share)
    if start is None or place is None:
        return None
    time = _at(series["time_s"], place)
    return {
        "time_s": time,
        "after_s": time - start,
        "slip_m": _at(series["cells_slip_m"], place),
        "speed_m_per_s": _at(series["speed_mean_m_per_s"], place),
    }


def _check(walls, cells):
    """Raises RecordsError for what are no cells, and where one of the ``walls`` is not in them."""
    if "wall" not in cells:
        raise RecordsError("cells: they have no column wall; give those of slip_surface.csv, as run.slip_surface")
    there = list(dict.fromkeys(np.asarray(cells["wall"]).tolist()))
    wrong = [walls] if isinstance(walls, str) else [name for name in walls if name not in there]
    if wrong:
        raise RecordsError(
            f"walls: {checks.shown(wrong[0])}: give a list of walls that have cells: {', '.join(there) or 'there are none'}"
        )


def temperatures(cells, walls, time) -> tuple[float, float]:
    """Mean temperature of the zone by length, as its heat is, and the highest across it [°C], in the row of ``cells``
    (columns of ``slip_surface.csv``) that is nearest to a ``time`` [s], of these ``walls``; NaN for laws without a zone
    that heats. Raises RecordsError for a wall that is not in the cells.
    """
    _check(walls, cells)
    now = cells["time_s"] == cells["time_s"][np.argmin(np.abs(cells["time_s"] - time))]
    now &= np.isin(cells["wall"], list(walls))
    heat = cells["temperature_degC"][now]
    if not len(heat) or np.isnan(heat).all():
        return math.nan, math.nan
    return float(np.average(heat, weights=cells["length_m"][now])), float(np.nanmax(cells["hottest_degC"][now]))


def of_cells(cells, walls, share) -> dict | None:
    """Of the cells of these ``walls`` whose friction comes to a ``share`` of that before slip: their ``share`` of all,
    and the medians of their ``slip_m`` and ``temperature_degC`` then, of two rows the later one; None where none does.
    The temperature is NaN for laws without a zone that heats. A mean over all cells may never come there: some lie below
    what does not slide.
    """
    _check(walls, cells)
    arrays, slips, heats, count = surface_arrays(cells), [], [], 0
    for name in walls:
        one = arrays[name]
        weak = one["friction"] < share * one["friction"][0]
        cell = np.flatnonzero(weak.any(axis=0))
        row, count = weak.argmax(axis=0)[cell], count + weak.shape[1]
        slips.append(one["slip_m"][row, cell])
        heats.append(one["temperature_degC"][row, cell] if "temperature_degC" in one else np.full(len(cell), np.nan))
    slip, heat = np.concatenate(slips), np.concatenate(heats)
    if not len(slip):
        return None
    return {"share": len(slip) / count, "slip_m": float(np.median(slip)), "temperature_degC": float(np.median(heat))}


def numbers(series, cells, walls) -> dict[str, float | None]:
    """What a run tells of its slip surface: for each of :data:`SHARES`, in per cent, ``after_s_10``, ``slip_m_10``,
    ``speed_m_per_s_10``, ``temperature_degC_10`` and ``hottest_degC_10``, None where more is left, and what
    :func:`of_cells` tells, ``cells_share_10``, ``cells_slip_m_10`` and ``cells_temperature_degC_10``; and
    ``friction_rel``, the least that was left. Arguments and errors as of the functions above.
    """
    _check(walls, cells)
    found: dict[str, float | None] = {"friction_rel": float(np.min(rows(series)["cells_friction_rel"]))}
    for share in SHARES:
        one, percent = lost(series, share), f"{100 * share:g}"
        mean, high = (None, None) if one is None else temperatures(cells, walls, one["time_s"])
        values = {name: one and one[name] for name in ("after_s", "slip_m", "speed_m_per_s")}
        values |= {"temperature_degC": mean, "hottest_degC": high}
        own = of_cells(cells, walls, share) or dict.fromkeys(("share", "slip_m", "temperature_degC"))
        values |= {f"cells_{name}": value for name, value in own.items()}
        found |= {
            f"{name}_{percent}": None if value is None or math.isnan(value) else value for name, value in values.items()
        }
    return found
