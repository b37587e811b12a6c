"""The figures of a search for the factor of safety, drawn from its records. Needs no YADE."""

from __future__ import annotations

from pathlib import Path

from ... import records
from ...figures import safety
from . import results

__all__ = ["FIGURES", "draw", "figure"]

FIGURES = ("displacements", "failing_mass")


def figure(folder, section, summary, name, path=None):
    """One of :data:`FIGURES` of the search in ``folder``, of a Section, with its ``summary``; None where it has not
    come to what it shows. ``path``: where it is written, None: returned.
    """
    folder = Path(folder)
    if not any("displacement_mean_m" in one for one in summary["trials"]):
        return None
    if name == "displacements":
        return safety.displacements(summary["trials"], (summary["factor_low"], summary["factor_high"]), path)
    if summary["failing_area_m2"] is None:
        return None
    before, after = (records.read_snapshot(folder / one) for one in (results.BEFORE, results.FAILED))
    failed = min(one["factor"] for one in summary["trials"] if one["trial"] > 0 and one["verdict"] == "failed")
    title = f"{section.name}: fails with strengths divided by {failed:.3f}"
    return safety.failing_mass_on_section(before, after, section, title, path)


def draw(folder, section, summary) -> list:
    """Draws all that the records allow into the folder; returns the paths."""
    made = [figure(folder, section, summary, name, Path(folder) / f"{name}.png") for name in FIGURES]
    return [path for path in made if path is not None]
