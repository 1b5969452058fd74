"""Functions of the state beside its rates: outputs, what a motion keeps, events, inverse dynamics.

Outputs are in the numbers of the state as it is emitted, with their derivatives.  Of the mass
matrix M and the bias b: for rates a of the velocity, M a + b is the covector that must be added to
what already acts; without inputs, that which they must supply.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any, Protocol

from ..language import rational as q
from ..language.expression import names
from ..language.limits import tell
from ..language.rational import Matrix
from ..language.reserved import did_you_mean, near_name, suffixed
from ..language.tree import Tree, add, fold, mul
from ..language.values import OPERATIONS, value
from ..record.record import Derivation, Equation
from . import dense
from .factor import factored
from .graph import Graph, Node, reachable, remade, rewritten
from .lower import Lowering
from .options import Options
from .program import LoweringError, Watched, refuse_first
from .reader import matrix, scalar
from .schedule import Directional, by_numbers, of_velocity, variations
from .state_forms import BACK, IN_SPACE, has_velocity, in_space, state_of

RULE = "output"
"""That of the step which says the outputs."""


def output_names(d: Derivation) -> tuple[str, ...]:
    """The names of the numbers that a record says to be read off its motion, in their order."""
    return tuple(name for name, _, _ in _entries(d))


def _entries(d: Derivation) -> Iterator[tuple[str, Equation, int]]:
    """Name, equation and which entry of its sides, from 0, of each number."""
    equations = (e for s in d.steps if s.rule == RULE for e in s.equations)
    for e in equations:
        match e.lhs:
            case ("par", name):
                yield name, e, 0
            case ("matrix", *rows):
                yield from ((row[1][1], e, k) for k, row in enumerate(rows))


def outputs(lowering: Lowering, options: Options) -> dict[str, list[Node]]:
    """The function ``outputs`` and the derivatives that are asked for, as name → outputs; nothing
    where the record says none."""
    found = output_nodes(lowering)
    if not found:
        return {}
    graph, reader = lowering.graph, lowering.reader
    wanted = {"outputs": found}
    if "outputs" in options.jacobian:
        wanted["jacobian_outputs"] = [v.of(x) for x in found for v in variations(reader.space)]
        if reader.inputs:
            wanted["jacobian_outputs_inputs"] = by_numbers(graph, found, reader.input_leaves)
        if "raw" in options.jacobian:
            wanted["jacobian_outputs_raw"] = by_numbers(graph, found, reader.state_leaves)
    return {name: factored(graph, nodes) for name, nodes in wanted.items()}


def output_nodes(lowering: Lowering) -> list[Node]:
    """The values of the outputs, in their order."""
    return [_value(lowering, e, k) for _, e, k in _entries(lowering.record)]


def _value(lowering: Lowering, e: Equation, k: int) -> Node:
    """Entry k of the right side of an equation, or the number that it is."""
    label = next(s.key(e) for s in lowering.record.steps if e in s.equations)
    reader = lowering.reader
    reader.label = label
    value = lowering.tree(e.rhs)
    return scalar(value if isinstance(value, Node) else value[k][0])


class EmittedQuantities:
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
        slopes = (Directional(self.graph, self.space.faster(a), f"zeta_{a + 1}") for a in span)
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


# Events of a motion: what is watched on it, in the numbers of the state as it is emitted.

DIRECTIONS = {"both": 0, "rising": 1, "falling": -1}

UNWATCHED = "gauss_jax"
"""The step whose motions do not stop at events."""


class EmittedEvent(Protocol):
    """An instant at which the expression ``when`` changes its sign, in a ``direction`` of
    DIRECTIONS."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def when(self) -> Tree:
        """Of the state, the time, inputs and parameters."""

    @property
    def direction(self) -> str:
        """From where 0 is reached."""

    @property
    def terminal(self) -> bool:
        """Does the motion end there?"""


def table(events: Sequence[EmittedEvent]) -> tuple[Watched, ...]:
    """What a program says of them."""
    return tuple(Watched(x.name, DIRECTIONS[x.direction], x.terminal) for x in events)


def watched(name: str, events: Sequence[EmittedEvent], chosen: Options) -> Sequence[EmittedEvent]:
    """The events at which the steps of an emission stop; ``LoweringError`` where none are written
    for its state."""
    if not {*chosen.step} - {UNWATCHED}:
        return ()
    if events and chosen.frame == "principal":
        raise LoweringError(
            f"{name}: [[event]] is of the state in the frame of the parameters: leave out --frame"
        )
    return events


def values(lowering: Lowering, events: Sequence[EmittedEvent]) -> list[Node]:
    """The expressions of the events; ``LoweringError`` for a name that means nothing.

    Numbers of the state are known by the names that they have as emitted, and by those of the state
    of matrices and velocities in the body.
    """
    own, known = _numbers(lowering), lowering.record.problem["parameters"]
    for event in events:
        _require_known(lowering.record.name, event, [*own, *known])
    reader = lowering.reader
    reader.memo |= {("par", x): node for x, node in own.items()}  # the last that is lowered
    reader.label = ""
    return factored(lowering.graph, [scalar(lowering.tree(x.when)) for x in events])


def values_of(
    problem: str, events: Sequence[EmittedEvent], graph: Graph, state: Mapping[str, Node]
) -> list[Node]:
    """The same of numbers of the state that have no matrices and no parameters beside them."""
    numbers: dict[str, Node] = {
        "π": graph.num(Fraction(math.pi)), "t": graph.leaf("t", "time")
    }  # fmt: skip
    for event in events:
        _require_known(problem, event, state)
    try:
        found = [value(x.when, numbers, state, graph.function, graph.num) for x in events]
    except (ArithmeticError, ValueError) as error:
        raise LoweringError(f"{problem}: [[event]]: {error}") from None
    return factored(graph, found)


def _require_known(problem: str, event: EmittedEvent, known: Collection[str]) -> None:
    for name in names(event.when):
        if name not in known:
            near = did_you_mean(near_name(name, [*known]), after=" ").rstrip()
            raise LoweringError(
                f"{problem}: event {event.name}: no {name[:40]!r} in the state, the parameters or "
                f"the inputs{'; ' * bool(near)}{near}"
            )


def _numbers(lowering: Lowering) -> dict[str, Node]:
    """Name → node of what an expression may read besides the time and parameters."""
    reader = lowering.reader
    space, graph = reader.space, lowering.graph
    plain = state_of(reader.record.problem, graph, reader.group, Options())
    velocity = [x for a, x in enumerate(space.coordinates, 1) if a not in space.held]
    if plain.has_element:
        found = [*plain.entries(space.element), *velocity, *space.stored.values()]
    else:
        found = [*velocity, *(x for (x,) in space.values["Γ"])]
    return {
        **dict(zip(plain.names, found, strict=True)),
        **dict(zip(space.names, reader.state_leaves, strict=True)),
        **dict(zip(reader.inputs, reader.input_leaves, strict=True)),
        **dict(zip(output_names(lowering.record), output_nodes(lowering), strict=True)),
    }


def refuse(d: Derivation) -> None:
    """``LoweringError`` where the velocity is not determined by the momenta."""
    held = d.problem.get("lagrangian", {}).get("held")
    why = "--dynamics is for motions on the whole group, and these are on a quotient"
    refuse_first(d.name, (held, why))


def wanted_rates(lowering: Lowering) -> list[Node]:
    """What ``inverse`` takes: the rates that the velocity is to have, in the basis of the state."""
    span = range(1, lowering.reader.group.dimension + 1)
    return [lowering.graph.leaf(suffixed("dzeta", a), "state") for a in span]


def dynamics(lowering: Lowering) -> dict[str, list[Node]]:
    """The functions ``mass_matrix``, ∂Π_a/∂ζ_b by rows, ``bias``, −M ζ̇ of the motion, and
    ``inverse``, M (a − ζ̇) by rates a and the motion without inputs, where there is such a motion;
    in the basis of the state."""
    reader, graph = lowering.reader, lowering.graph
    count = reader.group.dimension
    momenta = EmittedQuantities(lowering).momenta
    speeds = of_velocity(reader.space)
    upper = {
        (a, b): graph.value(speeds[b].of(momenta[a]), suffixed("M", a + 1, b + 1), "")
        for a in range(count)
        for b in range(a, count)
    }
    rows = [[upper[min(a, b), max(a, b)] for b in range(count)] for a in range(count)]
    rates = reader.space.velocity(reader.component)
    found = {
        "mass_matrix": [x for row in rows for x in row],
        "bias": [-Node.dot(row, rates) for row in rows],
        "inverse": _supplied(lowering, rows, rates),
    }
    return {name: factored(graph, nodes) for name, nodes in found.items() if nodes}


def _supplied(lowering: Lowering, rows: list[list[Node]], rates: list[Node]) -> list[Node]:
    """M on what the rates without inputs lack; none where an input is divided by."""
    reader, graph = lowering.reader, lowering.graph
    still = dict.fromkeys(reader.input_leaves, graph.num(0))
    try:
        unforced = rewritten(rates, reachable(rates), remade, still)
    except ZeroDivisionError:
        tell(f"{lowering.record.name}: no inverse is written, as an input is divided by")
        return []
    pairs = enumerate(zip(wanted_rates(lowering), unforced, strict=True), 1)
    lacking = [graph.value(a - x, suffixed("lacking", i), "") for i, (a, x) in pairs]
    return [Node.dot(row, lacking) for row in rows]
