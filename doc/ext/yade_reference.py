"""Reference of the plugin's classes, taken from the classes as YADE has loaded them.

``.. yade-class:: NAME ...``   doc, attributes and methods of each class
``.. yade-other-classes::``    the same for every class of pkg/dem that no page has named

YADE's docstrings use roles of its own: ``:yref:`` links to a class or attribute of this plugin (other names stay plain
text); ``:ydefault:``, ``:yattrtype:`` and ``:yattrflags:`` are read here and never shown.
"""
import importlib
import inspect
import pathlib
import re

from docutils.parsers.rst import Directive, roles
from sphinx.util import logging

import package_modules
import rst
import yade.wrapper

log = logging.getLogger(__name__)
SOURCES = pathlib.Path(__file__).resolve().parents[2] / "pkg" / "dem"
READONLY = 2
TYPES = {
    "Real": "float",
    "string": "str",
    "long": "int",
    "Body::id_t": "int",
    "vector<Real>": "list of float",
    "vector<int>": "list of int",
    "vector<Vector3r>": "list of Vector3",
    "Vector3r": "Vector3",
}
_MARK = re.compile(r":(ydefault|yattrtype|yattrflags):`(.*?)`", re.S)
_named = set()


def plugin_classes():
    """Names of the classes that pkg/dem registers."""
    names = []
    for path in sorted(SOURCES.glob("*.cpp")):
        for arguments in re.findall(r"YADE_PLUGIN\((.*?)\);", path.read_text(encoding="utf-8"), re.S):
            names += re.findall(r"\((\w+)\)", arguments)
    return names


def attributes(cls):
    """(name, text, type, flags) of a class's own attributes, in the order of the source, without deprecated ones."""
    found = []
    for name, value in cls.__dict__.items():
        if not isinstance(value, property) or name.startswith("_"):
            continue
        text = inspect.cleandoc(value.__doc__ or "")
        if text.startswith("|ydeprecated|"):
            continue
        marks = dict(_MARK.findall(text))
        kind = marks.get("yattrtype", "")
        shared = re.fullmatch(r"shared_ptr<(\w+)>", kind)
        # a property without marks was written by hand and can only be read
        flags = int(marks.get("yattrflags") or 0) if marks else READONLY
        found.append((name, _MARK.sub("", text).strip(), TYPES.get(kind, shared.group(1) if shared else kind), flags))
    return found


def methods(cls):
    """(signature, text) of a class's own methods that have a docstring."""
    found = []
    for name, value in cls.__dict__.items():
        static = isinstance(value, staticmethod)
        value = value.__func__ if static else value
        if name.startswith("_") or "function" not in type(value).__name__:
            continue
        heads = re.split(r"\n(?=%s\()" % re.escape(name), value.__doc__ or "")
        for head in heads:
            match = re.match(r"\s*%s\( ?(.*?)\) -> (\w+) ?:\n(.*)" % re.escape(name), head, re.S)
            if not match or not match.group(3).strip():
                continue
            arguments = re.findall(r"\((\w+)\)(\w+)", match.group(1))[0 if static else 1 :]
            result = "" if match.group(2) == "None" else f" -> {match.group(2)}"
            found.append((f"{name}({', '.join(a for _, a in arguments)}){result}", inspect.cleandoc(match.group(3))))
    return found


def label(name):
    return "yade-" + name.replace(".", "-").lower()


def value_of(instance, name):
    """A default as a script would write it."""
    value = getattr(instance, name)
    return f"``{value:g}``" if isinstance(value, float) else f"``{value!r}``"


def entry(name):
    """Lines of reStructuredText about one class."""
    cls = getattr(yade.wrapper, name)
    instance = cls()
    base = cls.__bases__[0]
    lines = [f".. _{label(name)}:", "", f".. py:class:: {name}({base.__name__})", "   :module:", ""]
    body = inspect.cleandoc(cls.__doc__).split("\n") + [""]
    inherited, parent = [], base
    while parent.__name__ not in ("Serializable", "object", "instance"):
        names = ", ".join(f"``{a}``" for a, *_ in attributes(parent))
        if names:
            inherited.append(f"{reference(parent.__name__)}: {names}")
        parent = parent.__bases__[0]
    if inherited:
        body += ["Inherited attributes: from " + "; from ".join(inherited) + ".", ""]
    own = attributes(cls)
    settable = [a for a in own if not a[3] & READONLY]
    readonly = [a for a in own if a[3] & READONLY]

    def cell(a):
        return f".. _{label(name + '.' + a[0])}:\n\n``{a[0]}``"

    if settable:
        body += [".. rubric:: Attributes", ""]
        body += rst.table(
            ("name", "type", "default", "meaning"),
            [(cell(a), a[2], value_of(instance, a[0]), a[1]) for a in settable],
            (24, 10, 12, 54),
        )
    if readonly:
        body += [".. rubric:: Results (read-only)", ""]
        body += rst.table(("name", "type", "meaning"), [(cell(a), a[2], a[1]) for a in readonly], (24, 12, 64))
    for signature, text in methods(cls):
        body += [f".. py:method:: {name}.{signature}", "   :module:", "", *("   " + t for t in text.split("\n")), ""]
    return lines + ["   " + t if t else "" for t in body]


class Classes(Directive):
    has_content = False
    required_arguments = 1
    final_argument_whitespace = True

    def run(self):
        result = []
        for name in self.arguments[0].split():
            if not hasattr(yade.wrapper, name):
                raise self.error(f"YADE has no class {name}: is the plugin loaded?")
            _named.add(name)
            result += rst.parse(self, entry(name), f"docstring of {name}")
        return result


class OtherClasses(Directive):
    """Stands last on the page that names all the others."""

    def run(self):
        result = []
        for name in plugin_classes():
            if name not in _named:
                _named.add(name)
                result += rst.parse(self, entry(name), f"docstring of {name}")
        return result


def reference(target, text=None):
    """reStructuredText of a link to CLASS or CLASS.ATTRIBUTE, or plain text for names that are not ours."""
    name, _, member = target.partition(".")
    shown = text or target
    if name not in plugin_classes():
        return f"``{shown}``"
    cls = getattr(yade.wrapper, name)
    if not member:
        return f":ref:`{shown} <{label(name)}>`"
    if member in [a[0] for a in attributes(cls)]:
        return f":ref:`{shown} <{label(target)}>`"
    if callable(getattr(cls, member, None)):
        return f":py:meth:`{shown} <{target}>`"
    log.warning("the docstrings name %s, which %s does not have", target, name)
    return f"``{shown}``"


def python_reference(target, text):
    """The same for a module of yade.nonsmooth, or a function or class, with or without the name of its module."""
    for name in package_modules.modules():
        member = target.rsplit(".", 1)[1]
        if target == name:
            return f":py:mod:`{text} <{name}>`"
        if target in (f"{name}.{member}", f"yade.nonsmooth.{member}"):
            module = importlib.import_module(name)
            if getattr(getattr(module, member, None), "__module__", None) == module.__name__:
                return f":py:obj:`{text} <{name}.{member}>`"
    return f"``{text}``"


def yref(name, rawtext, text, lineno, inliner, options=None, content=None):
    match = re.fullmatch(r"(.*?)\s*<([^<>]+)>", text, re.S)
    shown, target = match.groups() if match else (text, text)
    if target.startswith("yade.nonsmooth."):
        source = python_reference(target, shown)
    else:
        source = reference(target.strip(), shown)
    parsed, messages = inliner.parse(source, lineno, _Memo(inliner), inliner.parent)
    return parsed, messages


class _Memo:
    """What docutils' Inliner.parse asks for."""

    def __init__(self, inliner):
        self.document, self.reporter, self.language = inliner.document, inliner.reporter, inliner.language
        self.inliner = inliner


def setup(app):
    app.add_directive("yade-class", Classes)
    app.add_directive("yade-other-classes", OtherClasses)
    roles.register_local_role("yref", yref)
    return {"parallel_read_safe": False}
