"""Explicit Runge–Kutta methods as data, in ``DIGITS`` digits.

With rates f_i = f(t + c_i h, x + h Σ_j a_ij f_j), j < i, of the first ``stages`` rows, a step is
x + h Σ_i b_i f_i, its error by the embedded weights h Σ_i (b_i − b̂_i) f_i, and the state at
t + θh, 0 ≤ θ ≤ 1, is x + h Σ_i b_i(θ) f_i with the polynomials b_i(θ) = Σ_k d_ik θ^k, k ≥ 1, over
all rows: those after ``stages`` are computed where somebody asks for it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal, localcontext
from functools import cache
from math import factorial

from .collocation import DIGITS
from .verner import ONE, ZERO, verner

Rows = tuple[tuple[Decimal, ...], ...]


@dataclass(frozen=True)
class Tableau:
    """A method: c (rows), a by rows of the numbers before the diagonal, b and b̂ (``stages``; b̂
    empty without an embedded method), d (rows × degree); its order, that of b̂, and of b(θ)."""

    stages: int
    c: tuple[Decimal, ...]
    a: Rows
    b: tuple[Decimal, ...]
    embedded: tuple[Decimal, ...]
    dense: Rows
    order: int
    embedded_order: int
    dense_order: int

    @property
    def error(self) -> tuple[Decimal, ...]:
        """The weights b − b̂ of the error."""
        with localcontext() as context:
            context.prec = DIGITS
            return tuple(x - y for x, y in zip(self.b, self.embedded, strict=True))

    @property
    def legendre(self) -> Rows:
        """b_i(θ)/θ by rows in Legendre's polynomials P_n(2θ − 1), of which the numbers are small:
        (2n + 1) Σ_k d_ik ∫_0^1 θ^k P_n(2θ − 1) dθ, an integral k!²/((k − n)! (k + n + 1)!)."""
        degrees = range(len(self.dense[0]))
        with localcontext() as context:
            context.prec = DIGITS + 15
            projected = [
                [
                    Decimal((2 * n + 1) * factorial(k) ** 2)
                    / (factorial(k - n) * factorial(k + n + 1))
                    for k in degrees[n:]
                ]
                for n in degrees
            ]
            return tuple(
                tuple(
                    sum((x * d for x, d in zip(part, row[n:], strict=True)), ZERO)
                    for n, part in enumerate(projected)
                )
                for row in self.dense
            )


@cache
def rk4() -> Tableau:
    """Kutta's method of order 4, with its polynomial of order 3 (Hairer, Nørsett and Wanner,
    *Solving Ordinary Differential Equations I*, II.6)."""
    with localcontext() as context:
        context.prec = DIGITS
        half, third, sixth, ends = ONE / 2, ONE / 3, ONE / 6, ONE * 2 / 3
        middle = (ZERO, ONE, -ends)
    return Tableau(
        stages=4,
        c=(ZERO, half, half, ONE),
        a=((), (half,), (ZERO, half), (ZERO, ZERO, ONE)),
        b=(sixth, third, third, sixth),
        embedded=(),
        dense=((ONE, -3 * half, ends), middle, middle, (ZERO, -half, ends)),
        order=4,
        embedded_order=0,
        dense_order=3,
    )


@cache
def vern9() -> Tableau:
    """Verner's pair of orders 9 and 8 with its polynomial of order 8: :mod:`.verner`."""
    found = verner()
    rows = range(1, max(found.a) + 1)
    stages = max(found.b | found.embedded)
    return Tableau(
        stages=stages,
        c=tuple(found.c[i] for i in rows),
        a=tuple(_listed(found.a[i], i - 1) for i in rows),
        b=_listed(found.b, stages),
        embedded=_listed(found.embedded, stages),
        dense=tuple(tuple(row.get(i, ZERO) for row in found.dense) for i in rows),
        order=9,
        embedded_order=8,
        dense_order=8,
    )


def _listed(row: Mapping[int, Decimal], n: int) -> tuple[Decimal, ...]:
    """The numbers 1 … n of a row, 0 where it has none."""
    return tuple(row.get(j, ZERO) for j in range(1, n + 1))
