"""The letters and signs of formulas, choices of notation, and text escaped for LaTeX."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from ...language.reserved import GREEK

# The choices of notation that a reader has.

NOTATIONS = {
    "transpose": (("bar", "top"), "a transpose as a bar, or as a raised T"),
    "hat": (("j", "wedge"), "the skew matrix of a vector as j(x), or as x with a raised wedge"),
}
"""Choice → its values, the first one the default, and what they choose."""


@dataclass(frozen=True)
class Notation:
    """How transposes and skew matrices are written, by NOTATIONS; ``ValueError`` for others."""

    transpose: str = "bar"
    hat: str = "j"

    def __post_init__(self) -> None:
        for name, (allowed, _) in NOTATIONS.items():
            if getattr(self, name) not in allowed:
                raise ValueError(f"{name} must be one of {', '.join(allowed)}")


# Tables of the letters and signs of formulas, and their LaTeX commands.

LETTERS = GREEK | {
    "varphi": "φ", "phi": "ϕ", "varpi": "ϖ", "lambda": "λ", "Lambda": "Λ", "partial": "∂",
    "nabla": "∇", "ell": "ℓ", "vartheta": "ϑ", "varsigma": "ς", "infty": "∞",
}  # fmt: skip
"""Command of LaTeX (without its backslash) → letter, for commands that are letters."""
OVERDOT = "\u0307"
"""What stands over the letter of a rate."""
MATH_ACCENTS = {
    "\u0304": r"\bar", "\u0303": r"\tilde", "\u0302": r"\hat",
    OVERDOT: r"\dot", "\u0308": r"\ddot",
}  # fmt: skip
SYMBOLS = {letter: rf"\{name}" for name, letter in LETTERS.items()} | {
    "Σ": r"\sum", "−": "-", "∧": r"\wedge", "⟨": r"\langle", "⟩": r"\rangle",
    "‖": r"\Vert", "≅": r"\cong", "≠": r"\neq", "≤": r"\le", "≥": r"\ge", "∈": r"\in", "→": r"\to",
    "↦": r"\mapsto",
    "≈": r"\approx", "·": r"\cdot", "±": r"\pm", "√": r"\surd", "ℝ": r"\mathbb{R}",
    "×": r"\times", "𝔤": r"\mathfrak{g}", "′": "'", "½": r"\tfrac12", "⅓": r"\tfrac13",
    "¼": r"\tfrac14", "⅔": r"\tfrac23", "∘": r"\circ", "⊤": r"\top", "∫": r"\int",
    "𝟏": r"\mathbf{1}", "𝔰": r"\mathfrak{s}", "𝔬": r"\mathfrak{o}", "𝕁": r"\mathbb{J}",
    "𝕀": r"\mathbb{I}", "𝒥": r"\mathcal{J}", "𝒜": r"\mathcal{A}", "ℛ": r"\mathcal{R}",
    "𝒱": r"\mathcal{V}", "ℱ": r"\mathcal{F}",
    "𝐦": r"\mathbf m", "𝐧": r"\mathbf n",
}  # fmt: skip
STYLED = {x: letter for letter, x in SYMBOLS.items() if x[:7] in (r"\mathbb", r"\mathca")}
"""LaTeX of a letter of another style → the letter."""
RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-", strict=True))
LOWERED = dict(zip("₀₁₂₃₄₅₆₇₈₉ᵢⱼₑₜ", "0123456789ijet", strict=True))


def decomposed(text: str) -> str:
    """The text, the marks of each letter behind it; a sign with a stroke, as ≠, stays one."""
    composed = unicodedata.normalize("NFC", text)
    apart = (unicodedata.normalize("NFD", c) for c in composed)
    return "".join(x if x[0].isalpha() else c for x, c in zip(apart, composed, strict=True))


def math_char(c: str) -> str:
    """The LaTeX of one character of a formula."""
    if c in RAISED:
        return f"^{{{RAISED[c]}}}"
    if c in LOWERED:
        return f"_{{{LOWERED[c]}}}"
    return SYMBOLS.get(c, c)


# Escaping of words and names for LaTeX and Markdown: what a user typed is never a command.

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
    "⅓": "1/3", "⅔": "2/3", "ᵉ": r"\textsuperscript{e}", "µ": r"\ensuremath{\mu}",
    "⋅": r"\ensuremath{\cdot}", "∑": r"\ensuremath{\sum}",
    "∆": r"\ensuremath{\Delta}", "ħ": r"\ensuremath{\hbar}", "⊥": r"\ensuremath{\perp}",
    "⋉": r"\ensuremath{\ltimes}", "⊗": r"\ensuremath{\otimes}",
    "€": r"\texteuro{}", "†": r"\textdagger{}", "‰": r"\textperthousand{}",
}  # fmt: skip
"""Characters outside formulas → LaTeX; a fraction of mathematics in a title would end TeX."""
MATH = r"\ensuremath"
NO_BREAK = "\u00a0\u202f"
WORD = re.compile(rf"[\S{NO_BREAK}]+")


def tex_text(words: str, *, latin: bool = False) -> str:
    """Any text as LaTeX that prints it; what the fonts lack becomes a question mark.  In ASCII, for
    any preamble, or with letters of Latin-1 as they are (``latin``)."""
    shown: list[str] = []
    plain = re.sub(r"([-'`])(?=\1)", "\\1\u200b", " ".join(WORD.findall(words)))
    for c in decomposed(plain):
        if unicodedata.combining(c):
            shown[-1:] = [_with_mark("".join(shown[-1:]), c, latin=latin)]
        elif c in TEXT:
            shown.append(TEXT[c])
        elif c == "\u200b":
            shown.append("{}")
        elif c in TEX_SPECIAL:
            shown.append(TEX_SPECIAL[c])
        elif c in SYMBOLS or c in RAISED or c in LOWERED:
            shown.append(f"{MATH}{{{math_char(c)}}}")
        elif " " <= c <= "~":
            shown.append(c)
        elif not unicodedata.category(c).startswith(("M", "C")):
            shown.append("?")
    return "".join(shown)


def _with_mark(base: str, mark: str, *, latin: bool) -> str:
    """The LaTeX of a letter with a mark over or under it; ``?`` for those that no font has."""
    composed = unicodedata.normalize("NFC", base + mark)
    if latin and "À" <= composed <= "ÿ":
        return composed
    if mark in TEXT_ACCENTS and re.fullmatch("[A-Za-z]", base):
        dotless = rf"\{base}" if base in "ij" else base
        return rf"\{TEXT_ACCENTS[mark]}{{{dotless}}}"
    if mark in MATH_ACCENTS and base.startswith(MATH):
        return f"{MATH}{{{MATH_ACCENTS[mark]}{base.removeprefix(MATH)}}}"
    return "?"


def unknown_to_tex(words: str) -> str:
    """The distinct letters of a text, with their marks, that :func:`tex_text` has as ``?``."""
    letters = re.findall(r".[\u0300-\u036f]*", words)
    return "".join(dict.fromkeys(x for x in letters if x != "?" and "?" in tex_text(x)))


def markdown_text(words: str) -> str:
    """Any text as Markdown that prints it, with no markup and no HTML in it."""
    spaced = " ".join(WORD.findall(words))
    plain = "".join(c for c in spaced if c.isprintable() or c in NO_BREAK)
    plain = plain.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([\\`*_{}\[\]#|~$])", r"\\\1", plain)
