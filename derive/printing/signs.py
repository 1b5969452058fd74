"""Tables of the letters and signs of formulas, and their LaTeX commands."""

from __future__ import annotations

import unicodedata

from ..language.greek import GREEK

LETTERS = GREEK | {
    "varphi": "φ", "phi": "ϕ", "varpi": "ϖ", "lambda": "λ", "Lambda": "Λ", "partial": "∂",
    "nabla": "∇", "ell": "ℓ", "vartheta": "ϑ", "infty": "∞",
}  # fmt: skip
"""Command of LaTeX (without its backslash) → letter, for commands that are letters."""
MATH_ACCENTS = {"\u0304": r"\bar", "\u0303": r"\tilde", "\u0307": r"\dot", "\u0302": r"\hat"}
SYMBOLS = {letter: rf"\{name}" for name, letter in LETTERS.items()} | {
    "Σ": r"\sum", "−": "-", "∧": r"\wedge", "⟨": r"\langle", "⟩": r"\rangle",
    "‖": r"\Vert", "≅": r"\cong", "≠": r"\neq", "≤": r"\le", "≥": r"\ge", "∈": r"\in", "→": r"\to",
    "↦": r"\mapsto",
    "≈": r"\approx", "·": r"\cdot", "±": r"\pm", "√": r"\surd", "ℝ": r"\mathbb{R}",
    "×": r"\times", "𝔤": r"\mathfrak{g}", "′": "'", "½": r"\tfrac12", "⅓": r"\tfrac13",
    "¼": r"\tfrac14", "⅔": r"\tfrac23", "∘": r"\circ", "⊤": r"\top", "∫": r"\int",
    "𝟏": r"\mathbf{1}", "𝔰": r"\mathfrak{s}", "𝔬": r"\mathfrak{o}", "𝕁": r"\mathbb{J}",
    "𝕀": r"\mathbb{I}", "𝒥": r"\mathcal{J}", "𝒜": r"\mathcal{A}", "ℛ": r"\mathcal{R}",
    "𝒱": r"\mathcal{V}",
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
