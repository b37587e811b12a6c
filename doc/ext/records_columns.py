"""``.. records-columns::`` a table of the columns of series.csv, from yade.nonsmooth.records."""
from docutils.parsers.rst import Directive

import rst


class Columns(Directive):
    def run(self):
        from yade.nonsmooth import records

        table = [(f"``{name}``", "" if c.unit == "1" else c.unit, c.description) for name, c in records.COLUMNS.items()]
        return rst.parse(self, rst.table(("column", "unit", "meaning"), table, (36, 10, 54)), "records.COLUMNS")


def setup(app):
    app.add_directive("records-columns", Columns)
    return {"parallel_read_safe": True}
