"""What the forces on the walls do from stage to stage of an avalanche: the statements of the paper's section 6, each as
one number. Needs no YADE.

With N, T the total normal and the shear force on the slip surfaces (DP), N' = N − U what contacts bear of N, U the
water's force, F the normal force on the backstop (FB), μ the friction of the slip surface, means over a second at each
time. As t1 is where F comes within 2 % of its largest value, ``backstop_span`` is small almost by definition;
``backstop_fall`` is not, since a foot that loses its strength once it is overcome falls far before the slope
accelerates:

=============================  ============================================================  ============================
name                           number                                                        paper
=============================  ============================================================  ============================
``normal_change``              N(t1) / N(t0) − 1                                             0 ([115], "constant")
``normal_change_by_backstop``  Δ of the shear force on the backstop / ΔN from t0 to t1       not named there
``shear_drop``                 −ΔT / (μ ΔU) from t0 to t1                                    1 (eq. 19)
``shear_share``                mean of T by μ times that of N', from t0 to t1                1 (eq. 20)
``backstop_rise``              ΔF / −ΔT from t0 to t1                                        1 (eq. 21)
``backstop_span``              (largest − least mean of F) / F(t1) from t1 to t2             0 ([116], "fairly constant")
``backstop_swing``             largest F in a step by the mean of its row, less 1, t1 to t2  0 (the same)
``backstop_fall``              1 − (least F after the largest one) / (largest), t0 to t2     0 (the same)
``release_rise``               N'(t3) / N'(t2)                                               above 1 ([117])
``normal_fall``                N(t5) / N(t3)                                                 below 1 ([118], 1)
``backstop_momentum``          correlation of F with N v, v the mean speed, from t3 to t5    above 0 ([118], 2)
``shear_moving``               mean of T from t3 to t5, by T(t0)                             small, above 0 ([118], 3)
``backstop_final``             F at the end / F(t1)                                          above 1 ([119])
``shear_final``                T at the end / T(t0)                                          small, below 0 ([119])
=============================  ============================================================  ============================

Forces normal to the slip surface are in balance. The rising push on the backstop brings friction along it, which holds
the toe down on the slip surface: N grows by this force (where the backstop stands across the surface), and T by μ times
it. Equation (19) leaves it out; T = μ N' holds all the same.
"""

from __future__ import annotations

import math

import numpy as np

__all__ = ["NAMES", "statements", "water_halved"]

NAMES = (
    "normal_change",
    "normal_change_by_backstop",
    "shear_drop",
    "shear_share",
    "backstop_rise",
    "backstop_span",
    "backstop_swing",
    "backstop_fall",
    "release_rise",
    "normal_fall",
    "backstop_momentum",
    "shear_moving",
    "backstop_final",
    "shear_final",
)


def statements(series, times, friction, mean, backstop=True) -> dict[str, float | None]:
    """The numbers of :data:`NAMES`, None for what the run has not reached or the slope has not.

    ``series``: the rows of a run's series, name -> array; ``times``: t0 … t5 [s], None for those that did not come;
    ``friction``: μ of the slip surface before it weakens, None where there are several; ``mean(name, end)``: mean of a
    column over the second up to a time [s]; ``backstop``: whether there is one.
    """
    found = dict.fromkeys(NAMES)
    t0, t1, t2, t3, _, t5 = (times[f"t{k}"] for k in range(6))
    if None in (t0, t1):
        return found
    t = series["time_s"]

    def at(name, when):
        return mean(f"{name}_N_per_m", when)

    def change(name):
        return at(name, t1) - at(name, t0)

    normal, effective, shear, push = "dp_normal_total", "dp_normal_effective", "dp_shear", "fb_normal"
    found["normal_change"] = _ratio(change(normal), at(normal, t0))
    rising = (t > t0) & (t <= t1)
    if friction and rising.any():  # it may fail at once
        found["shear_drop"] = _ratio(-change(shear), friction * change("dp_water"))
        found["shear_share"] = _ratio(
            float(np.mean(series[f"{shear}_N_per_m"][rising])),
            friction * float(np.mean(series[f"{effective}_N_per_m"][rising])),
        )
    if backstop:
        found["normal_change_by_backstop"] = _ratio(change("fb_shear"), change(normal))
        found["backstop_rise"] = _ratio(change(push), -change(shear))
        if t2 is not None and (level := (t >= t1) & (t <= t2)).any():
            means = [at(push, when) for when in t[level]]
            found["backstop_span"] = _ratio(max(means) - min(means), at(push, t1))
            force, peak = series[f"{push}_N_per_m"][level], series[f"{push}_peak_N_per_m"][level]
            found["backstop_swing"] = float(np.max(peak / force)) - 1 if force.all() else None
            pushes = [at(push, when) for when in t[(t >= t0) & (t <= t2)]]
            largest = int(np.argmax(pushes))
            found["backstop_fall"] = _ratio(pushes[largest] - min(pushes[largest:]), pushes[largest])
    if None not in (t2, t3):
        found["release_rise"] = _ratio(at(effective, t3), at(effective, t2))
    if None not in (t3, t5):
        moving = (t >= t3) & (t <= t5)
        found["normal_fall"] = _ratio(at(normal, t5), at(normal, t3))
        found["shear_moving"] = _ratio(float(np.mean(series[f"{shear}_N_per_m"][moving])), at(shear, t0))
        found["shear_final"] = _ratio(at(shear, t[-1]), at(shear, t0))
        if backstop:
            momentum = series[f"{normal}_N_per_m"][moving] * series["speed_mean_m_per_s"][moving]
            found["backstop_momentum"] = _correlation(series[f"{push}_N_per_m"][moving], momentum)
            found["backstop_final"] = _ratio(at(push, t[-1]), at(push, t1))
    return found


def water_halved(series, times) -> float | None:
    """Time [s] after t2 in which the force of the pore water on what the slip surfaces bear falls to half of what it
    was at t2; None where it does not, or where there was none. ``series``, ``times``: as for :func:`statements`.
    """
    if times["t2"] is None:
        return None
    moving = series["time_s"] >= times["t2"]
    t, force = series["time_s"][moving], series["dp_water_N_per_m"][moving]
    low = np.flatnonzero(force <= 0.5 * force[0])
    return float(t[low[0]] - t[0]) if force[0] > 0 and len(low) else None


def _ratio(a, b):
    return a / b if b else None


def _correlation(a, b):
    """Pearson's, None where one does not change."""
    spread = math.sqrt(float(np.var(a) * np.var(b)))
    return float(np.mean((a - a.mean()) * (b - b.mean()))) / spread if spread > 0 else None
