"""Slopes whose slip surfaces lose their strength as they heat, beside each other."""

from __future__ import annotations

import numpy as np

from ..measure import heated_surface
from ..records import RecordsError, since_settled
from . import given, style

__all__ = ["heated_slopes"]

LEAST = 0.01  # m, of the slip that is shown


@given.takes(
    cases=given.cases(
        "(label, series), as (name, run.series)", None, (lambda v: hasattr(v, "keys"), "give columns by name")
    )
)
@style.styled
def heated_slopes(cases, path=None, pdf=False):
    """Friction that is left of that before slip against mean slip, on a scale of decades, and mean speed against time
    since that passed :data:`nonsmooth.measure.heated_surface.BEGIN`. Friction is shown until the slip is largest: what
    slides on comes to cells that have slipped less.

    ``cases``: (label, series of a slope); those of one label have one colour and one entry in the legend. A slope whose
    slip surface has no slip law is beside the others: dashed, and with its speed alone. Raises RecordsError where none
    has moved so fast, and where none has a slip law.
    """
    if not any(heated_surface.heats(series) for _, series in cases):
        raise RecordsError("no series has the column cells_friction_rel; give at least one of a slope with a slip_law")
    cases = [
        (label, (heated_surface.rows if heated_surface.heats(one) else since_settled)(one)) for label, one in cases
    ]
    begins = [heated_surface.begin(series) for _, series in cases]
    if not any(time is not None for time in begins):
        raise RecordsError(f"no slope has moved at {heated_surface.BEGIN:g} m/s; give at least one that did")
    labels = list(dict.fromkeys(label for label, _ in cases))
    colours = dict(zip(labels, style.line_colours(len(labels))))
    fig = style.figure(10, 3.8, layout="constrained")
    left, right = fig.subplots(1, 2)
    told, last = set(), 0.0
    for (label, series), time in zip(cases, begins):
        if time is None:
            continue
        heats, words = heated_surface.heats(series), None if label in told else label
        told.add(label)
        look = dict(color=colours[label], lw=1.1, ls="-" if heats else "--", label=words)
        if heats:
            # until the mass leaves the cells that have slipped most
            farthest = int(np.argmax(series["cells_slip_m"]))
            chosen = np.flatnonzero(series["cells_slip_m"][: farthest + 1] > 0)
            left.plot(series["cells_slip_m"][chosen], series["cells_friction_rel"][chosen], **look)
        late = series["time_s"] >= time
        right.plot(series["time_s"][late] - time, series["speed_mean_m_per_s"][late], **look)
        last = max(last, float(series["time_s"][-1] - time))
    left.set(xscale="log", ylim=(0, 1.05), xlabel="mean slip [m]", ylabel="friction by that before slip")
    left.set_xlim(LEAST, None)
    right.set(xlim=(0, last), ylim=(0, None), ylabel="mean speed [m/s]")
    right.set_xlabel(f"time since it moved at {heated_surface.BEGIN:g} m/s [s]")
    right.legend()
    return style.save(fig, path, pdf)
