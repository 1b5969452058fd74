"""From a record to its program: state, parameters, constants, right-hand side, energy."""

from __future__ import annotations

from ..algebra.groups import Group
from ..algebra.show import show
from ..record.record import Derivation
from .axes import inertia, turning
from .conventions import conventions
from .factor import factored
from .graph import Node
from .linearise import by_leaves, by_state
from .lower import Lowering
from .naming import Names, suffixed
from .options import Options
from .program import LoweringError, Program
from .reader import equation_key
from .schedule import Scheduler, frontier


def assemble(d: Derivation, group: Group, options: Options | None = None) -> Program:
    """The program of a record; ``LoweringError`` when the record has no solved equations."""
    chosen = options or Options()
    if chosen.attitude == "quaternion" and not group.turns_space:
        raise LoweringError(f"{d.name}: a quaternion needs SO(3) or SE(3), not {group.name}")
    if chosen.attitude == "quaternion" and chosen.velocity == "tangent":
        raise LoweringError(
            f"{d.name}: a quaternion goes with the velocity of the body, not tangent"
        )
    lowering = Lowering(d, group, chosen)
    if "inputs" in chosen.jacobian and not lowering.inputs:
        raise LoweringError(f"{d.name}: there are no inputs to linearise in")
    wanted = _outputs(lowering, chosen)
    # a pivot that is a number was seen not to vanish
    lowering.checks = [test for test in lowering.checks if test[0].op != "num"]
    checked = [x for test in lowering.checks for x in test if x is not None]
    parameters = _used_parameters(d, [*checked, *(x for nodes in wanted.values() for x in nodes)])
    names = Names()
    state, inputs = lowering.space.names, lowering.inputs
    for kind, members in (("state", state), ("input", inputs)):
        for name in members:
            names.claim(name, f"{kind} {name}")
    scheduler = Scheduler(names, _equations(d))
    fixed = frontier(x for name in wanted if name != "inertia" for x in wanted[name])
    given = _parameter_places(lowering, names, parameters)
    functions = {"constants": scheduler.function(fixed, given, lowering.checks)}
    constants = [_constant_name(names, x, i) for i, x in enumerate(fixed)]
    moving = _places(lowering, names, state, inputs)
    kept = {x: (name, ("k", i)) for i, (x, name) in enumerate(zip(fixed, constants, strict=True))}
    for name, nodes in wanted.items():
        places = given if name == "inertia" else moving | kept
        functions[name] = scheduler.function(nodes, places)
    if "parameters" in chosen.jacobian and parameters:
        leaves = [lowering.leaf(x, "parameter") for x in parameters]
        slopes = by_leaves(lowering.space, lowering.space.velocity(lowering.component), leaves)
        slopes = factored(lowering.graph, slopes)
        functions["jacobian_parameters"] = scheduler.function(slopes, moving | given)
    return Program(
        d.name,
        str(d.problem.get("title", "")),
        group.name,
        group.dimension,
        conventions(group, d.problem, chosen),
        tuple(state),
        tuple(_parameter(d, name) for name in parameters),
        tuple(inputs),
        tuple(constants),
        group.basis,
        functions,
        group.affine,
        turning(d.problem, parameters) if "inertia" in wanted else None,
    )


def _outputs(lowering: Lowering, options: Options) -> dict[str, list[Node]]:
    """What each function of the state, or of the parameters, computes, by its name."""
    space, graph = lowering.space, lowering.graph
    try:
        rates = space.rates(lowering.name, lowering.component)  # type: ignore[arg-type]
        lowering.require_regular()
        energy = lowering.name("h̃")
        tensor = inertia(lowering)
        if not isinstance(energy, Node):
            raise LoweringError("the energy is not a number")
        *rates, energy = factored(graph, [*rates, energy])
        found = {"rhs": rates, "energy": [energy]}
        second = space.velocity(lowering.component) if options.jacobian else []
        if "state" in options.jacobian:
            # after the rates, with which it shares much
            found["jacobian"] = factored(graph, [*rates, *by_state(space, second)])
        if "inputs" in options.jacobian:
            leaves = [lowering.leaf(x, "input") for x in lowering.inputs]
            found["jacobian_inputs"] = factored(graph, by_leaves(space, second, leaves))
    except ZeroDivisionError:
        raise LoweringError(
            f"{lowering.record.name}: a division by zero, or a mass matrix that is singular "
            "whatever the parameters: look at the denominators in the file, and at the masses"
        ) from None
    return found | ({"inertia": tensor} if tensor else {})


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
