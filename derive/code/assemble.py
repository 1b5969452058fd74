"""From a record to its program: state, parameters, constants, right-hand side, energy."""

from __future__ import annotations

from ..algebra.groups import Group
from ..algebra.rational import Matrix
from ..algebra.show import show
from ..record.record import Derivation
from .axes import inertia, turning
from .conventions import conventions
from .factor import factored
from .graph import Node
from .lower import Lowering
from .naming import Names, suffixed
from .program import Program
from .reader import LoweringError, equation_key
from .schedule import Scheduler, frontier
from .state import layout


def assemble(d: Derivation, group: Group) -> Program:
    """The program of a record; ``LoweringError`` when the record has no solved equations."""
    lowering = Lowering(d, group)
    try:
        state, rates = _state(lowering)
        lowering.require_regular()
        energy = lowering.name("h̃")
        tensor = inertia(lowering)
    except ZeroDivisionError:
        raise LoweringError(
            f"{d.name}: a division by zero, or a mass matrix that is singular whatever the "
            "parameters: look at the denominators in the file, and at the masses"
        ) from None
    if not isinstance(energy, Node):
        raise LoweringError("the energy is not a number")
    *rates, energy = factored(lowering.graph, [*rates, energy])
    names = Names()
    inputs = lowering.inputs
    for kind, members in (("state", state), ("input", inputs)):
        for name in members:
            names.claim(name, f"{kind} {name}")
    scheduler = Scheduler(names, _equations(d))
    fixed = frontier([*rates, energy])
    # a pivot that is a number was seen not to vanish
    lowering.checks = [test for test in lowering.checks if test[0].op != "num"]
    checked = [x for test in lowering.checks for x in test if x is not None]
    parameters = _used_parameters(d, [*fixed, *checked, *tensor])
    given = _parameter_places(lowering, names, parameters)
    compute = scheduler.function(fixed, given, lowering.checks)
    constants = [_constant_name(names, x, i) for i, x in enumerate(fixed)]
    places = _places(lowering, names, state, inputs)
    places |= {
        x: (name, ("k", i)) for i, (x, name) in enumerate(zip(fixed, constants, strict=True))
    }
    return Program(
        d.name,
        str(d.problem.get("title", "")),
        group.name,
        group.dimension,
        conventions(group, d.problem),
        tuple(state),
        tuple(_parameter(d, name) for name in parameters),
        tuple(inputs),
        tuple(constants),
        group.basis,
        compute,
        scheduler.function(rates, places),
        scheduler.function([energy], places),
        scheduler.function(tensor, given) if tensor else None,
        turning(d.problem, parameters) if tensor else None,
    )


def _state(lowering: Lowering) -> tuple[list[str], list[Node]]:
    """Names of the state and the nodes of its rate, in the order of the contract."""
    group, n = lowering.group, lowering.n
    slots = layout(group)
    state = [x.name for x in slots]
    rate: dict[str, Matrix] = {"A": lowering.name("Ȧ")}  # type: ignore[dict-item]
    if group.affine:
        rate["T"] = lowering.name("Ṫ")  # type: ignore[assignment]
    rates = [rate[x.letter][x.row][x.column] for x in slots]
    d = group.dimension - n if group.affine else group.dimension
    state += [suffixed("zeta", a) for a in range(1, d + 1)]
    rates += [lowering.component("ζ̇", a) for a in range(1, d + 1)]
    if group.affine:
        state += [suffixed("w", i) for i in range(1, n + 1)]
        rates += [lowering.component("ẇ", i) for i in range(1, n + 1)]
    return state, rates


def _places(
    lowering: Lowering, names: Names, state: list[str], inputs: list[str]
) -> dict[Node, tuple[str, tuple[str, int]]]:
    """Where each leaf is read from, and the name it has there (never a reserved word)."""
    arrays = (("x", "state", state), ("u", "input", inputs))
    found = {
        lowering.leaf(x, kind): (names.claim(x, f"{kind} {x}"), (array, i))
        for array, kind, members in arrays
        for i, x in enumerate(members)
    }
    return found | {lowering.leaf("t", "time"): ("t", ("t", 0))}


def _used_parameters(d: Derivation, nodes: list[Node]) -> list[str]:
    """The parameters that the equations contain, in the order of the problem."""
    used: set[str] = set()
    seen: set[Node] = set()
    stack = list(nodes)
    while stack:
        x = stack.pop()
        if x not in seen:
            seen.add(x)
            stack.extend(x.args)
            if x.op == "leaf":
                used.add(x.data[1])
    return [name for name in d.problem["parameters"] if name in used]


def _parameter_places(
    lowering: Lowering, names: Names, parameters: list[str]
) -> dict[Node, tuple[str, tuple[str, int]]]:
    """Where each parameter is read from, and the name it has there."""
    return {
        lowering.leaf(x, "parameter"): (names.claim(x, f"parameter {x}"), ("p", i))
        for i, x in enumerate(parameters)
    }


def _constant_name(names: Names, x: Node, i: int) -> str:
    if x.op == "leaf":
        return names.claim(x.data[1], f"parameter {x.data[1]}")
    return names.claim(_wanted(x) or suffixed("constant", i), f"node {x.id}")


def _wanted(x: Node) -> str:
    """A name from the names of a product's factors; empty when they have none."""
    if x.op in ("value", "leaf"):
        return x.graph.titles[x][0] if x.op == "value" else str(x.data[1])
    if x.op == "mul" and len(x.args) <= 3:
        parts = [_wanted(y) if y.op != "mul" else "" for y in x.args]
        return "_".join(parts) if all(parts) else ""
    return ""


def _parameter(d: Derivation, name: str) -> tuple[str, float | None, str, str]:
    p = d.problem["parameters"][name]
    return name, p["default"], p["unit"], p["meaning"]


def _equations(d: Derivation) -> dict[str, str]:
    """Label of an equation → its text, for comments."""
    return {
        equation_key(s, e): f"{show(e.lhs)} = {show(e.rhs)}" for s in d.steps for e in s.equations
    }
