"""Tables of the keys of a section file, from the schema that checks it.

``.. section-keys::``        the keys at the top
``.. section-keys:: NAME``   the keys below one of them
``.. section-hints::``       keys that a section does not have, and what to do instead, from the package
"""
import pathlib
import re

import yaml
from docutils.parsers.rst import Directive

import rst

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "py" / "nonsmooth" / "sections" / "section.schema.yaml"


def kind(schema):
    """What a value looks like, in a word or two."""
    if "$ref" in schema:
        return "[x, y]"
    if "enum" in schema:
        return " or ".join(f"``{v}``" for v in schema["enum"])
    names = {
        "number": "number",
        "integer": "whole number",
        "string": "text",
        "boolean": "true or false",
        "array": "list",
        "object": "keys",
    }
    types = schema.get("type", "object")
    return " or ".join(names[t] for t in ([types] if isinstance(types, str) else types))


def meaning(schema, root):
    if "$ref" in schema:
        schema = root["$defs"][schema["$ref"].rsplit("/", 1)[1]]
    return schema.get("description", "").strip()


def rows(schema, root, prefix=""):
    """(key, kind, needed, meaning) of every key below an object but the deprecated ones, depth first."""
    found = []
    for name, below in schema.get("properties", {}).items():
        if below.get("deprecated"):
            continue
        path = f"{prefix}{name}"
        needed = "yes" if name in schema.get("required", ()) else ""
        found.append((f"``{path}``", kind(below), needed, meaning(below, root)))
        found += inner(below, root, path)
    return found


def inner(schema, root, path):
    if schema.get("properties"):
        return rows(schema, root, path + ".")
    item = schema.get("items", {})
    if item.get("properties"):
        return rows(item, root, path + "[].")
    return []


class SectionKeys(Directive):
    optional_arguments = 1

    def run(self):
        self.state.document.settings.env.note_dependency(str(SCHEMA))
        root = yaml.safe_load(SCHEMA.read_text(encoding="utf-8"))
        if not self.arguments:
            table = [
                (f"``{n}``", kind(s), "yes" if n in root["required"] else "", meaning(s, root))
                for n, s in root["properties"].items()
            ]
        else:
            name = self.arguments[0]
            if name not in root["properties"]:
                raise self.error(f"the schema has no key {name}")
            below = root["properties"][name]
            if isinstance(below.get("additionalProperties"), dict):  # a map from names to keys
                below = below["additionalProperties"]
            table = rows(below.get("items", below), root)
        return rst.parse(self, rst.table(("key", "value", "needed", "meaning"), table, (32, 16, 9, 43)), str(SCHEMA))


class SectionHints(Directive):
    def run(self):
        from yade.nonsmooth.model.section import hints as section_hints

        self.state.document.settings.env.note_dependency(section_hints.__file__)
        rows = []
        for hint in section_hints.HINTS:
            where = f" (below ``{hint.inside}``)" if hint.inside else ""
            where = where or (f" (not below ``{hint.outside}``)" if hint.outside else "")
            keys = ", ".join(f"``{key}``" for key in hint.keys.split())
            # as in the message, with the marks of code that reStructuredText has
            text = re.sub(r"`([^`]+)`", r"``\1``", hint.instead[0].upper() + hint.instead[1:] + ".")
            rows.append((f"**{hint.about[0].upper()}{hint.about[1:]}**{where}\n\n{keys}", text))
        return rst.parse(
            self, rst.table(("keys that are refused", "what to do instead"), rows, (42, 58)), section_hints.__file__
        )


def setup(app):
    app.add_directive("section-keys", SectionKeys)
    app.add_directive("section-hints", SectionHints)
    return {"parallel_read_safe": True}
