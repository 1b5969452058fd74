"""Roots of a polynomial to many digits, and whether numbers are these, rounded.

Weierstrass' method: from numbers z_k near all roots, z_k − f(z_k)/Π_{j≠k}(z_k − z_j).  Where such
steps are small beside the distances, one root is within d times the step of each number.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal

from ...language.quadratic import Number, Quadratic
from ...language.univariate import square_free

DIGITS = 60
"""The digits of the arithmetic."""
STEPS = 200
"""The most steps of Weierstrass' method."""
SMALL = Decimal("1e-30")
"""A step of this part of a root is none."""
START = Decimal("0.4"), Decimal("0.9")
"""Of which powers are the first numbers, where none are known near the roots."""
LEAST = 4
"""Eigenvalues are told to so many digits at least."""
FLOATS = Decimal("1e-12")
"""The part of a number by which a float is off: where it is half of two decimals, both may be
told."""

Complex = tuple[Decimal, Decimal]


def decimal(x: Number) -> Decimal:
    """A number to the digits of the arithmetic."""
    if isinstance(x, Quadratic):
        return decimal(x.a) + decimal(x.b) * Decimal(x.d).sqrt()
    return Decimal(x.numerator) / Decimal(x.denominator)


def roots_near(f: Sequence[Decimal], guesses: Sequence[Complex]) -> list[Complex]:
    """The roots of a polynomial without multiple ones, given from the highest coefficient, 1, each
    near a number; ``ValueError`` where none are found."""
    found = [*guesses]
    for _ in range(STEPS):
        settled = True
        for k, z in enumerate(found):
            step = (Decimal(0), Decimal(0))
            for c in f:
                step = _product(step, z)
                step = step[0] + c, step[1]
            for j, other in enumerate(found):
                if j != k:
                    step = _ratio(step, (z[0] - other[0], z[1] - other[1]))
            found[k] = z[0] - step[0], z[1] - step[1]
            settled = settled and size(step) <= SMALL * size(z)
        if settled:
            return found
    raise ValueError("the roots are not found")


def all_roots(f: Sequence[Number]) -> list[Complex]:
    """The roots of a polynomial, given from the highest coefficient, that are not 0, each once."""
    simple = [*square_free((*f[::-1],))]
    while simple[0] == 0:
        simple = simple[1:]
    guesses = [(Decimal(1), Decimal(0))]
    for _ in simple[1:]:
        guesses.append(_product(guesses[-1], START))
    return roots_near([decimal(x / simple[-1]) for x in simple[::-1]], guesses[1:])


def size(z: Complex) -> Decimal:
    """|z|."""
    return (z[0] * z[0] + z[1] * z[1]).sqrt()


def _product(x: Complex, y: Complex) -> Complex:
    return x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]


def _ratio(x: Complex, y: Complex) -> Complex:
    by = y[0] * y[0] + y[1] * y[1]
    re, im = _product(x, (y[0], -y[1]))
    return re / by, im / by


def digits_told(told: Sequence[Complex]) -> int:
    """To how many digits numbers are told."""
    return max(LEAST, *(len(x.normalize().as_tuple().digits) for pair in told for x in pair))


def are_roots_rounded(told: Sequence[Complex], squares: Sequence[Complex]) -> bool:
    """Are numbers, their parts not negative, the square roots of others, rounded all to as many
    digits as are told?"""
    digits, pairs = digits_told(told), zip(told, map(_root, squares), strict=True)
    return all(is_rounded(x, true, digits, FLOATS) for x, true in pairs)


def _root(square: Complex) -> Complex:
    """The square root, but for the signs of its parts."""
    long = size(square)
    re, im = (max((long + x) / 2, Decimal(0)).sqrt() for x in (square[0], -square[0]))
    return re, im


def is_rounded(told: Complex, true: Complex, digits: int, off: Decimal) -> bool:
    """Are the parts of a number those of another to so many digits, when this part of its size is
    unknown?"""
    for x, y in zip(told, true, strict=True):
        half = Decimal(5).scaleb(y.adjusted() - digits) if y else Decimal(0)
        if abs(x - y) > half + off * size(true):
            return False
    return True
