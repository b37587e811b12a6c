"""Fills a page's template, which extends ``page.html.j2`` and takes its tables and figures from ``parts.html.j2``.
Needs no YADE.
"""

from __future__ import annotations

import base64
import datetime
from pathlib import Path

import docutils.core
import jinja2

from ..system.whole_files import write_atomically

__all__ = ["write"]


def write(path, template, filters=None, **values) -> Path:
    """Writes the page: ``template``: the Path of its own template; ``filters``: {name: function} and ``values`` that it
    takes besides. A template has the filters ``image`` (a PNG's path, from the page's folder or absolute, as data) and
    ``prose`` (reStructuredText as HTML), and the value ``date``.

    Returns the path. Raises WriteError.
    """
    path, template = Path(path), Path(template)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([template.parent, Path(__file__).parent]),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"image": lambda name: _image(path.parent / name), "prose": _prose} | (filters or {})
    page = environment.get_template(template.name).render(date=datetime.date.today().isoformat(), **values)
    write_atomically(path, page.encode())
    return path


def _image(path):
    return "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode()


def _prose(text):
    """A docstring's reStructuredText as HTML."""
    parts = docutils.core.publish_parts(
        text, writer_name="html5", settings_overrides={"report_level": 4, "initial_header_level": 4}
    )
    return jinja2.utils.markupsafe.Markup(parts["fragment"])
