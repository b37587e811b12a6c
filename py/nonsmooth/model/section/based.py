"""Section files that begin from another one: `base` names a shipped section, or the path of a file from the file's own
folder, and the other keys say what differs. Needs no YADE.

Maps are put together key by key, at any depth; a list, such as `walls`, or any other value takes the place of the
base's; a key whose value is null (`water: null`) is left out.
"""

from __future__ import annotations

from pathlib import Path

from .folder import FOLDER, shipped

__all__ = ["KEY", "merged", "on_base"]

KEY = "base"
DEEPEST = 5  # bases of bases


def on_base(document, read):
    """The data of a `document` put onto those of its base, where it has one; ``read``: from a path to the data of a
    file. Raises SectionError for a base that is none.
    """
    data, name, path = document.data, document.path, Path(document.path)
    files = [data]
    while KEY in files[-1]:
        base = files[-1][KEY]
        if not isinstance(base, str) or not base.strip():
            document.refuse((KEY,), f"{base!r} is no name", f"give {_choices()}")
        if len(files) > DEEPEST:
            document.refuse((KEY,), f"more than {DEEPEST} files build on each other", f"let {name} have another base")
        path = _place(document, base, path)
        files.append(read(path))
    made = {}
    for one in reversed(files):
        made = merged(made, {key: value for key, value in one.items() if key != KEY})
    return made


def _place(document, base, path):
    """The file that a base names in the file ``path``."""
    if Path(base).name == base and not Path(base).suffix:
        if base not in shipped():
            document.refuse((KEY,), f"{base!r} is no shipped section", f"give {_choices()}")
        return FOLDER / f"{base}.yaml"
    found = path.parent / base
    if not found.is_file():
        document.refuse((KEY,), f"there is no file {base}", f"give {_choices()}")
    return found


def _choices():
    return f"one of {', '.join(shipped())}, or the path of a section file from the folder of this one"


def merged(below, above):
    """Two dictionaries put together, see above."""
    made = dict(below)
    for key, value in above.items():
        if value is None:
            made.pop(key, None)
        elif isinstance(value, dict) and isinstance(made.get(key), dict):
            made[key] = merged(made[key], value)
        else:
            made[key] = value
    return made
