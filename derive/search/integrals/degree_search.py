"""The polynomials of a degree that are constant along the motion, beyond those already known."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, islice
from math import lcm, prod
from random import Random
from typing import Any

from ...algebra.exact_kernel import pivots
from ...language.limits import Refused
from ...language.rational import summed
from .lie_poisson import (
    PRIMES,
    Exponents,
    Level,
    PoissonPolynomials,
    Polynomial,
    kernel_modulo,
    kernel_vector,
    monomial_order,
    multiplied,
    rank_modulo,
)
from .parameter_cases import Grading

MONOMIALS = 20_000
"""The most monomials of one degree that are searched."""
UNKNOWNS = 2_500
"""The most unknowns of one linear system."""
CIRCUITS = 2_000
"""So many choices of zeros are tried for a vector of few terms."""


class TooLargeError(Refused, ValueError):
    """A linear system over the limits: the message says its size."""


class UnluckyPrimeError(Exception):
    """Modulo this prime, at these values of the parameters, there are more solutions than over the
    field: another prime has not."""


Residues = dict[Exponents, int]
"""A polynomial in x modulo a prime, at a point of the parameters."""


@dataclass(frozen=True)
class PrimePoint:
    """A prime, and values of the parameters modulo it."""

    p: int
    values: tuple[int, ...]

    def residues(self, f: Polynomial) -> Residues:
        """A polynomial with coefficients in the field at this point."""
        found = {e: self.number(c) for e, c in f.items()}
        return {e: c for e, c in found.items() if c}

    def number(self, c: Any) -> int:
        """An element of the field at this point."""
        if not self.values:
            return self.inverse(int(c.denominator)) * int(c.numerator) % self.p
        return self._polynomial(c.numer) * self.inverse(self._polynomial(c.denom)) % self.p

    def inverse(self, x: int) -> int:
        """1/x; ``UnluckyPrimeError`` where the prime divides x."""
        if not x % self.p:
            raise UnluckyPrimeError
        return pow(x, -1, self.p)

    def _polynomial(self, f: Any) -> int:
        total = 0
        for m, c in f.items():
            power = prod(pow(v, k, self.p) for v, k in zip(self.values, m, strict=True) if k)
            total += int(c.numerator) * self.inverse(int(c.denominator)) * power
        return total % self.p


def point(algebra: PoissonPolynomials, attempt: int) -> PrimePoint:
    """The point of an attempt: the same at every run."""
    p = PRIMES[attempt % len(PRIMES)]
    random = Random(f"integrals {attempt}")
    return PrimePoint(p, tuple(random.randrange(1, p) for _ in algebra.letters))


# -- monomials ----------------------------------------------------------------------------------


def monomials(grading: Grading, degree: Fraction) -> list[Exponents]:
    """The monomials of a degree, all of at most this degree where H is not homogeneous, but 1;
    ``TooLargeError`` where there are too many."""
    several = how_many(grading.degree, degree, exactly=grading.homogeneous)
    if several > MONOMIALS:
        raise TooLargeError(
            f"degree {degree}: a linear system of {several} unknowns; at most {MONOMIALS}"
        )
    return [e for e in _monomials(grading.degree, degree, grading.homogeneous) if any(e)]


def unknowns(grading: Grading, degree: Fraction) -> int:
    """The most unknowns of one linear system of a degree; of more monomials than are listed, how
    many these are."""
    count = how_many(grading.degree, degree, exactly=grading.homogeneous)
    if count > MONOMIALS:
        return count
    sizes = Counter(map(grading.block, monomials(grading, degree)))
    return max(sizes.values(), default=0)


def how_many(weights: Sequence[Fraction], degree: Fraction, *, exactly: bool) -> int:
    """How many monomials there are of a degree, or of at most this degree."""
    unit = lcm(*(w.denominator for w in weights))
    most = int(degree * unit)
    found = [1] + [0] * most
    for w in weights:
        step = int(w * unit)
        for v in range(step, most + 1):
            found[v] += found[v - step]
    return found[most] if exactly else sum(found)


def _monomials(weights: Sequence[Fraction], left: Fraction, exactly: bool) -> Iterator[Exponents]:
    if not weights:
        if left == 0 or not exactly:
            yield ()
        return
    for k in range(1 + int(left / weights[0])):
        for rest in _monomials(weights[1:], left - k * weights[0], exactly):
            yield (k, *rest)


def blocks(grading: Grading, degree: Fraction) -> list[list[Exponents]]:
    """The monomials of a degree, apart by their other weights."""
    found: dict[tuple[int, ...], list[Exponents]] = {}
    for e in monomials(grading, degree):
        found.setdefault(grading.block(e), []).append(e)
    most = max(map(len, found.values()), default=0)
    if most > UNKNOWNS:
        raise TooLargeError(
            f"degree {degree}: a linear system of {most} unknowns; at most {UNKNOWNS}"
        )
    return [sorted(block, key=monomial_order) for _, block in sorted(found.items())]


# -- the linear system --------------------------------------------------------------------------


Rows = dict[tuple[int, Exponents], dict[int, Any]]
"""A row, unknown → coefficient, for each derivation and monomial of the image."""


def system_rows(
    block: Sequence[Exponents], derivations: Sequence[Mapping[int, Polynomial]]
) -> Rows:
    """The equations D(Σ_j c_j x^{e_j}) = 0 for each derivation D in the unknowns c_j; a derivation
    maps i to its value on x_i."""
    rows: Rows = {}
    for j, e in enumerate(block):
        for d, images in enumerate(derivations):
            for i, image in images.items():
                if not e[i]:
                    continue
                rest = (*e[:i], e[i] - 1, *e[i + 1 :])
                for m, c in image.items():
                    target = tuple(map(int.__add__, rest, m))
                    row = rows.setdefault((d, target), {})
                    row[j] = row[j] + c * e[i] if j in row else c * e[i]
    return rows


# -- vectors of few terms -----------------------------------------------------------------------

Vector = list[int]


def sparse_vectors(kernel: Sequence[Vector], p: int) -> Iterator[Vector]:
    """Vectors of a space with as few terms as possible, few terms first, spanning the space.

    A vector of the space that vanishes at k − 1 independent places is told by them, up to a factor;
    no vector has fewer places than some of these.
    """
    k = len(kernel)
    directions: dict[tuple[int, ...], None] = {}
    for column in zip(*kernel, strict=True):
        lead = next((x for x in column if x), 0)
        if lead:
            inverse = pow(lead, -1, p)
            directions[tuple(x * inverse % p for x in column)] = None
    found = {tuple(x): None for x in kernel}
    for chosen in islice(combinations(directions, k - 1), CIRCUITS):
        rows = [{j: x for j, x in enumerate(c) if x} for c in chosen]
        weights = kernel_modulo(rows, k, p) if rows else [[1]]
        if len(weights) == 1:
            found[tuple(_combined(weights[0], kernel, p))] = None
    return iter(map(list, sorted(found, key=lambda v: (sum(map(bool, v)), [not x for x in v]))))


def _combined(weights: Sequence[int], vectors: Sequence[Vector], p: int) -> Vector:
    return [
        sum(w * x for w, x in zip(weights, column, strict=True)) % p
        for column in zip(*vectors, strict=True)
    ]


def new_vectors(kernel: Sequence[Vector], known: Sequence[Vector], p: int) -> Iterator[Vector]:
    """Sparse vectors of a space that span it together with those known in it."""
    span = [*known]
    rank = rank_modulo(span, p)
    for v in sparse_vectors(kernel, p) if rank < len(kernel) else ():
        if rank_modulo([*span, v], p) > rank:
            span.append(v)
            rank += 1
            yield v
        if rank == len(kernel):
            return


# -- what is known ------------------------------------------------------------------------------


def products(
    known: Sequence[tuple[Polynomial, Fraction]], degree: Fraction, p: int = 0, *, exactly: bool
) -> Iterator[Polynomial]:
    """The products of powers of known polynomials, given with their degrees, of a degree; of at
    most this degree unless ``exactly``.  {} counts as 1; modulo p, where that is not 0."""
    if not known:
        if degree == 0 or not exactly:
            yield {}
        return
    (f, w), *others = known
    power: Polynomial = {}
    for k in range(1 + int(degree / w)):
        power = times(power, f, p) if k else power
        for rest in products(others, degree - k * w, p, exactly=exactly):
            yield times(power, rest, p)


def times(f: Polynomial, g: Polynomial, p: int) -> Polynomial:
    """The product of two polynomials, modulo p, where that is not 0; {} counts as 1."""
    if not f or not g:
        return f or g
    found = summed(multiplied(f, g))
    return {e: x % p for e, x in found.items() if x % p} if p else found


# -- the search ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class PolynomialSearch:
    """The search of polynomials on which derivations vanish, at one point of the parameters.

    ``derivations``: for each, i → its value on x_i, over the field.  ``level``: they are to vanish
    where a Casimir does, and polynomials count as equal that are equal there.
    """

    algebra: PoissonPolynomials
    grading: Grading
    derivations: Sequence[Mapping[int, Polynomial]]
    at: PrimePoint
    level: Level | None = None

    def of_degree(self, degree: Fraction, known: Sequence[Polynomial]) -> list[Any]:
        """Polynomials of the ring that span, with the products of the ``known``, all on which the
        derivations vanish; ``UnluckyPrimeError`` where one of them is of this point alone."""
        p = self.at.p
        basis = [(self.at.residues(f), self.grading.largest(f)) for f in known]
        exactly = self.grading.homogeneous
        spanned = [self._on_level(x) for x in products(basis, degree, p, exactly=exactly) if x]
        found = []
        for whole in blocks(self.grading, degree):
            block = [e for e in whole if self.level is None or not self.level.leads(e)]
            place = {e: j for j, e in enumerate(block)}
            rows = self._rows(block, self._at_point).values()
            kernel = kernel_modulo(rows, len(block), p)
            inside = [x for x in spanned if x and all(e in place for e in x)]
            vectors = [[x.get(e, 0) for e in block] for x in inside]
            for v in new_vectors(kernel, vectors, p):
                support = [e for e, c in zip(block, v, strict=True) if c]
                found += [self.lifted(support)]
        return found

    def lifted(self, support: Sequence[Exponents]) -> Any:
        """The polynomial of the ring in these monomials on which the derivations vanish, verified
        over the field; ``UnluckyPrimeError`` where there is none."""
        algebra, field = self.algebra, self.algebra.field
        rows = self._rows(support, self._at_point)
        exact = self._rows(support, self.derivations)
        vector = [field.one]
        if len(support) > 1:
            few = _independent(rows, len(support), self.at.p)
            found = kernel_vector([exact[i] for i in few], len(support), field)
            if found is None:
                raise UnluckyPrimeError
            vector = found
        f = algebra.cleared(dict(zip(support, vector, strict=True)))
        own = algebra.over_the_field(f)
        if not self.at.residues(own):  # else it is the vector of the kernel modulo the prime
            raise UnluckyPrimeError
        for row in exact.values():
            if sum((x * own[support[j]] for j, x in row.items()), field.zero) != 0:
                raise UnluckyPrimeError
        return f

    @cached_property
    def _at_point(self) -> list[dict[int, Residues]]:
        return [{i: self.at.residues(f) for i, f in images.items()} for images in self.derivations]

    def _rows(
        self, block: Sequence[Exponents], derivations: Sequence[Mapping[int, Polynomial]]
    ) -> Rows:
        """The equations in the unknowns, on the level."""
        rows = system_rows(block, derivations)
        if self.level is None:
            return rows
        found: dict[tuple[int, Exponents], dict[int, Any]] = {}
        for (d, target), row in rows.items():
            for e, c in self.level.normal(target).items():
                there = found.setdefault((d, e), {})
                for j, x in row.items():
                    there[j] = there[j] + x * c if j in there else x * c
        return found

    def _on_level(self, f: Residues) -> Residues:
        if self.level is None:
            return f
        p, found = self.at.p, self.level.reduced(f.items())
        return {e: x % p for e, x in found.items() if x % p}


def _independent(rows: Rows, width: int, p: int) -> list[tuple[int, Exponents]]:
    """The keys of rows that span all rows modulo p, short rows first."""
    keys = sorted(rows, key=lambda x: (len(rows[x]), x))
    columns = ([int(rows[x].get(j, 0) % p) for x in keys] for j in range(width))
    return [keys[k] for k in pivots(columns, len(keys), p)][: width - 1]
