"""Sentences read back: what each format shows, as one line of letters, numbers and signs.

No spaces; an index stands after _, an exponent after ^, a bar or a point over a letter behind it, a
parameter in ⟦brackets⟧ without its stroke.
"""

import re
import unicodedata
from fractions import Fraction
from html import unescape
from xml.etree import ElementTree

from derive.views.printing.sentences import FORMULA
from tests.readers import latex, mathml, text
from tests.readers.formula import GREEK, Letters, UnreadableError, _Reader, joined

LOW = dict(zip("₀₁₂₃₄₅₆₇₈₉ᵢⱼₑₜ", "0123456789ijet", strict=True))
HIGH = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-", strict=True))
HALVES = {"½": "1/2", "⅓": "1/3", "¼": "1/4", "⅔": "2/3"}
ACCENTS = {"`": "\u0300", "'": "\u0301", "^": "\u0302", "~": "\u0303", "=": "\u0304",
           ".": "\u0307", '"': "\u0308", "u": "\u0306", "c": "\u0327"}  # fmt: skip
COMMANDS = {
    r"\opened{}": "«", r"\closed{}": "»", r"\dots{}": "…", r"\textless{}": "<", r"\oe{}": "œ",
    r"\textgreater{}": ">", r"\S{}": "§", "---": "—", "--": "–", "``": "“", "''": "”", "`": "‘",
    "'": "’", "~": " ", r"\,": " ",
}  # fmt: skip


def plain(words, known):
    """What a sentence says, as the record has it: parameters in ‘quotes’."""
    parts = re.split("‘([^’]+)’", re.sub(r"√([A-Z]\(.*?\))", r"√(\1)", words))
    parts[::2] = map(_signs, parts[::2])
    parts[1::2] = (_parameter(x, known) for x in parts[1::2])
    return _joined("".join(parts))


def _parameter(shown, known):
    """A parameter; one that is called as a Greek letter is that letter, where the walk has none."""
    base, index = re.fullmatch("(.*?)_?([0-9₀-₉]*)", shown).groups()
    letter, below = GREEK.get(base, ""), "".join(LOW.get(c, c) for c in index)
    if not letter or any(letter in x for x in known.letters):
        return f"⟦{base}{below}⟧".replace("_", "")
    return f"{letter}_⟦{below}⟧" if below else letter


def _signs(words):
    """Words and formulas, with marks for what stands above and below."""
    words = re.sub(f"[{''.join(LOW)}]+", lambda m: "_" + "".join(LOW[c] for c in m[0]), words)
    words = re.sub(f"[{''.join(HIGH)}]+", lambda m: "^" + "".join(HIGH[c] for c in m[0]), words)
    words = re.sub(f"[{''.join(HALVES)}]", lambda m: HALVES[m[0]], words)
    return words.replace("−", "-").replace("'", "’").replace("𝔤*", "𝔤^*")


def _joined(line):
    line = re.sub(r"\d+[.,]\d+", lambda m: str(Fraction(m[0].replace(",", "."))), line)
    return re.sub(r"\s", "", unicodedata.normalize("NFD", line.replace("⟧_⟦", "")))


def of_latex(tex, known):
    """A sentence in LaTeX, its formulas between dollars."""
    tex = re.sub(r"\\ensuremath\{((?:[^{}]|\{.*?\})*)\}", r"$\1$", tex)
    words, *others = re.split(r"(?<!\\)\$", tex)
    found = _words(words)
    for k, x in enumerate(others):
        found += _words(x) if k % 2 else flat(latex.tokens(x, known))
    return _joined(found)


def of_markdown(text, known):
    """A sentence in Markdown."""
    text = re.sub(r"\\([\\`*_{}\[\]#|~$])", r"\1", unescape(text)) if "$" not in text else text
    return _joined(
        "".join(
            flat(latex.tokens(x, known)) if k % 2 else _signs(unescape(re.sub(r"\\(.)", r"\1", x)))
            for k, x in enumerate(text.split("$"))
        )
    )


def of_html(markup, known):
    """A sentence as markup, its formulas in MathML."""
    found = ""
    for x in re.split("(<math>.*?</math>)", markup):
        if x.startswith("<math>"):
            root = ElementTree.fromstring(x)
            found += flat([token for child in root for token in mathml.tokens(child, known)])
        else:
            found += _signs(unescape(re.sub("<[^>]*>", "", x)))
    return _joined(found)


def _words(tex):
    """The words of a text in LaTeX."""
    tex = re.sub(
        r"""\\(['`^"~=.uc])\{\\?([A-Za-z])\}""",
        lambda m: unicodedata.normalize("NFC", m[2] + ACCENTS[m[1]]),
        tex,
    )
    for command, shown in COMMANDS.items():
        tex = tex.replace(command, shown)
    tex = re.sub(r"\\([_#%&{}])", r"\1", tex).replace("{}", "")
    if "\\" in tex:
        raise UnreadableError(tex)
    return _signs(tex)


def flat(tokens):
    """The tokens of a formula as a line."""
    return "".join(_flat(kind, value) for kind, value in tokens)


def _flat(kind, value):
    if kind == "sub":
        return f"_{flat(value)}"
    if kind == "sup":
        above = flat(value)
        return f"^({above})" if "/" in above else f"^{above}"
    if kind == "bar":
        return f"{flat(value)}\u0304"
    if kind == "prime":
        return "′" * value
    if kind == "norm":
        return "‖"
    if kind == "size":
        return "|"
    if kind == "root":
        return f"√({flat(value)})"
    if kind == "par":
        return f"⟦{value.replace('_', '')}⟧"
    if (kind, value) == ("op", ","):
        return ", "  # what has no space is a decimal
    return _tree(value) if kind in ("tree", "number") else value


def _tree(t):
    """What the readers of formulas have read whole."""
    if t == ("one",):
        return "𝟏"
    if isinstance(t, (int, Fraction)):
        return str(t)
    if isinstance(t, str):
        return t
    if t[0] == "hat":
        return f"j({_tree(t[1])})"
    raise UnreadableError(t)


# -- the formulas of a sentence, read as trees ----------------------------------------------------

RELATIONS = {"=", "≠", "<", ">", "≤", "≥", "≈", "∈", "↦", ":", "≅"}
LISTED = {",", ";"}
MASS = ("name", "dm")
OPERATORS = {"δ", "δ′", "grad", "div", "∇"}
ENDS_ABOVE = {"+": "⁺", "-": "⁻", "*": "*"}
CALLED = ("P",)
"""Functions that sentences alone have."""
BARE = {"log", "exp", "sqrt"}
ENDS, END = ("end", "close", "op"), ("end", "")


class _Statements(_Reader):
    """Descends from what sentences have beside the equations of steps: lists, relations, tuples,
    compositions, operators by themselves."""

    def listed_statements(self):
        found = [self.statement()]
        while self.peek()[0] == "op" and self.peek()[1] in LISTED:
            found.append((self.take()[1], self.statement()))
        return found[0] if len(found) == 1 else ("list", *found)

    def statement(self):
        sides = [self.sum()]
        while self.peek()[0] == "op" and self.peek()[1] in RELATIONS:
            sides += [self.take()[1], self.sum()]
        return sides[0] if len(sides) == 1 else ("holds", *sides)

    def term(self):
        left = super().term()
        while self.peek() in (("op", "∘"), ("op", "×")):
            left = (self.take()[1], left, super().term())
        return left

    def sum(self):
        return ("±", super().sum()) if self.passed(("op", "±")) else super().sum()

    def of_open(self, mark):
        if mark != "(":
            return super().of_open(mark)
        inside = self.listed_statements()
        self.take(("close", ")"))
        return inside

    def called(self, tree):
        return tree in CALLED or super().called(tree)

    def of_root(self, tokens):
        return ("fun", "sqrt", statement(tokens, self.known))

    def of_name(self, name):
        if name in OPERATORS and (self.peek()[0] in ENDS or str(self.peek()[1]) in OPERATORS):
            return name
        if name == "grad" and self.peek()[0] == "sub":
            return (name, flat(self.take()[1]), self.factor())
        return super().of_name(name)

    def of_word(self, word):
        """A function by itself, or before its argument without brackets; a partial derivative."""
        raised = self.peek()[0] == "sup"
        kind, value = self.tokens[self.at + raised] if self.at + raised < len(self.tokens) else END
        if kind in ENDS:
            return word
        if word in ("∂", "d"):
            return (word, self.factor())
        if word == "∫":
            ends = [flat(self.take()[1]), flat(self.take()[1])]
            return (word, *ends, self.sum())
        if word == "Σ" and kind != "sub":
            return ("sum", "", self.term())
        if word in BARE and value != "(":
            return ("fun", word, self.factor())
        return self.of_name(word) if word in OPERATORS else super().of_word(word)

    def raised(self, tree, tokens):
        end = ENDS_ABOVE.get(flat(tokens)) if isinstance(tokens, list) else None
        return f"{tree}{end}" if end else super().raised(tree, tokens)


def statement(tokens, known, raw=True):
    """The tree of what a formula of a sentence says."""
    tokens = joined(tokens, known) if raw else tokens
    reader = _Statements([MASS if x == ("word", "dm") else x for x in tokens], known)
    tree = reader.listed_statements()
    if reader.at < len(reader.tokens):
        raise UnreadableError(f"left over: {reader.tokens[reader.at :][:4]}")
    return tree


def formulas(shown, kind, known):
    """The tokens of each formula of a sentence, as a format has it; in text it is between marks."""
    if kind == "text":
        return [text.tokens(x, known) for x in shown.split(FORMULA)[1::2]]
    if kind == "html":
        return [mathml.all_tokens(x, known) for x in re.findall("<math>.*?</math>", shown)]
    return [latex.tokens(x, known) for x in re.findall(r"(?<!\\)\$(.*?)(?<!\\)\$", shown)]


def with_quoted(known, said):
    """The letters of a record, with the parameters that a sentence has in ‘quotes’: inputs and
    outputs are none of its equations'."""
    found = re.findall("‘([^’]+)’", said)
    quoted = {re.sub("[₀-₉]+", lambda m: f"_{_low(m[0])}", x) for x in found}
    return Letters(known.letters, known.parameters | quoted, known.moments)


def _low(index):
    return "".join(LOW[c] for c in index)
