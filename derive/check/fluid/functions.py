"""Functions on a space as sums of coefficients times monomials, whose products add exponents.

On a torus a monomial is e^{ik·x}, k a sum of frequencies with the exponents, in a ball it is a
product of powers of the coordinates.  The last exponent is that of s, a letter with s³ = 0, for
densities 1 + sθ.  Numbers are constant functions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from operator import add, mul
from typing import Any

from ..arithmetic import EvaluationError
from ..grades import Graded, _degree_of_product, _degree_of_sum
from ..nilpotent import Nilpotent
from ..residue import Residue, _residue
from .edges import Edges

Exponents = tuple[int, ...]
Combine = Callable[[Any, Any], Any]
ORDERS = 3
"""Densities are series in s up to this power, which is enough: a term has at most one factor ρ or
ρ⁻¹, and another by the mass of the points.  Where the motion is put in, −∇_u u − ρ⁻¹ grad p for u̇,
and ρ⁻¹ stands before grad p alone, ρ times a claim is A(ρ) ∇_u u + B(ρ) grad p = 0, A and B of
degree 2; its orders 1, s and s² say in turn that their coefficients vanish, as ∇_u u and grad p
have no relation at s = 0."""


class Function:
    """A function on a space: exponents → coefficients, in any ring."""

    __slots__ = ("space", "terms")

    def __init__(self, space: Any, terms: Mapping[Exponents, Any]):
        self.space, self.terms = space, terms

    def constant(self, x: Any) -> Function:
        """A number as a function on the same space."""
        return Function(self.space, {(0,) * self.space.length: x})

    @property
    def is_constant(self) -> bool:
        """Is it a number, as far as its exponents tell?"""
        return not any(any(m[:-1]) or isinstance(x, Edges) for m, x in self.terms.items())

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Function):
            if other == 0:
                return self
            other = self.constant(other)
        here = self._same(other)
        total = dict(self.terms)
        for m, x in other.terms.items():
            total[m] = total[m] + x if m in total else x
        return Function(here, total)

    __radd__ = __add__

    def __neg__(self) -> Function:
        return Function(self.space, {m: -x for m, x in self.terms.items()})

    def __sub__(self, other: Any) -> Any:
        return self + (-other)

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Function):
            return Function(self.space, {m: x * other for m, x in self.terms.items()})
        return Function(self._same(other), _product(self.terms, other.terms))

    __rmul__ = __mul__

    def _same(self, other: Function) -> Any:
        """The common space; that of the other where one is a number."""
        if self.space is other.space or other.is_constant:
            return self.space
        if self.is_constant:
            return other.space
        raise EvaluationError("a function over the points and one in space are not combined")

    def d(self, j: int) -> Function:
        """∂/∂x_j."""
        found: Function = self.space.derivative(self, j)
        return found

    def mean(self) -> Function:
        """The mean over the space, a number."""
        found: Function = self.space.mean(self)
        return found

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Function):
            return bool(other == 0) and not any(x != 0 for x in self.terms.values())
        try:
            left = self - other
        except EvaluationError:
            return False
        return bool(left == 0)

    __hash__ = None  # type: ignore[assignment]


def _product(a: Mapping[Exponents, Any], b: Mapping[Exponents, Any]) -> dict[Exponents, Any]:
    """The terms of a product, residues reduced once and degrees without their numbers."""
    kinds = {type(x) for terms in (a, b) for x in terms.values()}
    if Residue in kinds and kinds <= {Residue, Fraction}:
        p = next(x.p for terms in (a, b) for x in terms.values() if type(x) is Residue)
        left, right = ({m: _residue(x, p) for m, x in terms.items()} for terms in (a, b))
        found = _summed(left, right, mul, add)
        return {m: Residue(x, p) for m, x in found.items()}
    if kinds == {Graded}:
        first, other = ({m: x.degree for m, x in terms.items()} for terms in (a, b))
        found = _summed(first, other, _degree_of_product, _degree_of_sum)
        return {m: Graded(x) for m, x in found.items()}
    return _summed(a, b, mul, add)


def _summed(
    a: Mapping[Exponents, Any], b: Mapping[Exponents, Any], times: Combine, plus: Combine
) -> dict[Exponents, Any]:
    """The products of all terms, those of the same exponents together."""
    total: dict[int, Any] = {}
    right = [(_packed(k), k[-1], y) for k, y in b.items()]
    for m, x in a.items():
        first, most = _packed(m), ORDERS - m[-1]
        for second, order, y in right:
            if order < most:
                e, found = first + second, times(x, y)
                total[e] = plus(total[e], found) if e in total else found
    length = len(next(iter(a), ()))
    return {_unpacked(e, length): x for e, x in total.items()}


BITS = 16
"""Of an exponent where several are one number."""


@lru_cache(2**16)
def _packed(m: Exponents) -> int:
    """Exponents as one number, whose sums are those of the exponents."""
    return sum(n << BITS * i for i, n in enumerate(m))


@lru_cache(2**16)
def _unpacked(e: int, length: int) -> Exponents:
    """The exponents of which a number is made."""
    found = []
    for _ in range(length):
        n = (e + 2 ** (BITS - 1)) % 2**BITS - 2 ** (BITS - 1)
        found.append(n)
        e = (e - n) >> BITS
    return tuple(found)


Field = tuple[Any, ...]
"""A vector field by its components."""


def derivative(f: Any, j: int) -> Any:
    """∂/∂x_j of a function, or of each part of a nilpotent one."""
    if isinstance(f, Nilpotent):
        parts: dict[int, Any] = f.parts
        return Nilpotent({mask: x.d(j) for mask, x in parts.items()})
    return f.d(j)


def shifted(f: Any, by: Sequence[Any], powers: int = 2) -> Any:
    """f(x + φ(x)) by Taylor's formula, where the products of more than ``powers`` φ vanish."""
    total, weight = f, Fraction(1)
    terms: list[tuple[Any, Any]] = [(f, None)]
    for n in range(1, powers + 1):
        weight /= n
        terms = [
            (derivative(g, j), y if x is None else x * y)
            for g, x in terms
            for j, y in enumerate(by)
        ]
        for g, x in terms:
            total = total + g * x * weight
    return total


def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """Σ a_j b_j at each place."""
    first, *rest = (x * y for x, y in zip(a, b, strict=True))
    return sum(rest, first)


def divergence(field: Sequence[Any]) -> Any:
    """Σ ∂_j a_j."""
    found = [f.d(j) for j, f in enumerate(field)]
    return sum(found[1:], found[0])


def laplacian(f: Function) -> Any:
    """Δf: the divergence of its gradient."""
    return divergence([f.d(j) for j in range(f.space.dimension)])
