"""Forms on a group: the structure equation and the exterior derivative, on words.

Convention, fixed here once:  ``dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)]``  for two commuting variations,
and the left trivialisation ``δg = g ξ`` where no other is said.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .calculus import Image, derivation, substitute
from .words import Expr, Letter, word


def exterior(form: Expr, prime: Mapping[Letter, Letter], delta: Image, delta_prime: Image) -> Expr:
    """``dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)]`` of a one-form given as the scalar ϖ(δ).

    ``prime`` sends each variation letter (δA) to its primed twin (δ′A); the two derivations must
    agree on second variations, δ(δ′A) = δ′(δA), or differ by the structure equation.
    """
    primed = substitute(form, {x: word(y) for x, y in prime.items()})
    return derivation(primed, delta) - derivation(form, delta_prime)


Trivialisation = Callable[[Expr, Expr], Expr]
"""From g and an element ξ of 𝔤 to the tangent vector δg that it stands for."""


def left(g: Expr, xi: Expr) -> Expr:
    """δg = g ξ: the left trivialisation, ξ = g⁻¹δg."""
    return g * xi


def right(g: Expr, xi: Expr) -> Expr:
    """δg = ξ g: the right trivialisation, ξ = δg g⁻¹."""
    return xi * g


def structure_equation(
    g: Letter,
    xi: Letter,
    xi_prime: Letter,
    eta: Letter,
    eta_prime: Letter,
    moved: Trivialisation = left,
) -> Expr:
    """The value of ``δη′ − δ′η`` when  δg = g ξ  and  δx = g η  (so ``[ξ′, ξ]`` for η = ξ).

    From δ(δ′x) = δ′(δx): the terms in which g is varied must balance it.
    ``moved``: the trivialisation; the right one gives ``[ξ, ξ′]``.
    """
    element = word(g)
    delta = derivation(moved(element, word(eta_prime)), {g: moved(element, word(xi))}.get)
    delta_prime = derivation(moved(element, word(eta)), {g: moved(element, word(xi_prime))}.get)
    strip = strip_left if moved is left else strip_right
    return strip(delta_prime - delta, g)


def strip_left(e: Expr, g: Letter) -> Expr:
    """The expression y with e = g y, for an invertible letter g that each word of e begins with;
    ``ValueError`` where one does not."""
    terms = {}
    for (traces, w), c in e.terms.items():
        if not w or w[0] != (g, False):
            raise ValueError(f"{g.name} is not a common left factor")
        terms[traces, w[1:]] = c
    return e.like(terms)


def strip_right(e: Expr, g: Letter) -> Expr:
    """The expression y with e = y g, for an invertible letter g that each word of e ends with;
    ``ValueError`` where one does not."""
    terms = {}
    for (traces, w), c in e.terms.items():
        if not w or w[-1] != (g, False):
            raise ValueError(f"{g.name} is not a common right factor")
        terms[traces, w[:-1]] = c
    return e.like(terms)
