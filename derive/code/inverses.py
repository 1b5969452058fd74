"""Inverses of small matrices and linear systems, and the pivots of indefinite ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations, combinations_with_replacement
from operator import mul
from random import Random
from typing import Any

from ..algebra.factor_charts import COORDINATES
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..language.tree import Tree
from ..record.as_json import decode
from ..record.mass_signs import ANY_SIGN
from . import dense
from .graph import PARAMETER, Graph, Node, reachable, replaced
from .naming import name_of
from .reader import RecordReader, Value, matrix

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
    fails?  ``changing``: what is inverted and changes, maybe with masses that flow alone.
    """

    def __init__(self, reader: RecordReader):
        self.reader, self.graph, self.group = reader, reader.graph, reader.group
        self.checks: list[tuple[Node, Node | None]] = []
        self.changing: dict[Tree, Matrix] = {}
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
        self.changing[t] = ((value,),) if isinstance(value, Node) else value
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
            return "singular or not positive" + " at t = 0" * bool(self._start)
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
        value = self.changing[t] = matrix(self.reader.tree(t))
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
        for chart in self.reader.space.charts.values():  # a scaling has sums of exponentials
            if chart.kind == COORDINATES:
                images |= dict.fromkeys(self.reader.space.numbers[chart], self.graph.num(0))
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
        """Note checks that are not noted yet, of masses that flow at the start."""
        if start := self._start:
            checks = [(replaced(x, start), size and replaced(size, start)) for x, size in checks]
        self.checks += [x for x in dict.fromkeys(checks) if x not in self.checks]

    def tests(self) -> list[tuple[Node, Node | None]]:
        """The checks, when all is lowered; with those of what changes with masses that flow alone,
        as it is at the start: nothing of this is computed elsewhere."""
        g, start = self.graph, self._start
        for t, value in self.changing.items() if start else ():
            still = tuple(tuple(replaced(x, start) for x in row) for row in value)
            if dense.stage_of(value) == PARAMETER or dense.stage_of(still) != PARAMETER:
                continue
            try:
                inverse, pivots = dense.symmetric_inverse(g, still, self._namer(f"{name_of(t)}_0"))
            except ZeroDivisionError:  # singular then, whatever the parameters
                self._check([(g.num(0), None)])
            else:
                self._check_pivots(t, still, pivots)
                self._check_diagonal(t, still, inverse)
        return self.checks

    @cached_property
    def _start(self) -> dict[Node, Node]:
        """Where masses flow, the time 0, and those that are of the state by default."""
        if not self.reader.record.problem.get("flows"):
            return {}
        leaves = self.reader.space.stored
        known = start_of_masses(self.reader.record.problem, leaves)
        numbers = {leaf: self.graph.num(Fraction(repr(known[x]))) for x, leaf in leaves.items()}
        return {self.reader.leaf("t", "time"): self.graph.num(0), **numbers}

    def _unit_determinant(self, t: Tree) -> bool:
        """Is it A or C = ĀA, in a record that says det A = 1?"""
        equations = self.reader.equations
        return t in ("A", "C") and any((e.lhs, e.rhs) == (("det", "A"), 1) for _, e in equations)


def start_of_masses(problem: Mapping[str, Any], stored: Iterable[str]) -> dict[str, float]:
    """The masses that are of the state, each with the number at which it is tested."""
    return {name: problem["parameters"][name]["default"] or 1.0 for name in stored}


def _positive(x: object) -> bool:
    """Is it a positive number?"""
    return isinstance(x, (int, Fraction)) and x > 0


def _alike(m: Matrix) -> bool:
    """Is it a I + b (𝟙 − I), a on the diagonal and b ≠ 0 everywhere beside it, not of numbers?"""
    beside = {x for i, row in enumerate(m) for j, x in enumerate(row) if i != j}
    if len({row[i] for i, row in enumerate(m)}) != 1 or len(beside) != 1:
        return False
    return not dense.is_constant(m) and not m[0][1].is_zero


# What elimination divides by, where a symmetric matrix may be indefinite.
#
# The inverse is that of a product L D L̄ with rows in another order and pivots of one or two
# rows, chosen while code is emitted: by the values of the entries at points of a prime field,
# where a function that is 0 is told from one that is not.

PRIME = 2**61 - 1
POINTS = 2

Block = tuple[int, ...]
"""The rows of one pivot."""

Sampled = list[dict[tuple[int, int], int]]
"""The entries of a matrix at each point."""


class Pivots:
    """The pivots of a symmetric matrix, in the order of elimination.

    ``blocks``: their rows; ``sure``: is the matrix singular wherever a pivot is?
    """

    def __init__(self, m: Matrix):
        self.blocks: list[Block] = []
        self.sure = True
        rest = list(range(len(m)))
        points = [_at_a_point(m, Random(seed)) for seed in range(POINTS)]
        while rest:
            block, harmless = self._next(points, rest)
            self.blocks.append(block)
            self.sure = self.sure and harmless
            rest = [i for i in rest if i not in block]
            points = [_eliminated(x, block, rest) for x in points]

    @property
    def as_given(self) -> bool:
        """Is it each row in its place?"""
        return self.blocks == [(i,) for i in range(len(self.blocks))]

    def _next(self, points: Sampled, rest: Sequence[int]) -> tuple[Block, bool]:
        """The rows of the next pivot, and whether the matrix is singular wherever that is 0: a
        number, or of rows that are coupled to no other."""
        singles = [(i,) for i in rest if all(x[i, i] for x in points)]
        pairs = [*_pairs(points, rest)]
        alone = [b for b in (*singles[:1], *pairs) if not _coupled(points, b, rest)]
        known = [b for b in (*singles, *pairs) if len({_determinant(x, b) for x in points}) == 1]
        turned = [b for b in alone if len(b) == 2 and not all(points[0][i, i] for i in b)]
        if found := [*(b for b in alone if len(b) == 1), *known, *turned]:
            return found[0], True
        if found := [*singles, *pairs]:
            return found[0], False
        raise ZeroDivisionError("a matrix that is singular whatever the parameters")


def _coupled(points: Sampled, block: Block, rest: Sequence[int]) -> bool:
    """Is there another row with an entry in the columns of a pivot?"""
    others = [j for j in rest if j not in block]
    return any(x[i, j] for x in points for i in block for j in others)


def _pairs(points: Sampled, rest: Sequence[int]) -> Iterator[Block]:
    """Two coupled rows each, with a determinant that is not 0."""
    coupled = (b for b in combinations(rest, 2) if any(x[b] for x in points))
    return (b for b in coupled if all(_determinant(x, b) for x in points))


def _at_a_point(m: Matrix, random: Random) -> dict[tuple[int, int], int]:
    """The entries of a matrix where leaves and functions have random values."""
    values: dict[Node, int] = {}
    for x in reachable(y for row in m for y in row):
        values[x] = _value(x, [values[y] for y in x.args], random)
    return {(i, j): values[x] for i, row in enumerate(m) for j, x in enumerate(row)}


def _value(x: Node, args: Sequence[int], random: Random) -> int:
    """The value of a node by those of its operands."""
    match x.op:
        case "num":
            return int(x.data.numerator * pow(x.data.denominator, -1, PRIME) % PRIME)
        case "add":
            coefficients = (c.numerator * pow(c.denominator, -1, PRIME) for c in x.data)
            return int(sum(map(mul, coefficients, args)) % PRIME)
        case "mul":
            found = 1
            for y in args:
                found = found * y % PRIME
            return found
        case "value":
            return args[0]
        case "recip" if args[0]:
            return pow(args[0], -1, PRIME)
        case "recip":
            raise ZeroDivisionError("1/0 in the equations of this problem")
    return random.randrange(1, PRIME)


def _determinant(x: dict[tuple[int, int], int], block: Block) -> int:
    """The determinant of a pivot at a point."""
    return int(dense.determinant([[x[i, j] for j in block] for i in block]) % PRIME)


def _eliminated(
    x: dict[tuple[int, int], int], block: Block, rest: Sequence[int]
) -> dict[tuple[int, int], int]:
    """The entries that are left when the rows of a pivot are eliminated, at a point."""
    scale = pow(_determinant(x, block), -1, PRIME)
    pairs = [(a, b, scale * c % PRIME) for a, b, c in _adjugate(x, block)]
    return {
        (i, j): (x[i, j] - sum(x[i, a] * c % PRIME * x[b, j] for a, b, c in pairs)) % PRIME
        for i in rest
        for j in rest
    }


def _adjugate(x: dict[tuple[int, int], int], block: Block) -> list[tuple[int, int, int]]:
    """The entries of the adjugate of one or two rows, each after its two rows."""
    if len(block) == 1:
        return [(*block, *block, 1)]
    i, j = block
    return [(i, i, x[j, j]), (j, j, x[i, i]), (i, j, -x[i, j]), (j, i, -x[i, j])]


def solve(
    g: Graph, m: Matrix, blocks: Sequence[Block], right: Matrix, named: dense.NodeNamer
) -> tuple[Matrix, list[Node]]:
    """The matrix x with m x = ``right``, and the determinants of the pivots of m."""
    left = {(i, j): x for i, row in enumerate(m) for j, x in enumerate(row)}
    known = [list(row) for row in right]
    determinants: list[Node] = []
    inverses: list[Matrix] = []
    lower: dict[tuple[int, int], Node] = {}
    rest = list(range(len(m)))
    for block in blocks:
        rest = [i for i in rest if i not in block]
        own = tuple(tuple(left[i, j] for j in block) for i in block)
        place = "_".join(str(i + 1) for i in block)
        determinants.append(dense.determinant(own))
        over = named(f"r_{place}", g.recip(named(f"d_{place}", determinants[-1])))
        inverses.append(q.scaled(over, dense.adjugate(g, own)))
        for i in rest:
            (row,) = q.times(((*(left[i, j] for j in block),),), inverses[-1])
            for j, x in zip(block, row, strict=True):
                lower[i, j] = named(f"l_{i + 1}_{j + 1}", x)
            for k, column in enumerate(zip(*(known[j] for j in block), strict=True)):
                taken = [lower[i, j] * x for j, x in zip(block, column, strict=True)]
                known[i][k] = named(f"y_{i + 1}_{k + 1}", known[i][k] - g.sum(taken))
        for i, j in combinations_with_replacement(rest, 2):
            left[i, j] = left[j, i] = left[i, j] - g.sum(lower[i, k] * left[k, j] for k in block)
    for block, inverse in zip(reversed(blocks), reversed(inverses), strict=True):
        found = q.times(inverse, tuple(tuple(known[i]) for i in block))
        for i, row in zip(block, found, strict=True):
            terms = [[lower[k, i] * x for x in known[k]] for k in rest if (k, i) in lower]
            known[i] = [x - g.sum(column) for x, *column in zip(row, *terms, strict=True)]
        rest += block
    return tuple(map(tuple, known)), determinants
