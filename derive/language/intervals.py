"""Real numbers known within bounds: what is computed of all numbers in them has all their values.

Bounds are multiples of 2^−BITS, rounded outwards.  An exact 0 stays one, and the square of one
number is not negative, so that what vanishes by its form alone does so here.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import isqrt
from operator import attrgetter
from typing import Any, Literal

from . import rational as q
from .rational import FieldElement
from .univariate import Quadratic, routh

BITS = 320
ONE = 1 << BITS
KNOWN = (int, Fraction, Quadratic)
"""Numbers that are exact; the bounds of an interval are about those that are no such multiples."""
DIGITS = 2**128
"""Inverses of derivatives are known so well."""
GUARD = 40
"""Bits by which values of functions are computed more precisely than is claimed of them."""


class UnknownSignError(ArithmeticError):
    """A number of these bounds may be on either side of 0, and it matters."""


class Interval(FieldElement):
    """All numbers from ``low`` to ``high``, integers that count 2^−BITS."""

    __slots__ = ("high", "low")

    def __init__(self, low: int, high: int):
        self.low, self.high = low, high

    @staticmethod
    def of(x: Any) -> Interval:
        """A number, an exact one within its neighbours."""
        if isinstance(x, Interval):
            return x
        if isinstance(x, Quadratic):
            found: Interval = function("sqrt", Interval.of(x.d)) * x.b + x.a
            return found
        n, d = x.as_integer_ratio()
        return Interval(n * ONE // d, -(-n * ONE // d))

    @staticmethod
    def about(x: Fraction, radius: Fraction) -> Interval:
        """The numbers within a radius of one."""
        return Interval(Interval.of(x - radius).low, Interval.of(x + radius).high)

    @property
    def middle(self) -> Fraction:
        """The number in the middle."""
        return Fraction(self.low + self.high, 2 * ONE)

    @property
    def size(self) -> Fraction:
        """The largest absolute value."""
        return Fraction(max(-self.low, self.high), ONE)

    @property
    def sign(self) -> int:
        """1 or −1 where all these numbers have it; 0 where 0 is among them."""
        return (self.low > 0) - (self.high < 0)

    def within(self, other: Interval) -> bool:
        """Are all its numbers inside of others, not at their bounds?"""
        return other.low < self.low and self.high < other.high

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, (*KNOWN, Interval)):
            return NotImplemented
        y = Interval.of(other)
        return Interval(self.low + y.low, self.high + y.high)

    def __neg__(self) -> Interval:
        return Interval(-self.high, -self.low)

    def __mul__(self, other: Any) -> Any:
        if not isinstance(other, (*KNOWN, Interval)):
            return NotImplemented
        y = Interval.of(other)
        ends = [a * b for a in (self.low, self.high) for b in (y.low, y.high)]
        least = min(ends)
        if other is self:  # a square
            least = min(ends[0], ends[3]) if self.sign else 0
        return Interval(least >> BITS, -(-max(ends) >> BITS))

    @property
    def inverse(self) -> Interval:
        """1 over the number; ``ZeroDivisionError`` where it may be 0."""
        if not self.sign:
            raise ZeroDivisionError("division by a number that may be 0")
        return Interval(ONE * ONE // self.high, -(-ONE * ONE // self.low))

    def __pow__(self, n: int) -> Any:
        if n < 0:
            return self.inverse**-n
        root: Any = self ** (n // 2) if n > 1 else Fraction(1)
        square = root * root
        return square * self if n % 2 else square

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, (*KNOWN, Interval)):
            return NotImplemented
        y = Interval.of(other)
        return (self.low, self.high) == (y.low, y.high)

    def __bool__(self) -> bool:
        return (self.low, self.high) != (0, 0)

    def __hash__(self) -> int:
        return hash((self.low, self.high))

    def __float__(self) -> float:
        return float(self.middle)


def function(name: str, x: Any) -> Interval:
    """The values of an elementary function, of "abs", and of "none": 1 at 0, else 0;
    ``UnknownSignError`` where some have none, ``ValueError`` where none has."""
    x = Interval.of(x)
    if name == "none":
        if x and not x.sign:
            raise UnknownSignError("a number may be 0")
        return Interval.of(int(not x))
    if name == "abs":
        ends = sorted((abs(x.low), abs(x.high)))
        return Interval(ends[0] if x.sign else 0, ends[1])
    if name in ("sqrt", "log") and x.low < 0:
        if x.high < 0:
            raise ValueError(f"{name} of a negative number")
        raise UnknownSignError(f"{name} of a number that may be negative")
    if name == "sqrt":
        return Interval(isqrt(x.low << BITS), isqrt(x.high << BITS) + 1)
    if name in ("sin", "cos"):  # neither changes faster than its argument
        there = _value(name, x.low + x.high, 2)
        off = (x.high - x.low) // 2 + 1
        return Interval(max(-ONE, there.low - off), min(ONE, there.high + off))
    combined: Any = None
    if name == "tan":
        combined = function("sin", x) / function("cos", x)
    if name == "cosh":
        combined = (function("exp", x) + function("exp", -x)) * Fraction(1, 2)
    if combined is not None:
        return Interval.of(combined)
    return Interval(_value(name, x.low).low, _value(name, x.high).high)  # increasing


def pi() -> Interval:
    """π."""
    return Interval.of(function("atan", Interval.of(1)) * 4)


def _value(name: str, n: int, over: int = 1) -> Interval:
    """The value at n/over, counted in 2^−BITS."""
    import mpmath

    if name == "log" and n <= 0:
        raise UnknownSignError("log of a number that may be 0")
    with mpmath.workprec(BITS + abs(n).bit_length() + 2 * GUARD):
        f: Callable[[Any], Any] = getattr(mpmath, name)
        y = f(mpmath.mpf(n) / (over * ONE)) * ONE
        found, off = int(mpmath.floor(y)), abs(y) / 2 ** (BITS + GUARD)
        return Interval(found - int(off) - 1, found + int(off) + 2)


def krawczyk(
    box: Sequence[Interval], at_middle: Sequence[Any], slopes: Sequence[Sequence[Any]]
) -> list[Interval] | None:
    """Krawczyk's operator c − CF(c) + (1 − CF′)(y − c) of a box y, by F at its middle c and the
    derivatives F′ in the box, C about the inverse of F′; ``None`` where that has none.  Where it
    leads to inside of the box, one zero of F is there, and no other."""
    about = q.inverse(q.matrix([[_short(Interval.of(x).middle) for x in row] for row in slopes]))
    if about is None:
        return None
    middle = [x.middle for x in box]
    C = q.matrix([[_short(x) for x in row] for row in about])
    away = q.column(x - c for x, c in zip(box, middle, strict=True))
    left = q.minus(q.identity(len(box)), q.times(C, slopes))
    step = q.minus(q.times(left, away), q.times(C, q.column(at_middle)))
    return [Interval.of(c + x) for c, (x,) in zip(middle, step, strict=True)]


def _short(x: Fraction) -> Fraction:
    """A number with fewer digits."""
    return Fraction(round(x * DIGITS), DIGITS)


def characteristic(a: Sequence[Sequence[Any]]) -> list[Interval]:
    """The characteristic polynomial of a square matrix, from the highest power, by products alone
    (Faddeev and Leverrier)."""
    rows = tuple(tuple(map(Interval.of, row)) for row in a)
    found, M = [Interval.of(1)], q.identity(len(rows))
    for k in range(1, len(rows) + 1):
        M = q.times(rows, M)
        found.append(q.trace(M) * Fraction(-1, k))
        M = q.plus(M, q.scaled(found[-1], q.identity(len(rows))))
    return found


def signs_of_real_parts(f: Sequence[Interval]) -> Literal["negative", "positive", "unknown"]:
    """Are the real parts of all roots of a polynomial, from the highest power, "negative", or is
    one "positive"?  By Routh's scheme, also of f(x + s) for some s > 0, as of f itself nothing is
    proved where a root is 0."""
    sign = attrgetter("sign")
    if routh(f, sign) > 0:
        return "negative"
    shifts = (Fraction(0), *(Fraction(2) ** k for k in SHIFTS))
    grows = any(routh(_shifted(f, s), sign) < 0 for s in shifts)
    return "positive" if grows else "unknown"


def root_near(f: Sequence[Interval], re: Fraction, im: Fraction) -> Fraction | None:
    """The square of n |f/f′| at re + i im, so far from which a polynomial of degree n, given from
    the highest power, has a root; ``None`` where f′ may be 0 there."""
    value, slope = (f[0], Interval.of(0)), (Interval.of(0), Interval.of(0))
    for c in f[1:]:
        (a, b), (x, y) = slope, value
        slope = a * re - b * im + x, a * im + b * re + y
        value = x * re - y * im + c, x * im + y * re
    above, below = (x**2 + y**2 for x, y in (value, slope))
    return Fraction(above.high * (len(f) - 1) ** 2, below.low) if below.low > 0 else None


SHIFTS = range(-24, 12)
"""Powers of two: a root whose real part is larger than one of these is seen."""


def _shifted(f: Sequence[Interval], s: Fraction) -> list[Interval]:
    """f(x + s), by divisions by x − s."""
    left, found = [*f], []
    while left:
        for k in range(1, len(left)):
            left[k] = left[k] + left[k - 1] * s
        found.append(left.pop())
    return found[::-1]
