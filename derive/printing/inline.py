"""Formulas in sentences: plain text with the letters of the paper, as ``r̄_i`` or ``∂U/∂r_i``."""

from __future__ import annotations

import re
import unicodedata

from ..record.vocabulary import VOCABULARY
from .notation import Notation
from .signs import LOWERED, MATH_ACCENTS, NAMED, RAISED, SYMBOLS
from .spelling import named
from .typeset import (
    IDENTITY,
    SUM_SIGN,
    Formula,
    accented,
    barred,
    fraction,
    hat,
    literal,
    lowered,
    operator,
    primed,
    raised,
    sans,
    upright,
)

BARS = Notation()
KNOWN = {unicodedata.normalize("NFC", name): x.latex for name, x in VOCABULARY.items()}
OPERATORS = {"Tr", "det", "div", "grad", "Ric"}
"""The names of functions before which nothing stands, as in Tr A."""
INDICES = "".join(c for c in SYMBOLS if c.isalpha() and c.islower())
"""Greek letters that may be an index, as in ∇_η′."""
TOKEN = re.compile(
    "("
    + "|".join(re.escape(name) for name in sorted(KNOWN, key=len, reverse=True) if len(name) > 1)
    + rf")(?![\u0300-\u036f])|_([A-Za-z0-9]+|[{INDICES}]′*)"
    r"|([⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+)|([₀₁₂₃₄₅₆₇₈₉ᵢⱼₑₜ]+)"
    r"|([A-Za-z]{2,})(?![\u0300-\u036f])|(.)([\u0300-\u036f]*)"
)


SCRIPTS = f"_′{''.join(RAISED)}{''.join(LOWERED)}"
BELOW, ABOVE = r"_(?:\{[^{}]*\}|\w)", r"\^\{[^{}]*\}"
SECOND = {
    "_": f"{BELOW}(?:{ABOVE}|'+)?$",
    "^": f"(?:{ABOVE}|')(?:{BELOW})?$",
    "'": f"(?:{ABOVE}(?:{BELOW})?|'{BELOW})$",
}

BELOW_STROKE = re.compile(r"/∂\S+$")
"""What ends in the denominator of a partial derivative, which a space parts from a factor."""
SKEW = re.compile(r"(?<![A-Za-z_])j\(([^()]*)\)")
"""The skew matrix of a vector, j(…), as a sentence has it."""


def math_text(formula: str) -> str:
    """The LaTeX, without dollars, of a formula of a sentence."""
    return spelt(formula).tex


def inline(formula: str, notation: Notation) -> Formula:
    """A formula of a sentence, in a notation, with j(X) as the skew matrix of X."""
    found, at = Formula(""), 0
    for match in SKEW.finditer(formula):
        found += spelt(formula[at : match.start()], notation)
        found += hat(spelt(match[1], notation), notation)
        at = match.end()
    return found + spelt(formula[at:], notation)


def spelt(formula: str, notation: Notation = BARS) -> Formula:
    """A formula of a sentence, j as any letter; letters in ‘quotes’ are those of parameters."""
    if quoted := re.fullmatch("‘([^’]*)’", formula):
        return sans(quoted[1].replace(" ", "\\ "), quoted[1])
    found = Formula("")
    tight = re.sub(rf"(^|[{SCRIPTS}\s])[\u0300-\u036f]+", r"\1", formula)
    tight = re.sub(rf"\s+(?=[{SCRIPTS}])", "", tight)
    for match in TOKEN.finditer(unicodedata.normalize("NFC", tight)):
        known, below, above, under, letters, letter, marks = match.groups()
        if below or under:
            found = lowered(_open(found, "_"), _index(below or "".join(LOWERED[c] for c in under)))
        elif above:
            found = raised(_open(found, "^"), literal("".join(RAISED[c] for c in above)))
        elif letter == "′":
            found = primed(_open(found, "'"))
        else:
            piece, rest = Formula(""), match.string[match.end() :]
            before = match.string[: match.start()]
            if known in OPERATORS or letters:
                piece = _word(known or letters, rest.lstrip()[:1])
                if (known or letters) in OPERATORS and re.search(r"[^\W\d½]\s$", before):
                    piece = Formula("", literal(r"\,").items) + piece  # LaTeX has it by itself
            elif known:
                piece = named(KNOWN[known])
            elif letter == " " and BELOW_STROKE.search(before):
                piece = literal(r"\,")
            elif letter:
                piece = _letter(letter, marks, rest, notation)
            apart = piece.tex[:1].isalpha() and re.search(r"\\[A-Za-z]+$", found.tex)
            found += Formula(" " if apart else "") + piece
    return found


def _index(letters: str) -> Formula:
    """The formula of an index: letters and figures, or a Greek letter with its primes."""
    shown = literal("".join(SYMBOLS.get(c, c) for c in letters.rstrip("′")))
    return primed(shown, letters.count("′"))


def _open(f: Formula, mark: str) -> Formula:
    """The formula with an empty base appended where it cannot bear ``mark`` a second time."""
    second = not f.tex or re.search(SECOND[mark], f.tex)
    return f + Formula("{}", ("",)) if second else f


def _word(letters: str, after: str) -> Formula:
    """The formula of several letters: a Greek name, a differential as dx, or an operator as Tr."""
    if letters in NAMED:
        return literal(rf"\{letters}")
    if len(letters) == 2 and letters != "Tr":
        return upright("d") + literal(letters[1]) if letters[0] == "d" else literal(letters)
    return operator(letters, near=after in ("", "(", "_", *RAISED, *LOWERED))


def _letter(letter: str, marks: str, rest: str, notation: Notation) -> Formula:
    """The formula of a character with its accents; R before an exponent is that of the reals."""
    base, *own = list(unicodedata.normalize("NFD", letter))
    if unicodedata.combining(base):
        return Formula("")
    shown = symbol(base)
    if letter == "R" and rest[:1] in RAISED:
        shown = Formula(r"\mathbf{R}", ('<mn class="bold">R</mn>',))
    if letter == "d" and rest[:1] in SYMBOLS and rest[0].isalpha():
        shown = upright("d")
    for mark in [*own, *marks]:
        if mark in MATH_ACCENTS and base.isalpha():
            name = MATH_ACCENTS[mark]
            tex = f"{name}{{{shown.tex}}}"
            over = barred(shown, tex, notation, letter=True)
            shown = over if name == r"\bar" else accented(name[1:], shown, tex)
    return shown


def symbol(c: str) -> Formula:
    """The formula of one character."""
    tex = SYMBOLS.get(c, c)
    if c == "Σ":
        return SUM_SIGN
    if c == "𝟏":
        return IDENTITY
    if tex.startswith((r"\mathfrak", r"\mathbb", r"\mathbf ")):
        return Formula(tex, (f"<mi>{c}</mi>",))
    if tex.startswith(r"\tfrac"):
        return fraction(literal(tex[-2]), literal(tex[-1]), tex)
    return literal(tex)
