"""Scalar expressions as a graph: every distinct value is one node; rewriting of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from ..language.limits import OPERANDS
from ..language.rational import root
from .program import LoweringError

PARAMETER, STATE = 0, 1


@dataclass(frozen=True, eq=False)
class Node:
    """One value: an operation on other nodes, a number, a leaf, or a node with a name.

    ``op`` is one of num, leaf, add, mul, recip, abs, none, fun, value; ``data``: the number, the
    leaf's (kind, name), the coefficients of a sum, or the elementary function's name, for which
    "abs" is one: the operation abs is the size of a rounding error.
    """

    graph: Graph
    id: int
    op: str
    data: Any
    args: tuple[Node, ...]
    stage: int

    def __add__(self, other: Node | int | Fraction) -> Node:
        return self.graph.sum([self, self.graph.of(other)])

    __radd__ = __add__

    def __neg__(self) -> Node:
        return self.graph.linear([(Fraction(-1), self)])

    def __sub__(self, other: Node | int | Fraction) -> Node:
        return self + (-self.graph.of(other))

    def __mul__(self, other: Node | int | Fraction) -> Node:
        return self.graph.product([self, self.graph.of(other)])

    __rmul__ = __mul__

    def __rtruediv__(self, other: int | Fraction) -> Node:
        return self.graph.product([self.graph.of(other), self.graph.recip(self)])

    def __pow__(self, n: int) -> Node:
        return self.graph.product([self if n > 0 else self.graph.recip(self)] * abs(n))

    @staticmethod
    def dot(a: Iterable[Node], b: Iterable[Node]) -> Node:
        """Σ a_i b_i, one sum: so products of matrices are those of :mod:`rational`."""
        pairs = [*zip(a, b, strict=True)]
        return pairs[0][0].graph.sum(x * y for x, y in pairs if not (x.is_zero or y.is_zero))

    @property
    def is_zero(self) -> bool:
        """Is it the number 0?"""
        return self.op == "num" and self.data == 0

    @property
    def split(self) -> tuple[Fraction, Node]:
        """The node as rational · node."""
        if self.op == "add" and len(self.args) == 1:
            return self.data[0], self.args[0]
        return Fraction(1), self

    @property
    def is_atom(self) -> bool:
        """A number or a leaf: nothing to compute."""
        return self.op in ("num", "leaf")


class Graph:
    """The interned nodes of one program, and the names of its values."""

    def __init__(self) -> None:
        self._nodes: dict[tuple[Any, ...], Node] = {}
        self._operands = 0
        self.titles: dict[Node, tuple[str, str, bool]] = {}
        """Value node → name, label of its equation, and whether the record gave the name."""

    def _intern(self, op: str, data: Any, args: tuple[Node, ...], stage: int) -> Node:
        key = (op, data, *(a.id for a in args))
        if key not in self._nodes:
            self._operands += len(args)
            if self._operands > OPERANDS:
                raise LoweringError(
                    f"the code would have more than {OPERANDS} operands, too many for compilers; "
                    "leave out --jacobian, or give numbers for parameters, or take a smaller group"
                )
            self._nodes[key] = Node(self, len(self._nodes), op, data, args, stage)
        return self._nodes[key]

    def num(self, value: int | Fraction) -> Node:
        """The node of a rational number."""
        return self._intern("num", Fraction(value), (), PARAMETER)

    def of(self, x: Node | int | Fraction) -> Node:
        """The node itself, or the node of a number."""
        return x if isinstance(x, Node) else self.num(x)

    def leaf(self, name: str, kind: str) -> Node:
        """A leaf; ``kind``: state, time, input, parameter, or frame (of the principal frame)."""
        stage = PARAMETER if kind in ("parameter", "frame") else STATE
        return self._intern("leaf", (kind, name), (), stage)

    def value(self, node: Node, name: str, label: str = "", *, recorded: bool = False) -> Node:
        """The node under a name; a name that the record has (``recorded``) replaces one made up."""
        if node.is_atom or (node.op == "add" and node.data == (-1,) and node.args[0].is_atom):
            return node  # −L is no name of its own, so that it cancels L
        value = node if node.op == "value" else self._intern("value", None, (node,), node.stage)
        if value not in self.titles or (recorded and not self.titles[value][2]):
            self.titles[value] = (name, label, recorded)
        return value

    def recip(self, x: Node, *, late: bool = False) -> Node:
        """1 / x; ``late``: never in the constants, which are finite where x is 0."""
        if x.is_zero:
            raise ZeroDivisionError("1/0 in the equations of this problem")
        if x.op == "num":
            return self.num(1 / x.data)
        coefficient, core = x.split
        stage = STATE if late else core.stage
        return self.linear([(1 / coefficient, self._intern("recip", None, (core,), stage))])

    def has_reciprocal(self, x: Node) -> bool:
        """Is 1 / x in the graph, which is then not finite where x is 0?"""
        return ("recip", None, x.id) in self._nodes

    def function(self, name: str, *x: Node) -> Node:
        """An elementary function (``name``) of x, or an integral of several; √(y²) as |y|.

        In the constants, whose sizes are those of tests for 0, it is a root.
        """
        if name == "exp" and x[0].is_zero:
            return self.num(1)
        if name == "sqrt" and x[0].stage == STATE and (y := self._root(x[0])):
            return self.function("abs", y)
        if name == "abs":
            coefficient, y = x[0].split
            return self.linear([(abs(coefficient), self._intern("fun", name, (y,), y.stage))])
        return self._intern("fun", name, x, max(y.stage for y in x))

    def _root(self, x: Node) -> Node | None:
        """A node y with y² = x, if x is a number times such powers; else ``None``."""
        if x.op == "value":
            return self._root(x.args[0])
        if x.op == "num":
            found = root(x.data)
            return None if found is None else self.num(found)
        if x.op == "add" and len(x.args) == 1:
            halves = [self._root(self.num(x.data[0])), self._root(x.args[0])]
        elif x.op == "mul":
            counts = Counter(x.args)
            halves = [y for y, k in counts.items() for _ in range(k // 2)]
            halves += [self._root(y) for y, k in counts.items() if k % 2]
        else:
            return None
        return None if None in halves else self.product(y for y in halves if y)

    def none(self, x: Node) -> Node:
        """The indicator of x = 0: 1 where x is 0, else 0."""
        return (
            self.num(int(x.is_zero)) if x.op == "num" else self._intern("none", None, (x,), x.stage)
        )

    def absolute(self, x: Node) -> Node:
        """|x|."""
        return self.num(abs(x.data)) if x.op == "num" else self._intern("abs", None, (x,), x.stage)

    def magnitude(self, x: Node) -> Node:
        """The sum of the sizes of a node's terms: the scale of its rounding error."""
        if x.op == "num":
            return self.num(abs(x.data))
        if x.op == "add":
            terms = zip(x.data, x.args, strict=True)
            return self.linear((abs(c), self.magnitude(y)) for c, y in terms)
        if x.op == "mul":
            # a square needs no absolute value
            odd = [y for y, k in Counter(x.args).items() if k % 2]
            even = [y for y, k in Counter(x.args).items() for _ in range(k - k % 2)]
            return self.product([*even, *(self.magnitude(y) for y in odd)])
        if x.op == "value" and x.args[0].op in ("add", "mul"):
            return self.magnitude(x.args[0])
        return self.absolute(x)

    def sum(self, nodes: Iterable[Node]) -> Node:
        """The sum of the nodes."""
        return self.linear((Fraction(1), x) for x in nodes)

    def linear(self, terms: Iterable[tuple[Fraction, Node]]) -> Node:
        """The sum Σ c · x, flattened; a common rational factor is taken out in front."""
        totals: dict[Node, Fraction] = {}
        constant = Fraction(0)
        for c, x in terms:
            for k, y in self._terms(c, x):
                if y.op == "num":
                    constant += k * y.data
                else:
                    totals[y] = totals[y] + k if y in totals else k
        parts = [(c, x) for x, c in sorted(totals.items(), key=lambda i: i[0].id) if c]
        parts = self._collected(parts)
        if constant:
            parts.append((constant, self.num(1)))
        if not parts:
            return self.num(0)
        if len(parts) == 1 and parts[0][1].op == "num":
            return self.num(parts[0][0])
        content = _content([c for c, _ in parts])
        if content == 1:
            return self._sum_of(parts)
        core = self._sum_of([(c / content, x) for c, x in parts])
        return self._intern("add", (content,), (core,), core.stage)

    def _terms(self, c: Fraction, x: Node) -> list[tuple[Fraction, Node]]:
        """The terms of c x, sums in it opened."""
        if x.op != "add":
            return [(c, x)]
        return [
            term
            for k, y in zip(x.data, x.args, strict=True)
            for term in (self._terms(c * k, y) if y.op == "add" else [(c * k, y)])
        ]

    def _collected(self, parts: list[tuple[Fraction, Node]]) -> list[tuple[Fraction, Node]]:
        """The terms with a x + b x = (a + b) x for a, b of the parameters alone, x not."""
        alike: dict[tuple[Node, ...], list[tuple[Fraction, Node]]] = {}
        for c, x in parts:
            factors = x.args if x.op == "mul" else (x,)
            moving = tuple(y for y in factors if y.stage != PARAMETER)
            alike.setdefault(moving or (x,), []).append((c, x))
        if len(alike) == len(parts):
            return parts
        found: list[tuple[Fraction, Node]] = []
        for moving, terms in alike.items():
            if len(terms) == 1:
                found += terms
                continue
            fixed = self.linear(
                (c, x.args[0] if x.op == "mul" and x.args[0].stage == PARAMETER else self.num(1))
                for c, x in terms
            )
            found += self._terms(Fraction(1), self.product([fixed, *moving]))
        return sorted(((c, x) for c, x in found if not x.is_zero), key=lambda i: i[1].id)

    def _sum_of(self, parts: list[tuple[Fraction, Node]]) -> Node:
        """The sum of collected terms; what depends on parameters alone becomes one term."""
        if len(parts) == 1 and parts[0][0] == 1:
            return parts[0][1]
        fixed = [(c, x) for c, x in parts if x.stage == PARAMETER]
        moving = [(c, x) for c, x in parts if x.stage != PARAMETER]
        if len(fixed) > 1 and moving:
            parts = [(Fraction(1), self.linear(fixed)), *moving]
        coefficients = tuple(c for c, _ in parts)
        args = tuple(x for _, x in parts)
        return self._intern("add", coefficients, args, max(x.stage for x in args))

    def product(self, nodes: Iterable[Node]) -> Node:
        """The product of the nodes, flattened; what depends on parameters alone is one factor."""
        coefficient = Fraction(1)
        factors: list[Node] = []
        for x in nodes:
            k, core = x.split
            coefficient *= k
            if core.op == "num":
                coefficient *= core.data
            else:
                factors.extend(core.args if core.op == "mul" else (core,))
        if not coefficient:
            return self.num(0)
        if not factors:
            return self.num(coefficient)
        return self.linear([(coefficient, self._product_of(factors))])

    def _product_of(self, factors: list[Node]) -> Node:
        fixed = sorted((x for x in factors if x.stage == PARAMETER), key=lambda x: x.id)
        moving = sorted((x for x in factors if x.stage != PARAMETER), key=lambda x: x.id)
        if len(fixed) > 1 and moving:
            fixed = [self._intern("mul", None, tuple(fixed), PARAMETER)]
        args = (*fixed, *moving)
        return args[0] if len(args) == 1 else self._intern("mul", None, args, args[-1].stage)


def _content(coefficients: list[Fraction]) -> Fraction:
    """The rational factor common to the coefficients of a sum, negative where all of them are."""
    if all(c == 1 for c in coefficients):  # as most are
        return Fraction(1)
    common = Fraction(
        gcd(*(c.numerator for c in coefficients)), lcm(*(c.denominator for c in coefficients))
    )
    if len({abs(c) for c in coefficients}) > 1:
        common = Fraction(1)  # ½a + b stays as it is
    negative = all(c < 0 for c in coefficients)
    return -common if negative else common


# Rewriting of a graph: operands first, then what they stand in.

Image = Callable[[Node], Node]
"""What became of a node under a rewriting; the node itself, where nothing did."""

Rule = Callable[[Node, Image], Node]
"""What becomes of a node, by the images of its operands."""


def operands(x: Node) -> Sequence[Node]:
    """The nodes that a node is computed from."""
    return x.args


def reachable(
    roots: Iterable[Node], within: Callable[[Node], Iterable[Node]] = operands
) -> list[Node]:
    """The nodes that some nodes are computed from, these included, operands first.

    ``within``: the operands of a node that are looked at.
    """
    seen: set[Node] = set()
    stack = list(roots)
    while stack:
        x = stack.pop()
        if x not in seen:
            seen.add(x)
            stack.extend(within(x))
    return sorted(seen, key=lambda x: x.id)


def rewritten(
    roots: Sequence[Node],
    order: Iterable[Node],
    rule: Rule,
    known: Mapping[Node, Node] | None = None,
) -> list[Node]:
    """The images of ``roots`` when the nodes in ``order``, operands first, follow the rule.

    ``known``: nodes whose image is given already.
    """
    found = dict(known or {})

    def image(x: Node) -> Node:
        return found.get(x, x)

    for x in order:
        if x not in found:
            found[x] = rule(x, image)
    return [image(x) for x in roots]


def remade(x: Node, image: Image) -> Node:
    """The same operation on the images of the operands, under the same name if it has one."""
    g, args = x.graph, [image(y) for y in x.args]
    if all(a is b for a, b in zip(args, x.args, strict=True)):
        return x
    if x.op == "value":
        name, label, recorded = g.titles[x]
        return g.value(args[0], name, label, recorded=recorded)
    if x.op == "add":
        return g.linear(zip(x.data, args, strict=True))
    if x.op == "mul":
        return g.product(args)
    if x.op == "fun":
        return g.function(x.data, *args)
    return {"recip": g.recip, "none": g.none, "abs": g.magnitude}[x.op](args[0])


def replaced(x: Node, images: Mapping[Node, Node]) -> Node:
    """The node with images in place of some nodes; names are left behind."""

    def nameless(y: Node, image: Image) -> Node:
        return image(y.args[0]) if y.op == "value" else remade(y, image)

    return rewritten([x], reachable([x]), nameless, images)[0]
