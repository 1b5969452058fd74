"""Breaking long formulas into lines, by estimates of their width."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

# The width of a LaTeX formula, estimated well enough to choose where its lines break.

WIDTHLESS = "bar|overline|tilde|dot|hat|mathrm|mathsf|mathbf|operatorname|text|textsf|ensuremath"
WIDTHS = (
    (r"\\(?:begin|end)\{[a-z]+\}(?:\{[^{}]*\{\}[^{}]*\{\}\})?", 0.6),
    (rf"\\(?:{WIDTHLESS})(?![A-Za-z])", 0),
    (r"\\[td]?frac(?![A-Za-z])", 0.3),
    (r"\\(?:langle|rangle)(?![A-Za-z])|[()\[\]]", 0.4),
    (r"\\[lr]?Vert(?![A-Za-z])", 0.52),
    (r"\\wedge(?![A-Za-z])|\\cdot(?![A-Za-z])", 1.15),
    (r"\\sum(?![A-Za-z])", 1.7),
    (r"\\(?:quad|qquad)(?![A-Za-z])", 1.5),
    (r"\\,", 0.17),
    (r"\\(?:det|hatmap|sin|cos|tan|exp|log)(?![A-Za-z])", 1.5),
    (r"\\(?:sinh|cosh|tanh|arctan)(?![A-Za-z])", 2.2),
    (r"\\[a-z]+", 0.62),
    (r"\\[A-Z][A-Za-z]*|\\\\|[A-Z]", 0.78),
    (r"[mw]", 0.85),
    (r"[a-z0-9]", 0.53),
    (r" [+-] |[+-](?=[^}])", 1.25),
    (r"[=&]", 1.35),
    (r"[,;]", 0.46),
    (r"[']", 0.32),
    (r"[{}\s^_]", 0),
    (r".", 0.7),
)  # fmt: skip
WIDTH_PATTERN = re.compile("|".join(f"({pattern})" for pattern, _ in WIDTHS), re.S)
SCRIPT = re.compile(r"[_^](?:\{((?:[^{}]|\{[^{}]*\})*)\}|(\\[A-Za-z]+|[^{\\]))")


MATRIX = re.compile(r"\\begin\{pmatrix\}(.*?)\\end\{pmatrix\}", re.S)


@lru_cache(4096)  # terms in terms are measured again at every depth
def measure(tex: str) -> float:
    """The estimated width of a formula in em; rather too wide than too narrow."""
    wide = sum(
        1.8 + max(map(measure, re.split(r" \\\\(?:\[2pt\])? ", m[1]))) for m in MATRIX.finditer(tex)
    )
    tex = MATRIX.sub("", tex)
    small = sum(measure(m[1] or m[2] or "") for m in SCRIPT.finditer(tex))
    tex = SCRIPT.sub("", tex)
    rest = sum(WIDTHS[(m.lastindex or 1) - 1][1] for m in WIDTH_PATTERN.finditer(tex))
    return wide + 0.72 * small + rest


ROW, COMMA, SUM, WEDGE, FACTOR = -0.125, 0.0, 0.25, 0.5, 0.75
"""Depth added to a break by the operator it stands before: the less, the sooner."""

WIDTH = 100
"""The columns of a text, where nothing else is said."""

MARK = re.compile("[\u0300-\u036f]")
SIGN = re.compile(r"(?:\s|\{\})*[+−=-]")
"""What begins a term, not a factor."""


@dataclass(frozen=True)
class Piece:
    """A stretch of a formula that is not broken, and how deep the break before it would be."""

    text: str
    depth: float


START = 0.12
"""The part of a line that the beginning of a term takes which shares it with what is broken."""

P = TypeVar("P", bound=Piece)


@dataclass(frozen=True)
class Line:
    """One line, and how many times its break went inside a term."""

    text: str
    inside: int


def display_width(text: str) -> int:
    """The columns of a text in a terminal: combining marks take none."""
    return len(MARK.sub("", text))


def fill(
    pieces: Sequence[Piece], room: float, measure: Callable[[str], float], indent: float = 0
) -> list[Line]:
    """Lines no wider than ``room`` as far as the pieces allow; an inner line loses ``indent``."""
    whole = "".join(p.text for p in pieces).strip()
    if len(pieces) == 1 or measure(whole) <= room:
        return [Line(whole, 0)]
    lines: list[Line] = []
    current = ""
    for group in groups(pieces):
        text = "".join(p.text for p in group)
        if lines and not current and lines[-1].inside and not SIGN.match(text):
            closed = lines[-1].text + text.rstrip()  # a factor behind a bracket, as δt
            if measure(closed) <= room - indent * lines[-1].inside:
                lines[-1] = replace(lines[-1], text=closed)
                continue
        if measure((current + text).strip()) <= room:
            current += text
            continue
        if current and len(group) > 1 and measure(current.strip()) <= START * room:
            head, *rest = group  # a factor before a bracket, as k: not alone on its line
            group = [replace(head, text=current + head.text), *rest]
            text, current = current + text, ""
        if current:
            lines.append(Line(current.strip(), 0))
        if len(group) == 1 or measure(text.strip()) <= room:
            current = text
        else:
            first, *others = fill(group, room - indent, measure, indent)
            lines += [first, *(Line(line.text, line.inside + 1) for line in others)]
            current = ""
    return [*lines, Line(current.strip(), 0)] if current else lines


def groups(pieces: Sequence[P]) -> list[list[P]]:
    """The pieces in runs, cut at the shallowest breaks."""
    if len(pieces) == 1:
        return [[*pieces]]
    shallow = min(p.depth for p in pieces[1:])
    groups = [[pieces[0]]]
    for piece in pieces[1:]:
        if piece.depth == shallow:
            groups.append([])
        groups[-1].append(piece)
    return groups
