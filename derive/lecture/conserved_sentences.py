"""What symmetries of a problem keep, told of each: the quantity alone, and that it is constant."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..language.show import SUBSCRIPTS, in_sentence, show
from ..language.tree import Tree, names
from ..record.prose import message
from ..record.record import Derivation, Step
from ..views.language import Language
from .lecture_text import Entry, Formula, Words
from .recorded_text import SPOKEN, in_each, words

ENERGY = "L̃ is invariant under {kind}: the energy {kept} is constant."
EXACT = "L̃ is invariant under {kind}: {kept} is constant."
UP_TO = "Under {kind}, L̃ changes by the derivative of a function alone: {kept} is constant."
REDUCED = "It is reduced by {kind}, whose momentum is {kept}."
AXIS = {2: "{kind} about {axis}", 1: "{kind} along {axis}"}
"""How many entries of the matrix of a field are not 0 → the field with its axis."""


def reduced_by(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """A sentence of each symmetry by which a problem is reduced."""
    for step in steps:
        for e in step.equations:
            if isinstance(e.lhs, tuple) and e.lhs[:2] == ("at", "𝒥"):
                momentum = f"{show(e.lhs)} = {in_sentence(e.rhs)}"
                texts = (_sentence(REDUCED, momentum, kind_of(d, step, x), x) for x in SPOKEN)
                yield in_each(*texts, labels=(step.label,))


def kept_by(step: Step) -> Tree:
    """What a step of a symmetry proves to be constant; 0 of any other step."""
    if ".conserved_" not in step.label or not any("d/dt" in names(e.lhs) for e in step.equations):
        return 0
    return next((e.rhs for e in step.equations if "ϖ" in names(e.lhs) and e.rhs != 0), 0)


def conserved(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """A sentence of each step of a symmetry, ``d``: the record of the walk."""
    for step in steps:
        kept = kept_by(step)
        exact = step.prose[0].message == message("symmetries.exact")
        told = (ENERGY if kept == "h̃" else EXACT) if exact else UP_TO
        texts = (_sentence(told, in_sentence(kept), kind_of(d, step, x), x) for x in SPOKEN)
        yield in_each(*texts, labels=(step.label,))


def _sentence(told: str, kept: str, kind: str, spoken: Language) -> Words:
    before, _, after = spoken.word(told, kind=kind, kept="\0").partition("\0")
    apart = () if after.startswith(".") else (" ",)
    return (*words(before), " ", Formula(kept, condition=True), *apart, *words(after))


def kind_of(d: Derivation, step: Step, spoken: Language) -> str:
    """What the symmetry of a step is, in a language, with its axis in space."""
    kind = next(y for x in step.prose for place, y in x.places if place == "kind")
    told = kind if isinstance(kind, str) else spoken.sentence(kind)
    field = next(e.rhs for e in step.equations if e.lhs == "δA")
    matrix = [x for x in field[1:] if x[0] == "matrix"] if isinstance(field, tuple) else []
    places = [*_places(matrix[0])] if len(matrix) == 1 and _in_space(d) else []
    if len(places) == 1 and places[0][1] == 3:
        axis = places[0][0]
    elif len(places) == 2 and places[0] == places[1][::-1] and max(places[0]) < 3:
        (axis,) = {0, 1, 2} - {*places[0]}
    else:
        return told
    letter = f"e{axis + 1}".translate(SUBSCRIPTS).replace("ₑ", "e")
    return spoken.word(AXIS[len(places)], kind=told, axis=letter)


def _places(matrix: Tree) -> Iterator[tuple[int, int]]:
    """Where the entries of a matrix are not 0."""
    assert isinstance(matrix, tuple)
    for i, row in enumerate(matrix[1:]):
        yield from ((i, j) for j, x in enumerate(row[1:]) if x != 0)


def _in_space(d: Derivation) -> bool:
    """Does the group of a record move space, by matrices on r or on (r, 1)?"""
    basis = d.problem.get("basis")
    if not isinstance(basis, list) or not basis:
        return False
    size = len(basis[0])
    return size == (4 if all(not any(map(_number, E[-1])) for E in basis) else 3)


def _number(x: object) -> bool:
    return str(x) not in ("0", "0.0")
