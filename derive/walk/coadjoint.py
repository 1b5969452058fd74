"""Where the linear parts of 𝔤 are all skew matrices: Euler–Manakov's and Kirchhoff's equations.

On so(n) only the skew part of Π counts, the angular momentum in the body ℓ_b = Π − Π̄:

    ℓ̇_b = [ℓ_b, Z] + w p̄_b − p_b w̄ + moments,      ṗ_b = −Z p_b + F_b,

and in R³  ℓ̇_b = ℓ_b ∧ ζ + p_b ∧ w + μ,  ṗ_b = p_b ∧ ζ + F_b.
"""

from __future__ import annotations

from fractions import Fraction

from ..algebra.calculus import gradient, reduce, substitute
from ..algebra.notation import tree_of
from ..algebra.space import normal_form
from ..algebra.tree import Tree, add
from ..algebra.words import Expr, Letter, word
from ..record.record import Equation, Step
from ..record.sentence import Prose, say
from .alphabet import Alphabet
from .chapter import Chapter
from .isometry import Isometry
from .momentum import Momenta
from .vector import OMEGA_P, SPIN, ZETA, Reader, axis, body_momenta, isolate
from .wedge import vector_sum


def restricted(stage: Momenta, b: Alphabet, gram: Expr) -> tuple[dict[Letter, Expr], Expr]:
    """ℓ_b and p_b, and the balance in them, in the letters of a group with ĀA = 1."""
    own = {x: b.respell(e, gram).of(gram) for x, e in stage.values.items()}
    named = {x.name: e for x, e in own.items()}
    momentum = named[b.Pi.momentum.name]
    values = {b.spin: momentum - momentum.bar}
    if b.affine:
        values[b.p_b.momentum] = named[b.p_b.momentum.name]
    half = Fraction(1, 2)
    skew = {b.Pi.momentum: half * word(b.spin), b.Pi.rate: half * word(b.torque)}
    skew[b.Pi.push] = named[b.Pi.push.name]
    return values, substitute(b.respell(stage.balance), skew)


def coadjoint_steps(stage: Momenta, b: Alphabet, gram: Expr, c: Chapter) -> tuple[Step, ...]:
    """In matrices: Euler–Manakov."""
    telling, moving = c.draft("momenta", "relation"), c.draft("coadjoint", "kernel")
    values, balance = restricted(stage, b, gram)
    told = telling.step(
        (Equation(x.name, telling.tree(e)) for x, e in values.items()), _momenta_told(b)
    )
    rates = _rates(balance.of(telling.said(gram)), b.torque, b.Z.xi_prime, b)
    moving.read(*rates.values())
    equations = [Equation(x.name, _commuted(e, b)) for x, e in rates.items()]
    return told, moving.step(equations, _motion_told(b))


def coadjoint_vectors(
    stage: Momenta, isometry: Isometry, read: Reader, c: Chapter
) -> tuple[Step, ...]:
    """In vectors of R³: Euler's equations, or Kirchhoff's."""
    b = isometry.letters
    telling, moving = c.draft("momenta", "identification"), c.draft("coadjoint", "kernel")
    spin, pushed = body_momenta(isometry, read)
    values = {SPIN: spin} | ({b.p_b.momentum: pushed} if b.affine else {})
    telling.read(*values.values())
    told = telling.step(
        (Equation(x.name, vector_sum(e)) for x, e in values.items()), _momenta_told(b)
    )
    _, balance = restricted(stage, b, isometry.gram)
    turning = read.scalar(balance).of(telling.said(spin))
    rates = _rates(turning, axis(b.torque), OMEGA_P, b)
    moving.read(*rates.values())
    equations = [Equation(x.name, _spun(vector_sum(e))) for x, e in rates.items()]
    return told, moving.step(equations, _motion_told(b))


def _rates(balance: Expr, spin: Letter, xi: Letter, b: Alphabet) -> dict[Letter, Expr]:
    """ℓ̇_b and ṗ_b, from the coefficients of ξ′ (or Ω′) and η′; ``spin``: the letter ℓ̇_b."""
    in_space = xi.cols == 1
    written = reduce(balance, isolate(xi)) if in_space else 2 * balance
    rates = {spin: gradient(written, xi)}
    if b.affine:
        rates[b.p_b.rate] = gradient(balance, b.w.xi_prime)
    left = {x: word(x) - e for x, e in rates.items()}
    return {x: normal_form(e) for x, e in left.items()} if in_space else left


def _spun(t: Tree) -> Tree:
    """A sum with −(ζ ∧ ℓ_b) as ℓ_b ∧ ζ, before the other terms."""
    against: Tree = ("mul", -1, ("wedge", ZETA.name, SPIN.name))
    terms = t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)
    if against not in terms:
        return t
    return add(("wedge", SPIN.name, ZETA.name), *(x for x in terms if x != against))


def _commuted(e: Expr, b: Alphabet) -> Tree:
    """With [ℓ_b, Z] where its two terms stand."""
    spin, Z = word(b.spin), word(b.Z.velocity)
    commutator = spin * Z - Z * spin
    if not {*commutator.terms.items()} <= {*e.terms.items()}:
        return tree_of(e)
    rest = e - commutator
    return add(("bracket", b.spin.name, b.Z.velocity.name), tree_of(rest))


def _momenta_told(b: Alphabet) -> Prose:
    if b.affine:
        return say(
            "The angular momentum about the origin of the body and the momentum, in the body frame."
        )
    return say("The angular momentum in the body frame.")


def _motion_told(b: Alphabet) -> Prose:
    if b.affine:
        return say(
            "The equations of motion by the momenta (Kirchhoff): forces, and the coadjoint terms."
        )
    return say("The equations of motion by the momentum (Euler): forces, and the coadjoint term.")
