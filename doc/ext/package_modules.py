"""Reference of the modules of yade.nonsmooth, from their docstrings; names starting with _ stay out.

``.. package-modules:: NAME ...``     these modules, in this order, under titles of the third level
``.. other-package-modules:: PAGE``   all modules that the page PAGE does not name so, by the alphabet, under titles of the second
"""
import importlib
import pathlib
import pkgutil
import re

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList

PREFIX = "yade.nonsmooth."


def modules():
    import yade.nonsmooth

    names = [m.name for m in pkgutil.walk_packages(yade.nonsmooth.__path__, PREFIX)]
    return sorted({_shown(n) for n in names if not any(part.startswith("_") for part in n.split("."))})


def _shown(name):
    """The name by which scripts import a module, where the package's face has one."""
    import yade.nonsmooth

    for short, place in sorted(yade.nonsmooth.FACE.items(), key=lambda item: -len(item[1])):
        if f"{name}.".startswith(f"{PREFIX}{place}."):
            return PREFIX + short + name[len(PREFIX + place) :]
    return name


def document(directive, names, underline):
    """Nodes with a section for each of the modules (names without the package's)."""
    lines = []
    for short in names:
        name = PREFIX + short
        module = importlib.import_module(name)
        # what a module takes from another is documented there
        elsewhere = [
            n
            for n in getattr(module, "__all__", ())
            if getattr(getattr(module, n, None), "__module__", module.__name__) != module.__name__
        ]
        lines += [short, underline * len(short), "", f".. automodule:: {name}", "   :members:"]
        if elsewhere:
            lines.append(f"   :exclude-members: {', '.join(elsewhere)}")
        lines.append("")
    node = nodes.section()
    node.document = directive.state.document
    directive.state.nested_parse(StringList(lines, source="package-modules"), 0, node, match_titles=1)
    return node.children


class PackageModules(Directive):
    required_arguments = 1
    final_argument_whitespace = True

    def run(self):
        names = self.arguments[0].split()
        unknown = sorted({PREFIX + n for n in names} - set(modules()))
        if unknown:
            raise self.error(f"the package has no module {', '.join(unknown)}")
        return document(self, names, "~")


class OtherPackageModules(Directive):
    required_arguments = 1

    def run(self):
        env = self.state.document.settings.env
        page = pathlib.Path(env.doc2path(self.arguments[0]))
        env.note_dependency(str(page))
        named = re.findall(r"^\.\. package-modules:: (.+)$", page.read_text(encoding="utf-8"), re.M)
        shown = {PREFIX + n for line in named for n in line.split()}
        return document(self, [n.removeprefix(PREFIX) for n in modules() if n not in shown], "-")


def setup(app):
    app.add_directive("package-modules", PackageModules)
    app.add_directive("other-package-modules", OtherPackageModules)
    return {"parallel_read_safe": True}
