"""The same motion in momenta: the functions of ``--momenta``, and where points give L."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
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
from .naming import ClaimedNames, ascii_name, name_of
from .options import Options
from .program import refuse_first
from .reader import RecordReader, bound, matrix, scalar

OF_Y = ("velocity", "velocity_step", "momentum_rhs", "momentum_rates", "poisson")
"""The functions that take y."""

Places = Mapping[Node, tuple[str, tuple[str, int]]]


@dataclass(frozen=True)
class MomentumState:
    """``wanted``: function → its outputs; ``names``: those of y; ``leaves``: its momenta, by the
    index that they have in it; ``size``: the variables of 𝕁."""

    wanted: Mapping[str, list[Node]]
    names: tuple[str, ...]
    leaves: Mapping[int, Node]
    size: int

    def places(self, moving: Places, names: ClaimedNames) -> Places:
        """Where numbers are read by what takes y, and x for the velocity alone; ``moving``: where
        by what takes x."""
        found = {
            leaf: (name, ("y", i) if array == "x" and i not in self.leaves else (array, i))
            for leaf, (name, (array, i)) in moving.items()
        }
        own = {
            leaf: (names.claim(leaf.data[1], " ".join(leaf.data)), ("y", i))
            for i, leaf in self.leaves.items()
        }
        return found | own


def sentences(d: Derivation, state: MomentumState) -> list[str]:
    """What a reader of the emitted files must know of them."""
    carried = [x["name"] for x in d.problem.get("advected", ())]
    variables = ", then ".join(["of the momenta", *carried])
    force = "" if "advected" in d.problem else "the derivative of L along g, + "
    closed = "velocity" in state.wanted
    pushed = any(x.data[1].startswith("p_") for x in state.leaves.values())
    shift = ", p_i = dL/dw_i in that of w_i" if pushed else ""
    back = "velocity takes it back" if closed else "velocity takes it back by Newton's method"
    text = (
        f"With momenta, y is x with Pi_a = dL/dzeta_a in the place of zeta_a{shift}: momentum "
        f"takes x there, {back}, and momentum_rhs is dy/dt. poisson is the matrix of the Poisson "
        f"brackets {variables}: their rates are {force}poisson times the derivatives of the "
        f"energy, zeta for Pi{', w for p' if pushed else ''}."
    )
    return textwrap.wrap(text, 92)


def refuse(d: Derivation, group: Group, chosen: Options) -> None:
    """``LoweringError`` where there are no momenta of a Lagrangian's own to tell the motion by."""
    own, another = d.problem.get("lagrangian", {}), group.in_user_basis is not group
    reasons = (
        (own.get("held"), "is for motions on the whole group, and these are on a quotient"),
        (d.problem.get("flows"), "is for masses that stay, and here mass flows"),
        (chosen.velocity == "tangent", "has Pi in the state, and --velocity tangent has dg/dt"),
        (chosen.frame != "given", "is for the body as given, and --frame turns it"),
        (another, "is for the standard basis of the group, and this has another"),
        (not group.linear_basis, "is for groups that do more than translate, unlike this one"),
    )
    refuse_first(d.name, *((on, f"--momenta {why}") for on, why in reasons))


def momentum_state(lowering: Lowering, group: Group, options: Options) -> MomentumState:
    """The functions in momenta of a record."""
    if "lagrangian" not in lowering.record.problem:
        return _of_points(MomentaOfPoints(lowering, group, options))
    reader, graph = lowering.reader, lowering.graph
    coordinates = reader.space.coordinates
    span = range(1, len(coordinates) + 1)
    own = [reader.leaf(suffixed("Pi", a)) for a in span]
    leaves = reader.state_leaves
    at = {leaves.index(x): p for x, p in zip(coordinates, own, strict=True)}
    y = [at.get(i, x) for i, x in enumerate(leaves)]
    momenta = [reader.number_of(("at", "Π", a)) for a in span]
    after = Lowering(reader.record, group, options, graph)
    after.reader.memo |= {("at", "Π", a): p for a, p in zip(span, own, strict=True)}
    found = {"momentum": _with(leaves, at, momenta)}
    if closed := _quadratic(reader):
        velocity = _named(after, *closed)
        found["velocity"] = _with(y, at, velocity)
        # ζ in the equations of the record is the velocity that the momenta give
        after.reader.state["ζ"] = after.reader.space.values["ζ"] = q.column(velocity)
    else:
        missing = tuple((p - x,) for p, x in zip(own, momenta, strict=True))
        change = lowering.inverses.solved("M", missing)
        found["velocity_step"] = _with(
            y, at, [x + c for x, (c,) in zip(coordinates, change, strict=True)]
        )
    name = "momentum_rhs" if closed else "momentum_rates"
    found[name] = _rates(after.reader, at)
    tensor = after.reader.vector("𝕁")
    found["poisson"] = [x for row in tensor for x in row]
    return MomentumState(found, tuple(x.data[1] for x in y), at, len(tensor))


def _of_points(found: MomentaOfPoints) -> MomentumState:
    """The functions in momenta where points give the Lagrangian."""
    reader, moving = found.lowering.reader, found.after.reader
    leaves = reader.state_leaves
    at = {leaves.index(x): p for x, p in zip(reader.space.coordinates, found.own, strict=True)}
    y = [at.get(i, x) for i, x in enumerate(leaves)]
    moving.space.values["ζ"] = matrix(moving.state["ζ"])
    rates = moving.space.rates(moving.vector, lambda name, a: reader.graph.num(0))
    wanted = {
        "momentum": _with(leaves, at, found.momenta),
        "velocity": _with(y, at, found.velocity),
        "momentum_rhs": _with(rates, at, found.rates),
        "poisson": [x for row in found.tensor for x in row],
    }
    return MomentumState(wanted, tuple(x.data[1] for x in y), at, len(found.tensor))


def _quadratic(reader: RecordReader) -> tuple[str, Tree] | None:
    """What the record says that ζ is by the momenta, with the key of this equation; ``None`` where
    it has none."""
    for step, e in reader.equations:
        if step.rule == "inversion" and e.lhs == "ζ":
            return step.key(e), e.rhs
    return None


def _named(lowering: Lowering, key: str, t: Tree) -> list[Node]:
    """The entries of a column, as the velocity."""
    lowering.reader.label = key
    found = matrix(lowering.tree(t))
    return [
        lowering.graph.value(x, suffixed("velocity", a), key, recorded=True)
        for a, (x,) in enumerate(found, 1)
    ]


def _with(state: list[Node], at: Mapping[int, Node], values: list[Node]) -> list[Node]:
    """A state with values in the places of the velocity."""
    new = dict(zip(at, values, strict=True))
    return [new.get(i, x) for i, x in enumerate(state)]


def _rates(reader: RecordReader, at: Mapping[int, Node]) -> list[Node]:
    """The rates of y: those of x, with Π̇ in place of the acceleration."""
    span = range(1, len(at) + 1)
    pushed = [reader.number_of(("at", "Π̇", a)) for a in span]
    rates = reader.space.rates(reader.vector, lambda name, a: reader.graph.num(0))
    return _with(rates, at, pushed)


# The same motion in momenta where points give the Lagrangian: Π_a, or ℓ_b, and p_b in the place
# of ζ and w.
#
# All is read from the steps ``by_momenta`` and ``poisson_tensor`` of the record, which say the
# velocity by the momenta, and their rates. In a product whose factors are seen from their centres
# of mass ζ is found as the acceleration is: M, on Z(1 + S), from what the momenta leave on E_a(1
# − S).

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
            found = [*q.flatten(lowering.reader.vector(spin))]
        else:
            found = [self._on_basis(lowering, family, a + 1) for a in range(self.turns)]
        pushed = lowering.reader.vector(push) if self.group.affine else ()
        return [*found, *q.flatten(pushed)]

    def _on_basis(self, lowering: Lowering, family: str, a: int) -> Node:
        """Π_a or its rate, by the equation for any a."""
        key, e = self._equation(("at", family, "a"))
        lowering.reader.label = key
        value = scalar(lowering.tree(bound(e.rhs, {"a": a})))
        return self.graph.value(value, suffixed(ascii_name(family), a), key, recorded=True)

    def _equation(self, lhs: Tree) -> tuple[str, Equation]:
        """The equation with this left side in the steps that tell the motion by momenta."""
        return next(x for x in motion_equations(self.lowering.record) if x[1].lhs == lhs)

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
        if self.group.barycentric_blocks:
            self._set("ζ", "", self._seen_from_centres())
        for key, e in motion_equations(self.lowering.record, "inversion"):
            if isinstance(e.lhs, str):
                reader.label = key
                self._set(e.lhs, key, matrix(self.after.tree(e.rhs)))
        names = ("ζ", "w") if self.group.affine else ("ζ",)
        return [x for name in names for x in q.flatten(matrix(state[name]))]

    def _set(self, name: str, key: str, value: Matrix) -> None:
        """Let a name stand for a value; with Z also its coordinates."""
        reader, called = self.after.reader, {"ζ": "velocity", "w": "shift"}.get(name, name_of(name))
        reader.label = key
        reader.state[name] = named = reader.entries(value, called, recorded=True)
        if name == "Z":
            space, none = reader.space, q.column([self.graph.num(0)] * self.group.n)
            whole = space.homogeneous(named, none)
            self._set("ζ", key, q.column(space.read(whole)[: self.turns]))

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
        central = q.flatten(self.after.inverses.solved("M", loads))
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


def motion_equations(d: Derivation, *rules: str) -> list[tuple[str, Equation]]:
    """The equations of the steps that tell the motion by momenta, with their keys."""
    steps = [x for x in d.steps if x.rule in (rules or RULES)]
    return [(x.key(e), e) for x in steps for e in x.equations]
