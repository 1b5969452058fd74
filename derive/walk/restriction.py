"""From any group to a problem's: the letters of 𝔤* take their values.

What the general road says in P, δP, Ṗ, F, Z, ξ and the bracket is not expanded there: the values of
P and F on a group are put in here, with their variations.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ..algebra.calculus import derivation, substitute
from ..algebra.words import Expr, Letter, word
from ..record.sentence import Prose
from .alphabet import AlgebraPart, Alphabet, Dual
from .trivialisation import varied_cauchy_green
from .wording import say


def restrict(
    e: Expr,
    values: Mapping[Letter, Expr],
    a: Alphabet,
    brackets: Mapping[Letter, Expr] | None = None,
) -> Expr:
    """An expression about any group, in the letters ``a``, with P and F by their ``values``.

    ``brackets``: what those letters stand for, where they are to be opened.  ``ValueError`` for a P
    with other letters than those of the velocity, the body and C: how they vary is not known here.
    """
    known = {a.C, a.J, a.c, a.m, *(f.velocity for f in a.algebra_parts)}
    for d in a.duals:
        for x in values[d.momentum].letters():
            if x not in known:
                raise ValueError(f"{d.momentum.name} has {x.name}, whose variation is not known")
    further = [{a.C: varied_cauchy_green(a, x)} for x in (a.Z.xi, a.Z.xi_prime, a.Z.velocity)]
    images = moved(values, a.duals, a.algebra_parts, further) | dict(brackets or {})
    return substitute(a.respell(e), images)


def moved(
    values: Mapping[Letter, Expr],
    duals: Iterable[Dual],
    parts: Sequence[AlgebraPart],
    further: Iterable[Mapping[Letter, Expr]],
) -> dict[Letter, Expr]:
    """The images of P, δP, δ′P, Ṗ and F: their values in Z and w; letters that do not vary are
    constants.

    ``further``: what else varies, under δ, under δ′ and along the motion.
    """
    letters = zip(*((f.d_velocity, f.dp_velocity, f.acceleration) for f in parts), strict=True)
    varied = [
        {f.velocity: word(x) for f, x in zip(parts, found, strict=True)} | dict(others)
        for found, others in zip(letters, further, strict=True)
    ]
    images = dict(values)
    for d in duals:
        for x, delta in zip((d.d_momentum, d.dp_momentum, d.rate), varied, strict=True):
            images[x] = derivation(values[d.momentum], delta.get)
    return images


def restricted_prose(a: Alphabet) -> Prose:
    """The sentence for a dϖ that is restricted to a group."""
    return say(
        "exterior.by_momenta",
        momenta="(Π, p_b, Φ, F_b)" if a.affine else "(Π, Φ)",
    )
