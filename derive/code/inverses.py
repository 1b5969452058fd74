"""Inverses of small matrices and linear systems, by what the record says of them."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from ..language import rational as q
from ..language.rational import Matrix
from ..language.suffixed import suffixed
from ..language.tree import Tree
from ..record.as_json import decode
from ..record.mass_signs import ANY_SIGN
from . import dense
from .graph import PARAMETER, Node
from .naming import name_of
from .pivots import Block, Pivots, solve
from .reader import RecordReader, Value, matrix
from .rewrite import replaced

SMALL = 3
"""Up to this size a matrix is inverted by its adjugate."""

SLACK = {"double": Fraction(1, 10**7), "float": Fraction(1, 10**3)}
"""Added to moments that may be 0, in units of their trace: the root of what rounding makes of them,
as elimination divides by it."""


class Inverses:
    """The inverses and linear solves of one record, and what ``constants`` must test for them.

    ``checks``: what must be positive, and the scale of its rounding error; ``local``: do they hold
    the metric at g = 1 alone?  ``definite``: is M that of masses, or of any Lagrangian?
    ``untested``: such an M depends on the state.  ``sure``: is it singular wherever a test of it
    fails?
    """

    def __init__(self, reader: RecordReader):
        self.reader, self.graph, self.group = reader, reader.graph, reader.group
        self.checks: list[tuple[Node, Node | None]] = []
        self.local = self.untested = False
        self.sure = True
        self.definite = "lagrangian" not in reader.record.problem

    def of(self, t: Tree) -> Value:
        """The inverse of the value of a tree, a number or a matrix; its check is noted."""
        g, space = self.graph, self.reader.space
        if t == ("T", "A"):
            return q.transposed(space.inverse)
        if t == "C" and space.tangent:  # the inverse of A is at hand, for Z = A⁻¹Ȧ
            square = q.times(space.inverse, q.transposed(space.inverse))
            return self.reader.entries(square, "inv_C")
        value, name = self.reader.tree(t), name_of(("inv", t))
        if isinstance(value, Node):
            if value.stage == PARAMETER:
                self.checks.append((value, None))
            return g.value(g.recip(value), name, self.reader.label)
        if self._unit_determinant(t):
            if len(value) <= SMALL:
                return self.reader.entries(dense.adjugate(g, value), name)
        elif len(value) <= SMALL and dense.stage_of(value) != PARAMETER:
            return self._by_adjugate(t, value, name)
        if t == "M" and (blocks := self._chosen(value)):
            one = dense.numbers(g, q.identity(len(value)))
            return self.reader.entries(self._by_blocks(t, value, blocks, one), name, recorded=True)
        inverse, divided = dense.symmetric_inverse(g, value, self._namer(name_of(t)))
        if len(value) <= SMALL and _alike(value):
            inverse = self._by_adjugate(t, value, name)
        found = self.reader.entries(inverse, name, recorded=True)
        self._check_pivots(t, value, divided)
        if dense.stage_of(value) == PARAMETER:
            self._check_diagonal(t, value, found)
        return found

    @property
    def mass_fault(self) -> str:
        """What ``constants`` says that the mass matrix is, where a test fails."""
        if self.definite:
            return "singular or not positive"
        return "singular" if self.sure else "singular, or a diagonal block of it"

    def require_regular(self) -> None:
        """Note the checks of J and m even if no force asks for their inverses: where a multiplier
        solves the kernel, and where the group has all translations."""
        record = self.reader.record
        if any(step.label.endswith(".multiplier") for step in record.steps):
            central = record.definition("N_c") is not None
            self.reader.tree(("inv", "J_c" if central else "J"))
        if self.group.free_translations and self.definite:
            self._check([(self.reader.number("m"), None)])

    def solved(self, t: Tree, right: Matrix) -> Matrix:
        """The column x with t x = right, for a symmetric t; its checks are noted."""
        value = matrix(self.reader.tree(t))
        if blocks := self._chosen(value):
            return self._by_blocks(t, value, blocks, right, "_solve")
        factors = dense.factorised(self.graph, value, self._namer(name_of(t)))
        self._check_pivots(t, value, factors.pivots)
        return dense.solve(self.graph, factors, right, self._namer(f"{name_of(t)}_solve"))

    def _chosen(self, m: Matrix) -> list[Block] | None:
        """The pivots of an M that may be indefinite; ``None`` where elimination takes row by row,
        as it does for any that is not."""
        if self.definite:
            return None
        found = Pivots(m)
        if dense.stage_of(m) == PARAMETER:
            self.sure = self.sure and found.sure
        return None if found.as_given else found.blocks

    def _by_blocks(
        self, t: Tree, value: Matrix, blocks: list[Block], right: Matrix, suffix: str = ""
    ) -> Matrix:
        """The x with t x = right by these pivots, which are noted to be tested."""
        g = self.graph
        found, pivots = solve(g, value, blocks, right, self._namer(name_of(t) + suffix))
        if dense.stage_of(value) == PARAMETER:
            self._check((g.absolute(x), g.magnitude(x)) for x in pivots)
        else:
            self.untested = True
        return found

    def _namer(self, name: str) -> dense.NodeNamer:
        """What names the intermediate values of an elimination: ``name_part``."""
        return lambda part, x: self.graph.value(x, f"{name}_{part}", self.reader.label)

    def _check_pivots(self, t: Tree, value: Matrix, pivots: list[Node]) -> None:
        """Note that the pivots of a matrix of the parameters, or of M at g = 1, are positive."""
        if dense.stage_of(value) == PARAMETER:
            for pivot, size in zip(pivots, self._sizes(t, value), strict=True):
                tested = pivot if self.definite else self.graph.absolute(pivot)
                self._check([(tested, self.graph.magnitude(pivot) if size.is_zero else size)])
        elif not self.definite:
            self.untested = True
        elif t == "M":
            still = self._at_identity(value)
            factors = dense.factorised(self.graph, still, lambda part, x: x)
            scale = self.graph.magnitude(dense.diagonal(self.graph, still))
            self._check((d, scale) for d in factors.pivots)
            self._check_moments()

    def _check_moments(self) -> None:
        """Note that the moments of inertia are not negative, where masses may be.

        M at g is Tr Z μ Z̄ C: where no moment is negative it is singular at all g or at none, as it
        is where C is a multiple of 1. Elsewhere, where masses may be negative, nothing is known.
        """
        body = self.reader.record.problem["body"]
        masses = [decode(p["mass"], "mass") for p in body.get("points", [])]
        if self.group.conformal or (body["kind"] == "points" and all(map(_positive, masses))):
            return
        g, J, tests = self.graph, self.reader.vector("J"), []
        if self.group.affine:
            m, c = self.reader.number("m"), self.reader.vector("c")
            square = q.times(c, q.transposed(c))
            tests.append(m)
            J = q.minus(J, q.scaled(g.recip(m), square))
        J = self._seen(J)
        slack = g.product(
            (g.num(SLACK[self.reader.options.real]), g.magnitude(dense.diagonal(g, J)))
        )
        slack = g.value(slack, "slack", self.reader.label)
        span = range(len(J))
        least = tuple(tuple(J[i][j] + slack if i == j else J[i][j] for j in span) for i in span)
        tests += dense.factorised(g, least, self._namer("moments")).pivots
        if self.reader.record.problem.get("masses") == ANY_SIGN:
            self.local = not all(x.op == "num" and x.data > 0 for x in tests)
        if not self.local:
            self._check((x, None) for x in tests)

    def _seen(self, J: Matrix) -> Matrix:
        """The part R J R̄ of J that the metric sees; the rows of R span those of 𝔤."""
        g = self.graph
        rows = tuple(row for e in self.group.linear_basis for row in e)
        reduced, pivots = q.echelon(rows)
        R = dense.numbers(g, reduced[: len(pivots)])
        return q.times(q.times(R, J), q.transposed(R))

    def _at_identity(self, m: Matrix) -> Matrix:
        """A matrix that depends on the group element alone, at g = 1."""
        images = {
            x: self.graph.num(int(name == "A" and i == j))
            for name in ("A", "T")
            for i, row in enumerate(self.reader.space.values.get(name, ()))
            for j, x in enumerate(row)
            if x.op in ("leaf", "value")
        }
        return tuple(tuple(replaced(x, images) for x in row) for row in m)

    def _by_adjugate(self, t: Tree, value: Matrix, name: str) -> Matrix:
        """m⁻¹ as adjugate over determinant: few operations, but det may lose κ² (Higham 14.6).

        For matrices of the state. One of the parameters is factorised instead, which is done once
        and loses κ alone; but where all axes are alike, so are the entries of the adjugate, which
        rhs needs only once.
        """
        g, base = self.graph, name_of(t)
        adjugate = self.reader.entries(dense.adjugate(g, value), f"adj_{base}")
        if t == "C" and self.reader.record.definition("V_A"):
            det = g.product([self.reader.number("V_A")] * 2)  # det A is there
        else:
            det = q.dot(value[0], [row[0] for row in adjugate])
        det = g.value(det, f"det_{base}", self.reader.label)
        if dense.stage_of(value) != PARAMETER:
            self._check_pivots(t, value, [])
        scale = g.value(g.recip(det), f"inv_det_{base}", self.reader.label)
        return self.reader.entries(q.scaled(scale, adjugate), name)

    def _sizes(self, t: Tree, m: Matrix) -> list[Node]:
        """The sizes of the terms of the diagonal: in units where it is 1 they are the rounding of a
        positive M, however slender the body."""
        g, base = self.graph, name_of(t)
        pairs = [(suffixed(f"size_{base}", i), row[i - 1]) for i, row in enumerate(m, 1)]
        return [g.value(g.magnitude(x), name, self.reader.label) for name, x in pairs]

    def _check_diagonal(self, t: Tree, m: Matrix, inverse: Matrix) -> None:
        """Note that 1/(M⁻¹)_ii is positive: rounding after a small pivot may hide that one is
        not."""
        for i, scale in enumerate(self._sizes(t, m) if self.definite else ()):
            x = inverse[i][i]
            pivot = x.op == "value" and x.args[0].op == "recip"
            self._check([] if pivot else [(self.graph.recip(x), scale)])

    def _check(self, checks: Iterable[tuple[Node, Node | None]]) -> None:
        """Note checks that are not noted yet."""
        self.checks += [x for x in dict.fromkeys(checks) if x not in self.checks]

    def _unit_determinant(self, t: Tree) -> bool:
        """Is it A or C = ĀA, in a record that says det A = 1?"""
        equations = self.reader.equations
        return t in ("A", "C") and any((e.lhs, e.rhs) == (("det", "A"), 1) for _, e in equations)


def _positive(x: object) -> bool:
    """Is it a positive number?"""
    return isinstance(x, (int, Fraction)) and x > 0


def _alike(m: Matrix) -> bool:
    """Is it a I + b (𝟙 − I), a on the diagonal and b ≠ 0 everywhere beside it, not of numbers?"""
    beside = {x for i, row in enumerate(m) for j, x in enumerate(row) if i != j}
    if len({row[i] for i, row in enumerate(m)}) != 1 or len(beside) != 1:
        return False
    return not dense.is_constant(m) and not m[0][1].is_zero
