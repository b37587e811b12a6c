"""The statements of the paper's section 6, on slopes of its section: what forces on walls do from stage to stage of the
avalanche.
"""

from __future__ import annotations

import dataclasses
import math

from ... import figures, records
from ...measure.characteristic_times import chosen_rows
from ...measure.ground import ground_of
from ...measure.statistics import Estimate, over_seeds
from ...measure.weakening import foot_length, weakened_share
from ...model import scales, section
from ...studies.slope import run_files
from . import Claims, Findings, check
from .cases import folder_of, run_cases

SUBJECT = "The paper's section 6"
DISKS, SEEDS = 3000, (1, 2, 3, 4, 5)
QUICK_SEEDS = SEEDS[:2]  # of the same size: slopes of 1,500 disks scatter twice as much


@dataclasses.dataclass(frozen=True)
class Statement:
    """A number of :mod:`..measure.force_stages`: in words, what the paper says of it, the least and the largest mean
    over seeds, and why these.
    """

    what: str
    paper: str
    low: float
    high: float
    why: str


STATEMENTS = {
    "normal_change": Statement(
        "change of the total normal force on DP until failure, of itself", "constant [115]", -0.02, 0.02,
        "friction along FB holds the toe down by a few per cent of the force on FB, which is a seventh of that on DP",
    ),
    "shear_share": Statement(
        "shear force on DP by its friction times the effective normal force, until failure", "1, eq. (20)", 0.93, 1.0,
        "Coulomb's limit cannot be passed; short of it are places where the packing came to rest on DP without sliding",
    ),
    "shear_drop": Statement(
        "fall of the shear force on DP by its friction times the water's force, until failure", "1, eq. (19)", 0.3, 1.1,
        "1 where DP is at its limit from the beginning on; a few per cent short of it are as much as the water lets go in metres, and only reach it as it rises",
    ),
    "backstop_rise": Statement(
        "rise of the force on FB by the fall of the shear force on DP, until failure", "1, eq. (21)", 0.8, 1.2,
        "a balance of forces, but for what the toe rests on SS with, and for means over a second of forces that change",
    ),
    "backstop_span": Statement(
        "span of the force on FB from failure to the acceleration, of itself", "fairly constant [116]", 0.0, 0.05,
        "t1 is where it comes within 2 %; after that it may rise by these and fall by little",
    ),
    "backstop_swing": Statement(
        "largest force on FB in a step over the mean of its row, in the same time", "fairly constant [116]", 0.0, 0.1,
        "single bonds break; with a correction that left velocities behind steps swung by a quarter",
    ),
    "backstop_fall": Statement(
        "fall of the force on FB after its largest value until the acceleration, of that", "fairly constant [116]", 0.0, 0.05,
        "a foot that bears no more and yet holds lets go of a per cent or two as bonds break; one that loses its strength where it is overcome, of a quarter and more",
    ),
    "release_rise": Statement(
        "rise of the effective normal force on DP at the release: after over before", "above 1 [117]", 1.05, 1.4,
        "the water bears a fifth of the weight before; some of the mass has left DP after",
    ),
    "normal_fall": Statement(
        "normal force on DP at rest over that when the motion begins", "below 1 [118]", 0.3, 0.9, "a third of the mass leaves DP at least, and a third stays",
    ),
    "backstop_momentum": Statement(
        "correlation of the force on FB with the momentum of what lies on DP, in motion", "above 0 [118]", 0.1, 0.95, "collisions make the force swing about its mean",
    ),
    "shear_moving": Statement(
        "mean shear force on DP in motion, of the dry one", "small, above 0 [118]", 0.0, 0.1, "only what is not weakened near the foot bears shear",
    ),
    "backstop_final": Statement(
        "force on FB at rest over that at failure", "above 1 [119]", 1.05, 4.0, "friction on DP is gone, and the deposit leans on FB",
    ),
    "shear_final": Statement(
        "shear force on DP at rest, of the dry one", "small, below 0 [119]", -0.1, 0.05, "only the foot has friction left; its sense depends on how the mass came to rest",
    ),
}  # fmt: skip


WEDGE = (1.0, 150.0)  # m, of the lowest part of DP that keeps its strength: some of it, and less than a tenth of DP

#: Other numbers of a run's summary: what they are, and what the paper says.
NUMBERS = {
    "water_at_failure_m": ("water at failure, t1 [m]", "22.5 [115]"),
    "water_highest_m": ("largest height of the table [m]", "22.5 [115]"),
    "triggering_s": ("from the acceleration to the fall of the shear force, t2 to t3 [s]", "about 5 [117]"),
    "weakening_s": ("of these from the first weakening on [s]", "not named"),
    "motion_s": ("motion, t3 to t5 [s]", "about 35 [118]"),
    "wedge_m": ("lowest part of DP that is not weakened at the end [m]", "lowermost portion [119]"),  # claimed too
    **{
        f"friction_{wall}_rel": (f"work of friction on {wall}, of all that is dissipated", "not named")
        for wall in ("DP", "FB", "SS")
    },
}


def slope(disks, seed):
    """The shipped section with about so many disks."""
    return dataclasses.replace(section.load("jiufengershan").with_disks(disks), seed=seed)


def avalanche(folder, disks, seed):
    """Runs a :func:`slope` in the (empty) scene until it rests; returns its summary, as ``wedge_m`` how far up from the
    foot the end of DP is not weakened [m], and as ``friction_WALL_rel`` the work of friction on each wall by all that
    is dissipated."""
    from ...studies.slope import experiment

    chosen = slope(disks, seed)
    run = experiment.begin(chosen, folder)
    run.run()
    summary = run.summarise(threads=1)
    slid, lost = summary["sliding_on_walls_J_per_m"], summary["energy_dissipated_J_per_m"]
    return (
        summary
        | {"wedge_m": wedge(chosen, records.read_snapshot(folder / run_files.END))}
        | {f"friction_{wall}_rel": work / lost for wall, work in slid.items()}
    )


def wedge(chosen, end):
    """Length [m] of the lowest part of the slip surface that is not weakened (paper, [119])."""
    ground = ground_of(chosen)
    (column, wall), *_ = ground.weakening.items()
    return foot_length(*weakened_share(end, wall.vertices, column, ground.side))


@check("What forces on the walls do until, in and after the avalanche", subject=SUBJECT, seconds=300, quick=60)
def paper(bench):
    """Slopes of the paper's section with 3,000 disks, five packings.

    Until failure the slope stands, and forces along DP are in balance. It is steeper than its friction angle, so its
    friction is fully used: T_DP = μ N'_DP (eq. 20). Water takes N'_DP, and T_DP falls by μ U_DP (eq. 19), which FB
    takes over (eq. 21). At t1 the foot bears no more, N'_FB stays level, and does not fall from its largest value,
    until the slope accelerates at t2 [116]. The shear force drops as slip passes D_c, water is released and N'_DP rises
    [117]; in motion N_DP falls as the mass leaves DP, N'_FB goes with the momentum, T_DP is small [118]. At rest N'_FB
    is higher than at failure, T_DP small and of the other sense, for the lowest part of DP is below the slip surface
    and keeps its friction [119].

    Each of these is one number of a run (yade.nonsmooth.measure.force_stages), and means over packings are claimed. In
    a quick run there are two packings.
    """
    seeds = QUICK_SEEDS if bench.quick else SEEDS
    cases = [dict(disks=DISKS, seed=seed) for seed in seeds]
    found = run_cases(bench, avalanche, cases)
    stages = {name: [run["force_stages"][name] for run in found] for name in STATEMENTS}
    others = {name: [run[name] for run in found] for name in NUMBERS}
    rows = [[said.what, said.paper, *_shown(stages[name])] for name, said in STATEMENTS.items()]
    rows += [[*told, *_shown(others[name])] for name, told in NUMBERS.items()]
    first = folder_of(bench, avalanche, cases[0])
    chosen = slope(DISKS, seeds[0])
    series = chosen_rows(records.read_series(first / "series.csv"), {"failed_dry": found[0]["failed_dry_s"]})
    figures.forces_against_time(
        series, found[0]["times_s"], bench.folder / "forces.png", window=scales.of(chosen).mean_seconds, walls=chosen
    )
    plot = bench.folder / "forces.png", f"Forces on the walls against time, seed {seeds[0]} (the paper's Figure 12)."
    heads = ("", "the paper", "ours, mean", "95 % interval", "each")
    table = f"Section 6, {len(seeds)} slopes of about {found[0]['disks']:,} disks", heads, rows
    return Findings(
        claims_of(stages) + [wedge_claim(others["wedge_m"])],
        plots=[plot],
        tables=[table],
        numbers={name: over_seeds(values) for name, values in (stages | others).items()},
    )


def claims_of(stages):
    """A claim for each of :data:`STATEMENTS`, of its mean over packings; ``stages``: {name: its values, one a
    packing}.
    """
    claims = Claims(against="the paper")
    for name, said in STATEMENTS.items():
        claims.between(said.what, _mean(stages[name]).mean, said.low, said.high, said.why)
    return claims


def wedge_claim(lengths):
    """A claim of the mean :func:`wedge` of several packings, ``lengths`` [m]."""
    why = (
        "the foot of DP lies below the slip surface and keeps its friction [119]; with a tenth of DP it would hold "
        "the slope"
    )
    return Claims(against="the paper").between(NUMBERS["wedge_m"][0], _mean(lengths).mean, *WEDGE, why)


def _mean(values):
    """Over seeds; what a run did not come to is no number, and no claim of it holds."""
    return Estimate.of([math.nan if v is None else v for v in values])


def _shown(values):
    """Mean, half width of its 95 % interval and single values, as text."""
    mean = _mean(values)
    each = ", ".join("-" if v is None else f"{v:.3g}" for v in values)
    return [f"{mean.mean:.3g}", f"± {mean.half_width:.2g}", each]
