"""What became of a slope's run, in a word and a sentence, from its series and its state. Needs no YADE.

The words, which stay: see :data:`MEANINGS`. What a summary, the command, a sweep's rows and figures say of a run is
this.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ... import course, records
from ...course.triggers import shaking
from ...measure import centroid
from ...model import scales
from ...model.ground_motion.motion import COMPONENTS

__all__ = ["MEANINGS", "TITLES", "Verdict", "of"]

STOOD, SLID, DRY, MOVED, WATER, ERODED, SHAKEN, RESTLESS, UNFINISHED = (
    "stood",
    "slid",
    "failed dry",
    "moved dry",
    "failed by water",
    "failed by erosion",
    "failed by shaking",
    "not at rest",
    "not over",
)
#: The verdicts, and what each means.
MEANINGS = {
    STOOD: "the slope had not moved off when the run ended, and was at rest",
    SLID: "it slid so far that it did not stand, but never fast enough to move off, and was at rest when the run ended",
    DRY: "it collapsed or moved off by its own weight: before water acted on any disk, or without having come to rest before",
    MOVED: "it moved off so, and not, or not surely, by its weight: a script, or a wall that moves, had done work on it; or, with soft contacts, whose work nobody counts, it "
    "had been at rest under its weight",
    WATER: "it moved off once water acted on it",
    ERODED: "it moved off once disks had been taken out of it, whether water acted on it too or not",
    SHAKEN: "it moved off once the ground shook, while water acted on it or dry",
    RESTLESS: "it had neither moved off nor come to rest when the run ended",
    UNFINISHED: "the run was stopped before it was known",
}


#: A title for each, of figures.
TITLES = {
    STOOD: "the slope stood",
    SLID: "the slope slid and came to rest",
    DRY: "the slope failed dry",
    MOVED: "the slope moved dry",
    WATER: "the slope failed by water",
    ERODED: "the slope failed by erosion",
    SHAKEN: "the slope failed by shaking",
    RESTLESS: "the slope did not come to rest",
    UNFINISHED: "the run is not over",
}


@dataclass(frozen=True)
class Verdict:
    """``kind``: one of :data:`MEANINGS`; ``says``: a sentence; ``before``: when it moved [s], where that was before
    water acted on it.
    """

    kind: str
    says: str
    before: float | None = None


def of(series, section, state, times, disks=None) -> Verdict:
    """The Verdict of a run. ``series``: all of its rows; ``state``: the fields of course.State as a mapping; ``times``:
    its characteristic times; ``disks``: how many it has, where that is known."""
    last, over = float(series["time_s"][-1]), state["stage"] == "done"
    moved = state["failed_dry"] if state.get("failed_dry") is not None else state["moving"]
    if moved is None:
        return _unmoved(series, section, state, last, over, disks)
    rest = (
        ""
        if times["t5"] is not None
        else f"; it had not come to rest at {last:.1f} s, when the run {'ended' if over else 'was stopped'}"
    )
    start = shaking.since(state.get("t0"), state.get("failed_dry"))
    eroded = state.get("failed_dry") is None and _eroded(series, moved)
    # what moves after the record, in water or eroded, is not the record's
    shaken = (shaking.shakes if eroded or _wet(series, moved) else shaking.began)(section, start, moved)
    if not shaken and (state.get("failed_dry") is not None or not (eroded or _wet(series, moved))):
        return _dry(series, section, state, moved, rest)
    fast = float(np.max(series["speed_mean_m_per_s"][series["time_s"] >= moved - 1e-9]))
    table = _at(series, "water_m", moved)
    if not over and fast < scales.of(section).going_speed:
        at = f", with {eroded}" if eroded else f", with {_height(section, table)}" * (section.water is not None)
        return Verdict(
            UNFINISHED,
            f"the run was stopped at {last:.1f} s, while the slope moved and could still have come to rest again; it began to at {moved:.1f} s{at}",
        )
    if shaken:
        return _shaken(series, section, state, moved, start, rest)
    if eroded:
        return _by_erosion(series, state, moved, eroded, table, rest)
    failure = table if times["t1"] is None else _at(series, "water_m", times["t1"])
    also = _also(state, "the water")
    return Verdict(
        WATER,
        f"the slope failed by water, with {_height(section, failure, 'the table')}; it began to move at {moved:.1f} s{rest}{also}",
    )


def _shaken(series, section, state, moved, start, rest):
    """Of a slope that moved off while the ground shook."""
    since, motion = moved - start - section.shaking.begin, section.shaking.motion
    also = _also(state, "the shaking")
    return Verdict(
        SHAKEN,
        f"the slope failed by shaking{_load(series, section, None, moved)}; it began to move at {moved:.1f} s, {since:.1f} s after the record began, whose largest acceleration is "
        f"{max(map(motion.peak_acceleration, COMPONENTS)):.3g} m/s²{rest}{also}",
    )


def _by_erosion(series, state, moved, eroded, table, rest):
    wet = _wet(series, moved)
    water = f"; water acted on it too, with the table at {table:.4g} m" if wet else ""
    return Verdict(
        ERODED,
        f"the slope failed by erosion, with {eroded}; it began to move at {moved:.1f} s{rest}{water}"
        f"{_also(state, 'the erosion')}",
        None if wet else moved,
    )


def _eroded(series, time):
    """What had been taken out by a row's time [s], in words; "" where that is nothing."""
    if "eroded_disks" not in series or not _at(series, "eroded_disks", time):
        return ""
    disks, mass = _at(series, "eroded_disks", time), _at(series, "eroded_kg_per_m", time)
    return f"{disks:,.0f} disk{'s' * (disks > 1)} ({1e-3 * mass:.3g} t/m) taken out of it"


def _also(state, trigger):
    """That others had done something to it."""
    if not state.get("outside"):
        return ""
    return f"; {_from_outside(state)} before, so it may not have been {trigger} alone"


def _unmoved(series, section, state, last, over, disks):
    if not over:
        doing = {"settle": "settled", "dry": "rested dry"}.get(state["stage"])
        water = "" if doing else _load(series, section, disks)
        return Verdict(UNFINISHED, f"the run was stopped at {last:.1f} s, while the slope {doing or 'stood'}{water}")
    speed, water = float(series["speed_mean_m_per_s"][-1]), _load(series, section, disks)
    if speed >= scales.of(section).stopped_speed:
        return Verdict(
            RESTLESS,
            f"the slope did not come to rest, nor move off, until the run ended at {last:.1f} s (mean speed then {speed:.2g} m/s){water}",
        )
    slid = _slid(series, section, state)
    if slid is not None:
        way, when = slid
        return Verdict(
            SLID,
            f"the slope slid by {way:.3g} m, its centre of mass sideways since {'the water began to rise' if state['t0'] is not None else 'it settled'}, at {np.max(series['speed_mean_m_per_s']):.2g} m/s "
            f"at most, and was at rest when the run ended at {last:.1f} s; it had slid by {100 * course.COLLAPSED:g} % of its size at {when:.1f} s{_load(series, section, disks, when)}",
        )
    early = state.get("quiet_since") is not None and last < state["settled"] + section.stages.end.time - 1e-6 * last
    why = "; it was at rest and nothing was to come that could change it" if early else ""
    return Verdict(STOOD, f"the slope stood until the run ended at {last:.1f} s{water}{why}")


def _slid(series, section, state):
    """Way of the mass's centre [m] sideways from t0 on (from its beginning, where that did not come), where it is that
    of a mass that does not stand, and the time [s] at which it had become so; None where it is not."""
    since = series["time_s"] >= (state["t0"] if state["t0"] is not None else -math.inf) - 1e-9
    x = centroid.path(series)[0][since]
    ways = np.abs(x - x[:1])
    far = course.COLLAPSED * section.mass_size
    if not len(ways) or ways[-1] < far:
        return None
    return float(ways[-1]), float(series["time_s"][since][np.argmax(ways >= far)])


def _load(series, section, disks, time=None):
    """How far water and erosion have come, at most or by a ``time`` [s], as the end of a sentence."""
    eroded = _eroded(series, float(series["time_s"][-1]) if time is None else time)
    eroded = f" and {eroded}" if eroded else ""
    return f"{_of_water(series, section, disks, time)}{eroded}"


def _of_water(series, section, disks, time):
    if section.water is None:
        return ", without water"
    table, wet = (
        float(np.max(series[name])) if time is None else _at(series, name, time) for name in ("water_m", "wet_disks")
    )
    most = " at most" if time is None else ""
    if not wet and section.water_field is not None:
        return ", dry"
    if not wet:
        return f", with the water table at {table:.4g} m{most}, below all disks" if table else ", dry"
    share = f" ({100 * wet / disks:.0f} %)" if disks else ""
    return f", with {_height(section, table)}{most} and {wet:,.0f} disks wet{share}"


def _height(section, height, table="the water table"):
    """How high the water stands [m], in words."""
    if section.water_field is not None:
        return f"a mean pressure head of {height:.4g} m on the slip surface"
    return f"{table} at {height:.4g} m"


def _dry(series, section, state, moved, rest):
    """Of a slope that moved off before water acted on it, or had never come to rest."""
    outside, rested = state.get("outside", 0.0), state.get("rested")
    travel = f"{rest}. {_motion(series, section, state)}"
    if outside:
        return Verdict(
            MOVED,
            f"the slope moved dry, at {moved:.1f} s, and not by its weight alone: {_from_outside(state)} until then{travel}",
            moved,
        )
    if outside is None and rested is not None:
        return Verdict(
            MOVED,
            f"the slope moved dry, at {moved:.1f} s; it had been at rest under its weight at {rested:.1f} s, so that something else may have moved it{travel}",
            moved,
        )
    return Verdict(
        DRY,
        f"the slope failed dry, at {moved:.1f} s: it does not bear its own weight, and nothing here is a failure by water{travel}",
        moved,
    )


def _from_outside(state):
    return f"a script, or walls that move, had brought or taken {state['outside']:.3g} J/m"


def _motion(series, section, state):
    """How fast and how far it went, and what broke, from the beginning to the end of the run."""
    front = section.side * float(series["front_m"][-1] - series["front_m"][0])
    broken = records.broken_bonds(series)
    speed = float(np.max(series["speed_mean_m_per_s"]))
    return f"Its mean speed came to {speed:.2g} m/s, its front went {front:.3g} m, and {broken:,} of {state['bonds_initial']:,} bonds broke"


def _wet(series, time):
    """Whether water had acted on a disk by a time [s]."""
    return bool(np.any(series["wet_disks"][series["time_s"] <= time + 1e-9] > 0))


def _at(series, name, time):
    """A column's value in the row of a time [s]."""
    return float(series[name][np.argmin(np.abs(series["time_s"] - time))])
