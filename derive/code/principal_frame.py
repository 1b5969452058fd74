"""The principal frame in numbers: H, s, S and the parameters in it, from those of the problem.

All is straight-line code but the axes of a few small symmetric matrices, which the emitted code
finds by Jacobi's rotations: those of J, of K, of gravity, and of what holds a quaternion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..language.suffixed import suffixed
from ..record.as_json import decode
from . import dense
from .graph import Node
from .quaternion import conjugate, horn
from .reader import RecordReader, scalar

FRAME = "frame"
"""The label of what comes from no equation of the record but from the choice of the frame."""

SMALL = Fraction(1, 10**30)
"""Added to the size of gravity, which may be 0."""

SPREAD = (31, 27, 16, 11, 7, 5, 3, 2)
"""A diagonal matrix, in hundredths, in which no two directions across a rational γ are alike."""


@dataclass(frozen=True)
class Axes:
    """The spectral decomposition of a symmetric ``matrix``: eigenvalues ``values``, smallest first;
    ``rows``: a rotation whose rows are the eigenvectors."""

    matrix: Matrix
    values: tuple[Node, ...]
    rows: Matrix

    @property
    def leaves(self) -> list[Node]:
        """The numbers found: eigenvalues, then rows, as the emitted code stores them."""
        return [*self.values, *q.flatten(self.rows)]


class PrincipalFrame:
    """The principal frame of a problem: H, s, S and the new parameters, as nodes.

    ``data``: what the new parameters stand for, ``Problem.frame``; ``old``: the problem as the user
    gave it, read in the graph of the framed one. ``axes``: in order, each needs those before it;
    ``numbers``: leaf → node in the parameters and axes, for each new parameter of the framed
    problem and each entry of H, H⁻¹, s, S. ``unit``, ``scale``: the leaves of μ and 1/μ, else 1.
    """

    def __init__(self, data: Mapping[str, Any], old: RecordReader, quaternion: bool):
        self.data, self.old, self.graph = data, old, old.graph
        old.label = FRAME
        self.n, self.affine = old.group.n, old.group.affine
        self.axes: list[Axes] = []
        self.numbers: dict[Node, Node] = {}
        self.unit = self.per_unit = self.scale = old.graph.num(1)
        self._material()
        self._space()
        self._parameters()
        self.quaternions = self._quaternions() if quaternion else ()

    def nodes(self) -> list[Node]:
        """All that the frame computes: the numbers, and the matrices whose axes are wanted."""
        return [*self.numbers.values(), *(x for axes in self.axes for x in q.flatten(axes.matrix))]

    # -- the frame ---------------------------------------------------------------------------

    def _principal(self, m: Matrix, value: str, axis: str) -> Axes:
        """The axes of a symmetric matrix, as leaves: the emitted code finds their numbers."""
        leaf = self.graph.leaf
        span = range(1, len(m) + 1)
        values = tuple(leaf(suffixed(value, i), "frame") for i in span)
        rows = tuple(tuple(leaf(suffixed(axis, i, j), "frame") for j in span) for i in span)
        self.axes.append(Axes(m, values, rows))
        return self.axes[-1]

    def _kept(self, name: str, m: Matrix) -> Matrix:
        """The matrix as leaves ``name_ij`` of the frame, which ``constants`` keeps."""
        return dense.entrywise(m, name, self._number_of, len(m[0]) == 1)

    def _number_of(self, x: Node, name: str, kind: str = "frame") -> Node:
        """The leaf for a number x that the frame computes."""
        leaf = self.graph.leaf(name, kind)
        self.numbers[leaf] = x
        return leaf

    def _material(self) -> None:
        """Set H, H⁻¹, s, and the numbers that tell a singular body."""
        g, n = self.graph, self.n
        J = self.old.vector("J")
        self.s: Matrix = ()
        if self.affine:
            inverse = g.recip(self.old.number("m"))
            c = self.old.vector("c")
            s = self._named("centre", q.scaled(inverse, c))
            shift = q.times(c, q.transposed(s))
            J = q.minus(J, shift)
            self.s, self._s = self._kept("centre", s), s
        span = range(n)
        J = tuple(tuple(J[min(i, j)][max(i, j)] for j in span) for i in span)
        J = self._named("J_c" if self.affine else "J", J)
        found = self._principal(J, "second", "axis")
        scale = g.magnitude(dense.diagonal(g, J))
        if self.data["kind"] == "root":
            H, back = self._root(found)
            least = found.values[0]
            self.H, self.back = self._kept("frame", H), self._kept("frame_inverse", back)
            self._H = self._named("frame", H)
        else:
            least = found.values[0] + found.values[1]
            self._set(self.data["moments"], found.values)
            self.H, self._H = self._kept("frame", found.rows), found.rows
            self.back = q.transposed(self.H)
        self.regular: list[tuple[Node, Node | None]] = []
        if self.affine and self.data["per_unit"]:  # without mass, nothing below is a number
            self.regular.append((self._number_of(self.old.number("m"), "mass"), None))
        moments = self._number_of(least, "least_moment"), self._number_of(scale, "size_of_J")
        self.regular.append(moments)

    def _root(self, J: Axes) -> tuple[Matrix, Matrix]:
        """H with H J H̄ = μ1, and H⁻¹; with stiffnesses also H K H̄ diagonal."""
        g = self.graph
        mu: Node = g.num(1)
        if self.data["per_unit"]:
            logarithm = g.sum(g.function("log", x) for x in J.values)
            mu = g.function("exp", g.linear([(Fraction(1, self.n), logarithm)]))
            mu = g.value(mu, "unit_of_mass", FRAME)
            self.per_unit = g.value(g.recip(mu), "per_unit", FRAME)
            self._set((self.data["per_unit"],), (self.per_unit,))
            self.scale = self.graph.leaf(self.data["per_unit"], "parameter")
            self.unit = self._number_of(mu, "unit_of_mass")
        roots = [
            g.value(g.function("sqrt", g.product((mu, g.recip(x)))), suffixed("stretch", i), FRAME)
            for i, x in enumerate(J.values, 1)
        ]
        H = tuple(
            tuple(g.product((k, x)) for x in row) for k, row in zip(roots, J.rows, strict=True)
        )
        back = tuple(
            tuple(g.product((x, g.recip(k))) for x, k in zip(row, roots, strict=True))
            for row in q.transposed(J.rows)
        )
        if not self.data["stiffness"]:
            return H, back
        H, back = self._named("root", H), self._named("root_inverse", back)
        K = q.times(q.times(H, self.old.vector("K")), q.transposed(H))
        along = self._principal(K, "spring", "turn")
        stiffness = [g.product((self.per_unit, x)) for x in along.values]
        self._set(self.data["stiffness"], stiffness)
        return q.times(along.rows, H), q.times(back, q.transposed(along.rows))

    def _space(self) -> None:
        """Set S, the rotation that puts gravity along the last axis; empty where space stays."""
        self.S: Matrix = ()
        if self.data["turned"]:
            g = self.old.vector("γ")
            found = self._principal(self._upright(g), "pull", "space")
            self.S, self._S = self._kept("space", found.rows), found.rows
            whole = q.times((found.rows[-1],), g)
            self._set((self.data["gravity"],), whole[0])

    def _upright(self, gamma: Matrix) -> Matrix:
        """A matrix whose last axis is γ, and whose others are definite as well: s²uū + QDQ with u
        along γ, s² = ūu, Q = s²1 − uū."""
        g, span = self.graph, range(self.n)
        total = g.sum([*(g.magnitude(x) for (x,) in gamma), g.num(SMALL)])
        scale = g.value(g.recip(total), "per_gravity", FRAME)
        u = self._named("upright", q.scaled(scale, gamma))
        square = g.value(dense.dot(u, u), "upright_2", FRAME)
        both = q.times(u, q.transposed(u))
        Q = self._named("across", q.minus(q.scaled(square, q.identity(self.n)), both))
        spread = tuple(
            tuple(g.product((g.num(Fraction(SPREAD[i], 100)), x)) for x in Q[i]) for i in span
        )
        return q.plus(q.scaled(square, both), q.times(Q, spread))

    def _parameters(self) -> None:
        """Set the new places H(r − s), vectors of space S a, and first moment Hc."""
        for names, at in self.data["places"]:
            place = q.minus(self._column(at), self._s) if self.s else self._column(at)
            self._set(names, q.flatten(q.times(self._H, place)))
        for names, v in self.data["vectors"]:
            self._set(names, q.flatten(q.times(self._S, self._column(v))))
        if self.data["first"]:
            first = q.times(self._H, self.old.vector("c"))
            self._set(self.data["first"], q.flatten(q.scaled(self.per_unit, first)))

    def _set(self, names: Sequence[str], values: Sequence[Node]) -> None:
        """Let new parameters of the framed problem stand for these values."""
        for name, x in zip(names, values, strict=True):
            self._number_of(x, name, "parameter")

    def _quaternions(self) -> tuple[tuple[Node, ...], ...]:
        """The quaternions of S and of H̄, by the axis of the largest eigenvalue (see ``horn``)."""
        found = []
        for name, R in (("space", self.S and self._S), ("frame", self._H)):
            if not R:
                found.append((self.graph.num(1), *(self.graph.num(0),) * 3))
                continue
            axes = self._principal(horn(R), f"{name}_trace", f"{name}_quaternion")
            kept = self._kept(f"{name}_q", tuple((x,) for x in axes.rows[-1]))
            found.append(tuple(x for (x,) in kept))
        return found[0], conjugate(found[1])

    # -- values of the given problem ---------------------------------------------------------

    def _column(self, trees: Sequence[Any]) -> Matrix:
        """A list of trees of the given problem, as a column of nodes."""
        return tuple((scalar(self.old.tree(decode(t, "frame"))),) for t in trees)

    def _named(self, name: str, m: Matrix) -> Matrix:
        return self.old.entries(m, name)
