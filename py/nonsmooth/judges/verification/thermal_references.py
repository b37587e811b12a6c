"""What checks of slip surfaces that heat are held against: closed forms, a boundary value solver, numbers of another
program and of steam tables, and the cases themselves.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import cumulative_trapezoid, solve_bvp

from ...slip import block, laws

__all__ = [
    "DIFFUSING",
    "DRAINING",
    "G",
    "GENTLE",
    "MELT",
    "ROCK",
    "STEAM",
    "WATER",
    "ZONE",
    "layer",
    "melting",
    "undrained",
]

G = 9.81
WATER = ("thermal_pressurization",)
#: A zone like that of Vaiont under 100 m of rock on 22°, without diffusion.
ZONE = dict(
    friction=0.40,
    thickness=0.01,
    heat_capacity=2.85e6,
    thermal_diffusivity=0.0,
    hydraulic_diffusivity=0.0,
    pressurization_coefficient=6.7e4,
    temperature=20.0,
    water_pressure=1e6,
)
ROCK = block.OnSlope(dip=22, depth=100, density=2400, speed=0.1)
GENTLE = dict(dip=15, depth=100, density=2400)
#: Of TP-3: share of strength, time [s], slip [m], speed [m/s], mean temperature rise [K], by BDF with 160 nodes in h/2.
DIFFUSING = (
    (0.5, 1.787, 0.768, 1.276, 16.44),
    (0.1, 2.604, 2.617, 3.449, 29.68),
    (0.05, 2.827, 3.470, 4.210, 31.36),
    (0.01, 3.313, 5.936, 5.952, 32.77),
)
#: Of TP-4, a zone of 1.4 mm: hydraulic diffusivity [m²/s], slip [m] and mean temperature rise [K] at 5 % of strength.
DRAINING = ((7e-8, 0.727, 33.44), (1e-6, 1.843, 57.39), (1e-5, 6.721, 162.2))
#: Vapour pressures [MPa] of IAPWS-IF97 at temperatures [°C].
STEAM = ((100, 0.1014), (150, 0.4761), (200, 1.5547), (250, 3.976), (300, 8.588))
#: A layer of melt with round numbers.
MELT = dict(viscosity=100.0, decay=0.02, conductivity=2.0, thickness=1e-4)


def undrained(values, rock, share):
    """Time [s], slip [m], speed [m/s] and temperature rise [K] of a block without diffusion at a share of its strength:
    v² from the work of weight and strength, and time from it.
    """
    critical = (
        values["heat_capacity"] * values["thickness"] / (values["friction"] * values["pressurization_coefficient"])
    )
    slip = critical * math.log(1 / share)
    d = np.r_[0, np.geomspace(1e-6, slip, 20001)]
    lost = values["friction"] * math.cos(math.radians(rock.dip)) * critical * (1 - np.exp(-d / critical))
    speed = np.sqrt(rock.speed**2 + 2 * G * (math.sin(math.radians(rock.dip)) * d - lost))
    time = cumulative_trapezoid(1 / speed, d)[-1]
    return time, slip, speed[-1], rock.normal_stress / values["pressurization_coefficient"] * (1 - share)


def layer(speed, viscosity, decay, conductivity, thickness):
    """Shear stress [Pa] and rise [K] of a layer between walls at the melting point, by a boundary value solver: half of
    it, with T and u scaled; the stress is a parameter.
    """

    def fields(y, z, p):  # T, K T'/…, u over half of the layer; y from the middle, in units of m/2
        theta, flux, _ = z
        half, tau = thickness / 2, math.exp(p[0])
        rate = tau / (viscosity * np.exp(-decay * theta))
        return np.vstack((flux, -(half**2) * tau * rate / conductivity, half * rate))

    def ends(a, b, p):
        return np.array([a[1], a[2], b[0], b[2] - speed / 2])

    y = np.linspace(0, 1, 101)
    guess = np.vstack((1 - y**2, -2 * y, speed / 2 * y))
    found = solve_bvp(
        fields, ends, y, guess, [math.log(0.5 * viscosity * speed / thickness)], tol=1e-8, max_nodes=100000
    )
    if not found.success:
        raise RuntimeError(found.message)
    return math.exp(found.p[0]), found.sol(0)[0]


def melting(**changed):
    """A law of melt with round numbers, between walls at 1100 °C."""
    values = dict(
        friction=0.6, thickness=0, heat_capacity=3.2e6, thermal_diffusivity=0.9e-6, temperature=0, duration=100
    )
    values |= dict(
        finest_node=2e-5, melting_temperature=1100, melt_viscosity=100, melt_conductivity=2, squeezing_length=0.01
    )
    values |= dict(activation_temperature=0.02 * 1373.15**2, melting_heat=3.24e9)
    return laws.SlipLaw("shear_melting", **{**values, **changed})
