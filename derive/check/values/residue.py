"""Rational numbers by residues modulo a prime, and numbers of which only the degree is known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import lru_cache, reduce
from itertools import count
from operator import mul
from random import Random
from typing import Any, NamedTuple

from ...language.rational import FieldElement, Matrix, flatten
from ...language.univariate import Quadratic

# Rational numbers by their residues modulo a large random prime.
#
# Two different numbers have the same residue only for primes that divide their difference. Of the
# more than 2²⁴⁷ primes of 256 bits these are one for every 255 bits of its numerator: fewer than
# the degree of a claim, so that they add nothing to its bound.

BITS = 256
ROUNDS = 40
SMALL = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)


def random_prime(random: Random) -> int:
    """A random prime of :data:`BITS` bits."""
    while True:
        n = random.getrandbits(BITS) | 1 | 1 << (BITS - 1)
        if all(n % p for p in SMALL) and all(
            _passes_miller_rabin(n, random) for _ in range(ROUNDS)
        ):
            return n


def _passes_miller_rabin(n: int, random: Random) -> bool:
    """Does n pass Miller and Rabin's test for one random base? A composite does once in four."""
    odd, twos = n - 1, 0
    while not odd & 1:
        odd, twos = odd >> 1, twos + 1
    x = pow(random.randrange(2, n - 1), odd, n)
    return x == 1 or any(pow(x, 1 << k, n) == n - 1 for k in range(twos))


@lru_cache(2**12)
def _quotient(a: int, b: int, p: int) -> int:
    """a/b modulo p; ``ZeroDivisionError`` where p divides b."""
    return a * _inverse(b, p) % p


def _inverse(n: int, p: int) -> int:
    if not n % p:
        raise ZeroDivisionError("division by zero")
    return pow(n, -1, p)


def _residue(x: Any, p: int) -> int:
    """The residue of an integer, a fraction or a residue, as an integer."""
    if type(x) is Residue:
        return x.n
    a, b = x.as_integer_ratio()
    return int(a) if b == 1 else _quotient(a, b, p)


class Residue(FieldElement):
    """The residue n of a rational number modulo a prime p: an element of the field F_p."""

    __slots__ = ("n", "p")
    denominator = 1

    def __init__(self, n: int, p: int):
        self.n, self.p = n % p, p

    @property
    def numerator(self) -> int:
        """The least integer that has the residue."""
        return self.n

    def _other(self, x: Any) -> int | None:
        if isinstance(x, Residue):
            return x.n
        if isinstance(x, int):
            return x
        if not isinstance(x, Fraction):
            return None
        a, b = x.numerator, x.denominator
        return a if b == 1 else _quotient(a, b, self.p)

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i, reduced modulo p once."""
        return Residue.product([a], [b])[0][0]

    @staticmethod
    def product(rows: Sequence[Sequence[Any]], columns: Sequence[Sequence[Any]]) -> Any:
        """Each row times each column, reduced modulo p once."""
        p = next(x.p for m in (rows, columns) for y in m for x in y if isinstance(x, Residue))
        left, right = ([[_residue(x, p) for x in y] for y in m] for m in (rows, columns))
        return tuple(tuple(Residue(sum(map(mul, x, y)), p) for y in right) for x in left)

    def __add__(self, other: Any) -> Any:
        y = other.n if isinstance(other, Residue) else self._other(other)
        return NotImplemented if y is None else Residue(self.n + y, self.p)

    def __sub__(self, other: Any) -> Any:
        y = other.n if isinstance(other, Residue) else self._other(other)
        return NotImplemented if y is None else Residue(self.n - y, self.p)

    def __mul__(self, other: Any) -> Any:
        y = other.n if isinstance(other, Residue) else self._other(other)
        return NotImplemented if y is None else Residue(self.n * y, self.p)

    @property
    def inverse(self) -> Residue:
        """1 over the number."""
        return Residue(_inverse(self.n, self.p), self.p)

    def __neg__(self) -> Residue:
        return Residue(-self.n, self.p)

    def __pow__(self, n: int) -> Residue:
        return Residue(pow(self.n if n > 0 else _inverse(self.n, self.p), abs(n), self.p), self.p)

    def __eq__(self, other: object) -> bool:
        y = self._other(other)
        return NotImplemented if y is None else self.n == y % self.p

    def __bool__(self) -> bool:
        return self.n != 0

    def __hash__(self) -> int:
        return hash(self.n)


class ResidueSource:
    """A source of residues modulo p in the place of a random one, to draw a model from."""

    def __init__(self, random: Random, p: int):
        self.random, self.p = random, p

    def randint(self, low: int, high: int) -> Residue:
        """The residue of a random integer from low to high."""
        return Residue(self.random.randint(low, high), self.p)


# Numbers of which only the degree is known, for the Schwartz–Zippel degree of a claim.
#
# Such a number stands for a rational function of all that is drawn: a numerator, over powers of a
# few named polynomials. Dividing by a number names it; sums go over the least common denominator.
# What is zero by its form alone stays a plain 0; every other number counts as one that is not.

MEMO = 2**16
PLAIN = (int, Fraction, Quadratic)
"""The numbers that are themselves, not of a degree alone."""


class Grade(NamedTuple):
    """What is known of a polynomial in all that is drawn.

    ``degree``: its total degree. ``slots``: the number of indices of the tensors that it contracts,
    two for each matrix, one for each vector. ``loops``: the number of traces of 1, each a factor n.
    """

    degree: int
    slots: int
    loops: int


ZERO_GRADE = Grade(0, 0, 0)
Factor = tuple[int, Grade]
Powers = tuple[tuple[Factor, int], ...]


class Degree:
    """What is known of a rational function: the grade ``num`` of a polynomial, over the powers
    ``den`` of named polynomials, with negative exponents for those in the numerator."""

    __slots__ = ("den", "num")

    def __init__(self, num: Grade, den: Powers):
        self.num, self.den = num, den

    @property
    def numerator(self) -> Grade:
        """The grade of the numerator multiplied out, named factors included."""
        return _times_powers(self.num, ((f, -k) for f, k in self.den if k < 0))

    @property
    def denominator(self) -> Grade:
        """The grade of the denominator multiplied out."""
        return _times_powers(ZERO_GRADE, ((f, k) for f, k in self.den if k > 0))

    @property
    def total_degree(self) -> int:
        """The degree of numerator and denominator together: the probability that one of them
        vanishes at a random point is at most this over the size."""
        return self.numerator.degree + self.denominator.degree


def _times_powers(g: Grade, powers: Iterable[tuple[Factor, int]]) -> Grade:
    """The grade of a polynomial times powers of named ones."""
    for (_, own), k in powers:
        g = Grade(g[0] + k * own[0], g[1] + k * own[1], g[2] + k * own[2])
    return g


@lru_cache(MEMO)
def _degree(num: Grade, den: Powers) -> Degree:
    """The Degree of this value, one object for all that are equal: they are cheap to compare."""
    return Degree(num, den)


def _degree_of(num: Grade, powers: dict[Factor, int]) -> Degree:
    """A Degree from its powers in any order, exponents 0 left out."""
    return _degree(num, tuple(sorted((f, k) for f, k in powers.items() if k)))


@lru_cache(MEMO)
def _degree_of_product(a: Degree, b: Degree) -> Degree:
    powers = dict(a.den)
    for f, k in b.den:
        powers[f] = powers.get(f, 0) + k
    return _degree_of(_times_powers(a.num, [((0, b.num), 1)]), powers)


@lru_cache(MEMO)
def _degree_of_sum(a: Degree, b: Degree) -> Degree:
    if a is b:
        return a
    first, second = dict(a.den), dict(b.den)
    powers = {f: max(first.get(f, 0), second.get(f, 0)) for f in first | second}
    lifted = (
        _times_powers(x.num, ((f, k - own.get(f, 0)) for f, k in powers.items()))
        for x, own in ((a, first), (b, second))
    )
    return _degree_of(Grade(*map(max, *lifted)), powers)


@lru_cache(MEMO)
def _degree_of_dot(a: tuple[Degree | None, ...], b: tuple[Degree | None, ...]) -> Degree | None:
    """That of Σ a_i b_i, where ``None`` is a plain 0."""
    terms = dict.fromkeys((x, y) for x, y in zip(a, b, strict=True) if x and y)
    sums = dict.fromkeys(_degree_of_product(x, y) for x, y in terms)
    return reduce(_degree_of_sum, sums) if sums else None


CONSTANT = _degree(ZERO_GRADE, ())
_number = count(1)


def _factor(g: Grade) -> Factor:
    """A new named polynomial of this grade."""
    return next(_number), g


class Graded(FieldElement):
    """A number of which the degree alone is known; equal to itself alone."""

    __slots__ = ("_inverse", "degree")

    def __init__(self, degree: Degree):
        self.degree = degree
        self._inverse: Graded | None = None

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Graded):
            return Graded(_degree_of_sum(self.degree, other.degree))
        if not isinstance(other, PLAIN):
            return NotImplemented
        return Graded(_degree_of_sum(self.degree, CONSTANT)) if other else self

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Graded):
            return Graded(_degree_of_product(self.degree, other.degree))
        if not isinstance(other, PLAIN):
            return NotImplemented
        return self if other else Fraction(0)

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i."""
        return Graded.product([a], [b])[0][0]

    @staticmethod
    def product(rows: Sequence[Sequence[Any]], columns: Sequence[Sequence[Any]]) -> Matrix:
        """Each row times each column: of terms of one degree, one is enough."""
        left, right = ([(*map(_degree_if_there, x),) for x in m] for m in (rows, columns))
        found = ((_degree_of_dot(x, y) for y in right) for x in left)
        return tuple(tuple(Graded(x) if x else Fraction(0) for x in row) for row in found)

    def __neg__(self) -> Graded:
        return self

    __abs__ = __neg__

    @property
    def inverse(self) -> Graded:
        """1 over this number, the same object each time."""
        if self._inverse is None:
            powers = {f: -k for f, k in self.degree.den}
            powers[_factor(self.degree.num)] = 1
            self._inverse = Graded(_degree_of(ZERO_GRADE, powers))
        return self._inverse

    @staticmethod
    def solved(a: Matrix, b: Matrix) -> Matrix:
        """The n × m matrix x with a x = b, for a of size n, by Cramer's rule; as to indices, a⁻¹
        counts as a letter like a."""
        left, right, size = common_degree(flatten(a)), common_degree(flatten(b)), len(a)
        top, other = left.numerator, right.num
        powers = dict(right.den)
        for f, k in left.den:
            if k > 0:
                powers[f] = powers.get(f, 0) - k
        powers[_factor(Grade(size * top.degree, 0, 0))] = 1
        slots, loops = top.slots + other.slots, top.loops + other.loops
        found = _degree_of(Grade((size - 1) * top.degree + other.degree, slots, loops), powers)
        return tuple(tuple(Graded(found) for _ in b[0]) for _ in a)


def _degree_if_there(x: Any) -> Degree | None:
    """Its degree; ``None`` for a plain 0."""
    if isinstance(x, Graded):
        return x.degree
    return CONSTANT if x != 0 else None


def common_degree(entries: Iterable[Any]) -> Degree:
    """The degree of several numbers brought to one common denominator."""
    return reduce(_degree_of_sum, degrees(entries), CONSTANT)


def degrees(entries: Iterable[Any]) -> Iterator[Degree]:
    """The degree of each number; a plain one is constant."""
    return (x.degree if isinstance(x, Graded) else CONSTANT for x in entries)


def indeterminate(slots: int = 2, loops: int = 0) -> Graded:
    """An indeterminate: an entry of a drawn tensor with ``slots`` indices; with ``loops``, a 1 that
    stands for so many traces of 1."""
    return Graded(_degree(Grade(int(not loops), slots, loops), ()))


def with_slots(x: Any, slots: int) -> Any:
    """A graded number as an entry of a tensor with ``slots`` indices; any other as it is."""
    if not isinstance(x, Graded):
        return x
    top = x.degree.num
    return Graded(_degree(Grade(top.degree, slots, top.loops), x.degree.den))


class DegreeSource:
    """A source of indeterminates in the place of a random one: a model drawn from it is graded."""

    def randint(self, low: int, high: int) -> Graded:
        """A new entry of a matrix, whatever the range."""
        del low, high
        return indeterminate()
