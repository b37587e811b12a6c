"""The report of a verification as one HTML page."""

from __future__ import annotations

import base64
import datetime
import platform
from pathlib import Path

import docutils.core
import jinja2

from ..whole_files import write_atomically

__all__ = ["write_report"]


def write_report(path, results, *, quick, versions):
    """Writes the page with all plots in it; ``results``: :class:`~.runner.Result`; ``versions``: {name: version} of what took part."""
    path = Path(path)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(figure=_figure, allowed=_allowed, image=lambda name: _image(path.parent / name), prose=_prose)
    subjects = {}
    for result in results:
        subjects.setdefault(result.check.subject, []).append(result)
    page = environment.get_template("report.html.j2").render(
        subjects=subjects, results=results, quick=quick, versions=versions, machine=f"{platform.machine()}, {platform.system()}",
        date=datetime.date.today().isoformat(), claims=sum(len(r.claims) for r in results),
        failed=sum(not c.passed for r in results for c in r.claims) + sum(bool(r.error) for r in results))
    write_atomically(path, page.encode())
    return path


def _figure(value, unit=""):
    return f"{value:.6g} {unit}".rstrip()


def _allowed(claim):
    """The bounds in words."""
    unit = f" {claim.unit}" if claim.unit else ""
    if claim.expected is not None:
        below, above = claim.expected - claim.low, claim.high - claim.expected
        if abs(below - above) <= 1e-9 * max(abs(below), abs(above)):
            return f"{claim.expected:.6g} ± {above:.2g}{unit}"
    if claim.high == float("inf"):
        return f"at least {claim.low:.6g}{unit}"
    if claim.low == 0:
        return f"at most {claim.high:.6g}{unit}"
    return f"{claim.low:.6g} to {claim.high:.6g}{unit}"


def _image(path):
    return "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode()


def _prose(text):
    """A docstring's reStructuredText as HTML."""
    parts = docutils.core.publish_parts(text, writer_name="html5", settings_overrides={"report_level": 4, "initial_header_level": 4})
    return jinja2.utils.markupsafe.Markup(parts["fragment"])
