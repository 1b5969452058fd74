"""Gravity: −Σ m_i ⟨γ, r_i⟩, a sum over the points like L itself."""

from __future__ import annotations

from ...algebra.words import Letter, inner, word
from ...language.tree import neg
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.body_kinds import PointBody
from ...schema.potential_kinds import Gravity, gravity
from ..chapter import Chapter, say
from ..given.potentials import Words, column
from ..spine.alphabet import Alphabet
from ..spine.lagrangian import POINT, sum_over

KIND = Gravity


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """Gravity on words, −⟨γ, Ac⟩ − m⟨γ, T⟩; ``None`` without any."""
    del vectors
    g = gravity(problem.potentials)
    if g is None:
        return None
    gamma, general = Letter("γ", a.n), Chapter(a.chapter)
    position = a.acted_on(word(a.A.position), word(a.T.position)).marked(general.label("action"))
    summand = -word(a.m_i) * inner(word(gamma), position)
    table = {
        (a.m_i,): word(a.m).marked(general.label("moments")),
        (a.m_i, a.r_i): word(a.c).marked(general.label("moments")),
    }
    assert problem.group is not None
    spread = problem.body is not None and not isinstance(problem.body, PointBody)
    prose = say("potential.whole_body") if spread else ()
    return Words(
        sum_over(summand, {a.m_i, a.r_i}, table),
        [Equation("γ", column(problem.group.in_every_block(g)))],
        [neg(("sum", "i", ("mul", ("at", "m", "i"), ("inner", "γ", POINT))))],
        prose,
    )
