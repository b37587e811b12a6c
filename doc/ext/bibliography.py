"""Takes the citations of ``.. bibliography::`` out of the container that sphinxcontrib-bibtex puts them into: docutils'
writer closes the list of a container's first child without having opened it, and the theme's footer then stands beside
the page."""
from docutils import nodes


def unwrap(app, doctree, docname):
    for node in list(doctree.findall(nodes.container)):
        if node.children and all(isinstance(child, nodes.citation) for child in node.children):
            node.replace_self(node.children)


def setup(app):
    app.connect("doctree-resolved", unwrap)
    return {"parallel_read_safe": True}
