"""Escaping of words and names for LaTeX and Markdown: what a user typed is never a command."""

from __future__ import annotations

import re
import unicodedata

from .signs import LOWERED, RAISED, SYMBOLS, decomposed, math_char

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
    "⅓": "1/3", "⅔": "2/3", "µ": r"\ensuremath{\mu}",
    "⋅": r"\ensuremath{\cdot}", "∑": r"\ensuremath{\sum}",
    "∆": r"\ensuremath{\Delta}", "ħ": r"\ensuremath{\hbar}", "⊥": r"\ensuremath{\perp}",
    "⋉": r"\ensuremath{\ltimes}", "⊗": r"\ensuremath{\otimes}",
    "€": r"\texteuro{}", "†": r"\textdagger{}", "‰": r"\textperthousand{}",
}  # fmt: skip
"""Characters outside formulas → LaTeX; a fraction of mathematics in a title would end TeX."""
NO_BREAK = "\u00a0\u202f"
WORD = re.compile(rf"[\S{NO_BREAK}]+")


def tex_text(words: str) -> str:
    """Any text as LaTeX that prints it; what the fonts lack becomes a question mark."""
    shown: list[str] = []
    plain = re.sub(r"([-'`])(?=\1)", "\\1\u200b", " ".join(WORD.findall(words)))
    for c in decomposed(plain):
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
