"""What the measurements in space say: the headline figures of ``benchmark.json`` that begin with ``space``, and tables of
text.
"""

from __future__ import annotations

from tabulate import tabulate

from . import sphere_bed
from .report import number, step_rows, with_quartiles

__all__ = ["HEADLINES", "summarise", "table"]

#: Headline figures and what each is; medians, but means where shares of a step are compared. Steps are those of the bed
#: with as many threads as were asked for; E is that of the soft contacts.
HEADLINES = {
    "space_sweep_ns_per_contact": "a sweep in space, for each contact, one thread [ns]",
    "space_sweep_over_plane": "the same, over a sweep in the plane",
    "space_sweep_speedup_over_scalar": "a sweep in space by the law's formulas, contact after contact, over it",
    "space_sweep_speedup_two_threads": "a sweep in space on one thread, over two",
    "space_cold_sweeps_to_1e-4": "sweeps from zero to a residual of 1e-4, {layers} layers of spheres",
    "space_step_ms": "a step at rest [ms]",
    "space_step_ms_moving": "a step on the move [ms]",
    "space_soft_step_ms": "a soft step at rest, E = 1 GPa [ms]",
    "space_soft_step_ms_moving": "a soft step on the move, E = 1 GPa [ms]",
    "space_step_over_soft_step": "the one over the other at rest",
    "space_step_over_soft_step_moving": "the same on the move",
    "space_second_over_soft": "the same for a second of simulation, at rest",
    "space_second_over_soft_moving": "the same on the move",
    "space_second_over_soft_10GPa": "the same over E = 10 GPa, at rest",
    "space_second_over_soft_10GPa_moving": "the same on the move",
    "space_outside_sweeps_over_sweeps": "of a step at rest, all but its sweeps, over these",
    "space_outside_sweeps_over_sweeps_moving": "the same on the move",
    "space_outside_solve_over_solve": "of a step at rest, all but the solve and the correction, over these two",
    "space_outside_solve_over_solve_moving": "the same on the move",
    "space_sweeps_mean": "sweeps of a step at rest, mean",
    "space_sweeps_mean_moving": "the same on the move",
    "space_bytes_per_contact": "memory for each contact of the largest bed [byte]",
}
_SUFFIX = {"rest": "", "moving": "_moving"}
_SOFT, _STIFF = sphere_bed.YOUNGS


def _outside(measured, inside):
    """Of a step, what is not ``inside``, over it; both means [ms]."""
    return (measured["step_ms"]["mean"] - inside) / inside


def summarise(found) -> dict:
    """Headline figures, {name: number}, and beside them as "space" what space_suite.run ``found``, with the quartiles of
    those figures that have them. Without sizes there is no figure of memory.
    """
    steps = {m["state"]: m for m in found["steps"] if m["threads"] == found["threads"]}
    sweeps, ratios = found["sweeps"], found["ratios"][str(found["threads"])]
    spreads = {
        "space_sweep_ns_per_contact": sweeps["ns_per_contact"]["best"],
        "space_sweep_over_plane": sweeps["over_plane"],
        "space_sweep_speedup_over_scalar": sweeps["speedup_over_reference"]["best"],
        "space_sweep_speedup_two_threads": sweeps["speedup_two_threads"],
    }
    plain = {"space_cold_sweeps_to_1e-4": sweeps["cold_sweeps"]}
    for name, end in _SUFFIX.items():
        hard, soft = steps[name], sphere_bed.softened(name, _SOFT)
        solve = hard["stage_ms"]["solve"]["mean"] + hard["stage_ms"]["correct"]["mean"]
        spreads |= {
            f"space_step_ms{end}": hard["step_ms"],
            f"space_soft_step_ms{end}": steps[soft]["step_ms"],
            f"space_step_over_soft_step{end}": ratios[f"step_over_{soft}"],
            f"space_second_over_soft{end}": ratios[f"second_over_{soft}"],
            f"space_second_over_soft_10GPa{end}": ratios[f"second_over_{sphere_bed.softened(name, _STIFF)}"],
        }
        plain |= {
            f"space_outside_sweeps_over_sweeps{end}": _outside(hard, hard["sweeps_ms"]["mean"]),
            f"space_outside_solve_over_solve{end}": _outside(hard, solve),
            f"space_sweeps_mean{end}": hard["sweeps_mean"],
        }
    if found["sizes"]:
        plain["space_bytes_per_contact"] = found["sizes"][-1]["bytes_per_contact"]
    told = {name: s["median"] for name, s in spreads.items()} | plain
    quartiles = {name: s["quartiles"] for name, s in spreads.items()}
    return {**{name: told[name] for name in HEADLINES if name in told}, "space": {"quartiles": quartiles, **found}}


def table(summary) -> str:
    """Tables of text of what :func:`summarise` says: headlines, sweeps by path, steps by stage, sizes."""
    found = summary["space"]
    sweeps = found["sweeps"]
    rows = [
        (
            what.format(layers=sweeps["layers"]),
            number(summary[name]),
            " … ".join(map(number, found["quartiles"].get(name, ()))),
        )
        for name, what in HEADLINES.items()
        if name in summary
    ]
    over = sweeps["speedup_over_reference"]
    paths = [
        (name.replace("_", " "), with_quartiles(s), with_quartiles(over[name]) if name in over else "-")
        for name, s in sweeps["ns_per_contact"].items()
    ]
    parts = [
        tabulate(rows, ("", "", "quartiles"), disable_numparse=True),
        tabulate(paths, ("sweep", "ns a contact", "over reference"), disable_numparse=True),
        f"{sweeps['spheres']} spheres, {sweeps['contacts']} contacts of {sweeps['bytes_per_contact']:.0f} bytes; "
        f"{sweeps['contacts_plane']} in the plane; the cold start carries {sweeps['share_of_weight']:.3f} of the weight",
        *(_steps_table(found, threads) for threads in sorted({m["threads"] for m in found["steps"]})),
    ]
    if found["sizes"]:
        parts.append(_size_table(found))
    return "\n\n".join(parts)


def _steps_table(found, threads):
    steps = [m for m in found["steps"] if m["threads"] == threads]
    rows = [("step", *(with_quartiles(m["step_ms"]) for m in steps))]
    rows.append(("sweeps alone", *(with_quartiles(m["sweeps_ms"]) if "sweeps_ms" in m else "-" for m in steps)))
    solve = "solve_without_sweeps_ms"
    rows.append(("the solve without them, mean", *(number(m[solve]) if solve in m else "-" for m in steps)))
    rows += step_rows(steps)
    rows.append(("time step [s]", *(number(m["time_step_s"]) for m in steps)))
    heads = (f"[ms], {threads} thr., {found['bed']['spheres']} spheres", *(m["state"].replace("_", " ") for m in steps))
    return tabulate(rows, heads, disable_numparse=True)


def _size_table(found):
    threads = str(found["threads"])
    rows = [
        (
            str(s["spheres"]),
            str(s["candidates"]),
            f"{s['building_s']:.0f}",
            f"{s['steps']} steps in {s['stepping_s']:.0f}",
            with_quartiles(s["step_ms"]),
            number(s["sweeps_mean"]),
            with_quartiles(s["sweep_ns_per_contact"]["1"]),
            with_quartiles(s["sweep_ns_per_contact"][threads]),
            f"{1e-3 * s['bytes_per_contact']:.2f}",
            f"{1e-3 * s['bytes_per_contact_without_bodies']:.2f}",
            f"{1e-3 * s['bytes_per_sphere']:.2f}",
        )
        for s in found["sizes"]
    ]
    heads = (
        "spheres",
        "candidates",
        "building [s]",
        "stepping [s]",
        "step [ms]",
        "sweeps",
        "ns a contact and sweep",
        f"{threads} threads",
        "kB a contact",
        "without bodies",
        "kB a sphere",
    )
    return tabulate(rows, heads, disable_numparse=True)
