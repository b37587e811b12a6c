"""The factor of safety of blocks on planes, by strength reduction, against limit equilibrium."""

from __future__ import annotations

import math

from yade import O

from ...figures import safety as figures
from ...model import section
from ...records import checkpoints
from ...studies.safety import results, search
from ...studies.safety.asked import Asked, SafetyError
from ...system.whole_files import empty
from .claims import Claims, Findings
from .registry import check

WITHIN = 0.005  # width of the bracket
DISKS = "of so many disks the weight and the bonded length of the plane are the block's to a per cent"
BRACKET = "the bracket is 0.5 % wide, and rigid disks slip all at once"


def limit_equilibrium(weight, adhesion, friction, dip, off=0.0, along=0.0):
    """F of a rigid block on a plane of ``dip`` [degrees]: its ``weight``, Σ F_a of its bonds, and the water's force
    ``off`` the plane and ``along`` it, down [N/m].
    """
    c, s = math.cos(math.radians(dip)), math.sin(math.radians(dip))
    return friction * (adhesion + weight * c - off) / (weight * s + along)


@check("A block on a plane with water in its tension crack: the factor of safety", subject="Slopes", seconds=10)
def priests_block(bench):
    """Priest's block: 25 kN/m³ between (0, 0), (17, 30), (25.98, 30) and (25.98, 15) m, on a plane of 30° and A = 30 m
    with c = 20 kPa and φ = 30°. With z = 3.75 m of water in the crack, V = γ_w z²/2 pushes horizontally, and
    U = γ_w z A/2 off the plane, so

        F = (c A + (W cos 30° − U − V sin 30°) tan 30°) / (W sin 30° + V cos 30°) = 1.048 .

    (The 1.049 that is quoted has a face of exactly 60°.) All contacts of a rigid block slip at once. So the search must
    find what these disks' weight, their bonds with the plane and the force of the water on them give in this formula,
    and that must be near the book's.
    """
    made, folder = section.load("priest"), bench.folder / "priest"
    asked = Asked(made, materials=("plane",), numbers={"within": WITHIN})
    O.reset()
    empty(folder)  # of an earlier run's, which would be gone on with
    found = search.run(asked, folder)
    told = checkpoints.read(folder / results.STABLE, asked.key, SafetyError)
    walls = {i for ids in told["walls"].values() for i in ids}
    disks = [b for b in O.bodies if b.id not in walls]
    length = sum(2 * O.bodies[i.id2].shape.radius for i in O.interactions if i.id1 in walls and i.phys.bonded)
    weight = made.gravity * sum(b.state.mass for b in disks)
    O.step()  # what acts on the disks is not saved
    water = next(e for e in O.engines if type(e).__name__ == "PorePressureEngine").totalForce
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    plane, across = made.materials["plane"], made.side * water[0]
    exact = limit_equilibrium(
        weight,
        plane.tensile_strength * length,
        plane.friction,
        30,
        across * s + water[1] * c,
        across * c - water[1] * s,
    )
    crack, uplift = 0.5 * 9810 * 3.75**2, 0.5 * 9810 * 3.75 * 30
    book = limit_equilibrium(
        25e3 * 329.55, 20e3 * 30 / plane.friction, plane.friction, 30, uplift + crack * s, crack * c
    )
    claims = Claims()
    claims.near("factor of safety of these disks", found["factor"], exact, BRACKET, relative=WITHIN)
    claims.near("factor of safety of the book's block", found["factor"], book, DISKS, relative=0.02, against="Priest")
    plot = figures.displacements(found["trials"], (found["factor_low"], found["factor_high"]))
    return Findings(claims, plots=[(plot, "Displacement of the block against the factor, and the bracket.")])
