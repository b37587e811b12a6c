"""``.. picture:: NAME.png`` shows doc/figures/NAME.png with the directive's text as caption; without the file only the
caption is there.

Where there are ``NAME-1.png``, ``NAME-2.png`` … instead, they are panels of one picture: beside each other where the
page is wide enough, and one below the other on a narrow one, or where they are wide themselves. Wide pictures of one
file keep a readable width on narrow pages, which are moved sideways.

Figures are made by runs of many minutes, so a checkout may not have them all.
"""
import pathlib
import struct

from docutils import nodes
from docutils.parsers.rst import Directive, directives

import rst

FIGURES = pathlib.Path(__file__).resolve().parents[1] / "figures"
WIDE = 1.5  # width over height from which two panels stand below each other, and one picture is moved sideways


def shape(path):
    """Width over height of a PNG."""
    width, height = struct.unpack(">II", path.read_bytes()[16:24])
    return width / height


def files(name):
    """Those that show a picture: itself, or its panels in order; an empty list where there is none."""
    path = FIGURES / name
    if path.is_file():
        return [path]
    return sorted(FIGURES.glob(f"{path.stem}-[0-9]{path.suffix}"))


class Picture(Directive):
    required_arguments = 1
    has_content = True
    option_spec = {"alt": directives.unchanged_required}

    def run(self):
        name = self.arguments[0]
        env = self.state.document.settings.env
        env.note_dependency(str(FIGURES / name))
        found, caption, alt = files(name), list(self.content), self.options.get("alt", name)
        if not found:
            node = nodes.paragraph(text=f"{name} has not been made in this copy yet. ", classes=["missing"])
            return [node, *rst.parse(self, caption, env.docname)]
        wide = max(map(shape, found)) > WIDE
        if len(found) == 1:
            lines = [f".. figure:: /figures/{name}", f"   :alt: {alt}"] + ["   :figclass: wide"] * wide + [""]
            return rst.parse(self, lines + ["   " + line for line in caption], env.docname)
        lines = [f".. container:: panels{' wide' * wide}", ""]
        for k, path in enumerate(found, start=1):
            env.note_dependency(str(path))
            lines += [f"   .. image:: /figures/{path.name}", f"      :alt: {alt} ({k} of {len(found)})", ""]
        lines += [".. rst-class:: caption", "", *caption]
        return rst.parse(self, lines, env.docname)


def setup(app):
    app.add_directive("picture", Picture)
    return {"parallel_read_safe": True}
