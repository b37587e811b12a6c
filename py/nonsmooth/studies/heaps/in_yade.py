"""``build`` and ``run`` of :mod:`.heaps.course` for the kinds of heaps: they need YADE, and are imported when they are
asked for.
"""

from __future__ import annotations


def __getattr__(name):
    if name in ("build", "run"):
        from . import course

        return getattr(course, name)
    raise AttributeError(f"the modules of heaps have no attribute {name!r}")
