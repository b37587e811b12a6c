"""Reading a section file: YAML with line numbers, checked against the JSON schema.

One error is reported, the first of the file, as `file: line N: key: what is wrong; remedy`.
"""

from __future__ import annotations

import difflib
import math
import re
from pathlib import Path
from typing import NoReturn

import jsonschema
import yaml

from .errors import UserError

__all__ = ["Document", "SectionError", "read"]


class SectionError(UserError, ValueError):
    """A section file that cannot be used; the message names file, line, key, value and remedy."""


class _Loader(yaml.SafeLoader):
    """SafeLoader that reads 1e5 as a number (YAML 1.2) and refuses a key given twice."""

    def construct_mapping(self, node, deep=False):
        seen = {}
        for key, _ in node.value:
            if key.value in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key {key.value!r} is given twice, first in line {seen[key.value]}; keep one",
                    key.start_mark)
            seen[key.value] = key.start_mark.line + 1
        return super().construct_mapping(node, deep)


_Loader.yaml_implicit_resolvers = {k: list(v) for k, v in yaml.SafeLoader.yaml_implicit_resolvers.items()}
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$"),
                              list("-+0123456789."))


class Document:
    """Plain data of a section file (`data`), and where each key stands in it."""

    def __init__(self, path: str, data, root):
        self.path, self.data, self._root = path, data, root

    def line(self, keys) -> int:
        """Line (from 1) of the key path `keys`, or of the deepest part of it that exists."""
        node = self._root
        line = node.start_mark.line
        for key in keys:
            if isinstance(node, yaml.MappingNode):
                found = [(k, v) for k, v in node.value if k.value == str(key)]
                if not found:
                    break
                # the last: a key of the mapping itself comes after those that `<<` brings
                line, node = found[-1][0].start_mark.line, found[-1][1]
            elif isinstance(node, yaml.SequenceNode) and isinstance(key, int) and key < len(node.value):
                node = node.value[key]
                line = node.start_mark.line
            else:
                break
        return line + 1

    def named(self, keys) -> str:
        """Key path as text, list items by their name where they have one: walls[DP].material."""
        text, value = "", self.data
        for key in keys:
            try:
                value = value[key]
            except (KeyError, IndexError, TypeError):
                value = None
            if isinstance(key, int):
                name = value.get("name") if isinstance(value, dict) else None
                text += f"[{name if isinstance(name, str) else key}]"
            else:
                text += f".{key}" if text else str(key)
        return text

    def refuse(self, keys, what: str, remedy: str) -> NoReturn:
        """Raise SectionError about the key path `keys`."""
        where = f"{self.named(keys)}: " if keys else ""
        raise SectionError(f"{self.path}: line {self.line(keys)}: {where}{what}; {remedy}")


def _yaml(path: Path):
    try:
        text = path.read_bytes().decode("utf-8")
    except FileNotFoundError:
        raise SectionError(f"{path}: there is no such file; give the path of a section file, "
                           "or a shipped name") from None
    except UnicodeDecodeError as error:
        raise SectionError(f"{path}: byte {error.start} is not UTF-8 text; save the file as UTF-8") from None
    except OSError as error:
        raise SectionError(f"{path}: cannot be read ({error.strerror}); give a readable section file") from None
    try:
        loader = _Loader(text)
        try:
            root = loader.get_single_node()
            data = loader.construct_document(root) if root is not None else None
        finally:
            loader.dispose()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = f"line {mark.line + 1}: " if mark else ""
        raise SectionError(f"{path}: {line}{error.problem or error.context}; correct the YAML there") from None
    except (yaml.YAMLError, ValueError, TypeError, RecursionError) as error:
        raise SectionError(f"{path}: no valid YAML ({' '.join(str(error).split())}); correct the file") from None
    if not isinstance(data, dict):
        raise SectionError(f"{path}: holds {_kind(data)} where keys such as `walls:` are needed; "
                           "start from a copy of a shipped section")
    return data, root


def _numbers(document: Document, value, keys=()) -> None:
    """Refuse NaN, infinities and keys that are no text; JSON has none of them."""
    if isinstance(value, dict):
        for key, item in value.items():
            if not isinstance(key, str):
                document.refuse((*keys, key), f"the key {key!r} is no text", "give it as a word, or in quotes")
            _numbers(document, item, (*keys, key))
    elif isinstance(value, list):
        for i, item in enumerate(value):
            _numbers(document, item, (*keys, i))
    elif isinstance(value, float) and not math.isfinite(value):
        document.refuse(keys, f"{value} is no finite number", "give a finite number")


def _kind(value) -> str:
    names = {dict: "keys", list: "a list", str: "text", bool: "true or false", type(None): "nothing"}
    return names.get(type(value), "a number")


def _brief(value) -> str:
    text = repr(value) if not isinstance(value, (dict, list)) else f"{_kind(value)} of {len(value)}"
    return text if len(text) <= 60 else text[:57] + "..."


def _explain(error) -> tuple[tuple, str, str]:
    """Key path, what is wrong, and the remedy of a schema error."""
    keys, value, schema = tuple(error.absolute_path), error.instance, error.schema
    needed = f"needed: {schema['description']}" if "description" in schema else "correct it"
    if error.validator == "additionalProperties":
        known = list(schema["properties"])
        key = next(k for k in value if k not in known)
        near = difflib.get_close_matches(key, known, 1)
        hint = f"did you mean {near[0]!r}? Known here" if near else "known here"
        return (*keys, key), "unknown key", f"{hint}: {', '.join(known)}"
    if error.validator == "required":
        key = next(k for k in error.validator_value if k not in value)
        about = schema["properties"][key].get("description", "")
        return keys, f"the key {key!r} is missing", f"add it ({about})" if about else "add it"
    if error.validator == "type" and error.validator_value == "integer" and isinstance(value, float):
        return keys, f"{value!r} is no whole number", needed
    if error.validator == "type":
        return keys, f"{_brief(value)} is {_kind(value)}", needed
    if error.validator in ("minItems", "maxItems", "minProperties", "maxProperties"):
        return keys, f"has {len(value)} entries", needed
    return keys, f"{_brief(value)} is not allowed", needed


def read(path, schema_path, part=()) -> Document:
    """Read the YAML file `path` and check it against the schema, or its `part` (keys); SectionError if it fails."""
    data, root = _yaml(Path(path))
    document = Document(str(path), data, root)
    _numbers(document, data)
    whole = yaml.safe_load(Path(schema_path).read_text(encoding="utf-8"))
    schema = whole
    for key in part:
        schema = schema[key]
    schema = {"$defs": whole.get("$defs", {}), **schema}
    found = [_explain(e) for e in jsonschema.Draft202012Validator(schema).iter_errors(data)]
    if found:
        keys, what, remedy = min(found, key=lambda f: (document.line(f[0]), len(f[0]), str(f)))
        more = f" (and {len(found) - 1} more to correct)" if len(found) > 1 else ""
        document.refuse(keys, what, remedy + more)
    return document
