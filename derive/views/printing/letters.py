"""Names in LaTeX: letters with what stands about them, factors side by side, macros."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable, Mapping
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any

from ...language.reserved import GREEK
from ...language.show import ATOM, SUM
from ...language.tree import Tree
from ...record.record import Symbol
from ...record.vocabulary import VOCABULARY
from .signs import STYLED, Notation, tex_text
from .typeset import (
    BEFORE_FACTOR,
    Formula,
    accented,
    barred,
    fraction,
    literal,
    lowered,
    operator,
    primed,
    raised,
    sans,
    text,
    upright,
)

# Formulas of single names: a letter with what stands before, over and below it.

NAME = re.compile(
    r"(?P<lead>(?:(?:\\delta|\\partial_t|\\mathrm\{d\})(?![A-Za-z])'?\s*)?)"
    r"(?P<over>(?:\\(?:tilde|dot|hat|bar|mathrm|mathbf)(?![A-Za-z])\s*\{?\s*)*)"
    r"(?P<letter>\\[A-Za-z]+|[A-Za-z])\}*(?P<primes>'*)"
    r"(?P<below>(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9]+\}))?)(?P<above>(?:\^[+-])?)"
)
RATE = r"\frac{\mathrm{d}}{\mathrm{d}t}"
DIFFERENTIAL = r"\mathrm{d}"
WORD = re.compile(r"\\operatorname\{([a-z]+)\}")
BOLD = {r"\mathbf m": "𝐦", r"\mathbf n": "𝐧"}
"""Points of a lattice: letters that MathML has in bold by themselves."""
BARS = Notation()


@lru_cache(1024)
def named(tex: str) -> Formula:
    """The formula of a name, from its LaTeX."""
    if tex == RATE:
        return fraction(upright("d"), upright("d") + literal("t"), RATE)
    if upright_word := WORD.fullmatch(tex):
        return operator(upright_word[1], near=True)
    plain, _, below = tex.partition("_")
    if plain in STYLED | BOLD:
        letter = Formula(plain, (f"<mi>{(STYLED | BOLD)[plain]}</mi>",))
        return _letter_in_full(tex, "", letter, "", below)
    if tex.startswith(DIFFERENTIAL) and tex.removeprefix(DIFFERENTIAL) in STYLED:
        styled = STYLED[tex.removeprefix(DIFFERENTIAL)]
        return Formula(tex, (*upright("d").items, f"<mi>{styled}</mi>"))
    found = NAME.fullmatch(tex)
    if found is None:
        return Formula(tex, literal(tex).items)
    letter = literal(found["letter"])
    for name in reversed(re.findall(r"\\([a-z]+)", found["over"])):
        if name in ("mathrm", "mathbf"):
            letter = upright(found["letter"])
        elif name == "bar":
            letter = barred(letter, "", BARS, letter=True)
        else:
            letter = accented(name, letter, "")
    whole = _letter_in_full(tex, found["lead"], letter, found["primes"], found["below"])
    if sign := found["above"].strip("^"):
        return Formula(tex, raised(whole, literal(sign)).items)
    return whole


def _letter_in_full(tex: str, lead: str, letter: Formula, primes: str, below: str) -> Formula:
    """What this LaTeX is: a letter with what stands before it, its primes and its index."""
    found = _lead(lead) + primed(letter, len(primes))
    if below:
        found = lowered(found, literal(below.strip("_{}")))
    return Formula(tex, found.items)


def _lead(tex: str) -> Formula:
    """The formula of what stands before a letter: d, ∂_t, or δ with its primes."""
    if tex.startswith(r"\mathrm"):
        return upright("d")
    if tex.startswith(r"\partial"):
        return lowered(literal(r"\partial"), literal("t"))
    return primed(literal(r"\delta"), tex.count("'")) if tex else Formula("")


SINGLE = re.compile(r"(\\delta'?\s*|)(\\[a-z]+|[A-Za-z])('*)(_.+|)")
ACCENTED = re.compile(r"(\\delta'?\s*|)(\\[a-z]+\s*(?:\\[a-z]+|[A-Za-z]))()()")


@lru_cache(1024)
def transposed(tex: str, notation: Notation) -> Formula:
    """The formula of a transposed name: a bar over its letter, not over its prime or index."""
    single = SINGLE.fullmatch(tex)
    parts = single or ACCENTED.fullmatch(tex)
    lead, inside, primes, below = parts.groups() if parts else ("", tex, "", "")
    alone = single is not None or re.fullmatch(r"\\[A-Za-z]+", inside) is not None
    over = "bar" if single else "overline"
    letter = barred(named(inside), "", notation, letter=alone)
    whole = rf"{lead}\{over}{{{inside}}}{primes}{below}"
    return _letter_in_full(whole, lead, letter, primes, below)


NAMES = {name: x.latex for name, x in VOCABULARY.items()}
HARMLESS = re.compile(
    r"(?:(?:\\delta|\\partial_t|\\mathrm\{d\})(?![A-Za-z])'?\s*)?"
    r"(?:\\(?:tilde|bar|dot|hat|mathrm|mathbf)(?![A-Za-z])\s*)?"
    rf"(?:\\(?:{'|'.join(GREEK)}|lambda|Lambda|varphi|varpi)(?![A-Za-z])|[A-Za-z])'*"
    r"(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9]+\}))?"
)


SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


def named_so(shown: str) -> str:
    """The name of a parameter as text shows it between quotes: x₁ is x_1."""
    return re.sub("[₀-₉]+$", lambda index: "_" + index[0].translate(SUBSCRIPTS), shown)


def quoted(shown: str, names: Mapping[str, str]) -> Formula:
    """The formula of a parameter as text shows it between quotes; of words, the words."""
    found = " " in shown
    return sans(shown.replace(" ", r"\ "), shown) if found else parameter(named_so(shown), names)


def names_of(symbols: Iterable[Symbol], parameters: Collection[str] = ()) -> dict[str, str]:
    """Name → LaTeX, for the names of a record: its own LaTeX where that is one harmless letter.

    Beside a parameter x_1 there may be x1, which then has no index: its key is ``par x1``.  A
    Greek letter that no name of the record has is free for parameters: its key is ``free rho``.
    """
    symbols = [*symbols]
    own = {s.name: s.latex for s in symbols if HARMLESS.fullmatch(s.latex)}
    ends = {p: re.fullmatch(r"([A-Za-z]+)([0-9]{1,3})", p) for p in parameters}
    alike = [p for p, end in ends.items() if end and f"{end[1]}_{end[2]}" in parameters]
    taken = unicodedata.normalize("NFD", "".join(["π", *(s.name for s in symbols)]))
    free = {f"free {word}": rf"\{word}" for word, letter in GREEK.items() if letter not in taken}
    return NAMES | own | {f"par {p}": p for p in alike} | (free if symbols else {})


def parameter(name: str, names: Mapping[str, str] = NAMES) -> Formula:
    """The formula of a parameter, sans serif; a short end after _, or digits, is an index."""
    if f"par {name}" in names:
        return sans(name, name)
    match = re.fullmatch(r"([A-Za-z][A-Za-z0-9]*)_([A-Za-z0-9]{1,3})", name) or re.fullmatch(
        r"([A-Za-z]+)([0-9]{1,3})", name
    )
    if match:
        return lowered(_base(match[1], names), sans(match[2], match[2]))
    if name in (*GREEK, "ell"):
        return _base(name, names)
    if re.fullmatch(r"[A-Za-z0-9_]+", name):
        return sans(name.replace("_", r"\_"), name)
    return text(rf"\text{{\textsf{{{tex_text(name)}}}}}", name)


def _base(word: str, names: Mapping[str, str]) -> Formula:
    """A word sans serif; a Greek letter as itself, where the record, or no walk at all, gives it no
    meaning; the momentum ell of a family of equilibria as ℓ."""
    if word == "ell":
        return sans(r"\ell", "ℓ")
    free = word in GREEK and (GREEK[word] not in VOCABULARY or f"free {word}" in names)
    return literal(rf"\{word}") if free else sans(word, word)


# Factors of a LaTeX product side by side: numbers, and what separates two factors.

SPACE, THIN, DOT = literal(" "), literal(r"\,"), literal(rf"{BEFORE_FACTOR} \cdot ")


def number(q: int | Fraction) -> tuple[Formula, int]:
    """A number and how tightly it holds together; a small fraction is set small."""
    level = ATOM if q >= 0 else SUM
    sign = literal("" if q > 0 else "-")
    if isinstance(q, int) or q.denominator == 1:
        return literal(str(int(q))), level
    size = "tfrac" if abs(q.numerator) < 100 and q.denominator < 100 else "frac"
    above, below = str(abs(q.numerator)), str(q.denominator)
    short = len(above) == len(below) == 1
    digits = above + below if short else f"{{{above}}}{{{below}}}"
    return sign + fraction(literal(above), literal(below), rf"\{size}{digits}"), level


def outside(tex: str) -> str:
    """The part of a LaTeX formula that is outside every brace and parenthesis."""
    inner = re.sub(r"\{[^{}]*\}|\([^()]*\)", "", tex)
    return tex if inner == tex else outside(inner)


def _simple(t: Any) -> bool:
    """Is it a letter with its marks, which stands beside another without a space?"""
    if isinstance(t, str):
        return not t.startswith("δ")
    simple = isinstance(t, tuple) and t[0] in ("T", "inv", "pow", "at", "entry", "par", "one")
    return simple and (len(t) < 2 or _simple(t[1]))


def separator(left: Tree, right: Tree) -> Formula:
    """The sign, or space, between two factors."""
    if isinstance(right, (int, Fraction)):
        return DOT
    if isinstance(left, (int, Fraction)):
        return SPACE
    if isinstance(left, tuple) and left[0] == "one":
        return THIN
    if _simple(left) and _simple(right):
        named = [isinstance(x, tuple) and x[0] == "par" for x in (left, right)]
        return THIN if any(named) else SPACE
    return literal(BEFORE_FACTOR) + THIN


# The LaTeX of notes in macros, so that a preamble may restyle every symbol.
#
# The other views keep standard commands; here each becomes a macro of ``derive.sty``, which the
# notes contain and a lecturer's own preamble may change.

INDEX = r"'*(?:_(?:\{[^{}]*\}|[A-Za-z0-9]))?'*"
BAR = re.compile(rf"\\bar(?:\{{((?:[^{{}}]|\{{[^{{}}]*\}})*)\}}|\s+([A-Za-z]))({INDEX})")
HAT = re.compile(r"\\hatmap\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}")
SKEW = re.compile(r"(?<![A-Za-z_\\{])j\(([^()]*)\)")

DEFINED = {
    "transpose": (
        "",
        2,
        {"bar": r"\bar{#1}#2", "top": r"{{#1#2}^{\top}}"},
        "the transpose of a letter, its prime or index",
    ),
    "transposeof": (
        r"\\overline(?=\{)",
        1,
        {"bar": r"\overline{#1}", "top": r"{\left(#1\right)^{\top}}"},
        "the transpose of an expression",
    ),
    "hatmap": ("", 1, {"j": "j(#1)", "wedge": r"{(#1)^{\wedge}}"}, "the skew matrix of a vector"),
    "Tr": (r"\\operatorname\{Tr\}", 0, {"": r"\operatorname{Tr}"}, "the trace"),
    "unitmatrix": (r"\\mathbf\{1\}", 0, {"": r"\mathbf{1}"}, "the identity"),
    "parameter": (r"\\mathsf(?=\{)", 1, {"": r"\mathsf{#1}"}, "a parameter of the problem"),
    "dd": (r"\\mathrm\{d\}", 0, {"": r"\mathrm{d}"}, "the exterior derivative, a differential"),
    "Liealgebra": (r"\\mathfrak\{g\}", 0, {"": r"\mathfrak{g}"}, "the Lie algebra"),
    "algebraof": (r"\\mathfrak(?=\{)", 1, {"": r"\mathfrak{#1}"}, "a classical Lie algebra"),
    "Cartanform": (r"\\varpi(?![A-Za-z])", 0, {"": r"\varpi"}, "the Cartan form"),
    "variation": (r"\\delta(?![A-Za-z])", 0, {"": r"\delta"}, "a variation"),
    "pulled": (r"\\tilde(?![A-Za-z])", 1, {"": r"\tilde{#1}"}, "pulled back to the group"),
    "rate": (r"\\dot(?![A-Za-z])", 1, {"": r"\dot{#1}"}, "the derivative along the motion"),
}
"""Macro → the command that it replaces, if one pattern has it, how many arguments, its definition
for each notation, what it is for."""


def styled(tex: str) -> str:
    """Formulas, or a text with formulas between dollars, with macros in place of commands."""
    tex = re.sub(r"\$[^$]*\$", lambda m: SKEW.sub(r"\\hatmap{\1}", m[0]), tex)
    tex = BAR.sub(r"\\transpose{\1\2}{\3}", tex)
    for macro, (pattern, *_) in DEFINED.items():
        if pattern:
            tex = re.sub(rf"{pattern}(?=([A-Za-z])?)", partial(_renamed, rf"\{macro}"), tex)
    return tex


def _renamed(macro: str, found: re.Match[str]) -> str:
    """The macro, followed by a space where a letter follows."""
    return f"{macro} " if found[1] else macro


def standard(tex: str) -> str:
    """Formulas with j(x) in place of the macro ``hatmap``: standard commands alone."""
    return HAT.sub(r"j(\1)", tex)


def definitions(notation: Notation) -> list[str]:
    """The definitions of the macros, a line each; one that a preamble has already stays."""
    chosen = {"transpose": notation.transpose, "transposeof": notation.transpose}
    chosen["hatmap"] = notation.hat
    lines = []
    for name, (_, count, bodies, meaning) in DEFINED.items():
        body, arguments = bodies[chosen.get(name, "")], f"[{count}]" if count else ""
        lines.append(rf"\providecommand{{\{name}}}{arguments}{{{body}}} % {meaning}")
    return lines
