"""The road of a record in a few stations: of each the formula that it ends with there, the step
that has it, and the numbers of the paper on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

from ..language.tree import Tree, terms
from ..record.record import ANY_GROUP, Derivation, Equation, Step
from .answer import ANGLE, EXPANDED, by_angle, steps_of_answer
from .outline import latex_names, printed
from .printing.signs import Notation
from .printing.tex import formula as of_tree
from .printing.typeset import Formula, literal, measure
from .printing.typeset import word as symbol

WIDE = 15.0
"""em: terms that go beyond are left out."""
DOTS = symbol(r"\dots", "…")


@dataclass(frozen=True)
class Station:
    """A place on the road by its ``name``; ``numbers``: those of the paper, as they are shown."""

    name: str
    step: Step
    equation: Equation
    numbers: str


def _of(*heads: Tree) -> Callable[[Step, Equation], bool]:
    """Is it an equation for one of these, no special case of it?"""
    return lambda s, e: e.lhs in heads and s.rule not in ("restriction", "kernel")


def _form(*names: str) -> Callable[[Step, Equation], bool]:
    """Is it an equation for a form in the variations δy, and δ′y, that has one of the names?"""
    return _of(*(("call", x, *y) for x in names for y in (("δy",), ("δy", "δ′y"))))


ROAD: dict[str, Callable[[Step, Equation], bool]] = {
    "lagrangian": _of("L"),
    "group": _of("L̃", "L_d"),
    "cartan": _form("ϖ"),
    "exterior": _form("dϖ"),
    "kernel": lambda s, e: s.rule == "kernel",
}
"""The stations before those of one body: which equations they have."""


def stations(d: Derivation) -> tuple[Station, ...]:
    """Those that the record comes by, in the order of the road, then the equation of its own
    body, and what its motion keeps."""
    found = [*filter(None, (_station(d, name, has) for name, has in ROAD.items()))]
    told = steps_of_answer(d)
    own = told[-1] if told[-1].label == f"{d.name}.{EXPANDED[-1]}" else told[0]
    if own.scope == ANY_GROUP or own in (x.step for x in found):
        return tuple(found)
    rates = [e for e in own.equations if isinstance(e.lhs, tuple) and e.lhs[0] == "entry"]
    kept = [s for s in d.steps if s.label == f"{d.name}.conserved"]
    found.append(Station("body", own, (*rates, own.equations[-1])[0], printed(own)))
    return (*found, *(Station("kept", s, s.equations[-1], printed(s)) for s in kept))


def _station(d: Derivation, name: str, has: Callable[[Step, Equation], bool]) -> Station | None:
    """The last step that has such an equation; nothing where there is none. Of dϖ its first one:
    that by momenta."""
    there = [(s, e) for s in d.steps for e in s.equations if has(s, e)]
    if not there:
        return None
    step = there[-1][0]
    equation = [e for s, e in there if s is step][0 if name == "exterior" else -1]
    numbers = sorted({n for s, _ in there for n in s.paper})
    return Station(name, step, equation, printed(replace(step, paper=tuple(numbers))))


def station_mathml(d: Derivation, x: Station) -> str:
    """The formula of a station as MathML, without the terms that go too far; of the body in the
    plane by its angle, as in the answer."""
    typeset = partial(of_tree, names=ANGLE | latex_names(d), notation=Notation())
    rhs = by_angle(d)(x.equation.rhs) if x.name == "body" else x.equation.rhs
    return _short(typeset(x.equation.lhs), rhs, typeset).plain().mathml()


def _short(lhs: Formula, rhs: Tree, typeset: Callable[[Tree], Formula]) -> Formula:
    """An equation with as many terms of its right side as there is room for."""
    whole, dots = lhs + literal(" = ") + typeset(rhs), literal(" + ") + DOTS
    parts = [*terms(rhs)]
    for count in range(len(parts) - 1, 0, -1):
        if measure(whole.tex) <= WIDE:
            break
        whole = lhs + literal(" = ") + typeset(("add", *parts[:count])) + dots
    fits = measure(whole.tex) <= 2 * WIDE
    return whole if fits else lhs + literal(" = ") + DOTS


def told(d: Derivation, identified: Callable[[str], str]) -> Iterator[dict[str, str]]:
    """The stations as a page has them; ``identified``: label → the id of its step there."""
    for x in stations(d):
        shown = station_mathml(d, x)
        yield {"name": x.name, "id": identified(x.step.label), "shown": shown, "paper": x.numbers}
