"""Reading a section file: YAML with line numbers, checked against the JSON schema.

One error is reported, the first of the file, as `file: line N: key: what is wrong; remedy`.
"""

from __future__ import annotations

import difflib
import math
import re
import unicodedata
import warnings
from functools import cache
from itertools import islice
from pathlib import Path
from typing import NoReturn

import jsonschema
import yaml

from ...errors import OldNameWarning, UserError
from . import based, hints as section_hints, units as section_units

__all__ = ["Document", "SectionError", "read", "schema", "take", "values"]

# What a file may ask for, so that reading it ends within seconds; the shipped section has 17 kB, 400 values and 6
# levels.
LARGEST_FILE = 500_000  # bytes
MOST_VALUES = 50_000  # with each alias (`*name`) counted as what it stands for
DEEPEST = 50  # lists and maps inside each other
MOST_ERRORS = 200  # looked at, to find the first of them
LARGEST_NUMBER = 1e18  # reaction rates come to 1e16; squares and products of some such numbers are still finite


class SectionError(UserError, ValueError):
    """A section file that cannot be used; the message names file, line, key, value and remedy."""


class _Loader(yaml.SafeLoader):
    """SafeLoader with the numbers of YAML 1.2 (1e5 is one; 1:30, 010 and a date are text), which refuses a key given
    twice.
    """

    def construct_mapping(self, node, deep=False):
        seen = {}
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise yaml.constructor.ConstructorError(
                    None, None, "a list or a map stands where a key is needed", key.start_mark
                )
            if key.value in seen:
                raise yaml.constructor.ConstructorError(
                    None,
                    None,
                    f"the key {key.value!r} is given twice, first in line {seen[key.value]}; keep one",
                    key.start_mark,
                )
            seen[key.value] = key.start_mark.line + 1
        return super().construct_mapping(node, deep)


_OWN = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float", "tag:yaml.org,2002:timestamp")
_Loader.yaml_implicit_resolvers = {
    k: [(tag, pattern) for tag, pattern in v if tag not in _OWN]
    for k, v in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
_Loader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile(r"^[-+]?(0|[1-9][0-9]*)$"), list("-+0123456789"))
_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(
        r"^[-+]?([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+(?=[eE]))([eE][-+]?[0-9]+)?$|^[-+]?\.(inf|Inf|INF)$|^\.(nan|NaN|NAN)$"
    ),
    list("-+0123456789."),
)


def values(text):
    """The list that ``text`` is without its brackets, ``0.5, 1e4, [1, 2], name``, with the numbers of section files.
    Raises yaml.YAMLError.
    """
    return yaml.load(f"[{text}]", _Loader)


class Document:
    """Plain data of a section file (`data`), and where each key stands in it; data of Python stand nowhere."""

    def __init__(self, path: str, data, root=None):
        self.path, self.data, self._root = path, data, root

    @property
    def is_file(self) -> bool:
        """Whether the data are those of a file, ``path``; others are of Python."""
        return self._root is not None

    def beside(self, path: str) -> str:
        """A path that the data have, as an absolute one: of a file it begins at its folder, of Python at the working
        folder.
        """
        folder = Path(self.path).parent if self.is_file else Path()
        return str((folder / Path(path).expanduser()).resolve())

    def line(self, keys) -> int:
        """Line (from 1) of the key path `keys`, or of the deepest part of it that exists."""
        node = self._root
        if node is None:
            return 0
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
                text += f"[{name[:60] if isinstance(name, str) else key}]"
            else:
                text += ("." if text else "") + str(key)[:60]
        return text

    def refuse(self, keys, what: str, remedy: str) -> NoReturn:
        """Raise SectionError about the key path `keys`."""
        raise SectionError(self._said(keys, what, remedy))

    def warn(self, keys, what: str, remedy: str) -> None:
        """Warn of the key path `keys`, an old name that is still read: an OldNameWarning."""
        warnings.warn(self._said(keys, what, remedy), OldNameWarning, stacklevel=2)

    def _said(self, keys, what, remedy) -> str:
        where = f"{self.named(keys)}: " if keys else ""
        line = f"line {self.line(keys)}: " if self._root is not None else ""
        return _line(f"{self.path}: {line}{where}{what}; {remedy}")


def _line(text: str) -> str:
    """Text on one line, whatever names and values the file has."""
    return " ".join(text.split())


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:  # not more than needed: /dev/zero has no end
            raw = file.read(LARGEST_FILE + 1)
        if len(raw) > LARGEST_FILE:
            raise SectionError(f"{path}: has more than {LARGEST_FILE} bytes; a section is smaller, give another file")
        return raw.decode("utf-8")
    except FileNotFoundError:
        raise SectionError(
            f"{path}: there is no such file; give the path of a section file, " "or a shipped name"
        ) from None
    except UnicodeDecodeError as error:
        raise SectionError(f"{path}: byte {error.start} is not UTF-8 text; save the file as UTF-8") from None
    except (OSError, ValueError) as error:  # ValueError: a zero in the name
        raise SectionError(
            _line(
                f"{str(path)[:200]}: cannot be read ({getattr(error, 'strerror', None) or error}); give a readable section file"
            )
        ) from None


def _yaml(path: Path):
    text = _text(path)
    try:
        loader = _Loader(text)
        try:
            root = loader.get_single_node()
            if root is not None:
                _size(root, path)
            data = loader.construct_document(root) if root is not None else None
        finally:
            loader.dispose()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = f"line {mark.line + 1}: " if mark else ""
        raise SectionError(_line(f"{path}: {line}{error.problem or error.context}; correct the YAML there")) from None
    except RecursionError:
        raise SectionError(
            f"{path}: lists and maps stand inside each other more than {DEEPEST} times; a section needs 6 levels"
        ) from None
    # SafeLoader lets through what its conversions raise, as for `!!int x` or a number of 5000 digits
    except (yaml.YAMLError, ValueError, TypeError, ArithmeticError, LookupError, AttributeError) as error:
        raise SectionError(_line(f"{path}: no valid YAML ({error}); correct the file")) from None
    if not isinstance(data, dict):
        raise SectionError(
            f"{path}: holds {_kind(data)} where keys such as `walls:` are needed; "
            "start from a copy of a shipped section"
        )
    return data, root


def _size(root, path) -> None:
    """Refuse a graph of nodes whose aliases come back to themselves or stand for too much, before anything follows
    them.
    """
    sizes, open_ = {}, set()

    def size(node, depth):
        if id(node) in sizes:
            return sizes[id(node)]
        where = f"{path}: line {node.start_mark.line + 1}"
        if id(node) in open_:
            raise SectionError(f"{where}: an alias stands for a list or a map that holds it; write out what is meant")
        if depth > DEEPEST:
            raise SectionError(
                f"{where}: lists and maps stand inside each other more than {DEEPEST} times; a section needs 6 levels"
            )
        open_.add(id(node))
        inner = node.value if isinstance(node, yaml.CollectionNode) else ()
        total = 1
        for item in inner:
            for part in item if isinstance(item, tuple) else (item,):
                total += size(part, depth + 1)
        open_.discard(id(node))
        if total > MOST_VALUES:
            raise SectionError(
                f"{where}: this holds more than {MOST_VALUES} values, each alias counted as what it stands for; a section needs some hundred"
            )
        sizes[id(node)] = total
        return total

    size(root, 0)


def _plain(document: Document, value, keys=()) -> None:
    """Refuse what JSON has not, NaN, infinities, keys that are no text, and what no message or computation could
    bear.
    """
    if isinstance(value, dict):
        for key, item in value.items():
            if not isinstance(key, str):
                document.refuse((*keys, key), f"the key {_brief(key)} is no text", "give it as a word, or in quotes")
            _text_of(document, key, (*keys, key))
            _plain(document, item, (*keys, key))
    elif isinstance(value, list):
        for i, item in enumerate(value):
            _plain(document, item, (*keys, i))
    elif isinstance(value, str):
        _text_of(document, value, keys)
    elif isinstance(value, float) and not math.isfinite(value):
        document.refuse(keys, f"{value} is no finite number", "give a finite number")
    elif isinstance(value, (int, float)) and abs(value) > LARGEST_NUMBER:
        document.refuse(keys, f"{_brief(value)} is too large", f"give a number of at most {LARGEST_NUMBER:g}")


def _text_of(document, text, keys):
    odd = next((c for c in text if unicodedata.category(c) in ("Cc", "Cs", "Zl", "Zp") and c not in "\t\n"), None)
    if odd is not None:
        document.refuse(keys, f"holds the character {ascii(odd)}", "give text that can be printed")


def _kind(value) -> str:
    names = {
        dict: "keys",
        list: "a list",
        str: "text",
        bool: "true or false",
        type(None): "nothing",
        int: "a number",
        float: "a number",
    }
    return names.get(type(value), f"of YAML's type {type(value).__name__}")


def _brief(value) -> str:
    if isinstance(value, (dict, list)):
        return f"a list of {len(value)}" if isinstance(value, list) else f"a map of {len(value)} keys"
    if isinstance(value, int) and abs(value) > 10**60:  # Python writes no more than 4300 digits
        return f"a number of more than {int(0.3 * value.bit_length())} digits"
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _explain(error, part=()) -> tuple[tuple, str, str]:
    """Key path, what is wrong, and the remedy of a schema error; ``part``: keys that lead to the schema's part, as
    `read` takes them.
    """
    keys, value, schema = tuple(error.absolute_path), error.instance, error.schema
    needed = f"needed: {schema['description']}" if "description" in schema else "correct it"
    if error.validator == "additionalProperties":
        known = [name for name, below in schema["properties"].items() if not below.get("deprecated")]
        key = next(k for k in value if k not in known)
        turned = [name for name in known if sorted(name.split("_")) == sorted(key.lower().replace("-", "_").split("_"))]
        if turned:  # its words in another order, or with other signs between them
            return (*keys, key), "unknown key", f"did you mean {turned[0]!r}? Known here: {', '.join(known)}"
        instead = section_hints.instead_of(key, (*part[1:2], *keys))
        if instead:
            return (*keys, key), "unknown key", f"{instead} (more on the page 'What a section cannot say')"
        near = difflib.get_close_matches(key, known, 1)
        hint = f"did you mean {near[0]!r}? Known here" if near else "known here"
        return (*keys, key), "unknown key", f"{hint}: {', '.join(known)}"
    if error.validator == "required":
        key = next(k for k in error.validator_value if k not in value)
        # what is required under a condition is described with the condition
        about = schema.get("properties", {}).get(key, schema).get("description", "")
        return keys, f"the key {key!r} is missing", f"add it ({about})" if about else "add it"
    if error.validator == "type" and error.validator_value == "integer" and isinstance(value, float):
        return keys, f"{value!r} is no whole number", needed
    if error.validator == "type":
        if value is None:
            return keys, "is empty", needed
        holds = isinstance(value, (dict, list))
        return keys, f"holds {_brief(value)}" if holds else f"{_brief(value)} is {_kind(value)}", needed
    if error.validator in ("minItems", "maxItems", "minProperties", "maxProperties"):
        return keys, f"has {len(value)} entr{'y' if len(value) == 1 else 'ies'}", needed
    meant = section_units.hint(keys[-1], value) if keys and isinstance(value, (int, float)) else ""
    return keys, f"{_brief(value)} is not allowed", f"{needed}; {meant}" if meant else needed


@cache
def schema(path: str, part: tuple):
    """The schema, or its `part` (keys), with what it refers to."""
    whole = found = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    for key in part:
        found = found[key]
    return {"$defs": whole.get("$defs", {}), **found}


def _whole(schema, value):
    """The data with 300.0 as 300 where the schema asks for whole numbers; they meet it already."""
    if isinstance(value, dict):
        known, others = schema.get("properties", {}), schema.get("additionalProperties")
        return {k: _whole(known.get(k, others if isinstance(others, dict) else {}), v) for k, v in value.items()}
    if isinstance(value, list):
        return [_whole(schema.get("items", {}), v) for v in value]
    return int(value) if schema.get("type") == "integer" else value


def read(path, schema_path, part=()) -> Document:
    """Read the YAML file `path` and check it against the schema, or its `part` (keys); SectionError if it fails."""
    data, root = _yaml(Path(path))
    document = Document(str(path), data, root)
    if not part:
        document.data = based.on_base(document, lambda path: _yaml(path)[0])
    return _checked(document, schema_path, part)


def take(data, source, schema_path, part=()) -> Document:
    """Check data of Python as `read` does a file: dictionaries, lists, tuples, arrays, numbers and texts; `source`:
    what messages begin with.
    """
    return _checked(Document(source, _as_plain(data)), schema_path, part)


def _as_plain(value):
    """With lists for tuples and arrays, and Python's own numbers."""
    if isinstance(value, dict):
        return {key: _as_plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return value.tolist()
    return [_as_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def _bare(document, rules) -> None:
    """Refuse a file of a part of a section, such as a material, whose keys stand below a name, as they do in a
    section.
    """
    for key, value in document.data.items():
        if isinstance(value, (dict, list)) and key not in rules["properties"]:
            document.refuse(
                (key,),
                f"holds {_kind(value)}, as in a section, and this file is of one item, a material",
                f"give its keys at the top ({', '.join(list(rules['properties'])[:6])}, …), without `{key}:`",
            )


def _checked(document, schema_path, part) -> Document:
    data = document.data
    _plain(document, data)
    rules = schema(str(schema_path), tuple(part))
    if part:
        _bare(document, rules)
    found = [_explain(e, part) for e in islice(jsonschema.Draft202012Validator(rules).iter_errors(data), MOST_ERRORS)]
    if found:
        keys, what, remedy = min(found, key=lambda f: (document.line(f[0]), len(f[0]), str(f)))
        more = f" (and {len(found) - 1} more to correct)" if len(found) > 1 else ""
        document.refuse(keys, what, remedy + more)
    document.data = _whole(rules, data)
    return document
