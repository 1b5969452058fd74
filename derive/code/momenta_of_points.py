"""The same motion in momenta where points give the Lagrangian: Π_a, or ℓ_b, and p_b in the place of
ζ and w.

All is read from the steps ``by_momenta`` and ``poisson_tensor`` of the record, which say the
velocity by the momenta, and their rates.  In a product whose factors are seen from their centres of
mass ζ is found as the acceleration is: M, on Z(1 + S), from what the momenta leave on E_a(1 − S).
"""

from __future__ import annotations

from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..language.tree import Tree, nodes
from ..record.record import Derivation, Equation
from . import dense
from .graph import Node
from .lower import Lowering
from .naming import ascii_name, name_of
from .options import Options
from .reader import bound, matrix, scalar

RULES = ("inversion", "Poisson tensor")
"""The rules of the steps that tell the motion by momenta."""


class MomentaOfPoints:
    """The functions in momenta of a record: the ``momenta`` at a state; by the momenta ``own`` of
    y the ``velocity``, then ``rates`` and ``tensor``."""

    def __init__(self, lowering: Lowering, group: Group, options: Options):
        self.lowering, self.group, self.graph = lowering, group, lowering.graph
        self.turns, self.spin = len(group.linear_basis), "ℓ_b" if group.turns_space else ""
        names = [suffixed("Pi", a) for a in range(1, self.turns + 1)]
        names += [suffixed("p", i) for i in range(1, group.dimension - self.turns + 1)]
        self.own = [self.graph.leaf(x, "state") for x in names]
        self.after = Lowering(lowering.record, group, options, self.graph)
        self.momenta = self._read(lowering, "ℓ_b", "Π", "p_b")
        self.velocity = self._velocity()
        self.rates = self._read(self.after, "ℓ̇_b", "Π̇", "ṗ_b")
        self.tensor = self._tensor()

    def _read(self, lowering: Lowering, spin: str, family: str, push: str) -> list[Node]:
        """The numbers of a momentum, or of its rate, by the record."""
        if self.spin:
            found = column(lowering.reader.vector(spin))
        else:
            found = [self._on_basis(lowering, family, a + 1) for a in range(self.turns)]
        return found + (column(lowering.reader.vector(push)) if self.group.affine else [])

    def _on_basis(self, lowering: Lowering, family: str, a: int) -> Node:
        """Π_a or its rate, by the equation for any a."""
        key, e = self._equation(("at", family, "a"))
        lowering.reader.label = key
        value = scalar(lowering.tree(bound(e.rhs, {"a": a})))
        return self.graph.value(value, suffixed(ascii_name(family), a), key, recorded=True)

    def _equation(self, lhs: Tree) -> tuple[str, Equation]:
        """The equation with this left side in the steps that tell the motion by momenta."""
        return next(x for x in told(self.lowering.record) if x[1].lhs == lhs)

    def _velocity(self) -> list[Node]:
        """The coordinates of the velocity, by which the equations of the record are then read."""
        turning, pushing = self.own[: self.turns], self.own[self.turns :]
        reader, state = self.after.reader, self.after.reader.state
        if self.group.affine:
            state["p_b"] = q.column(pushing)
        if self.spin:
            state[self.spin] = q.column(turning)
        else:
            reader.memo |= {("at", "Π", a): x for a, x in enumerate(turning, 1)}
            if BRACKET in nodes(self._equation(RATE)[1].rhs):
                state["Π"] = self._covector(turning)
        if self.group.centred:
            self._set("ζ", "", self._seen_from_centres())
        for key, e in told(self.lowering.record, "inversion"):
            if isinstance(e.lhs, str):
                reader.label = key
                self._set(e.lhs, key, matrix(self.after.tree(e.rhs)))
        names = ("ζ", "w") if self.group.affine else ("ζ",)
        return [x for name in names for x in column(matrix(state[name]))]

    def _set(self, name: str, key: str, value: Matrix) -> None:
        """Let a name stand for a value; with Z also its coordinates."""
        reader, called = self.after.reader, {"ζ": "velocity", "w": "shift"}.get(name, name_of(name))
        reader.label = key
        reader.state[name] = named = reader.entries(value, called, recorded=True)
        if name == "Z":
            whole = q.bordered(
                named, q.column([self.graph.num(0)] * self.group.n), self.graph.num(0)
            )
            whole = whole if self.group.affine else named
            self._set("ζ", key, q.column(self.after.reader.space.read(whole)[: self.turns]))

    def _covector(self, values: list[Node]) -> Matrix:
        """A matrix that gives these values on the linear parts of the basis."""
        span, terms = range(self.group.n), dict[tuple[int, int], list[tuple[Any, Node]]]()
        for a, x in enumerate(values):
            for c, i, j in self.group.coordinate_terms(a):
                terms.setdefault((i, j), []).append((c, x))
        return tuple(tuple(self.graph.linear(terms.get((i, j), ())) for j in span) for i in span)

    def _seen_from_centres(self) -> Matrix:
        """ζ by M on Z(1 + S), from the momenta on E_a(1 − S)."""
        reader = self.after.reader
        S, one = reader.vector("S"), dense.numbers(self.graph, q.identity(self.group.n))
        seen = q.minus(one, S)
        Pi = q.times(matrix(reader.state["Π"]), q.transposed(seen))
        basis = [dense.numbers(self.graph, e) for e in self.group.basis]
        loads = tuple((dense.dot(Pi, e),) for e in basis)
        central = column(self.after.inverses.solved("M", loads))
        Z = q.times(reader.space.hat(central), seen)
        return q.column(reader.space.read(Z))

    def _tensor(self) -> list[list[Node]]:
        """The brackets of the momenta: the record's 𝕁, or by 𝕁_ab = ⟨Π, [E_b, E_a]⟩ on the whole
        basis."""
        if self.spin:
            return [[*row] for row in self.after.reader.vector("𝕁")]
        return [[self._bracket(a, b) for b in self.group.basis] for a in self.group.basis]

    def _bracket(self, a: Matrix, b: Matrix) -> Node:
        """⟨Π, [b, a]⟩, by coordinates."""
        found = self.group.nearest(q.minus(q.times(b, a), q.times(a, b)))
        return self.graph.linear(zip(found, self.own, strict=True))


RATE: Tree = ("at", "Π̇", "a")
BRACKET: Tree = ("bracket", "Z", ("at", "E", "a"))


def told(d: Derivation, *rules: str) -> list[tuple[str, Equation]]:
    """The equations of the steps that tell the motion by momenta, with their keys."""
    steps = [x for x in d.steps if x.rule in (rules or RULES)]
    return [(x.key(e), e) for x in steps for e in x.equations]


def column(m: Matrix) -> list[Node]:
    """The entries of a column."""
    return [x for (x,) in m]
