"""A problem whose Lagrangian is an expression ℓ(t, g, Z): the momentum form in a basis of 𝔤.

    Π_a = ∂ℓ/∂ζ_a,  Φ_a = E_a·ℓ,  Π̇_a = Φ_a + ε Σ ζ_b c_ba^k Π_k,  M ζ̇ = β,  M_ab = ∂Π_a/∂ζ_b

with [E_b, E_a] = Σ c_ba^k E_k, and β what is left of Π̇ where the acceleration is not in it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...algebra.groups import Group
from ...language.derivatives import derivative
from ...language.laurent import OverlongError, collected
from ...language.read import read
from ...language.tree import Tree, add, mul, neg, nodes
from ...problem.problem import Problem
from ...problem.state_names import coordinates
from ...problem.stated_lagrangian import hessian
from ...record.formulas import stated
from ...record.record import Equation, Step
from ...schema.lagrangian_kinds import Lagrangian
from ..chapter import Chapter
from ..coordinates import basis_equations
from ..wording import say
from .any_lagrangian import AnyLagrangian


@dataclass(frozen=True)
class Expressed:
    """ℓ in coordinates.  ``momenta``: Π_a, and ``forces``: Φ_a, as trees; ``second``: ∂²ℓ/∂ζ²;
    ``coordinates``: the step of the basis, and of Ȧ; ``brackets``: that of those of the basis."""

    momenta: tuple[Tree, ...]
    forces: tuple[Tree, ...]
    second: tuple[tuple[Tree, ...], ...]
    coordinates: Step
    brackets: tuple[Step, ...]
    steps: tuple[Step, ...]


def tidied(t: Tree) -> Tree:
    """A tree of numbers with its like terms added, where that is not too long; parameters first."""
    try:
        return _ordered(collected(t))
    except OverlongError:
        return t


def _ordered(t: Tree) -> Tree:
    """The factors of products in the order of physics: numbers, parameters, g, functions, ζ."""
    if not isinstance(t, tuple) or t[0] in ("par", "entry"):
        return t
    parts = [t[1], *map(_ordered, t[2:])] if t[0] == "fun" else [*map(_ordered, t[1:])]
    return (t[0], *(sorted(parts, key=_place) if t[0] == "mul" else parts))


def _place(t: Tree) -> int:
    """Where a factor stands in a product."""
    if not isinstance(t, tuple):
        return 0 if isinstance(t, (int, Fraction)) else 1
    if t[0] in ("pow", "div"):
        return _place(t[1])
    order = {"par": 1, "add": 3, "fun": 4}
    return (5 if t[1] in ("ζ", "Ȧ") else 2) if t[0] == "entry" else order.get(t[0], 3)


def places(t: Tree) -> list[tuple[Any, ...]]:
    """The entries of g in an expression, once each."""
    return [*dict.fromkeys(x for x in nodes(t) if isinstance(x, tuple) and x[:2] == ("entry", "A"))]


def along(t: Tree, a: int, group: Group, side: str) -> Tree:
    """The derivative of an expression along δg = g E_a, or E_a g, at fixed t and Z."""
    span = range(group.n)
    g = [[_entry(group, i, j) for j in span] for i in span]
    e = [[_plain(x) for x in row] for row in group.basis[a]]
    one, two = (g, e) if side == "left" else (e, g)
    terms: list[Tree] = []
    for place in places(t):
        *_, i, j = place
        moved = add(*(mul(one[i - 1][k], two[k][j - 1]) for k in span))
        terms.append(mul(derivative(t, place), moved))
    return add(*terms)


def _entry(group: Group, i: int, j: int) -> Tree:
    """An entry of g: a number in the last row of an affine factor, and between blocks."""
    for offset, factor in group.places:
        inside = range(offset, offset + factor.size)
        if i in inside and j in inside and factor.affine and i == offset + factor.n:
            return int(i == j)
        if (i in inside) != (j in inside):
            return 0
    return ("entry", "A", i + 1, j + 1)


def _plain(x: Fraction) -> Tree:
    return int(x) if x.denominator == 1 else x


def expressed(problem: Problem, group: Group, general: AnyLagrangian, c: Chapter) -> Expressed:
    """The basis, L̃, and its derivatives along Z and along the group."""
    given = problem.lagrangian
    assert given is not None
    zeta, side = coordinates(group), given.trivialisation
    momenta = tuple(tidied(derivative(given.L, x)) for x in zeta)
    forces = tuple(tidied(along(given.L, a, group, side)) for a in range(group.dimension))
    second = tuple(tuple(map(tidied, row)) for row in hessian(given.L, zeta))
    place, brackets = _coordinates(group, general, c), _brackets(group, c)
    expression = _lagrangian(given, c)
    told = _momenta(momenta, forces, (expression, general["momenta"]), c)
    energy = _energy(given, momenta, zeta, (expression, told, general["energy"]), c)
    steps = (place, *brackets, expression, told, energy)
    return Expressed(momenta, forces, second, place, brackets, steps)


def _coordinates(group: Group, general: AnyLagrangian, c: Chapter) -> Step:
    """Z = Σ ζ_a E_a, and Ȧ by it."""
    draft = c.draft("coordinates", "coordinates")
    draft.depends_on(general["second_order"])
    return draft.step(
        [*basis_equations(group), Equation("Ȧ", general.velocity)],
        say("coordinates.basis"),
    )


def _brackets(group: Group, c: Chapter) -> tuple[Step, ...]:
    """[E_a, E_b] where it is not 0."""
    table, span = group.structure_constants, range(group.dimension)
    equations = [
        Equation(("bracket", _member("E", a), _member("E", b)), _combined(table[a][b], "E"))
        for a in span
        for b in span
        if a < b and any(table[a][b])
    ]
    if not equations:
        return ()
    return (c.draft("algebra", "relation").step(equations, say("algebra.brackets")),)


def _member(family: str, a: int) -> Tree:
    return ("at", family, a + 1)


def _combined(coefficients: Iterable[Fraction], family: str) -> Tree:
    """Σ x_k Y_k over a family."""
    return add(*(mul(_plain(x), _member(family, k)) for k, x in enumerate(coefficients) if x))


def _lagrangian(given: Lagrangian, c: Chapter) -> Step:
    return c.draft("lagrangian", "definition").step(
        [Equation("L̃", given.L)], say("lagrangian.expression")
    )


def _momenta(
    momenta: Sequence[Tree], forces: Sequence[Tree], made_from: tuple[Step, ...], c: Chapter
) -> Step:
    """Π_a and Φ_a."""
    draft = c.draft("momenta", "fibre derivative")
    draft.depends_on(*made_from)
    equations = [Equation(read("Π_a"), read("⟨Π, E_a⟩"))]
    equations += [Equation(_member("Π", a), t) for a, t in enumerate(momenta)]
    equations += [Equation(read("Φ_a"), read("⟨Φ, E_a⟩"))]
    if any(forces):
        equations += [Equation(_member("Φ", a), t) for a, t in enumerate(forces)]
    else:
        equations += [Equation(read("Φ_a"), 0)]
    return draft.step(equations, say("momenta.basis"))


def _energy(
    given: Lagrangian,
    momenta: Sequence[Tree],
    zeta: Sequence[Tree],
    made_from: tuple[Step, ...],
    c: Chapter,
) -> Step:
    draft = c.draft("energy", "Legendre transform")
    draft.depends_on(*made_from)
    paired = add(*(mul(p, z) for p, z in zip(momenta, zeta, strict=True)))
    return draft.step([Equation("h̃", tidied(add(paired, neg(given.L))))], say("energy.expression"))


def balance(
    stage: Expressed, problem: Problem, group: Group, general: AnyLagrangian, c: Chapter
) -> tuple[Step, ...]:
    """Π̇ in the basis, then M, β and the motion."""
    turning, weighing = c.draft("coadjoint", "kernel"), c.draft("mass", "coordinates")
    turning.depends_on(general["coadjoint"], *stage.brackets)
    coadjoint = coadjoint_terms(group, general.epsilon)
    driven = [("entry", "u", a + 1) for a in range(group.dimension)] if problem.inputs else []
    forces = [_member("Φ", a) if x else 0 for a, x in enumerate(stage.forces)]
    rates = [
        add(*((x,) if x else ()), *((y,) if y else ()), *driven[a : a + 1])
        for a, (x, y) in enumerate(zip(forces, coadjoint, strict=True))
    ]
    coadjoint_step = turning.step(
        [Equation(_member("Π̇", a), t) for a, t in enumerate(rates)], say("coadjoint.basis")
    )
    left = [add(t, neg(_carried(p))) for t, p in zip(rates, stage.momenta, strict=True)]
    weighing.depends_on(coadjoint_step, stage.coordinates)
    mass = weighing.step(
        [
            Equation("M", ("matrix", *(("row", *row) for row in stage.second))),
            Equation("β", ("matrix", *(("row", t) for t in left))),
        ],
        say("mass.basis_of_lagrangian"),
    )
    solving = c.draft("motion", "solution")
    solving.depends_on(mass, stage.coordinates)
    motion = solving.step(
        [Equation("Ȧ", general.velocity), *stated("ζ̇ = M⁻¹β")], say("motion.lagrangian")
    )
    return coadjoint_step, mass, motion


def _carried(p: Tree) -> Tree:
    """What Π_a changes by where ζ does not: ∂Π_a/∂t, and along Ȧ."""
    terms = [derivative(p, "t")]
    terms += [mul(derivative(p, x), ("entry", "Ȧ", *x[2:])) for x in places(p)]
    return tidied(add(*terms))


def coadjoint_terms(group: Group, epsilon: int) -> list[Tree]:
    """ε⟨Π, [Z, E_a]⟩ = ε Σ_b ζ_b c_ba^k Π_k."""
    table, span = group.structure_constants, range(group.dimension)
    return [
        add(
            *(
                mul(_plain(epsilon * table[b][a][k]), ("entry", "ζ", b + 1), _member("Π", k))
                for b in span
                for k in span
                if table[b][a][k]
            )
        )
        for a in span
    ]
