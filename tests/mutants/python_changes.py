"""Changes of single tokens in Python, found in its syntax tree."""
import ast
import re
import zlib

from changes import COMPARISON, CONDITION, CONSTANT, INDEX, NAME, SIGN, change, number

TURNED = {
    ast.Lt: ("<", ">"),
    ast.Gt: (">", "<"),
    ast.LtE: ("<=", ">="),
    ast.GtE: (">=", "<="),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: (r"is\s+not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: (r"not\s+in", "in"),
}
BOUNDARY = {ast.Lt: ("<", "<="), ast.Gt: (">", ">="), ast.LtE: ("<=", "<"), ast.GtE: (">=", ">")}
SIGNS = {ast.Add: (r"\+", "-"), ast.Sub: ("-", "+"), ast.Mult: (r"\*", "/"), ast.Div: ("/", "*")}
LOOK_CALLS = {
    "add_axes",
    "add_gridspec",
    "annotate",
    "figure",
    "legend",
    "margins",
    "subplots",
    "subplots_adjust",
    "text",
}  # where things stand on the paper
# keyword arguments that say how a figure looks: no answer is wrong for another width of a line
LOOK = set(
    """alpha bbox bbox_to_anchor bbox_props borderaxespad bottom capsize columnspacing constrained_layout dashes dpi edgecolor facecolor figsize fontsize frameon handlelength height_ratios
    hspace labelpad labelspacing leave left length linestyle linewidth linewidths loc ls lw markersize mew mininterval miniters ms ncol pad rasterized right rotation s size
    smoothing stacklevel top width_ratios wspace xytext zorder""".split()
)


def changes(file, text):
    """A list of Changes of one Python file."""
    finder = _Finder(file, text)
    finder.visit(ast.parse(text))
    return finder.found


class _Finder(ast.NodeVisitor):
    def __init__(self, file, text):
        self.file, self.text, self.found = file, text, []
        self._lines = text.splitlines(keepends=True)
        self._starts = [0]
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line))
        self._scopes, self._bound = [], [{}]

    # ---- places
    def _at(self, line, column):
        # columns of the tree count bytes
        return self._starts[line - 1] + len(self._lines[line - 1].encode()[:column].decode())

    def _span(self, node):
        return self._at(node.lineno, node.col_offset), self._at(node.end_lineno, node.end_col_offset)

    def _add(self, kind, begin, end, new):
        self.found.append(change(self.file, self.text, kind, ".".join(self._scopes), begin, end, new))

    def _replace(self, kind, node, new):
        self._add(kind, *self._span(node), new)

    def _between(self, kind, left, right, pattern, new):
        """Changes the operator between two nodes, which may stand in brackets and on two lines."""
        begin, end = self._span(left)[1], self._span(right)[0]
        gap = re.sub(r"#.*", lambda m: " " * len(m[0]), self.text[begin:end])
        found = re.search(rf"\b{pattern}\b" if new[0].isalpha() else pattern, gap)
        if found:
            self._add(kind, begin + found.start(), begin + found.end(), new)

    # ---- what is left alone
    def visit_Raise(self, node):  # whether it is raised is what the condition says; messages have tests of their own
        pass

    def visit_JoinedStr(self, node):  # its parts have no places of their own
        pass

    def visit_Import(self, node):
        pass

    visit_ImportFrom = visit_Assert = visit_Import

    def visit_AnnAssign(self, node):
        if node.value:
            self.visit(node.value)

    def visit_keyword(self, node):
        if node.arg not in LOOK:
            self.visit(node.value)

    def visit_arg(self, node):  # annotations
        pass

    # ---- scopes
    def visit_ClassDef(self, node):
        self._scopes.append(node.name)
        self._bound.append({})
        for part in node.body:
            self.visit(part)
        self._bound.pop()
        self._scopes.pop()

    def visit_FunctionDef(self, node):
        arguments = node.args
        placed = [*arguments.posonlyargs, *arguments.args]
        every = [*placed, *arguments.kwonlyargs]
        usual = [*zip(placed[::-1], arguments.defaults[::-1]), *zip(arguments.kwonlyargs, arguments.kw_defaults)]
        for name, default in usual:
            if default is not None and name.arg not in LOOK:
                self.visit(default)
        bound = {a.arg: node.lineno for a in every if a.arg not in ("self", "cls")}
        for part in _own(node):
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
                bound.setdefault(part.id, part.lineno)
        self._scopes.append(node.name)
        self._bound.append(bound)
        for part in node.body:
            self.visit(part)
        self._bound.pop()
        self._scopes.pop()

    # ---- changes
    def visit_Name(self, node):
        bound = self._bound[-1]
        if not isinstance(node.ctx, ast.Load) or node.id not in bound:
            return
        others = sorted(name for name, line in bound.items() if name not in (node.id, "_") and line < node.lineno)
        if others:
            text = f"{self.file} {node.id} {self._lines[node.lineno - 1].strip()} {node.col_offset}"
            self._replace(NAME, node, others[zlib.crc32(text.encode()) % len(others)])

    def visit_Call(self, node):
        if not isinstance(node.func, ast.Name):
            self.visit(node.func)
        if isinstance(node.func, ast.Attribute) and node.func.attr in LOOK_CALLS:
            return
        for part in [*node.args, *node.keywords]:
            self.visit(part)

    def visit_Tuple(self, node):
        if re.fullmatch(r"\(0, \([\d., ]+\)\)", ast.unparse(node)):  # a line's dashes
            return
        self.generic_visit(node)

    def visit_Compare(self, node):
        sides = [node.left, *node.comparators]
        for op, left, right in zip(node.ops, sides, sides[1:]):
            self._between(COMPARISON, left, right, *TURNED[type(op)])
            # of measured numbers both say the same but for one value in 2⁵³
            if type(op) in BOUNDARY and (_counts(left) or _counts(right)):
                self._between(COMPARISON, left, right, *BOUNDARY[type(op)])
        if len(node.ops) > 1:
            self._add(CONDITION, self._span(sides[0])[0], self._span(sides[1])[0], "")
            self._add(CONDITION, self._span(sides[-2])[1], self._span(sides[-1])[1], "")
        self.generic_visit(node)

    def visit_BoolOp(self, node):
        for value in node.values:
            self._replace(CONDITION, value, "True" if isinstance(node.op, ast.And) else "False")
        self.generic_visit(node)

    def visit_If(self, node):
        if ast.unparse(node.test) in ("TYPE_CHECKING", "__name__ == '__main__'"):
            return
        for new in ("True", "False"):
            self._replace(CONDITION, node.test, new)
        self.generic_visit(node)

    visit_IfExp = visit_If

    def visit_comprehension(self, node):
        for test in node.ifs:
            self._replace(CONDITION, test, "True")
        self.generic_visit(node)

    def visit_BinOp(self, node):
        if type(node.op) in SIGNS and not any(_is_text(side) for side in (node.left, node.right)):
            self._between(SIGN, node.left, node.right, *SIGNS[type(node.op)])
        self.generic_visit(node)

    def visit_AugAssign(self, node):
        if type(node.op) in (ast.Add, ast.Sub):
            pattern, new = SIGNS[type(node.op)]
            self._between(SIGN, node.target, node.value, pattern, new)
        self.visit(node.value)

    def visit_UnaryOp(self, node):
        begin, operand = self._span(node)[0], self._span(node.operand)[0]
        if isinstance(node.op, (ast.USub, ast.Not)):
            self._add(SIGN if isinstance(node.op, ast.USub) else CONDITION, begin, operand, "")
        self.generic_visit(node)

    def visit_Subscript(self, node):
        self.visit(node.value)
        parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        for part in parts:
            for one in (part.lower, part.upper) if isinstance(part, ast.Slice) else (part,):
                value = _whole(one)
                if value is not None:
                    self._replace(INDEX, one, str(value + 1 if value >= 0 else value - 1))
                    if value and not isinstance(part, ast.Slice):
                        self._replace(INDEX, one, str(value - 1 if value > 0 else value + 1))
                elif one is not None:
                    self.visit(one)

    def visit_Constant(self, node):
        if isinstance(node.value, bool):
            self._replace(CONSTANT, node, str(not node.value))
        elif isinstance(node.value, (int, float)):
            new = number(self.text[slice(*self._span(node))])
            if new:
                self._replace(CONSTANT, node, new)


def _own(function):
    """Nodes of a function but for those of the functions within it."""
    waiting = list(function.body)
    while waiting:
        node = waiting.pop()
        yield node
        if not isinstance(
            node, (ast.FunctionDef, ast.ClassDef, ast.Lambda, ast.ListComp, ast.GeneratorExp, ast.DictComp, ast.SetComp)
        ):
            waiting += ast.iter_child_nodes(node)


def _is_text(node):
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def _whole(node):
    """The whole number that a node says, None where it says none."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        value = _whole(node.operand)
        return None if value is None else -value
    return node.value if isinstance(node, ast.Constant) and type(node.value) is int else None


def _counts(node):
    """Whether a node is a number of things, as far as its text tells."""
    return bool(re.search(r"^len\(|\.size$|\.sum\(\)$|count|number", ast.unparse(node))) or (_whole(node) or 0) != 0
