"""``.. records-columns:: studies.heaps.columns`` a table of the columns of a series, from their declaration ``COLUMNS``
in a module of yade.nonsmooth, or of another ``NAME`` as a second argument.
"""
import importlib

from docutils.parsers.rst import Directive

import rst


class Columns(Directive):
    required_arguments, optional_arguments = 1, 1

    def run(self):
        module, name = (*self.arguments, "COLUMNS")[:2]
        columns = getattr(importlib.import_module(f"yade.nonsmooth.{module}"), name).values()
        table = [(f"``{c.name}``", "" if c.unit in ("1", "-") else c.unit, c.meaning) for c in columns]
        return rst.parse(self, rst.table(("column", "unit", "meaning"), table, (36, 10, 54)), f"{module}.{name}")


def setup(app):
    app.add_directive("records-columns", Columns)
    return {"parallel_read_safe": True}
