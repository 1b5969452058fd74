"""Sentences for LaTeX and Markdown: their formulas are found among the words, and typeset."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Mapping

from ...record.vocabulary import VOCABULARY
from .letters import NAMES, named, quoted
from .letters import NAMES as KNOWN
from .signs import (
    LOWERED,
    MATH_ACCENTS,
    NO_BREAK,
    RAISED,
    SYMBOLS,
    WORD,
    Notation,
    decomposed,
    tex_text,
)
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


def _word(letters: str, after: str) -> Formula:
    """The formula of several letters: a differential as dx, or an operator as Tr."""
    if letters in ("SO", "SE", "SL", "GL"):
        return upright(letters)
    if len(letters) == 2 and letters != "Tr":
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


PLAIN = "+=<>/(),[].:0123456789 "
OPERATORS = "=<>+−±∧≅≠≈≤≥∈→↦×/"
PAIRED = (("(", ")"), ("⟨", "⟩"))
"""Brackets, between which a comma ends no formula."""
ELIDED = re.compile("(?:[cdjlmnst]|qu|jusqu|lorsqu|puisqu)’", re.I)
"""A French word that has lost its last letter before the next one, which may be a formula."""
QUOTED = re.compile(r"‘[^\W\d]\w*’")
"""A parameter."""


def dollars(formula: str, names: Mapping[str, str] = KNOWN) -> str:
    """A formula of a sentence as LaTeX between dollars; ``names``: the LaTeX of a record's own."""
    return f"${shown}$" if (shown := spelt(formula, names=names).tex) else ""


def prose(
    words: str,
    escape: Callable[[str], str] = tex_text,
    formula: Callable[[str], str] = dollars,
) -> str:
    """A sentence, its formulas between dollars or as ``formula`` shows them, the rest escaped."""
    found: list[str] = []
    for mathematical, run in _runs(WORD.findall(words)):
        before, core, after = _core(run) if mathematical else (run, "", "")
        found.append(escape(before) + (formula(core) if core else "") + escape(after))
    return " ".join(found)


def unbraced(formula: str) -> str:
    """A formula as :func:`dollars` has it, without braces around a single letter."""
    tex = re.sub(r"([_^])\{(\w)\}", r"\1\2", dollars(formula))
    return re.sub(r"\\bar\{(\w)\}", r"\\bar \1", tex)


def between_dollars(
    words: str,
    escape: Callable[[str], str] = tex_text,
    formula: Callable[[str], str] = unbraced,
) -> str:
    """Text whose formulas stand between dollars already: the rest escaped, word by word."""
    parts = words.split("$")
    parts[::2] = [WORD.sub(lambda found: escape(found[0]), x) for x in parts[::2]]
    parts[1::2] = map(formula, parts[1::2])
    return "".join(parts)


def _runs(words: list[str]) -> list[tuple[bool, str]]:
    """The words joined into runs, each a formula or not; a comma ends a closed formula."""
    runs: list[tuple[bool, str]] = []
    closed = True
    for word, formula in zip(words, _flags(words), strict=True):
        if runs and runs[-1][0] == formula and not (formula and closed):
            runs[-1] = (formula, f"{runs[-1][1]} {word}")
        else:
            runs.append((formula, word))
        whole = runs[-1][1]
        closed = whole[-1] in ",;:." and all(whole.count(a) <= whole.count(b) for a, b in PAIRED)
    return runs


def _flags(words: list[str]) -> list[bool]:
    """Which words belong to a formula: by their own letters, or beside an operator."""
    cores = [_core(w)[1] for w in words]
    found = []
    for k, c in enumerate(cores):
        first = k == 0 or words[k - 1].endswith((".", ":"))
        near = (k > 0 and _operator(cores[k - 1])) or (
            words[k] == c and k + 1 < len(words) and _operator(cores[k + 1])
        )
        found.append(_operator(c) or _is_formula(c, first) or (near and _allowed(c)))
    for k, (c, w) in enumerate(zip(cores[:-1], words, strict=False)):
        found[k] |= c in NAMED_OPERATORS and w.endswith(c) and found[k + 1]
    return found


def _operator(word: str) -> bool:
    """Is it a sign of an operator or relation that stands between formulas?"""
    return word != "" and word in OPERATORS


def _core(word: str) -> tuple[str, str, str]:
    """A word in three parts: an elided word and opening parentheses before it, itself, punctuation
    and unmatched parentheses after it."""
    elided = ELIDED.match(word)
    start, end = elided.end() if elided else 0, len(word.rstrip(",.;:!?" + NO_BREAK))
    excess = word[:end].count("(") - word[:end].count(")")
    while excess > 0 and word[start:end].startswith("("):
        start, excess = start + 1, excess - 1
    while excess < 0 and word[start:end].endswith(")"):
        end, excess = end - 1, excess + 1
    return word[:start], word[start:end], word[end:]


def _allowed(word: str) -> bool:
    """Has the word letters and signs alone that formulas can have, and no index left open?"""
    return bool(word) and all(
        (c.isascii() and c.isalpha()) or c in SYMBOLS or c in RAISED or c in LOWERED
        or c in MATH_ACCENTS or c in PLAIN or c in "_^"
        for c in decomposed(QUOTED.sub("x", word))
    ) and re.search(rf"_(?![A-Za-z0-9{INDICES}])|[A-Za-z]{{9}}", word) is None  # fmt: skip


def _is_formula(word: str, first: bool) -> bool:
    """Is it a word with a sign of mathematics or a parameter in ‘quotes’ in it, a quotient of
    letters, a function of one, a differential as dm, the first of a bracket, or one letter?

    The article “a” is none, nor is a capital that may begin the sentence (``first``); a circumflex
    in a longer word is a letter of French.
    """
    if not _allowed(word):
        return False
    if QUOTED.search(word):
        return True
    if len(word) == 1 and word.isascii():
        return word.isalpha() and word != "a" and not (first and word in "AEIOY")
    called = word.partition("(")[0] in NAMED_OPERATORS and "(" in word
    small = r"d?[A-Za-z]/d?[a-z]|[A-Za-z]\([A-Za-z]\)|d[mrt]|\[[A-Z]"
    if called or re.fullmatch(small, word):
        return True
    signs = decomposed(word)
    if len(signs) > 2:
        signs = signs.replace("\u0302", "")
    return any(
        c in SYMBOLS or c in RAISED or c in LOWERED or c in MATH_ACCENTS or c in "_=^"
        for c in signs
    )


def formula_ok(name: str) -> bool:
    """Can a name be shown by :func:`spelt`?"""
    return _allowed(name) and re.search(r"[ /,()\[\].:]", name) is None
