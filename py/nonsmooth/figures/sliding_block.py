"""Strength, speed and temperature of a block that slides on a surface which weakens (``scripts/sliding_block.py``)."""

from ..records import RecordsError
from . import given, style
from .style import LINES

__all__ = ["sliding_block"]


@given.takes(
    cases=given.cases(
        "(label, columns), as (name, block.slide(…))", None, (lambda v: hasattr(v, "keys"), "give columns by name")
    )
)
@style.styled
def sliding_block(cases, path=None, closed_forms=(), pdf=False):
    """Blocks beside each other: strength by its first value against slip, speed against time, and against slip the mean
    temperature of the zone and its pore pressure by the stress on it, where a law has them.

    ``cases``: (label, columns) with the columns of :data:`nonsmooth.slip.block.COLUMNS`. ``closed_forms``: (label, slip
    [m], strength by its first value), dotted. Raises RecordsError where there is no block to draw.
    """
    if not cases:
        raise RecordsError("there is no block to draw; give at least one")
    for _, course in cases:
        style.need(course, "time_s", "slip_m", "speed_m_per_s", "normal_stress_Pa", "strength_Pa")
    warm = [(label, course) for label, course in cases if "temperature_degC" in course]
    wet = [(label, course) for label, course in cases if "pressure_Pa" in course]
    below = [name for name, there in (("temperature", warm), ("pressure", wet)) if there]
    fig = style.figure(10, 3.4 * (1 + bool(below)), layout="constrained")
    axes = fig.subplots(1 + bool(below), 2, squeeze=False)
    colours = dict(zip((label for label, _ in cases), style.line_colours(len(cases))))
    strength, speed = axes[0]
    for label, course in cases:
        first = course["strength_Pa"][0] or 1.0
        strength.plot(course["slip_m"], course["strength_Pa"] / first, color=colours[label], label=label)
        speed.plot(course["time_s"], course["speed_m_per_s"], color=colours[label])
    for label, slip, share in closed_forms:
        strength.plot(slip, share, color=LINES["grey"], ls=":", label=label)
    strength.set(xlabel="slip [m]", ylabel="strength by its first value", ylim=(0, None), xlim=(0, None))
    speed.set(xlabel="time [s]", ylabel="speed [m/s]", ylim=(0, None), xlim=(0, None))
    strength.legend()
    for ax, name in zip(axes[1] if below else (), below):
        for label, course in warm if name == "temperature" else wet:
            y = (
                course["temperature_degC"]
                if name == "temperature"
                else course["pressure_Pa"] / course["normal_stress_Pa"]
            )
            ax.plot(course["slip_m"], y, color=colours[label])
        ax.set(xlabel="slip [m]", xlim=(0, None))
        ax.set_ylabel("mean temperature of the zone [°C]" if name == "temperature" else "pore pressure by the stress")
    for ax in axes[1][len(below) :] if below else ():
        ax.remove()
    return style.save(fig, path, pdf)
