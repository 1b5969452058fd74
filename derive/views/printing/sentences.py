"""Sentences for LaTeX and Markdown: their formulas, which stand between marks, are typeset."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Mapping

from ...record.vocabulary import VOCABULARY
from .letters import NAMES, named, quoted
from .letters import NAMES as KNOWN
from .signs import LOWERED, MATH_ACCENTS, RAISED, SYMBOLS, WORD, Notation, decomposed, tex_text
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
    root,
    upright,
)

# Formulas in sentences: plain text with the letters of the paper, as ``r̄_i`` or ``∂U/∂r_i``.

BARS = Notation()
LATEX_OF_NAMES = {unicodedata.normalize("NFC", name): x.latex for name, x in VOCABULARY.items()}
NAMED_OPERATORS = {"Tr", "det", "div", "grad", "Ric"}
"""The names of functions before which nothing stands, as in Tr A."""
INDICES = "".join(c for c in SYMBOLS if c.isalpha() and c.islower())
"""Greek letters that may be an index, as in ∇_η′."""
TOKEN = re.compile(
    "("
    + "|".join(
        re.escape(name) for name in sorted(LATEX_OF_NAMES, key=len, reverse=True) if len(name) > 1
    )
    + r")(?![\u0300-\u036f])|‘([^’]*)’|√(?:\(([^()]*)\)|([A-Z]\([^()]*\)))|([0-9]+(?:[.,][0-9]+)?)"
    rf"|_([A-Za-z0-9]+|[{INDICES}]′*)"
    r"|([⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+|\^(?:∞|\([^()]*\)))|([₀₁₂₃₄₅₆₇₈₉ᵢⱼₑₜ]+)"
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
INTEGRAL = re.compile(r"(∫\S*) (?:(\S+) )?(d\w) / (\S+)")
"""The integral of a quotient, whose differential stands above, perhaps after a factor."""


def inline(formula: str, notation: Notation, names: Mapping[str, str] = NAMES) -> Formula:
    """A formula of a sentence, in a notation, with j(X) as the skew matrix of X; ``names``: as in
    spelt."""
    found, at = Formula(""), 0
    for match in SKEW.finditer(formula):
        found += spelt(formula[at : match.start()], notation, names)
        found += hat(spelt(match[1], notation, names), notation)
        at = match.end()
    return found + spelt(formula[at:], notation, names)


def spelt(formula: str, notation: Notation = BARS, names: Mapping[str, str] = NAMES) -> Formula:
    """A formula of a sentence, j as any letter; what stands in ‘quotes’ is a parameter, whose own
    LaTeX is in ``names``."""
    if integral := INTEGRAL.fullmatch(formula):
        sign, factor, differential, under_it = (
            spelt(part or "", notation, names) for part in integral.groups()
        )
        over_it = factor + literal(r"\,") + differential if factor.tex else differential
        return sign + fraction(over_it, under_it)
    found = Formula("")
    tight = re.sub(rf"(^|[{SCRIPTS}\s])[\u0300-\u036f]+", r"\1", formula)
    tight = re.sub(rf"\s+(?=[{SCRIPTS}])", "", tight)
    for match in TOKEN.finditer(unicodedata.normalize("NFC", tight)):
        known, own, inside, called, number, below, above, under = match.groups()[:8]
        letters, letter, marks = match.groups()[8:]
        if own:
            found += quoted(own, names)
        elif inside or called:
            found += root(spelt(inside or called, notation, names))
        elif number:
            found += Formula(number.replace(",", "{,}"), (f"<mn>{number}</mn>",))
        elif below or under:
            found = lowered(_open(found, "_"), _index(below or "".join(LOWERED[c] for c in under)))
        elif above:
            exponent = "".join(RAISED.get(c, c) for c in above.strip("^()"))
            found = raised(_open(found, "^"), spelt(exponent, notation, names))
        elif letter == "′":
            found = primed(_open(found, "'"))
        elif letter == "*":
            found = raised(_open(found, "^"), literal(letter))
        else:
            piece, rest = Formula(""), match.string[match.end() :]
            before = match.string[: match.start()]
            if known in NAMED_OPERATORS or letters:
                piece = _word(known or letters, rest.lstrip()[:1])
                if (known or letters) in NAMED_OPERATORS and re.search(r"[^\W\d½]\s$", before):
                    piece = Formula("", literal(r"\,").items) + piece  # LaTeX has it by itself
            elif known:
                piece = named(LATEX_OF_NAMES[known])
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


GROUPS = ("SO", "SE", "SL", "GL", "SU", "Sp")
"""Groups of matrices, upright before their dimension."""


def _word(letters: str, after: str) -> Formula:
    """The formula of several letters: a differential as dx, or an operator as Tr."""
    if len(letters) == 2 and letters != "Tr" and not (letters in GROUPS and after == "("):
        return upright("d") + literal(letters[1]) if letters[0] == "d" else literal(letters)
    return operator(letters, near=after in ("", "(", "_", *RAISED, *LOWERED))


def _letter(letter: str, marks: str, rest: str, notation: Notation) -> Formula:
    """The formula of a character with its accents; d before a letter is upright."""
    base, *own = [*decomposed(letter)]
    if unicodedata.combining(base):
        return Formula("")
    shown = symbol(base)
    if letter == "d" and rest[:1].isalpha():
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
    if tex.startswith((r"\mathfrak", r"\mathbb", r"\mathcal", r"\mathbf ")):
        return Formula(tex, (f"<mi>{c}</mi>",))
    if tex.startswith(r"\tfrac"):
        return fraction(literal(tex[-2]), literal(tex[-1]), tex)
    return literal(tex)


FORMULA = "\ue002"
"""What stands before and after each formula of a sentence that is to be typeset."""
PLAIN = "+=<>/(),[].:;|*0123456789 "
QUOTED = re.compile(r"‘[^\W\d][\w ]*’")
"""A parameter."""


def dollars(formula: str, names: Mapping[str, str] = KNOWN) -> str:
    """A formula of a sentence as LaTeX between dollars; ``names``: the LaTeX of a record's own."""
    return f"${shown}$" if (shown := spelt(formula, names=names).tex) else ""


def prose(
    words: str,
    escape: Callable[[str], str] = tex_text,
    formula: Callable[[str], str] = dollars,
) -> str:
    """A sentence whose formulas stand between marks, as ``formula`` shows them, and the rest
    escaped; with it what stands there and can be none."""
    parts = words.split(FORMULA)
    parts[::2] = [WORD.sub(lambda found: escape(found[0]), x) for x in parts[::2]]
    parts[1::2] = [formula(x) if _allowed(x) else escape(x) for x in parts[1::2]]
    return "".join(parts)


def _allowed(word: str) -> bool:
    """Has the word letters and signs alone that formulas can have, and no index left open?"""
    return bool(word) and all(
        (c.isascii() and c.isalpha()) or c in SYMBOLS or c in RAISED or c in LOWERED
        or c in MATH_ACCENTS or c in PLAIN or c in "_^"
        for c in decomposed(QUOTED.sub("x", word))
    ) and re.search(rf"_(?![A-Za-z0-9{INDICES}])|[A-Za-z]{{9}}", word) is None  # fmt: skip


def formula_ok(name: str) -> bool:
    """Can a name be shown by :func:`spelt`?"""
    return _allowed(name) and re.search(r"[ /,()\[\].:]", name) is None
