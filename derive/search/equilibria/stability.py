"""What is proved of the stability of an equilibrium.

Definite on the leaf, the energy–Casimir form proves stability there (Lagrange–Dirichlet, Arnold);
where Λ has its largest rank, or the form is definite beyond the leaf, or the stabiliser is compact
(Montaldi), also off it.  Elsewhere the linearisation on the leaf is a Hamiltonian matrix: its
characteristic polynomial is q(λ²), and one root of q that is not real and at most 0, counted by
Sturm, proves instability (Lyapunov).  Where all variables are momenta, so does a root with positive
real part, by Routh's scheme, of that of all rates.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from ...language.intervals import characteristic, root_near
from ...language.rational import times
from ...language.univariate import Number, RealRoots, grows, real_roots
from ..integrals.all_integrals import IntegralsFound
from ..integrals.lie_poisson import ONE, LiePoisson
from ..integrals.reduced import NotReducedError
from .energy_casimir import (
    EnergyCasimirForm,
    Leaf,
    along_the_orbit,
    diagonalised,
    domain_matrix,
    form,
    leaf,
    number_of,
    signs,
)
from .equilibrium_points import About, Elements, Matrix, attained, given, tried


@dataclass(frozen=True)
class Equilibrium:
    """An equilibrium ``about`` a point.  ``linear``: the linearisation M on the ``leaf``, LP = PM;
    ``characteristic``: of M, from the highest power, q(λ²); ``squares``: how many roots q has;
    ``eigenvalues``: about those of M; ``signature``: of the form on the leaf; ``regular``: has Λ
    its largest rank there?  ``compact``: is the stabiliser of a point on a smaller leaf than
    others?  ``attained``: is it proved that an element of the group has the entries of g there?"""

    about: About
    leaf: Leaf
    form: EnergyCasimirForm | None
    linear: Matrix
    characteristic: tuple[Number, ...]
    squares: RealRoots
    signature: tuple[int, int]
    regular: bool
    compact: bool
    attained: bool

    @property
    def verdict(self) -> str:
        """What is proved: "stable", "stable on the leaf", "unstable" or "open"."""
        if not self.attained:
            return "open"
        definite = len(self.leaf.free) in self.signature
        if (self.form and self.form.whole) or (definite and (self.regular or self.compact)):
            return "stable"
        if self.leaf.free and definite:
            return "stable on the leaf"
        return "unstable" if self._grows or self._leaves else "open"

    @property
    def _grows(self) -> bool:
        """Has an eigenvalue on the leaf a positive real part?"""
        return self.squares.negative < self.squares.distinct

    @property
    def _leaves(self) -> bool:
        """Are all variables momenta, or what an algebra advects, so that motions start anywhere,
        and has the linearisation off the leaf, too, an eigenvalue with positive real part?"""
        others = self.about.system.variables[self.about.system.momenta :]
        anywhere = all(isinstance(x, tuple) and x[1] == "Γ" for x in others)
        return anywhere and grows(self.characteristic_of_all[::-1])

    @cached_property
    def characteristic_of_all(self) -> tuple[Number, ...]:
        """That of the linearised rates of all variables."""
        return polynomial([e.slope for e in self.about.rates])

    @property
    def sentence(self) -> str:
        """The name of the sentence that says what is proved, and how."""
        if not self.attained:
            return "undecided"
        if self.verdict == "stable":
            beyond = self.form is not None and self.form.whole
            return "stable_beyond" if beyond else "stable_compact" if self.compact else "stable"
        if self.verdict == "stable on the leaf":
            return "on_the_leaf"
        if self.verdict == "unstable":
            return "unstable" if self._grows else "unstable_beyond"
        return "open" if self.leaf.free else "point"

    @cached_property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About those of M."""
        return eigenvalues(self.linear)

    @property
    def growth(self) -> float:
        """About the largest real part of an eigenvalue."""
        beyond = self.sentence == "unstable_beyond"
        found = eigenvalues([e.slope for e in self.about.rates]) if beyond else self.eigenvalues
        return max((x.real for x in found), default=0.0)


class PiError(NotReducedError):
    """Numbers are fractions here, and π is left of the moments of a solid."""


def require_numbers(whole: IntegralsFound) -> None:
    """``NotReducedError`` where parameters have no numbers, ``PiError`` where π alone is left."""
    told = "equilibria are told for numbers, and"
    if names := ", ".join(x for x in whole.system.parameters if x != "π"):
        raise NotReducedError(f"{told} {names} has no default")
    if whole.system.parameters:
        reason = "π is none: of a density that is a mass over a volume, it cancels"
        raise PiError(f"{told} {reason}")


def equilibria_of(
    whole: IntegralsFound, values: Mapping[str, Number], on: Elements
) -> tuple[Equilibrium, ...]:
    """The equilibrium at a point, or those among the points that are tried where none is given;
    ``on``: what entries of g satisfy."""
    system, kept = whole.system, [*map(whole.system.algebra.over_the_field, whole.casimirs)]
    found = [given(system, values, kept, on)] if values else tried(system, kept, on)
    return tuple(judged(whole, about, on) for about in found)


def judged(whole: IntegralsFound, about: About, elements: Elements) -> Equilibrium:
    """An equilibrium with what is proved of it."""
    on = leaf(about)
    over = about.algebra.over_the_field
    found = form(about, on, [*map(over, whole.casimirs), *map(over, whole.integrals)])
    linear = linear_on(about, on)
    characteristic = polynomial(linear)
    regular = whole.proved.proved and len(on.free) == whole.proved.rank
    squares = found.squares if found else diagonalised(along_the_orbit(about, on))
    return Equilibrium(
        *(about, on, found, linear, characteristic, roots_of_squares(characteristic)),
        signs(squares),
        regular=regular,
        compact=not regular and has_compact_stabilisers(whole.system),
        attained=attained(about, elements),
    )


def linear_on(about: About, on: Leaf) -> Matrix:
    """The linearised rates on the tangent space of the leaf, in its basis."""
    image = times([e.slope for e in about.rates], on.basis)
    return [image[i] for i in on.free]


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


def roots_of_squares(characteristic: Sequence[Number]) -> RealRoots:
    """The roots λ² of q, for the characteristic polynomial q(λ²) of a Hamiltonian matrix."""
    assert not any(characteristic[1::2])
    return real_roots(characteristic[::2][::-1])


def eigenvalues(a: Matrix) -> tuple[complex, ...]:
    """About the eigenvalues of a matrix."""
    import numpy as np

    if not a:
        return ()
    return (*map(complex, np.linalg.eigvals(np.array(a, dtype=float))),)


def eigenvalues_within(a: Matrix) -> tuple[Fraction, list[tuple[Fraction, Fraction]]]:
    """Of a matrix of intervals a radius, and numbers, their imaginary parts not negative, within it
    of each of which, and of its conjugate, is an eigenvalue, as is proved."""
    found = [x for x in eigenvalues(a) if x.imag >= 0]
    power = max((math.ceil(math.log10(abs(x))) for x in found if x), default=0)
    radius, told = Fraction(10) ** (min(max(power, 0), 5) - 6), list[tuple[Fraction, Fraction]]()
    f = characteristic(a)
    for x in found:
        re, im = (round(Fraction(y) * 100 / radius) * radius / 100 for y in (x.real, x.imag))
        im = im if im > radius else Fraction(0)
        near = root_near(f, re, im)
        apart = all((a - re) ** 2 + (b - im) ** 2 > 4 * radius**2 for a, b in told)
        if near is not None and near <= radius**2 and apart:
            told.append((re, im))
    return radius, sorted(told, reverse=True)
