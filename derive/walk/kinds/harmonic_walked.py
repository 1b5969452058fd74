"""Harmonic forces: ½ Σ m_i ⟨r_i, W_r r_i⟩, a sum over the points like L itself."""

from __future__ import annotations

from fractions import Fraction

from ...algebra.words import Letter, inner, word
from ...language.tree import Tree, add
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.potential_kinds import Harmonic
from ..chapter import Chapter
from ..given.potentials import Words
from ..spine.alphabet import Alphabet
from ..spine.lagrangian import POINT, sum_over

KIND = Harmonic
HALF = Fraction(1, 2)


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """Harmonic forces on words, ½ Tr W_r AJĀ with what T adds; ``None`` without any."""
    del vectors
    given = [p.W for p in problem.potentials if isinstance(p, Harmonic)]
    if not given:
        return None
    assert problem.group is not None
    W, general = Letter("W_r", a.n, a.n, 1), Chapter(a.chapter)
    position = a.acted_on(word(a.A.position), word(a.T.position)).marked(general.label("action"))
    moments = {(a.m_i,): a.m, (a.m_i, a.r_i): a.c, (a.m_i, a.r_i, a.r_i): a.J}
    table = {k: word(x).marked(general.label("moments")) for k, x in moments.items()}
    summand = HALF * word(a.m_i) * inner(position, word(W) * position)
    span = range(len(given[0]))
    entries = ((add(*(x[i][j] for x in given)) for j in span) for i in span)
    shown: Tree = ("mul", HALF, ("at", "m", "i"), ("metric", W.name, POINT, POINT))
    return Words(
        sum_over(summand, {a.m_i, a.r_i}, table),
        [Equation(W.name, ("matrix", *(("row", *row) for row in entries)))],
        [("sum", "i", shown)],
    )
