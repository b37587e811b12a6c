"""Reading generated reStructuredText into a directive's place."""
from docutils import nodes
from docutils.statemachine import StringList


def parse(directive, lines, source):
    """Nodes of ``lines`` (reStructuredText); ``source`` is what messages name."""
    node = nodes.Element()
    node.document = directive.state.document
    directive.state.nested_parse(StringList(list(lines), source=source), 0, node)
    return node.children


def table(header, rows, widths):
    """Lines of a list-table. Cells are text; line breaks in them stay."""
    lines = [".. list-table::", "   :header-rows: 1", "   :widths: " + " ".join(map(str, widths)), ""]
    for row in (header, *rows):
        for k, cell in enumerate(row):
            first, *rest = (str(cell) or " ").split("\n")
            lines.append(("   * - " if k == 0 else "     - ") + first)
            lines += ["       " + line if line else "" for line in rest]
    return [*lines, ""]
