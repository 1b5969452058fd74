"""Step 3, trivialised: tangent vectors are carried to the Lie algebra by g⁻¹ (27), (30)."""

from __future__ import annotations

from collections.abc import Mapping

from ..algebra.calculus import PairRule, derivation, reduce, substitute
from ..algebra.word_trees import tree_of
from ..algebra.words import Expr, Factor, Letter, word
from ..record.record import Equation, Step, stated
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .wording import say


def body_rule(a: Alphabet, C: Expr) -> PairRule:
    """The relations ``ĀA = C``, ``ĀN = N_b``, ``ĀF = F_b``: what g leaves in a word carried to
    1.

    ``C`` is the letter C for any group and the identity for isometries.
    """
    pairs = {a.A.position: C} | {x: _marked(word(y), a) for x, y in a.body_forces}

    def rule(left: Factor, right: Factor) -> Expr | None:
        if left == (a.A.position, True) and not right[1] and right[0] in pairs:
            return pairs[right[0]]
        if right == (a.A.position, False) and left[1] and left[0] in (a.N, a.F):
            return pairs[left[0]].bar
        return None

    return rule


def varied_cauchy_green(a: Alphabet, xi: Letter) -> Expr:
    """The variation δC of C = ĀA along δA = Aξ: ξ̄C + Cξ, derived."""
    g = word(a.A.position)
    return reduce(
        derivation(g.bar * g, {a.A.position: g * word(xi)}.get), body_rule(a, cauchy_green(a))
    )


def trivial_images(a: Alphabet) -> dict[Letter, Expr]:
    """The images of letters in space: ν = gZ, δg = gξ, δ′g = gξ′, F̃ = A f, and δν, δ′ν by the
    product rule."""
    g = _marked(word(a.A.position), a)
    images: dict[Letter, Expr] = {a.F_group: g * word(a.f)}
    for part, inner in zip(a.parts, a.algebra_parts, strict=True):
        images[part.velocity] = g * word(inner.velocity)
        images[part.d_position] = g * word(inner.xi)
        images[part.dp_position] = g * word(inner.xi_prime)
        delta = {a.A.position: g * word(a.Z.xi), inner.velocity: word(inner.d_velocity)}
        images[part.d_velocity] = derivation(images[part.velocity], delta.get)
        delta = {a.A.position: g * word(a.Z.xi_prime), inner.velocity: word(inner.dp_velocity)}
        images[part.dp_velocity] = derivation(images[part.velocity], delta.get)
    return images


def rates(d: Draft, a: Alphabet, turned: Mapping[Letter, Expr] | None = None) -> list[Equation]:
    """The equations Ȧ = AZ and Ṫ = Aw; ``turned``: what is written for Z."""
    images, first = trivial_images(a), Chapter(a.chapter).label("kernel")
    speeds = {p.rate: substitute(word(p.velocity).marked(first), images) for p in a.parts}
    return [Equation(x, d.tree(substitute(e, turned or {}))) for x, e in speeds.items()]


def at_identity(e: Expr, a: Alphabet) -> Expr:
    """A scalar expression carried to the identity, in Z, ξ, C and the forces in the body."""
    return reduce(substitute(e, trivial_images(a)), body_rule(a, cauchy_green(a)))


def cauchy_green(a: Alphabet) -> Expr:
    """The Cauchy–Green matrix C = ĀA as a word, marked by the step that defines it."""
    return _marked(word(a.C), a)


def _marked(e: Expr, a: Alphabet) -> Expr:
    """An expression marked as said by the step ``trivialisation``."""
    return e.marked(Chapter(a.chapter).label("trivialisation"))


def trivialisation(a: Alphabet, c: Chapter) -> Step:
    """The step that defines Z, ξ, ξ′, C, and says what they make of variations."""
    definitions = stated("Z = A⁻¹α,  ξ = A⁻¹δA,  ξ′ = A⁻¹δ′A")
    if a.affine:
        definitions += stated("w = A⁻¹τ,  η = A⁻¹δT,  η′ = A⁻¹δ′T,  N_b = ĀN,  F_b = ĀF")
    else:
        definitions += stated("f = A⁻¹F̃")
    images = trivial_images(a)
    return c.draft("trivialisation", "trivialisation").step(
        (
            *definitions,
            *stated("C = ĀA"),
            *(Equation(p.d_velocity.name, tree_of(images[p.d_velocity])) for p in a.parts),
            Equation("δC", tree_of(varied_cauchy_green(a, a.Z.xi))),
        ),
        say("trivialisation.carried"),
        (27, 30),
    )
