"""Inverses of small matrices and linear systems, by what the record says of them."""

from __future__ import annotations

from ..algebra import rational as q
from ..algebra.groups import Group
from ..algebra.rational import Matrix
from ..algebra.tree import Tree
from ..record.record import Derivation
from . import dense
from .graph import PARAMETER, Graph, Node
from .naming import name_of, suffixed
from .options import Options
from .reader import Reader, Value

SMALL = 3
"""Up to this size a matrix is inverted by its adjugate."""


class Inverting(Reader):
    """``checks``: what must not vanish in constants, and the scale of its rounding error."""

    def __init__(self, d: Derivation, group: Group, options: Options, graph: Graph | None = None):
        super().__init__(d, group, options, graph)
        self.checks: list[tuple[Node, Node | None]] = []
        self._single = options.real == "float"

    def _inverse(self, t: Tree) -> Value:
        if t == ("T", "A"):
            return q.transposed(self.space.inverse)
        if t == "C" and self.space.tangent:
            inverse = self.space.inverse  # at hand, for Z = A⁻¹Ȧ
            square = dense.times(self.graph, inverse, q.transposed(inverse))
            return self.named(square, "inv_C")
        value, name = self.tree(t), name_of(("inv", t))
        g = self.graph
        if isinstance(value, Node):
            if value.stage == PARAMETER:
                self.checks.append((value, None))
            return g.value(g.recip(value), name, self.label)
        if self._unit_determinant(t):
            if len(value) <= SMALL:
                return self.named(dense.adjugate(g, value), name)
        elif len(value) <= SMALL:
            return self._by_adjugate(t, value, name)
        inverse, pivots = dense.symmetric_inverse(g, value, self._namer(name))
        self._check_pivots(t, value, pivots)
        return self.named(inverse, name)

    def require_regular(self) -> None:
        """Where a multiplier solves the kernel, J must be regular even if no force asks for J⁻¹."""
        if any(step.label.endswith(".multiplier") for step in self.record.steps):
            central = self.record.definition("N_c") is not None
            self.tree(("inv", "J_c" if central else "J"))

    def solved(self, t: Tree, right: Matrix) -> Matrix:
        """The column x with t x = right, for a positive definite t."""
        value = self.tree(t)
        assert not isinstance(value, Node)
        factors = dense.factorised(self.graph, value, self._namer(name_of(t)))
        self._check_pivots(t, value, factors.pivots)
        return dense.solve(self.graph, factors, right, self._namer(f"{name_of(t)}_solve"))

    def _namer(self, name: str) -> dense.NodeNamer:
        return lambda part, x: self.graph.value(x, f"{name}_{part}", self.label)

    def _check_pivots(self, t: Tree, value: Matrix, pivots: list[Node]) -> None:
        if dense.stage_of(value) == PARAMETER:
            scale = self.graph.magnitude(dense.diagonal(self.graph, value))
            self.checks += [(d, scale) for d in pivots]
        elif t == "M":
            # M is the metric at g of one space of displacements: singular at all g or at none
            still = self._at_identity(value)
            factors = dense.factorised(self.graph, still, lambda part, x: x)
            scale = self.graph.magnitude(dense.diagonal(self.graph, still))
            self.checks += [(d, scale) for d in factors.pivots if d.op != "num" or d.is_zero]

    def _at_identity(self, m: Matrix) -> Matrix:
        """A matrix that depends on the group element alone, at g = 1."""
        images = {
            x: self.graph.num(int(name == "A" and i == j))
            for name in ("A", "T")
            for i, row in enumerate(self.space.values.get(name, ()))
            for j, x in enumerate(row)
            if x.op in ("leaf", "value")
        }
        return tuple(tuple(self.graph.replaced(x, images) for x in row) for row in m)

    def _by_adjugate(self, t: Tree, value: Matrix, name: str) -> Value:
        g, base, units = self.graph, name_of(t), []
        if self._single and dense.stage_of(value) == PARAMETER:
            # three moments of a ship are 1e12 kg m² each: their product is no float
            self.checks.append((value[-1][-1], None))
            units = [g.value(g.recip(value[-1][-1]), f"unit_{base}", self.label)]
            lighter = tuple(tuple(g.product((*units, x)) for x in row) for row in value)
            value = self.named(lighter, f"{base}_in_units")  # type: ignore[assignment]
        adjugate = self.named(dense.adjugate(g, value), f"adj_{base}")
        assert not isinstance(adjugate, Node)
        row = [(x, adjugate[j][0]) for j, x in enumerate(value[0])]
        det = g.value(g.sum(g.product(pair) for pair in row), f"det_{base}", self.label)
        if det.stage == PARAMETER:
            self._check_minors(value, adjugate, det, base)
        else:
            self._check_pivots(t, value, [])
        scale = g.value(g.product((*units, g.recip(det))), f"inv_det_{base}", self.label)
        return self.named(tuple(tuple(g.product((scale, x)) for x in r) for r in adjugate), name)

    def _check_minors(self, m: Matrix, adjugate: Matrix, det: Node, base: str) -> None:
        """The leading minors of a positive M against Σ_i s_i Π_j≠i M_jj, s_i the terms of M_ii.

        In units where the diagonal is 1 that is the rounding of M, however slender the body.
        """
        g, n = self.graph, len(m)
        minors = [m[0][0], *([adjugate[2][2]] if n == 3 else []), det][-n:]
        names = [suffixed(f"size_{base}", i) for i in range(1, n + 1)]
        pairs = zip(range(n), names, strict=True)
        sizes = [g.value(g.magnitude(m[i][i]), name, self.label) for i, name in pairs]
        for k, minor in enumerate(minors, 1):
            terms = (
                g.product([sizes[i], *(m[j][j] for j in range(k) if j != i)]) for i in range(k)
            )
            self.checks.append((minor, g.sum(terms)))

    def _unit_determinant(self, t: Tree) -> bool:
        """A and C = ĀA where the record says det A = 1."""
        unimodular = any(
            e.lhs == ("det", "A") and e.rhs == 1 for s in self.record.steps for e in s.equations
        )
        return unimodular and t in ("A", "C")
