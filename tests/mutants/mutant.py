"""What a mutant is, and how it gets into a copy of the sources.

Those of the C++ (below pkg/) all stand in one copy, which is built once: the environment variable NONSMOOTH_MUTANT,
read when the library is loaded, chooses one by its number, and without it the copy computes as the original does.
Others, one at a time, take the place of the text that they change.
"""
import re
import zlib
from dataclasses import dataclass
from pathlib import Path

SYMBOL = "nonsmooth_mutant"  # of C, so that Python can set it too
HEADER = f'extern "C" int {SYMBOL};\n'
SOURCE = f"""#include <cstdlib>
extern "C" {{
int {SYMBOL} = [] {{ const char* number = std::getenv("NONSMOOTH_MUTANT"); return number ? std::atoi(number) : 0; }}();
}}
"""
# a module of Python links one of them alone; what links several takes the switch of the first
LIBRARIES = ("pkg/contact/core", "pkg/contact/slip", "pkg/packing")


class TableError(ValueError):
    """A mutant that cannot be applied; the message says which and why."""


@dataclass(frozen=True)
class Mutant:
    """``edits``: (file, text that occurs there once, what takes its place); ``broken``: what is wrong, in words;
    ``tests``: that should see it, one is enough, of

        test_records.py::test_x     pytest in YADE, in a folder of tests/yade
        plain:test_figures.py, fuzz/test_x.py, bindings/…  pytest without YADE, which is quicker; "plain:" stands for such a folder
        gtest:Law.*                 GoogleTest, a filter
        verify:melt-layer           a check of scripts/verify.py, in its quick form
        check:landing               one of the table of the law (judge.LAW); all that are named must see it

    ``slow``: a run of half a minute or more, which only --all makes.
    """

    name: str
    broken: str
    edits: tuple
    tests: tuple
    slow: bool = False

    @property
    def number(self):
        """Of the switch: the same one whatever stands before it in the table, so that objects need not be built
        again.
        """
        return zlib.crc32(self.name.encode()) >> 1

    @property
    def compiled(self):
        return self.edits[0][0].startswith("pkg/")

    @property
    def files(self):
        return {file for file, _, _ in self.edits}


def mutant(name, file, old, new, broken, *tests, slow=False):
    """A Mutant of one line. Raises TableError where no test should see it."""
    if not tests:
        raise TableError(f"mutant {name}: has no tests that should see it; is there a comma before the first?")
    return Mutant(name, broken, ((file, old, new),), tests, slow)


def place(root, mutated, file, old):
    """Text of the file below ``root``, and where ``old`` stands in it. Raises TableError where it does not occur
    once.
    """
    path = Path(root) / file
    text = path.read_text() if path.exists() else ""
    if text.count(old) != 1:
        raise TableError(
            f"mutant {mutated.name}: `{old}` occurs {text.count(old)} times in {file} and must occur once: adapt tests/mutants/mutants"
        )
    return text, text.index(old)


def check_whole(mutated, text, begin, old, new):
    """Raises TableError where an edit of C++ can stand in no brackets, which would change the copy without a mutant
    too.
    """
    if old.endswith(";"):
        return
    for part in (old, new):
        depth = 0
        for c in re.sub(r"<[\w:, ]*>", "", part):  # without the commas of templates
            depth += (c in "([{") - (c in ")]}")
            if depth < 0 or (c == "," and depth == 0):
                raise TableError(f"mutant {mutated.name}: `{part}` is no expression and ends with no semicolon")
    if re.search(r"(?<![=<>!])=(?!=)", re.sub(r"\[[^]]*\]|<=|>=", "", old)) and not re.match(
        r"\s*[;)]", text[begin + len(old) :]
    ):
        raise TableError(
            f"mutant {mutated.name}: `{old}` is a part of an assignment; take all of it, or its right side"
        )


def switched(old, alternatives):
    """``old``, an expression or a statement of C++, or one of the ``alternatives`` {number: text} where that is
    chosen.
    """
    if old.endswith(";"):
        return (
            " ".join(f"if ({SYMBOL} == {number}) {{ {new} }} else" for number, new in alternatives.items())
            + f" {{ {old} }}"
        )
    return "(" + " : ".join(f"{SYMBOL} == {number} ? ({new})" for number, new in alternatives.items()) + f" : ({old}))"


def switch_all(root, mutants):
    """Makes the compiled ones of the Mutants in the sources below ``root``."""
    spans = {}  # file: {(begin, old): {number: new}}
    for mutated in mutants:
        for file, old, new in mutated.edits if mutated.compiled else ():
            text, begin = place(root, mutated, file, old)
            check_whole(mutated, text, begin, old, new)
            spans.setdefault(file, {}).setdefault((begin, old), {})[mutated.number] = new
    for file, found in spans.items():
        path = Path(root) / file
        text, before = path.read_text(), None
        for (begin, old), alternatives in sorted(found.items(), reverse=True):
            if before is not None and begin + len(old) > before:
                raise TableError(f"mutants {sorted(alternatives)} of {file} stand in what another one changes: `{old}`")
            text, before = text[:begin] + switched(old, alternatives) + text[begin + len(old) :], begin
        path.write_text(text)
    (Path(root) / "pkg" / "contact" / "mutant.hpp").write_text(HEADER)
    for library in LIBRARIES:
        (Path(root) / library / "mutant.cpp").write_text(SOURCE)
