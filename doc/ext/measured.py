"""Numbers and tables of documentation pages, from files that commands wrote and that are kept as
doc/measured/NAME.json.

``:measured:`NAME KEY[/KEY][*FACTOR] FORMAT``` is one number: KEY of the file (a dot goes into a dictionary, or to an item of a list by its number), over another one and times FACTOR if these are given, as
Python's FORMAT writes it. Names that have dots themselves, as those of a sweep's means, are found too. A mean over
seeds, a dictionary with ``mean`` and ``half_width``, is written with its interval, as 1.2 ± 0.3.
``.. measured-tables:: NAME`` shows the tables of a check's result.json (scripts/verify.py), or those whose title begins
with the directive's text. A file or key that is not there is an error of the build: a page must not show what nobody
measured.
"""
import json
import pathlib

from docutils import nodes
from docutils.parsers.rst import Directive

import rst

HOME = pathlib.Path(__file__).resolve().parents[1] / "measured"


def load(name, env):
    env.note_dependency(str(HOME / f"{name}.json"))
    return json.loads((HOME / f"{name}.json").read_text())


def at(name, key, env):
    """The file's value at a key."""
    value, parts = load(name, env), key.split(".")
    while parts:
        taken = 1
        if isinstance(value, dict):
            taken = next((n for n in range(len(parts), 1, -1) if ".".join(parts[:n]) in value), 1)
        part, parts = ".".join(parts[:taken]), parts[taken:]
        value = value[int(part) if isinstance(value, list) else part]
    return value


def written(value, form):
    """As Python's ``form`` has it; what rounds to nothing has no sign."""
    text = format(value, form)
    return text.lstrip("-") if not text.strip("-0.,") else text


def number(text, env):
    """What the role's text stands for. Raises ValueError that says what is wrong."""
    try:
        name, key, form = text.split()
    except ValueError:
        raise ValueError(f"{text!r}: give NAME KEY FORMAT") from None
    key, _, factor = key.partition("*")
    try:
        upper, _, lower = key.partition("/")
        value, unit = at(name, upper, env), float(factor or 1) / (at(name, lower, env) if lower else 1)
        if not isinstance(value, dict):
            return written(value * unit, form)
        half = "" if value["half_width"] is None else f" ± {format(value['half_width'] * unit, form)}"
        return written(value["mean"] * unit, form) + half
    except (OSError, LookupError, TypeError, ValueError, ZeroDivisionError) as error:
        raise ValueError(f"{text!r}: {type(error).__name__} {error}") from None


def role(kind, raw, text, line, inliner, options={}, content=[]):  # noqa: B006 (docutils' signature)
    try:
        return [nodes.Text(number(text, inliner.document.settings.env).replace("-", "\u2212"))], []
    except ValueError as error:
        message = inliner.reporter.error(f"measured: {error}", line=line)
        return [inliner.problematic(raw, raw, message)], [message]


class Tables(Directive):
    required_arguments = 1
    has_content = True

    def run(self):
        env, begins = self.state.document.settings.env, "\n".join(self.content)
        chosen = [table for table in load(self.arguments[0], env)["tables"] if table[0].startswith(begins)]
        if not chosen:
            raise self.error(f"{self.arguments[0]}: no table begins with {begins!r}")
        found = []
        for title, header, rows in chosen:
            found.append(nodes.rubric(text=title))
            found += rst.parse(self, rst.table(header, rows, [40] + [20] * (len(header) - 1)), env.docname)
        return found


def setup(app):
    app.add_role("measured", role)
    app.add_directive("measured-tables", Tables)
    return {"parallel_read_safe": True}
