"""The numeric code of a problem, as a program and at work: its record assembled with what the
options ask for, conserved quantities and the discrete motion among it; trims, of its values."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from .language.limits import Refused
from .language.reserved import did_you_mean, near_name
from .pipeline import discrete, lagrangian_road, walk
from .problem.fields import state_names
from .problem.lagrangian_tables import quotient_of
from .problem.principal import principal
from .problem.problem import Problem, ProblemError
from .record.record import Derivation
from .searches import conserved_quantities, conserved_without_gravity

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .code.options import Options
    from .code.program import Program
    from .language.univariate import Number
    from .motion.emitted import Emitted, OneDegree
    from .search.equilibria.trim import Bounds, Trim


def motion_of(
    problem: Problem,
    record: Derivation,
    step: str = "gauss",
    order: str = "",
    *,
    weightless: bool = False,
) -> Emitted:
    """The emitted code of a problem with a step, of an ``order`` if it is the discrete one, which
    stops at its events, and all that its motion keeps, for runs; with what it keeps if it is
    ``weightless``."""
    from .motion.emitted import Emitted

    made, why = moving_program(problem, record, step, order, weightless=weightless)
    return Emitted.of(made, problem, record, step, one_degree(problem, record), why, order)


def moving_program(
    problem: Problem,
    record: Derivation,
    step: str = "gauss",
    order: str = "",
    *,
    sought: bool = True,
    weightless: bool = False,
) -> tuple[Program, str]:
    """The program of a problem with all that its motion keeps, and why it has none of that but the
    energy: none is found, or it is not looked for where SymPy is not there.  ``sought``: is it
    looked for?  ``weightless``: also what is kept where gravity is 0?"""
    from .code.options import Options

    if problem.kinematics:
        raise ProblemError(
            f"{problem.name}: kinematics of first order are a filter, which is not simulated: emit "
            "its code, with --step and --exponential"
        )
    has, why = record.definition("θ") is not None, ""
    plain = Options(step=(step,), order=order)
    told = replace(plain, multiplier=has)
    for chosen in (*([replace(told, conserved=True)] * sought), told, plain):
        try:
            return program(problem, record, chosen, weightless=weightless), why
        except (Refused, ImportError) as error:  # or none is written for this state
            why = why or str(error)
            if chosen == plain:
                raise
    raise AssertionError("the last is made or raises")


def motion_of_many(problem: Problem, record: Derivation) -> Emitted:
    """The same for ensembles, whose motions stop at terminal events alone."""
    from .motion.ensemble import STEP

    ends = tuple(x for x in problem.events if x.terminal)
    return motion_of(replace(problem, events=ends), record, STEP)


def one_degree(problem: Problem, record: Derivation) -> OneDegree | None:
    """The effective potential where the symmetries of a problem leave one degree of freedom, an
    entry of g; else ``None``."""
    from .motion.emitted import OneDegree
    from .search.symmetries.found_symmetries import symmetries_of
    from .search.symmetries.quadrature import leaves_one, momenta_of
    from .search.symmetries.symmetry_steps import reduction_record

    try:
        found = symmetries_of(problem, record)
        if not leaves_one(found):
            return None
        general = lagrangian_road(found.lagrangian.trivialisation)
        reduced = reduction_record(found, general)
    except Refused:
        return None
    left = reduced.quadrature
    if left is None or not isinstance(left.entry, tuple) or reduced.routhian.named:
        return None
    told = reduced.record[f"{problem.name}.effective"].equations
    V = next(e.rhs for e in told if e.lhs == "𝒱")
    group = problem.own_group
    name = next(x for x, t in state_names(group).items() if t == left.entry)
    turns = "orthogonal" in group.relations and name.startswith("A")
    return OneDegree(left.entry, V, momenta_of(found, reduced.routhian.chosen), name, turns)


def trim(
    problem: Problem,
    at: Mapping[str, Number],
    free: Sequence[str] | None = None,
    given: Mapping[str, float] | None = None,
    bounds: Bounds | None = None,
    along: Mapping[str, Number] | None = None,
) -> tuple[Trim, Derivation, Mapping[str, str]]:
    """The inputs and velocities ``free``, else all inputs that are not given, with which the
    velocity of a state stays as it is, the record of the problem with the step that tells them, and
    the units of inputs and of the state by name, where they are known;
    ``at``: numbers of the state and of inputs, else those of g = 1, and 0; parameters have their
    defaults, or what is ``given``; a trim that is out of ``bounds``, of numbers by name, is
    refused; ``along``: a velocity in space of which g sees its own."""
    from .code.options import Options
    from .code.program import LoweringError
    from .motion.emitted_code import EmittedCode
    from .motion.signals import units_of_inputs
    from .search.equilibria.trim_steps import told
    from .search.equilibria.trimmed import trimmed
    from .walk.chapter import Chapter
    from .walk.spine.lagrangian import completed

    if why := untrimmed(problem):
        raise ProblemError(f"{problem.name}: {why}")
    problem = with_parameters(problem, given or {})
    record = walk(problem)
    try:
        by = ("state", "inputs") if problem.inputs else ("state",)
        made = program(problem, record, Options(jacobian=by, dynamics=True))
    except LoweringError:
        raise ProblemError(
            f"{problem.name}: a trim is by linearised equations on a whole group of matrices, "
            "which are not written here; derive equilibria may tell what is steady"
        ) from None
    try:
        found = trimmed(problem, made, at, free, bounds, along)
    except Refused as error:
        raise ProblemError(f"{problem.name}: {error}") from None
    c = Chapter(problem.name, problem.group_name)
    step = told(found, problem.own_group, record.steps, c)
    columns = EmittedCode(made, record, problem).columns()
    units = {x.name: x.unit for x in columns} | units_of_inputs(problem)
    return found, replace(record, steps=completed((*record.steps, step))), units


def untrimmed(problem: Problem) -> str:
    """Why nothing is trimmed in a problem of this kind; "" where something may be."""
    if problem.kinematics:
        return "a trim is of forces, and [kinematics] has none: its velocity is given"
    if problem.fluid:
        return "a trim is of a body with inputs, and a fluid has none"
    if problem.torus:
        return (
            "a trim is by linearised equations of g and its velocity, and the state of a fluid on "
            "the torus is its vorticity alone"
        )
    if problem.stored:
        mass = next(iter(problem.stored))
        return (
            f"a trim is by linearised equations of g and its velocity, and this state has the mass "
            f"{mass}, too; leave out its [[flow]], and give what it pushes as an [[input]]"
        )
    if problem.lagrangian and problem.lagrangian.held:
        return (
            "a trim is by linearised equations of all of g, and this motion is one on a quotient "
            "of the group; derive equilibria may tell what is steady"
        )
    if problem.advected is not None:
        return (
            "a trim is at an element of a group, and equations on an algebra alone have none; "
            "derive equilibria may tell what is steady"
        )
    return "" if problem.group else f"{problem.without_matrices}; {problem.with_matrices}"


def with_parameters(problem: Problem, given: Mapping[str, float]) -> Problem:
    """The problem with these numbers as the defaults of its parameters; ``ProblemError`` for a name
    of none."""
    known = problem.parameters
    if unknown := [x for x in given if x not in known]:
        near = did_you_mean(near_name(unknown[0], known), "; ")
        raise ProblemError(f"{problem.name}: {unknown[0]} is no parameter{near}")
    parameters = {x: replace(p, default=given.get(x, p.default)) for x, p in known.items()}
    return replace(problem, parameters=parameters)


def program(
    problem: Problem,
    record: Derivation,
    options: Options | None = None,
    *,
    weightless: bool = False,
) -> Program:
    """The program of a problem; in its principal frame that is the program of another problem.
    ``weightless``: with what is conserved, also that which is where gravity is 0."""
    from .code.assemble import assemble
    from .code.watched_functions import watched

    require_program(problem, record, options)
    events = watched(problem.name, problem.events, options) if options else ()
    if problem.torus:
        from .code.torus_program import torus_program

        return torus_program(record, problem.torus, options, events)
    group = problem.own_group
    if problem.kinematics:
        from .code.kinematics_program import kinematics_program

        return kinematics_program(record, group, options)
    if options is None or options.frame == "given":
        kept = conserved_quantities(problem, record) if options and options.conserved else None
        more = conserved_without_gravity(problem) if kept is not None and weightless else {}
        more = {name: t for name, t in more.items() if name not in (kept or {})}
        every = None if kept is None else kept | more
        stepped = discrete(problem) if options and "discrete" in options.step else None
        made = assemble(
            *(record, group, options),
            kept=every,
            events=events,
            discrete=stepped,
            forces=problem.force_tables,
            null=quotient.directions if (quotient := quotient_of(problem)) else (),
        )
        return replace(made, weightless=(*more,))
    return assemble(record, group, options, walk(principal(problem)))


def require_program(problem: Problem, record: Derivation, options: Options | None = None) -> None:
    """Refuse options that exclude one another or the problem, before anything is made of it:
    ``LoweringError``, or ``ProblemError`` where it has no code, or no such frame."""
    from .code.options import Options
    from .code.requests import require_written
    from .code.torus_program import require_on_torus
    from .code.watched_functions import watched

    chosen = options or Options()
    watched(problem.name, problem.events, chosen)
    if problem.torus:
        require_on_torus(record, problem.torus, chosen)
    elif problem.kinematics:
        from .code.kinematics_program import require_kinematics

        require_kinematics(record, chosen)
    elif problem.group is None:
        raise ProblemError(
            f"{problem.name}: {problem.without_matrices}, so it has no numeric code; "
            f"{problem.with_matrices}"
        )
    else:
        require_written(record, problem.group, chosen)
        if chosen.frame == "principal":
            principal(problem)
