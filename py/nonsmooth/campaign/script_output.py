"""The run of a YADE script, opened from its folder: what the script has printed, its numbers and tables, and its scene
at the end. Needs no YADE.
"""

from __future__ import annotations

import re
from functools import cached_property

from ..studies import runs
from ..system import checks

__all__ = ["OUTPUT", "SCENE", "ScriptRun", "open_script"]

OUTPUT, SCENE = "output.txt", "scene.npz"  # what a script has printed; its scene at the end, see scene_arrays.save


class ScriptRun(runs.Opened):
    """A run of a script."""

    TABLES = ()

    @cached_property
    def output(self) -> str:
        """All that the script has printed."""
        return self._file(OUTPUT).read_text(encoding="utf-8")

    def number(self, key) -> float:
        """The number behind ``key`` at the begin of a line of the output. Raises RunError where there is none."""
        checks.text("key", key, runs.RunError, "give the words before the number, a text")
        found = re.search(rf"^{re.escape(key)} +(\S+)", self.output, re.M)
        try:
            return float(found.group(1))
        except (AttributeError, ValueError):
            raise runs.RunError(
                f"{self.folder}: the output has no line with {key!r} and a number behind it; run.output is all of it"
            ) from None

    def table(self, first=None) -> dict:
        """Columns of the table whose line of names begins with ``first``: {name: list of numbers, or of texts where a
        cell is none}. Two or more spaces part the names, or commas where there are no such spaces. None: the only
        table. Raises RunError where there is none, or where there are several to choose from; it says which there are.
        """
        found, lines = self._tables, self.output.splitlines()
        if first is None:
            if len(found) != 1:
                raise runs.RunError(f"{self.folder}: {self._which_tables('give the begin of its line of names')}")
            return next(iter(found.values()))
        checks.text("first", first, runs.RunError, "give the begin of a table's line of names, a text")
        for line in found:
            if line.startswith(first):
                return found[line]
        for at, line in enumerate(lines):  # a table of one column, which is found by its name alone
            rows = _rows(lines[at + 1 :], 1) if line.startswith(first) and len(_cells(line)) == 1 else ()
            if rows:
                return {line.strip(): [row[0] for row in rows]}
        raise runs.RunError(
            f"{self.folder}: no table of the output begins with {first!r}; {self._which_tables('give one of them')}"
        )

    def frame(self, first=None):
        """The same as a pandas.DataFrame. Raises RunError as :meth:`table`, and where pandas is not installed."""
        return self._as_frame(self.table(first), "take run.table()")

    @cached_property
    def _tables(self):
        """{line of names: columns}, in the order of the output."""
        found, lines = {}, self.output.splitlines()
        for at, line in enumerate(lines):
            names = _cells(line)
            if len(names) > 1 and not any(isinstance(_value(name), float) for name in names):
                rows = _rows(lines[at + 1 :], len(names))
                if rows:
                    found.setdefault(line, {name: [row[k] for row in rows] for k, name in enumerate(names)})
        return found

    def _which_tables(self, advice):
        known = [repr(_cells(line)[0]) for line in self._tables]
        if not known:
            return "the script has printed no table; run.number(...) finds single numbers, and run.output is all of it"
        return f"there {'is' if len(known) == 1 else 'are'} {', '.join(known)}; {advice}"

    def scene(self):
        """The scene at the end, a scene_arrays.Scene. Raises RunError where the script has left no disk in it."""
        from ..world import scene_arrays

        return scene_arrays.load(self._file(SCENE))

    def figure(self, name="scene", ax=None):
        """The ``scene`` at the end, as figures.draw draws it; ``ax``: axes to draw on, of a figure of one's own. Raises
        RunError for another name, and where there is none.
        """
        if name != "scene":
            raise runs.RunError(f"{self.folder}: no figure is called {name!r}; give scene")
        from .. import figures  # brings matplotlib, which a reader of numbers need not wait for

        return figures.draw(self.scene(), ax=ax)


def _cells(line):
    """The cells of a table's line: two or more spaces part them, or commas where there are no such spaces."""
    cells = re.split(r"\s{2,}", line.strip())
    return re.split(r",\s+", cells[0]) if len(cells) == 1 else cells


def _value(cell):
    """A cell as a number, or as it is."""
    try:
        return float(cell)
    except ValueError:
        return cell


def _rows(lines, width):
    """Rows of a table of ``width`` columns, as far as lines are rows: of so many numbers, or of so many cells among
    which are numbers.
    """
    rows = []
    for line in lines:
        for cells in (line.split(), _cells(line)):
            row = [_value(cell) for cell in cells]
            numbers = sum(isinstance(value, float) for value in row)
            if len(row) == width and numbers and (numbers == width or cells == _cells(line)):
                rows.append(row)
                break
        else:
            break
    return rows


def open_script(folder) -> ScriptRun:
    """The ScriptRun in a folder. Raises RunError where it is none."""
    run = ScriptRun(folder)
    if not (run.folder / OUTPUT).is_file():
        raise runs.RunError(f"{folder}: no script has run here; give the folder of one")
    return run
