"""Lowering: the recorded equations become matrices of scalar nodes.

A name is an input (state, parameter) or is looked up in the record, where the last equation with
that left side defines it; so the motion is the record's, not derived again.  Matrices stay
matrices: a product is formed whole, in the cheapest order, and its entries are named.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.rational import Matrix
from ..language.tree import Tree, mul
from ..language.values import OPERATIONS, wedge
from ..record.record import Derivation, step_of
from . import dense
from .ellipsoid import PLACES, SLACK, UNSEEN, half_angle, integral, tension
from .graph import PARAMETER, Graph, Node
from .inverses import SMALL, Inverses
from .naming import name_of
from .options import Options
from .program import LoweringError
from .reader import RecordReader, Value, bound, matrix, scalar


class Lowering:
    """The values, as nodes, of the trees of one record.

    ``reader``: what the names in them stand for; ``inverses``: those of matrices.
    """

    def __init__(self, d: Derivation, group: Group, options: Options, graph: Graph | None = None):
        self.graph, self.record = graph or Graph(), d
        self.reader = RecordReader(d, group, options, self.graph, self.tree)
        self.inverses = Inverses(self.reader)
        self._products = {  # that stand alone in the record's motion: their traces come free
            product
            for step in d.steps
            if step.rule == "solution"
            for equation in step.equations
            for product in standalone(equation.rhs)
        }

    @property
    def solving(self) -> bool:
        """Does the equation that is being read belong to the solved motion?"""
        return step_of(self.reader.label).endswith(".motion")

    def tree(self, t: Tree) -> Value:
        """The value of a tree: a node, or a matrix of nodes."""
        if t == "π":
            return self.graph.num(Fraction(math.pi))
        if isinstance(t, str):
            return self.reader.name(t)
        if isinstance(t, (int, Fraction)):
            return self.graph.num(t)
        if t in self.reader.memo:
            return self.reader.memo[t]
        value = self._node(t)
        if isinstance(value, Node) and t[0] in ("inner", "norm2", "metric"):
            value = self.graph.value(value, name_of(t), self.reader.label)
        self.reader.memo[t] = value
        return value

    def _node(self, t: tuple[Any, ...]) -> Value:
        """The value of an operator tree; ``LoweringError`` for an operator without code."""
        op = t[0]
        if op == "fun":
            found = self.graph.function(t[1], self._argument(t[2]))
            return self.graph.value(found, name_of(t), self.reader.label)
        if op == "par":  # a number of a force that has a name, or a parameter
            told = self.reader.record.definition(t)
            return self.reader.member(t) if told else self.graph.leaf(t[1], "parameter")
        if op == "call" and t[1] in PLACES:
            invariants = [self._number(x) for x in t[2:]]
            return integral(self.graph, t[1], invariants, self.reader.label)
        if op == "call":
            return self.reader.applied(t)
        if op == "at":
            return self.reader.member(t)
        if op == "sum":
            return self._sum(t)
        if op == "mul":
            return self._product(t)
        if op == "tr":
            return self._trace(t[1])
        if op == "inv":
            return self.inverses.of(t[1])
        if op in ("metric", "norm2"):
            return self._metric(t)
        if op == "wedge" and isinstance(t[1], tuple) and t[1][0] == "mul" and t[1][2:] == (t[2],):
            turned: Matrix = wedge(self._gyroscopic(t[1][1], t[2]), self._matrix(t[2]))
            return turned
        if op == "div" and (spring := tension(t)):
            return self._tension(*spring)
        if op == "entry":
            entry: Node = self._matrix(t[1])[t[2] - 1][t[3] - 1 if len(t) == 4 else 0]
            return entry
        return self._simple(op, [self.tree(x) for x in t[1:] if op != "pow" or x != t[2]], t)

    def _argument(self, t: Tree) -> Node:
        """That of a function; of atan2 on its half line not 0/0 but infinite."""
        half = half_angle(t)
        if half is None or not isinstance(t, tuple):
            return self._number(t)
        g = self.graph
        unseen = g.linear([(UNSEEN[self.reader.options.real], g.none(self._number(half)))])
        return g.product((self._number(t[1]) + unseen, g.recip(self._number(t[2]))))

    def _tension(
        self, factors: tuple[Tree, ...], distance: Tree, square: Tree, length: Tree
    ) -> Node:
        """The tension c(s − l)/s of a spring, as c − cl/s with s kept off 0 where l = 0."""
        g = self.graph
        c, q = g.product([self._number(x) for x in factors]), self._number(square)
        at_rest = self._number(length)
        slack = g.linear([(SLACK[self.reader.options.real], g.none(at_rest))])
        slack = g.value(slack, f"slack_{name_of(length)}", self.reader.label)
        s = g.value(g.function("sqrt", g.sum((q, slack))), name_of(distance), self.reader.label)
        return c - g.product((c, at_rest, g.recip(s)))

    def _simple(self, op: str, a: list[Any], t: tuple[Any, ...]) -> Value:
        """The value of an operator whose operands have the values ``a``."""
        g = self.graph
        if op == "add":
            if any(isinstance(x, Node) for x in a):
                return g.sum(map(scalar, a))
            return tuple(
                tuple(g.sum(entries) for entries in zip(*rows, strict=True))
                for rows in zip(*a, strict=True)
            )
        if op == "pow":
            return self._power(t, a[0])
        if op == "div":
            return g.product((a[0], g.recip(a[1])))
        if op == "one":
            return dense.numbers(g, q.identity(self.reader.n))
        if op == "inner":
            plain = any(isinstance(x, Node) for x in a)
            return g.product(map(scalar, a)) if plain else dense.dot(a[0], a[1])
        if op in ("T", "wedge", "hat", "matrix", "row"):
            found: Value = OPERATIONS[op](*a)
            return found
        if op == "tr":
            return dense.diagonal(g, a[0])
        if op == "det":
            found_det: Node = dense.determinant(a[0])
            return found_det
        if op == "bracket":
            return q.minus(q.times(*a), q.times(*reversed(a)))
        raise LoweringError(f"no code for the operator {op!r}")

    def _power(self, t: tuple[Any, ...], base: Value) -> Value:
        if isinstance(base, Node):
            factor = base if t[2] > 0 else self.graph.recip(base)
            return self.graph.product([factor] * abs(t[2]))
        value = dense.chain(self.graph, [base] * t[2], lambda m, i, j: m)
        return self.reader.entries(value, name_of(t))

    def _gyroscopic(self, metric: Tree, vector: Tree) -> Matrix:
        """M x for M x ∧ x: a multiple of 1 taken from M changes nothing, and leaves M_33 = 0.

        Of M = (Tr J) 1 − J all of Tr J is taken: in a slender body the sums J_jj + J_kk differ by
        less than their rounding.
        """
        m = self._matrix(metric)
        found = self.record.definition(metric)
        inside = untraced(found[1].rhs) if found else None
        light = q.scaled(-1, self._matrix(inside)) if inside else m
        if dense.is_diagonal(m):
            return q.times(light, self._matrix(vector))  # (M_j − M_k) x_j x_k, unnamed
        rows = tuple(
            tuple(x - light[2][2] if i == j else x for j, x in enumerate(row))
            for i, row in enumerate(light)
        )
        name = name_of(metric)
        lighter = self.reader.entries(rows, f"{name}_0") if dense.stage_of(m) == PARAMETER else m
        product = q.times(lighter, self._matrix(vector))
        return self.reader.entries(product, f"{name}_0_{name_of(vector)}")

    def _sum(self, t: tuple[Any, ...]) -> Value:
        """The value of a sum over an index: over the members that the record defines."""
        _, index, body = t
        terms = [self.tree(bound(body, {index: i})) for i in self.reader.members(body, index)]
        return self._simple("add", terms, t)

    def _product(self, t: tuple[Any, ...]) -> Value:
        """The value of a product of numbers and matrices."""
        solves = len(t) == 3 and t[1] == ("inv", "M")  # a linear system in coordinates
        if solves and (len(M := self._matrix("M")) > SMALL or dense.is_diagonal(M)):
            return self.inverses.solved("M", self._matrix(t[2]))
        if len(t) == 3 and is_adjugate(*t[1:]):
            return dense.adjugate(self.graph, self._matrix(t[1][1]))
        factors = [(x, self.tree(x)) for x in t[1:]]
        scalars = [v for _, v in factors if isinstance(v, Node)]
        matrices = [(x, v) for x, v in factors if not isinstance(v, Node)]
        if not matrices:
            return self.graph.product(scalars)
        whole = self._chain(matrices)
        if not scalars:
            return whole
        if len(whole) == 1 == len(whole[0]):
            return self.graph.product([*scalars, whole[0][0]])
        return q.scaled(self.graph.product(scalars), whole)

    def _chain(self, factors: list[tuple[Tree, Matrix]]) -> Matrix:
        """The named product of matrices; the same chain is computed once."""
        if len(factors) == 1:
            return factors[0][1]
        factors = [(x, self._operand(x, v)) for x, v in factors]
        trees = [x for x, _ in factors]
        key: Tree = ("mul", *trees)
        if key in self.reader.memo:
            return matrix(self.reader.memo[key])

        def named(m: Matrix, i: int, j: int) -> Matrix:
            return self.reader.entries(m, name_of(mul(*trees[i : j + 1])))

        value = dense.chain(self.graph, [v for _, v in factors], named)
        value = self.reader.entries(value, name_of(key))
        self.reader.memo[key] = value
        return value

    def _operand(self, t: Tree, value: Matrix) -> Matrix:
        """A factor of a matrix product: a sum gets a name, and is computed once."""
        if isinstance(t, tuple) and t[0] == "add":
            name = "balance" if self.solving else name_of(t)
            return self.reader.entries(value, name)
        return value

    def _trace(self, t: Tree) -> Node:
        """Tr of a tree: of a product its diagonal where that is wanted anyway, else Σ P_ij Q_ji."""
        g, name = self.graph, name_of(("tr", t))
        factors = [x for x in t[1:] if not is_scalar(x)] if isinstance(t, tuple) else []
        if isinstance(t, tuple) and t[0] == "mul" and len(factors) > 1:
            matrices = [(x, self._matrix(x)) for x in factors]
            scalars = [self._number(x) for x in t[1:] if is_scalar(x)]
            if any(dense.is_constant(v) for _, v in matrices):
                return g.product([*scalars, self._sparse_trace(matrices)])
            if ("mul", *factors) in self._products:
                traced = dense.diagonal(g, self._chain(matrices))
            else:
                half = len(matrices) // 2
                left, right = self._chain(matrices[:half]), self._chain(matrices[half:])
                traced = dense.dot(left, q.transposed(right))
            whole = g.product([*scalars, traced])
            return g.value(whole, name, self.reader.label)
        if isinstance(t, tuple) and t[0] == "pow" and t not in self._products and t[2] == 2:
            base = self._matrix(t[1])
            return g.value(dense.dot(base, q.transposed(base)), name, self.reader.label)
        # a bare trace has no name: in (Tr J)1 − J its terms must cancel before they are rounded
        return dense.diagonal(g, self._matrix(t))

    def _sparse_trace(self, factors: list[tuple[Tree, Matrix]]) -> Node:
        """Tr of a product with constant matrices: a sum over their entries that are not zero."""
        first = next(k for k, (_, v) in enumerate(factors) if dense.is_constant(v))
        turned = factors[first:] + factors[:first]
        constants: list[Matrix] = []
        runs: list[list[tuple[Tree, Matrix]]] = []
        for x, v in turned:
            if dense.is_constant(v):
                constants.append(v)
                runs.append([])
            else:
                runs[-1].append((x, v))
        between = [self._chain(run) if run else None for run in runs]
        return dense.sparse_trace(self.graph, constants, between)

    def _matrix(self, t: Tree) -> Matrix:
        return matrix(self.tree(t))

    def _number(self, t: Tree) -> Node:
        return scalar(self.tree(t))

    def _metric(self, t: tuple[Any, ...]) -> Value:
        """⟨a, M b⟩ or |a|², or the latter in a metric."""
        if t[0] == "norm2":
            if len(t) == 2:
                value = self._matrix(t[1])
                return dense.dot(value, value)
            t = ("metric", t[1], t[2], t[2])
        _, metric, a, b = t
        left, right = self._matrix(a), self._matrix(mul(metric, b))
        return dense.dot(left, right)


SCALARS = {"m", "θ", "t", "h̃", "Ũ", "L̃", "V_A", "p_V", "U_V", "I_1", "I_2", "I_3"}
SCALAR_OPERATORS = {"tr", "inner", "metric", "norm2", "det", "par", "entry", "fun"}


def untraced(t: Tree) -> Tree | None:
    """The tree J of (Tr J) 1 − J; ``None`` for any other tree."""
    match t:
        case ("add", ("mul", ("tr", inside), ("one",)), ("mul", -1, other)) if inside == other:
            found: Tree = inside
            return found
    return None


def is_adjugate(a: Tree, b: Tree) -> bool:
    """Is a b = (det x) x⁻¹?"""
    return isinstance(a, tuple) and a[0] == "det" and b == ("inv", a[1])


def is_scalar(t: Tree) -> bool:
    """Is a tree's value a number, whatever the sizes of the matrices in it?"""
    if isinstance(t, str):
        return t in SCALARS
    if isinstance(t, tuple):
        return t[0] in SCALAR_OPERATORS or (t[0] in ("inv", "pow", "div") and is_scalar(t[1]))
    return True


def standalone(t: Tree) -> Iterator[Tree]:
    """The matrix products and powers in a tree that are wanted whole, not only their traces."""
    if not isinstance(t, tuple):
        return
    if t[0] == "pow":
        yield t
    elif t[0] == "mul":
        yield ("mul", *(x for x in t[1:] if not is_scalar(x)))
    for part in t[1:]:
        inside = t[0] == "tr" and isinstance(part, tuple) and part[0] in ("mul", "pow")
        for x in part[1:] if inside else (part,):
            yield from standalone(x)
