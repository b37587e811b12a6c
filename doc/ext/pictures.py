"""``.. picture:: NAME`` shows doc/figures/NAME with the directive's text as caption; without the file only the caption is there.

Figures are made by runs of many minutes, so a checkout may not have them all.
"""
import pathlib

from docutils import nodes
from docutils.parsers.rst import Directive, directives

import rst

FIGURES = pathlib.Path(__file__).resolve().parents[1] / "figures"


class Picture(Directive):
    required_arguments = 1
    has_content = True
    option_spec = {"alt": directives.unchanged_required}

    def run(self):
        name = self.arguments[0]
        env = self.state.document.settings.env
        env.note_dependency(str(FIGURES / name))
        caption = "\n".join(self.content)
        if not (FIGURES / name).is_file():
            node = nodes.paragraph(text=f"{name} has not been made in this copy yet. ", classes=["missing"])
            return [node, *rst.parse(self, caption.split("\n"), env.docname)]
        lines = [f".. figure:: /figures/{name}", f"   :alt: {self.options.get('alt', name)}", ""]
        lines += ["   " + line for line in caption.split("\n")]
        return rst.parse(self, lines, env.docname)


def setup(app):
    app.add_directive("picture", Picture)
    return {"parallel_read_safe": True}
