"""Polynomials in one variable over Q or a quadratic field; their real roots, counted exactly."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import total_ordering
from itertools import pairwise
from math import isqrt, sqrt
from typing import Any, Literal

from .derivatives import power
from .rational import FieldElement
from .tree import Tree, add, mul, plain
from .values import value

# Exact numbers a + b√d, a and b rational, of one quadratic field, d > 1 an integer.
#
# Where b vanishes the number is a fraction. Signs are exact.

TRIED = 1_000
"""Squares of primes up to this are taken out of a root."""


class RootError(ValueError):
    """A number in no quadratic field: the message says why."""


@total_ordering
class Quadratic(FieldElement):
    """The number a + b√d, with b not 0; numbers with different d have no sum."""

    __slots__ = ("a", "b", "d")

    def __init__(self, a: Fraction, b: Fraction, d: int):
        self.a, self.b, self.d = a, b, d

    def _with(self, other: Any) -> tuple[Fraction, Fraction] | None:
        """The parts of another number of the field; ``None`` for anything else."""
        if isinstance(other, (int, Fraction)):
            return Fraction(other), Fraction(0)
        if not isinstance(other, Quadratic):
            return None
        if other.d != self.d:
            raise RootError(f"sqrt({self.d}) and sqrt({other.d}) are of different fields")
        return other.a, other.b

    def __add__(self, other: Any) -> Any:
        y = self._with(other)
        return NotImplemented if y is None else number(self.a + y[0], self.b + y[1], self.d)

    def __neg__(self) -> Quadratic:
        return Quadratic(-self.a, -self.b, self.d)

    def __mul__(self, other: Any) -> Any:
        y = self._with(other)
        if y is None:
            return NotImplemented
        c, e = y
        return number(self.a * c + self.b * e * self.d, self.a * e + self.b * c, self.d)

    @property
    def norm(self) -> Fraction:
        """(a + b√d)(a − b√d)."""
        return self.a**2 - self.b**2 * self.d

    @property
    def conjugate(self) -> Quadratic:
        """a − b√d."""
        return Quadratic(self.a, -self.b, self.d)

    @property
    def inverse(self) -> Quadratic:
        """1 over the number."""
        return Quadratic(self.a / self.norm, -self.b / self.norm, self.d)

    def __eq__(self, other: object) -> bool:
        same = isinstance(other, Quadratic) and other.d == self.d
        return same and (self.a, self.b) == (other.a, other.b)  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash((self.a, self.b, self.d))

    def __lt__(self, other: Any) -> bool:
        x = self - other
        return x.sign < 0 if isinstance(x, Quadratic) else x < 0

    @property
    def sign(self) -> int:
        """1 or −1: of the part that is larger."""
        by_root = self.b**2 * self.d > self.a**2
        return 1 if (self.b if by_root else self.a) > 0 else -1

    def __float__(self) -> float:
        return float(self.a) + float(self.b) * sqrt(self.d)

    def __repr__(self) -> str:
        from .show import show

        return show(tree(self))


Number = Fraction | Quadratic


def number(a: Fraction, b: Fraction, d: int) -> Number:
    """a + b√d."""
    return Quadratic(a, b, d) if b else a


def root(x: int | Number) -> Number:
    """√x of a number x ≥ 0; ``RootError`` for a negative one, and where √x is in no quadratic
    field."""
    if isinstance(x, Quadratic):
        return _root_in_its_field(x)
    x = Fraction(x)
    if x < 0:
        raise RootError("the root of a negative number")
    left, outside = x.numerator * x.denominator, 1
    for k in range(2, TRIED):
        if k * k > left:
            break
        while left % (k * k) == 0:
            left, outside = left // (k * k), outside * k
    whole = isqrt(left)
    if whole * whole == left:
        return Fraction(outside * whole, x.denominator)
    return Quadratic(Fraction(0), Fraction(outside, x.denominator), left)


def _root_in_its_field(x: Quadratic) -> Number:
    """√(a + b√d) = u + v√d: u² is half of a ± √(a² − b²d), and v = b/2u."""
    if x.sign < 0:
        raise RootError("the root of a negative number")
    n = root(x.norm) if x.norm >= 0 else x
    for sign in (1, -1) if isinstance(n, Fraction) else ():
        square = (x.a + sign * n) / 2
        u = root(square) if square > 0 else x
        if isinstance(u, Fraction):
            found = Quadratic(u, x.b / (2 * u), x.d)
            return found if found.sign > 0 else -found
    raise RootError("a root of a root is in no quadratic field")


def exact_function(name: str, x: Any) -> Number:
    """√x of a number; ``RootError`` for another function, and where it is in no quadratic field."""
    if name != "sqrt":
        raise RootError(f"{name} of a number; square roots alone are exact")
    return root(x)


def value_of(t: Tree) -> Number:
    """The value of an expression of numbers and square roots; ``RootError`` where it is in no
    quadratic field."""
    found = value(t, {}, {}, exact_function)
    return Fraction(found) if isinstance(found, int) else found


def tree(x: Number) -> Tree:
    """A number as a tree."""
    if isinstance(x, Quadratic):
        return add(plain(x.a), mul(plain(x.b), ("fun", "sqrt", x.d)))
    return plain(x)


DEGREES = 1000
"""Powers below this one are read; a file of a stranger may have any."""


def polynomial_tree(f: Sequence[Number], x: Tree) -> Tree:
    """Σ f_k x^(n−k) as a tree, for coefficients from the highest power."""
    return polynomial_of([*map(tree, f)], x)


def polynomial_of(f: Sequence[Tree], x: Tree) -> Tree:
    """The same of coefficients that are trees."""
    terms = (mul(c, power(x, k)) for k, c in zip(range(len(f) - 1, -1, -1), f, strict=True))
    return add(*terms)


def coefficients_of(t: Tree, x: Tree) -> list[Tree]:
    """Those of such a tree, from the highest power; a factor that is no power of x, or too high a
    one, is one of the coefficient."""
    found: dict[int, Tree] = {}
    for term in t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,):
        degree, rest = 0, []
        for y in term[1:] if isinstance(term, tuple) and term[0] == "mul" else (term,):
            if y == x:
                degree += 1
            elif isinstance(y, tuple) and y[:2] == ("pow", x) and y[2] in range(DEGREES):
                degree += y[2]
            else:
                rest.append(y)
        found[degree] = add(found.get(degree, 0), mul(*rest))
    return [found.get(k, 0) for k in range(max(found), -1, -1)]


Coefficients = tuple[Any, ...]


@dataclass(frozen=True)
class RealRoots:
    """How many roots a polynomial has: ``at_zero``, by their multiplicity; of the others, complex
    ones too, ``distinct`` ones, and those of them that are ``negative``."""

    at_zero: int
    negative: int
    distinct: int


def real_roots(f: Sequence[Any]) -> RealRoots:
    """The roots of a polynomial that is not 0, by Sturm: of what is left of it without the powers
    of the variable and without multiple roots."""
    at_zero = next(k for k, x in enumerate(f) if x != 0)
    simple = square_free(trimmed(f[at_zero:]))
    chain = sturm(simple)
    far = [p[-1] * (-1) ** (len(p) - 1) for p in chain]
    negative = changes(far) - changes(p[0] for p in chain)
    return RealRoots(at_zero, negative, len(simple) - 1)


def sturm(f: Coefficients) -> list[Coefficients]:
    """Sturm’s chain of a polynomial without multiple roots."""
    chain = [f]
    after = derivative(f)
    while any(after):
        chain.append(after)
        after = tuple(-x for x in division(*chain[-2:])[1])
    return chain


def changes(values: Iterable[Any]) -> int:
    """How often the sign changes along some numbers, those that are 0 left out."""
    signs = [x > 0 for x in values if x != 0]
    return sum(x != y for x, y in pairwise(signs))


def grows(f: Sequence[Any]) -> bool:
    """Has a polynomial a root with positive real part?

    The roots that come with their opposites are those of the common divisor of f(x) and f(−x),
    xᵃq(x²), where all must be imaginary or 0: q has real roots alone, and none is positive.  Of
    the others Routh's scheme says whether all have negative real parts.
    """
    own = trimmed(f)
    opposite = tuple((-1) ** k * x for k, x in enumerate(own))
    both = common_divisor(own, opposite)
    at_zero = next(k for k, x in enumerate(both) if x != 0)
    squares = real_roots(both[at_zero::2])
    return squares.negative < squares.distinct or routh(division(own, both)[0][::-1]) < 1


def routh(
    f: Sequence[Any], sign: Callable[[Any], int] = lambda x: (x > 0) - (x < 0)
) -> Literal[1, 0, -1]:
    """1: all roots of a polynomial, given from the highest power, have negative real parts; −1:
    some have not even such that are 0; 0: unknown.

    Each first number of the scheme is one of Hurwitz's determinants over that before, and none of
    these is negative where no real part is positive.
    """
    first, second = [*f[::2]], [*f[1::2]]
    while second:
        if (found := sign(second[0] * f[0])) <= 0:
            return -1 if found else 0
        ratio, after = first[0] / second[0], [*second[1:], 0 * f[0]]
        both = zip(first[1:], after, strict=False)
        first, second = second, [x - ratio * y for x, y in both]
    return 1


def square_free(f: Coefficients) -> Coefficients:
    """A polynomial without its multiple roots: divided by its common divisor with its
    derivative."""
    return division(f, common_divisor(f, derivative(f)))[0]


def common_divisor(f: Coefficients, g: Coefficients) -> Coefficients:
    """The greatest common divisor of two polynomials."""
    while any(g):
        f, g = g, division(f, g)[1]
    return f


def derivative(f: Coefficients) -> Coefficients:
    """The derivative of a polynomial."""
    return trimmed([k * x for k, x in enumerate(f)][1:] or [0 * f[0]])


def division(f: Coefficients, g: Coefficients) -> tuple[Coefficients, Coefficients]:
    """The quotient of two polynomials, and the rest."""
    zero = 0 * f[0]
    rest, found = list(f), [zero] * max(len(f) - len(g) + 1, 1)
    for k in range(len(f) - len(g), -1, -1):
        c = found[k] = rest[k + len(g) - 1] / g[-1]
        for j, x in enumerate(g):
            rest[k + j] -= c * x
    return trimmed(found), trimmed(rest)


def polynomial_value(f: Sequence[Any], x: Any) -> Any:
    """A polynomial at a number."""
    total = 0 * f[0]
    for c in reversed(f):
        total = total * x + c
    return total


def trimmed(f: Sequence[Any]) -> Coefficients:
    """The same without leading coefficients that are 0."""
    last = max((k for k, x in enumerate(f) if x), default=0)
    return tuple(f[: last + 1])
