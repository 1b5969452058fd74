"""The same motion in momenta: the functions of ``--momenta``.

The state y is x with Π_a = ∂L/∂ζ_a in place of ζ_a.  All is read from the record: Π_a, ζ by M⁻¹
where it has that, Π̇_a, and the Poisson tensor 𝕁.  Elsewhere ζ is found by Newton's method, of which
a step is ζ + M⁻¹(Π − ∂L/∂ζ).  For points see :mod:`derive.code.momenta_of_points`.
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from dataclasses import dataclass

from ..algebra.groups import Group
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..language.tree import Tree
from ..record.record import Derivation
from .graph import Node
from .lower import Lowering
from .momenta_of_points import MomentaOfPoints
from .naming import ClaimedNames
from .options import Options
from .program import LoweringError
from .reader import RecordReader, matrix

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
    own = d.problem.get("lagrangian", {})
    for on, reason in (
        (own.get("held"), "is for motions on the whole group, and these are on a quotient"),
        (chosen.velocity == "tangent", "has Pi in the state, and --velocity tangent has dg/dt"),
        (chosen.frame != "given", "is for the body as given, and --frame turns it"),
        (group.stated is not group, "is for the standard basis of the group, and this has another"),
        (
            not group.linear_basis,
            "is for groups that do more than translate, unlike this one",
        ),
    ):
        if on:
            raise LoweringError(f"{d.name}: --momenta {reason}: leave it out")


def momentum_state(lowering: Lowering, group: Group, options: Options) -> MomentumState:
    """The functions in momenta of a record."""
    if "lagrangian" not in lowering.record.problem:
        return _of_points(MomentaOfPoints(lowering, group, options))
    reader, graph = lowering.reader, lowering.graph
    coordinates = reader.space.coordinates
    span = range(1, len(coordinates) + 1)
    own = [reader.leaf(suffixed("Pi", a)) for a in span]
    leaves = [reader.leaf(x) for x in reader.space.names]
    at = {leaves.index(x): p for x, p in zip(coordinates, own, strict=True)}
    y = [at.get(i, x) for i, x in enumerate(leaves)]
    momenta = [reader.number_of(("at", "Π", a)) for a in span]
    after = Lowering(reader.record, group, options, graph)
    after.reader.memo |= {("at", "Π", a): p for a, p in zip(span, own, strict=True)}
    found = {"momentum": _with(leaves, at, momenta)}
    if closed := _quadratic(reader):
        velocity = _named(after, *closed)
        found["velocity"] = _with(y, at, velocity)
        _moving_by(after.reader, velocity)
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
    leaves = [reader.leaf(x) for x in reader.space.names]
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


def _moving_by(reader: RecordReader, velocity: list[Node]) -> None:
    """Let ζ in the equations of the record be the velocity that the momenta give."""
    column: Matrix = tuple((x,) for x in velocity)
    reader.state["ζ"] = reader.space.values["ζ"] = column


def _rates(reader: RecordReader, at: Mapping[int, Node]) -> list[Node]:
    """The rates of y: those of x, with Π̇ in place of the acceleration."""
    span = range(1, len(at) + 1)
    pushed = [reader.number_of(("at", "Π̇", a)) for a in span]
    rates = reader.space.rates(reader.vector, lambda name, a: reader.graph.num(0))
    return _with(rates, at, pushed)
