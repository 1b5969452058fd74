"""Words and names for LaTeX and Markdown: nothing a user typed reaches them as a command."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

from ..record.vocabulary import VOCABULARY

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
MATH_ACCENTS = {"\u0304": r"\bar", "\u0303": r"\tilde", "\u0307": r"\dot", "\u0302": r"\hat"}
GREEK = {
    name: unicodedata.lookup(f"GREEK {case} LETTER {name.upper()}")
    for case, names in (
        ("SMALL", "alpha beta gamma delta epsilon zeta eta theta iota kappa mu nu xi pi rho "
         "sigma tau upsilon phi chi psi omega"),
        ("CAPITAL", "Gamma Delta Theta Xi Pi Sigma Upsilon Phi Psi Omega"),
    )
    for name in names.split()
}  # fmt: skip
NAMED = {"rho", "sigma", "omega", "gamma", "kappa", "theta", "lambda"}
"""Parameters that equations have as Greek letters, and that are words of neither language."""
SYMBOLS = {letter: rf"\{name}" for name, letter in GREEK.items()} | {
    "λ": r"\lambda", "Λ": r"\Lambda", "φ": r"\varphi", "ϕ": r"\phi", "ϖ": r"\varpi",
    "Σ": r"\sum", "∂": r"\partial", "−": "-", "∧": r"\wedge", "⟨": r"\langle", "⟩": r"\rangle",
    "‖": r"\Vert", "≅": r"\cong", "≠": r"\neq", "≤": r"\le", "≥": r"\ge", "∈": r"\in", "→": r"\to",
    "×": r"\times", "𝔤": r"\mathfrak{g}", "′": "'", "½": r"\tfrac12", "⅓": r"\tfrac13",
    "¼": r"\tfrac14", "⅔": r"\tfrac23", "∇": r"\nabla", "∘": r"\circ",
    "ℓ": r"\ell", "𝟏": r"\mathbf{1}", "𝔰": r"\mathfrak{s}", "𝔬": r"\mathfrak{o}",
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
"""Outside formulas; a fraction of mathematics in a title would end TeX."""
RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True))
LOWERED = dict(zip("₀₁₂₃₄₅₆₇₈₉ᵢⱼₑₜ", "0123456789ijet", strict=True))
PLAIN = "+=/(),[].:0123456789 "
OPERATORS = "=+−∧≅≠≤≥∈→×"
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
            shown.append(rf"\ensuremath{{{_math_char(c)}}}")
        elif " " <= c <= "~":
            shown.append(c)
        elif not unicodedata.category(c).startswith(("M", "C")):
            shown.append("?")
    return "".join(shown)


def unknown_to_tex(words: str) -> str:
    """The characters that :func:`tex_text` shows as question marks."""
    return "".join(dict.fromkeys(c for c in words if c != "?" and "?" in tex_text(c)))


def markdown_text(words: str) -> str:
    """Any text as Markdown that prints it."""
    spaced = " ".join(WORD.findall(words))
    plain = "".join(c for c in spaced if c.isprintable() or c in NO_BREAK)
    plain = plain.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([\\`*_{}\[\]#|~$])", r"\\\1", plain)


def prose(words: str, escape: Callable[[str], str] = tex_text) -> str:
    """A sentence with its formulas between dollars and the rest escaped."""
    found: list[str] = []
    for formula, run in _runs(WORD.findall(words)):
        before, core, after = _core(run) if formula else (run, "", "")
        inside = f"${shown}$" if (shown := math_text(core)) else ""
        found.append(escape(before) + inside + escape(after))
    return " ".join(found)


def between_dollars(words: str, escape: Callable[[str], str] = tex_text) -> str:
    """Text whose formulas stand between dollars already: the rest escaped, word by word."""
    parts = words.split("$")
    parts[::2] = [WORD.sub(lambda found: escape(found[0]), x) for x in parts[::2]]
    return "$".join(parts)


def _runs(words: list[str]) -> list[tuple[bool, str]]:
    """The words joined into formulas and other text; a comma ends a formula that is not open."""
    runs: list[tuple[bool, str]] = []
    closed = True
    for word, formula in zip(words, _flags(words), strict=True):
        if runs and runs[-1][0] == formula and not (formula and closed):
            runs[-1] = (formula, f"{runs[-1][1]} {word}")
        else:
            runs.append((formula, word))
        whole = runs[-1][1]
        closed = whole[-1] in ",;:." and whole.count("(") <= whole.count(")")
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
    return found


def _operator(word: str) -> bool:
    return word != "" and word in OPERATORS


def _core(word: str) -> tuple[str, str, str]:
    """A word without the elided one before it, punctuation and unmatched parentheses around it."""
    elided = ELIDED.match(word)
    start, end = elided.end() if elided else 0, len(word.rstrip(",.;:!?" + NO_BREAK))
    excess = word[:end].count("(") - word[:end].count(")")
    while excess > 0 and word[start:end].startswith("("):
        start, excess = start + 1, excess - 1
    while excess < 0 and word[start:end].endswith(")"):
        end, excess = end - 1, excess + 1
    return word[:start], word[start:end], word[end:]


def _allowed(word: str) -> bool:
    return bool(word) and all(
        (c.isascii() and c.isalpha()) or c in SYMBOLS or c in RAISED or c in LOWERED
        or c in MATH_ACCENTS or c in PLAIN or c == "_"
        for c in unicodedata.normalize("NFD", word)
    ) and re.search(r"__|_$|_[^A-Za-z0-9]|[A-Za-z]{9}", word) is None  # fmt: skip


def _is_formula(word: str, first: bool) -> bool:
    """A word with a sign of mathematics in it, a quotient of letters, or a single letter.

    The article “a” is none, nor is a capital that may begin the sentence; a circumflex in a longer
    word is a letter of French.
    """
    if not _allowed(word):
        return False
    if len(word) == 1 and word.isascii():
        return word.isalpha() and word != "a" and not (first and word in "AEIOY")
    if re.fullmatch(r"d?[A-Za-z]/d?[a-z]", word) or word in NAMED:
        return True
    decomposed = unicodedata.normalize("NFD", word)
    if len(word) > 1:
        decomposed = decomposed.replace("\u0302", "")
    return any(
        c in SYMBOLS or c in RAISED or c in LOWERED or c in MATH_ACCENTS or c in "_="
        for c in decomposed
    )


def _math_char(c: str) -> str:
    if c in RAISED:
        return f"^{{{RAISED[c]}}}"
    if c in LOWERED:
        return f"_{{{LOWERED[c]}}}"
    return SYMBOLS.get(c, c)


KNOWN = {unicodedata.normalize("NFC", name): x.latex for name, x in VOCABULARY.items()}
TOKEN = re.compile(
    "("
    + "|".join(re.escape(name) for name in sorted(KNOWN, key=len, reverse=True) if len(name) > 1)
    + r")(?![\u0300-\u036f])|_([A-Za-z0-9]+)|([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)|([₀₁₂₃₄₅₆₇₈₉ᵢⱼₑₜ]+)"
    r"|([A-Za-z]{2,})(?![\u0300-\u036f])|(.)([\u0300-\u036f]*)"
)


SCRIPTS = f"_′{''.join(RAISED)}{''.join(LOWERED)}"
BELOW, ABOVE = r"_(?:\{[^{}]*\}|\w)", r"\^\{[^{}]*\}"
SECOND = {
    "_": f"{BELOW}(?:{ABOVE}|'+)?$",
    "^": f"(?:{ABOVE}|')(?:{BELOW})?$",
    "'": f"(?:{ABOVE}(?:{BELOW})?|'{BELOW})$",
}


def math_text(formula: str) -> str:
    """Letters of the paper, as ``r̄_i`` or ``∂U/∂r_i``, as the inside of a LaTeX formula."""
    shown = ""
    tight = re.sub(rf"(^|[{SCRIPTS}\s])[\u0300-\u036f]+", r"\1", formula)
    tight = re.sub(rf"\s+(?=[{SCRIPTS}])", "", tight)
    for match in TOKEN.finditer(unicodedata.normalize("NFC", tight)):
        known, below, raised, lowered, word, letter, marks = match.groups()
        if known:
            piece = KNOWN[known]
        elif below:
            piece = f"_{{{below}}}"
        elif raised:
            piece = f"^{{{''.join(RAISED[c] for c in raised)}}}"
        elif lowered:
            piece = f"_{{{''.join(LOWERED[c] for c in lowered)}}}"
        elif word:
            piece = _word(word)
        else:
            piece = _letter(letter, marks, match.string[match.end() :])
        shown += _joint(shown, piece) + piece
    return shown


def _joint(shown: str, piece: str) -> str:
    """What keeps a command from its neighbour, and a second index or exponent from the first."""
    if piece[:1].isalpha():
        return " " if re.search(r"\\[A-Za-z]+$", shown) else ""
    pattern = SECOND.get(piece[:1])
    return "{}" if pattern and (not shown or re.search(pattern, shown)) else ""


def _word(word: str) -> str:
    if word == "Tr":
        return r"\operatorname{Tr}"
    if word in NAMED:
        return rf"\{word}"
    if len(word) == 2:
        return rf"\mathrm{{d}}{word[1]}" if word[0] == "d" else word
    return rf"\operatorname{{{word}}}"


def _letter(letter: str, marks: str, rest: str) -> str:
    """One character with its accents; R before an exponent is the field of the reals."""
    base, *own = list(unicodedata.normalize("NFD", letter))
    if unicodedata.combining(base):
        return ""
    shown = _math_char(base)
    if letter == "R" and rest[:1] in RAISED:
        shown = r"\mathbf{R}"
    if letter == "d" and rest[:1] in SYMBOLS and rest[0].isalpha():
        shown = r"\mathrm{d}"
    for mark in [*own, *marks]:
        if mark in MATH_ACCENTS and base.isalpha():
            shown = f"{MATH_ACCENTS[mark]}{{{shown}}}"
    return shown


def formula_ok(name: str) -> bool:
    """Can a name be shown by :func:`math_text`?"""
    return _allowed(name) and re.search(r"[ /,()\[\].:]", name) is None
