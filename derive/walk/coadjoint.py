"""Where the linear parts of 𝔤 are all skew matrices: Euler–Manakov's equations.

On so(n) only the skew part of Π counts, the angular momentum in the body ℓ_b = Π − Π̄:

    ℓ̇_b = [ℓ_b, Z] + w p̄_b − p_b w̄ + moments,      ṗ_b = −Z p_b + F_b.

In R³ it is :mod:`derive.walk.vector` that makes the steps ``momenta`` and ``coadjoint``.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from ..algebra.calculus import gradient, substitute
from ..algebra.word_trees import tree_of
from ..algebra.words import Expr, Letter, word
from ..language.tree import Tree, add
from ..record.record import Equation, Step
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Chapter
from .momentum import MomentumForm
from .wording import say


def halved(values: Mapping[Letter, Expr], b: Alphabet) -> dict[Letter, Expr]:
    """The values Π = ½ ℓ_b, δΠ = ½ δℓ_b, δ′Π = ½ δ′ℓ_b, Π̇ = ½ ℓ̇_b, and that of Φ.

    On so(n) ⟨Π, ξ⟩ = ½ Tr ξℓ̄_b, so that a skew ℓ_b says as much as any Π.
    """
    pairs = zip(b.Pi.letters[:4], b.spin.letters[:4], strict=True)
    return {x: Fraction(1, 2) * word(y) for x, y in pairs} | {b.Pi.force: values[b.Pi.force]}


def coadjoint_steps(stage: MomentumForm, b: Alphabet, C: Expr, c: Chapter) -> tuple[Step, ...]:
    """The steps ``momenta`` and ``coadjoint``: ℓ_b (and p_b) and their rates in matrices,
    Euler–Manakov's equations; ``C``: ĀA."""
    stating, moving = c.draft("momenta", "relation"), c.draft("coadjoint", "kernel")
    own = {b.letters()[x.name]: b.respell(e, C).of(C) for x, e in stage.values.items()}
    momentum = own[b.Pi.momentum]
    values = {b.spin.momentum: momentum - momentum.bar}
    if b.affine:
        values[b.p_b.momentum] = own[b.p_b.momentum]
    momenta = stating.step(
        [Equation(x.name, stating.tree(e)) for x, e in values.items()], momenta_prose(b)
    )
    balance = substitute(b.respell(stage.balance), halved(own, b)).of(stating.mark(C))
    rates = {b.spin.rate: word(b.spin.rate) - 2 * gradient(balance, b.Z.xi_prime)}
    if b.affine:
        rates[b.p_b.rate] = word(b.p_b.rate) - gradient(balance, b.w.xi_prime)
    moving.depends_on(*rates.values())
    equations = [Equation(x.name, _commuted(e, b)) for x, e in rates.items()]
    return momenta, moving.step(equations, motion_prose(b))


def _commuted(e: Expr, b: Alphabet) -> Tree:
    """The tree of an expression, with the bracket [ℓ_b, Z] for its two terms ℓ_b Z − Zℓ_b."""
    spin, Z = word(b.spin.momentum), word(b.Z.velocity)
    commutator = spin * Z - Z * spin
    if not {*commutator.terms.items()} <= {*e.terms.items()}:
        return tree_of(e)
    rest = e - commutator
    return add(("bracket", b.spin.momentum.name, b.Z.velocity.name), tree_of(rest))


def momenta_prose(b: Alphabet) -> Prose:
    """The sentence that says what ℓ_b (and p_b) are."""
    if b.affine:
        return say("momenta.affine")
    return say("momenta.linear")


def motion_prose(b: Alphabet) -> Prose:
    """The sentence for the rates of ℓ_b (and p_b): Euler's equations, or Kirchhoff's."""
    if b.affine:
        return say("coadjoint.kirchhoff")
    return say("coadjoint.euler")
