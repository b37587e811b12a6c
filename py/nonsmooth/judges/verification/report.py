"""The report of a verification as one HTML page."""

from __future__ import annotations

import platform
from pathlib import Path

from ... import report

__all__ = ["write_report"]

TEMPLATE = Path(__file__).with_name("report.html.j2")


def write_report(path, results, *, quick, versions):
    """Writes the page with all plots in it.

    ``results``: :class:`~.runner.CheckResult`; ``versions``: {name: version} of what took part.
    """
    subjects = {}
    for result in results:
        subjects.setdefault(result.check.subject, []).append(result)
    return report.write(
        path,
        TEMPLATE,
        {"figure": _figure, "allowed": _allowed},
        subjects=subjects,
        results=results,
        quick=quick,
        versions=versions,
        machine=f"{platform.machine()}, {platform.system()}",
        claims=sum(len(r.claims) for r in results),
        failed=sum(not c.passed for r in results for c in r.claims) + sum(bool(r.error) for r in results),
    )


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
