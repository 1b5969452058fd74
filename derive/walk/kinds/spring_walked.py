"""Springs: those of natural length 0 inside one block together, ½ Tr AKĀ; any other one by one."""

from __future__ import annotations

from fractions import Fraction

from ...algebra.words import Letter, inner, word
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.potential_kinds import Spring, quadratic
from ..chapter import Chapter, say
from ..given.potentials import PointPotentials, Words, column, in_space, place
from ..spine.alphabet import Alphabet
from ..spine.lagrangian import sum_over

KIND = Spring


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """The springs of natural length 0 inside one block on words, Σ ½ k_e ‖A s_e‖²; ``None`` without
    any."""
    del vectors
    springs = quadratic(problem.potentials, problem.block)
    if not springs:
        return None
    K, k_e, s_e = Letter("K", a.n, a.n, 1), Letter("k_e"), Letter("s_e", a.n)
    turned = word(a.A.position).marked(Chapter(a.chapter).label("action"))
    stretched = turned * word(s_e)
    summand = Fraction(1, 2) * word(k_e) * inner(stretched, stretched)
    return Words(
        sum_over(summand, {k_e, s_e}, {(k_e, s_e, s_e): word(K)}),
        _definitions(springs),
        [_on_points(e, spring) for e, spring in enumerate(springs, 1)],
        say("potential.springs"),
    )


def _on_points(e: int, spring: Spring) -> Tree:
    """The tree ½ k_e ‖r_i(t) − r_j(t)‖² of one spring."""
    i, j = map(in_space, spring.points())
    return ("mul", Fraction(1, 2), ("at", "k", e), ("norm2", ("add", i, neg(j))))


def _definitions(springs: tuple[Spring, ...]) -> list[Equation]:
    """The equations of s_e, k_e and K = Σ k_e s_e s̄_e."""
    equations = []
    for e, spring in enumerate(springs, 1):
        i, j = spring.ends
        ends = ("add", ("at", "r", i), neg(("at", "r", j)))
        equations += [Equation(("at", "s", e), ends), Equation(("at", "k", e), spring.stiffness)]
    s: Tree = ("at", "s", "e")
    equations.append(Equation("K", ("sum", "e", ("mul", ("at", "k", "e"), s, ("T", s)))))
    return equations


def pointwise(found: PointPotentials, p: Spring, problem: Problem) -> None:
    """Add ½ k (‖d‖ − ℓ)², unless the spring is in K."""
    if p in quadratic((p,), problem.block):
        return
    i, j = p.ends
    anchor = p.anchor or ()
    other = column(anchor) if j is None else place(problem, j)
    d = found.add_difference(add(place(problem, i), neg(other)))
    square: Tree = ("norm2", d)
    stretched = square
    if p.length != 0:
        stretched = ("pow", add(("fun", "sqrt", square), neg(p.length)), 2)
    energy = mul(Fraction(1, 2), p.stiffness, stretched)
    found.add_radial(energy, d, {i: 1} if j is None else {i: 1, j: -1}, anchor)
