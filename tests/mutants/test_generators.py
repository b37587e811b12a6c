"""The generators of random mutants: what they change in made-up sources, what they leave alone, and whom they ask. No
YADE, no files but made-up ones.
"""
import ast
import os
import re
from collections import Counter
from textwrap import dedent

import changes
import cpp_changes
import judge
import near_tests
import pytest
import python_changes
import workplace
from changes import COMPARISON, CONDITION, CONSTANT, INDEX, NAME, SIGN, as_mutant, chosen, number
from mutant import LIBRARIES, check_whole, mutant, place
from mutants import MUTANTS
from near_tests import NearTests


def python(text):
    """{(kind, line as it is then)} of a made-up module."""
    return {(c.kind, c.after) for c in python_changes.changes("made_up.py", dedent(text))}


def cpp(text):
    """{(kind, expression or statement as it is then)} of a made-up source."""
    return {(c.kind, c.after) for c in cpp_changes.changes("pkg/made_up.cpp", dedent(text))}


# ---- Python: each kind of change
@pytest.mark.parametrize(
    "line, expected",
    [
        ("x = a < b", {(COMPARISON, "x = a > b")}),  # of measured numbers the bound itself is none
        ("x = a == b", {(COMPARISON, "x = a != b")}),
        ("x = a is not None", {(COMPARISON, "x = a is None")}),
        ("x = a not in b", {(COMPARISON, "x = a in b")}),
        # of counts it is one
        ("x = len(a) >= len(b)", {(COMPARISON, "x = len(a) <= len(b)"), (COMPARISON, "x = len(a) > len(b)")}),
        (
            "x = a < b < c",
            {
                (COMPARISON, "x = a > b < c"),
                (COMPARISON, "x = a < b > c"),
                (CONDITION, "x = b < c"),
                (CONDITION, "x = a < b"),
            },
        ),
        ("x = a + b", {(SIGN, "x = a - b")}),
        ("x = a / b", {(SIGN, "x = a * b")}),
        ("x = a ** b", set()),
        ("x = -a", {(SIGN, "x = a")}),
        ("x -= a", {(SIGN, "x += a")}),
        ("x = a[0]", {(INDEX, "x = a[1]")}),
        ("x = a[1]", {(INDEX, "x = a[2]"), (INDEX, "x = a[0]")}),
        ("x = a[-1]", {(INDEX, "x = a[-2]"), (INDEX, "x = a[0]")}),
        ("x = a[:, 0]", {(INDEX, "x = a[:, 1]")}),
        ("x = a[1:]", {(INDEX, "x = a[2:]")}),  # one side of a slice, not both
        ("x = 3", {(CONSTANT, "x = 4")}),
        ("x = 2.5", {(CONSTANT, "x = 5.0")}),
        ("x = 0.0", {(CONSTANT, "x = 1.0")}),
        ("x = True", {(CONSTANT, "x = False")}),
        ("x = not a", {(CONDITION, "x = a")}),
        ("x = a and b", {(CONDITION, "x = True and b"), (CONDITION, "x = a and True")}),
        ("x = a or b", {(CONDITION, "x = False or b"), (CONDITION, "x = a or False")}),
        ("x = [y for y in a if y]", {(CONDITION, "x = [y for y in a if True]")}),
        ("x = b if a else c", {(CONDITION, "x = b if True else c"), (CONDITION, "x = b if False else c")}),
        ("x = f(a, key=2)", {(CONSTANT, "x = f(a, key=3)")}),
    ],
)
def test_python_changes_one_token_of_a_line(line, expected):
    assert python(line + "\n") == expected


def test_python_exchanges_names_that_are_bound_by_then():
    found = python(
        """
        def f(a, b):
            return a
            later = 1
        """
    )
    assert found == {(NAME, "return b"), (CONSTANT, "later = 2")}
    assert python("def f(a):\n    return a\n") == set()  # there is no other name
    assert python("def f(self, a):\n    return a\n") == set()  # nor is the object one


def test_python_finds_an_operator_between_brackets_behind_a_comment_and_after_wide_letters():
    assert (SIGN, ") - b") in python("x = (\n    a  # + c\n) + b\n")
    assert python('x = f("Größe", a + b)\n') == {(SIGN, 'x = f("Größe", a - b)')}
    assert (COMPARISON, "< b") not in python("x = (\n    a  # > c\n    < b\n)\n")
    assert (COMPARISON, "> b") in python("x = (\n    a  # > c\n    < b\n)\n")


@pytest.mark.parametrize(
    "text",
    [
        '"""A docstring of 3 words: a < b."""\n',
        'def f():\n    """Returns 1 + 2."""\n',
        "# 1 + 2 < 3\n",
        '__all__ = ["a", "b"]\n',
        "from a import b as c\n",
        "x: Literal[1, 2]\n",
        "def f(a: Annotated[int, 3]) -> Annotated[int, 4]:\n    pass\n",
        'raise ValueError(f"{a + 1} is too large", 2)\n',
        'x = f"{a + 1} of {b[0]}"\n',
        'x = "a" + b\n',
        "x = b % 'a'\n",
        "assert a < 3\n",
        'if __name__ == "__main__":\n    main()\n',
        "if TYPE_CHECKING:\n    import a\n",
        "ax.plot(a, linewidth=0.5, alpha=0.3, zorder=3)\n",  # how a figure looks
        "fig.subplots(2, 3)\n",
        "def draw(a, width, linewidth=0.5):\n    pass\n",
    ],
)
def test_python_leaves_alone_what_computes_nothing(text):
    assert python(text) == set()


# lines of many kinds, which the changes below are made of
MANY = '''
"""Says nothing."""
import math

LIMIT = 1e-3


class Path:
    side = -1

    def ahead(self, points, start=0, *, open=True):
        """Points ahead of ``start``."""
        count: int = len(points)
        if not points or (count > 2 and start != 0):
            raise ValueError(f"{count} points")
        total = 0.0
        for k, (x, y) in enumerate(points[1:]):
            total += self.side * math.hypot(x - points[k][0], y - points[k][1]) / 2
        return [p for p in points if p[0] * self.side >= start] if open else total
'''


def test_every_python_change_is_python_and_touches_what_it_says():
    found = python_changes.changes("made_up.py", MANY)
    assert {c.kind for c in found} == {COMPARISON, SIGN, INDEX, CONSTANT, NAME, CONDITION}
    for c in found:
        text = MANY[: c.begin] + c.new + MANY[c.end :]
        assert ast.dump(ast.parse(text)) != ast.dump(ast.parse(MANY)), c.says
        assert [k for k, (a, b) in enumerate(zip(text.split("\n"), MANY.split("\n")), 1) if a != b] == [c.line], c.says
        assert c.scope == ("Path.ahead" if c.line > 11 else "Path" if c.line > 7 else ""), c.says


# ---- which are tried
def test_a_seed_chooses_the_same_ones_and_another_seed_others():
    found = python_changes.changes("made_up.py", MANY)
    first = [c.digest for c in chosen(found, 1)]
    assert first == [c.digest for c in chosen(list(reversed(found)), 1)]
    assert sorted(first) == sorted(c.digest for c in chosen(found, 2)) and len(set(first)) == len(first) == len(found)
    assert first != [c.digest for c in chosen(found, 2)]


def test_each_kind_has_its_share_and_another_file_changes_no_order():
    found = python_changes.changes("made_up.py", MANY)
    assert {c.kind for c in chosen(found, 1)[:6]} == {c.kind for c in found}
    signs = [c for c in chosen(found, 1) if c.kind == SIGN]
    more = [c for c in chosen(found + python_changes.changes("other.py", "x = a + b\n"), 1) if c.kind == SIGN]
    assert [c for c in more if c.file == "made_up.py"] == signs and len(more) == len(signs) + 1


def test_a_digest_stays_where_lines_move_and_differs_between_equal_lines():
    text = "x = a + b\ny = 1\nx = a + b\n"
    before, after = ([c.digest for c in chosen(python_changes.changes("m.py", t), 1)] for t in (text, "\n\n" + text))
    assert before == after and len(set(before)) == 3


def test_what_computes_the_same_is_left_out(monkeypatch):
    found = python_changes.changes("m.py", "x = a + b\ny = 1\n")
    monkeypatch.setattr(changes, "SAME", {("m.py", "x = a + b", "x = a - b"): "made up"})
    assert [c.after for c in chosen(found, 1)] == ["y = 2"]


def test_a_python_mutant_is_lines_that_occur_once(tmp_path):
    text = "def f(a, b):\n    return a + b\n\n\ndef g(a, b):\n    return a + b\n"
    (tmp_path / "m.py").write_text(text)
    signs = [c for c in python_changes.changes("m.py", text) if c.kind == SIGN]
    for one, name in zip(signs, "fg"):
        ((_, old, new),) = as_mutant(one, tmp_path, ["test_m.py"]).edits
        assert text.count(old) == 1 and f"def {name}" in text.replace(old, new).split("a - b")[0].split("\n\n")[-1]


def test_a_cpp_mutant_occurs_once_or_is_none(tmp_path):
    text = "void f() { x = a + b; y = a + b; z = a + c; }\n"
    (tmp_path / "m.cpp").write_text(text)
    found = {c.after: as_mutant(c, tmp_path, ["test_m.py"]) for c in cpp_changes.changes("m.cpp", text)}
    assert found["a - b"] is None and found["a - c"].edits == (("m.cpp", "a + c", "a - c"),)


@pytest.mark.parametrize(
    "text, other",
    [
        ("0", "1"),
        ("1_000", "1001"),
        ("52L", "53L"),
        ("49u", "50u"),
        ("0.0", "1.0"),
        ("1e-9", "2e-09"),
        ("0.5f", "1.0f"),
        (".5", "1.0"),
        ("2.", "4.0"),
        ("0x1F", None),
        ("2j", None),
    ],
)
def test_another_number_is_of_the_same_type(text, other):
    assert number(text) == other


# ---- C++
@pytest.mark.parametrize(
    "statement, expected",
    [
        ("x = a < b;", {(COMPARISON, "a > b")}),
        ("x = a == b;", {(COMPARISON, "a != b")}),
        ("x = n > 1;", {(COMPARISON, "n < 1"), (COMPARISON, "n >= 1"), (CONSTANT, "n > 2")}),
        ("x = a + b;", {(SIGN, "a - b")}),
        ("x = -a;", {(SIGN, "a")}),
        ("x = (a) -b;", set()),
        ("x += a * b;", {(SIGN, "a / b")}),  # the statement's own sign cannot stand in a branch
        ("f(a, 2, true);", {(CONSTANT, "3"), (CONSTANT, "false")}),
        ("x = a[0];", {(CONSTANT, "1")}),
        ("x = 0.5f;", {(CONSTANT, "1.0f")}),
        ("x = !p;", {(CONDITION, "!!p")}),  # which is of the type of !p also where p is a pointer
        ("x = a && b;", {(CONDITION, "true && b"), (CONDITION, "a && true")}),
        (
            "x = a || b || c;",
            {
                (CONDITION, f"{x} || {y} || {z}")
                for x, y, z in (("false", "b", "c"), ("a", "false", "c"), ("a", "b", "false"))
            },
        ),
        (
            "x = a && (b || c);",
            {
                (CONDITION, "true && (b || c)"),
                (CONDITION, "a && true"),
                (CONDITION, "false || c"),
                (CONDITION, "b || false"),
            },
        ),
        ("x = std::max<Real>(a, 2);", {(CONSTANT, "3")}),
        ("x = static_cast<Real>(a) / b;", {(SIGN, "static_cast<Real>(a) * b")}),
        ("return a - b;", {(SIGN, "a + b")}),
        ("x = c ? a + b : d;", {(SIGN, "a - b")}),
        ("if (a) x = b;", {(CONDITION, "true"), (CONDITION, "false")}),
        ("for (int i = 0; i < n; ++i) f(i);", {(CONSTANT, "1"), (COMPARISON, "i > n")}),
        ("const Real x = a * b;", {(SIGN, "a / b")}),
        ("x = 'a' + b;", set()),  # words are put together there
    ],
)
def test_cpp_changes_one_token_of_an_expression(statement, expected):
    assert cpp(f"void f() {{ {statement} }}\n") == expected


@pytest.mark.parametrize(
    "text",
    [
        "// 1 + 2 < 3\n",
        "/* a < b\n   1 + 2 */\n",
        '#include "a/b-2.hpp"\n',
        "#define TWICE(a) \\\n\t(2 * a)\n",
        "#include <a>\n#ifdef YADE_MPI\nint f() { return a + b; }\n#else\nint f() { return a - b; }\n#endif\n",
        "constexpr int most = 3 * 4;\n",
        "static_assert(sizeof(A) == 8);\n",
        "template <int N = 3> class A;\n",
        "enum Limit { Largest = 0, Smallest = 4 };\n",
        "enum class Limit : char { Largest = 1 };\n",
        "void f() { switch (a) { case 1: g(); } }\n",
        "void f() { std::array<Real, 3> x; Real y[2]; }\n",
        "void f() { std::vector<std::array<int, 3>> x; }\n",
        'YADE_CLASS_BASE_DOC_ATTRS(A, B, "", ((int, a, 3, , "a < 2")));\n',
        'void f() { LOG_WARN("a " << 3 + 4); }\n',
        'void f() { g("1 + 2 < 3 && !x"); }\n',
        'void f() { g(R"(1 + 2 < 3)"); }\n',
        "void f() { if (const auto* p = g()) h(); }\n",  # it declares a name
        "bool operator<(const A& a);\n",
        "A& a = b;\nA&& c;\nB* d;\n",
    ],
)
def test_cpp_leaves_alone_what_computes_nothing_or_must_be_constant(text):
    assert cpp("int first;\n" + text + "int last;\n") == set()


def test_cpp_behind_what_is_left_alone_is_changed_again():
    assert cpp("enum A { B = 1 };\nvoid f() { x = a + b; }\n") == {(SIGN, "a - b")}
    assert cpp("#ifdef A\nint y = 1 * z;\n#endif\nvoid f() { x = a + b; }\n") == {(SIGN, "a - b")}
    assert cpp("void f() { std::array<Real, 3> x; y = a < b; z = c > d; }\n") == {
        (COMPARISON, "a > b"),
        (COMPARISON, "c < d"),
    }


def test_every_cpp_change_can_be_a_branch_of_a_switch():
    text = dedent(
        """
        Real A::f(const Vector3r& p, bool open) const
        {
        	const auto found = at.find(id);
        	if (found == at.end() || (open && !p)) return -1;
        	for (size_t k = 0; k + 1 < list.size(); ++k)
        		sum += std::abs(list[k] - list[k + 1]) * (k > 2 ? 0.5 : 1);
        	while (sum > 1e-9)
        		sum -= weigh(sum, 2, { 3, 4 });
        	return open ? sum / 2 : std::max(sum, Real(0));
        }
        """
    )
    found = cpp_changes.changes("pkg/made_up.cpp", text)
    assert {c.kind for c in found} == {COMPARISON, SIGN, CONSTANT, CONDITION}
    for c in found:
        first, last = c.reach
        old, new = text[first:last], text[first : c.begin] + c.new + text[c.end : last]
        check_whole(mutant(c.digest, c.file, old, new, c.says, "gtest:Law.*"), text, first, old, new)
        assert new != old and ";" not in old


def test_a_copy_is_built_again_where_it_changed_also_back(tmp_path, monkeypatch):
    """Files' times are what ninja goes by: one that loses its mutants is the checkout's, which is older than what was
    built with them.
    """
    checkout, copy = tmp_path / "checkout" / "pkg" / "contact", tmp_path / "copy"
    for folder in ("contact/core", "contact/slip", "packing"):
        (checkout.parent / folder).mkdir(parents=True)
    for name in ("a.cpp", "b.cpp"):
        (checkout / name).write_text("int f() { return x + y; }\n")
        os.utime(checkout / name, (1e9, 1e9))
    monkeypatch.setattr(workplace, "ROOT", tmp_path / "checkout")
    monkeypatch.setattr(workplace, "PARTS", ("pkg",))

    def times():
        return [(copy / "pkg" / "contact" / name).stat().st_mtime_ns for name in ("a.cpp", "b.cpp")]

    one, other = (
        mutant(name[0], f"pkg/contact/{name}", "x + y", "x - y", "", "gtest:Law.*") for name in ("a.cpp", "b.cpp")
    )
    workplace.mutated_sources(copy, [one, other])
    first = times()
    workplace.mutated_sources(copy, [one])
    again = times()
    assert again[0] == first[0] and again[1] > first[1] > 1e9 * 1e9
    assert (copy / "pkg" / "contact" / "b.cpp").read_text() == (checkout / "b.cpp").read_text()


def test_every_library_that_a_python_module_links_has_the_switch():
    """Such a module is opened without the engines, and what its library leaves undefined nobody defines."""
    cmake, bindings = ((workplace.ROOT / name).read_text() for name in ("CMakeLists.txt", "cmake/Bindings.cmake"))
    folders = dict(re.findall(r"file\(GLOB \w+ CONFIGURE_DEPENDS (\S+)/\*\.cpp.*\)\nadd_library\((\w+) STATIC", cmake))
    linked = re.findall(r"^nonsmooth_python_module\(.* (\w+)\)$", bindings, re.M)
    assert len(linked) == 3
    assert {folder for folder, library in folders.items() if library in linked} == set(LIBRARIES)


# ---- who judges
@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """A made-up checkout: modules a, b (which imports a), c, the package sub with a face; a script; tests of each
    kind.
    """
    for name, text in {
        "py/nonsmooth/__init__.py": "",
        "py/nonsmooth/a.py": "def weigh(x):\n    return x\n",
        "py/nonsmooth/b.py": "from . import a\n",
        "py/nonsmooth/c.py": "from nonsmooth.a import weigh\n",
        "py/nonsmooth/lonely_part.py": "",
        "py/nonsmooth/sub/__init__.py": "from .inside import thing\n",
        "py/nonsmooth/sub/inside.py": "thing = 1\n",
        "py/nonsmooth/sub/starts.py": "WORKER = Path(__file__).with_name('_worker.py')\n",
        "py/nonsmooth/sub/_worker.py": "",
        "scripts/run_c.py": "from nonsmooth import c\n",
        "pkg/dem/Wall.cpp": '.def("touch", &Wall::touch)\n',
        "tests/yade/conftest.py": "from nonsmooth import a, b, c\n",
        "tests/yade/helper.py": "from nonsmooth.sub import thing\n",
        "tests/yade/test_a.py": "from nonsmooth import a\n\ndef test_x():\n    a.weigh(1)\n",
        "tests/yade/test_other.py": "from yade.nonsmooth import a\n",
        "tests/yade/test_b.py": "from nonsmooth import b\n\ndef test_x(empty):\n    pass\n",
        "tests/yade/test_c.py": 'call("run_c.py")\n',
        "tests/yade/test_face.py": "from nonsmooth.sub import thing\n",
        "tests/yade/test_helped.py": "import helper\n",
        "tests/yade/test_starts.py": "from nonsmooth.sub import starts\n",
        "tests/yade/test_wall.py": "Wall().touch()\n",
        "tests/yade/test_walls_more.py": "Wall(), Wall(), Wall()\n",
        "tests/yade/test_named.py": "",
        "tests/fuzz/test_a_files.py": "import nonsmooth.a as read\n\nread.weigh(2)\n",
        "tests/bindings/test_module.py": "from nonsmooth import a\n",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.setattr(
        near_tests, "MUTANTS", [mutant("m", "pkg/dem/Wall.hpp", "", "", "", "test_named.py::test_x", "check:landing")]
    )
    return NearTests(tmp_path)


def test_who_imports_a_module_judges_it_and_the_nearest_first(checkout):
    # named after it and naming the function, without YADE; then one of the two; what tries thousands of inputs last.
    # conftest.py is nobody's own.
    assert checkout.of("py/nonsmooth/a.py", "weigh") == [
        "plain:test_a.py",
        "bindings/test_module.py",
        "test_other.py",
        "fuzz/test_a_files.py",
    ]
    assert checkout.of("py/nonsmooth/b.py") == ["test_b.py"]  # which has a fixture of YADE's


def test_scripts_faces_and_helpers_are_ways_to_a_module(checkout):
    assert checkout.of("py/nonsmooth/c.py") == ["test_c.py"]
    assert set(checkout.of("py/nonsmooth/sub/inside.py")) == {"plain:test_face.py", "test_helped.py"}
    assert checkout.of("py/nonsmooth/sub/_worker.py") == ["plain:test_starts.py"]  # which a module beside it starts
    assert checkout.of("py/nonsmooth/lonely_part.py") == []


def test_cpp_is_judged_by_the_table_and_by_who_says_its_names(checkout):
    assert set(checkout.of("pkg/dem/Wall.cpp")) == {"test_named.py", "test_wall.py", "test_walls_more.py"}
    assert checkout.of("pkg/contact/law.cpp") == ["gtest:*"]


@pytest.mark.parametrize(
    "ran, outcome", [("0 tests from 0 test suites", "BROKEN"), ("10 tests from 2 test suites", "SURVIVED")]
)
def test_a_filter_of_googletest_that_selects_nothing_is_no_judge(monkeypatch, ran, outcome):
    """A suite of parameters is called Instance/Suite, so that the filter "Suite.*" has none of it."""
    said = f"[==========] {ran} ran. (0 ms total)\n[  PASSED  ] 0 tests."
    monkeypatch.setattr(judge, "run", lambda *_: [("gtest", 0, said)])
    one = mutant("m", "pkg/contact/core/a.cpp", "x", "y", "", "gtest:Suite.*")
    assert judge._verdict(None, one, 1, {}, 300, ()).outcome == outcome


def test_no_two_mutants_have_one_name_and_each_text_stands_once():
    """What run.py asks before it begins, here at once."""
    assert [name for name, times in Counter(m.name for m in MUTANTS).items() if times > 1] == []
    for one in MUTANTS:
        for file, old, _ in one.edits:
            place(workplace.ROOT, one, file, old)
