"""The vectors of the equations of motion that are seen on a body: of each the letter or term that
it is there, and what it means; its numbers are read off the motion, as outputs are.

A vector is in the frame of the part of the body that it belongs to.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from ..language.show import show
from ..language.tree import Tree, names, nodes, terms
from ..record.record import Derivation, Equation, Step
from .answer import equations_of_motion, steps_of_answer
from .figure.stated_inertia import SIZES, along, shifts, turns
from .language import Language
from .outline import latex_names
from .printing.tex import COMMA_SPACE, formula, joined

RATES = {"ζ", "ζ̇", "w_c", "Z", "Ż"}
"""What a term of the rate of w has that is no force."""
TURNING, ORIGIN = "angular velocity in the body", "velocity of the body's origin"
GRAVITY = "torque of gravity", "acceleration of gravity"
FORCES = "torque of the forces", "acceleration by the forces"
"""What vectors mean, as messages of the views."""
MOST = 10
"""So many have a colour."""


@dataclass(frozen=True)
class Arrow:
    """A vector: the ``trees`` that it is in equations, the first to be shown; what it means, as a
    message of the views, or by a symbol; its three entries; the ``part`` of the body, from 0; where
    it begins, at the body's origin or at its ``centre``; those of one ``scale`` are compared."""

    trees: tuple[Tree, ...]
    meaning: str
    of: str
    entries: tuple[Tree, ...]
    scale: str
    part: int = 0
    centre: bool = True

    @property
    def shown(self) -> tuple[Tree, ...]:
        """What names it: its letter or term, else the entries of a column."""
        first = self.trees[0]
        listed = isinstance(first, tuple) and first[0] == "entry"
        return self.trees if listed else (first,)


def arrows(d: Derivation) -> tuple[Arrow, ...]:
    """The vectors that stand in the answer of a record, the velocities first."""
    if not isinstance(d.problem.get("n"), int) or "basis" not in d.problem:
        return ()
    equations = (*steps_of_answer(d)[0].equations, *equations_of_motion(d))
    there = {t for e in equations for side in (e.lhs, e.rhs) for t in nodes(side)}
    found = [x for x in (*_velocities(d), *_terms(d)) if there & {*x.trees}]
    return tuple(found[:MOST])


def _velocities(d: Derivation) -> Iterator[Arrow]:
    """Those of each part that turns, or of its origin."""
    named = {s.name for s in d.symbols}
    factors = str(d.problem["group"]).split(" x ")
    if "w" in named and len(factors) == 1:
        entries: list[Tree] = [("entry", "w", k) for k in range(1, d.problem["n"] + 1)]
        if factors[0] in SIZES:
            yield _of_entries("ζ", [0, 1, 2], TURNING, "turning", 0)
        if len(entries) in (2, 3):
            made = (*entries, *[0] * (3 - len(entries)))
            yield Arrow(("w", *entries), ORIGIN, "", made, "sliding", centre=False)
        return
    offset, basis = 0, [[[*map(Fraction, row)] for row in E] for E in d.problem["basis"]]
    for part, name in enumerate(factors):
        if name not in SIZES:
            return
        at = along(basis, turns(offset))
        if -1 not in at:
            yield _of_entries("ζ", at, TURNING, "turning", part, len(basis) == 3)
        to = along(basis, shifts(offset, 3)) if name == "SE(3)" else [-1]
        if -1 not in to:
            yield _of_entries("ζ", to, ORIGIN, "sliding", part, False)
        offset += SIZES[name]


def _of_entries(
    letter: str, at: Sequence[int], meaning: str, scale: str, part: int, whole: bool = True
) -> Arrow:
    """The vector of some entries of a column, from 0; is that the ``whole`` column?"""
    entries = tuple(("entry", letter, k + 1) for k in at)
    alone = (letter,) if whole and [*at] == [0, 1, 2] else ()
    return Arrow((*alone, *entries), meaning, "", entries, scale, part, scale == "turning")


def _terms(d: Derivation) -> Iterator[Arrow]:
    """What turns a body of space and what moves it, term by term; its angular momentum."""
    for e in steps_of_answer(d)[0].equations:
        match e.lhs, e.rhs:
            case "ζ̇", ("mul", ("inv", "I" | "I_c" as inertia), torque):
                momentum = ("mul", inertia, "ζ")
                yield _term(momentum, "angular momentum in the body", "", "momentum")
                for t in terms(torque):
                    if t == ("wedge", momentum, "ζ"):
                        yield _term(t, "gyroscopic torque", "", "torque")
                    else:
                        yield _term(t, *_cause(t, 0), "torque")
            case "ẇ", force if d.problem["n"] == 3:
                for t in terms(force):
                    if not RATES & {*names(t)}:
                        yield _term(t, *_cause(t, 1), "force")


def _cause(t: Tree, moves: int) -> tuple[str, str]:
    """What a term that turns, or ``moves``, means: as a message, or by a symbol."""
    if isinstance(t, str):
        return "", t
    return (GRAVITY if "γ" in names(t) else FORCES)[moves], ""


def _term(t: Tree, meaning: str, of: str, scale: str) -> Arrow:
    """A term of a column of three numbers."""
    entries = tuple(("entry", t, k) for k in (1, 2, 3))
    return Arrow((t,), meaning, of, entries, scale)


# What is made of them: the record whose code has their numbers, the marks of the answer, the words.


def with_arrows(d: Derivation, found: Sequence[Arrow]) -> Derivation:
    """The record with one output more for each entry of each arrow, behind its own."""
    equations = (
        Equation(("par", f"arrow_{i}_{k}"), t)
        for i, x in enumerate(found, 1)
        for k, t in enumerate(x.entries, 1)
    )
    step = Step(f"{d.name}.arrows", "output", (), tuple(equations), ())
    return replace(d, steps=(*d.steps, step)) if found else d


def marks(found: Sequence[Arrow]) -> dict[Tree, str]:
    """Tree → the number of its arrow, as the page has it."""
    return {t: str(i) for i, x in enumerate(found, 1) for t in x.trees}


def legend(d: Derivation, found: Sequence[Arrow], language: Language) -> list[dict[str, str]]:
    """Of each arrow the letter or term that it is, as MathML, and what that means."""
    typeset = latex_names(d)
    meanings = {s.name: language.of(s.meaning).partition(", ‘")[0] for s in d.symbols}
    return [
        {
            "shown": joined([formula(t, typeset) for t in x.shown], COMMA_SPACE).plain().mathml(),
            "meaning": meanings[x.of] if x.of else language.word(x.meaning),
        }
        for x in found
    ]


def drawn(found: Sequence[Arrow], after: int) -> list[dict[str, Any]]:
    """What draws the arrows, as JSON has it; their numbers stand ``after`` so many others."""
    return [
        {
            "at": after + 3 * i,
            "label": ", ".join(map(show, x.shown)),
            "part": x.part,
            "scale": x.scale,
            **({"centre": True} if x.centre else {}),
        }
        for i, x in enumerate(found)
    ]
