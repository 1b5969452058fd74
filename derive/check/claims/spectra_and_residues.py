"""What claims are computed with: eigenvalues of exact matrices, counted; values modulo a prime.

Roots of polynomials to many digits; values of trees with derivatives, and about an exact point to
second order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from random import Random
from typing import Any

from ...algebra.exact_kernel import ResidueVector, ResidueVectorSource
from ...language import rational as q
from ...language.tree import Tree, operands
from ...language.univariate import (
    Number,
    Quadratic,
    changes,
    common_divisor,
    exact_function,
    square_free,
    trimmed,
)
from ...language.values import arithmetic
from ..values.arithmetic import Varying, slopes_of, value_of
from ..values.evaluate import ElementaryValues
from ..values.residue import Residue

# Eigenvalues of exact matrices, counted: over Q, or numbers of one quadratic field.
#
# The characteristic polynomial is that of Hessenberg's form. Of a symmetric matrix all roots are
# real, so that Descartes' changes of sign count them. Of any polynomial the sums of powers of its
# roots, p_k = Σ μ^k, in Hermite's forms (p_{i+j}) and (p_{i+j+1}): the rank of the first is the
# number of distinct roots, and the second has no positive square where all roots are real and at
# most 0.

Matrix = Sequence[Sequence[Number]]


def characteristic(a: Matrix) -> list[Number]:
    """The coefficients of det(μ − a), from the highest power."""
    h = hessenberg(a)
    found: list[list[Number]] = [[Fraction(1)]]
    for m, _ in enumerate(h):
        # det(μ − h) of the first m + 1 rows, by the last column
        total = [*found[m], Fraction(0)]
        chain: Number = Fraction(1)
        for i in range(m, -1, -1):
            for k, x in enumerate(found[i]):
                total[k + 1 + m - i] -= chain * h[i][m] * x
            chain = chain * h[i][i - 1] if i else chain
        found.append(total)
    return found[-1]


def hessenberg(a: Matrix) -> list[list[Number]]:
    """A similar matrix with 0 below the diagonal beside the main one."""
    h, n = [[*row] for row in a], len(a)
    for m in range(1, n - 1):
        pivot = next((i for i in range(m, n) if h[i][m - 1]), None)
        if pivot is None:
            continue
        h[pivot], h[m] = h[m], h[pivot]
        for row in h:
            row[pivot], row[m] = row[m], row[pivot]
        for i in range(m + 1, n):
            if ratio := h[i][m - 1] / h[m][m - 1]:
                h[i] = [x - ratio * y for x, y in zip(h[i], h[m], strict=True)]
                for row in h:
                    row[m] += ratio * row[i]
    return h


def signature(a: Matrix) -> tuple[int, int]:
    """How many positive and how many negative squares a symmetric matrix has; ``ValueError`` for
    another one."""
    if any(a[i][j] != a[j][i] for i in range(len(a)) for j in range(i)):
        raise ValueError("a form that is not symmetric")
    c = characteristic(a)
    return changes(c), changes((-1) ** k * x for k, x in enumerate(c))


def powers(f: Sequence[Number], most: int) -> list[Number]:
    """The sums p_0 … of powers of the roots of a polynomial with the highest coefficient 1, given
    from there (Newton)."""
    d = len(f) - 1
    found: list[Number] = [Fraction(d)]
    for k in range(1, most + 1):
        own = -k * f[k] if k <= d else Fraction(0)
        found.append(own - sum((f[i] * found[k - i] for i in range(1, min(k, d + 1))), Fraction(0)))
    return found


def hermite(f: Sequence[Number], shift: int) -> Matrix:
    """The form (p_{i+j+shift}) of a polynomial."""
    d = len(f) - 1
    p = powers(f, 2 * d + shift)
    return [[p[i + j + shift] for j in range(d)] for i in range(d)]


def distinct_roots(f: Sequence[Number]) -> int:
    """How many roots a polynomial has, complex ones too."""
    return sum(signature(hermite(f, 0)))


def real_and_not_positive(f: Sequence[Number]) -> bool:
    """Are all roots real and at most 0?"""
    return not signature(hermite(f, 1))[0]


def grows(f: Sequence[Number]) -> bool:
    """Has a root a positive real part?

    Hermite's form of the coefficients of (f(x)f(y) − f(−x)f(−y))/(x + y) has a negative square for
    each such root, but for those whose opposites are roots: of these f(x) and f(−x) have the
    divisor xᵃq(x²), and q has real roots alone, none positive, where all are imaginary or 0.
    """
    opposite = [(-1) ** k * x for k, x in enumerate(f)]
    even = common_divisor(trimmed(f[::-1]), trimmed(opposite[::-1]))
    squares = [x / even[-1] for x in even[::-1]]
    while len(squares) > 1 and not squares[-1]:
        squares.pop()
    return not real_and_not_positive(squares[::2]) or signature(_hermite_hurwitz(f))[1] > 0


def _hermite_hurwitz(f: Sequence[Number]) -> Matrix:
    """The coefficients b_ij of xⁱyʲ, by (x + y) Σ b_ij xⁱyʲ."""
    c, d = f[::-1], len(f) - 1
    b: list[list[Number]] = [[Fraction(0)] * (d + 1) for _ in range(d)]
    for i in range(d):
        for j in range(d):
            whole = c[i] * c[j + 1] * (1 - (-1) ** (i + j + 1))
            b[i][j] = whole - (b[i - 1][j + 1] if i else 0)
    return [row[:d] for row in b]


def all_negative(f: Sequence[Number]) -> bool:
    """Have all roots negative real parts?  Hermite's form has a positive square for each such root
    then, and no others."""
    return signature(_hermite_hurwitz(f)) == (len(f) - 1, 0)


def negative_or_zero(f: Sequence[Number]) -> bool:
    """Is a root real and at most 0?"""
    (more, fewer), (positive, negative) = (signature(hermite(f, k)) for k in (0, 1))
    real_ones, difference = more - fewer, positive - negative
    return real_ones > difference  # so many are real, and so many more positive than negative


# Roots of a polynomial to many digits, and whether numbers are these, rounded.
#
# Weierstrass' method: from numbers z_k near all roots, z_k − f(z_k)/Π_{j≠k}(z_k − z_j). Where
# such steps are small beside the distances, one root is within d times the step of each number.

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


def digits_given(told: Sequence[Complex]) -> int:
    """To how many digits numbers are told."""
    return max(LEAST, *(len(x.normalize().as_tuple().digits) for pair in told for x in pair))


def are_roots_rounded(told: Sequence[Complex], squares: Sequence[Complex]) -> bool:
    """Are numbers, their parts not negative, the square roots of others, rounded all to as many
    digits as are told?"""
    digits, pairs = digits_given(told), zip(told, map(_root, squares), strict=True)
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


# Values of trees of rational functions modulo a prime: at points, and with their gradients.

Value = Any
"""A residue; one at each of some points; either with its derivatives."""
LARGEST_POWER = 64

BY_VARIABLES = (Varying, ResidueVector)
"""What values are that depend on variables, where a polynomial is evaluated."""

At = Mapping[Tree, Value]
"""The values of variables and parameters."""


def value(t: Tree, at: At, p: int, functions: Callable[[str, Value], Value] | None = None) -> Value:
    """The value of a tree modulo p; ``ValueError`` for what has none.

    Without ``functions`` of names and arguments it is to be a polynomial in the variables: nothing
    is divided by them.
    """
    return _value(t, at, lambda x: Residue(1, p) * x, functions)


def _value(
    t: Tree,
    at: At,
    number: Callable[[Fraction], Value],
    functions: Callable[[str, Value], Value] | None,
) -> Value:
    if isinstance(t, (int, Fraction)):
        return number(Fraction(t))
    if t in at:
        return at[t]
    heads = ("add", "mul", "div", "pow", *(() if functions is None else ("fun",)))
    if not isinstance(t, tuple) or t[0] not in heads:
        raise ValueError("no function of the variables and the parameters that has a value")
    if t[0] == "pow" and (not isinstance(t[2], int) or abs(t[2]) > LARGEST_POWER):
        raise ValueError(f"an exponent that is no integer up to {LARGEST_POWER}")
    parts = {x: _value(x, at, number, functions) for x in operands(t)}
    if functions and t[0] == "fun":
        return functions(t[1], parts[t[2]])
    divides = t[0] == "div" or (t[0] == "pow" and t[2] < 0)
    if functions is None and divides and isinstance([*parts.values()][-1], BY_VARIABLES):
        raise ValueError("a division by a variable")
    return arithmetic(t, parts.__getitem__)


def begins(t: Tree, *head: str) -> bool:
    """Is a tree one of this head, and of what comes first in it?"""
    return isinstance(t, tuple) and t[: len(head)] == head


def is_parameter(t: Tree) -> bool:
    """Is a tree a parameter, or π, which is drawn like one?"""
    return t == "π" or begins(t, "par")


def drawn(letters: Iterable[Tree], random: Random, p: int) -> dict[Tree, Residue]:
    """A random value of each, but for 0."""
    return {x: Residue(random.randrange(1, p), p) for x in letters}


def residues(rows: Sequence[Sequence[Any]], p: int) -> q.Matrix:
    """A matrix of rational numbers, or of residues, modulo p."""
    one = Residue(1, p)
    return tuple(tuple(one * x for x in row) for row in rows)


def gradient(x: Value, n: int) -> list[Value]:
    """The derivatives by n variables."""
    return [*map(value_of, slopes_of(x, n))]


# Elementary functions at random points modulo a prime, and their derivatives.
#
# Square roots are true ones, at points and for parameters that have them; the others are any
# numbers at each argument, on c² ± s² = 1.


class UnluckyError(ArithmeticError):
    """No true roots of numbers and parameters, or too few points with roots."""


class ResidueFunctions(ElementaryValues):
    """The functions at the points of a source; roots are true at those that are ``valid``, or any
    numbers without ``roots``."""

    def __init__(self, source: ResidueVectorSource, *, roots: bool):
        super().__init__(lambda: source.randint(1, source.p))
        self.p, self.valid = source.p, [True] * source.points
        self.true_root = self._root if roots else None
        self.roots: dict[Any, Any] = {}

    __call__ = ElementaryValues.value

    def key(self, x: Any) -> Any:
        """The number, or those at the points."""
        return x if isinstance(x, Residue) else (*x.values,)

    def drawn(self, x: Any) -> Any:
        """A random number for a number, or one for each point."""
        found = self.draw()
        return Residue(found.values[0], self.p) if isinstance(x, Residue) else found

    def _root(self, x: Any) -> Any:
        """√x, found once."""
        if (at := self.key(x)) not in self.roots:
            self.roots[at] = self._found_root(x)
        return self.roots[at]

    def _found_root(self, x: Any) -> Any:
        if isinstance(x, Residue):
            y = Residue(pow(x.n, (self.p + 1) // 4, self.p), self.p)
            if y * y != x:
                raise UnluckyError
            return y
        root = x.root()
        there = zip(self.valid, (root * root).values, x.values, strict=True)
        self.valid = [v and a == b for v, a, b in there]
        return root


# Functions about an exact point, up to the second order: the derivatives vary in turn.


def about(variables: Sequence[Tree], values: Sequence[Number]) -> dict[Tree, Varying]:
    """The variables themselves about a point."""
    units = q.identity(len(variables))
    pairs = zip(variables, values, units, strict=True)
    return {x: Varying(Varying(y, unit), unit) for x, y, unit in pairs}


def expansion(t: Tree, at: At) -> Value:
    """A tree about a point; ``ValueError`` for what has no value there."""
    return _value(t, at, Fraction, exact_function)


def value_there(x: Value) -> Number:
    """The value of an expansion at the point."""
    found: Number = value_of(value_of(x))
    return found


def second_derivatives(x: Value, n: int) -> q.Matrix:
    """Those of an expansion by n variables."""
    return tuple(tuple(slopes_of(y, n)) for y in slopes_of(x, n))
