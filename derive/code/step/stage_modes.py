"""The stages of a collocation apart: eigenvectors of its matrix, by which Newton's method finds
them one by one.

With J = ∂f/∂x where a step begins, Newton's method for L_i = h b_i f(x + Σ_j μ_ij L_j) takes away
ΔL with (1 − h M ⊗ J) ΔL = L − h b f, M_ij = b_i μ_ij.  With M = V Λ V⁻¹ this is

    (1 − h λ_k J) (V⁻¹ΔL)_k = (V⁻¹(L − h b f))_k,

s systems of the size of the state, of which complex conjugates are one (Butcher, *BIT* 16, 1976).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mpmath

from .collocation import DIGITS, Collocation


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
