"""What an algebra carries along where the state has no element of the group.

ρ(g)^ε Γ is constant, ε = +1 on the left, −1 on the right:  δΓ = −ε ρ(ξ)Γ,  Γ̇ = −ε ρ(Z)Γ
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import derivation
from ...algebra.carried import block
from ...algebra.forms import left, strip_left
from ...algebra.groups import Group
from ...algebra.structure import brackets_of, faithful
from ...algebra.words import Letter, word
from ...language.rational import Matrix
from ...language.suffixed import suffixed
from ...language.tree import Tree, add, mul, plain
from ...problem.moved_entries import Entry, Moved
from ...problem.problem import Problem
from ...record.record import Equation, stated
from ...schema.algebra_kinds import Advected
from ..alphabet import Alphabet
from ..chapter import Chapter
from ..wording import say
from .any_lagrangian import SIDES, AnyLagrangian
from .basis import Basis, brackets
from .orbit_form import sign_of

UNNAMED = "G"
"""The name of an algebra of no family."""

NAMED = 6
"""Of so many entries of one name each is named."""


@dataclass(frozen=True)
class EntriesOfAdvected(Moved):
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
    assert problem.lagrangian is not None
    assert problem.advected is not None
    draft = c.draft("coordinates", "coordinates")
    draft.depends_on(general["second_order"])
    place = draft.step(stated("Z = Σ_a ζ_a E_a"), say("coordinates.reduced"))
    side, size = problem.lagrangian.trivialisation, sum(x.size for x in problem.advected)
    told = brackets(group, c, shown=not size and not _chosen(group))
    rows = range(group.n - size, group.n)
    moved = EntriesOfAdvected([block(e, rows) for e in group.basis], sign(a, side))
    if not size:
        return Basis(moved, (), place, told, (place, *told))
    zeta: list[Tree] = [("entry", "ζ", k) for k in range(1, group.dimension + 1)]
    by_velocity = [
        [
            add(
                *(
                    mul(plain(e[i][j]), z)
                    for e, z in zip(moved.matrices, zeta, strict=True)
                    if e[i][j]
                )
            )
            for j in range(size)
        ]
        for i in range(size)
    ]
    rates = Equation("Γ̇", _column(_carried(moved, zeta, i) for i in range(1, size + 1)))
    draft, names = c.draft("advected", "variation"), _names(problem.advected)
    draft.depends_on(place)
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
        return -sign_of(strip_left(varied, g), xi * carried)
    return sign_of(varied, xi * word(g) * carried)


def _column(entries: Iterable[Tree]) -> Tree:
    return ("matrix", *(("row", x) for x in entries))


def _terms(row: Sequence[Fraction], times: int) -> list[Tree]:
    """± Σ x_j Γ_j."""
    found = enumerate(row, 1)
    return [mul(plain(times * x), ("entry", "Γ", j)) for j, x in found if x]


def _carried(moved: EntriesOfAdvected, zeta: Sequence[Tree], i: int) -> Tree:
    """Γ̇_i = ± Σ ζ_a (ρ(E_a)Γ)_i."""
    terms = (
        mul(plain(moved.sign * x), z, ("entry", "Γ", j))
        for e, z in zip(moved.matrices, zeta, strict=True)
        for j, x in enumerate(e[i - 1], 1)
        if x
    )
    return add(*terms)
