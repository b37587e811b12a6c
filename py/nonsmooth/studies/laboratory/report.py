"""What a campaign of biaxial tests shows: a table, figures, and files for ParaView."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ... import records
from ...errors import UserError
from ...figures import biaxial as figures, cycle as cycle_figure, film, paraview
from ...measure import cycles
from ...measure.statistics import told
from ...system import checks
from ...system.whole_files import whole
from . import biaxial_test
from .campaign import name_of_result

__all__ = ["BY_PRESSURE", "draw", "pressures", "table"]


def _of_a_campaign(names):
    """A decorator: the function asks for the ``summary`` of a campaign of one test or more, which has these names,
    words in a text.
    """
    remedy = "give the summary of a campaign of biaxial tests, of one or more, as scripts/biaxial.py keeps it in summary.json"
    there, _ = checks.holds(names, remedy)
    return checks.takes(UserError, summary=(lambda v: there(v) and all(len(v[name]) for name in names.split()), remedy))


@_of_a_campaign("tests")
def table(summary):
    """Rows of text: one a test, then the envelopes."""
    lines = [
        " σ₃ [MPa]  seed   σ₁ peak  at ε₁ [%]   residual   ψ [°]   bands [d] at 1 %, 4 %     I        platens differ"
    ]
    for t in summary["tests"]:
        widths = "  ".join(
            ", ".join("-" if b is None else f"{b['width_d']:.1f}" for b in t[key]) for key in ("bands", "bands_late")
        )
        lines.append(
            f"{t['confining_Pa'] / 1e6:9.3g} {t['seed']:5d} {t['sigma1_peak_Pa'] / 1e6:9.3f} {100 * t['strain_peak']:10.2f} {t['sigma1_residual_Pa'] / 1e6:10.3f} "
            f"{'-' if t['dilatancy_deg'] is None else format(t['dilatancy_deg'], '.1f'):>7s}   {widths:23s} {t['inertial_number']:8.1e} {100 * t['platen_difference_rel']:8.2f} %"
        )
    for kind in ("peak", "residual"):
        if summary.get(f"cohesion_{kind}_kPa") is not None:
            dc, df = summary[f"cohesion_{kind}_95_kPa"], summary[f"friction_{kind}_95_deg"]
            lines.append(
                f"{kind:9s} cohesion {summary[f'cohesion_{kind}_kPa']:6.1f}{'' if dc is None else f' ± {dc:.1f}'} kPa, "
                f"friction {summary[f'friction_{kind}_deg']:5.2f}{'' if df is None else f' ± {df:.2f}'}°"
            )
    return "\n".join(lines + [summary["note"]] if "note" in summary else lines)


#: {number of campaign.by_pressure: (its head in a table, its factor, digits)}.
BY_PRESSURE = {
    "peak_deg": ("peak φ [°]", 1, 1),
    "strain_peak": ("at strain [%]", 100, 2),
    "later_share": ("largest at 0.5 to 2 %, of the peak [%]", 100, 0),
    "residual_deg": ("plateau φ [°]", 1, 1),
    "dilatancy_deg": ("ψ [°]", 1, 0),
    "band_width_d": ("bands at 1 % [d]", 1, 1),
    "band_width_late_d": ("at 4 % [d]", 1, 1),
    "bands_conjugate": ("two conjugate ones at 1 % [% of samples]", 100, 0),
    "antithetic": ("antithetic [%]", 100, 0),
    "stress_fluctuation_rel": ("σ₁ fluctuates by [%]", 100, 1),
    "contraction_with_drop": ("contractions with a stress drop [%]", 100, 0),
}


@_of_a_campaign("by_pressure")
def pressures(summary):
    """(heads, lines) of texts: what was measured under each pressure, mean over seeds and half of its 95 % interval."""

    return ["σ₃ [MPa]", *(head for head, _, _ in BY_PRESSURE.values())], [
        [
            f"{row['confining_Pa'] / 1e6:g}",
            *(
                told(row[name]["mean"], row[name]["half_width"], digits, f)
                for name, (_, f, digits) in BY_PRESSURE.items()
            ),
        ]
        for row in summary["by_pressure"]
    ]


@_of_a_campaign("tests seeds")
def draw(out, summary):
    """Figures and ParaView files of a campaign in ``out``; returns the figures' paths."""
    out, made = Path(checks.path("out", out, UserError, "give the path of the folder of the campaign")), []
    first = [t for t in summary["tests"] if t["seed"] == summary["seeds"][0]]
    curves = [
        (t["confining_Pa"], records.read_series(out / "tests" / name_of_result(t) / "series.csv"), t) for t in first
    ]
    made.append(figures.stress_strain(curves, out / "stress_strain.png"))
    made.append(figures.stress(curves, out / "stress.png"))
    if "cohesion_peak_kPa" in summary:
        made.append(figures.mohr(summary, out / "mohr.png"))
    shown = min(first, key=lambda t: abs(t["confining_Pa"] - 8e6))  # the paper's Figure 9 is at 8 MPa
    made += _cycle(shown, out)
    for t in summary["tests"]:
        home = out / "tests" / name_of_result(t)
        frames = {path.stem: records.read_snapshot(path) for path in whole(home / "snapshots", "*.npz")}
        _paraview(frames, home / "vtk")
        if t is shown:
            made += _pictures(t, frames, out)
            shots = whole(home / "frames", "*.npz")
            if shots and not film.missing():
                made.append(figures.film(shots, f"σ₃ = {t['confining_Pa'] / 1e6:g} MPa", out / "biaxial.mp4"))
    return made


def _pictures(test, frames, out):
    """The sample by rotation, and its forces: from snapshots by name."""
    order = [name for name in ("1", "2", "4", "end") if name in frames]

    def title(name):
        return f"{'end' if name == 'end' else f'ε₁ = {name} %'}, σ₃ = {test['confining_Pa'] / 1e6:g} MPa"

    # a test that ends before the first of these strains has one state
    panels = [(title(name), frames[name]) for name in dict.fromkeys((order[0], order[-1]))]
    return [
        figures.rotations(frames["begin"], panels, out / "bands.png"),
        figures.chains(frames[order[0]], panels[0][0], out / "force_chains.png"),
    ]


def _cycle(test, out):
    """The deepest cycle of stress whose forces a test has kept; nothing where it has kept none."""
    home = out / "tests" / name_of_result(test)
    shots = {path.stem: records.read_snapshot(path) for path in whole(home / biaxial_test.CYCLE, "*.npz")}
    if not shots:
        return []
    series = records.read_series(home / "series.csv")
    rows = cycles.Cycle(*(int(np.flatnonzero(series["step"] == shots[name].step)[0]) for name in biaxial_test.PHASES))
    words = f"σ₃ = {test['confining_Pa'] / 1e6:g} MPa, {test['disks']:,} disks"
    return [cycle_figure.cycle(series, rows, shots["peak"], shots["end"], words, out / "cycle.png")]


def _paraview(frames, folder):
    entries = []
    for name, s in frames.items():
        entries.append((s.time_s, paraview.write_disks(s, folder / f"disks-{name}.vtu")))
        paraview.write_contacts(s, folder / f"contacts-{name}.vtu")
    paraview.write_collection(sorted(entries), folder / "biaxial.pvd")
