"""Breaking long formulas into lines: shallow operators first, whatever the language."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

COMMA, SUM, WEDGE, FACTOR = 0.0, 0.25, 0.5, 0.75
"""Depth added to a break by the operator it stands before: the less, the sooner."""

WIDTH = 100
"""The columns of a text, where nothing else is said."""

MARK = re.compile("[\u0300-\u036f]")


@dataclass(frozen=True)
class Piece:
    """A stretch of a formula that is not broken, and how deep the break before it would be."""

    text: str
    depth: float


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
        if measure((current + text).strip()) <= room:
            current += text
            continue
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
