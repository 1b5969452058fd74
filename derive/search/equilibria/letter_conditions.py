"""Inequalities in letters: products of irreducible polynomials that are positive together.

Of a product the sign alone counts: what is known to be positive is left out, and so is an even
power, whose base does not vanish then.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from typing import Any

from ...language.derivatives import power
from ...language.tree import Tree, mul
from ...language.univariate import root
from ..integrals.lie_poisson import PoissonPolynomials, plain

Element = Any
"""A function of the letters, of SymPy's field of fractions."""
Factors = frozenset[Any]
"""Irreducible polynomials in the letters, their leading coefficients positive."""


@dataclass(frozen=True)
class Case:
    """``products``: sign times product is positive; ``nonzero``: factors that do not vanish."""

    products: tuple[tuple[int, Factors], ...] = ()
    nonzero: Factors = frozenset()

    def with_positive(self, *functions: Element) -> Case | None:
        """The case with these positive, too; ``None`` where they cannot be."""
        found: Case | None = self
        for x in functions:
            found = found._with(x) if found else None
        return found

    def _with(self, x: Element) -> Case | None:
        if not x:
            return None
        sign, odd, every = _signed(x)
        nonzero = Case(self.products, self.nonzero | every)
        sign, odd = self._reduced(sign, frozenset(f for f in odd if not nonzero.shows(f)))
        if not odd:
            return nonzero if sign > 0 else None
        return Case((*self.products, (sign, odd)), nonzero.nonzero)

    def _reduced(self, sign: int, odd: Factors) -> tuple[int, Factors]:
        """A product times such as are positive, with as few factors as these make it."""

        def size(x: Factors) -> tuple[int, list[str]]:
            return len(x), sorted(map(str, x))

        while True:
            shorter = [x for x in self.products if size(odd ^ x[1]) < size(odd)]
            if not shorter:
                return sign, odd
            sign, odd = sign * shorter[0][0], odd ^ shorter[0][1]

    def settled(self) -> Case:
        """The same with each product reduced by the others."""
        products = [*self.products]
        for k, x in enumerate(products):
            products[k] = Case((*products[:k], *products[k + 1 :]))._reduced(*x)
        return Case((*(x for x in products if x[1]),), self.nonzero)

    def shows(self, f: Any) -> bool:
        """Is a polynomial positive, being a sum of even powers and of positive letters?"""
        positive = {_letter(y) for s, x in self.products if s > 0 and len(x) == 1 for y in x}
        there = {_letter(y) for y in self.nonzero}
        terms = [({n for n, k in enumerate(e) if k % 2}, {*_places(e)}, c) for e, c in f.items()]
        fair = all(c > 0 and odd <= positive for odd, _, c in terms)
        return fair and any(used <= there for _, used, _ in terms)

    def beyond(self, known: Case) -> tuple[tuple[int, Factors], ...]:
        """What is to be positive beyond what is known, squares of what is not to vanish last."""
        new = self.products[len(known.products) :]
        implied = known.nonzero.union(*(x for _, x in self.products))
        squares = (f for f in self.nonzero - implied if not known.shows(f))
        return (*new, *((0, frozenset([f])) for f in sorted(squares, key=str)))


def _signed(x: Element) -> tuple[int, Factors, Factors]:
    """The sign of the number in a function, its factors of odd powers, and all."""
    (c, above), (d, below) = x.numer.factor_list(), x.denom.factor_list()
    sign, odd, every = 1 if c * d > 0 else -1, set[Any](), set[Any]()
    for f, k in chain(above, below):
        alike = f if f.LC > 0 else -f
        sign *= 1 if f.LC > 0 or k % 2 == 0 else -1
        every.add(alike)
        odd ^= {alike} if k % 2 else set()
    return sign, frozenset(odd), frozenset(every)


def _places(e: Iterable[int]) -> Iterable[int]:
    return (n for n, k in enumerate(e) if k)


def _letter(f: Any) -> int:
    """The place of the letter that a polynomial is; −1 for none."""
    ((e, _), *more) = f.items()
    return e.index(1) if not more and sum(e) == 1 else -1


def square_root(x: Element) -> Element | None:
    """A function whose square a function is; ``None`` for none."""
    found = x.field.one
    for p, side in ((x.numer, 1), (x.denom, -1)):
        number, factors = p.factor_list()
        y = root(Fraction(plain(number))) if number > 0 else None
        if not isinstance(y, Fraction) or any(k % 2 for _, k in factors):
            return None
        found *= x.field(x.field.domain(y.numerator, y.denominator)) ** side
        for f, k in factors:
            found *= x.field(f) ** (side * k // 2)
    return found


def inequality(algebra: PoissonPolynomials, sign: int, factors: Factors) -> tuple[Tree, Tree]:
    """Two sides, the greater first: of one factor what is added and what is taken away, of several
    a product and 0; with a sign 0, that they do not vanish, by squares."""
    if len(factors) > 1 or not sign:
        trees = [algebra.letters_tree(f) for f in sorted(factors, key=str)]
        product = mul(*(trees if sign else (power(x, 2) for x in trees)))
        return (product, 0) if sign >= 0 else (0, product)
    (f,) = factors
    more, less = ({e: abs(c) for e, c in f.items() if (c > 0) is up} for up in (True, False))
    above, below = map(algebra.letters_tree, (more, less)[::sign])
    return above, below
