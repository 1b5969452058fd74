"""Collocation at the Gauss nodes: the numbers of the method, and its stages apart."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal, localcontext
from functools import cached_property
from math import cos, pi
from typing import Any

import mpmath

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
            pairs = [[*map(_pair, row)] for row in (*into, *back, [values[k] for k in upper])]
        half = len(upper)
        return cls(pairs[-1], pairs[:half], pairs[half:-1])


def _pair(x: Any) -> tuple[float, float]:
    return float(x.real), float(x.imag)
