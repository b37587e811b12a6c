"""The shipped slope, and what its paper says would change it or would not: control runs, as plans of a campaign. Needs
no YADE.

Taboada and Estrada (2009) hold that no avalanche comes without weakening of the slip surface ([72], [126]), that the
criterion by which disks are released from water has no major influence ([113]), and that the slope fails where the
water table has risen to a height ([115], [116]). A :class:`Variant` is the shipped section with some keys changed; one
of them stops the table at the height that the shipped slope of the same packing had at t1, so it runs after that one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ...campaign.plan import SEED, VERDICT, Plan, PlanError, Planned, numbers as numbers_of
from ...campaign.sweep import FUNCTION, arguments_of
from ...measure import force_stages, surface_slip
from ...measure.statistics import over_seeds, told
from ...model import section
from ...model.section import values as section_values
from ...system import checks
from ...records import read_snapshot
from ..runs import open_run
from ..slope import frames

__all__ = [
    "CHANGES",
    "DISKS",
    "SECTION",
    "SEEDS",
    "SHIPPED",
    "TIMES",
    "VARIANTS",
    "Variant",
    "changes",
    "check",
    "rows",
    "run",
    "slope_of",
    "table",
]

SECTION, SHIPPED, HELD = "jiufengershan", "shipped", "held"
DISKS, SEEDS = 3000, (1, 2, 3, 4, 5)
NAME = "variant"
BEYOND = 1e5  # m, that nothing comes to
D_C = "materials.dp.slip_weakening.critical_slip"
RELEASE = "water.release_distance"
BY, DILATION, DRAINAGE = "water.release.by", "water.release.dilation", "water.release.drainage_time"
TABLE = "water.table"


@dataclass(frozen=True)
class Variant:
    """``label``: in words; ``paper``: the paragraphs it is about; ``keys``: of the section file, with dots, and their
    values; ``stops_at``: number of the summary of the shipped slope of the same packing, at which height the table
    stops."""

    label: str
    paper: str
    keys: Mapping = field(default_factory=dict)
    stops_at: str | None = None


# the shipped slope releases disks from water at D_c, 5 m; a variant changes one of the two and leaves the other
VARIANTS = {
    SHIPPED: Variant("as shipped", "[114] to [119]"),
    "no-weakening": Variant("DP keeps its friction", "[72], [126]", {D_C: BEYOND, RELEASE: 5.0}),
    "no-release": Variant("water stays in the mass", "[113]", {RELEASE: BEYOND}),
    "release-10": Variant("release from water after 10 m", "[113]", {RELEASE: 10.0}),
    "release-2.5": Variant("release from water after 2.5 m", "[113]", {RELEASE: 2.5}),
    "dilatancy": Variant("release by dilatancy, 3 %", "[113]", {BY: "dilatancy"}),
    "dilatancy-5": Variant("release by dilatancy, 5 %", "[113]", {BY: "dilatancy", DILATION: 0.05}),
    "drained": Variant("release by dilatancy, water back in 2 s", "[113]", {BY: "dilatancy", DRAINAGE: 2.0}),
    "slip-or-dilatancy": Variant("release by slip or dilatancy", "[113]", {BY: "slip_or_dilatancy"}),
    "neither": Variant("neither weakening nor release", "[72], [126]", {D_C: BEYOND, RELEASE: BEYOND}),
    HELD: Variant("table stops at t1", "[115], [116]", stops_at="water_at_failure_m"),
}


def slope_of(name, disks, seed, shipped=None):
    """The Section of a variant with about so many disks. ``shipped``: the summary of the shipped slope of this packing,
    where the variant asks for one.

    Raises PlanError where that summary has not the number, SectionError for a number of disks or a seed that is none.
    """
    variant, base = VARIANTS[name], section.load(SECTION).with_disks(disks)
    values = {SEED: seed, **variant.keys}
    if variant.stops_at:
        height = (shipped or {}).get(variant.stops_at)
        if height is None:
            raise PlanError(
                f"{name}, seed {seed}: the shipped slope of this packing has no {variant.stops_at}, where the table is to stop; give other seeds or more disks"
            )
        # the shipped course up to there: it also waits where the slope moves and comes to rest again, as it would not
        # with a height for stages.water.hold
        values[TABLE] = {"points": [[0.0, 0.0], [height / base.water.rate, height]]}
    return section_values.with_values(base, values, f"{name}, seed {seed}")


def check(names, disks, seeds):
    """The ``names`` of variants and the ``seeds`` as lists. Raises PlanError for some that are none or stand twice,
    SectionError for a number of disks that is none.
    """
    names, seeds = list(names), list(seeds)
    unknown = [name for name in names if name not in VARIANTS]
    if unknown or not names or len(set(names)) < len(names):
        raise PlanError(f"slopes {', '.join(map(str, names)) or 'none'}: give some of {', '.join(VARIANTS)}, each once")
    if not seeds or len(set(seeds)) < len(seeds):
        raise PlanError(f"seeds {', '.join(map(str, seeds)) or 'none'}: give one or more, each once")
    for seed in seeds:
        checks.count("seeds", seed, PlanError, "give whole numbers from 0", least=0)
    section.load(SECTION).with_disks(disks)
    return names, seeds


def run(names, out, disks, seeds, threads=1, resume=False, progress=lambda share, ended: None) -> dict:
    """Runs the variants called ``names``, one slope of about so many ``disks`` for each of the ``seeds``, below the
    folder ``out``: {name: [runs.Run, …]}, in the order of the seeds.

    What a variant asks of the shipped slope is run too. The rest as for :meth:`.plan.Plan.run`. Raises PlanError for
    names or seeds that are none or stand twice, and what that raises.
    """
    names, seeds = check(names, disks, seeds)
    after = [name for name in names if VARIANTS[name].stops_at]
    first = [name for name in VARIANTS if name in names and name not in after or name == SHIPPED and after]
    whole = (len(first) + len(after)) * len(seeds)
    found = {}
    for group, folder in ((first, "slopes"), (after, "after")):
        if not group:
            continue
        shipped = [one.summary for one in found.get(SHIPPED, ())] or [None] * len(seeds)
        runs = tuple(
            _planned(name, slope_of(name, disks, seed, told), seed)
            for name in group
            for seed, told in zip(seeds, shipped)
        )
        done = len(found) * len(seeds)

        def shown(share, ended, n=len(runs), done=done):
            return progress((done + share * n) / whole, done + ended)

        Plan(SECTION, FUNCTION, runs).run(Path(out) / folder, threads, resume, shown)
        opened = iter(open_run(Path(out) / folder / "runs" / one.name) for one in runs)
        found |= {name: [next(opened) for _ in seeds] for name in group}
    return {name: found[name] for name in VARIANTS if name in names}


def _planned(name, made, seed):
    return Planned(f"{name}-{seed}", {NAME: name, SEED: seed}, arguments_of(made), float(sum(made.disk_counts())))


def rows(found) -> list:
    """What :func:`run` returned as plain data, a dictionary for each variant: ``name``, ``label``, ``paper``, ``of``,
    how many slopes there are, ``verdicts`` ({what became of a slope: how many}), ``weakened``, of how many the slip
    surface came to D_c, and ``numbers``, {name of a number of the summary, those of its dictionaries as ``key.key``: as
    statistics.over_seeds has it over the slopes that have it, with ``of``, how many these are}. Among these are
    ``triggering_by_speed_s`` and ``motion_by_speed_s``, t3 − t2 and t5 − t3 by other thresholds of speed;
    ``water_halved_s``, see force_stages.water_halved; ``since_t0_s``, t1 to t5 counted from t0; and ``slip_m``, the slip
    of the ``upper`` and of the ``lower`` half of the slip surface as its mean comes to D_c, and by how much the upper
    one is ``ahead``.
    """
    found_rows = []
    for name, runs in found.items():
        summaries = [numbers_of(one.summary | _durations(one) | _slips(one)) for one in runs]
        kinds = [one.get(VERDICT) for one in summaries]
        numbers = {}
        for key in dict.fromkeys(key for one in summaries for key in one):
            values = [one.get(key) for one in summaries]
            if not all(v is None or isinstance(v, (bool, int, float)) for v in values):
                continue
            there = [float(v) for v in values if v is not None]
            if there:
                numbers[key] = over_seeds(there) | {"values": values, "of": len(there)}
        variant = VARIANTS[name]
        found_rows.append(
            {
                "name": name,
                "label": variant.label,
                "paper": variant.paper,
                "of": len(runs),
                "verdicts": {kind: kinds.count(kind) for kind in dict.fromkeys(kinds)},
                "weakened": sum(one.get("weakening_begins_s") is not None for one in summaries),
                "numbers": numbers,
            }
        )
    return found_rows


def _durations(run):
    """Triggering and motion as other rules for t2 and t5 have them [s], by the thresholds of
    characteristic_times.by_threshold; and what else :func:`rows` adds to a summary.
    """
    summary = run.summary
    times = summary.get("times_s", {})
    t3 = times.get("t3")

    def known(name):
        return summary.get(name, {}).items()

    def less(a, b):
        return None if a is None or b is None else a - b

    return {
        "triggering_by_speed_s": {percent: less(t3, t2) for percent, t2 in known("t2_by_speed_s")},
        "motion_by_speed_s": {percent: less(t5, t3) for percent, t5 in known("t5_by_speed_s")},
        "since_t0_s": {name: less(time, times.get("t0")) for name, time in times.items() if name != "t0"},
        "water_halved_s": None if times.get("t2") is None else force_stages.water_halved(run.series, times),
    }


def _slips(run):
    """Which half of the slip surface is ahead as it weakens, see :func:`rows`; nothing where it does not weaken."""
    if run.summary.get("weakening_begins_s") is None:
        return {}
    begin, critical = run.snapshot("t0"), run.section.critical_slips
    surface = next(one for one in surface_slip.surfaces(run.section, begin) if one.name in critical)
    since = [path for time, path in frames.of_run(run.folder, run.series) if time > begin.time_s]
    found = surface_slip.halves(surface, begin, map(read_snapshot, since), critical[surface.name])
    return {} if found is None else {"slip_m": dict(zip(("upper", "lower", "ahead"), (*found, found[0] - found[1])))}


#: {number: (its head in a table, its factor, digits)}.
SHOWN = {
    "water_highest_m": ("highest water [m]", 1, 1),
    "weakening_begins_s": ("D_c is reached [s]", 1, 0),
    "speed_mean_max_m_per_s": ("mean speed, largest [m/s]", 1, 1),
    "centroid_travel_m": ("way of the centre [m]", 1, 0),
    "front_travel_m": ("way of the front [m]", 1, 0),
    "travel_angle_deg": ("travel angle [°]", 1, 1),
    "deposit_thickness_ground_m": ("deposit beyond the foot [m]", 1, 0),
    "mixing": ("mixing [%]", 100, 1),
}


#: The same of times.
TIMES = {f"since_t0_s.t{k}": (f"t{k} [s]", 1, 1) for k in range(1, 6)} | {
    "water_halved_s": ("water halved after t2 [s]", 1, 1),
    "triggering_s": ("t3 - t2 [s]", 1, 1),
}
CHANGES = {name: SHOWN[name] for name in ("centroid_travel_m", "front_travel_m", "speed_mean_max_m_per_s")}


def changes(rows):
    """What each variant changes of the shipped slope, as :func:`rows` has it: the rows of the variants with the
    differences of ``numbers`` from those of the shipped slope of the same packing. None of them without that slope.
    """
    shipped = next((row for row in rows if row["name"] == SHIPPED), None)
    made = []
    for row in rows:
        if shipped is None or row is shipped:
            continue
        numbers = {}
        for key in (key for key in row["numbers"] if key in shipped["numbers"]):
            pairs = zip(row["numbers"][key]["values"], shipped["numbers"][key]["values"], strict=True)
            values = [None if None in pair else float(pair[0]) - float(pair[1]) for pair in pairs]
            there = [value for value in values if value is not None]
            if there:
                numbers[key] = over_seeds(there) | {"values": values, "of": len(there)}
        made.append(row | {"numbers": numbers})
    return made


def table(rows, shown=SHOWN):
    """(heads, lines) of texts for what :func:`rows` returned, a line for each variant; a mean of fewer than all slopes
    has their number behind it. ``shown``: SHOWN, TIMES or CHANGES.
    """
    lines = []
    for row in rows:
        count = sum(row["verdicts"].values())
        kinds = ", ".join(f"{number} {kind}" for kind, number in row["verdicts"].items())
        cells = []
        for name, (_, factor, digits) in shown.items():
            found = row["numbers"].get(name)
            text = "–" if found is None else told(found["mean"], found["half_width"], digits, factor)
            cells.append(text if found is None or found["of"] == count else f"{text} ({found['of']})")
        lines.append([row["label"], kinds, *cells])
    return ["slope", "what became of it", *(head for head, _, _ in shown.values())], lines
