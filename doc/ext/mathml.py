"""Equations as MathML, which browsers show by themselves: pages need neither a network nor a TeX system."""
import html
import inspect
import re

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number

log = logging.getLogger(__name__)
# docutils 0.19 has `inline`, later ones `as_block`
_OLD = "inline" in inspect.signature(latex2mathml.tex2mathml).parameters


def _mathml(node, block):
    tex = node.astext()
    if re.search(r"frac\s*\d", tex):  # docutils reads the 12 of \frac12 as one number
        log.warning("this equation has a fraction without braces; write \\frac{1}{2}: %s", tex, location=node)
    try:
        return latex2mathml.tex2mathml(tex, **({"inline": not block} if _OLD else {"as_block": block}))
    except Exception as error:  # SyntaxError or MathError, as docutils has it
        log.warning("this equation cannot be shown: %s (%s)", tex, error, location=node)
        return html.escape(tex)


def inline(self, node):
    self.body.append(_mathml(node, block=False))
    raise nodes.SkipNode


def block(self, node):
    self.body.append(self.starttag(node, "div", CLASS="math notranslate"))
    if node["number"]:
        self.body.append('<span class="eqno">(%s)' % get_node_equation_number(self, node))
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append(_mathml(node, block=True) + "</div>\n")
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
