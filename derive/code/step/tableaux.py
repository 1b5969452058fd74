"""Runge–Kutta methods, of Gauss's collocation and explicit, and symmetric compositions as data."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal, localcontext
from functools import cache, cached_property
from math import cos, factorial, pi
from typing import Any

import mpmath

from .verner import DIGITS, ONE, ZERO, verner

# Collocation at the Gauss nodes: the numbers of the method, and its stages apart.


@dataclass(frozen=True)
class Collocation:
    """The method of s Gauss nodes, of order 2s; vectors by the nodes, matrices by rows."""

    s: int = 8

    @cached_property
    def exact_nodes(self) -> list[Decimal]:
        """The nodes c_j, the least first, by Newton's method on P_s."""
        with localcontext() as context:
            context.prec = DIGITS
            return [self._node(j) for j in range(self.s)]

    def _node(self, j: int) -> Decimal:
        near = 0.5 - 0.5 * cos(pi * (j + 0.75) / (self.s + 0.5))
        x = 2 * Decimal(near) - 1
        for _ in range(8):
            p = legendre(self.s, x)
            slope = self.s * (p[self.s - 1] - x * p[self.s]) / (1 - x * x)
            x -= p[self.s] / slope
        return (1 + x) / 2

    @cached_property
    def exact_weights(self) -> list[Decimal]:
        """The weights b_j: 1/b_j = Σ_k (2k + 1) P_k(2c_j − 1)², as ℓ_j(c_j) = 1."""
        with localcontext() as context:
            context.prec = DIGITS
            return [
                1 / sum((q * q / (2 * k + 1) for k, q in enumerate(row)), Decimal(0))
                for row in self.series
            ]

    @cached_property
    def series(self) -> list[list[Decimal]]:
        """Row j: (2k + 1) P_k(2c_j − 1) for k < s, what ℓ_j/b_j is of the P_k."""
        with localcontext() as context:
            context.prec = DIGITS
            return [
                [(2 * k + 1) * p for k, p in enumerate(legendre(self.s - 1, 2 * c - 1))]
                for c in self.exact_nodes
            ]

    @cached_property
    def exact_mu(self) -> list[list[Decimal]]:
        """Row i: μ_ij = a_ij/b_j = Σ_k (2k + 1) P_k(2c_j − 1) ∫_0^c_i P_k."""
        with localcontext() as context:
            context.prec = DIGITS
            integrals = [integrated(self.s - 1, c) for c in self.exact_nodes]
            return [
                [
                    sum((q * v for q, v in zip(row, own, strict=True)), Decimal(0))
                    for row in self.series
                ]
                for own in integrals
            ]

    @property
    def c(self) -> list[float]:
        """The nodes, rounded."""
        return [float(x) for x in self.exact_nodes]

    @property
    def b(self) -> list[float]:
        """The weights, rounded."""
        return [float(x) for x in self.exact_weights]

    @property
    def mu(self) -> list[list[float]]:
        """μ_ij, rounded for i > j; the others are 1 − μ_ji, without rounding."""
        found = self.exact_mu
        lower = [[float(x) for x in row] for row in found]
        span = range(self.s)
        return [
            [lower[i][j] if i > j else 0.5 if i == j else 1 - lower[j][i] for j in span]
            for i in span
        ]

    @property
    def continued(self) -> list[float]:
        """1/(b_j Π_m (c_j − c_m)), m ≠ j: ℓ_j(θ)/b_j is that times Π_m (θ − c_m)."""
        with localcontext() as context:
            context.prec = DIGITS
            found = []
            for j, (c, b) in enumerate(zip(self.exact_nodes, self.exact_weights, strict=True)):
                product = b
                for m, other in enumerate(self.exact_nodes):
                    product *= c - other if m != j else 1
                found.append(float(1 / product))
            return found

    @property
    def dense(self) -> list[list[float]]:
        """Row k: (2k + 1) P_k(2c_j − 1), by which Σ_j F_j b_j gives the coefficients of the P_k."""
        return [[float(row[k]) for row in self.series] for k in range(self.s)]


def legendre(n: int, x: Decimal) -> list[Decimal]:
    """P_0(x) … P_n(x), by (k + 1) P_(k+1) = (2k + 1) x P_k − k P_(k−1)."""
    found = [Decimal(1), x]
    for k in range(1, n):
        found.append(((2 * k + 1) * x * found[k] - k * found[k - 1]) / (k + 1))
    return found[: n + 1]


def integrated(n: int, c: Decimal) -> list[Decimal]:
    """The integrals from 0 to c of P_k(2θ − 1), k ≤ n: (P_(k+1) − P_(k−1))/(2(2k + 1))."""
    p = legendre(n + 1, 2 * c - 1)
    return [c, *((p[k + 1] - p[k - 1]) / (2 * (2 * k + 1)) for k in range(1, n + 1))]


# The stages of a collocation apart: eigenvectors of its matrix, by which Newton's method finds
# them one by one.
#
# With J = ∂f/∂x where a step begins, Newton's method for L_i = h b_i f(x + Σ_j μ_ij L_j) takes
# away ΔL with (1 − h M ⊗ J) ΔL = L − h b f, M_ij = b_i μ_ij. With M = V Λ V⁻¹ this is
#
# (1 − h λ_k J) (V⁻¹ΔL)_k = (V⁻¹(L − h b f))_k,
#
# s systems of the size of the state, of which complex conjugates are one (Butcher, *BIT* 16,
# 1976).


@dataclass(frozen=True)
class StageModes:
    """λ_k, one of each conjugate pair; ``into``: rows of V⁻¹; ``back``: columns of V, twice, as the
    real part of their sum is that of all.  Numbers are pairs of a real and an imaginary part."""

    values: list[tuple[float, float]]
    into: list[list[tuple[float, float]]]
    back: list[list[tuple[float, float]]]

    @classmethod
    def of(cls, method: Collocation) -> StageModes:
        """Those of a method with an even number of stages, which has no real eigenvalue."""
        span = range(method.s)
        with mpmath.workdps(DIGITS):
            b = [mpmath.mpf(str(x)) for x in method.exact_weights]
            mu = [[mpmath.mpf(str(x)) for x in row] for row in method.exact_mu]
            values, V = mpmath.eig(mpmath.matrix([[b[i] * mu[i][j] for j in span] for i in span]))
            inverse = V**-1
            upper = sorted((k for k in span if values[k].imag > 0), key=lambda k: values[k].imag)
            into = [[V[0, k] * inverse[k, i] for i in span] for k in upper]
            back = [[2 * V[i, k] / V[0, k] for i in span] for k in upper]
            rows = (*into, *back, [values[k] for k in upper])
            pairs = [[(float(x.real), float(x.imag)) for x in row] for row in rows]
        half = len(upper)
        return cls(pairs[-1], pairs[:half], pairs[half:-1])


# Explicit methods.

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


# Symmetric compositions of a symmetric step of order 2, which raise its order.
#
# Steps γ_1 h, …, γ_s h one after the other, γ_i = γ_(s+1−i) and Σ γ_i = 1, are one of a higher
# order where Σ γ_i³ = 0, and so on. For order 4 these are Suzuki's five, for which there is a
# formula (M. Suzuki, Physics Letters A 146 (1990), 319–323); for 6 and 8 the nine and the
# seventeen of least size that W. Kahan and R.-C. Li found (*Composition constants for raising the
# orders of unconventional schemes for ordinary differential equations*, Mathematics of
# Computation 66 (1997), 1089–1099), to 26 decimals: digit by digit those of E. Hairer, C. Lubich
# and G. Wanner, *Geometric Numerical Integration*, V.3.2, (3.12) and (3.14), as OrdinaryDiffEq.jl
# (``KahanLi6``, ``KahanLi8``) and REBOUND's ``janus`` have them, too. A test holds them against
# every order condition.

FOUND = {
    6: (
        "0.39216144400731413927925056",
        "0.33259913678935943859974864",
        "-0.70624617255763935980996482",
        "0.08221359629355080023149045",
    ),
    8: (
        "0.13020248308889008087881763",
        "0.56116298177510838456196441",
        "-0.38947496264484728640807860",
        "0.15884190655515560089621075",
        "-0.39590389413323757733623154",
        "0.18453964097831570709183254",
        "0.25837438768632204729397911",
        "0.29501172360931029887096624",
    ),
}
"""Order → γ_1, γ_2, … before the one in the middle."""


def weights(order: int) -> list[Decimal]:
    """γ_1 … γ_s of the composition of an order, 2, 4, 6 or 8; their sum is 1."""
    with localcontext() as context:
        context.prec = DIGITS
        if order == 2:
            first: list[Decimal] = []
        elif order == 4:
            first = [1 / (4 - Decimal(4) ** (Decimal(1) / 3))] * 2
        else:
            first = [*map(Decimal, FOUND[order])]
        return [*first, 1 - 2 * sum(first, Decimal(0)), *reversed(first)]


# What the templates of explicit Runge–Kutta steps are filled with.

METHODS: dict[str, tuple[Callable[[], Tableau], str]] = {
    "rk4": (rk4, "Kutta's method of order 4"),
    "vern9": (vern9, "Verner's pair of orders 9 and 8"),
}
"""Name of a step → its method, and what it is called."""

GROWTH, SAFETY = 5.0, 0.9
"""By how much a step may grow, and the part taken of what its error suggests."""


def explicit(names: Iterable[str]) -> dict[str, Any] | None:
    """The explicit ones of these steps, and the most rows of any with those of dense output alone;
    has one such, ``extra``?  ``None`` without any."""
    found = {x: METHODS[x][0]() for x in names if x in METHODS}
    if not found:
        return None
    return {
        "methods": [{"name": x, "title": METHODS[x][1], "method": y} for x, y in found.items()],
        "rows": max(len(x.legendre) for x in found.values()),
        "extra": any(len(x.a) > x.stages for x in found.values()),
    }
