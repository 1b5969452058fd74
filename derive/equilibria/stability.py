"""What is proved of the stability of an equilibrium.

Definite on the leaf, the energy–Casimir form proves stability there (Lagrange–Dirichlet, Arnold);
where Λ has its largest rank, or the form is definite beyond the leaf, or the stabiliser is compact
(Montaldi), also off it.  Elsewhere the linearisation on the leaf is a Hamiltonian matrix: its
characteristic polynomial is q(λ²), and one root of q that is not real and at most 0, counted by
Sturm, proves instability (Lyapunov).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from ..integrals.all_integrals import Found
from ..integrals.lie_poisson import ONE, LiePoisson
from ..integrals.reduced import NotReducedError
from ..language.quadratic import Number
from .energy_casimir import (
    Form,
    Leaf,
    along_the_orbit,
    diagonalised,
    domain_matrix,
    form,
    leaf,
    number_of,
    product,
    signs,
)
from .equilibrium_points import About, Matrix, given, tried


@dataclass(frozen=True)
class Equilibrium:
    """An equilibrium ``about`` a point.  ``verdict``: "stable", "stable on the leaf", "unstable"
    or "open"; ``linear``: the linearisation M on the ``leaf``, LP = PM; ``characteristic``: of M,
    from the highest power; ``eigenvalues``: about those of M; ``signature``: of the form on the
    leaf; ``compact``: is the stabiliser of a point on a smaller leaf than others?"""

    about: About
    leaf: Leaf
    form: Form | None
    linear: Matrix
    characteristic: tuple[Number, ...]
    eigenvalues: tuple[complex, ...]
    signature: tuple[int, int]
    compact: bool
    verdict: str

    @property
    def growth(self) -> float:
        """About the largest real part of an eigenvalue."""
        return max((x.real for x in self.eigenvalues), default=0.0)


def require_numbers(whole: Found) -> None:
    """``NotReducedError`` where parameters have no numbers."""
    if whole.system.parameters:
        names = ", ".join(whole.system.parameters)
        raise NotReducedError(f"equilibria are told for numbers, and {names} has no default")


def equilibria_of(whole: Found, values: Mapping[str, Number]) -> tuple[Equilibrium, ...]:
    """The equilibrium at a point, or those among the points that are tried where none is given;
    ``NotReducedError`` where parameters have no numbers."""
    require_numbers(whole)
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
    compact = not regular and has_compact_stabilisers(whole.system)
    squares = found.squares if found else diagonalised(along_the_orbit(about, on))
    signature = signs(squares)
    definite = len(on.free) in signature
    if (found and found.whole) or (definite and (regular or compact)):
        verdict = "stable"
    elif on.free and definite:
        verdict = "stable on the leaf"
    else:
        verdict = "unstable" if grows(characteristic) else "open"
    return Equilibrium(
        *(about, on, found, linear, characteristic, eigenvalues(linear), signature),
        compact=compact,
        verdict=verdict,
    )


def has_compact_stabilisers(system: LiePoisson) -> bool:
    """Is the Lie algebra compact and semisimple, by its Killing form, so that the stabilisers of
    all points are compact?"""
    n = len(system.variables)
    ad = [[[Fraction(0)] * n for _ in range(n)] for _ in range(n)]
    for i in range(n):
        for j in range(n):
            for k, c in system.bracket(i, j).items():
                if k == ONE:
                    return False
                ad[i][j][k] = c
    zero, places = Fraction(0), [(j, k) for j in range(n) for k in range(n)]
    killing = [[sum((a[j][k] * b[k][j] for j, k in places), zero) for b in ad] for a in ad]
    squares = diagonalised([[*row] for row in killing])
    return len(squares) == n and all(d < 0 for d, _ in squares)


def polynomial(a: Matrix) -> tuple[Number, ...]:
    """The characteristic polynomial of a matrix, from the highest power."""
    if not a:
        return (Fraction(1),)
    matrix = domain_matrix(a, len(a))
    return tuple(number_of(c, matrix.domain) for c in matrix.charpoly())


def grows(characteristic: Sequence[Number]) -> bool:
    """Has a polynomial q(λ²) a root with positive real part?  False for others."""
    if any(c != 0 for c in characteristic[1::2]):
        return False
    chain = sturm([*characteristic[::2]])
    several = len(chain[0]) - len(chain[-1])  # the distinct roots
    at_zero = [p[-1] for p in chain]
    far = [p[0] * (-1) ** (len(p) - 1) for p in chain]
    negative = _changes(far) - _changes(at_zero)
    return negative + (chain[0][-1] == 0) < several


def sturm(p: list[Number]) -> list[list[Number]]:
    """Sturm’s chain of a polynomial, each from the highest power; the last divides all."""
    n = len(p) - 1
    chain = [p, [c * (n - k) for k, c in enumerate(p[:-1])]]
    while len(chain[-1]) > 1:
        rest = [*chain[-2]]
        divisor = chain[-1]
        while len(rest) >= len(divisor):
            factor = rest[0] / divisor[0]
            padded = [*divisor, *[Fraction(0)] * (len(rest) - len(divisor))]
            rest = [x - factor * y for x, y in zip(rest, padded, strict=True)][1:]
        while rest and rest[0] == 0:
            rest = rest[1:]
        if not rest:
            break
        chain.append([-x for x in rest])
    return [x for x in chain if x]


def _changes(values: Sequence[Number]) -> int:
    """How often the sign changes along some numbers, those that are 0 left out."""
    signs = [x > 0 for x in values if x != 0]
    return sum(x != y for x, y in pairwise(signs))


def eigenvalues(a: Matrix) -> tuple[complex, ...]:
    """About the eigenvalues of a matrix."""
    import numpy as np

    if not a:
        return ()
    return (*map(complex, np.linalg.eigvals(np.array(a, dtype=float))),)
