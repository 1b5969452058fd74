"""Laurent polynomials over Q in named symbols: enough to divide by the entries of a diagonal."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction

Monomial = tuple[tuple[str, int], ...]
"""Sorted (symbol, exponent ≠ 0)."""


class Laurent:
    """A sum of q · monomial with exponents in Z; only a monomial can be divided by.

    >>> x, y = Laurent.symbol("x"), Laurent.symbol("y")
    >>> ((x + y) * (x - y) / x).terms == {(("x", 1),): 1, (("x", -1), ("y", 2)): -1}
    True
    """

    __slots__ = ("terms",)

    def __init__(self, terms: Mapping[Monomial, Fraction]) -> None:
        self.terms = {m: q for m, q in terms.items() if q}

    @classmethod
    def symbol(cls, name: str) -> Laurent:
        """A symbol by itself."""
        return cls({((name, 1),): Fraction(1)})

    @classmethod
    def of(cls, x: Laurent | Fraction | int) -> Laurent:
        """A number as a constant polynomial."""
        return x if isinstance(x, Laurent) else cls({(): Fraction(x)})

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: Laurent | Fraction | int) -> Laurent:
        return _gathered((*self.terms.items(), *Laurent.of(other).terms.items()))

    __radd__ = __add__

    def __neg__(self) -> Laurent:
        return Laurent({m: -q for m, q in self.terms.items()})

    def __sub__(self, other: Laurent | Fraction | int) -> Laurent:
        return self + (-Laurent.of(other))

    def __rsub__(self, other: Fraction | int) -> Laurent:
        return Laurent.of(other) - self

    def __mul__(self, other: Laurent | Fraction | int) -> Laurent:
        right = Laurent.of(other).terms.items()
        return _gathered((_product(m, n), p * q) for m, p in self.terms.items() for n, q in right)

    __rmul__ = __mul__

    def __truediv__(self, other: Laurent | Fraction | int) -> Laurent:
        return self * Laurent.of(other).reciprocal()

    def __rtruediv__(self, other: Fraction | int) -> Laurent:
        return other * self.reciprocal()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, (Laurent, Fraction, int)):
            return NotImplemented
        return self.terms == Laurent.of(other).terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def reciprocal(self) -> Laurent:
        """1/p of a monomial; ``ZeroDivisionError`` of anything else."""
        if len(self.terms) != 1:
            raise ZeroDivisionError("only a monomial has an inverse here")
        ((m, q),) = self.terms.items()
        return Laurent({tuple((s, -e) for s, e in m): 1 / q})


def _gathered(terms: Iterable[tuple[Monomial, Fraction]]) -> Laurent:
    total: dict[Monomial, Fraction] = {}
    for m, q in terms:
        total[m] = total.get(m, Fraction(0)) + q
    return Laurent(total)


def _product(m: Monomial, n: Monomial) -> Monomial:
    exponents = dict(m)
    for symbol, e in n:
        exponents[symbol] = exponents.get(symbol, 0) + e
    return tuple(sorted((s, e) for s, e in exponents.items() if e))
