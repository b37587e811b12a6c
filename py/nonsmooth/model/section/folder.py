"""The section files that come with the package, and their schema."""

from __future__ import annotations

from pathlib import Path

__all__ = ["FOLDER", "SCHEMA", "shipped"]

FOLDER = Path(__file__).resolve().parents[2] / "sections"
SCHEMA = FOLDER / "section.schema.yaml"


def shipped() -> list[str]:
    """Names of the sections that come with the package."""
    return sorted(p.stem for p in FOLDER.glob("*.yaml") if not p.stem.endswith(".schema"))
