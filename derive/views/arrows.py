"""The vectors of the equations of motion that are seen on a body: of each the letter or term that
it is there, and what it means; its numbers are read off the motion, as outputs are.

A vector is in the frame of the part of the body that it belongs to; in a plane, one that turns it
stands out of the plane. A matrix is seen as what it makes of the points of the body.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..language.show import show, signed
from ..language.tree import Tree, names, neg, nodes, terms
from ..record.record import Derivation, Equation, Step
from .answer import ANGLE, by_angle, equations_of_motion, steps_of_answer
from .figure.scene import SIZES, along, basis_of, shifts, turns
from .language import Language
from .layout import Reading
from .outline import latex_names
from .printing.tex import COMMA_SPACE, formula, joined

RATES = {"ζ", "ζ̇", "w_c", "Z", "Ż"}
"""What a term of the rate of w has that is no force."""
TURNING, ORIGIN = "angular velocity in the body", "velocity of the body's origin"
GRAVITY = "torque of gravity", "acceleration of gravity"
FORCES = "torque of the forces", "acceleration by the forces"
"""What vectors mean, as messages of the views."""
WHOLE, TURNED = "whole torque", "angular acceleration by the forces"
POINTS = "velocity of the points about the origin"
PULLED = "acceleration of the points by the forces"
HELD = "acceleration of the points that keeps the volume"
CARRIED = "acceleration of the points by their own motion"
PLANAR = {"SO(2)": 2, "SE(2)": 3}
"""The factors that turn a body of the plane, and the size of their matrices."""
MOST, FEW = 10, 3
"""So many have a colour; a rate of so many terms is seen term by term, of more as a whole."""


@dataclass(frozen=True)
class Arrow:
    """A vector: the ``trees`` that it is in equations, the first to be shown; what it means, as a
    message of the views, or by a symbol; its entries, three for each of the ``parts`` of the body,
    from 0, that have one, or nine, row by row, of a matrix; where it begins, at the body's origin
    or at its ``centre``; those of one ``scale`` are compared."""

    trees: tuple[Tree, ...]
    meaning: str
    of: str
    entries: tuple[Tree, ...]
    scale: str
    parts: tuple[int, ...] = (0,)
    centre: bool = True

    @property
    def shown(self) -> tuple[Tree, ...]:
        """What names it: its letter or term, else the entries of a column."""
        first = self.trees[0]
        listed = isinstance(first, tuple) and first[0] == "entry"
        return tuple(t for t in self.trees if t != "Z") if listed else (first,)


def arrows(d: Derivation) -> tuple[Arrow, ...]:
    """The vectors that stand in the answer of a record, the velocities first."""
    if not isinstance(d.problem.get("n"), int) or "basis" not in d.problem:
        return ()
    told = _there(equations_of_motion(d))
    there = told | _there(steps_of_answer(d)[0].equations)
    found = [x for x in _velocities(d) if there & {*x.trees}]
    if not any(x.scale == "turning" for x in found):
        found += _in_letters(d, "Z", TURNING, "turning")
    terms = {x.trees: x for x in _terms(d) if there & {*x.trees}}
    found += _momentum_of_lagrangian(d)
    moved = len(_factors(d)) > 1 or "w" in {s.name for s in d.symbols}
    loads = _in_letters(d, "β", WHOLE, "torque") if "β" in (there if moved else told) else ()
    return (*found, *loads, *terms.values())[:MOST]


def _there(equations: Iterable[Equation]) -> set[Tree]:
    """The trees that stand in equations."""
    return {t for e in equations for side in (e.lhs, e.rhs) for t in nodes(side)}


def _factors(d: Derivation) -> list[str]:
    return str(d.problem["group"]).split(" x ")


def _turning(d: Derivation) -> list[list[int]]:
    """Of each part the numbers, from 0, of the basis that turn it about e_1, e_2, e_3, −1 for none;
    nothing where a part is more than turned and moved."""
    offset, basis, found = 0, basis_of(d.problem), []
    for name in _factors(d):
        at = along(basis, turns(offset))
        if name in PLANAR:
            at = [-1, -1, at[2]]
        if name not in SIZES | PLANAR or at[2] == -1:
            return []
        found.append(at)
        offset += (SIZES | PLANAR)[name]
    return found


def _in_letters(d: Derivation, letter: str, meaning: str, scale: str) -> Iterator[Arrow]:
    """Z, or the load β, where the parts have no other motion in it than to turn, by its entries in
    the basis; else Z as it moves the points."""
    turning = _turning(d)
    if turning and ("w" in {s.name for s in d.symbols} or "SE" not in d.problem["group"]):
        column = "ζ" if letter == "Z" else letter
        entries = (("entry", column, k + 1) if k >= 0 else 0 for at in turning for k in at)
        told: tuple[Tree, ...] = (letter,)
        if letter == "Z" and d.problem["group"] in PLANAR:
            told = (("entry", "ζ", turning[0][2] + 1), letter)  # the rate of the angle
        yield Arrow(told, meaning, "", (*entries,), scale, (*range(len(turning)),))
    elif letter == "Z" and not turning and _moves_points(d):
        yield _matrix(("Z",), POINTS, "sliding", d.problem["n"])


def _moves_points(d: Derivation) -> bool:
    """Is Z the matrix of one factor that moves points of the plane, or of space?"""
    advected, single = d.problem.get("advected"), len(_factors(d)) == 1
    return not advected and single and d.problem["n"] in (2, 3)


def _velocities(d: Derivation) -> Iterator[Arrow]:
    """Those of each part that turns, or of its origin."""
    named = {s.name for s in d.symbols}
    factors = _factors(d)
    if "w" in named and len(factors) == 1:
        entries: list[Tree] = [("entry", "w", k) for k in range(1, d.problem["n"] + 1)]
        if factors[0] in SIZES:
            yield _of_entries("ζ", [0, 1, 2], TURNING, "turning", 0)
        if len(entries) in (2, 3):
            yield Arrow(("w", *entries), ORIGIN, "", _padded(entries), "sliding", centre=False)
        return
    offset, basis = 0, basis_of(d.problem)
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


def _momentum_of_lagrangian(d: Derivation) -> Iterator[Arrow]:
    """Π of a body that a Lagrangian tells, as its walk has it by the velocities; of SE(3), the part
    about the body's origin."""
    turning = _turning(d)
    told = [s for s in d.steps if s.label == f"{d.name}.momenta"]
    Π = {e.lhs: e.rhs for s in told for e in s.equations}
    if len(turning) == 1 and -1 not in turning[0] and ("at", "Π", 1) in Π:
        entries = tuple(Π["at", "Π", k + 1] for k in turning[0])
        yield Arrow(("Π",), "angular momentum in the body", "", entries, "momentum", centre=False)


def _of_entries(
    letter: str, at: Sequence[int], meaning: str, scale: str, part: int, whole: bool = True
) -> Arrow:
    """The vector of some entries of a column, from 0; is that the ``whole`` column?"""
    entries = tuple(("entry", letter, k + 1) for k in at)
    alone = (letter,) if whole and [*at] == [0, 1, 2] else ()
    named = (*alone, *entries, *(("Z",) if alone else ()))
    return Arrow(named, meaning, "", entries, scale, (part,), scale == "turning")


def _padded(entries: Sequence[Tree]) -> tuple[Tree, ...]:
    """Two entries or three as three."""
    return (*entries, *[0] * (3 - len(entries)))


def _terms(d: Derivation) -> Iterator[Arrow]:
    """What turns a body and what moves it, or its points, term by term; its angular momentum."""
    n, turning = d.problem["n"], _turning(d)
    for e in (*steps_of_answer(d)[0].equations, *equations_of_motion(d)):
        match e.lhs, e.rhs:
            case "ζ̇", ("mul", ("inv", "I" | "I_c" as inertia), torque):
                momentum = ("mul", inertia, "ζ")
                yield _term((momentum,), "angular momentum in the body", "", "momentum")
                for t in _signed(torque):
                    if t[-1] == ("wedge", momentum, "ζ"):
                        yield _term(t, "gyroscopic torque", "", "torque")
                    else:
                        yield _term(t, *_cause(t[-1], 0), "torque")
            case "ẇ", force if n in (2, 3):
                for t in _signed(force):
                    if not RATES & {*names(t[0])}:
                        yield _term(t, *_cause(t[-1], 1), "force", n)
            case "Ż", force if not turning and _moves_points(d) and "ζ̇" not in names(force):
                for t in _signed(force):
                    yield _matrix(t, _cause_of_matrix(t[0]), "force", n)
            case ("entry", "ζ̇", k), rate if [-1, -1, k - 1] in turning:
                for t in _signed(rate) if len(terms(rate)) <= FEW else ():
                    if not RATES & {*names(t[0])}:
                        part = turning.index([-1, -1, k - 1])
                        yield Arrow(t, TURNED, "", (0, 0, t[0]), "torque", (part,))


def _signed(t: Tree) -> Iterator[tuple[Tree, ...]]:
    """The terms of a sum, each as it is, then without its sign."""
    for sign, term in signed(t):
        yield (term,) if sign == "+" else (neg(term), term)


def _matrix(trees: tuple[Tree, ...], meaning: str, scale: str, n: int) -> Arrow:
    """A matrix, of n rows."""
    span = (1, 2, 3)
    entries = (("entry", trees[0], i, j) if max(i, j) <= n else 0 for i in span for j in span)
    return Arrow(trees, meaning, "", (*entries,), scale)


def _cause(t: Tree, moves: int) -> tuple[str, str]:
    """What a term that turns, or ``moves``, means: as a message, or by a symbol."""
    if isinstance(t, str):
        return "", t
    return (GRAVITY if "γ" in names(t) else FORCES)[moves], ""


def _cause_of_matrix(t: Tree) -> str:
    """What a term of the rate of Z means."""
    there = {*names(t)}
    return HELD if "θ" in there else CARRIED if there == {"Z"} else PULLED


def _term(trees: tuple[Tree, ...], meaning: str, of: str, scale: str, n: int = 3) -> Arrow:
    """A term of a column of n numbers."""
    entries = _padded([("entry", trees[0], k) for k in range(1, n + 1)])
    return Arrow(trees, meaning, of, entries, scale)


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
    typeset, turned, read = latex_names(d) | ANGLE, by_angle(d), Reading(d.problem).tree
    meanings = {s.name: language.of(s.meaning).partition(", ‘")[0] for s in d.symbols}
    return [
        {
            "shown": joined([formula(turned(read(t)), typeset) for t in x.shown], COMMA_SPACE)
            .plain()
            .mathml(),
            "meaning": meanings[x.of] if x.of else language.word(x.meaning),
        }
        for x in found
    ]


def drawn(d: Derivation, found: Sequence[Arrow], after: int) -> list[dict[str, Any]]:
    """What draws the arrows, as JSON has it; their numbers stand ``after`` so many others."""
    turned, read = by_angle(d), Reading(d.problem).tree
    return [
        {
            "number": i,
            "at": after + sum(len(y.entries) for y in found[: i - 1]) + 3 * k,
            "label": ", ".join(show(turned(read(t))) for t in x.shown),
            "part": part,
            "scale": x.scale,
            **({"centre": True} if x.centre else {}),
            **({"matrix": True} if len(x.entries) == 9 and len(x.parts) == 1 else {}),
        }
        for i, x in enumerate(found, 1)
        for k, part in enumerate(x.parts)
    ]
