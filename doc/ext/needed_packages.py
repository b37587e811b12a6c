"""``.. needed-packages::`` a table of what a plain Python needs, from the package's list
(py/nonsmooth/system/requirements.txt).
"""
from docutils.parsers.rst import Directive

import rst


class Packages(Directive):
    def run(self):
        from yade.nonsmooth.system import requirements

        table = [(f"``{one.pip}``", f"``{one.debian}``", one.use) for one in requirements.listed()]
        return rst.parse(self, rst.table(("pip", "Debian", "for"), table, (18, 30, 52)), "requirements.txt")


def setup(app):
    app.add_directive("needed-packages", Packages)
    return {"parallel_read_safe": True}
