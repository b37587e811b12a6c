"""``.. records-columns::`` a table of the columns of series.csv, and with the argument ``walls`` of walls.csv, from yade.nonsmooth.records."""
from docutils.parsers.rst import Directive

import rst


class Columns(Directive):
    optional_arguments = 1

    def run(self):
        from yade.nonsmooth import records

        columns = records.WALL_COLUMNS if self.arguments == ["walls"] else records.COLUMNS
        table = [(f"``{name}``", "" if c.unit in ("1", "-") else c.unit, c.description) for name, c in columns.items()]
        return rst.parse(self, rst.table(("column", "unit", "meaning"), table, (36, 10, 54)), "records.COLUMNS")


def setup(app):
    app.add_directive("records-columns", Columns)
    return {"parallel_read_safe": True}
