"""The well-formedness of equations: known heads, arguments of their kinds, letters of indices.

What stands around a head, or beside its arguments, has no value of its own: it is judged here, by
the tables of :mod:`derive.check.function_signatures`, before anything is evaluated.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Set
from typing import Any

from ..language.show import show
from ..language.tree import Tree, nodes
from ..record.record import Equation
from .function_signatures import (
    FORMS,
    HEADS,
    INDEX_SETS,
    INDICES,
    MOVED,
    NUMBERED,
    OF_ELEMENTS,
    QUANTIFIED,
    RATES,
    SOLVED,
    TRANSLATION,
    Kind,
    is_polynomial,
)
from .locus import TIME, Locus

SHOWN = 40
"""The most letters of a faulty subtree that a message shows."""


def first_fault(t: Tree, *, affine: bool, inside: str = "") -> str:
    """The first ill-formed head, argument or index of a tree, in words; "" if there is none.

    ``affine``: does the group translate? ``inside``: the operator of which the tree is an operand.
    """
    if not isinstance(t, tuple):
        return ""
    parts = (first_fault(x, affine=affine, inside=t[0]) for x in t[1:])
    return _operator_fault(t, inside, affine) or next(filter(None, parts), "")


def along_any(equation: Equation, used: Collection[str]) -> bool:
    """Does an equation speak of X, or of rates along it?"""
    inside = [*nodes(equation.lhs), *nodes(equation.rhs)]
    return "X" in used or any(isinstance(x, tuple) and x[:2] == ("call", "d/dt") for x in inside)


def quantifier_fault(equation: Equation, at: Locus) -> str:
    """What is wrong with the first quantified name of an equation, in words; "" if none.

    A name of ``for_all`` must be a variation or an acceleration that is drawn freely and stands in
    the equation, one of ``exists`` a multiplier that stands in it. ``at``: the hypotheses of the
    step, which may fix a variation.
    """
    used = {*_values_of(equation.lhs), *_values_of(equation.rhs)}
    if fault := _existence_fault(equation, used):
        return fault
    first, second, rates = ({x for form in forms for x in form} for forms in (*FORMS, RATES))
    fixed = (second if at.vanishing - {TIME} else set()) | (first if at.contracted else set())
    for name in equation.for_all:
        if name not in QUANTIFIED:
            return f"nothing holds for all {_shortened(name)}: it is no variation"
        if name not in used or equation.for_all.count(name) > 1:
            return f"it says nothing of {name}, for all values of which it is to hold"
        if name in fixed:
            return f"{name} is fixed by a hypothesis of the step: nothing holds for all of it"
        if name in rates and not along_any(equation, used):
            return f"nothing holds for all {name}: it is the acceleration of the motion"
        if name in rates and not used & rates <= {*equation.for_all}:
            return f"it is to hold for all {name}, and not for all of the acceleration"
        if used & {*OF_ELEMENTS} and used & {*first, *second}:
            return f"it has {name} beside another variation, which are tied to one another"
        if name in OF_ELEMENTS:
            continue
        together = used & next(x for x in (first, second, rates) if name in x)
        if not any(together <= {*form} for forms in (*FORMS, RATES) for form in forms):
            return f"it has {', '.join(sorted(together))}, which are tied to one another"
    return ""


def _existence_fault(equation: Equation, used: Set[str]) -> str:
    """What is wrong with a name of ``exists``, in words; "" if nothing is."""
    for name in equation.exists:
        if name not in SOLVED:
            return f"that there is some {_shortened(name)} is not found: it is no multiplier"
        if name not in used or equation.exists.count(name) > 1:
            return f"it says nothing of {name}, which is to exist"
    return ""


def _values_of(t: Tree) -> Iterator[str]:
    """The names in a tree that stand for their values, not for functions."""
    if isinstance(t, str):
        yield t
    elif isinstance(t, tuple):
        for x in t[2:] if t[0] in ("call", "par") else t[1:]:
            yield from _values_of(x)


def _operator_fault(t: tuple[Any, ...], inside: str, affine: bool) -> str:
    """What is wrong with the outermost operator of a tree, in words; "" if nothing is."""
    if t[0] == "call":
        return _call_fault(t[1], t[2:], affine)
    if t[0] == "row" and inside != "matrix":
        return "a row is part of a matrix"
    if t[0] == "at" and len(t) != 3:
        return f"a member of {_shortened(t[1])} has one index"
    if t[0] == "at" and t[1] not in INDEX_SETS:
        return f"no members of {_shortened(t[1])}, which is no family"
    index = next((x for x in _indices(t) if x not in INDICES), None)
    return "" if index is None else f"{_shortened(index)} is no index: {', '.join(INDICES)} are"


def _indices(t: tuple[Any, ...]) -> Iterator[str]:
    """The letters that stand in a tree's outermost operator in the place of an index."""
    places = {"sum": t[1:2], "at": t[2:], "entry": t[2:]}.get(t[0], ())
    return (x for x in places if isinstance(x, str))


def _call_fault(head: Tree, arguments: tuple[Tree, ...], affine: bool) -> str:
    """What is wrong with a call: its head, how many arguments, or the kind of one."""
    kinds = _kinds_of(head)
    if kinds is None:
        return f"no function is called {_shortened(head)}"
    kinds = tuple(x for x in kinds if affine or x is not TRANSLATION)
    if head in NUMBERED and len(arguments) > 1:
        kinds = NUMBERED[head]  # type: ignore[index]
    if len(arguments) != len(kinds):
        expected = f"{len(kinds)} argument{'s' * (len(kinds) != 1)}"
        return f"{_shortened(head)} has {expected}, not {len(arguments)}"
    for kind, x in zip(kinds, arguments, strict=True):
        if not _is_of(kind, x):
            return f"{_shortened(head)} is of {kind.description}, not of {_shortened(x)}"
    return ""


def _kinds_of(head: Tree) -> tuple[Kind, ...] | None:
    """The kinds of the arguments that a head takes; ``None`` for what is no head."""
    if isinstance(head, str):
        return HEADS.get(head)
    member = isinstance(head, tuple) and head[0] == "at" and len(head) == 3
    return MOVED.get(head[1]) if member and isinstance(head, tuple) else None


def _is_of(kind: Kind, x: Tree) -> bool:
    if x in kind.letters or (kind.polynomial and is_polynomial(x)):
        return True
    if kind.less and isinstance(x, tuple) and x[0] == "add" and x[1] in kind.letters:
        return {*map(_name, nodes(("add", 0, *x[2:])))} <= {None, "t", "A", "π"}
    if kind.members and isinstance(x, tuple) and x[:2] == ("at", kind.members):
        return True
    called = isinstance(x, tuple) and x[0] == "call" and isinstance(x[1], tuple)
    if called and (x[1][1], *x[2:]) == kind.applied:  # type: ignore[index]
        return True
    return bool(kind.family and called and x[1][:2] == ("at", kind.family))  # type: ignore[index]


def _name(t: Tree) -> str | None:
    """A name, or that of a function; ``None`` of any other tree."""
    return t if isinstance(t, str) else t[0] if isinstance(t, tuple) and t[0] == "call" else None


def _shortened(t: Tree) -> str:
    """A tree as text, cut to a length that fits a message."""
    text = show(t)
    return text if len(text) <= SHOWN else f"{text[:SHOWN]} …"
