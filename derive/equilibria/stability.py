"""What is proved of the stability of an equilibrium.

Definite on the leaf, the energy–Casimir form proves stability there (Lagrange–Dirichlet, Arnold);
where Λ has its largest rank, or the form is definite beyond the leaf, also off it.  Elsewhere the
linearisation on the leaf is a Hamiltonian matrix: its characteristic polynomial is q(λ²), and one
root of q that is not real and at most 0, counted by Sturm, proves instability (Lyapunov).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from ..integrals.all_integrals import Found
from ..integrals.reduced import NotReducedError
from .energy_casimir import Form, Leaf, definite, domain_matrix, form, leaf, product
from .equilibrium_points import About, Matrix, given, tried


@dataclass(frozen=True)
class Equilibrium:
    """An equilibrium ``about`` a point.  ``verdict``: "stable", "stable on the leaf", "unstable"
    or "open"; ``linear``: the linearisation M on the ``leaf``, LP = PM; ``characteristic``: of M,
    from the highest power; ``growth``: about the largest real part of an eigenvalue."""

    about: About
    leaf: Leaf
    form: Form | None
    linear: Matrix
    characteristic: tuple[Fraction, ...]
    growth: float
    verdict: str


def equilibria_of(whole: Found, values: Mapping[str, Fraction]) -> tuple[Equilibrium, ...]:
    """The equilibrium at a point, or those among the points that are tried where none is given;
    ``NotReducedError`` where parameters have no numbers."""
    if whole.system.parameters:
        names = ", ".join(whole.system.parameters)
        raise NotReducedError(f"equilibria are told for numbers, and {names} has no default")
    system, fixed = whole.system, whole.casimirs
    found = [given(system, values, fixed)] if values else tried(system, fixed)
    return tuple(judged(whole, about) for about in found)


def judged(whole: Found, about: About) -> Equilibrium:
    """An equilibrium with what is proved of it."""
    on = leaf(about)
    over = about.algebra.over_the_field
    found = form(about, on, [*map(over, whole.casimirs), *map(over, whole.integrals)])
    slopes = [e.slope for e in about.rates]
    image = product(slopes, on.basis) if on.free else []
    linear = [image[i] for i in on.free]
    characteristic = polynomial(linear)
    regular = whole.proved.proved and len(on.free) == whole.proved.rank
    if found and (found.whole or (definite(found, on) and regular)):
        verdict = "stable"
    elif found and on.free and definite(found, on):
        verdict = "stable on the leaf"
    else:
        verdict = "unstable" if grows(characteristic) else "open"
    return Equilibrium(about, on, found, linear, characteristic, largest(linear), verdict)


def polynomial(a: Matrix) -> tuple[Fraction, ...]:
    """The characteristic polynomial of a matrix, from the highest power."""
    if not a:
        return (Fraction(1),)
    terms = domain_matrix(a, len(a)).charpoly()
    return tuple(Fraction(int(c.numerator), int(c.denominator)) for c in terms)


def grows(characteristic: tuple[Fraction, ...]) -> bool:
    """Has a polynomial q(λ²) a root with positive real part?  False for others."""
    from sympy import Poly, Rational, Symbol

    if any(characteristic[1::2]):
        return False
    terms = [Rational(c.numerator, c.denominator) for c in characteristic[::2]]
    q = Poly(terms, Symbol("s")).sqf_part()
    return bool(q.count_roots(None, 0) < q.degree())


def largest(a: Matrix) -> float:
    """About the largest real part of an eigenvalue."""
    import numpy as np

    if not a:
        return 0.0
    return float(max(np.linalg.eigvals(np.array(a, dtype=float)).real))
