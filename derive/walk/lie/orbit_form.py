"""Kirillov, Kostant, Souriau: dϖ at constant time, on a level of the other momentum.

The other momentum pairs a constant η of 𝔤 as Π pairs what g carries it to, A⁻¹ηA on the left; on
its level ⟨δΠ, ξ′⟩ = ε⟨Π, [ξ, ξ′]⟩, and dϖ is there ε⟨Π, [ξ, ξ′]⟩.  Makes the step ``kks`` of the
chapters ``left`` and ``right``.
"""

from __future__ import annotations

from ...algebra import forms
from ...algebra.calculus import derivation, substitute
from ...algebra.forms import Trivialisation
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Letter, inner, word
from ...language.read import read
from ...language.tree import add, neg
from ...record.record import Equation, Step
from ..alphabet import Alphabet
from ..chapter import Chapter
from ..exterior import DOMEGA
from ..factorisation import at_constant_time
from ..wording import say

CONSTANT_TIME = (Equation("δt", 0), Equation("δ′t", 0))


def orbit_form(form: Expr, a: Alphabet, moved: Trivialisation, other: Step, c: Chapter) -> Step:
    """dϖ at constant time, less what the variations of the other momentum are in it.

    ``form``: dϖ by Π and the letter of the bracket; ``other``: the step of the other momentum.
    ``ValueError`` where the rest is no bracket.
    """
    draft = c.draft("kks", "restriction")
    draft.depends_on(other)
    crossed = Letter("[ξ, ξ′]", a.n, a.n)
    display = {a.bracket: read("[ξ′, ξ]"), crossed: read("[ξ, ξ′]")}
    notation = WordNotation(display=display, covectors=frozenset(a.Pi.letters))
    xi, xi_prime, Pi = word(a.Z.xi), word(a.Z.xi_prime), word(a.Pi.momentum)
    opened = {a.bracket: xi_prime * xi - xi * xi_prime, crossed: xi * xi_prime - xi_prime * xi}
    restricted = at_constant_time(form, a.dt, a.dpt)
    turn = carried(a, moved)
    sign = sign_of(turn, opened[crossed])
    here = inner(word(a.Pi.d_momentum), xi_prime) + sign * inner(Pi, word(crossed))
    there = inner(word(a.Pi.dp_momentum), xi) + sign * inner(Pi, word(a.bracket))
    rest = substitute(restricted - here + there, opened)
    left = sign_of(rest, inner(Pi, opened[crossed])) * inner(Pi, word(crossed))
    return draft.step(
        [
            Equation(DOMEGA, draft.tree(restricted, notation)),
            Equation(
                add(DOMEGA, neg(draft.tree(left, notation))),
                add(draft.tree(here, notation), neg(draft.tree(there, notation))),
            ),
        ],
        say("kks.level"),
        where=CONSTANT_TIME,
    )


def carried(a: Alphabet, moved: Trivialisation) -> Expr:
    """The variation along ξ, at g = 1, of what g carries a constant of 𝔤 to, which is ξ′ there."""
    g, back, constant = word(a.A.position), Letter("A⁻¹", a.n, a.n), Letter("η", a.n, a.n)
    xi, inverse, eta = word(a.Z.xi), word(back), word(constant)
    whole, undone = (
        (inverse * eta * g, xi * inverse)
        if moved is forms.left
        else (g * eta * inverse, inverse * xi)
    )
    varied = derivation(whole, {a.A.position: moved(g, xi), back: -undone}.get)
    one = {a.A.position: a.unit, back: a.unit, constant: word(a.Z.xi_prime)}
    return substitute(varied, one)


def sign_of(e: Expr, unit: Expr) -> int:
    """ε of an expression ε · unit; ``ValueError`` where it is none."""
    for sign in (1, -1):
        if e == sign * unit:
            return sign
    raise ValueError("neither the expression nor its opposite")
