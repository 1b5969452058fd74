"""Escaping of words and names for LaTeX and Markdown: what a user typed is never a command."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

from .inline import INDICES, math_text
from .inline import OPERATORS as NAMES
from .signs import LOWERED, MATH_ACCENTS, NAMED, RAISED, SYMBOLS, math_char

TEX_SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "%": r"\%", "&": r"\&",
    "_": r"\_", "#": r"\#", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
    "<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}",
    "–": "--", "—": "---", "‘": "`", "’": "'", "“": "``", "”": "''", "…": r"\dots{}",
    "«": r"\opened{}", "»": r"\closed{}",
    "ß": r"\ss{}", "æ": r"\ae{}", "Æ": r"\AE{}", "œ": r"\oe{}",
    "Œ": r"\OE{}", "ø": r"\o{}", "Ø": r"\O{}", "ł": r"\l{}", "Ł": r"\L{}", '"': "''{}",
    "·": r"$\cdot$", "°": r"$^\circ$", "§": r"\S{}", "©": r"\copyright{}",
    "\u00a0": "~", "\u202f": r"\,",
}  # fmt: skip
TEXT_ACCENTS = {
    "\u0300": "`", "\u0301": "'", "\u0302": "^", "\u0303": "~", "\u0304": "=", "\u0306": "u",
    "\u0307": ".", "\u0308": '"', "\u030a": "r", "\u030b": "H", "\u030c": "v", "\u0323": "d",
    "\u0327": "c",
}  # fmt: skip
TEXT = {
    "½": r"\textonehalf{}", "¼": r"\textonequarter{}", "¾": r"\textthreequarters{}",
    "⅓": "1/3", "⅔": "2/3", "µ": r"\ensuremath{\mu}", "∞": r"\ensuremath{\infty}",
    "√": r"\ensuremath{\surd}", "±": r"\ensuremath{\pm}", "≈": r"\ensuremath{\approx}",
    "⋅": r"\ensuremath{\cdot}", "∑": r"\ensuremath{\sum}", "∫": r"\ensuremath{\int}",
    "∆": r"\ensuremath{\Delta}", "ħ": r"\ensuremath{\hbar}", "⊥": r"\ensuremath{\perp}",
    "⋉": r"\ensuremath{\ltimes}", "↦": r"\ensuremath{\mapsto}", "⊗": r"\ensuremath{\otimes}",
    "€": r"\texteuro{}", "†": r"\textdagger{}", "‰": r"\textperthousand{}",
}  # fmt: skip
"""Characters outside formulas → LaTeX; a fraction of mathematics in a title would end TeX."""
PLAIN = "+=<>/(),[].:0123456789 "
OPERATORS = "=<>+−∧≅≠≤≥∈→×"
PAIRED = (("(", ")"), ("⟨", "⟩"))
"""Brackets, between which a comma ends no formula."""
NO_BREAK = "\u00a0\u202f"
WORD = re.compile(rf"[\S{NO_BREAK}]+")
ELIDED = re.compile("(?:[cdjlmnst]|qu|jusqu|lorsqu|puisqu)’", re.I)
"""A French word that has lost its last letter before the next one, which may be a formula."""


def tex_text(words: str) -> str:
    """Any text as LaTeX that prints it; what the fonts lack becomes a question mark."""
    shown: list[str] = []
    plain = re.sub(r"([-'`])(?=\1)", "\\1\u200b", " ".join(WORD.findall(words)))
    for c in unicodedata.normalize("NFD", plain):
        if c in TEXT:
            shown.append(TEXT[c])
        elif c == "\u200b":
            shown.append("{}")
        elif c in TEXT_ACCENTS and shown and re.fullmatch("[A-Za-z]", shown[-1]):
            base = rf"\{shown[-1]}" if shown[-1] in "ij" else shown[-1]
            shown[-1] = rf"\{TEXT_ACCENTS[c]}{{{base}}}"
        elif c in TEX_SPECIAL:
            shown.append(TEX_SPECIAL[c])
        elif c in SYMBOLS or c in RAISED or c in LOWERED:
            shown.append(rf"\ensuremath{{{math_char(c)}}}")
        elif " " <= c <= "~":
            shown.append(c)
        elif not unicodedata.category(c).startswith(("M", "C")):
            shown.append("?")
    return "".join(shown)


def unknown_to_tex(words: str) -> str:
    """The distinct characters of a text that :func:`tex_text` shows as question marks."""
    return "".join(dict.fromkeys(c for c in words if c != "?" and "?" in tex_text(c)))


def markdown_text(words: str) -> str:
    """Any text as Markdown that prints it, with no markup and no HTML in it."""
    spaced = " ".join(WORD.findall(words))
    plain = "".join(c for c in spaced if c.isprintable() or c in NO_BREAK)
    plain = plain.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([\\`*_{}\[\]#|~$])", r"\\\1", plain)


def dollars(formula: str) -> str:
    """A formula of a sentence as LaTeX between dollars."""
    return f"${shown}$" if (shown := math_text(formula)) else ""


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
        or c in MATH_ACCENTS or c in PLAIN or c == "_"
        for c in unicodedata.normalize("NFD", word)
    ) and re.search(rf"_(?![A-Za-z0-9{INDICES}])|[A-Za-z]{{9}}", word) is None  # fmt: skip


def _is_formula(word: str, first: bool) -> bool:
    """Is it a word with a sign of mathematics in it, a quotient of letters, a function of one, a
    differential as dm, the first of a bracket, or one letter, also that of a parameter in ‘quotes’?

    The article “a” is none, nor is a capital that may begin the sentence (``first``); a circumflex
    in a longer word is a letter of French.
    """
    if re.fullmatch("‘[A-Za-z]’", word):
        return True
    if not _allowed(word):
        return False
    if len(word) == 1 and word.isascii():
        return word.isalpha() and word != "a" and not (first and word in "AEIOY")
    called = word.partition("(")[0] in NAMES and "(" in word
    small = r"d?[A-Za-z]/d?[a-z]|[A-Za-z]\([A-Za-z]\)|d[mrt]|\[[A-Z]"
    if called or re.fullmatch(small, word) or word in NAMED:
        return True
    decomposed = unicodedata.normalize("NFD", word)
    if len(word) > 1:
        decomposed = decomposed.replace("\u0302", "")
    return any(
        c in SYMBOLS or c in RAISED or c in LOWERED or c in MATH_ACCENTS or c in "_="
        for c in decomposed
    )


def formula_ok(name: str) -> bool:
    """Can a name be shown by :func:`math_text`?"""
    return _allowed(name) and re.search(r"[ /,()\[\].:]", name) is None
