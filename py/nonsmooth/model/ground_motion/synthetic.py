"""Motions of the ground that are made up: pulses and sines, for which blocks have closed forms, and noise that looks
like an earthquake. Each says in its name and source that it is synthetic. Needs no YADE.
"""

from __future__ import annotations

import math

import numpy as np

from ...system import checks
from .motion import GroundMotion, GroundMotionError

__all__ = ["half_sine", "rectangular", "sine", "stochastic"]

POINTS = 1000  # a half sine is so many straight pieces: its integral is less by 8e-7
MOST_POINTS = 1_000_000
DAMPING = 0.6  # of the ground in Kanai's and Tajimi's filter, for firm ground
LOW, LOW_DAMPING = 0.1, 0.6  # of Clough and Penzien's second filter: its frequency, of that of the first, and damping
PEAK_AT, LEFT = 0.2, 0.05  # of the envelope: where it is largest, of the duration, and what is left of it at the end
DIGITS = 9  # of the peak: of exponentials and filters the last bits are a processor's own


def _above(name, value, unit):
    return checks.number(name, value, GroundMotionError, f"give {unit} above 0", above=0)


def rectangular(peak, duration) -> GroundMotion:
    """A constant horizontal acceleration ``peak`` [m/s²] from 0 s on for the ``duration`` [s]; both above 0."""
    peak, duration = _above("peak", peak, "m/s²"), _above("duration", duration, "seconds")
    told = f"synthetic: rectangular pulse of {peak:g} m/s² over {duration:g} s"
    return GroundMotion([0.0, duration], [peak, peak], name="synthetic rectangular pulse", source=told)


def half_sine(peak, duration) -> GroundMotion:
    """A half sine of the ``peak`` [m/s²] and the ``duration`` [s], both above 0, as a thousand straight pieces."""
    peak, duration = _above("peak", peak, "m/s²"), _above("duration", duration, "seconds")
    part = np.arange(POINTS + 1) / POINTS
    told = f"synthetic: half sine of {peak:g} m/s² over {duration:g} s"
    return GroundMotion(duration * part, peak * np.sin(math.pi * part), name="synthetic half sine", source=told)


def sine(peak, frequency, cycles=1) -> GroundMotion:
    """So many whole ``cycles`` of a sine of the ``peak`` [m/s²] and the ``frequency`` [Hz], both above 0; two thousand
    straight pieces a cycle.
    """
    peak, frequency = _above("peak", peak, "m/s²"), _above("frequency", frequency, "Hz")
    most = MOST_POINTS // (2 * POINTS)
    cycles = checks.count("cycles", cycles, GroundMotionError, f"give a whole number from 1 to {most}", most=most)
    number = np.arange(2 * POINTS * cycles + 1)
    values = peak * np.sin(math.pi / POINTS * (number % (2 * POINTS)))  # all cycles have the same bits
    told = f"synthetic: {cycles} {'cycle' if cycles == 1 else 'cycles'} of a sine of {peak:g} m/s² and {frequency:g} Hz"
    return GroundMotion(number / (2 * POINTS * frequency), values, name="synthetic sine", source=told)


def stochastic(peak, duration, frequency, seed, vertical_peak=0.0, damping=DAMPING, step=0.01) -> GroundMotion:
    """Filtered noise of an envelope, as a record that nobody has measured: the largest horizontal acceleration is
    ``peak`` [m/s²], the envelope falls to a twentieth after the ``duration`` [s], where the record ends, and the power
    spectrum is largest near the ``frequency`` [Hz]. ``seed``: a whole number; the same one gives the same bits.
    ``vertical_peak`` [m/s²], from 0: of a vertical component, independent noise of the same kind. ``damping`` of the
    ground's filter, from 0.05 to 2; ``step`` [s] of the values, a tenth of the period or less.

    White noise goes through the filter of Kanai (1957) and Tajimi (1960), which stands for the ground as an oscillator
    on rock, and the second one of Clough and Penzien (1975), which takes away what is slower than a tenth of its
    frequency. The product with the envelope of Saragoni and Hart (1974), t^b exp(-c t), in the form of Boore (2003), is
    largest after a fifth of the duration. The ground drifts by what is left (:attr:`GroundMotion.drift`).

    Raises GroundMotionError for values that make no such motion.
    """
    from scipy import signal  # slow to import, and nothing else of the package asks for it

    peak, duration = _above("peak", peak, "m/s²"), _above("duration", duration, "seconds")
    frequency = _above("frequency", frequency, "Hz")
    damping = checks.number("damping", damping, GroundMotionError, "give a number from 0.05 to 2", least=0.05, most=2)
    seed = checks.count("seed", seed, GroundMotionError, "give a whole number from 0", least=0, most=2**32 - 1)
    vertical_peak = checks.number("vertical_peak", vertical_peak, GroundMotionError, "give 0 or more m/s²", least=0)
    least, most = duration / MOST_POINTS, min(0.1 / frequency, 0.1 * duration)
    remedy = f"give seconds, from {least:g} to {most:g}: a tenth of the period, and of the duration, or less"
    step = checks.number("step", step, GroundMotionError, remedy, least=least, most=most)
    time = step * np.arange(round(duration / step) + 1)

    # of the square of the filter's frequency: where its spectrum is largest
    share = (math.sqrt(1 + 8 * damping**2) - 1) / (4 * damping**2)
    ground = 2 * math.pi * frequency / math.sqrt(share)
    low = LOW * ground
    filters = (
        ((2 * damping * ground, ground**2), (1.0, 2 * damping * ground, ground**2)),
        ((1.0, 0.0, 0.0), (1.0, 2 * LOW_DAMPING * low, low**2)),
    )
    b = -PEAK_AT * math.log(LEFT) / (1 + PEAK_AT * (math.log(PEAK_AT) - 1))
    part = time / (PEAK_AT * duration)
    envelope = part**b * np.exp(b * (1 - part))
    dice = np.random.RandomState(seed)  # whose numbers stay what they are from version to version

    def component(largest):
        noise = dice.standard_normal(len(time))
        for numerator, denominator in filters:
            noise = signal.lfilter(*signal.bilinear(numerator, denominator, 1 / step), noise)
        noise *= envelope
        return largest * np.round(noise / np.abs(noise).max(), DIGITS)

    horizontal = component(peak)
    told = (
        f"synthetic: filtered noise, peak {peak:g} m/s², {duration:g} s, {frequency:g} Hz, seed {seed}, damping "
        f"{damping:g}, step {step:g} s"
    )
    if vertical_peak:
        told += f", vertical peak {vertical_peak:g} m/s²"
    return GroundMotion(time, horizontal, component(vertical_peak), name="synthetic filtered noise", source=told)
