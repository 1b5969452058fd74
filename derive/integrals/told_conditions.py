"""The steps of a record that say under which conditions on the parameters there is more.

d/dt F is a sum of multiples of p − s for the letters p that are solved, s being their values: it
vanishes in the case p = s.
"""

from __future__ import annotations

from typing import Any

from ..language.tree import Tree, add, mul, neg
from ..record.record import Equation, Step
from ..record.sentence import Prose
from ..walk.chapter import Chapter, Draft
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
    several = "condition.several" if len(x.integrals) > 1 else "condition.one"
    prose = draft.claim(several, condition=case_tree(whole.system.algebra, x.case))
    if x.proved.complete:
        rank = x.proved.rank
        prose += draft.claim("condition.complete", rank=rank, half=rank // 2)
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


def case_tree(algebra: Algebra, case: Case, *beside: Any) -> Tree:
    """The equations of a case: letters, each with its value; and others ``beside``, that vanish."""
    rows = [solved_letter(algebra, j, value) for j, value in case.solved]
    rows += [(algebra.number_tree(algebra.field(f)), 0) for f in beside]
    return ("matrix", *(("row", *x) for x in rows))


def all_conditions(whole: Found, found: Conditions, draft: Draft) -> Prose:
    """What is said of all conditions together."""
    algebra, degree = whole.system.algebra, whole.degree
    cases = [case_tree(algebra, x.case) for x in found.conditions]
    if cases:
        prose = draft.claim("first_integrals.further", degree=degree, conditions=("row", *cases))
    else:
        prose = draft.claim("first_integrals.no_further", degree=degree)
    if not found.unsolved:
        return prose
    unsolved = (case_tree(algebra, case, f) for case, f in found.unsolved)
    return prose + draft.claim("first_integrals.unsolved", conditions=("row", *unsolved))
