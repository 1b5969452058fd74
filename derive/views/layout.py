"""A record as it is read: common factors of parameters before their sum, l²(m₁ + m₂), no brackets
around a sum in a sum; entries of g as problem files type them, in a product by the blocks of the
factors, A₃₃ of two rotations of the plane, A2_11 in a file, is (A₂)₁₁, and places as T; and those
of Γ by the names of what the algebra carries along. And the equations of a step as rows of an
alignment, none wider than the page.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, product
from typing import Any

from ..algebra.families import group
from ..algebra.groups import Group
from ..language.reserved import advected_entries
from ..language.show import in_sentence, show
from ..language.tree import Tree, add, coefficient, mul, neg, operands, terms
from ..record.record import Derivation, Equation, Step, Symbol
from ..record.sentence import Prose, Sentence, phrase
from .gathered import as_monomial, less, of_parameters, shared_powers
from .language import ENGLISH, Entry, Language, entries
from .outline import domain, moving, quantified
from .printing.sentences import spelt
from .printing.signs import OVERDOT, Notation, tex_text
from .printing.tex import formula, guarded, joined, latex_tree, marked, paren, pieces
from .printing.typeset import Formula, Line, fill, literal, measure, plain, text

OF_G = ("A", "Ȧ")
"""The letters of matrices that have a block for each factor."""
MEANING = "{meaning}; its blocks are {blocks}"
LAST = "{meaning}; {last}: last column of the matrix"
ELEMENT = "element of the group"
CARRIED = "{meaning}; its components are {entries}"


class Reading:
    """How equations and sentences of a record are read, by its problem; a sum with one of the terms
    ``apart`` is not factored."""

    def __init__(self, problem: Mapping[str, Any], apart: Collection[Tree] = ()):
        self.apart = {*apart}
        places = _factors(str(problem["group"]))
        self.count = len(places) if len(places) > 1 else 0
        self.spans = [(at, at + x.size) for at, x in places[: self.count]]
        self.named = _entries(places) | _carried(problem)
        self.texts = {show(old): in_sentence(new) for old, new in self.named.items()}
        self.found = re.compile("|".join(rf"{re.escape(x)}(?!,?[₀-₉])" for x in self.texts))

    def tree(self, t: Tree) -> Tree:
        """A tree as it is read."""
        if not isinstance(t, tuple) or t[0] == "par":
            return t
        if t in self.named:
            return self.named[t]
        found = unfolded((t[0], *map(self.tree, t[1:])))
        if t[0] != "add" or self.apart.isdisjoint(t[1:]):
            found = factored(found)
        return _by_blocks(found, self.spans) if t[0] == "matrix" else found

    def equation(self, e: Equation) -> Equation:
        """An equation as it is read."""
        return replace(e, lhs=self.tree(e.lhs), rhs=self.tree(e.rhs))

    def text(self, text: str) -> str:
        """A text with its entries of g by their blocks."""
        return self.found.sub(lambda x: self.texts[x[0]], text) if self.texts else text

    def _prose(self, said: Prose) -> Prose:
        return tuple(
            Sentence(x.message, tuple((place, self._filled(y)) for place, y in x.places))
            for x in said
        )

    def _filled(self, x: Sentence | str) -> Sentence | str:
        return self.text(x) if isinstance(x, str) else self._prose((x,))[0]

    def step(self, s: Step) -> Step:
        """A step as it is read."""
        equations = tuple(map(self.equation, s.equations))
        return replace(s, equations=equations, prose=self._prose(s.prose))

    def symbol(self, x: Symbol) -> Symbol:
        """A symbol; that of g with its blocks, that of Γ with its entries."""
        if x.name == "Γ" and self.named:
            entries = ", ".join(
                y for t, y in self.texts.items() if t.startswith("Γ") and OVERDOT not in t
            )
            return replace(x, meaning=(phrase(CARRIED, meaning=x.meaning[0], entries=entries),))
        if x.name != "A" or not str(x.meaning[0]).startswith(ELEMENT):
            return x
        blocks = ", ".join(show(("at", "A", k + 1)) for k in range(self.count))
        columns = (show(t[1]) for t in self.named.values() if isinstance(t, tuple) and len(t) == 3)
        last = ", ".join(x for x in dict.fromkeys(columns) if x.startswith("T"))
        meaning = x.meaning[0]
        if blocks:
            meaning = phrase(MEANING, meaning=meaning, blocks=blocks)
        if last:
            meaning = phrase(LAST, meaning=meaning, last=last)
        return replace(x, meaning=(meaning,))


def as_read(d: Derivation) -> Derivation:
    """The record as it is read; to be shown, not to be checked."""
    reading = Reading(d.problem)
    steps, symbols = map(reading.step, d.steps), map(reading.symbol, d.symbols)
    return replace(d, steps=tuple(steps), symbols=tuple(symbols))


def _carried(problem: Mapping[str, Any]) -> dict[Tree, Tree]:
    """Each entry of Γ, and its rate → by the name that the problem has for it."""
    found: dict[Tree, Tree] = {}
    for i, name in enumerate(advected_entries(problem), 1):
        letter, _, index = name.rpartition("_")
        found["entry", "Γ", i] = ("par", name)
        dotted = ("par", f"{letter}{OVERDOT}_{index}")
        found["entry", "Γ̇", i] = dotted if len(letter) == 1 else ("call", "d/dt", ("par", name))
    return found


def _factors(name: str) -> tuple[tuple[int, Group], ...]:
    """The factors of a group by its name, one of which may act on (r, 1), each with its first row;
    none of a group of the problem's own, or of any group."""
    try:
        places = group(name).places
    except ValueError:
        return ()
    return places if len(places) > 1 or places[0][1].affine else ()


def _entries(places: Sequence[tuple[int, Group]]) -> dict[Tree, Tree]:
    """Each entry of g by the rows and columns of the whole → by those of its block, of the last
    column of one that moves (r, 1) by those of T."""
    found: dict[Tree, Tree] = {}
    for k, (at, x) in enumerate(places, 1):
        span, last = range(1, x.size + 1), x.n + 1 if x.affine else 0
        for letter, moved in zip(OF_G, ("T", "Ṫ"), strict=True):
            several = len(places) > 1
            block, column = (("at", y, k) if several else y for y in (letter, moved))
            for i, j in product(span, repeat=2):
                own = ("entry", column, i) if i < j == last else ("entry", block, i, j)
                found["entry", letter, at + i, at + j] = own
    return found


def _by_blocks(t: Tree, spans: Sequence[tuple[int, int]]) -> Tree:
    """A matrix that is 0 outside of the blocks of the factors as diag of these; any other tree as
    it is."""
    rows = [[*operands(x)] for x in operands(t)]
    size = spans[-1][1] if spans else 0
    if [*map(len, rows)] != [size] * size or not rows:
        return t
    inside = {(i, j) for a, b in spans for i in range(a, b) for j in range(a, b)}
    if any(x != 0 and (i, j) not in inside for i, r in enumerate(rows) for j, x in enumerate(r)):
        return t
    cut = ((("row", *r[a:b]) for r in rows[a:b]) for a, b in spans)
    return ("call", "diag", *(("matrix", *x) for x in cut))


def unfolded(t: Tree) -> Tree:
    """A sum without brackets around sums in it, and −(−a − b) as a + b; any other tree as it is."""
    match t:
        case ("add", *parts):
            return ("add", *(y for x in parts for y in terms(x)))
        case ("mul", -1, ("add", *parts)) if all(coefficient(x)[0] < 0 for x in parts):
            return ("add", *map(neg, parts))
    return t


def factored(t: Tree) -> Tree:
    """A sum of products of parameters with the factors of all of them before it; any other tree as
    it is."""
    monomials = [*map(as_monomial, terms(t))]
    powers = [p for _, p in monomials]
    common = shared_powers(powers)
    whole = all(c == 1 and of_parameters(p) and min(p.values()) > 0 for c, p in monomials if p)
    if len(monomials) < 2 or not common or not whole:
        return t
    return mul(_product(common), add(*(_product(less(p, common)) for p in powers)))


def _product(powers: Mapping[Tree, int]) -> Tree:
    return mul(1, *(("pow", x, k) if k > 1 else x for x, k in powers.items()))


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
    """The LaTeX of a line that continues a formula, indented by ``quads`` and its depth; a product
    that is broken before a bracket has its sign there."""
    tex = line.text.replace(r"\,(", r"\times (", 1) if line.text.startswith(r"\,(") else line.text
    sign = "{}" if tex[:1] in "+-" else ""
    return r"\quad" * (quads + line.inside) + " " + sign + tex


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
