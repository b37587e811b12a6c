"""Which tests concern a file: in Python those that import the module, in C++ those that the table of mutants names for
the file or that name what it defines.
"""
import ast
import re
from collections import Counter
from pathlib import Path

from mutants import MUTANTS

PACKAGE = Path("py", "nonsmooth")
FIXTURES = re.compile(
    r"^def test_\w+\(.*\b(empty|in_process|cases_here|whole|known)\b", re.MULTILINE
)  # of tests/yade/conftest.py


class NearTests:
    """Asks the sources below ``root`` once, and answers for many files."""

    def __init__(self, root):
        self.root = Path(root)
        self.modules = {
            _dotted(path.relative_to(self.root / PACKAGE)): path for path in (self.root / PACKAGE).rglob("*.py")
        }
        self.trees = {name: ast.parse(path.read_text()) for name, path in self.modules.items()}
        self.public = _public(self.trees.get(""))
        self.faces = {name: self._face(name) for name, path in self.modules.items() if path.name == "__init__.py"}
        self.used_by_modules = {name: self._used(tree, name) - {name} for name, tree in self.trees.items()}
        self.used_by_scripts = {
            path.name: self._used(ast.parse(path.read_text())) for path in (self.root / "scripts").glob("*.py")
        }
        self.texts, self.tests, self.words = {}, {}, {}
        self._read_tests()

    def of(self, file, scope=""):
        """Names of tests (as a Mutant has them), nearest first: those that name the function ``scope`` and are named
        after the module or its package, then those of one of the two; of equally near ones those that need no YADE, and
        small ones; what tries thousands of inputs comes last.
        """
        words = [w.strip("_") for w in scope.split(".") if w.strip("_")] or [Path(file).stem]
        near = self._of_python(file, words) if file.endswith(".py") else self._of_cpp(file)
        folders = (*PACKAGE.parts, "pkg", "dem", "engines", "materials", "walls", "checks", "__init__")
        parts = [p for p in Path(file).with_suffix("").parts if p not in folders]
        # WallForceEngine: wall_force
        parts = [re.sub(r"(?<=[a-z])(?=[A-Z])", "_", p).lower().removesuffix("_engine") for p in parts]

        def rank(test):
            text, after = self.texts[test], any(p.rstrip("s") in test for p in parts)
            named = any(re.search(rf"\b{w}\b", text) for w in words)
            return (
                test.startswith("fuzz/"),
                -named - after,
                not test.startswith(("plain:", "gtest:", "bindings/")),
                not after,
                len(text),
            )

        return sorted(near, key=rank)

    # ---- Python
    def _of_python(self, file, names):
        """Tests that import the module, or call a script that does; where none does those that import a module which
        does, and so on. Of those further on also the ones that have a word of the module's name, or its folder's, in
        their own, as test_section of section.checks, and those that say one of the ``names``, where it is no word like
        any other.
        """
        modules, seen, found = {_dotted(Path(file).relative_to(PACKAGE))}, set(), []
        words = [*Path(file).stem.split("_"), *Path(file).parent.relative_to(PACKAGE).parts[-1:]]
        said = {name for name in names if "_" in name}
        while modules:
            scripts = {name for name, used in self.used_by_scripts.items() if used & modules}
            tests = [t for t, (used, called) in self.tests.items() if used & modules or called & scripts]
            found += [
                t
                for t in tests
                if t not in found and (not found or any(w in t for w in words) or said & self._words(t))
            ]
            seen |= modules
            modules = {name for name, used in self.used_by_modules.items() if used & modules} - seen
        return found

    def _words(self, test):
        """Names in the text of a file of tests."""
        if test not in self.words:
            self.words[test] = set(re.findall(r"\w+", self.texts[test]))
        return self.words[test]

    def _face(self, name):
        """{name that a package shows: module from which it comes}."""
        face = {}
        for node in self.trees[name].body:
            if isinstance(node, ast.ImportFrom):
                base = self._base(node, name)
                for alias in node.names:
                    if base is not None and ".".join((*base, alias.name)) not in self.modules:
                        face[alias.asname or alias.name] = ".".join(base)
        return face

    def _base(self, node, within):
        """Parts of the module from which a node imports, None where it is not of the package."""
        if node.level:
            package = within.split(".") if within else []
            if self.modules.get(within) and self.modules[within].name != "__init__.py":
                package = package[:-1]
            package = package[: len(package) - node.level + 1]
            return [*package, *(node.module or "").split(".")] if node.module else package
        return _inside(node.module or "")

    def _resolve(self, parts):
        """The modules on the way from the package to a name."""
        if parts and parts[0] in self.public:
            parts = [*self.public[parts[0]].split("."), *parts[1:]]
        here, found = "", set()
        for part in parts:
            further = f"{here}.{part}".strip(".")
            if further in self.modules:
                here = further
            elif part in self.faces.get(here, {}):
                here = self.faces[here][part]
            else:
                break
            found.add(here)
        return {here} if found else set()

    def _used(self, tree, within=None):
        """Modules of the package that a file uses: imported, through the face of a package, or by a string that names
        one where it imports by name.
        """
        used, aliases, by_name, before = set(), {}, False, {""}
        for node in ast.walk(tree):
            if isinstance(node, ast.JoinedStr) and isinstance(node.values[0], ast.Constant):  # f"figures.{name}"
                before.add(str(node.values[0].value))
            elif isinstance(node, ast.Import):
                for alias in node.names:
                    by_name |= alias.name in ("importlib", "synthetic_slope")
                    if _inside(alias.name) is not None and alias.asname:
                        aliases[alias.asname] = _inside(alias.name)
            elif isinstance(node, ast.ImportFrom):
                base = self._base(node, within or "")
                if node.level and within is None:
                    base = None
                for alias in node.names:
                    parts = (
                        [*base, alias.name]
                        if base is not None
                        else []
                        if node.module == "yade" and alias.name == "nonsmooth"
                        else None
                    )
                    if parts is not None:
                        used |= self._resolve(parts)
                        aliases[alias.asname or alias.name] = parts
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute):
                chain = []
                while isinstance(node, ast.Attribute):
                    chain.insert(0, node.attr)
                    node = node.value
                if isinstance(node, ast.Name) and node.id in aliases:
                    used |= self._resolve([*aliases[node.id], *chain])
                elif isinstance(node, ast.Name) and by_name and node.id in self.modules:  # figures = load("figures")
                    used |= self._resolve([node.id, *chain])
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                said = re.fullmatch(r"(?:yade\.)?nonsmooth\.([\w.]+)|(\w+)\.py", node.value)
                name = next(filter(None, said.groups()), "") if said else node.value.strip(".") if by_name else ""
                if within:  # of the package itself, or beside the module: a script that it starts
                    before |= {f"{within}.", f"{within.rpartition('.')[0]}."}
                used |= {self.public[name]} if name in self.public else set()
                used |= {f"{one}{name}" for one in before if name and f"{one}{name}" in self.modules}
        return used

    # ---- tests
    def _read_tests(self):
        plain = {t.partition("::")[0][6:] for m in MUTANTS for t in m.tests if t.startswith("plain:")}
        folders = [("yade", ""), ("fuzz", "fuzz/"), ("bindings", "bindings/")]
        for folder, prefix in folders:
            here = self.root / "tests" / folder
            helpers = {}
            for path in sorted(here.rglob("*.py")):
                text = path.read_text()
                tree = ast.parse(text)
                used = self._used(tree), {s for s in self.used_by_scripts if re.search(rf"\b{re.escape(s)}\b", text)}
                if path.name.startswith("test_"):
                    test = f"{prefix}{path.name}"
                    if folder == "yade" and (path.name in plain or _is_plain(text)):
                        test = f"plain:{path.name}"
                    self.texts[test], self.tests[test] = text, used
                else:
                    helpers[path.stem] = used
            # what a helper imports is what its users test, unless they have it in common with many
            for test in [t for t in self.tests if t.startswith(prefix) or not prefix]:
                for name, (used, scripts) in helpers.items():
                    if name != "conftest" and re.search(rf"^\s*(import|from) {name}\b", self.texts[test], re.MULTILINE):
                        self.tests[test] = self.tests[test][0] | used, self.tests[test][1] | scripts

    # ---- C++
    def _of_cpp(self, file):
        """The solver's tests for its own files; else files that the table names for this one, and those that name it
        more often than others do.
        """
        if file.startswith(("pkg/contact/", "pkg/neighbours/", "pkg/packing/")):
            return self._gtests() or []
        stem = Path(file).stem
        named = {
            t.partition("::")[0]
            for m in MUTANTS
            if any(Path(f).stem == stem for f in m.files)
            for t in m.tests
            if not t.startswith(("check:", "gtest:"))
        }
        text = (self.root / file).read_text()
        header = (self.root / file).with_suffix(".hpp")
        text += header.read_text() if header.is_file() else ""
        words = {stem, *re.findall(r"\.(?:def|add_property|def_readwrite|def_readonly)\(\"(\w+)\"", text)}
        counts = Counter(
            {
                t: sum(len(re.findall(rf"\b{w}\b", said)) for w in words)
                for t, said in self.texts.items()
                if not t.startswith("fuzz/")
            }
        )
        return [t for t in self.texts if t in named] + [
            t for t, count in counts.most_common(12) if count and t not in named
        ]

    def _gtests(self):
        self.texts.setdefault("gtest:*", "")
        return ["gtest:*"]


def _dotted(path):
    """Name of a module below the package, "" for the package."""
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _public(tree):
    """{name by which scripts import a module: where it stands}, from the package's face."""
    for node in tree.body if tree else ():
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", None) == "FACE":
            return ast.literal_eval(node.value)
    return {}


def _inside(name):
    """Parts of a module's name below the package, None where it is not of it."""
    parts = name.split(".")
    if parts[:1] == ["yade"]:
        parts = parts[1:]
    return parts[1:] if parts[:1] == ["nonsmooth"] else None


def _is_plain(text):
    """Whether a file of tests imports the package without YADE, and has no fixture that needs it."""
    needs = r"^\s*(from|import) yade|^import (contact_scenes|slope_scenes|shell|drawn)"
    return (
        bool(re.search(r"^(from|import) nonsmooth", text, re.MULTILINE))
        and not re.search(needs, text, re.MULTILINE)
        and not FIXTURES.search(text)
    )
