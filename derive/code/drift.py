"""Back to the group: one Newton step for its relations, and how far a state is off them.

With A in the affine span of the group already, the step is A ← A + AX, where X solves the relations
linearised on the group, SX + X̄S = −R and Tr X = −(det A − 1), with R = ĀSA − S:

    X = −½ S⁻¹R,    with R = ĀSA/μ − S and nμ = Tr S⁻¹ĀSA up to a factor,
    X = −(det A − 1 + Tr X_S)/n,    X_S the other one where there are both.

A velocity dA/dt goes along by the derivative of the step: what leaves the group is taken from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial

from ..algebra.factor_charts import QUATERNION, FactorChart
from ..algebra.groups import Group
from ..algebra.relations import Relations, relations
from ..language import rational as q
from ..language.rational import Matrix
from . import dense
from .dense import Complex
from .factor import factored
from .graph import Graph, Node
from .program import Block
from .schedule import Directional, by_numbers
from .slots import StateSlot, conjugate, multiplied
from .state import StateSpace

TEXTS = {
    "hull": "A in the affine span of the group",
    "orthogonal": "ĀA = 1",
    "similar": "ĀA = μ 1",
    "form": "ĀSA = S",
    "conformal": "ĀSA = μS",
    "determinant": "det A = 1",
    "unit": "q̄q = 1",
}
"""The label of the values of a relation, and what stands in a comment before them."""


def drift(x: StateSpace, *, slopes: bool = False) -> dict[str, list[Node]]:
    """The outputs of ``project`` and ``defect``, and the derivative of the former where ``slopes``
    are asked for, by name; empty where G has no relations."""
    g, leaves = x.graph, [x.graph.leaf(name, "state") for name in x.names]
    steps = _by_factors(x) if x.has_element else []
    images = {leaf: image for step in steps for leaf, image in step.images.items()}
    residuals = [y for step in steps for y in step.residuals]
    if not residuals:
        return {}
    if x.tangent:
        half = (len(leaves) - len(x.stored)) // 2
        here, there = leaves[:half], leaves[half : 2 * half]
        moving = Directional(g, dict(zip(here, there, strict=True)), "t")
        pairs = zip(here, there, strict=True)
        images |= {rate: moving.of(images.get(y, y)) for y, rate in pairs}
        residuals += [moving.of(y) for y in residuals]
    sizes = g.sum(g.absolute(y) for y in residuals)
    found = {"project": [images.get(y, y) for y in leaves], "defect": [sizes]}
    if slopes:
        found["jacobian_project"] = factored(g, by_numbers(g, found["project"], leaves))
    return found


@dataclass
class _Step:
    """A Newton step: leaf of the state → its new value; ``residuals``: what the relations leave."""

    images: dict[Node, Node] = field(default_factory=dict)
    residuals: list[Node] = field(default_factory=list)


def _unit_quaternion(g: Graph, chart: FactorChart, q: list[Node]) -> _Step:
    """The step of a unit quaternion: q ← q − ½ q (q̄q − 1)."""
    square = multiplied(conjugate(tuple(q)), tuple(q))[0]
    left = g.value(square - 1, f"left{chart.mark}", "unit")
    change = g.value(left * Fraction(-1, 2), f"step{chart.mark}", "unit")
    return _Step({y: y + y * change for y in q}, [left])


def _by_factors(x: StateSpace) -> list[_Step]:
    """One step for each factor of the group that has relations, or a quaternion."""
    found = []
    for place, (offset, factor) in enumerate(x.group.places):
        kept, mark = relations(factor), str(place + 1) if len(x.group.places) > 1 else ""
        if (chart := x.charts.get(place)) or factor.vectors:
            if chart and chart.kind == QUATERNION:
                found.append(_unit_quaternion(x.graph, chart, x.numbers[chart]))
        elif not kept.none:
            found.append(_Block(x.graph, factor, kept, mark).step(_entries(x, offset, factor)))
    return found


def matrices(x: StateSpace) -> tuple[Block, ...]:
    """The places of the entries of A, row by row, of the factors that have relations."""
    if not x.has_element:
        return ()
    held = [y for y, own in x.numbers.items() for _ in own]
    at = {(y.letter, y.row, y.column): k for k, y in enumerate(held) if isinstance(y, StateSlot)}
    return tuple(
        Block(factor.name, _places(at, offset, factor), factor.conformal)
        for place, (offset, factor) in enumerate(x.group.places)
        if not (relations(factor).none or x.still or place in x.charts or factor.vectors)
    )


def _places(at: Mapping[tuple[str, int, int], int], offset: int, factor: Group) -> tuple[int, ...]:
    span = range(offset, offset + factor.n)
    return tuple(at["A", i, j] for i in span for j in span)


def _entries(x: StateSpace, offset: int, factor: Group) -> list[Node]:
    """The leaves of A of a factor, row by row, then those of its T; numbers where they never
    vary."""
    span, last = range(offset, offset + factor.n), offset + factor.n
    A = [x.values["A"][i][j] for i in span for j in span]
    if not factor.affine:
        return A
    return A + [x.values["A"][i][last] if x.group.factors else x.values["T"][i][0] for i in span]


@dataclass
class _Block:
    """One factor of the group with its relations; ``mark``: its number among several."""

    graph: Graph
    factor: Group
    relations: Relations
    mark: str
    residuals: list[Node] = field(default_factory=list)

    def step(self, leaves: list[Node]) -> _Step:
        """The step of this factor; ``leaves``: its A row by row, then T."""
        n = self.factor.n
        placed = self._in_hull(leaves) if self.relations.hull else leaves
        A = tuple(tuple(placed[i * n : i * n + n]) for i in range(n))
        X = self._form(A) if self.relations.form else ()
        if self.relations.determinant:
            X = self._complex(A, X) if self.relations.complex_basis else self._determinant(A)
        if X:
            moved = zip(placed, q.flatten(q.times(A, X)), strict=False)
            placed = [*(a + change for a, change in moved), *placed[n * n :]]
        return _Step(dict(zip(leaves, placed, strict=True)), self.residuals)

    def _in_hull(self, leaves: list[Node]) -> list[Node]:
        """The leaves projected to the affine span of the group."""
        g, n, found = self.graph, self.factor.n, []
        one = (*q.flatten(q.identity(n)), *[Fraction(0)] * (len(leaves) - n * n))
        for y, start, row in zip(leaves, one, self.relations.hull, strict=True):
            if y.op == "num":
                found.append(y)
                continue
            shift = start - sum(c * s for c, s in zip(row, one, strict=True))
            terms = ((c, z) for c, z in zip(row, leaves, strict=True) if c)
            inside = g.linear([*terms, (Fraction(1), g.num(shift))])
            found.append(self._named(inside, f"{y.data[1]}_in", "hull"))
            if found[-1] is not y:
                self.residuals.append(y - found[-1])
        return found

    def _form(self, A: Matrix) -> Matrix:
        """The matrix X = −½ S⁻¹R that restores ĀSA = S (or μS)."""
        g, n, S = self.graph, self.factor.n, self._numbers(self.relations.form)
        inverse = self._inverse(self.relations.form)
        sign = 1 if self.relations.form == q.transposed(self.relations.form) else -1
        label = _label(self.relations)
        SA = self._names(q.times(S, A), f"SA{self.mark}", label)
        pulled_back = self._mirrored(q.times(q.transposed(A), SA), sign)
        if self.relations.conformal:
            pulled_back = self._names(pulled_back, f"gram{self.mark}", label)
            mu = dense.diagonal(g, q.times(inverse, pulled_back)) * Fraction(1, n)
            inv_mu = self._named(g.recip(mu), f"inv_mu{self.mark}", label)
            pulled_back = q.scaled(inv_mu, pulled_back)
        R = q.plus(pulled_back, self._numbers(q.scaled(-1, self.relations.form)))
        R = self._mirrored(self._names(R, f"left{self.mark}", label), sign)
        self.residuals += [R[i][j] for i in range(n) for j in range(i, n) if not R[i][j].is_zero]
        X = q.scaled(Fraction(-1, 2), q.times(inverse, R))
        return self._names(X, f"step{self.mark}", label)

    def _mirrored(self, m: Matrix, sign: int) -> Matrix:
        """The symmetric (sign 1) or skew (−1) matrix with the upper triangle of m."""
        span = range(len(m))
        return tuple(tuple(m[i][j] if i <= j else m[j][i] * sign for j in span) for i in span)

    def _determinant(self, A: Matrix) -> Matrix:
        """The matrix X = −(det A − 1)/n that restores det A = 1."""
        left = self._left(dense.determinant(A) - 1, "left")
        step = self._named(left * Fraction(-1, len(A)), f"step{self.mark}", "determinant")
        return q.scaled(step, q.identity(len(A)))

    def _complex(self, A: Matrix, X: Matrix) -> Matrix:
        """X − (det A − 1 + Tr X)/m with a complex determinant of m × m, as real matrices."""
        P, back = (
            self._numbers(self.relations.complex_basis),
            self._inverse(self.relations.complex_basis),
        )
        m = len(P) // 2

        def complexes(M: Matrix) -> list[list[Complex]]:
            inside = q.times(q.times(back, M), P)
            top, bottom = inside[:m], inside[m:]
            pairs = (zip(x[:m], y[:m], strict=True) for x, y in zip(top, bottom, strict=True))
            return [[Complex(*pair) for pair in row] for row in pairs]

        det = dense.determinant(complexes(A))
        total = Complex(self._left(det.re - 1, "left_re"), self._left(det.im, "left_im"))
        for i, row in enumerate(complexes(X) if X else ()):
            total = total + row[i]
        re, im = (
            self._named(y * Fraction(-1, m), f"{name}{self.mark}", "determinant")
            for name, y in (("step_re", total.re), ("step_im", total.im))
        )
        diagonal, beside = q.scaled(re, q.identity(m)), q.scaled(im, q.identity(m))
        rows = [(*a, *(-y for y in b)) for a, b in zip(diagonal, beside, strict=True)]
        rows += [(*b, *a) for a, b in zip(diagonal, beside, strict=True)]
        change = q.times(q.times(P, tuple(rows)), back)
        return self._names(q.plus(X, change), f"step{self.mark}", "determinant") if X else change

    def _left(self, y: Node, name: str) -> Node:
        """What the determinant leaves, named, and added to the residuals."""
        self.residuals.append(self._named(y, f"{name}{self.mark}", "determinant"))
        return self.residuals[-1]

    def _inverse(self, m: Matrix) -> Matrix:
        """The inverse of a rational matrix, as nodes."""
        found = q.inverted(m)
        return self._numbers(found)

    def _numbers(self, m: Matrix) -> Matrix:
        return dense.numbers(self.graph, m)

    def _named(self, y: Node, name: str, label: str) -> Node:
        return self.graph.value(y, name, label)

    def _names(self, m: Matrix, name: str, label: str) -> Matrix:
        return dense.entrywise(m, name, partial(self.graph.value, label=label), column=False)


def _label(kept: Relations) -> str:
    """The key in TEXTS of the relation that a form expresses."""
    if kept.form == q.identity(len(kept.form)):
        return "similar" if kept.conformal else "orthogonal"
    return "conformal" if kept.conformal else "form"
