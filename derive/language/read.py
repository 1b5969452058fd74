"""A printed formula as a tree: the inverse of :mod:`show`.

    sum      =  [−] term { (+ | −) term }
    term     =  product [ ∧ product ]
    product  =  factor { factor | / factor }
    factor   =  Tr product  |  Σᵢ term  |  atom { ‾ | power | index | (arguments) }

``show(read(s)) == s``, and ``read(show(t)) == t`` but where trees print alike; then it is the first
of these: the number 1, not the unit matrix 𝟏, where it is no factor; a letter of the walk, not a
parameter, unless the reader is told its name or it stands in ‘quotes’; a member F₁ of a family, not
an entry of the resultant; T₁ of a step in time, not an entry of T; an inverse, not the power −1;
‖a‖², not a square of ‖a‖; (−a)/b, not −(a/b).
Of a matrix two digits are two indices; [a, b] = ab − ba, and [a, b;] is a row.
Spaces between factors may be left out, ``αδt``, and an index may stand after _, ``r_i``.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import lru_cache
from unicodedata import normalize

from .derivatives import DERIVATIVES
from .show import FIELD_OPERATORS, FRACTIONS, show_name
from .tree import Tree, neg, plain

FAMILIES = frozenset({*"rmvFQdPχσκEks", "r̂", "v̇", "Π", "Π̇", "Φ", "𝒥", "𝒜", "d𝒜"})
"""Letters of families, whose members an index counts; after any other it tells an entry."""
IN_THE_BASIS = frozenset({"E", "M", "β", "ζ", "ζ̇", "ψ", "Π", "Π̇", "Φ", "𝕁"})
"""Letters that have the indices a and b; after any other these belong to its name, as in ℓ_b."""
OF_FIELDS = ("𝒜", "d𝒜")
"""Families of functions, whose members are applied to the brackets after them."""
FUNCTIONS = frozenset(
    {"dŨ", "p̃", "M̃", "ρ", "ϖ", "dϖ", "ϖ_h", "dϖ_h", "ω", "g", "δ", "δ′", "d/dt", "ω̂", "f̂"}
    | {"Ψ", "Ψ_0", "Ψ_1", "Ψ_2", "Θ⁺", "Θ⁻", "dΘ⁺", "dΘ⁻", "ℱ"}
)
"""Names that are applied to the brackets after them; others are to t and X alone."""

_OF_ELEMENTS = ("g", "δg", "δ′g", "N", "N\u0302", "A", "T", "R")
_OF_STEPS = ("U", "W", "M", "ℓ", "p", "q", "x")
NUMBERED = frozenset(
    {"f_1", "μ_1", "Γ_0", "ρ_0", "I_1", "I_2", "I_3", "Ψ_0", "Ψ_1", "Ψ_2"}
    | {f"{x}_{k}" for x in _OF_ELEMENTS for k in range(3)}
    | {f"{x}_{k}" for x in _OF_STEPS for k in range(2)}
)
"""Letters whose number belongs to the name; after any other it tells an entry or a member."""

_LETTER = r"[^\W\d_⁰¹²³⁴-⁹₀-₉½⅓¼⅔ᵢⱼₑₜ]"
_VARIED = r"(?:δ′?|∂ₜ|d(?=ϖ|𝒜|U\u0303))?"
_CALLED = "|".join(("j", *DERIVATIVES))
TOKEN = (
    r"(?P<quoted>‘[^’]*’)|(?P<opening>(?<= )‖)"
    rf"|(?P<word>Tr(?=[ (\[])|Σ(?:[ᵢⱼₑ]|_[a-z𝐦𝐧])|∫|√|det(?=\(| \w)|(?:{_CALLED})(?=\()"
    r"|(?:grad|div)(?![A-Za-z])|Δ(?![\u0300-\u036f])|∇_|∇|∂ₙ)"
    rf"|(?P<name>d/dt|∂_s|d?Θ[⁺⁻]|{'|'.join(sorted(NUMBERED))}|(?!dm(?![A-Za-z])){_VARIED}{_LETTER}[\u0300-\u036f]*′?(?:_(?:[abij][abij]|[A-Za-z]))?)"
    r"|(?P<index>[₀-₉ᵢⱼₑ]+(?:,[₀-₉ᵢⱼₑ]+)*)"
    r"|(?P<power>⁻?[⁰¹²³⁴-⁹]+)"
    r"|(?P<number>\d+(?:/[1-9]\d*)?|½)"
    r"|(?P<mark>dm(?![A-Za-z])|\S)"
)
BEGIN = frozenset({"quoted", "word", "name", "number", "parameter", "opening", *"(⟨‖|[/·"})
MACRON = "\u0304"
DIGITS = str.maketrans("₀₁₂₃₄₅₆₇₈₉ᵢⱼₑ⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789ije0123456789-")
SMALL = {text: q for q, text in FRACTIONS.items()}


class FormulaError(ValueError):
    """A text that is no formula: the message says which, and where."""


@lru_cache(2**10)
def read(text: str, *parameters: str) -> Tree:
    """The tree of a formula, ``FormulaError`` for any other text; ``parameters``: the names that
    stand for those of the problem."""
    reader = _Reader(normalize("NFD", text), {show_name(x): x for x in parameters})
    found = reader.sum()
    reader.take("")
    return found


def _tokens(text: str, parameters: dict[str, str]) -> list[tuple[str, str]]:
    """The tokens of a formula as (kind, text); a parameter of several letters is one."""
    long = "|".join(sorted((re.escape(x) for x in parameters if len(x) > 1), key=len, reverse=True))
    own = rf"(?P<parameter>(?<!\w)(?:{long})(?![A-Za-z0-9_₀-₉′]))|" if long else ""
    found = ((str(m.lastgroup), m[0]) for m in re.finditer(own + TOKEN, text))
    return [(x if kind == "mark" else kind, x) for kind, x in found] + [("end", "")] * 3


class _Reader:
    """The parser of one formula: its tokens, how far they are read, and a method for each level of
    the grammar."""

    def __init__(self, text: str, parameters: dict[str, str]) -> None:
        self.text, self.tokens, self.k = text, _tokens(text, parameters), 0
        self.parameters, self.strokes = parameters, ""

    def next(self) -> str:
        """Go past the token that stands here, and give its text."""
        self.k += 1
        return self.tokens[self.k - 1][1]

    def met(self, wanted: str) -> bool:
        """Go past a token if it stands here, and say whether it did."""
        here = self.tokens[self.k][1] == wanted
        self.k += here
        return here

    def take(self, wanted: str) -> None:
        """Go past a token; ``FormulaError`` if another stands here."""
        if not self.met(wanted):
            raise self.error(wanted or "the end")

    def error(self, wanted: str) -> FormulaError:
        """The error that says what is expected here."""
        rest = "".join(text for _, text in self.tokens[self.k :]) or "the end"
        return FormulaError(f"{self.text!r}: {wanted} is expected at {rest}")

    def sum(self, strokes: str = "") -> Tree:
        """A sum, of terms with their signs; ``strokes``: those between which it stands, if any."""
        outer, self.strokes = self.strokes, strokes
        terms = [_minus(self.term()) if self.met("−") else self.term()]
        while self.tokens[self.k][0] in ("+", "−"):
            terms.append(_minus(self.term()) if self.next() == "−" else self.term())
        self.strokes = outer
        return terms[0] if len(terms) == 1 else ("add", *terms)

    def term(self) -> Tree:
        """A term: a product, or two with ∧ between them."""
        left = self.product()
        return ("wedge", left, self.product()) if self.met("∧") else left

    def product(self) -> Tree:
        """A product of factors; what stands before / is divided by the factor after it."""
        factors = [self.factor()]
        while (kind := self.tokens[self.k][0]) in BEGIN and kind != self.strokes:
            if self.met("/"):
                factors = [("div", _of_factors(factors), self.factor())]
            else:
                self.met("·")
                factors.append(self.factor())
        return _of_factors(factors)

    def factor(self) -> Tree:
        """A factor: Tr and Σ of what follows, or an atom with what stands behind it."""
        if self.met("Tr"):
            return ("tr", self.product())
        if self.tokens[self.k][1].startswith("Σ"):
            return ("sum", self.next()[-1].translate(DIGITS), self.term())
        found = self.atom()
        while True:
            kind, _ = self.tokens[self.k]
            if kind == "(" and self._applied(found):
                found = ("call", found, *self.listed("(", ")"))
            elif kind in ("‾", "index", "power"):
                found = _behind(found, kind, self.next())
            else:
                return found

    def _applied(self, t: Tree) -> bool:
        """Is a tree a function, or applied to t or X, before the parenthesis that stands here?"""
        inside = "".join(text for _, text in self.tokens[self.k : self.k + 3])
        name = isinstance(t, str) or (isinstance(t, tuple) and t[0] == "at")
        of_fields = isinstance(t, tuple) and t[0] == "at" and t[1] in OF_FIELDS
        of_place = t in ("T", "ζ") and inside.lstrip("(−")[:1] in ("𝐦", "𝐧")
        applied = t in FUNCTIONS or of_fields or of_place
        return applied or (name and inside in ("(t)", "(X)"))

    def listed(self, opening: str, closing: str, count: int = 0) -> list[Tree]:
        """The sums between brackets, with commas between them: ``count`` of them, if that is
        not 0."""
        self.take(opening)
        found = [self.sum()]
        while len(found) != count and self.met(","):
            found.append(self.sum())
        self.take(closing if len(found) >= count else ",")
        return found

    def atom(self) -> Tree:
        """An atom: a name, a number, or something in brackets of any kind."""
        kind, text = self.tokens[self.k]
        if kind == "name":
            return self.named(self.next())
        if kind == "number":
            q = SMALL.get(self.next()) or Fraction(text)
            return ("one",) if text == "𝟏" else plain(q)
        if kind in ("parameter", "quoted"):
            return ("par", self.parameters.get(self.next(), text))
        if kind == "word":
            return self.worded(self.next())
        if kind == "(":
            return self.listed("(", ")", 1)[0]
        if kind == "⟨":
            return self.measured("metric", "inner", *self.listed("⟨", "⟩", 2))
        if kind == "[":
            return self.rows()
        if self.met("|"):
            inside = self.sum("|")
            self.take("|")
            return ("fun", "sqrt", ("pow", inside, 2))
        if not self.met("‖"):
            raise self.error("a factor")
        inside = self.sum("‖")
        self.take("‖")
        squared = self.measured("norm2", "norm2", inside) if self.met("²") else None
        return squared or ("fun", "sqrt", ("norm2", inside))

    def measured(self, with_metric: str, without: str, *found: Tree) -> Tree:
        """The tree of ⟨·, ·⟩ or ‖·‖², with the metric that stands behind _, if one does."""
        return (with_metric, self.atom(), *found) if self.met("_") else (without, *found)

    def worded(self, text: str) -> Tree:
        """The tree behind a word: ∫ … dm, and functions with a name of their own."""
        if text == "∫":
            found = 1 if self.tokens[self.k][0] == "dm" else self.sum()
            self.take("dm")
            return ("call", "∫", found)
        if text == "∇_":
            inside = self.tokens[self.k][0] == "("
            return ("nabla", *(self.listed("(", ")", 1) if inside else [self.named(self.next())]))
        if text in FIELD_OPERATORS and self.tokens[self.k][0] not in BEGIN:
            return text
        if text in FIELD_OPERATORS:
            inside = self.tokens[self.k][0] == "("
            return ("call", text, *(self.listed("(", ")", 1) if inside else [self.factor()]))
        if text == "det" and self.tokens[self.k][0] != "(":
            return ("det", self.factor())
        own = {"det": ("det",), "j": ("hat",), "√": ("fun", "sqrt")}.get(text, ("fun", text))
        return (*own, *self.listed("(", ")", 1))

    def rows(self) -> Tree:
        """The tree of [a, b], or of a matrix by its rows."""
        self.take("[")
        rows: list[list[Tree]] = [[self.sum()]]
        while (mark := self.next()) in (";", ","):
            rows += [[]] if mark == ";" else []
            if self.tokens[self.k][0] != "]":
                rows[-1].append(self.sum())
        self.k -= 1
        self.take("]")
        if len(rows) == 1 and len(rows[0]) == 2:
            return ("bracket", *rows[0])
        return ("matrix", *(("row", *row) for row in rows if row))

    def named(self, text: str) -> Tree:
        """The tree of a letter with its marks, and the index behind it: parameters have none."""
        name, index = normalize("NFC", text.replace(MACRON, "")), ""
        base, _, behind = name.partition("_")
        if behind and {*behind} <= ({*"abije"} if base in IN_THE_BASIS else {*"ijke"}):
            name, index = base, behind
        if self.tokens[self.k][0] == "index":
            index += self.next()
        if name + index in self.parameters:
            return ("par", self.parameters[name + index])
        if index and (whole := f"{name}_{index.translate(DIGITS)}") in NUMBERED:
            name, index = whole, ""
        member = name in FAMILIES and index
        found: Tree = ("at", name, *_numbers(index)) if member else name
        found = ("T", found) if MACRON in text else found
        entry = [] if member else _numbers(index, pair=name.lstrip("δ′")[:1].isupper())
        return ("entry", found, *entry) if entry else found


def _numbers(text: str, pair: bool = False) -> list[Tree]:
    """What an index says, letters and numbers; two digits behind a matrix (``pair``) are two
    numbers."""
    each = r"\d|[a-z]" if pair and len(text) == 2 else r"\d+|[a-z]"
    return [int(x) if x.isdigit() else x for x in re.findall(each, text.translate(DIGITS))]


def _behind(t: Tree, kind: str, text: str) -> Tree:
    """The entry, power, inverse or transpose of a tree, as the token behind it says."""
    if kind == "index":
        return ("entry", t, *_numbers(text))
    if kind == "power" and text != "⁻¹":
        return ("pow", t, int(text.translate(DIGITS)))
    return ("inv" if kind == "power" else "T", t)


def _of_factors(factors: list[Tree]) -> Tree:
    """The tree of a product; beside other factors, 1 is the unit matrix."""
    beside = (("one",) if f == 1 else f for f in factors)
    return ("mul", *beside) if len(factors) > 1 else factors[0]


def _minus(t: Tree) -> Tree:
    """The opposite of a tree, with the sign above a fraction's line."""
    if isinstance(t, tuple) and t[0] == "div":
        return ("div", neg(t[1]), t[2])
    return neg(t)
