"""``.. package-modules::`` documents every module of yade.nonsmooth that is there; names starting with _ stay out."""
import importlib
import pkgutil

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList


def modules():
    import yade.nonsmooth

    names = [m.name for m in pkgutil.walk_packages(yade.nonsmooth.__path__, "yade.nonsmooth.")]
    return [n for n in sorted(names) if not any(part.startswith("_") for part in n.split("."))]


class PackageModules(Directive):
    def run(self):
        lines = []
        for name in modules():
            module = importlib.import_module(name)
            title = name.removeprefix("yade.")
            # what a module takes from another is documented there
            elsewhere = [
                n
                for n in getattr(module, "__all__", ())
                if getattr(getattr(module, n, None), "__module__", name) != name
            ]
            lines += [title, "-" * len(title), "", f".. automodule:: {name}", "   :members:"]
            if elsewhere:
                lines.append(f"   :exclude-members: {', '.join(elsewhere)}")
            lines.append("")
        node = nodes.section()
        node.document = self.state.document
        self.state.nested_parse(StringList(lines, source="package-modules"), 0, node, match_titles=1)
        return node.children


def setup(app):
    app.add_directive("package-modules", PackageModules)
    return {"parallel_read_safe": True}
