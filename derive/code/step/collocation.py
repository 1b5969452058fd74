"""Collocation at the Gauss nodes: the numbers of the method, from its definition.

On the interval 0 ≤ θ ≤ 1 of a step, c_j are the roots of the Legendre polynomial P_s(2θ − 1), ℓ_j
the polynomials of degree s − 1 with ℓ_j(c_i) = δ_ij.  The P_k are orthogonal, and the quadrature is
exact on products of two of degree < s, so that

    ℓ_j(θ) = b_j Σ_k (2k + 1) P_k(2c_j − 1) P_k(2θ − 1),    k < s,
    a_ij = ∫_0^c_i ℓ_j = b_j μ_ij,    μ_ij + μ_ji = 1.

The last is that quadratic invariants are kept; it holds for the doubles, too.  Every number is
found to ``DIGITS`` and then rounded once.
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal, localcontext
from functools import cached_property
from math import cos, pi

DIGITS = 60


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
