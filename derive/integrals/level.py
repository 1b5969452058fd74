"""Polynomials on the level C = 0 of a Casimir: normal forms modulo C.

The multiples of a Casimir are a Poisson ideal: {F, H} on the level is told by F on the level.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from .lie_poisson import Algebra, Exponents, Polynomial


class Level:
    """The polynomials modulo a Casimir over Z with leading coefficient 1 or −1."""

    def __init__(self, algebra: Algebra, casimir: Any):
        size = algebra.size
        terms = {m[:size]: int(c) for m, c in casimir.items()}
        self.casimir, self.lead = casimir, max(terms)
        self.sign = terms.pop(self.lead)
        self.rest = {e: -c * self.sign for e, c in terms.items()}
        self.normal = cache(self._normal)

    @staticmethod
    def possible(algebra: Algebra, casimir: Any) -> bool:
        """Is it without parameters, of leading coefficient 1 or −1, with a linear factor in that
        term, and can it vanish: has every term a momentum?  Casimirs of the entries of g alone
        have the values that the group gives them."""
        size, momenta = algebra.size, algebra.system.momenta
        return (
            not any(any(m[size:]) for m in casimir)
            and abs(casimir.LC) == 1
            and 1 in max(casimir)
            and all(any(m[:momenta]) for m in casimir)
        )

    def leads(self, e: Exponents) -> bool:
        """Is a monomial a multiple of the leading one?"""
        return all(x >= y for x, y in zip(e, self.lead, strict=True))

    def _normal(self, e: Exponents) -> dict[Exponents, int]:
        """The normal form of a monomial."""
        if not self.leads(e):
            return {e: 1}
        found: dict[Exponents, int] = {}
        left = tuple(x - y for x, y in zip(e, self.lead, strict=True))
        for m, c in self.rest.items():
            for k, x in self.normal(tuple(map(int.__add__, left, m))).items():
                found[k] = found.get(k, 0) + c * x
        return {k: x for k, x in found.items() if x}

    def quotient(self, f: Polynomial) -> Polynomial:
        """What the Casimir is multiplied by in a polynomial over the field that is a multiple."""
        left, found = {**f}, Polynomial()
        while left:
            e = max(left)
            c = left.pop(e)
            own = tuple(x - y for x, y in zip(e, self.lead, strict=True))
            found[own] = c * self.sign
            for m, y in self.rest.items():
                target = tuple(map(int.__add__, own, m))
                left[target] = left[target] + c * y if target in left else c * y
            left = {e: c for e, c in left.items() if c}
        return found

    def contains(self, f: Any) -> bool:
        """Is a polynomial of the ring a multiple of the Casimir?"""
        return bool(f.rem(self.casimir) == 0)
