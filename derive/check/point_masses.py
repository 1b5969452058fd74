"""The body of a model: point masses that a matrix moves, their moments and their metric."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .draws import Draws
from .kinds import uses_body_axes
from .points import points_of, principal_points

Vector = tuple[Any, ...]


def outer_sum(vectors: Sequence[Vector], arms: Sequence[Vector]) -> Matrix:
    """Σ v_i x̄_i, n × k, over vectors of n numbers and arms of k, one of each for every point."""
    return q.times(q.transposed(tuple(vectors)), tuple(arms))


def scaled_each(weights: Iterable[Any], vectors: Iterable[Vector]) -> list[Vector]:
    """The vectors m_i v_i."""
    return [tuple(m * x for x in v) for m, v in zip(weights, vectors, strict=True)]


class Body(Draws):
    """The draws of a model with its body: masses, places and blocks of its points."""

    masses: list[Any]
    points: list[Vector]
    blocks: list[int]

    def embody(self, *, principal: bool) -> None:
        """Draw the points, with a diagonal J if ``principal``; symbolic moments m, c, J get the
        values that these points have."""
        self.masses, self.points, self.blocks = (
            principal_points(self) if principal else points_of(self)
        )
        if not self.generic and uses_body_axes(self.problem):
            self._axes()
        if self.problem.get("body", {}).get("kind") != "moments":
            return
        m, c, J = self.moments
        self.parameters |= {"m": m} | {f"c_{i + 1}": c[i][0] for i in range(self.n)}
        self.parameters |= {
            f"J_{i + 1}{j + 1}": J[i][j] for i in range(self.n) for j in range(i, self.n)
        }

    def _axes(self) -> None:
        """Last of all the origin of the body and the ends of its axes, without mass."""
        rows = (q.scaled(Fraction(0), q.identity(self.n))[0], *q.identity(self.n))
        self.masses = [*self.masses, *(Fraction(0) for _ in rows)]
        self.points, self.blocks = [*self.points, *rows], [*self.blocks, *(1 for _ in rows)]

    @cached_property
    def moments(self) -> tuple[Fraction, Matrix, Matrix]:
        """m, c, J as sums over the points."""
        weighted = scaled_each(self.masses, self.points)
        first, second = outer_sum(weighted, self.units), outer_sum(weighted, self.points)
        return sum(self.masses, Fraction(0)), first, second

    @property
    def units(self) -> list[Vector]:
        """The number 1 for each point, as a vector."""
        return [(Fraction(1),)] * len(self.points)

    def homogeneous(self, r: Vector) -> Matrix:
        """A place as a column: r, or (r, 1) for an affine action."""
        return q.column((*r, Fraction(1)) if self.group.affine else r)

    def moved(self, g: Matrix) -> list[Vector]:
        """The places in space of the points moved by g; for a tangent matrix their velocities."""
        ends = q.transposed(tuple(q.flatten(self.homogeneous(r)) for r in self.points))
        return [*q.transposed(q.times(g[: self.n], ends))]

    def pairing(self, a: Matrix, b: Matrix, weights: Sequence[Any] | None = None) -> Any:
        """Σ m_i ⟨a r_i, b r_i⟩, the kinetic metric of two tangent matrices at g; ``weights``: those
        of the points that stand for m_i."""
        weights = self.masses if weights is None else weights
        pairs = zip(weights, self.moved(a), self.moved(b), strict=True)
        return sum((m * q.dot(u, v) for m, u, v in pairs), Fraction(0))

    def metric_matrix(self, tangents: list[Matrix]) -> Matrix:
        """The matrix of the kinetic metric on tangent matrices at g."""
        moved = [[x for v in self.moved(a) for x in v] for a in tangents]
        weights = [m for m in self.masses for _ in range(self.n)]
        rows = [[m * x for m, x in zip(weights, u, strict=True)] for u in moved]
        return q.times(q.matrix(rows), q.transposed(q.matrix(moved)))
