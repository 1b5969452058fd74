"""The equations of a step as rows of an alignment, none wider than the page."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from ..record.record import Equation
from .language import ENGLISH, Entry, Language, entries
from .outline import domain, moving, quantified
from .printing.line_breaking import Line, fill, measure
from .printing.sentences import spelt
from .printing.signs import Notation, tex_text
from .printing.tex import formula, guarded, joined, latex_tree, marked, paren, pieces
from .printing.typeset import Formula, literal, plain, text

ROOM = 38.0
"""The width of an equation in em, its number aside."""
EQUALS, INDENT = 1.4, 1.5

Rows = list[str]


@dataclass(frozen=True)
class Quantifiers:
    """The words "for every" and "for some" before names, "along the motion", and the equations of
    the step that hold along it alone, which tell where they stand."""

    every: Formula
    some: Formula
    motion: Formula
    along: Collection[Equation]


def blocks(
    equations: Sequence[Equation], names: Mapping[str, str], language: Language = ENGLISH
) -> list[list[Rows]]:
    """Alignments, each a list of entries, each a list of rows ``left & right``.

    The entries of a step share one alignment unless a long left side forbids it.
    """
    every = quantifiers(language, equations)
    numbered = entries(equations)
    leading = [x.equations[0] for x in numbered]
    left = [measure(latex_tree(e.lhs, names)) for e in leading]
    right = [
        measure(latex_tree(e.rhs, names)) + clause_width(clause(e, names, every)) for e in leading
    ]
    column = max(left)
    if column <= 0.4 * ROOM or column + EQUALS + max(right) <= ROOM:
        return [[rows(x, names, column, every) for x in numbered]]
    found: list[list[Rows]] = []
    for long, run in groupby(zip(numbered, left, strict=True), key=lambda x: x[1] > 0.4 * ROOM):
        members = [*run]
        if long:
            found += [
                [alone(x.only, names, every) if x.only else side(x, names)] for x, _ in members
            ]
        else:
            narrow = max(w for _, w in members)
            found.append([rows(x, names, narrow, every) for x, _ in members])
    return found


def quantifiers(language: Language, equations: Sequence[Equation]) -> Quantifiers:
    """The words for what the ``equations`` of a step hold for."""
    words = (f"{language.word(x)} " for x in ("for every", "for some"))
    every, some = (text(rf"\text{{{tex_text(x[:-1])} }} ", x) for x in words)
    motion = language.word("along the motion")
    return Quantifiers(
        every, some, text(rf"\text{{{tex_text(motion)}}}", motion), moving(equations)
    )


def rows(x: Entry, names: Mapping[str, str], column: float, every: Quantifiers) -> Rows:
    """The rows of an entry whose left side has a column of the given width."""
    if x.only is None:
        return side(x, names)
    below = (aligned(e, names, column, every) for e in x.where)
    return [*aligned(x.only, names, column, every), *(row for e in below for row in e)]


def side(x: Entry, names: Mapping[str, str]) -> Rows:
    """The row of short equations side by side."""
    cells = [(latex_tree(e.lhs, names), latex_tree(e.rhs, names)) for e in x.equations]
    (head, first), *others = cells
    more = (rf"{a} = {b}" for a, b in others)
    return [r",\qquad ".join([f"{guarded(head)} &= {first}", *more])]


def aligned(e: Equation, names: Mapping[str, str], column: float, every: Quantifiers) -> Rows:
    """The rows of an equation whose left side has a column of the given width."""
    lines = broken(marked(e.rhs, names), ROOM - column - EQUALS)
    head = guarded(latex_tree(e.lhs, names))
    rows = [f"{head} &= {lines[0].text}", *("&" + indented(x, 1) for x in lines[1:])]
    return closed(rows, clause(e, names, every), measure(lines[-1].text) + column + EQUALS)


def alone(e: Equation, names: Mapping[str, str], every: Quantifiers) -> Rows:
    """The rows of an equation with an alignment of its own; a long left side has its own lines."""
    head = latex_tree(e.lhs, names)
    column = measure(head)
    words = clause(e, names, every)
    whole = column + EQUALS + measure(latex_tree(e.rhs, names)) + clause_width(words)
    if column <= 0.4 * ROOM or whole <= ROOM:
        return aligned(e, names, column, every)
    first, *others = broken(marked(e.lhs, names), ROOM)
    rows = ["&" + guarded(first.text), *("&" + indented(x, 1) for x in others)]
    first, *others = broken(marked(e.rhs, names), ROOM - EQUALS - INDENT)
    rows += [rf"&\quad = {first.text}", *("&" + indented(x, 2) for x in others)]
    return closed(rows, words, ROOM if others else measure(first.text) + EQUALS + INDENT)


def broken(tex: str, room: float) -> list[Line]:
    """Marked LaTeX in lines of at most ``room`` em."""
    lines = fill(pieces(tex), room, lambda x: measure(plain(x)), INDENT)
    return [Line(plain(x.text), x.inside) for x in lines]


def indented(line: Line, quads: int) -> str:
    """The LaTeX of a line that continues a formula, indented by ``quads`` and its depth."""
    sign = "{}" if line.text[:1] in "+-" else ""
    return r"\quad" * (quads + line.inside) + " " + sign + line.text


def clause(e: Equation, names: Mapping[str, str], words: Quantifiers) -> str:
    """For which names the equation holds, as LaTeX."""
    return quantifier(e, names, words).tex


def quantifier(
    e: Equation, names: Mapping[str, str], words: Quantifiers, notation: Notation | None = None
) -> Formula:
    """For which names the equation holds: every one, or some; or along the motion; empty where
    nothing is said."""

    def listed(these: Sequence[str]) -> Formula:
        return joined([formula(x, names, notation) for x in these], literal(", "))

    clauses = []
    if over := quantified(e, words.along):
        shown, space = listed(over), domain(over)
        shown = paren(shown) if len(over) > 1 and space else shown
        if space:
            shown += literal(r" \in ") + spelt(space)
        clauses.append(words.every + shown)
    if e.exists:
        clauses.append(words.some + listed(e.exists))
    if e in words.along:
        clauses.append(words.motion)
    return joined(clauses, literal(r",\ ")) if clauses else Formula("")


def clause_width(words: str) -> float:
    """The width, in em, that a clause takes at the end of a row."""
    return INDENT + 4.5 + measure(re.sub(r"\\text\{.*?\} ", "", words, count=1)) if words else 0.0


def closed(rows: Rows, words: str, last: float) -> Rows:
    """The rows with a clause at their end, or below where the last, ``last`` em wide, is full."""
    if not words:
        return rows
    if last + clause_width(words) <= ROOM:
        return [*rows[:-1], rf"{rows[-1]} \quad {words}"]
    return [*rows, rf"&\quad {words}"]
