"""U = ½ k (n − Σ ⟨R e_j, A e_j⟩), A e_j an axis of the body in space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.model import Model
from ..trials.momenta import axial
from ..trials.point_masses import AppliedForces, Vector
from ..values.arithmetic import ETA, Nilpotent, nilpotent

KIND, OF_BODY_AXES = "torsion", True
Data = Mapping[str, Any]


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """By the cosines of the axes with where they rest."""
    del masses
    _, axes = at.body_axes(r)
    cosines = [q.dot(x, y) for x, y in zip(axes, _rest(at, p), strict=True)]
    return at.number(p["stiffness"]) * (len(axes) - sum(cosines, Fraction(0))) * Fraction(1, 2)


def _rest(at: AppliedForces, p: Data) -> list[Vector]:
    """Where the axes rest, the columns of R."""
    rows = tuple(at.vector(row) for row in p["rest"]) or q.identity(at.env.size)
    return [*q.transposed(rows)]


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """k_A; N_A by its work, for any matrix ξ; its vector."""
    at, n = model.applied, model.n
    A = model.group.linear_part(model.g)

    def work(i: int, j: int) -> Any:
        """−dU where the axis e_j moves towards A e_i."""
        eta = nilpotent(ETA)
        moved = q.transposed(q.plus(A, q.times(A, q.scaled(eta, q.unit(n, i, j)))))
        places = [(Fraction(0),) * n, *moved]
        total = sum((energy(at, p, places, ()) for p in members), Fraction(0))
        return -Nilpotent.of(total).part(ETA)

    N = tuple(tuple(work(i, j) for j in range(n)) for i in range(n))
    found = {"k_A": sum((at.number(p["stiffness"]) for p in members), Fraction(0)), "N_A": N}
    if n == 3:
        found["μ_A"] = axial(q.minus(N, q.transposed(N)))
    return found
