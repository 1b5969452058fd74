"""Unit quaternions, scalar first: r ↦ q r q̄ is the rotation A, and q̇ = ½ q ζ for Ȧ = A j(ζ)."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..language.rational import Matrix
from .graph import Graph, Node

Quaternion = tuple[Any, ...]


def multiplied(a: Quaternion, b: Quaternion) -> Quaternion:
    """Hamilton's product a b, in any ring."""
    p, x, y, z = a
    s, u, v, w = b
    return (
        p * s - x * u - y * v - z * w,
        p * u + s * x + y * w - z * v,
        p * v + s * y + z * u - x * w,
        p * w + s * z + x * v - y * u,
    )


def conjugate(a: Quaternion) -> Quaternion:
    """The conjugate (p, −x, −y, −z) of (p, x, y, z)."""
    p, x, y, z = a
    return (p, -x, -y, -z)


def matrix_of(g: Graph, q: tuple[Node, ...]) -> Matrix:
    """The rotation A of a unit quaternion q, A e = q e q̄, 3 × 3, entries named; q q̄ = 1 takes the
    square of the scalar out of the diagonal."""
    p, x, y, z = q
    unit = multiplied((p, x, y, z), conjugate((p, x, y, z)))[0]
    zero = g.num(0)
    columns = []
    for k in range(3):
        e = tuple(g.num(int(i == k)) for i in range(3))
        image = multiplied(multiplied((p, x, y, z), (zero, *e)), conjugate((p, x, y, z)))[1:]
        column = list(image)
        column[k] = column[k] - unit + 1
        columns.append(column)
    span = range(3)
    return tuple(tuple(g.value(columns[j][i], f"A_{i + 1}{j + 1}") for j in span) for i in span)


def halves(column: Matrix) -> list[Node]:
    """The entries of ½ ζ, for a column ζ."""
    return [x * Fraction(1, 2) for (x,) in column]
