"""What a rapid drawdown does to a long slope, as a section says it, in every book-keeping. Needs no YADE."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from ....model import section
from ....water import forces, of_section
from ..claims import Claims, Findings
from ..registry import check

__all__ = [
    "AFTER",
    "BARE",
    "BEFORE",
    "BETA",
    "BOOKS",
    "FULL",
    "THICK",
    "at",
    "factor",
    "layer_on_a_plane",
    "rapid_drawdown",
    "seeping",
]

BETA, THICK, PHI = math.radians(21), 10.0, 0.84  # dip, thickness [m], packing fraction
BEFORE, AFTER = 0.0, 5.0  # times [s] of the two states
FULL, BARE = {"time": BEFORE, "reservoir": 120.0}, {"time": AFTER, "drained": False}  # of seepage

#: Density of disks [kg/m³], ``water`` of the section, and the factor of safety after a drawdown by that before it: in
#: closed form, and as it is printed.
BOOKS = {
    "N' stays": (2260 / PHI, {"volume": "bulk", "phreatic": {"flow": "along"}}, 1 - 1000 / 2260, 0.5575),
    "Morgenstern's B = 1": (2260 / PHI, {"volume": "bulk"}, 1 - 1000 / 2260 / math.cos(BETA) ** 2, 0.492),
    "the paper's bulk": (2500.0, {"volume": "bulk", "phreatic": {"flow": "along"}}, 1 - 1000 / 2100, 0.524),
    "volumes of disks": (2500.0, {"volume": "disk", "phreatic": {"flow": "along"}}, 1 - 1000 / 2500, 0.600),
}


def at(s, h):
    """The place [m] s up the plane and h above it."""
    return [-s * math.cos(BETA) + h * math.sin(BETA), s * math.sin(BETA) + h * math.cos(BETA)]


def layer_on_a_plane(density, **water):
    """A Section: a layer of disks of a ``density`` [kg/m³] on a plane, under a reservoir; in a second state with water
    up to its surface. ``water``: keys of the section's that take the place of phreatic lines, or come beside them.
    """
    base, surface = ([[x, -x * math.tan(BETA) + up / math.cos(BETA)] for x in (-190.0, 0.0)] for up in (0.0, THICK))
    lines = [{"time": BEFORE, "points": [[-210.0, 120.0], [40.0, 120.0]]}, {"time": AFTER, "points": surface}]
    if "seepage" not in water:
        water["phreatic"] = {"lines": lines, **water.get("phreatic", {})}
    rock = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False, "density": density}
    plane = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False}
    return section.of(
        name="long",
        walls=[{"name": "plane", "material": "plane", "role": "slip", "vertices": [at(215, 0), at(-15, 0)]}],
        layers=[{"name": "rock", "material": "rock", "vertices": [*base, *surface[::-1]]}],
        materials={"rock": rock, "plane": plane},
        disks={"diameter": [0.5, 1.0], "packing_fraction": PHI},
        water=water,
    )


def seeping(*states, conductivity=1e-5, size=2.5, density=2260 / PHI, **keys):
    """The same Section with seepage that is computed for these states."""
    return layer_on_a_plane(
        density, volume="bulk", seepage={"size": size, "conductivity": conductivity, "states": states, **keys}
    )


def factor(made, time):
    """Factor of safety, by tan φ, of disks within the layer far from its ends at a ``time`` [s]: normal by shear force
    on the plane.
    """
    rng = np.random.default_rng(7)
    x, y = np.array([at(s, h) for s, h in zip(rng.uniform(40, 160, 300), rng.uniform(0.2, THICK - 0.2, 300))]).T
    r = rng.uniform(0.25, 0.5, 300)
    share = {"packing_fraction": made.disks.packing_fraction} if made.water.volume == "bulk" else {}
    force = forces.on_disks(of_section.field(made), x, y, r, time, area=made.water.volume, **share)
    force[:, 1] -= made.materials["rock"].density * made.gravity * math.pi * r**2
    total = force.sum(axis=0)
    return -(total @ made.normal) / (total @ made.downslope)


@check("Rapid drawdown of a long slope, in every book-keeping", subject="Water", seconds=4)
def rapid_drawdown(bench):
    """A layer on a plane of the dip β = 21° stands under water; its factor of safety is that of the dry slope, tan φ/tan
    β. Then the reservoir is gone, and the water in the layer is not. What is left of the factor depends on the
    book-keeping, which a section names by ``water.volume``, ``water.phreatic.flow`` and the density of its disks:

    * the effective stresses stay (undrained, no strain along the normal): −∇p of water that flows along the slope on
      the bulk. 1 − γ_w/γ, which is 0.5575 for a bulk of 2,260 kg/m³ and 0.524 for the paper's 2,100;
    * the pressure on the plane is γ_w times the depth, which is Morgenstern's B = 1: −∇p of water that flows sideways.
      Its part down the slope makes up for the buoyancy, so that the shear force is that of the whole weight, and N'
      falls to 1 − γ_w/(γ cos² β), 0.492;
    * −∇p acts on the volumes of disks alone: 1 − ρ_w/ρ, 0.600.

    With ``water.seepage`` and ``drained: false`` the same comes of computed heads, and a slope that has drained is dry.
    """
    claims, figure = Claims(), Figure(figsize=(7.2, 3.2), layout="constrained")
    axes, dry = figure.add_subplot(), 1 / math.tan(BETA)
    why, mesh = "rounding", "the mesh's, and the ends' of the layer"

    def shown(k, ratio, closed):
        axes.plot(ratio, k, "o", color="#0072B2")
        axes.plot(closed, k, "|", color="#D55E00", ms=22, mew=2)

    for k, (name, (density, water, closed, printed)) in enumerate(BOOKS.items()):
        made = layer_on_a_plane(density, **water)
        before, after = factor(made, BEFORE), factor(made, AFTER)
        claims.near(f"{name}: factor under water, by the dry slope's", before / dry, 1, why, absolute=1e-10)
        claims.near(f"{name}: closed form", closed, printed, "printed so", absolute=5e-4)
        claims.near(f"{name}: factor after the drawdown, by before", after / before, closed, why, absolute=1e-10)
        shown(k, after / before, closed)
    layers = {"rock": {"along": 2e-5, "across": 1e-5, "dip": 21.0}}
    made = seeping(FULL, BARE, {"time": 9.0, "reservoir": -100.0}, conductivity=layers)
    before, after, drained = (factor(made, time) for time in (BEFORE, AFTER, 9.0))
    claims.near("seepage: factor under water, by the dry slope's", before / dry, 1, why, absolute=1e-10)
    expected = 1 - 1000 / 2260
    claims.near("seepage: factor after the drawdown, by before", after / before, expected, mesh, relative=2e-3)
    claims.near("seepage: factor when it has drained, by the dry slope's", drained / dry, 1, mesh, absolute=0.02)
    shown(len(BOOKS), after / before, expected)
    axes.set_yticks(range(len(BOOKS) + 1), [*BOOKS, "seepage, drained: false"])
    axes.set(xlabel="factor of safety after the drawdown, by that before it", ylim=(len(BOOKS) + 0.6, -0.6))
    return Findings(claims, plots=[(figure, "Dots: what the forces on disks give. Bars: closed forms.")])
