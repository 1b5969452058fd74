"""The line through the origin about which space may be turned without moving what a potential is
given by: the acceleration of gravity, anchors, centres, the axes of harmonic forces.

Whether two vectors are parallel is decided by residues modulo large primes
(:func:`derive.problem.null_directions.vanishes`); what is then claimed is checked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ..algebra.words import Expr, Letter, one, word, zero
from ..language.derivatives import product
from ..language.tree import Tree, add, mul, neg
from ..problem.null_directions import vanishes
from ..problem.problem import Problem
from ..schema.kinds.attraction import Attraction
from ..schema.kinds.far_centre import FarCentre
from ..schema.kinds.gravity import gravity
from ..schema.kinds.harmonic import Harmonic
from ..schema.kinds.spring import Spring

Vector = tuple[Tree, ...]
UNITS = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True)
class Given:
    """What the potentials are given by in space: ``vectors`` that are not 0; ``weighs``: is gravity
    one of them? ``W``: the matrix of harmonic forces."""

    n: int
    vectors: tuple[Vector, ...]
    weighs: bool
    W: tuple[Vector, ...]

    @classmethod
    def of(cls, problem: Problem) -> Given:
        """Of the potentials of a problem on one space."""
        assert problem.group is not None
        n = problem.group.n
        weight = _not_zero([gravity(problem.potentials)])
        places = []
        for p in problem.potentials:
            if isinstance(p, Spring):
                places.append(p.anchor)
            elif isinstance(p, (Attraction, FarCentre)):
                places.append(p.centre)
        W = [p.W for p in problem.potentials if isinstance(p, Harmonic)]
        summed = (tuple(add(*(x[i][j] for x in W)) for j in range(n)) for i in range(n))
        vectors = (*weight, *_not_zero(places))
        return cls(n, vectors, bool(weight), tuple(summed) if W else ())

    def lines(self) -> tuple[Vector, ...]:
        """A vector of R³ along each line to try: the one of all vectors, where there are some, else
        the axes that W_r may have."""
        if self.vectors:
            first, *others = self.vectors
            return (first,) if all(_parallel(first, x) for x in others) else ()
        return tuple(x for x in _axes(self.W) if not all(map(_is_zero, x))) if self.W else ()

    def known(self, line: Vector | None, axis: Letter | None = None) -> dict[Letter, Expr]:
        """γ as 0 where it is; W_r as w, or as w + v x x̄ with the letter ``axis`` x of the ``line``,
        where it is that."""
        found = {} if self.weighs else {Letter("γ", self.n): zero(self.n)}
        W, w, v = Letter("W_r", self.n, self.n, 1), Letter("w"), Letter("v")
        if self.W and _is_scalar(self.W):
            found[W] = word(w) * one(self.n)
        elif self.W and line and axis and _turns_into_itself(self.W, line):
            found[W] = word(w) * one(self.n) + word(v) * word(axis) * word(axis).bar
        return found


def _not_zero(vectors: Iterable[Vector | None]) -> tuple[Vector, ...]:
    return tuple(x for x in vectors if x and not all(map(_is_zero, x)))


def _is_zero(t: Tree) -> bool:
    try:
        return vanishes(t)
    except ZeroDivisionError:
        return False


def _parallel(x: Sequence[Tree], y: Sequence[Tree]) -> bool:
    """Is x ∧ y = 0?"""
    return all(_is_zero(t) for t in _wedge(x, y))


def _wedge(x: Sequence[Tree], y: Sequence[Tree]) -> Vector:
    pairs = ((1, 2), (2, 0), (0, 1))
    return tuple(add(mul(x[i], y[j]), neg(mul(x[j], y[i]))) for i, j in pairs)


def _turns_into_itself(W: Sequence[Vector], x: Vector) -> bool:
    """Is j(x)W = Wj(x), for a symmetric W: is j(x)W, whose columns are x ∧ W e_i, symmetric?"""
    turned = [_wedge(x, row) for row in W]
    return all(_is_zero(add(turned[i][j], turned[j][i])) for i in range(3) for j in range(i + 1))


def _is_scalar(W: Sequence[Vector]) -> bool:
    span = range(len(W))
    other = (add(W[i][j], neg(W[0][0]) if i == j else 0) for i in span for j in span)
    return all(map(_is_zero, other))


def _axes(W: Sequence[Vector]) -> Iterator[Vector]:
    """The x for which W may be w + v x x̄: by W_ij = v x_i x_j, or with an x_i = 0, where w is
    W_ii."""
    yield from UNITS
    yield product(W[0][1], W[0][2]), product(W[0][1], W[1][2]), product(W[0][2], W[1][2])
    for i in range(3):
        for j in {0, 1, 2} - {i}:
            yield tuple(add(W[j][k], neg(W[i][i]) if j == k else 0) for k in range(3))
