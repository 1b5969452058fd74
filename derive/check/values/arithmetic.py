"""Arithmetic of values: scalars of any ring, matrices of them, numbers with nilpotent parts, and
with their first derivatives by several others, over any ring: fractions, intervals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.limits import DEGREE
from ...language.rational import FieldElement, Matrix, dot

# Arithmetic of values: scalars of any ring, and matrices of them as tuples of rows.

Value = Any

SHOWN = 20
"""The most digits of an exponent that a message shows."""
LARGEST_POWER, LARGEST_MATRIX = DEGREE + 1, 12
"""The largest exponent: the derivative of 1/xⁿ has xⁿ⁺¹, and n is at most the degree of an
expression; and the most rows of a matrix that has a determinant, as of a group's elements."""


class EvaluationError(ValueError):
    """A tree that has no value: an unknown name, or shapes that do not fit."""


Shape = tuple[int, ...]


class Many:
    """A matrix for each of many points at once, with a product, a sum and multiples of its own."""

    @property
    def shape(self) -> Shape:
        """That of each."""
        raise NotImplementedError

    def transposed(self) -> Value:
        """The transpose of each."""
        raise NotImplementedError

    def traced(self) -> Value:
        """The trace of each."""
        raise NotImplementedError


def is_matrix(x: Value) -> bool:
    """Is the value a matrix?"""
    return isinstance(x, (tuple, Many))


def shape(x: Value) -> Shape:
    """(rows, columns) of a matrix; () of a number."""
    if isinstance(x, Many):
        return x.shape
    return (len(x), len(x[0]) if x else 0) if is_matrix(x) else ()


def describe_shapes(*shapes: Shape) -> str:
    """Shapes as words of a message: "a 3×1 matrix and a number"."""
    return " and ".join(f"a {s[0]}×{s[1]} matrix" if s else "a number" for s in shapes)


def number(x: Value) -> Value:
    """The value itself where it is a scalar; ``EvaluationError`` for a matrix."""
    if is_matrix(x):
        raise EvaluationError(f"{describe_shapes(shape(x))} in the place of a number")
    return x


def _require_square(x: Value, of: str) -> Value:
    if not is_matrix(x):
        raise EvaluationError(f"{of} of a number")
    if len({*shape(x)}) != 1:
        raise EvaluationError(f"{of} of a matrix that is not square")
    return x


def plus(a: Value, b: Value) -> Value:
    """a + b, of one shape."""
    if shape(a) != shape(b):
        raise EvaluationError(f"{describe_shapes(shape(a), shape(b))} do not add")
    return q.plus(a, b) if type(a) is type(b) is tuple else a + b


def times(a: Value, b: Value) -> Value:
    """Scalar or matrix product; a row times a column is a number."""
    if is_matrix(a) and is_matrix(b):
        (rows, inside), (lines, columns) = shape(a), shape(b)
        if inside != lines:
            raise EvaluationError(f"{describe_shapes(shape(a), shape(b))} have no product")
        if isinstance(a, Many) or isinstance(b, Many):
            return a @ b
        product = q.times(a, b)
        return product[0][0] if rows == columns == 1 < inside else product
    if isinstance(a, tuple):
        return q.scaled(b, a)
    return q.scaled(a, b) if isinstance(b, tuple) else a * b


def scalar(x: Value) -> Value:
    """The entry of a 1 × 1 matrix; any other value as it is."""
    return x[0][0] if shape(x) == (1, 1) else x


def transpose(x: Value) -> Value:
    """The transpose of a matrix."""
    if not is_matrix(x):
        raise EvaluationError("transpose of a number")
    return x.transposed() if isinstance(x, Many) else q.transposed(x)


def trace(x: Value) -> Value:
    """Tr x."""
    square = _require_square(x, "trace")
    return square.traced() if isinstance(square, Many) else q.trace(square)


def inner(a: Value, b: Value, metric: Value | None = None) -> Value:
    """⟨a, b⟩ with a metric: ā M b for vectors, Tr a M b̄ for matrices."""
    if not is_matrix(a) and not is_matrix(b):
        with_metric = " of a matrix" if is_matrix(metric) else ""
        raise EvaluationError(f"numbers have no inner product{with_metric}")
    if not (is_matrix(a) and is_matrix(b)):
        raise EvaluationError("inner product of a scalar and a matrix")
    if shape(a) != shape(b):
        raise EvaluationError(f"{describe_shapes(shape(a), shape(b))} have no inner product")
    if shape(a)[1] == 1:
        return scalar(times(transpose(a), b if metric is None else times(metric, b)))
    return trace(times(a if metric is None else times(a, metric), transpose(b)))


def _coordinates(a: Value) -> Any:
    if shape(a) != (3, 1):
        raise EvaluationError(f"{describe_shapes(shape(a))} in the place of a vector of space")
    return (x for (x,) in a)


def wedge(a: Value, b: Value) -> Value:
    """The vector product a ∧ b of two vectors of R³ (3 × 1 matrices); of two of R² a number."""
    if shape(a) == shape(b) == (2, 1):
        return a[0][0] * b[1][0] - a[1][0] * b[0][0]
    (x, y, z), (u, v, w) = _coordinates(a), _coordinates(b)
    return ((y * w - z * v,), (z * u - x * w,), (x * v - y * u,))


def hat(a: Value) -> Value:
    """The skew matrix j(a) of a vector of R³, j(a)b = a ∧ b."""
    x, y, z = _coordinates(a)
    zero = x * 0
    return ((zero, -z, y), (z, zero, -x), (-y, x, zero))


def reciprocal(x: Value) -> Value:
    """1/x of a scalar; ``EvaluationError`` for a matrix."""
    return 1 / number(x)


def inverse(x: Value) -> Value:
    """x⁻¹ of a scalar or a square matrix; ``EvaluationError`` where the matrix is singular."""
    if not is_matrix(x):
        return 1 / x
    result = q.inverse(_require_square(x, "inverse"))
    if result is None:
        raise EvaluationError("inverse of a singular matrix")
    return result


def determinant(x: Value) -> Value:
    """det x in any commutative ring: without a quotient (R. S. Bird, *Information Processing
    Letters* 111 (2011) 1072)."""
    if not is_matrix(x) or any(len(row) != len(x) for row in x) or len(x) > LARGEST_MATRIX:
        raise EvaluationError(f"determinant of a square matrix of size up to {LARGEST_MATRIX} only")
    n, found = len(x), x
    for _ in range(n - 1):
        below = [-sum((found[j][j] for j in range(i + 1, n)), Fraction(0)) for i in range(n)]
        upper = ((*[Fraction(0)] * i, below[i], *row[i + 1 :]) for i, row in enumerate(found))
        found = times(tuple(upper), x)
    return found[0][0] if n % 2 else -found[0][0]


def power(x: Value, n: Value) -> Value:
    """xⁿ, for an integer n ≠ 0 of at most ±LARGEST_POWER; ``EvaluationError`` for other n."""
    if not isinstance(n, Fraction):
        raise EvaluationError("an exponent that is no number")
    if n.denominator != 1 or n == 0:
        raise EvaluationError(f"an exponent of {str(n)[:SHOWN]}, where a whole number but 0 is due")
    if abs(n) > LARGEST_POWER:
        size = f"{n}" if abs(n) < 10**SHOWN else "more digits than are shown"
        raise EvaluationError(f"an exponent of {size}: at most ±{LARGEST_POWER} is tried")
    base = inverse(x) if n < 0 else x
    result = base
    for _ in range(abs(int(n)) - 1):
        result = times(result, base)
    return result


# Numbers with nilpotent parts ε, ε′, η (each squares to zero): exact first and mixed derivatives.
#
# A number is a map  subset of {ε, ε′, η} → fraction,  the subset as a bit mask.

EPS, EPS_PRIME, ETA = 1, 2, 4


class Nilpotent(FieldElement):
    """Element of Q[ε, ε′, η] / (ε², ε′², η²)."""

    __slots__ = ("parts",)

    def __init__(self, parts: dict[int, Fraction]):
        self.parts = parts

    @staticmethod
    def of(x: Any) -> Nilpotent:
        """The number x as a nilpotent one without nilpotent parts."""
        return (
            x
            if isinstance(x, Nilpotent)
            else Nilpotent({0: Fraction(x) if isinstance(x, int) else x})
        )

    def part(self, mask: int) -> Fraction:
        """The coefficient of the product of nilpotents that a mask stands for."""
        return self.parts.get(mask, Fraction(0))

    @staticmethod
    def dot(a: Iterable[Any], b: Iterable[Any]) -> Nilpotent:
        """Σ a_i b_i, each part of it summed at once."""
        factors: dict[int, tuple[list[Any], list[Any]]] = {}
        for x, y in zip(a, b, strict=True):
            left = x.parts if isinstance(x, Nilpotent) else {0: x}
            right = y.parts if isinstance(y, Nilpotent) else {0: y}
            for m, u in left.items():
                for k, v in right.items():
                    if not m & k:
                        us, vs = factors.setdefault(m | k, ([], []))
                        us.append(u)
                        vs.append(v)
        return Nilpotent({mask: dot(us, vs) for mask, (us, vs) in factors.items()})

    @staticmethod
    def product(rows: Sequence[Sequence[Any]], columns: Sequence[Sequence[Any]]) -> Matrix:
        """Each row times each column: products of the matrices of their parts."""
        found: dict[int, Matrix] = {}
        left, right = _matrices_of_parts(rows), _matrices_of_parts(columns)
        for m, a in left.items():
            for k, b in right.items():
                if not m & k:
                    product, mask = q.times(a, q.transposed(b)), m | k
                    found[mask] = q.plus(found[mask], product) if mask in found else product
        span = range(len(columns))
        return tuple(
            tuple(Nilpotent({mask: x[i][j] for mask, x in found.items()}) for j in span)
            for i in range(len(rows))
        )

    def __add__(self, other: Any) -> Nilpotent:
        if not isinstance(other, Nilpotent):
            if other == 0:
                return self
            other = Nilpotent.of(other)
        parts = dict(self.parts)
        for mask, x in other.parts.items():
            parts[mask] = parts[mask] + x if mask in parts else x
        return Nilpotent(parts)

    def __mul__(self, other: Any) -> Nilpotent:
        if not isinstance(other, Nilpotent):
            return Nilpotent({mask: x * other for mask, x in self.parts.items()})
        parts: dict[int, Fraction] = {}
        for a, x in self.parts.items():
            for b, y in other.parts.items():
                if not a & b:
                    product, mask = x * y, a | b
                    parts[mask] = parts[mask] + product if mask in parts else product
        return Nilpotent(parts)

    @property
    def inverse(self) -> Nilpotent:
        """1/x by the geometric series, which ends."""
        base = self.part(0)
        small = Nilpotent({k: -v / base for k, v in self.parts.items() if k})
        result = power = Nilpotent({0: 1 / base})
        for _ in range(3):
            power = power * small
            result = result + power
        return result


def _matrices_of_parts(rows: Sequence[Sequence[Any]]) -> dict[int, Matrix]:
    """Mask → the matrix of the coefficients of its product of nilpotents, 0 where it is none."""
    entries = [[x.parts if isinstance(x, Nilpotent) else {0: x} for x in row] for row in rows]
    masks = dict.fromkeys(mask for row in entries for parts in row for mask in parts)
    return {m: tuple(tuple(x.get(m, q.ZERO) for x in row) for row in entries) for m in masks}


def part(x: Any, mask: int) -> Any:
    """The coefficient of ``mask`` in a scalar or, entry by entry, in a matrix."""
    if isinstance(x, tuple):
        return tuple(tuple(part(y, mask) for y in row) for row in x)
    return x.part(mask) if isinstance(x, Nilpotent) else (x if mask == 0 else Fraction(0))


def nilpotent(mask: int) -> Nilpotent:
    """ε, ε′ or η itself."""
    return Nilpotent({mask: Fraction(1)})


def derivative_in(x: Any, mask: int) -> Any:
    """∂x/∂ε for ε the parameter of ``mask``, at ε = 0, as a function of the other parameters."""
    return Nilpotent({k ^ mask: v for k, v in Nilpotent.of(x).parts.items() if k & mask})


def derivative_of(x: Matrix, mask: int) -> Matrix:
    """The same derivative of a matrix, entry by entry."""
    return tuple(tuple(derivative_in(y, mask) for y in row) for row in x)


class Varying(FieldElement):
    """A number ``value`` whose derivatives are ``slopes``, 0 for what it does not depend on."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: Any, slopes: Sequence[Any]):
        self.value, self.slopes = value, tuple(slopes)

    def _with(self, value: Any, slope: Callable[[Any], Any]) -> Varying:
        return Varying(value, [slope(x) if x else 0 for x in self.slopes])

    def chained(self, value: Any, derivative: Any) -> Varying:
        """A function of the number, by its value and its derivative there."""
        return self._with(value, lambda x: derivative * x)

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Varying):
            return Varying(self.value + other, self.slopes)
        pairs = zip(self.slopes, other.slopes, strict=True)
        return Varying(self.value + other.value, [x + y for x, y in pairs])

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Varying):
            return self._with(self.value * other, lambda x: x * other)
        pairs = zip(self.slopes, other.slopes, strict=True)
        a, b = self.value, other.value
        slopes = [(x * b if x else 0) + (a * y if y else 0) for x, y in pairs]
        return Varying(a * b, slopes)  # where other is self, a square

    @property
    def inverse(self) -> Varying:
        """1 over the number."""
        value = 1 / self.value
        return self._with(value, lambda x: -(value * value) * x)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Varying):
            return not self + -other
        return bool(self.value == other) and not any(self.slopes)

    def __bool__(self) -> bool:
        return bool(self.value) or any(map(bool, self.slopes))

    def __hash__(self) -> int:
        return hash((self.value, self.slopes))


def value_of(x: Any) -> Any:
    """The value of a number, which may vary."""
    return x.value if isinstance(x, Varying) else x


def slopes_of(x: Any, count: int) -> Sequence[Any]:
    """Its derivatives by so many others."""
    return x.slopes if isinstance(x, Varying) else (0,) * count
