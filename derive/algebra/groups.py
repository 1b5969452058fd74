"""Groups as data: a basis of 𝔤 over Q, an action, relations, an exact sampler.

A matrix group G ⊂ GL(n) acts on Rⁿ linearly, ``r ↦ A r``, or affinely, ``r ↦ A r + T``.  An affine
group is kept as the matrices ``[[A, T], [0, 1]]`` that act linearly on ``(r, 1)``, so bracket,
structure constants, coordinates and the normal space are computed by one code for both.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any, Literal

from . import rational as q
from .rational import Matrix

Relation = Literal["orthogonal", "unimodular"]
Sampler = Callable[[Random, int], Matrix]


@dataclass(frozen=True)
class Group:
    """A matrix group moving points of Rⁿ.

    ``basis``: d matrices of size n (linear) or n + 1 with last row zero (affine), over Q.
    ``relations``: what holds for the linear part: ``orthogonal`` ĀA = 1, ``unimodular`` det A = 1.
    ``sampler(random, size)``: an exact element, its parameters within ±``size``.
    """

    name: str
    n: int
    action: Literal["linear", "affine"]
    basis: tuple[Matrix, ...]
    relations: frozenset[Relation]
    sampler: Sampler

    @property
    def dimension(self) -> int:
        """d = dim 𝔤."""
        return len(self.basis)

    @property
    def affine(self) -> bool:
        """Does the group also translate?"""
        return self.action == "affine"

    @property
    def size(self) -> int:
        """The size of its matrices: n, or n + 1 for an affine action."""
        return self.n + self.affine

    def hat(self, coordinates: Sequence[Any]) -> Matrix:
        """Z = Σ ζᵃ E_a."""
        return q.combine(coordinates, self.basis)

    @cached_property
    def _readers(self) -> Matrix:
        """The rows that read ζ off the entries of Z: a left inverse of the basis."""
        columns = q.transposed(tuple(q.flatten(e) for e in self.basis))
        _, pivots = q.echelon(q.transposed(columns))
        square = q.inverse(tuple(columns[p] for p in pivots))
        assert square is not None
        rows = [[Fraction(0)] * (self.size**2) for _ in self.basis]
        for a, row in enumerate(square):
            for k, p in enumerate(pivots):
                rows[a][p] = row[k]
        return q.matrix(rows)

    def reading(self, a: int) -> list[tuple[Fraction, int, int]]:
        """ζᵃ as Σ coefficient · Z_ij: the terms (coefficient, i, j), counted from 0."""
        s = self.size
        return [(c, k // s, k % s) for k, c in enumerate(self._readers[a]) if c]

    def vee(self, z: Matrix) -> tuple[Any, ...] | None:
        """The coordinates of Z, or ``None`` when Z is not in 𝔤."""
        flat = q.flatten(z)
        coordinates = tuple(
            sum((c * x for c, x in zip(row, flat, strict=True) if c), Fraction(0))
            for row in self._readers
        )
        return coordinates if self.hat(coordinates) == q.matrix(z) else None

    @cached_property
    def structure_constants(self) -> tuple[Matrix, ...]:
        """``c[a][b]`` are the coordinates of [E_a, E_b]; ``ValueError`` if 𝔤 is not closed."""
        table = []
        for a in self.basis:
            row = []
            for b in self.basis:
                coordinates = self.vee(q.bracket(a, b))
                if coordinates is None:
                    raise ValueError(f"{self.name}: the basis is not closed under the bracket")
                row.append(coordinates)
            table.append(tuple(row))
        return tuple(table)

    @cached_property
    def normal_space(self) -> tuple[Matrix, ...]:
        """A basis of {Λ : Tr Λ̄ξ = 0 for every ξ in 𝔤}: the multipliers of the constraint."""
        s = self.size
        vectors = q.nullspace(tuple(q.flatten(e) for e in self.basis))
        return tuple(tuple(v[i * s : (i + 1) * s] for i in range(s)) for v in vectors)

    def sample(self, random: Random, size: int = 9) -> Matrix:
        """An exact rational element of the group."""
        return self.sampler(random, size)


def _fraction(random: Random, size: int) -> Fraction:
    return Fraction(random.randint(-size, size))


def so_basis(n: int) -> tuple[Matrix, ...]:
    """Skew matrices, ordered and signed so that for n = 3 they are j(e₁), j(e₂), j(e₃)."""
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)][::-1]
    return tuple(
        q.scaled((-1) ** (i + j), q.minus(q.unit(n, i, j), q.unit(n, j, i))) for i, j in pairs
    )


def sl_basis(n: int) -> tuple[Matrix, ...]:
    """E_ij off the diagonal and E_ii − E_nn on it: ζ is Z row by row, less its last entry."""
    return tuple(
        q.unit(n, i, j) if i != j else q.minus(q.unit(n, i, i), q.unit(n, n - 1, n - 1))
        for i in range(n)
        for j in range(n)
        if (i, j) != (n - 1, n - 1)
    )


def gl_basis(n: int) -> tuple[Matrix, ...]:
    """All E_ij, row by row."""
    return tuple(q.unit(n, i, j) for i in range(n) for j in range(n))


def cayley(skew: Matrix) -> Matrix:
    """(1 − S)(1 + S)⁻¹, a rational rotation (1 + S is invertible for skew S)."""
    one = q.identity(len(skew))
    inverse = q.inverse(q.plus(one, skew))
    assert inverse is not None
    return q.times(q.minus(one, skew), inverse)


def sample_so(n: int) -> Sampler:
    """Cayley transform of a random skew matrix."""
    basis = so_basis(n)
    return lambda random, size: cayley(q.combine([_fraction(random, size) for _ in basis], basis))


def sample_sl(n: int) -> Sampler:
    """A product of unitriangular matrices, lower · upper · lower: elementary factors gathered."""

    def triangular(random: Random, size: int, lower: bool) -> Matrix:
        return tuple(
            tuple(
                Fraction(1)
                if i == j
                else _fraction(random, size)
                if (i > j) == lower
                else Fraction(0)
                for j in range(n)
            )
            for i in range(n)
        )

    def sample(random: Random, size: int) -> Matrix:
        low, up = triangular(random, size, True), triangular(random, size, False)
        return q.times(q.times(low, up), triangular(random, size, True))

    return sample


def sample_gl(n: int) -> Sampler:
    """A random matrix; singular with probability ≤ n / size, then drawn again."""

    def sample(random: Random, size: int) -> Matrix:
        while True:
            a = tuple(tuple(_fraction(random, size) for _ in range(n)) for _ in range(n))
            if q.rank(a) == n:
                return a

    return sample


def affine_basis(linear: Sequence[Matrix], n: int) -> tuple[Matrix, ...]:
    """The linear basis bordered by zeros, then the translations."""
    last = (Fraction(0),) * (n + 1)
    bordered = [(*((*row, Fraction(0)) for row in e), last) for e in linear]
    return (*bordered, *(q.unit(n + 1, i, n) for i in range(n)))


def sample_affine(linear: Sampler, n: int) -> Sampler:
    """A linear element and a random translation."""

    def sample(random: Random, size: int) -> Matrix:
        a = linear(random, size)
        rows = tuple((*row, _fraction(random, size)) for row in a)
        return (*rows, (*(Fraction(0),) * n, Fraction(1)))

    return sample


def _orthogonal(n: int) -> Group:
    relations: frozenset[Relation] = frozenset({"orthogonal", "unimodular"})
    return Group(f"SO({n})", n, "linear", so_basis(n), relations, sample_so(n))


def _euclidean(n: int) -> Group:
    relations: frozenset[Relation] = frozenset({"orthogonal", "unimodular"})
    sampler = sample_affine(sample_so(n), n)
    return Group(f"SE({n})", n, "affine", affine_basis(so_basis(n), n), relations, sampler)


def _special(n: int) -> Group:
    return Group(f"SL({n})", n, "linear", sl_basis(n), frozenset({"unimodular"}), sample_sl(n))


def _general(n: int) -> Group:
    return Group(f"GL({n})", n, "linear", gl_basis(n), frozenset(), sample_gl(n))


def _affine(n: int) -> Group:
    sampler = sample_affine(sample_gl(n), n)
    return Group(f"Aff({n})", n, "affine", affine_basis(gl_basis(n), n), frozenset(), sampler)


def turning_about_a_point() -> Group:
    """The rotations of R³ about (1, 2, 3): affine maps whose translations are not free."""
    place: Matrix = ((Fraction(1),), (Fraction(2),), (Fraction(3),))
    turn = sample_so(3)
    zero = (Fraction(0),) * 4

    def moved(linear: Matrix, translation: Matrix, last: tuple[Fraction, ...]) -> Matrix:
        return (*((*row, *x) for row, x in zip(linear, translation, strict=True)), last)

    def sample(random: Random, size: int) -> Matrix:
        a = turn(random, size)
        return moved(a, q.minus(place, q.times(a, place)), (*zero[:3], Fraction(1)))

    basis = tuple(moved(e, q.scaled(-1, q.times(e, place)), zero) for e in so_basis(3))
    relations: frozenset[Relation] = frozenset({"orthogonal", "unimodular"})
    return Group("SO(3) about a point", 3, "affine", basis, relations, sample)


FAMILIES: dict[str, tuple[Callable[[int], Group], int, str]] = {
    "SO": (_orthogonal, 2, "rotations, ĀA = 1"),
    "SE": (_euclidean, 2, "displacements, r ↦ A r + T with ĀA = 1"),
    "SL": (_special, 2, "volume-preserving linear maps, det A = 1"),
    "GL": (_general, 1, "invertible linear maps"),
    "Aff": (_affine, 1, "invertible affine maps"),
}
"""Name → (constructor from n, smallest n, description)."""

LARGEST = 8


def group(name: str) -> Group:
    """The group called ``"SO(3)"``, ``"SL(4)"``, …; ``ValueError`` says what is known."""
    match = re.fullmatch(r"\s*([A-Za-z]+)\(\s*([0-9]{1,3})\s*\)\s*", name)
    if match is None or match[1] not in FAMILIES:
        known = ", ".join(f"{family}(n)" for family in FAMILIES)
        raise ValueError(f"unknown group {name[:40]!r}; known: {known}")
    make, least, _ = FAMILIES[match[1]]
    n = int(match[2])
    if not least <= n <= LARGEST:
        raise ValueError(f"{match[1]}({n}): n must be from {least} to {LARGEST}")
    return make(n)
