"""What a motion keeps, as functions of its state.

A quantity is a tree in the momenta Π_a on the basis of 𝔤, the energy h̃, the time, parameters, and
the entries of g as a matrix that acts on (r, 1); or of Γ, where the state has no g.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..language.tree import Tree, add, fold, mul
from ..language.values import OPERATIONS
from . import dense
from .graph import Node
from .linearise import Varied
from .lower import Lowering
from .reader import matrix, scalar
from .velocity_in_space import BACK, IN_SPACE, has_velocity, in_space


class Kept:
    """The values of such quantities, as nodes of the graph of one program."""

    def __init__(self, lowering: Lowering):
        self.lowering, self.reader = lowering, lowering.reader
        self.graph, self.space = lowering.graph, lowering.reader.space
        self.energy = self.reader.number("h̃")
        self.push = self._push()
        self.momenta = self._momenta()
        self.names: dict[str, Any] = {x: lowering.tree(x) for x in ("t", "π")}
        self.names["h̃"] = self.energy
        if "A" in self.space.values:
            self.names["A"] = self.space.element

    def of(self, quantities: Mapping[str, Tree]) -> list[Node]:
        """The values of the quantities, in their order."""
        return [self.value(t) for t in quantities.values()]

    def value(self, t: Tree) -> Node:
        """The value of one quantity."""
        found: Node = fold(self._at)(in_space(t) if self.push else t)
        return found

    def _push(self) -> Matrix:
        """ν𝕁, the matrix p with p̃(δg) = Tr p δḡ of points where C does not drop out; else empty.

        (n, n), or (n, n + 1) of affine maps.
        """
        found = self.reader.record.definition("h̃")
        if found is None or not has_velocity(found[1].rhs):
            return ()
        nu, tau = self.space.velocity_names
        rows = q.transposed(self._matrix(("mul", "J", ("T", nu))))
        if self.space.group.affine:
            rows = q.plus(rows, self._matrix(("mul", tau, ("T", "c"))))
            last = self._matrix(add(mul(nu, "c"), mul("m", tau)))
            rows = tuple((*row, *x) for row, x in zip(rows, last, strict=True))
        return self._named(rows, "push")

    def _matrix(self, t: Tree) -> Matrix:
        return matrix(self.lowering.tree(t))

    def _named(self, m: Matrix, name: str) -> Matrix:
        return dense.entrywise(m, name, lambda x, y: self.graph.value(x, y, ""), column=False)

    def _body_momentum(self, a: int) -> Node:
        """Π_a = p̃(gE_a)."""
        moved = q.times(self.space.element, self.space.member(a))
        found = dense.dot(self.push, moved[: len(self.push)])
        return self.graph.value(found, f"momentum_{a + 1}", "")

    @cached_property
    def _in_space(self) -> Matrix:
        """ν𝕁ḡ, the matrix p with p̃(Yg) = Tr p Ȳ."""
        g = self.space.element
        return self._named(q.times(self.push, q.transposed(g)), "space_momentum")

    def _momenta(self) -> tuple[Node, ...]:
        """Π_a = ∂L̃/∂ζ_a: the record's, or of points, where L̃ + Ũ is a square, ∂h̃/∂ζ_a."""
        span = range(self.space.group.dimension)
        if self.push:
            return tuple(self._body_momentum(a) for a in span)
        if "lagrangian" in self.reader.record.problem:
            return tuple(scalar(self.reader.member(("at", "Π", a + 1))) for a in span)
        slopes = (Varied(self.graph, self.space.faster(a), f"zeta_{a + 1}") for a in span)
        found = [self._opened(x.of(self.energy)) for x in slopes]
        return tuple(self.graph.value(x, f"momentum_{a}", "") for a, x in enumerate(found, 1))

    def _opened(self, x: Node) -> Node:
        """A sum as one of its summands, in which the two derivatives of a square meet."""
        if x.op == "value":
            return self._opened(x.args[0])
        if x.op != "add":
            return x
        return self.graph.linear((c, self._opened(y)) for c, y in zip(x.data, x.args, strict=True))

    def _at(self, t: Tree, *parts: Any) -> Any:
        """The value of a tree by those of its operands: a node, or a matrix of nodes."""
        if isinstance(t, (int, Fraction)):
            return self.graph.num(t)
        if isinstance(t, str):
            return self.names.get(t)  # none of a head of members, as Π
        if t == BACK:
            return self._inverse()
        match t:
            case ("par", name):
                return self.graph.leaf(name, "parameter")
            case ("at", "Π", int(a)):
                return self.momenta[a - 1]
            case ("entry", "A", int(i), int(j)):
                return self.names["A"][i - 1][j - 1]
            case ("entry", "Γ", int(i)):
                return self.space.values["Γ"][i - 1][0]
            case ("fun", name, _):
                return self.graph.function(name, parts[0])
            case ("pow", _, int(n)):
                x = parts[0] if n > 0 else self.graph.recip(parts[0])
                return self.graph.product([x] * abs(n))
            case ("div", _, below):  # a length may be 0, with which the constants are finite still
                if isinstance(below, tuple) and below[:2] == ("fun", "sqrt"):
                    length = self.graph.value(parts[1], "length", "")
                    return self.graph.product((parts[0], self.graph.recip(length, late=True)))
                return self.graph.product((parts[0], self.graph.recip(parts[1])))
            case ("inner", head, _) if head == IN_SPACE:
                Y = parts[1][: len(self.push)]
                return dense.dot(self._in_space, Y)
            case ("inner", "Π", _):
                coordinates = self.space.group.nearest(parts[1])
                terms = zip(self.momenta, coordinates, strict=True)
                return self.graph.sum([self.graph.product(x) for x in terms])
        return OPERATIONS[t[0]](*parts)

    def _inverse(self) -> Matrix:
        """g⁻¹."""
        space = self.space
        if not space.group.affine:
            return space.inverse
        shift = q.scaled(Fraction(-1), q.times(space.inverse, space.values["T"]))
        return q.bordered(space.inverse, shift, self.graph.num(1))
