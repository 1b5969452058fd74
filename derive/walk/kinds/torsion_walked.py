"""Torsion springs: ½ k Tr(1 − R̄A), with N_A = ½ Ā Σ k R the sum of their moments."""

from __future__ import annotations

from fractions import Fraction

from ...algebra.words import Letter, one, trace, word
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.potential_kinds import Torsion
from ..given.potentials import PotentialLetter, Words
from ..spine.alphabet import Alphabet

KIND = Torsion
HALF = Fraction(1, 2)


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """Torsion springs on words, ½ k_A Tr 1 − Tr N_A; ``None`` without any."""
    springs = [p for p in problem.potentials if isinstance(p, Torsion)]
    if not springs:
        return None
    N, turned = Letter("N_A", a.n, a.n), Letter("Σ k R", a.n, a.n)
    mu = Letter("μ_A", a.n) if vectors else None
    definitions = [
        Equation("k_A", add(*(p.stiffness for p in springs))),
        Equation("N_A", add(*(mul(HALF, p.stiffness, ("T", "A"), _rest(p)) for p in springs))),
    ]
    if mu:
        definitions.append(Equation(mu.name, _axial(N.name)))
    moments = HALF * word(a.A.position).bar * word(turned)
    return Words(
        HALF * word(Letter("k_A")) * trace(one(a.n)) - trace(word(N)),
        definitions,
        [mul(HALF, p.stiffness, ("tr", add(("one",), neg(_back(p))))) for p in springs],
        own=[PotentialLetter(N, moments, (a.A.position, turned), Fraction(2), mu)],
    )


def _back(p: Torsion) -> Tree:
    """The tree R̄A."""
    return mul(("T", _rest(p)), "A") if p.rest else "A"


def _rest(p: Torsion) -> Tree:
    """The tree R, or 1 where the spring rests there."""
    return ("matrix", *(("row", *row) for row in p.rest)) if p.rest else 1


def _axial(N: Tree) -> Tree:
    """The column of the vector of a matrix: (N₃₂ − N₂₃, …), for j(x)₃₂ = x₁."""
    pairs = ((3, 2), (1, 3), (2, 1))
    entries = (add(("entry", N, i, j), neg(("entry", N, j, i))) for i, j in pairs)
    return ("matrix", *(("row", x) for x in entries))
