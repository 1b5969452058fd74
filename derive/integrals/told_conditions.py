"""The steps of a record that say under which conditions on the parameters there is more.

d/dt F is a sum of multiples of p − s for the letters p that are solved, s being their values: it
vanishes in the case p = s.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..language.show import in_sentence
from ..language.tree import Tree, add, mul, neg
from ..record.record import Equation, Step
from ..record.sentence import Prose
from ..walk.chapter import Chapter
from ..walk.wording import say
from .all_integrals import Condition, Conditions, Found
from .lie_poisson import Algebra
from .parameter_cases import Case


def told_conditions(whole: Found, found: Conditions, reduced: Step, c: Chapter) -> list[Step]:
    """A step for each condition, with the integrals that there are under it."""
    return [
        _under(whole, found, x, reduced, f"condition_{k}", c)
        for k, x in enumerate(found.conditions, 1)
    ]


def _under(
    whole: Found, found: Conditions, x: Condition, reduced: Step, label: str, c: Chapter
) -> Step:
    draft = c.draft(label, "Poisson bracket")
    draft.depends_on(reduced)
    equations = [
        Equation(("call", "d/dt", x.system.algebra.tree(f)), _rate(whole, found, x, f))
        for f in x.integrals
    ]
    words = case_text(whole.system.algebra, x.case)
    several = "condition.several" if len(x.integrals) > 1 else "condition.one"
    prose = say(several, condition=words)
    if x.proved.complete:
        sizes = {"rank": str(x.proved.rank), "half": str(x.proved.rank // 2)}
        prose += say("condition.complete", **sizes)
    return draft.step(equations, prose)


def _rate(whole: Found, found: Conditions, x: Condition, f: Any) -> Tree:
    """The rate for all parameters, as a sum of multiples of what vanishes in the case."""
    algebra, own = whole.system.algebra, x.system.algebra
    terms = {e: algebra.number(own.number_tree(c)) for e, c in own.over_the_field(f).items()}
    left, summed = algebra.derivative(terms), []
    for j, value in x.case.solved:
        there = found.cases.polynomial_at(Case(((j, value),)), left)
        zero = algebra.field.gens[j] - value
        quotient = {
            e: (left.get(e, algebra.field.zero) - there.get(e, algebra.field.zero)) / zero
            for e in left
        }
        quotient = {e: y for e, y in quotient.items() if y}
        letter, number = solved_letter(algebra, j, value)
        summed.append(mul(add(letter, neg(number)), algebra.field_tree(quotient)))
        left = there
    assert not left
    return add(*summed)


def solved_letter(algebra: Algebra, j: int, value: Any) -> tuple[Tree, Tree]:
    """A letter and its value, as trees."""
    name = algebra.system.parameters[j]
    return name if name == "π" else ("par", name), algebra.number_tree(value)


def case_text(algebra: Algebra, case: Case) -> str:
    """The equations of a case as text."""
    pairs = (solved_letter(algebra, j, value) for j, value in case.solved)
    return ", ".join(f"{in_sentence(x)} = {in_sentence(y)}" for x, y in pairs)


def all_conditions(whole: Found, found: Conditions) -> Prose:
    """What is proved of all conditions together."""
    algebra, degree = whole.system.algebra, str(whole.degree)
    texts = [case_text(algebra, x.case) for x in found.conditions]
    numbered = _listed(f"({k}) {x}" for k, x in enumerate(texts, 1))
    if texts:
        prose = say("first_integrals.further", degree=degree, conditions=numbered)
    else:
        prose = say("first_integrals.no_further", degree=degree)
    if not found.unsolved:
        return prose
    places = _listed(
        ", ".join(x for x in (case_text(algebra, case), f"{_polynomial(algebra, f)} = 0") if x)
        for case, f in found.unsolved
    )
    return prose + say("first_integrals.unsolved", conditions=places)


def _listed(texts: Iterable[str]) -> str:
    return "; ".join(texts)


def _polynomial(algebra: Algebra, f: Any) -> str:
    return in_sentence(algebra.number_tree(algebra.field(f)))
