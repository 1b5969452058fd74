"""Names in LaTeX: those of the walk from the vocabulary or record, those of the user sans serif."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable, Mapping

from ..language.greek import GREEK
from ..record.record import Symbol
from ..record.vocabulary import VOCABULARY
from .escape import tex_text
from .typeset import Formula, literal, lowered, sans, text

NAMES = {name: x.latex for name, x in VOCABULARY.items()}
HARMLESS = re.compile(
    r"(?:(?:\\delta|\\partial_t|\\mathrm\{d\})(?![A-Za-z])'?\s*)?"
    r"(?:\\(?:tilde|bar|dot|hat|mathrm|mathbf)(?![A-Za-z])\s*)?"
    rf"(?:\\(?:{'|'.join(GREEK)}|lambda|Lambda|varphi|varpi)(?![A-Za-z])|[A-Za-z])'*"
    r"(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9]+\}))?"
)


SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


def quoted(shown: str, names: Mapping[str, str]) -> Formula:
    """The formula of a parameter as text shows it between quotes: x₁ is x_1; of words, the
    words."""
    name = re.sub("[₀-₉]+$", lambda index: "_" + index[0].translate(SUBSCRIPTS), shown)
    return sans(shown.replace(" ", r"\ "), shown) if " " in shown else parameter(name, names)


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
    if name in GREEK:
        return _base(name, names)
    if re.fullmatch(r"[A-Za-z0-9_]+", name):
        return sans(name.replace("_", r"\_"), name)
    return text(rf"\text{{\textsf{{{tex_text(name)}}}}}", name)


def _base(word: str, names: Mapping[str, str]) -> Formula:
    """A word sans serif; a Greek letter as itself, where the record, or no walk at all, gives it no
    meaning."""
    free = word in GREEK and (GREEK[word] not in VOCABULARY or f"free {word}" in names)
    return literal(rf"\{word}") if free else sans(word, word)
