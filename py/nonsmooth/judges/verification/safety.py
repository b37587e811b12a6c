"""The factor of safety by strength reduction: of blocks on planes against limit equilibrium, and of slopes that are
published.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from yade import O

from ... import records
from ...figures import safety as figures
from ...measure import slices
from ...model import section
from ...model.materials import ENVELOPE
from ...records import checkpoints
from ...studies.safety import results, search
from ...studies.safety.asked import Asked, SafetyError
from ...system.whole_files import empty
from .cases import run_cases
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


@dataclass(frozen=True)
class Published:
    """A slope that ships: ``name`` of its section, its ``factor`` and by ``whom``, that of ``bishop``'s circles, and
    between which x [m] the worst of them leaves the ground at its ``foot`` and its ``crest``; ``off``: by how much of
    it the mean of the most disks may be off.
    """

    name: str
    factor: float
    whom: str
    bishop: float
    foot: tuple
    crest: tuple
    off: float


PUBLISHED = (
    Published("acads_1a", 1.00, "ACADS, the referee", 0.987, (-3.0, 5.0), (-33.0, -18.0), 0.1),
    Published("griffiths_lane", 1.40, "Griffiths and Lane", 1.380, (-4.0, -1e-6), (-31.0, -18.0), 0.25),
    Published("acads_1c", 1.39, "ACADS, the referee", 1.406, (-3.0, 5.0), (-33.0, -18.0), 0.1),
)
WHY = "a tenth is asked for, and means of three such packings scatter by a twentieth"
OVER_THE_TOE = (
    "on a rigid base slides leave the face some disks above the toe: less with more of them, see the page on the factor"
)
COUNTS, SEEDS = (500, 2000, 8000), (1, 2, 3)
QUICK_COUNTS = (300,)
NARROW = 0.04  # width of these brackets


def soils_of(made, weights):
    """The Soils of a Section's layers, with the envelopes of their rocks; ``weights``: of each, of its bulk [N/m³]."""
    envelopes = [made.materials[layer.material].envelope for layer in made.layers]
    return [
        slices.Soil(np.array(layer.vertices), e.cohesion, e.friction_deg, weight)
        for layer, e, weight in zip(made.layers, envelopes, weights)
    ]


def slope_factor(folder, name, disks, seed):
    """Searches the factor of safety of a shipped section with about so many disks; its summary's numbers, and
    ``weights``, of the bulk of each layer [N/m³].
    """
    made = section.load(name).with_disks(disks).with_values({"seed": seed})
    found = search.run(Asked(made, quantities=(ENVELOPE,), numbers={"within": NARROW}), folder)
    start = records.read_snapshot(folder / results.START)
    area = np.bincount(start.layer, math.pi * start.r**2, len(made.layers))
    weights = [
        float(made.gravity * made.materials[layer.material].density * a / layer.area)
        for layer, a in zip(made.layers, area)
    ]
    keys = ("verdict", "factor", "factor_low", "factor_high", "disks", "failing_share", "steps")
    return {key: found[key] for key in keys} | {"weights": weights}


@check(
    "Published slopes: factors of safety of disks with the envelope of their soil",
    subject="Slopes",
    seconds=1200,
    quick=40,
)
def published_slopes(bench):
    """Three faces of 2:1, 10 m high, whose factors of safety are published: ACADS 1(a), the first example of Griffiths
    and Lane, and ACADS 1(c). Their soils are asked for by c and φ, and the table of calibrated rocks, which biaxial
    tests have measured, says what the contacts of such disks are. What is divided is the envelope: at a factor F the
    disks have the contacts that the table has for c/F and tan φ/F.

    The published factors are those of a continuum; so is Bishop's,

        F = Σ (c b + W tan φ)/m_α / Σ W sin α ,  m_α = cos α + sin α tan φ/F ,

    on the worst circle through the layers of the sections, which must be the published one: so these are the published
    slopes. Factors of disks stand beside it, for three packings each of more and more disks: with few of them slides
    are a few disks deep, and packings differ. The means of the most disks are claimed.
    """
    counts, seeds = (QUICK_COUNTS, SEEDS[:1]) if bench.quick else (COUNTS, SEEDS)
    cases = [dict(name=p.name, disks=n, seed=s) for p in PUBLISHED for n in counts for s in seeds]
    found = run_cases(bench, slope_factor, cases)
    claims, rows, drawn, numbers = Claims(), [], [], {}
    for k, p in enumerate(PUBLISHED):
        made = section.load(p.name)
        of = found[k * len(counts) * len(seeds) : (k + 1) * len(counts) * len(seeds)]
        by_count = [of[j * len(seeds) : (j + 1) * len(seeds)] for j in range(len(counts))]
        circle = slices.worst_circle(soils_of(made, by_count[-1][0]["weights"]), p.foot, p.crest)
        why = "circles are searched here and there, and the disks weigh what the soil does to a per cent"
        claims.near(f"{made.name}: Bishop's factor", circle.factor, p.bishop, why, relative=0.01, against="Bishop")
        disks = [round(float(np.mean([one["disks"] for one in group]))) for group in by_count]
        rows += [
            [*((made.name, p.whom, f"{p.factor:.2f}") if not j else ("",) * 3), f"{n:,}", *_scatter(group, p.factor)]
            for j, (n, group) in enumerate(zip(disks, by_count))
        ]
        factors = [[_number(one) for one in group] for group in by_count]
        if not bench.quick:
            why = WHY if p.off <= 0.1 else OVER_THE_TOE
            what = f"{made.name}: mean factor of three packings of {disks[-1]:,} disks"
            claims.near(what, float(np.mean(factors[-1])), p.factor, why, relative=p.off, against=p.whom)
        drawn.append({"label": made.name, "published": p.factor, "disks": disks, "factors": factors})
        numbers[p.name] = {"bishop": circle.factor, "disks": disks, "searches": by_count}
    heads = ["slope", "published by", "factor", "disks", f"seeds {', '.join(map(str, seeds))}"]
    heads += ["mean", "standard deviation", "off"]
    caption = "Factors of safety of slopes of disks over those that are published, against the number of disks."
    return Findings(
        claims,
        plots=[(figures.by_disks(drawn), caption)],
        tables=[("Factors of safety of published slopes", heads, rows)],
        numbers=numbers,
    )


def _number(found):
    """The factor of a search, nan where the table of rocks has ended before."""
    return math.nan if found["factor"] is None else found["factor"]


def _scatter(group, published):
    """Texts of a row of searches: factors, their mean and standard deviation, and what the mean is off."""
    factors = [_number(one) for one in group]
    each = [f"> {one['factor_low']:.3f}" if one["verdict"] == "stands" else f"{_number(one):.3f}" for one in group]
    if not np.isfinite(factors).all():
        return ", ".join(each), "", "", ""
    mean = float(np.mean(factors))
    deviation = f"{np.std(factors, ddof=1):.3f}" if len(factors) > 1 else ""
    return ", ".join(each), f"{mean:.3f}", deviation, f"{100 * (mean / published - 1):+.1f} %"
