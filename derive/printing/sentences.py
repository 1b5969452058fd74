"""Sentences for LaTeX and Markdown: their formulas are found among the words, and typeset."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from .escape import NO_BREAK, WORD, tex_text
from .inline import INDICES, spelt
from .inline import OPERATORS as NAMES
from .letters import NAMES as KNOWN
from .signs import LOWERED, MATH_ACCENTS, RAISED, SYMBOLS, decomposed

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
        found[k] |= c in NAMES and w.endswith(c) and found[k + 1]
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
    called = word.partition("(")[0] in NAMES and "(" in word
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
