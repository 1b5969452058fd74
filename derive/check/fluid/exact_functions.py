"""Functions on a space as sums of monomials; sums and products of fields."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from operator import add, mul
from typing import Any

from ...language.rational import RingElement
from ..values.arithmetic import EvaluationError, Nilpotent
from ..values.residue import Graded, Residue, _degree_of_product, _degree_of_sum, _residue

# Functions on a space as sums of coefficients times monomials, whose products add exponents.
#
# On a torus a monomial is e^{ik·x}, k a sum of frequencies with the exponents, in a ball it is a
# product of powers of the coordinates. The last exponent is that of s, a letter with s³ = 0, for
# densities 1 + sθ. Numbers are constant functions.

Exponents = tuple[int, ...]
Combine = Callable[[Any, Any], Any]
ORDERS = 3
"""Densities are series in s up to this power, which is enough: a term has at most one factor ρ or
ρ⁻¹, and another by the mass of the points.  Where the motion is put in, −∇_u u − ρ⁻¹ grad p for u̇,
and ρ⁻¹ stands before grad p alone, ρ times a claim is A(ρ) ∇_u u + B(ρ) grad p = 0, A and B of
degree 2; its orders 1, s and s² say in turn that their coefficients vanish, as ∇_u u and grad p
have no relation at s = 0."""


class Function(RingElement):
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

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Function):
            return Function(self.space, {m: x * other for m, x in self.terms.items()})
        return Function(self._same(other), _product(self.terms, other.terms))

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


# Operators on fields, and what is told of a field by its scalar products alone.
#
# The transpose of an operator is known by ⟨X̄a, b⟩ = ⟨a, Xb⟩, for fields b tangent to the
# boundary.

Apply = Callable[[Any], Any]
Factor = tuple[Apply, bool]
"""What an operator does, and whether it is transposed."""


@dataclass(frozen=True)
class Operator:
    """A sum of numbers times products of factors; ``on_curve``: of what is along the curve."""

    terms: tuple[tuple[Any, tuple[Factor, ...]], ...]
    on_curve: bool = False

    @staticmethod
    def of(apply: Apply, *, on_curve: bool = False) -> Operator:
        """A single operator."""
        return Operator(((1, ((apply, False),)),), on_curve)

    @property
    def transposed(self) -> Operator:
        """The transpose."""
        turned = ((c, tuple((f, not t) for f, t in reversed(w))) for c, w in self.terms)
        return Operator(tuple(turned), self.on_curve)

    def __add__(self, other: Operator) -> Operator:
        return Operator(self.terms + other.terms, self.on_curve)

    def scaled(self, x: Any) -> Operator:
        """A number times the operator."""
        return Operator(tuple((c * x, w) for c, w in self.terms), self.on_curve)

    def then(self, other: Operator) -> Operator:
        """The product, ``other`` first."""
        both = ((a * b, v + w) for a, v in self.terms for b, w in other.terms)
        return Operator(tuple(both), other.on_curve)


@dataclass(frozen=True)
class Told:
    """A field by its scalar products: a sum of numbers times transposed operators on fields."""

    terms: tuple[tuple[Any, tuple[Factor, ...], Any], ...]

    def __add__(self, other: Told) -> Told:
        return Told(self.terms + other.terms)

    def scaled(self, x: Any) -> Told:
        """A number times the field."""
        return Told(tuple((c * x, w, a) for c, w, a in self.terms))

    def paired(self, b: Any, product: Callable[[Any, Any], Any]) -> Any:
        """⟨this, b⟩, by the ``product`` of fields or of functions."""
        total: Any = 0
        for c, word, a in self.terms:
            moved = b
            for apply, transposed in word:
                if not transposed:
                    raise EvaluationError("an operator stands before a transposed one")
                moved = apply(moved)
            total = product(a, moved) * c + total
        return total


def applied(x: Operator, a: Any, added: Callable[[Any, Any], Any], times: Any) -> Any:
    """The field or function X a; told by scalar products where a transposed operator is left."""
    total: Any = None
    for c, word in x.terms:
        moved, left = a, [*word]
        while left and not left[-1][1]:
            moved = left.pop()[0](moved)
        found = Told(((c, tuple(left), moved),)) if left else times(c, moved)
        total = found if total is None else added(total, found)
    return total


# Sums and products of what has a value at the points of a fluid: numbers, functions, fields,
# matrices at each place, operators.

Value = Any


@dataclass(frozen=True)
class MatrixField:
    """A matrix at each place."""

    rows: tuple[tuple[Function, ...], ...]


@dataclass(frozen=True)
class Normal:
    """The unit normal of the boundary."""


@dataclass(frozen=True)
class Slope:
    """The gradient of the density, whose products with fields are those at each place."""

    field: Field


@dataclass(frozen=True)
class OnBoundary:
    """A function on the boundary."""

    f: Function


def times(a: Value, b: Value) -> Value:
    """The product of two values, an operator applied to what follows it."""
    if isinstance(a, Operator):
        if isinstance(b, Operator):
            return a.then(b)
        if isinstance(b, Told):
            raise EvaluationError("an operator before a transposed one")
        if not isinstance(b, (tuple, Function)):
            raise EvaluationError("an operator is of fields")
        return applied(a, b, plus, times)
    if isinstance(a, int):
        a = Fraction(a)
    if isinstance(a, (Fraction, Function)):
        if isinstance(a, Function) and not a.is_constant:
            raise EvaluationError("a function is no factor")
        if isinstance(b, tuple):
            return tuple(x * a for x in b)
        if isinstance(b, (Operator, Told)):
            return b.scaled(a)
        if isinstance(b, Function):
            return b * a
        if isinstance(b, OnBoundary):
            return OnBoundary(b.f * a)
        if isinstance(b, MatrixField):
            return MatrixField(tuple(tuple(x * a for x in row) for row in b.rows))
    if isinstance(a, MatrixField) and isinstance(b, MatrixField):
        return matrix_product(a, b)
    if isinstance(b, Function) and b.is_constant and not isinstance(a, Function):
        return times(b, a)
    raise EvaluationError("these are not multiplied")


def plus(a: Value, b: Value) -> Value:
    """a + b, of one kind; 0 is of each."""
    for x, y in ((a, b), (b, a)):
        if isinstance(x, Function) and x == 0 and not isinstance(y, Function):
            return y
    if type(a) is not type(b):
        raise EvaluationError("a sum of things of two kinds")
    if isinstance(a, tuple):
        return tuple(x + y for x, y in zip(a, b, strict=True))
    if isinstance(a, OnBoundary):
        return OnBoundary(a.f + b.f)
    if isinstance(a, MatrixField):
        rows = zip(a.rows, b.rows, strict=True)
        return MatrixField(tuple(tuple(map(add, x, y)) for x, y in rows))
    return a + b


def power(x: Value, n: Any) -> Value:
    """xⁿ, which is the square of a matrix."""
    if not isinstance(x, MatrixField) or n != 2:
        raise EvaluationError("a power is the square of a matrix")
    return matrix_product(x, x)


def matrix_product(a: MatrixField, b: MatrixField) -> MatrixField:
    """At each place."""
    columns = [*zip(*b.rows, strict=True)]
    return MatrixField(tuple(tuple(dot(row, c) for c in columns) for row in a.rows))


def trace(x: Value) -> Function:
    """Of a matrix, at each place."""
    if not isinstance(x, MatrixField):
        raise EvaluationError("the trace is of a matrix")
    found = [row[j] for j, row in enumerate(x.rows)]
    return sum(found[1:], found[0])


def componentwise(change: Callable[[Any], Any], *, on_curve: bool = False) -> Operator:
    """What changes functions, as an operator on functions and fields."""
    return Operator.of(
        lambda c: change(c) if isinstance(c, Function) else tuple(map(change, field_of(c))),
        on_curve=on_curve,
    )


def field_of(x: Value) -> Field:
    """It, if it is a field; else ``EvaluationError``."""
    if not isinstance(x, tuple):
        raise EvaluationError("a field is expected")
    return x


# Numbers of which a polygon has one for each of its edges.


class Edges(RingElement):
    """One number for each edge, added and multiplied edge by edge; a plain number is the same on
    all."""

    __slots__ = ("each",)

    def __init__(self, each: tuple[Any, ...]):
        self.each = each

    def _with(self, other: Any, operation: Callable[[Any, Any], Any]) -> Edges:
        others = other.each if isinstance(other, Edges) else [other] * len(self.each)
        return Edges(tuple(map(operation, self.each, others)))

    def __add__(self, other: Any) -> Edges:
        return self._with(other, add)

    def __mul__(self, other: Any) -> Edges:
        return self._with(other, mul)

    def __eq__(self, other: object) -> bool:
        return all(self._with(other, lambda x, y: x == y).each)

    __hash__ = None  # type: ignore[assignment]
