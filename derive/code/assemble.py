"""From a record to its program: state, parameters, constants, right-hand side, energy."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import zip_longest
from typing import Any

from ..algebra.groups import Group, names_by_block
from ..language.limits import SLOPES
from ..language.reserved import rate_of_mass, suffixed
from ..language.show import show
from ..language.tree import Tree
from ..record.record import Derivation
from .conventions import conventions, titles
from .drift import TEXTS, drift, matrices
from .factor import factored
from .graph import Node, reachable
from .group_functions import GroupFunctions
from .inverses import start_of_masses
from .kinks import kinks, may_bend
from .lower import Lowering
from .momentum_state import OF_Y, MomentumState, momentum_state, sentences
from .naming import ClaimedNames
from .options import Options
from .principal_frame import PrincipalFrame, frame_changes, inertia, turning
from .program import EmittedFunction, Framing, KeptByGauss, LoweringError, Program
from .reader import RecordReader
from .requests import require_written
from .schedule import (
    Scheduler,
    by_leaves,
    by_numbers,
    by_state,
    frontier,
    leaf_places,
    symmetries,
    variations,
)
from .state_forms import FROM_MATRIX, LABELS, matrix_state, of_variations, state_of
from .step.discrete_step import STEPPING, Lowered, lowered
from .watched_functions import (
    EmittedEvent,
    EmittedQuantities,
    dynamics,
    output_names,
    outputs,
    table,
    values,
    wanted_rates,
)

Place = tuple[str, tuple[str, int]]
"""The name of a number that is read, and its array and index."""

LOCAL = (
    "Masses may be negative: constants tests the metric at g = 1; where the state takes it to a",
    "singular one, dx/dt is without bound.",
)

UNTESTED = (
    "M, the second derivative of L in the velocity, depends on the state, so that constants does",
    "not test it; where it is singular, dx/dt is without bound.",
)

OF_STATE = "constants does not know the masses of the state: it tests the mass matrix at t = 0 with"

Check = tuple[Node, Node | None]
"""A node that must be positive, and the scale of its rounding error."""


def assemble(
    d: Derivation,
    group: Group,
    options: Options | None = None,
    framed: Derivation | None = None,
    kept: Mapping[str, Tree] | None = None,
    events: Sequence[EmittedEvent] = (),
    discrete: Derivation | None = None,
    forces: Sequence[Mapping[str, Any]] = (),
    null: Sequence[Sequence[Fraction]] = (),
) -> Program:
    """The program of a record; ``LoweringError`` when the record has no solved equations.

    ``framed``: the record in the principal frame, if that is asked for; ``kept``: what the motion
    keeps, as :mod:`derive.code.watched_functions` takes it; ``events``: what is watched;
    ``forces``: their ``table`` and ``wind`` in the file; ``null``: directions of a quotient's 𝔥.
    """
    chosen = options or Options()
    require_written(d, group, chosen)
    lowering = Lowering(framed or d, group, chosen)
    lowering.reader.space.null = null
    frame = _frame(framed, Lowering(d, group, chosen, lowering.graph)) if framed else None
    wanted, momenta, stepped = _of_state(lowering, chosen, kept or {}, events, discrete)
    if frame:
        wanted["energy"] = [lowering.graph.product((frame.unit, *wanted["energy"]))]
        wanted |= _inertia(frame.old) | frame_changes(frame, lowering.reader)
    checks = [(x, size) for x, size in lowering.inverses.tests() if x.op != "num" or x.data <= 0]
    checks += frame.regular if frame else []
    found = [*_several(checks), *_several(wanted.values()), *(frame.nodes() if frame else ())]
    parameters = _used_parameters(d, found, chosen)
    given = lowering, chosen, wanted, checks, parameters, frame, momenta, stepped
    functions, constants, framing = _functions(*given)
    said = _said(d, forces)
    return Program(
        d.name,
        str(d.problem.get("title", "")),
        group.name,
        group.dimension,
        (
            *conventions(group, said, chosen, framed.problem["frame"] if framed else None),
            *_told_besides(lowering, chosen),
            *(sentences(d, momenta) if momenta else ()),
        ),
        tuple(lowering.reader.space.names),
        tuple(parameter(d, name) for name in parameters),
        tuple(lowering.reader.inputs),
        tuple(constants),
        group.in_user_basis.basis,
        functions,
        group.in_user_basis.free_translations,
        turning(d.problem, parameters) if "inertia" in wanted and not frame else None,
        framing,
        "eta g" if lowering.reader.space.right else "g eta",
        tuple(kept or ()),
        table(events),
        _invariants_of_gauss(lowering, chosen, functions, len(parameters), tuple(kept or ())),
        *((momenta.names, momenta.size) if momenta else ((), 0)),
        discrete=stepped.step if stepped else None,
        **_further(d, said, lowering, chosen),
    )


def _frame(framed: Derivation, lowering: Lowering) -> PrincipalFrame:
    """The principal frame, by its record and the values in the frame that is given."""
    old = lowering.reader
    return PrincipalFrame(framed.problem["frame"], old, bool(old.space.charts))


def _said(d: Derivation, forces: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The problem of a record, with what is known of its forces beside it."""
    more: Mapping[str, Any] = {}
    pairs = zip_longest(d.problem.get("forces", ()), forces, fillvalue=more)
    return {**d.problem, "forces": [{**x, **y} for x, y in pairs]}


def _told_besides(lowering: Lowering, chosen: Options) -> list[str]:
    """What a header says of what is not tested, and of variations."""
    found = [*(LOCAL * lowering.inverses.local + UNTESTED * lowering.inverses.untested)]
    space = lowering.reader.space
    if stored := start_of_masses(lowering.record.problem, space.stored):
        told = ", ".join(f"{name} = {x!r}" for name, x in stored.items())
        found += textwrap.wrap(f"{OF_STATE} {told}.", 90)
    return found + textwrap.wrap(of_variations(space), 90) * bool(chosen.varied)


def _further(
    d: Derivation, said: Mapping[str, Any], lowering: Lowering, chosen: Options
) -> dict[str, Any]:
    """What the program says of outputs, of matrices in a state or beside its charts, and of the
    group."""
    space = lowering.reader.space
    door = matrix_state(space)
    plain = state_of(d.problem, space.graph, space.standard, replace(chosen, attitude="matrix"))
    names, known = tuple(space.names), names_by_block(space.group)
    by_block = tuple(known.get(x, x) for x in names)
    return {
        "mass_fault": lowering.inverses.mass_fault,
        "masses": tuple(space.stored),
        "varied": len(space.variations()) if chosen.varied or chosen.exponential else 0,
        "symmetries": len(space.null),
        "outputs": output_names(d),
        "state_by_block": by_block if by_block != names else (),
        "kinks": kinks(said, space.group) if chosen.jacobian else {},
        "bends": may_bend(d.problem),
        "blocks": matrices(space),
        "matrix_state": door.names if door else (),
        "matrix_blocks": matrices(plain) if door else (),
        "charts": tuple(space.charts.values()),
        "group_functions": GroupFunctions.of(space) if chosen.exponential else None,
    }


def _of_state(
    lowering: Lowering,
    chosen: Options,
    kept: Mapping[str, Tree],
    events: Sequence[EmittedEvent],
    discrete: Derivation | None,
) -> tuple[dict[str, list[Node]], MomentumState | None, Lowered | None]:
    """Name → outputs of the functions of the state; the state with momenta; the discrete step."""
    wanted = _outputs(lowering, chosen)
    group = lowering.reader.group
    momenta = momentum_state(lowering, group, chosen) if chosen.momenta else None
    found = {**momenta.wanted} if momenta else {}
    if lowering.reader.options.multiplier:
        found["multiplier"] = [lowering.reader.number("θ")]
    if kept:
        found["conserved"] = EmittedQuantities(lowering).of(kept)
    wanted |= {name: factored(lowering.graph, nodes) for name, nodes in found.items()}
    wanted |= outputs(lowering, chosen)
    wanted |= dynamics(lowering) if chosen.dynamics else {}
    if events:
        wanted["events"] = values(lowering, events)
    stepped = lowered(lowering, discrete) if discrete else None
    if stepped:
        wanted |= {x: factored(lowering.graph, y) for x, y in stepped.functions.items()}
    return wanted, momenta, stepped


def _invariants_of_gauss(
    lowering: Lowering,
    chosen: Options,
    functions: Mapping[str, EmittedFunction],
    parameters: int,
    conserved: Sequence[str],
) -> KeptByGauss | None:
    """What the step keeps of which that is asked for."""
    if "gauss" not in chosen.step:
        return None
    from .step.gauss_invariants import invariants_of_gauss

    sizes = {"p": parameters, "u": len(lowering.reader.inputs)}
    return invariants_of_gauss(functions, lowering.reader.space, sizes, conserved)


def _functions(
    lowering: Lowering,
    options: Options,
    wanted: Mapping[str, list[Node]],
    checks: Sequence[Check],
    parameters: Sequence[str],
    frame: PrincipalFrame | None,
    momenta: MomentumState | None,
    stepped: Lowered | None,
) -> tuple[dict[str, EmittedFunction], list[str], Framing | None]:
    """The program's functions by name, the names of the entries of ``k``, and the functions that
    find the principal frame where there is one."""
    names = ClaimedNames()
    space = lowering.reader.space
    moving = _places(lowering.reader, names)
    texts = _equations(lowering.record) | TEXTS | LABELS
    scheduler = Scheduler(names, texts | (_equations(stepped.record) if stepped else {}))
    fixed = frontier(x for name in wanted if name != "inertia" for x in wanted[name])
    leaves = [lowering.reader.leaf(x, "parameter") for x in parameters]
    from_p = leaf_places(names, leaves, "p")
    read = _leaves([*fixed, *_several(checks)])
    framed = [x for x in frame.numbers if x in read] if frame else []
    numbers = leaf_places(names, framed, "frame")
    functions = {"constants": scheduler.function(fixed, from_p | numbers, checks)}
    constants = [_constant_name(names, x, i) for i, x in enumerate(fixed)]
    kept = {x: (name, ("k", i)) for i, (x, name) in enumerate(zip(fixed, constants, strict=True))}
    by_momenta = momenta.places(moving, names) if momenta else {}
    of_step = {**moving}
    for array, read_by_it in (stepped.leaves if stepped else {}).items():
        of_step |= leaf_places(names, read_by_it, array)
    if options.dynamics:
        moving |= leaf_places(names, wanted_rates(lowering), "dzeta")
    for name, nodes in wanted.items():
        own = by_momenta if name in OF_Y else moving
        own = of_step if name.startswith(STEPPING) else own
        places = from_p if name == "inertia" else {**own, **kept}
        functions[name] = scheduler.function(nodes, places)
    functions["rhs"] = replace(functions["rhs"], titles=titles(lowering.reader))
    if "parameters" in options.jacobian:
        slopes = by_leaves(space, _second(lowering.reader), leaves)
        slopes = factored(lowering.graph, slopes)
        functions["jacobian_parameters"] = scheduler.function(slopes, moving | from_p)
    framing = _framing(frame, scheduler, from_p, numbers) if frame else None
    for name, nodes in drift(space, slopes="step" in options.jacobian).items():
        functions[name] = scheduler.function(nodes, moving)
    door = matrix_state(space)
    for name, nodes in door.outputs.items() if door else ():
        functions[name] = scheduler.function(
            nodes, leaf_places(names, door.leaves, "z") if door and name == FROM_MATRIX else moving
        )
    return functions, constants, framing


def _inertia(reader: RecordReader) -> dict[str, list[Node]]:
    """The function ``inertia``, where space is R³, as name → outputs."""
    tensor = inertia(reader)
    return {"inertia": tensor} if tensor else {}


def _framing(
    frame: PrincipalFrame,
    scheduler: Scheduler,
    from_p: dict[Node, Place],
    numbers: dict[Node, Place],
) -> Framing:
    """The functions that find the frame: each matrix whose axes are wanted, then the numbers."""
    scheduler = Scheduler(scheduler.names, _equations(frame.old.record))
    axes = [x for found in frame.axes for x in found.leaves]
    places = from_p | leaf_places(scheduler.names, axes, "axes")
    outputs = [frame.numbers[x] for x in numbers]
    return Framing(
        tuple(
            (len(x.matrix), scheduler.function([y for row in x.matrix for y in row], places))
            for x in frame.axes
        ),
        scheduler.function(outputs, places),
    )


def _several(groups: Iterable[Iterable[Node | None]]) -> list[Node]:
    """The nodes of all groups in one list, ``None`` left out."""
    return [x for group in groups for x in group if x is not None]


def _outputs(lowering: Lowering, options: Options) -> dict[str, list[Node]]:
    """Name → the nodes that the function of this name computes; ``LoweringError`` where a
    denominator, or the mass matrix, is 0 whatever the parameters."""
    reader, graph = lowering.reader, lowering.graph
    space = reader.space
    try:
        rates = space.rates(reader.vector, reader.component, in_space=reader.in_space)
        rates += _lost(reader)
        lowering.inverses.require_regular()
        energy, tensor = reader.number("h̃"), _inertia(reader)
        *rates, energy = factored(graph, [*rates, energy])
        found = {"rhs": rates, "energy": [energy]}
        second = _second(reader) if options.varied else []
        if "state" in options.jacobian:
            # after the rates, with which it shares much
            found["jacobian"] = factored(graph, [*rates, *by_state(space, second)])
        if "inputs" in options.jacobian:
            inputs = by_leaves(space, second, reader.input_leaves)
            found["jacobian_inputs"] = factored(graph, inputs)
        if {"raw", "step"} & {*options.jacobian}:
            found["jacobian_raw"] = _raw(lowering, rates)
        if "step" in options.jacobian:
            if reader.inputs:
                slopes = by_numbers(graph, rates, reader.input_leaves)
                found["jacobian_raw_inputs"] = factored(graph, slopes)
            moves = [*variations(space), *symmetries(space)]
            found["variations"] = [v.of(x) for x in reader.state_leaves for v in moves]
    except ZeroDivisionError:
        raise LoweringError(
            f"{lowering.record.name}: a division by zero, or a mass matrix that is singular "
            "whatever the parameters: look at the denominators in the file"
            + ", and at the masses"
            * lowering.inverses.definite
        ) from None
    return found | tensor


def _second(reader: RecordReader) -> list[Node]:
    """The rates of which linearised equations have the derivatives: those of the velocity and of
    masses; where there is no element of the group, all."""
    space = reader.space
    if not space.has_element:
        return space.rates(reader.vector, reader.component)
    return [*space.velocity(reader.component), *_lost(reader)]


def _lost(reader: RecordReader) -> list[Node]:
    """The rates of masses of the state."""
    return [reader.number_of(("par", rate_of_mass(x))) for x in reader.space.stored]


def _raw(lowering: Lowering, rates: list[Node]) -> list[Node]:
    """The derivative of the rates by the numbers of the state; ``LoweringError`` for too many."""
    leaves = lowering.reader.state_leaves
    if len(leaves) ** 2 > SLOPES:
        raise LoweringError(
            f"{lowering.record.name}: --jacobian raw is a matrix of {len(leaves) ** 2} entries; "
            f"compilers manage {SLOPES}: leave it out"
        )
    return factored(lowering.graph, by_numbers(lowering.graph, rates, leaves))


def _places(reader: RecordReader, names: ClaimedNames) -> dict[Node, Place]:
    """The leaves that change with time and where they are read: state x, inputs u, time t."""
    found = leaf_places(names, reader.state_leaves, "x")
    found |= leaf_places(names, reader.input_leaves, "u")
    return found | {reader.leaf("t", "time"): ("t", ("t", 0))}


def _used_parameters(d: Derivation, nodes: list[Node], options: Options) -> list[str]:
    """The parameters that some nodes depend on, in the order of the problem; ``LoweringError`` for
    none where they are to be linearised in."""
    used = {x.data[1] for x in _leaves(nodes) if x.data[0] == "parameter"}
    if "parameters" in options.jacobian and not used:
        raise LoweringError(f"{d.name}: there are no parameters to linearise in")
    return [name for name in d.problem["parameters"] if name in used]


def _leaves(nodes: Iterable[Node]) -> set[Node]:
    """All leaves that some nodes depend on."""
    return {x for x in reachable(nodes) if x.op == "leaf"}


def _constant_name(names: ClaimedNames, x: Node, i: int) -> str:
    """The name of entry i of ``k``: that of its factors, else ``constant_i``."""
    if x.op == "leaf":
        return names.claim(x.data[1], " ".join(x.data))
    return names.claim(_wanted(x) or suffixed("constant", i), f"node {x.id}")


def _wanted(x: Node) -> str:
    """A name made of the names of a product's factors; empty when one of them has none."""
    if x.op in ("value", "leaf"):
        return x.graph.titles[x][0] if x.op == "value" else str(x.data[1])
    if x.op == "mul" and len(x.args) <= 3:
        parts = [_wanted(y) if y.op != "mul" else "" for y in x.args]
        return "_".join(parts) if all(parts) else ""
    return ""


def parameter(d: Derivation, name: str) -> tuple[str, float | None, str, str]:
    """Name, default, unit and meaning of a parameter."""
    p = d.problem["parameters"][name]
    return name, p["default"], p["unit"], p["meaning"]


def _equations(d: Derivation) -> dict[str, str]:
    """Key of an equation → its text, for comments."""
    return {s.key(e): f"{show(e.lhs)} = {show(e.rhs)}" for s in d.steps for e in s.equations}
