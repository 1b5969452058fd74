"""Equations of the record of the discrete motion, as nodes: what their letters are put to.

A record is about three elements g₀, g₁, g₂.  A step sees the half of each equation that has g₁ and
g₂, which is Θ⁻, what is to be solved for, and that with g₀ and g₁, which is Θ⁺, what it gives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, names
from ...record.record import Derivation
from .. import dense
from ..graph import Graph, Node
from ..lower import Lowering
from ..reader import Value, matrix, scalar
from ..state import StateSpace

SHARED = ("J", "c", "m", "J_c", "I", "I_c")
"""What the motion in time has, too."""

Given = Mapping[Tree, Any]
"""Letters, or other trees, and what they are put to."""

NONE: Given = {}

STEP = "step"
"""The kind of the leaves that a step has beside those of the state."""


@dataclass
class Ends:
    """The letters of the discrete record of a problem: ``motion``, the lowering of its motion in
    time, whose state and constants the step shares."""

    motion: Lowering
    record: Derivation

    def __post_init__(self) -> None:
        reader = self.motion.reader
        self.lowering = Lowering(self.record, reader.group, reader.options, self.graph)
        own, d = self.lowering.reader, self.record.problem
        known = (x for x in SHARED if self.motion.record.definition(x) is not None)
        own.state |= {x: reader.name(x) for x in known}
        own.state |= {x: v for x, v in self.space.values.items() if x in ("A", "T")}
        g = self.space.element
        self.h = self.graph.leaf("h", STEP)
        own.state |= {"g_1": g, "A_1": self.space.values["A"], "h": self.h}
        if reader.covector:
            own.state["u"] = q.column([x for part in ("u", "f_u") for x in self._given(part)])
        if self.group.affine:
            own.state["T_1"] = self.space.values["T"]
        places = [*d.get("body", {}).get("points", ()), *d.get("places", ())]
        for i in range(1, len(places) + 1):  # A r_i, with T where there is one
            moved = ("call", ("at", "r", i), "t")
            own.memo[moved] = reader.applied(moved)  # as in the rates, by the same nodes

    def _given(self, part: str) -> list[Node]:
        """The numbers of a covector that is given, in the basis of the record."""
        state = self.motion.reader.state
        return [x for (x,) in matrix(state[part])] if part in state else []

    @property
    def graph(self) -> Graph:
        """That of the motion in time."""
        return self.motion.graph

    @property
    def space(self) -> StateSpace:
        """The state."""
        return self.motion.reader.space

    @property
    def group(self) -> Group:
        """The group in the basis that the file states."""
        return self.space.group

    def has(self, step: str) -> bool:
        """Is there a step of this name about the group itself?"""
        return any(x.label == f"{self.record.name}.{step}" for x in self.record.steps)

    def equation(self, step: str, lhs: Tree) -> Tree:
        """The right side of the equation of a step of the group that has this left side; what is
        lowered next has its label."""
        own = self.record[f"{self.record.name}.{step}"]
        found = next(x for x in own.equations if x.lhs == lhs)
        self.label = own.key(found)
        return found.rhs

    def axis(self, step: str, lhs: Tree) -> Tree:
        """The same of an equation that says of a skew matrix what vector it is."""
        found = self.equation(step, lhs)
        assert isinstance(found, tuple)
        assert found[0] == "hat"
        turned: Tree = found[1]
        return turned

    @property
    def label(self) -> str:
        """The key of the equation that what is lowered comes from."""
        return self.lowering.reader.label

    @label.setter
    def label(self, key: str) -> None:
        self.lowering.reader.label = key

    def invert(self, name: str) -> None:
        """Have the inverse of what the motion in time has, too, by its nodes and tests."""
        self.lowering.reader.memo["inv", name] = self.motion.tree(("inv", name))

    def value(self, t: Tree, given: Given = NONE) -> Value:
        """The value of a tree where some letters, or other parts of it, have these values."""
        reader = self.lowering.reader
        state, memo = reader.state, reader.memo
        reader.state = {**state, **{x: y for x, y in given.items() if isinstance(x, str)}}
        reader.memo = {**memo, **{x: y for x, y in given.items() if not isinstance(x, str)}}
        found = self.lowering.tree(t)
        reader.state, reader.memo = state, memo
        return found

    def matrix(self, t: Tree, given: Given = NONE) -> Matrix:
        """The same of a matrix, or a vector."""
        return matrix(self.value(t, given))

    def number(self, t: Tree, given: Given = NONE) -> Node:
        """The same of a number."""
        return scalar(self.value(t, given))

    def leaves(self, name: str, count: int) -> list[Node]:
        """New leaves, counted from 1."""
        return [self.graph.leaf(f"{name}_{i}", STEP) for i in range(1, count + 1)]

    def zero(self, m: Matrix) -> Matrix:
        """0, of the shape of a matrix."""
        return tuple(tuple(self.graph.num(0) for _ in row) for row in m)

    @property
    def one(self) -> Node:
        """The number 1."""
        return self.graph.num(1)

    def named(self, m: Matrix, name: str) -> Matrix:
        """The matrix, or column, with its entries named."""
        return dense.entrywise(m, name, self.graph.value, len(m[0]) == 1)

    def entries(self, linear: Matrix, shift: Matrix) -> list[Node]:
        """What the state has of a change of g."""
        return self.space.entries(self.space.homogeneous(linear, shift))

    def coordinates(self, linear: Matrix, shift: Matrix) -> list[Node]:
        """The coordinates of a Z of these parts, in the stated basis."""
        return self.space.read(self.space.homogeneous(linear, shift))


class Centre:
    """The centre of mass of an affine group, by the steps ``centre`` and ``translation``: R, which
    moves by itself; nothing on a linear group."""

    def __init__(self, ends: Ends):
        self.ends, self.size = ends, ends.group.n if ends.group.affine else 0

    def varied(self, linear: Matrix, shift: Matrix) -> Matrix:
        """The change of R with such changes of A and T."""
        e = self.ends
        return (
            e.matrix(e.equation("centre", "R_1"), {"A_1": linear, "T_1": shift})
            if self.size
            else ()
        )

    def push(self) -> Matrix:
        """The acceleration of R."""
        e = self.ends
        if not self.size:
            return ()
        none: Matrix = tuple((e.graph.num(0),) for _ in range(self.size))
        given: Given = {"R_0": none, "R_1": none, "h": e.one}
        return e.matrix(e.equation("translation", "R_2"), given)

    def shift(self, moved: Matrix, linear: Matrix) -> Matrix:
        """The change of T with such changes of R and A."""
        if not self.size:
            return ()
        none = self.ends.zero(self.ends.space.values["T"])
        return q.minus(moved, self.varied(linear, none))


def has(t: Tree, *letters: str) -> bool:
    """Does a tree have one of these letters in it?"""
    return not {*letters}.isdisjoint(names(t))
