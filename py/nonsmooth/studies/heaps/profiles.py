"""Profiles of speed behind the tip of a column that collapses, over seeds: what the paper's Figure 7 sketches (Taboada
and Estrada 2009, section 4.2.4). Needs no YADE.

Speeds are differences of the places that a run keeps for its video, a tenth of T = √(H₀/g) apart, so each is a mean
over that time. They are taken while the front is at :data:`AT` of its run-out, in :data:`LOOKS` such spans one after
the other, each with places measured from its own tip. So one description holds for all aspect ratios, and for rigid and
soft disks alike.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np

from ...measure import heap as measures, velocity_profiles
from ...measure.statistics import over_seeds
from . import study
from .grains import HeapError

__all__ = ["AT", "BEHIND", "SpeedSpan", "looks", "of_run", "over_runs"]

AT = (0.25, 0.5, 0.8)  # of the run-out: where the front is at the three times
BEHIND = (0.1, 0.4, 0.75)  # of the way from the tip to the wall: where profiles are taken
HALF = 0.06  # half of their width, of the same way
LOOKS = 3  # spans at one time
LEAST = 0.05  # √(g d), d the mean diameter: what is slower everywhere in a profile is at rest


@dataclass(frozen=True)
class SpeedSpan:
    """Disks in the middle of a span: ``time`` [s]; ``x`` from the wall, ``y`` [m]; ``u``, ``v`` [m/s], (n,); ``tip``
    [m]: front of the connected mass.
    """

    time: float
    x: np.ndarray
    y: np.ndarray
    u: np.ndarray
    v: np.ndarray
    tip: float


def looks(film, place, runout, width, at):
    """:class:`SpeedSpan` in the :data:`LOOKS` spans around the time at which the front has come ``at`` of its way; an
    empty list for a run of an earlier version, which kept no places.

    ``film``: times [s], places and radii as of study.film; ``place``: x of the wall [m]; ``runout``: of the run, in
    units of its ``width`` [m].
    """
    times, places, r = film
    if len(times) < 2:
        return []
    fronts = np.array([measures.fronts(x, r, measures.connected(x, y, r))[1] for x, y in places]) - place
    middle = 0.5 * (fronts[1:] + fronts[:-1])
    reached = int(np.argmax(middle >= width * (1 + at * runout)))  # the first; 0 where rounding leaves none
    begin = min(max(0, reached - LOOKS // 2), max(0, len(middle) - LOOKS))
    found = []
    for k in range(begin, min(begin + LOOKS, len(middle))):
        x, y, u, v = velocity_profiles.midway((times[k], *places[k]), (times[k + 1], *places[k + 1]))
        found.append(SpeedSpan(0.5 * (times[k] + times[k + 1]), x - place, y, u, v, float(middle[k])))
    return found


def of_run(seen, r, gravity):
    """Profiles at the places :data:`BEHIND` of one run's ``seen``, a list of :class:`SpeedSpan`: a
    velocity_profiles.Profile each, None where no disks are.

    ``r`` [m]; ``gravity`` [m/s²]. Layers are a mean diameter thick.
    """
    # all looks as one, each by its own tip: places are shares of the way from the tip to the wall
    behind, y, u = (np.concatenate([one(look) for look in seen]) for one in (_behind, lambda s: s.y, lambda s: s.u))
    length = float(np.mean([look.tip for look in seen]))
    radii = np.tile(r, len(seen))
    layer = 2 * float(np.mean(r))
    # a look's disks fill its window once: the thickness of a layer times the looks is what they may fill
    return [
        velocity_profiles.measure(
            behind * length, y, radii / math.sqrt(len(seen)), u, (share - HALF) * length, (share + HALF) * length, layer, slowest(gravity, layer)
        )
        for share in BEHIND
    ]  # fmt: skip


def slowest(gravity, diameter):
    """The speed [m/s] that something in a profile is above where it moves; ``gravity`` [m/s²], mean ``diameter``
    [m].
    """
    return LEAST * math.sqrt(gravity * diameter)


def _behind(look):
    return 1 - look.x / look.tip


def over_runs(runs):
    """What columns of one aspect ratio have in common, a list of dictionaries that JSON can hold, one for each of
    :data:`AT`.

    ``runs``: list of (heap, summary, folder), one a seed. Each has ``at``; ``time_rel``: in units of T; ``length_rel``:
    from the wall to the tip, in units of L₀; and ``places``, one for each of :data:`BEHIND`: ``behind``; ``z_d``, in
    mean diameters, and ``speed_rel``, in units of √(g H₀), of the layers that all runs have; ``height_d`` and
    ``border_rel``, of the height;
    ``fullness``; ``regimes``: {name: number of runs}. Numbers are those of statistics.over_seeds. Raises HeapError
    where a run kept no places.
    """
    found = []
    for at in AT:
        seen = [
            looks(study.film(folder), heap.place(), told["runout_rel"], told["width_m"], at)
            for heap, told, folder in runs
        ]
        if not all(seen):
            raise HeapError(
                "profiles: a run has kept no places on its way, as runs of earlier versions; run it again without --resume"
            )
        each = [of_run(s, study.film(folder)[2], heap.gravity) for s, (heap, told, folder) in zip(seen, runs)]

        def mean(s, value):
            return float(np.mean([value(one) for one in s]))

        found.append(
            {
                "at": at,
                "time_rel": over_seeds(
                    [mean(s, lambda one: one.time) / told["fall_time_s"] for s, (_, told, _) in zip(seen, runs)]
                ),
                "length_rel": over_seeds(
                    [mean(s, lambda one: one.tip) / told["width_m"] for s, (_, told, _) in zip(seen, runs)]
                ),
                "places": [_over(share, [one[k] for one in each], runs) for k, share in enumerate(BEHIND)],
            }
        )
    return found


def _over(share, profiles, runs):
    """Numbers of one place over runs, see :func:`over_runs`."""
    if None in profiles:
        return {"behind": share, "regimes": {}}
    layers = min(len(p.z) for p in profiles)
    sizes = [heap.mean_diameter() for heap, _, _ in runs]
    units = [math.sqrt(heap.gravity * told["height_m"]) for heap, told, _ in runs]

    def plain(value):
        return value if math.isfinite(value) else None

    return {
        "behind": share,
        "z_d": [k + 0.5 for k in range(layers)],
        "speed_rel": [
            over_seeds([float(p.speed[k] / unit) for p, unit in zip(profiles, units)]) for k in range(layers)
        ],
        "height_d": over_seeds([p.height / size for p, size in zip(profiles, sizes)]),
        "border_rel": over_seeds([p.border / p.height for p in profiles]),
        "fullness": over_seeds([plain(p.fullness) for p in profiles]),
        "regimes": dict(Counter(p.regime for p in profiles)),
    }
