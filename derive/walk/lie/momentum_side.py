"""The motion told by momenta: the velocity from them, and the Poisson tensor of the variables.

    ζ = M⁻¹(Π − b),  {Π_a, Π_b} = ε Σ c_ba^k Π_k,  {Γ_i, Π_b} = E_b·Γ_i,  Ḟ = {F, h̃} + Σ Φ_a ∂F/∂Π_a

with [E_b, E_a] = Σ c_ba^k E_k.  These brackets are the entries of 𝕁; of h̃, a function of Π and Γ, ζ
is the derivative by Π, and −∂L̃/∂Γ that by Γ.  Where Γ is in place of g, Φ is a part of {Π, h̃}.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ...algebra.groups import Group
from ...language.derivatives import derivative
from ...language.tree import Tree, add, mul, neg, nodes
from ...problem.problem import Problem
from ...problem.state_names import coordinates
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..wording import say
from .any_lagrangian import AnyLagrangian
from .basis import Basis, member
from .expressed import Expressed, coadjoint_terms, tidied


def by_momenta(
    stage: Expressed,
    problem: Problem,
    group: Group,
    general: AnyLagrangian,
    basis: Basis,
    balance: Sequence[Step],
    c: Chapter,
    c_u: Chapter,
) -> tuple[Step, ...]:
    """ζ by Π where L̃ is quadratic in ζ, and 𝕁 with the rates; nothing on a quotient of the group,
    whose momenta are not all of 𝔤*."""
    assert problem.lagrangian is not None
    if problem.lagrangian.held:
        return ()
    mass = next(x for x in balance if x.label == c.label("mass"))
    coadjoint = next(x for x in balance if x.label == c.label("coadjoint"))
    moving, variables = _moving(stage, problem, group), _brackets(problem, group, general, basis)
    draft = c_u.draft("poisson_tensor", "Poisson tensor")
    draft.depends_on(coadjoint, basis.last, *stage.steps[:2])
    tensor = Equation("𝕁", ("matrix", *(("row", *map(tidied, row)) for row in variables)))
    kind = "group" if problem.advected is None else "reduced" if problem.advected else "dual"
    step = draft.step([tensor, moving], say(f"poisson_tensor.{kind}"))
    return (*_velocity(stage, group, mass, c), step)


def _velocity(stage: Expressed, group: Group, mass: Step, c: Chapter) -> tuple[Step, ...]:
    """ζ = M⁻¹(Π − b), b the momenta at ζ = 0; nothing where M depends on ζ."""
    zeta = coordinates(group)
    if {*zeta} & {x for row in stage.second for t in row for x in nodes(t)}:
        return ()
    at_rest = [tidied(_at_rest(p, zeta)) for p in stage.momenta]
    draft = c.draft("by_momenta", "inversion")
    draft.depends_on(stage.steps[1], mass)
    moving = _column(add(member("Π", a), neg(b)) for a, b in enumerate(at_rest))
    return (draft.step([Equation("ζ", mul(("inv", "M"), moving))], say("by_momenta.quadratic")),)


def _at_rest(t: Tree, zeta: Sequence[Tree]) -> Tree:
    """A tree where ζ = 0, without what vanishes with it."""
    if t in zeta:
        return 0
    if isinstance(t, tuple) and t[0] == "fun":
        return ("fun", t[1], _at_rest(t[2], zeta))
    if not isinstance(t, tuple) or t[0] not in ("add", "mul", "div", "pow"):
        return t
    op, first, *rest = (t[0], *(_at_rest(x, zeta) for x in t[1:]))
    if op in ("add", "mul"):
        return (add if op == "add" else mul)(first, *rest)
    return 0 if first == 0 else (op, first, *rest)


def _carried(problem: Problem) -> list[tuple[Any, ...]]:
    """The entries of Γ."""
    size = sum(x.size for x in problem.advected or ())
    return [("entry", "Γ", i + 1) for i in range(size)]


def _brackets(
    problem: Problem, group: Group, general: AnyLagrangian, basis: Basis
) -> list[list[Tree]]:
    """{Π_a, Π_b}, which ζ_b has as its coefficient in Π̇_a, and {Γ_i, Π_b}, in Γ̇_i."""
    turning = coadjoint_terms(group, general.epsilon)
    moved = [
        [basis.moved.displaced(x, a) for a in range(group.dimension)] for x in _carried(problem)
    ]
    momenta = [
        [*(derivative(t, z) for z in coordinates(group)), *(neg(row[a]) for row in moved)]
        for a, t in enumerate(turning)
    ]
    return [*momenta, *([*row, *(0 for _ in moved)] for row in moved)]


def _moving(stage: Expressed, problem: Problem, group: Group) -> Equation:
    """The rates of Π and Γ, by 𝕁 and the derivatives of h̃; by Φ where g is not in Γ, and u."""
    assert problem.lagrangian is not None
    span, carried = range(group.dimension), _carried(problem)
    rates: list[Tree] = [
        *(member("Π̇", a) for a in span),
        *(("entry", "Γ̇", *x[2:]) for x in carried),
    ]
    slopes = [tidied(neg(derivative(problem.lagrangian.L, x))) for x in carried]
    pushed: list[Tree] = [0] * len(rates)
    if problem.advected is None:
        pushed = [member("Φ", a) if x else 0 for a, x in enumerate(stage.forces)]
    if problem.inputs:
        driven: list[Tree] = [*(("entry", "u", a + 1) for a in span), *(0 for _ in carried)]
        pushed = [add(x, y) for x, y in zip(pushed, driven, strict=True)]
    turned = mul("𝕁", _column((*coordinates(group), *slopes)))
    return Equation(_column(rates), add(_column(pushed), turned) if any(pushed) else turned)


def _column(entries: Iterable[Tree]) -> Tree:
    return ("matrix", *(("row", x) for x in entries))
