"""The motion told by momenta, and what an algebra carries along where the state has no g."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...algebra.calculus import derivation, left, strip
from ...algebra.groups import Group
from ...algebra.structure import brackets_of, faithful
from ...algebra.user_groups import block
from ...algebra.words import Letter, word
from ...language.derivatives import derivative
from ...language.rational import Matrix
from ...language.reserved import suffixed
from ...language.tree import Tree, add, mul, neg, nodes, plain
from ...problem.entries_on_orbit import Entry, OrbitEntries
from ...problem.fields import coordinates
from ...problem.problem import Problem
from ...record.record import Equation, Step, stated
from ...schema.kind import Advected
from ..chapter import Chapter, say
from ..given.potential_terms import column
from ..spine.alphabet import Alphabet
from .any_lagrangian import SIDES, AnyLagrangian, sign_of
from .expressed import Basis, Expressed, brackets, coadjoint_terms, member, tidied
from .from_outside import combined, from_outside

# The motion told by momenta: the velocity from them, and the Poisson tensor of the variables.
#
# ζ = M⁻¹(Π − b),  {Π_a, Π_b} = ε Σ c_ba^k Π_k,  {Γ_i, Π_b} = E_b·Γ_i,  Ḟ = {F, h̃} + Σ Φ_a ∂F/∂Π_a
#
# with [E_b, E_a] = Σ c_ba^k E_k. These brackets are the entries of 𝕁; of h̃, a function of Π and
# Γ, ζ is the derivative by Π, and −∂L̃/∂Γ that by Γ. Where Γ is in place of g, Φ is a part of {Π,
# h̃}.


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
    if problem.own_lagrangian.held:
        return ()
    mass = next(x for x in balance if x.label == c.label("mass"))
    coadjoint = next(x for x in balance if x.label == c.label("coadjoint"))
    moving, variables = _moving(stage, problem, group), _brackets(problem, group, general, basis)
    draft = c_u.draft("poisson_tensor", "Poisson tensor", coadjoint, basis.last, *stage.steps[:2])
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
    draft = c.draft("by_momenta", "inversion", stage.steps[1], mass)
    moving = column(add(member("Π", a), neg(b)) for a, b in enumerate(at_rest))
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


def _advected_entries(problem: Problem) -> list[tuple[Any, ...]]:
    """The entries of Γ."""
    size = sum(x.size for x in problem.advected or ())
    return [("entry", "Γ", i + 1) for i in range(size)]


def _brackets(
    problem: Problem, group: Group, general: AnyLagrangian, basis: Basis
) -> list[list[Tree]]:
    """{Π_a, Π_b}, which ζ_b has as its coefficient in Π̇_a, and {Γ_i, Π_b}, in Γ̇_i."""
    turning = coadjoint_terms(group, general.epsilon)
    moved = [
        [basis.orbit_entries.displaced(x, a) for a in range(group.dimension)]
        for x in _advected_entries(problem)
    ]
    momenta = [
        [*(derivative(t, z) for z in coordinates(group)), *(neg(row[a]) for row in moved)]
        for a, t in enumerate(turning)
    ]
    return [*momenta, *([*row, *(0 for _ in moved)] for row in moved)]


def _moving(stage: Expressed, problem: Problem, group: Group) -> Equation:
    """The rates of Π and Γ, by 𝕁 and the derivatives of h̃; by Φ where g is not in Γ, and u."""
    span, carried = range(group.dimension), _advected_entries(problem)
    rates: list[Tree] = [
        *(member("Π̇", a) for a in span),
        *(("entry", "Γ̇", *x[2:]) for x in carried),
    ]
    slopes = [tidied(neg(derivative(problem.own_lagrangian.L, x))) for x in carried]
    pushed: list[Tree] = [0] * len(rates)
    if problem.advected is None:
        pushed = [member("Φ", a) if x else 0 for a, x in enumerate(stage.forces)]
    if problem.driven:
        driven = [*(add(*terms) for terms in from_outside(problem, group)), *(0 for _ in carried)]
        pushed = [add(x, y) for x, y in zip(pushed, driven, strict=True)]
    turned = mul("𝕁", column((*coordinates(group), *slopes)))
    return Equation(column(rates), add(column(pushed), turned) if any(pushed) else turned)


# What an algebra carries along where the state has no element of the group.
#
# ρ(g)^ε Γ is constant, ε = +1 on the left, −1 on the right:  δΓ = −ε ρ(ξ)Γ,  Γ̇ = −ε ρ(Z)Γ

UNNAMED = "G"
"""The name of an algebra of no family."""

NAMED = 6
"""Of so many entries of one name each is named."""


@dataclass(frozen=True)
class EntriesOfAdvected(OrbitEntries):
    """Those of Γ, with δΓ = ``sign`` ρ(ξ)Γ; ``matrices``: ρ(E_a)."""

    letter = "Γ"
    rate = "Γ̇"
    matrices: Sequence[Matrix]
    sign: int

    def displaced(self, entry: Entry, a: int) -> Tree:
        """An entry of ± ρ(E_a)Γ."""
        *_, i = entry
        return add(*_terms(self.matrices[a][i - 1], self.sign))


def reduced(
    problem: Problem, group: Group, general: AnyLagrangian, a: Alphabet, c: Chapter
) -> Basis:
    """Z = Σ ζ_a E_a; [E_a, E_b]; and where something is carried along, how it moves."""
    assert problem.advected is not None
    draft = c.draft("coordinates", "coordinates", general["second_order"])
    place = draft.step(stated("Z = Σ_a ζ_a E_a"), say("coordinates.reduced"))
    side, size = problem.own_lagrangian.trivialisation, sum(x.size for x in problem.advected)
    told = brackets(group, c, shown=not size and not _chosen(group))
    rows = range(group.n - size, group.n)
    moved = EntriesOfAdvected([block(e, rows) for e in group.basis], sign(a, side))
    if not size:
        return Basis(moved, (), place, told, (place, *told))
    zeta = coordinates(group)
    by_velocity = combined(moved.matrices, zeta, size)
    rates = Equation("Γ̇", column(_rate_of_entry(moved, zeta, i) for i in range(1, size + 1)))
    draft, names = c.draft("advected", "variation", place), _names(problem.advected)
    advected = draft.step(
        [
            Equation("δΓ", mul(moved.sign, ("call", "ρ", "ξ"), "Γ")),
            Equation(("call", "ρ", "Z"), ("matrix", *(("row", *row) for row in by_velocity))),
            Equation("Γ̇", mul(moved.sign, ("call", "ρ", "Z"), "Γ")),
            rates,
        ],
        say(f"advected.{side}") + say("advected.names", entries=", ".join(names)),
    )
    return Basis(moved, (rates,), advected, told, (place, *told, advected))


def _chosen(group: Group) -> bool:
    """Were the matrices of an algebra chosen for its brackets, which is all that the file says?"""
    table, span = group.structure_constants, range(group.dimension)
    rows = (
        (a + 1, b + 1, k + 1, table[a][b][k]) for a in span for b in span[a + 1 :] for k in span
    )
    known = group.name != UNNAMED
    return not known and group.basis == faithful(brackets_of(rows), group.dimension)


def _names(advected: Iterable[Advected]) -> Iterator[str]:
    """What the problem calls the entries of Γ; of many under one name the first two and the
    last."""
    for x in advected:
        listed = [f"‘{suffixed(x.name, i)}’" for i in range(1, x.size + 1)]
        yield from listed if x.size <= NAMED else (*listed[:2], "…", listed[-1])


def sign(a: Alphabet, side: str) -> int:
    """That of δΓ = ± ρ(ξ)Γ: of 0 = δ(gΓ) on the left, of Γ = gΓ₀ on the right, where g is its own
    representation."""
    g, xi, carried = a.A.position, word(a.Z.xi), word(Letter("Γ", a.n))
    varied = derivation(word(g) * carried, {g: SIDES[side](word(g), xi)}.get)
    if SIDES[side] is left:
        return -sign_of(strip(varied, g), xi * carried)
    return sign_of(varied, xi * word(g) * carried)


def _terms(row: Sequence[Fraction], times: int) -> list[Tree]:
    """± Σ x_j Γ_j."""
    found = enumerate(row, 1)
    return [mul(plain(times * x), ("entry", "Γ", j)) for j, x in found if x]


def _rate_of_entry(moved: EntriesOfAdvected, zeta: Sequence[Tree], i: int) -> Tree:
    """Γ̇_i = ± Σ ζ_a (ρ(E_a)Γ)_i."""
    terms = (
        mul(plain(moved.sign * x), z, ("entry", "Γ", j))
        for e, z in zip(moved.matrices, zeta, strict=True)
        for j, x in enumerate(e[i - 1], 1)
        if x
    )
    return add(*terms)
