"""A change of one token that a person might make by mistake, found by a generator, and which of them are tried.

What a generator may change is chosen by its own text and a seed, so that a change of one file leaves the choice in all
others as it was.
"""
import ast
import dataclasses
import hashlib
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from mutant import Mutant
from same import SAME

COMPARISON, SIGN, INDEX, CONSTANT, NAME, CONDITION = "comparison", "sign", "index", "constant", "name", "condition"
KINDS = (COMPARISON, SIGN, INDEX, CONSTANT, NAME, CONDITION)


@dataclass(frozen=True)
class Change:
    """Characters ``begin`` to ``end`` of a file become ``new``. ``kind``: one of KINDS; ``scope``: function in which it
    stands; ``reach``: (begin, end) of the least text that can stand alone, which is what takes a mutant's place: lines
    in Python, an expression or a statement in C++.
    """

    file: str
    kind: str
    line: int
    scope: str
    begin: int
    end: int
    new: str
    before: str  # what stands in the reach, on one line
    after: str
    reach: tuple
    digest: str = ""  # of its text and which one of this text it is: the same one wherever the lines have gone

    @property
    def place(self):
        return f"{self.file}:{self.line}"

    @property
    def says(self):
        return f"{self.before} → {self.after}"


def on_one_line(text):
    return " ".join(text.split())


def change(file, text, kind, scope, begin, end, new, reach=None):
    """A Change; without a ``reach`` that of the lines on which it stands."""
    if reach is None:
        stop = text.find("\n", end)
        reach = text.rfind("\n", 0, begin) + 1, len(text) if stop < 0 else stop
    first, last = reach
    after = text[first:begin] + new + text[end:last]
    line = text.count("\n", 0, begin) + 1
    return Change(file, kind, line, scope, begin, end, new, on_one_line(text[first:last]), on_one_line(after), reach)


def chosen(changes, seed):
    """All of them but for those that compute the same, in the order in which a ``seed`` tries them: kind after kind, so
    that each has its share.
    """
    kinds, seen = {kind: [] for kind in KINDS}, Counter()
    for one in sorted(changes, key=lambda c: (c.file, c.begin, c.kind, c.new)):
        if (one.file, one.before, one.after) in SAME:
            continue
        text = f"{one.file} {one.scope} {one.kind} {one.before} {one.after}"
        seen[text] += 1
        one = dataclasses.replace(one, digest=_digest(f"{text} {seen[text]}"))
        kinds[one.kind].append((_digest(f"{seed} {one.digest}"), one))
    piles = [[one for _, one in sorted(pile, key=lambda p: p[0])] for pile in kinds.values()]
    ranked = [(k, which, one) for which, pile in enumerate(piles) for k, one in enumerate(pile)]
    return [one for _, _, one in sorted(ranked, key=lambda r: r[:2])]


def as_mutant(one, root, tests):
    """The Mutant of a Change; None where it is no Python, or where its reach occurs more than once in C++. In Python
    lines around it are taken until they occur once.
    """
    text = (Path(root) / one.file).read_text()
    if one.file.endswith(".py"):
        try:
            ast.parse(text[: one.begin] + one.new + text[one.end :])
        except SyntaxError:
            return None
    begin, end = one.reach
    while text.count(text[begin:end]) > 1:
        if not one.file.endswith(".py"):
            return None
        begin = text.rfind("\n", 0, max(begin - 1, 0)) + 1
        stop = text.find("\n", end + 1)
        end = len(text) if stop < 0 else stop
    new = text[begin : one.begin] + one.new + text[one.end : end]
    return Mutant(one.digest, one.says, ((one.file, text[begin:end], new),), tuple(tests))


def _digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def number(text):
    """Another number for a literal: twice a float, one more for a whole number, with what C++ writes behind it; None
    for what is none.
    """
    whole = re.fullmatch(r"(\d[\d_]*)([uUlL]*)", text)
    if whole:
        return f"{int(whole[1].replace('_', '')) + 1}{whole[2]}"
    found = re.fullmatch(r"((?:\d[\d_]*)?\.?\d*(?:[eE][-+]?\d+)?)([fFlL]?)", text)
    if not found or not re.search(r"\d", text):
        return None
    value = float(found[1].replace("_", ""))
    return f"{2 * value or 1.0!r}{found[2]}"
