"""Changes of single tokens in C++, found in its tokens: enough for sources that clang-format has put in order, with
spaces around operators of two sides alone.

Each stands in an expression or a statement, its reach, which becomes one branch of a switch (see mutant.py). Not all
that looks like an expression is one that can be a branch: what the compiler refuses is no mutant, and
`random_mutants.py` leaves it out.
"""
import re

from changes import COMPARISON, CONDITION, CONSTANT, SIGN, change, number

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<directive>^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*)|(?P<string>R"\((?:.*?)\)"|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
    |(?P<number>(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[uUlLfF]*)|(?P<word>[A-Za-z_]\w*)
    |(?P<sign>->|::|<<=|>>=|\+\+|--|&&|\|\||[-+*/%&|^=!<>]=|<<|>>|[^\s\w])""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "=="}
BOUNDARY = {"<": "<=", ">": ">=", "<=": "<", ">=": ">"}
SIGNS = {"+": "-", "-": "+", "*": "/", "/": "*"}
ASSIGNED = ("=", "+=", "-=", "*=", "/=", "|=", "&=")
STOPS = (*ASSIGNED, ";", "{", "}", "return", "?", ":", "else", "case")
# no computing, or before a program runs
LEFT_ALONE = (
    "constexpr",
    "static_assert",
    "template",
    "using",
    "namespace",
    "enum",
    "case",
    "operator",
    "goto",
    "friend",
    "extern",
)
MACRO = re.compile(r"[A-Z][A-Z0-9_]{3,}$")  # of YADE's classes, registries and messages
PAIRS = {"(": ")", "[": "]", "{": "}"}


def changes(file, text):
    """A list of Changes of one file of C++."""
    return _Finder(file, text).find()


class _Finder:
    def __init__(self, file, text):
        self.file, self.text = file, text
        every = list(TOKEN.finditer(text))
        self.tokens = [m for m in every if m.lastgroup not in ("comment", "directive")]
        self.words = [m[0] if m.lastgroup != "string" else '""' for m in self.tokens]
        self.other = self._partners()
        self.alone = self._left_alone() | self._compiled_perhaps([m for m in every if m.lastgroup == "directive"])
        self.types = self._in_types()
        self.found = []

    def _partners(self):
        """{index of a bracket: index of its partner}."""
        other, open_ = {}, []
        for k, word in enumerate(self.words):
            if word in PAIRS:
                open_.append(k)
            elif word in PAIRS.values() and open_:
                other[k] = open_.pop()
                other[other[k]] = k
        return other

    def _left_alone(self):
        """Indices of tokens in macros of YADE's and in statements that are no computing."""
        alone = set()
        for k, word in enumerate(self.words):
            if MACRO.match(word) and self.words[k + 1 : k + 2] == ["("]:
                alone |= set(range(k, self.other.get(k + 1, k + 1) + 1))
            elif word in LEFT_ALONE:
                end = k
                while end < len(self.words) and self.words[end] not in (";", "{", ":"):
                    end += 1
                if word == "enum":  # its values too
                    end = self.other.get(self.words.index("{", k), end) if "{" in self.words[k:] else end
                alone |= set(range(k, end + 1))
        return alone

    def _compiled_perhaps(self, directives):
        """Indices of tokens between #if and #endif: YADE's features say which of them are compiled."""
        spans, open_ = [], []
        for directive in directives:
            word = re.match(r"\s*#\s*(\w+)", directive[0])[1]
            if word in ("if", "ifdef", "ifndef"):
                open_.append(directive.end())
            elif word == "endif" and open_:
                spans.append((open_.pop(), directive.start()))
        return {k for k, m in enumerate(self.tokens) if any(first <= m.start() < last for first, last in spans)}

    def _in_types(self):
        """Indices of tokens that a type asks for: between the angle brackets of a template, and an array's size."""
        found, open_ = set(), []
        for k, (token, word) in enumerate(zip(self.tokens, self.words)):
            before, after = self.text[token.start() - 1 : token.start()], self.text[token.end() : token.end() + 1]
            if word == "<" and not before.isspace():
                open_.append(k)
            elif word in (">", ">>") and not (before.isspace() and after.isspace()):
                for _ in word[: len(open_)]:
                    found |= set(range(open_.pop(), k + 1))
            elif word in (";", "{"):
                open_.clear()
            elif word == "[" and re.match(r"[A-Za-z_>]", self.words[k - 2]) and self.words[k - 1].isidentifier():
                # "double x[3]"; a word before an element begins a statement or is an operator
                if self.words[k - 2] not in ("return", "else", "do", "throw", "case", "and", "or", "not"):
                    found |= set(range(k, self.other.get(k, k) + 1))
        return found

    def _reach(self, k):
        """First and last index of the least expression around a token: all between brackets, commas, assignments and
        ends of statements; None where there is none.
        """
        first = last = k
        while first > 0 and self.words[first - 1] not in (*STOPS, ",", "(", "["):
            first = self.other[first - 1] if self.words[first - 1] in (")", "]") else first - 1
            if self.words[first - 1 : first] and self.words[first - 1] == "if":
                first = self.other[first] + 1  # what follows the brackets of a condition begins a statement
                break
        while last + 1 < len(self.words) and self.words[last + 1] not in (*STOPS, ",", ")", "]"):
            last = self.other.get(last + 1, last + 1) if self.words[last + 1] in ("(", "[") else last + 1
        if first > k or last >= len(self.words) - 1 or self.words[last + 1] in (*ASSIGNED, "{", "}"):
            return None
        inside = self.words[first : last + 1]
        if set(inside) & {"{", "}", ";", "auto", "const"} or any(m in self.alone for m in range(first, last + 1)):
            return None
        return first, last

    def _add(self, kind, k, begin, end, new):
        reach = self._reach(k)
        if reach and not (kind == SIGN and '""' in self.words[reach[0] : reach[1] + 1]):  # words are put together there
            span = self.tokens[reach[0]].start(), self.tokens[reach[1]].end()
            self.found.append(change(self.file, self.text, kind, "", begin, end, new, span))

    def find(self):
        for k, (token, word) in enumerate(zip(self.tokens, self.words)):
            if k in self.alone or k in self.types or k in (0, len(self.words) - 1):
                continue
            begin, end = token.span()
            apart = self.text[begin - 1].isspace() and self.text[end : end + 1].isspace()
            if token.lastgroup == "number":
                new = number(word)
                if new:
                    self._add(CONSTANT, k, begin, end, new)
            elif word in ("true", "false"):
                self._add(CONSTANT, k, begin, end, "false" if word == "true" else "true")
            elif apart and word in TURNED:
                self._add(COMPARISON, k, begin, end, TURNED[word])
                if word in BOUNDARY and self._counts(k):
                    self._add(COMPARISON, k, begin, end, BOUNDARY[word])
            elif apart and word in SIGNS:
                self._add(SIGN, k, begin, end, SIGNS[word])
            elif word == "-" and not apart and self.words[k - 1] not in (")", "]"):
                self._add(SIGN, k, begin, end, "")
            elif (
                word == "!"
            ):  # of two, since both branches of a switch must be of one type, and what it denies may be a pointer
                self._add(CONDITION, k, begin, end, "!!")
            elif apart and word in ("&&", "||"):
                self._drop(k, word)
            elif word == "if" and self.words[k + 1] == "(":
                self._decide(k + 1)
        return self.found

    def _counts(self, k):
        """Whether a whole number stands beside a comparison."""
        return any(re.fullmatch(r"\d+u?", self.words[m]) for m in (k - 1, k + 1))

    def _drop(self, k, word):
        """Drops what stands on either side of "and" or "or", where its expression has no other of the two words."""
        reach = self._reach(k)
        if not reach:
            return
        first, last = reach
        parts, m = [first - 1], first
        while m <= last:
            if self.words[m] in ("&&", "||"):
                if self.words[m] != word:
                    return
                parts.append(m)
            m = self.other[m] + 1 if self.words[m] in ("(", "[") else m + 1
        parts.append(last + 1)
        at, neutral = parts.index(k), "true" if word == "&&" else "false"
        for left, right in ((parts[at - 1], k), (k, parts[at + 1])):
            if left != first - 1 and right == k:
                continue  # it was the right side of the one before
            begin, end = self.tokens[left + 1].start(), self.tokens[right - 1].end()
            self._add(CONDITION, k, begin, end, neutral)

    def _decide(self, k):
        """A condition in brackets at ``k`` that always holds, and one that never does."""
        first, last = k + 1, self.other[k] - 1
        if self._reach(first) != (first, last):
            return  # it declares a name
        for new in ("true", "false"):
            self._add(CONDITION, first, self.tokens[first].start(), self.tokens[last].end(), new)
