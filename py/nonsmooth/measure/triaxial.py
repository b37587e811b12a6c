"""What triaxial tests of spheres say: packing fraction and coordination in the middle of a sample, its stress by the
forces of the contacts, and its strength. Arrays in, numbers out.

With σ₁ the axial and σ₃ the lateral stress, both positive in compression, the mobilised angle of friction is

    sin φ = (σ₁ − σ₃)/(σ₁ + σ₃) .
"""

from __future__ import annotations

import math

import numpy as np

from .statistics import standard_error
from .strength import apparent_deg, running_mean

__all__ = [
    "CARRIES",
    "PEAK_WINDOW",
    "PLATEAU",
    "SHORTEST",
    "axial",
    "backbone",
    "coordination",
    "friction_at",
    "lateral",
    "solid_fraction",
    "strengths",
    "stress",
]

CARRIES = 1e-3  # of the mean normal force: contacts that bear less are the solver's residual
PEAK_WINDOW = 0.01  # strain over which stresses are averaged before the largest ratio is taken
PLATEAU = 2 / 3  # share of a test's strain from which on the critical state is the mean
SHORTEST = PEAK_WINDOW / (1 - PLATEAU)  # strain of a test that has both a peak and a plateau to measure
BLOCKS = 5  # of the plateau, for the error of its mean


def axial(series):
    """σ₁ [Pa] of a test's rows, an array: mean of bottom and top."""
    return _mean(series, "bottom", "top")


def lateral(series):
    """σ₃ [Pa] of a test's rows, an array: mean of the four sides."""
    return _mean(series, "left", "right", "front", "back")


def _mean(series, *plates):
    return np.mean([np.asarray(series[f"sigma_{name}_Pa"], float) for name in plates], axis=0)


def strengths(series) -> dict:
    """Peak and critical state of a test's series (columns of :data:`.studies.spheres.columns.TRIAXIAL`).

    ``peak_deg`` [°], ``sigma1_peak_Pa``, ``sigma3_peak_Pa`` and ``strain_peak``: where σ₁/σ₃, both as means over
    :data:`PEAK_WINDOW` of strain, is the largest; ``critical_deg`` and the same of means from :data:`PLATEAU` of the
    strain on; ``critical_error_deg``: standard error of that mean by blocks; ``volumetric_strain_end``;
    ``plates_difference_rel``: between bottom and top, and ``contacts_difference_rel``: between the deviator σ₁ − σ₃ of
    the plates and that of the contacts, both as means on the plateau. None for what the series is too short for.
    """
    strain, one, three = np.asarray(series["strain"], float), axial(series), lateral(series)
    begin, major = running_mean(strain, one, PEAK_WINDOW)
    _, minor = running_mean(strain, three, PEAK_WINDOW)
    late = strain > PLATEAU * strain[-1]
    found = dict.fromkeys(
        "peak_deg sigma1_peak_Pa sigma3_peak_Pa strain_peak critical_deg critical_error_deg sigma1_critical_Pa "
        "sigma3_critical_Pa plates_difference_rel contacts_difference_rel".split()
    )
    found["volumetric_strain_end"] = float(series["volumetric_strain"][-1])
    if not len(begin) or np.count_nonzero(late) < BLOCKS:
        return found
    k = int(np.argmax(major / minor))
    mean = {name: float(np.mean(np.asarray(series[name], float)[late])) for name in series}
    blocks = [apparent_deg(*pair) for pair in zip(_blocks(three[late]), _blocks(one[late]))]
    found |= {
        "peak_deg": apparent_deg(float(minor[k]), float(major[k])),
        "sigma1_peak_Pa": float(major[k]),
        "sigma3_peak_Pa": float(minor[k]),
        "strain_peak": float(begin[k] + PEAK_WINDOW / 2),
        "critical_deg": apparent_deg(float(three[late].mean()), float(one[late].mean())),
        "critical_error_deg": standard_error(blocks),
        "sigma1_critical_Pa": float(one[late].mean()),
        "sigma3_critical_Pa": float(three[late].mean()),
        "plates_difference_rel": mean["sigma_top_Pa"] / mean["sigma_bottom_Pa"] - 1,
        "contacts_difference_rel": (mean["contacts_sigma1_Pa"] - mean["contacts_sigma3_Pa"])
        / float((one[late] - three[late]).mean())
        - 1,
    }
    return found


def friction_at(friction, angle, wanted):
    """The least friction of the contacts with which a sample has the ``wanted`` angle [°], by straight lines between
    tests with ``friction`` and ``angle`` [°], sequences of one length; None where no two of them have it between them.
    """
    order = np.argsort(friction)
    x, y = np.asarray(friction, float)[order], np.asarray(angle, float)[order]
    for k in range(len(x) - 1):
        if min(y[k], y[k + 1]) <= wanted <= max(y[k], y[k + 1]):
            part = 0.0 if y[k] == y[k + 1] else (wanted - y[k]) / (y[k + 1] - y[k])
            return float(x[k] + part * (x[k + 1] - x[k]))
    return None


def _blocks(values):
    return [float(block.mean()) for block in np.array_split(values, BLOCKS)]


def stress(force, branch, volume):
    """Stress tensor (3, 3) [Pa], positive in compression, of contacts in a ``volume`` [m³] by Love's and Weber's
    formula (Weber 1966), σ = Σ f ⊗ l / V.

    ``force`` (n, 3) [N]: on the second body of each contact by the first; ``branch`` (n, 3) [m]: from the first one's
    centre to the second's; where a body is a plate, the point of the contact stands for its centre. In equilibrium that
    is the mean stress of all that the plates press.
    """
    return np.asarray(force, float).T @ np.asarray(branch, float) / volume


def solid_fraction(at, r, low, high):
    """Share of a box that spheres fill: ``at`` (n, 3), ``r`` (n,), ``low`` and ``high`` (3,) its corners [m].

    Of a sphere that a face cuts the part within counts. Near an edge of the box the parts are multiplied, which is not
    exact for one sphere, but for the mean over all places that it may have.
    """
    at, r = np.asarray(at, float), np.asarray(r, float)
    part = np.ones(len(r))
    for axis in range(3):
        part *= _below(high[axis] - at[:, axis], r) - _below(low[axis] - at[:, axis], r)
    return float(np.sum(part * 4 / 3 * math.pi * r**3) / np.prod(np.subtract(high, low)))


def _below(height, r):
    """Share of a sphere's volume up to a ``height`` above its centre, arrays (n,)."""
    x = np.clip(0.5 * (1 + height / r), 0, 1)
    return x * x * (3 - 2 * x)


def backbone(first, second, normal, count, least):
    """Spheres that bear: those left when spheres with fewer than ``least`` contacts are taken out, again and again.

    ``first``, ``second``, int (m,): the bodies of each contact, spheres 0 to ``count`` − 1, plates below 0; ``normal``
    (m,) [N]; contacts with less than :data:`CARRIES` of its mean do not count. Returns bool (count,), and how many
    contacts each sphere has among what is left and the plates, int (count,), 0 for those that are out.
    """
    first, second, normal = (np.asarray(one) for one in (first, second, normal))
    bears = normal > CARRIES * (normal[normal > 0].mean() if np.any(normal > 0) else 0.0)
    first, second = first[bears], second[bears]
    there = np.ones(count, bool)
    while True:
        stands = ((first < 0) | there[first]) & ((second < 0) | there[second])
        ends = np.concatenate((first[stands], second[stands]))
        number = np.bincount(ends[ends >= 0], minlength=count)
        out = there & (number < least)
        if not out.any():
            return there, np.where(there, number, 0)
        there &= ~out


def coordination(there, number, inside):
    """Mean number of contacts of the spheres ``inside``, bool (n,), that bear, and the share of those inside that do
    not; ``there``, ``number``: of :func:`backbone`. 0 and 1 where none bears.
    """
    chosen = there & inside
    if not chosen.any():
        return 0.0, 1.0
    return float(number[chosen].mean()), 1 - float(np.count_nonzero(chosen) / np.count_nonzero(inside))
