"""The whole road on one screen: the stages from a problem to its record, a table that is run.

A row: the stage, what it takes, the type of what it gives, its function (``walk.stages`` runs it);
a: the letters of any group, c: the chapter that the steps belong to, c_u: the same where an input
acts.  From the record the road goes on in ``derive.code``: assemble (which reads it, lowers,
factors and schedules) → program → emit, by the signatures and the templates; the checker, the paper
and the views read it, too.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

# fmt: off
# isort: off
from .language.limits import Refused
from .problem import inertia
from .problem.principal import principal
from .problem.problem import (Problem, ProblemError)
from .record.record import Derivation
from .walk.chapter import Chapter, Stage, Values, follow, naming_steps, traced
from .walk.discrete import discrete_blocks, discrete_forces, discrete_group, discrete_road
from .walk.discrete.discrete_road import DiscreteAlphabet
from .walk.ellipsoid import dirichlet
from .walk.fluid import circulation, fluid_forms, fluid_kernel
from .walk.fluid.fluid_forms import FluidAlphabet
from .walk.given import body, inputs, potentials
from .walk.given.inputs import acts, by_name
from .walk.lie import any_lagrangian, expressed, momentum_side
from .walk.matrices import (
    conserved, coordinates, explicit, isometry, separation, solution, specialisation,
)
from .walk.matrices.specialisation import turns_whole
from .walk.spine import alphabet, cartan, kernel, lagrangian, orbit, principle
from .walk.spine.alphabet import Alphabet
from .walk.spine.head import problem_data, symbols
from .walk.spine.lagrangian import supposing_all
from .walk.torus import vorticity
from .walk.vectors import by_momenta, euler, isomorphism, rotation
# isort: on

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .code.options import Options
    from .code.program import Program
    from .language.tree import Tree
    from .language.univariate import Number
    from .motion.emitted import Emitted, OneDegree
    from .search.equilibria.enclosed_points import Enclosed
    from .search.equilibria.entries_of_elements import EntryConditions
    from .search.equilibria.stability import Equilibrium
    from .search.integrals.all_integrals import IntegralsFound
    from .search.reduction.reduction_steps import Reduction
    from .search.symmetries.symmetry_steps import Symmetries

ANY_GROUP = (
    Stage("lagrangian", "a c", "PointLagrangian", lagrangian.lagrangian),
    Stage("pullback", "lagrangian a c", "Pullback", lagrangian.pullback),
    Stage("unique", "lagrangian pullback.moments a c", "Step", orbit.unique),
    Stage("cartan", "pullback a c", "Cartan", cartan.cartan),
    Stage("exterior", "cartan a c", "Exterior", cartan.exterior),
    Stage("principle", "lagrangian pullback cartan a c", "Principle", principle.principle),
    Stage("kernel", "exterior principle a c", "Kernel", kernel.kernel),
    Stage("motions", "cartan kernel a c", "Step", orbit.motions),
    Stage("trivial", "cartan a c", "Cartan", cartan.trivialise),
    Stage("distances", "lagrangian a c", "Distances", orbit.distances),
    Stage("volumes", "a c", "Step", orbit.volumes),
    Stage("derivative", "exterior trivial a c", "Exterior", cartan.exterior_trivialised),
    Stage("balance", "derivative kernel trivial a c", "Steps", kernel.kernel_trivialised),
    Stage("momenta", "trivial a c", "MomentumForm", kernel.momentum_form),
    Stage("apart", "pullback.kinetic a c", "Step", separation.kinetic_separation, "affine"),
)
"""Exercise 1: L → L̃ → ϖ → dϖ → kernel for every matrix group, in space and carried to 𝔤."""

MATRICES = (
    Stage("general", "a pullback.moment_work trivial derivative momenta",
          "AnyGroup", specialisation.AnyGroup),
    Stage("body", "problem lagrangian a c", "Steps", body.body_step),
    Stage("brackets", "group c", "Steps", coordinates.bracket_step),
    Stage("bodies", "problem", "Bodies", inertia.invariant),
    Stage("relation", "group bodies? c", "Steps", specialisation.relation),
    Stage("plain", "group", "Alphabet", alphabet.of_matrices),
    Stage("tetrahedron", "problem group c", "Steps", orbit.tetrahedron),
    Stage("potentials", "problem plain c", "Potentials", potentials.potentials),
    Stage("special", "general group potentials c bodies?",
          "KernelOnGroup", specialisation.specialise),
    Stage("external", "problem special.letters special.C c_u",
          "External", inputs.external_matrices),
    Stage("driven", "special external?", "KernelOnGroup", specialisation.with_external),
    Stage("centred", "driven c_u", "Barycentric", separation.eliminate_translation, "affine"),
    Stage("solution", "driven centred? group c c_u", "Solution", solution.solution),
    Stage("fluid", "problem group potentials driven solution c_u",
          "Steps", dirichlet.fluid_steps),
    Stage("energy", "special.last", "Steps", tuple),
    Stage("rigid", "distances special.C special.letters c",
          "Step", orbit.rigid, "orthogonal"),
    Stage("apart", "problem potentials special.letters c",
          "Steps", separation.potential_separation, "affine"),
    Stage("held", "kernel special.C group.n c", "Step", orbit.held, "rotations"),
    Stage("space", "cartan.momentum a", "SpaceMomenta", conserved.matrix_momenta),
    Stage("conserved", "problem potentials space solution.motion special.letters c",
          "Steps", conserved.conserved_steps),
    Stage("by_momenta", "general driven centred? group c c_u",
          "Steps", by_momenta.of_matrices),
    Stage("explicit", "problem group body potentials special driven external? solution.motion "
          "pullback.steps c_u", "Steps", explicit.of_matrices),
)
"""Every group but those of VECTORS: its relations, dϖ and kernel, solved."""

VECTORS = (
    Stage("body", "problem lagrangian a c", "Steps", body.body_step),
    Stage("isometry", "trivial momenta a group.n c", "Isometry", isometry.isometry),
    Stage("rigid", "distances isometry.C isometry.letters c", "Step", orbit.rigid),
    Stage("unaligned", "lagrangian isometry.C isometry.letters c", "Step", orbit.unaligned),
    Stage("held", "kernel isometry.C group.n c", "Step", orbit.held, "linear"),
    Stage("axial", "isometry.letters isometry.C c", "Axial", isomorphism.axial_identification),
    Stage("vectors", "momenta isometry axial.hat_map c", "VectorForm", euler.vector_form),
    Stage("centred", "vectors isometry.letters c", "Eliminated", euler.eliminate, "affine"),
    Stage("euler", "vectors isometry.letters c", "Step", rotation.euler_step, "linear"),
    Stage("principal", "euler c", "Step", rotation.principal_step),
    Stage("potentials", "problem isometry.letters c isometry.C",
          "Potentials", potentials.potentials),
    Stage("torque", "potentials isometry axial.hat_map c", "Torque", rotation.torque),
    Stage("external", "problem isometry.letters isometry.C axial.hat_map c_u",
          "External", inputs.external_vectors),
    Stage("motion", "vectors torque isometry.letters axial.hat_map external? c_u",
          "Step", rotation.spherical_motion, "linear"),
    Stage("motion", "centred torque isometry.letters axial.hat_map external? c_u",
          "Step", rotation.displacement_motion, "affine"),
    Stage("tensor", "problem body axial.inertia motion c",
          "Steps", rotation.tensor_steps, "linear"),
    Stage("tensor", "problem body centred.inertia motion c",
          "Steps", rotation.tensor_steps, "affine"),
    Stage("energy", "isometry potentials axial.hat_map c", "Step", rotation.energy_step),
    Stage("space", "vectors.momenta isometry.letters", "SpaceMomenta", conserved.vector_momenta),
    Stage("conserved", "problem potentials space motion isometry.letters c",
          "Steps", conserved.conserved_steps),
    Stage("by_momenta", "vectors torque external? isometry.letters c c_u",
          "Steps", by_momenta.of_rotations, "linear"),
    Stage("by_momenta", "vectors torque external? isometry.letters c c_u",
          "Steps", by_momenta.of_displacements, "affine"),
    Stage("basis", "group isometry.letters c", "Steps", coordinates.stated_basis_step),
    Stage("explicit", "problem group body potentials torque pullback.steps axial.inertia "
          "external? motion tensor c_u", "Steps", explicit.of_vectors, "linear"),
    Stage("explicit", "problem group body potentials torque pullback.steps centred.inertia "
          "external? motion tensor c_u", "Steps", explicit.of_vectors, "affine"),
)
"""SO(3) and SE(3), by so(3) ≅ R³: Euler's equations, Kirchhoff's."""
ANY_LAGRANGIAN = (
    Stage("lagrangian", "a side c", "AnyLagrangian", any_lagrangian.any_lagrangian),
)
"""Exercise 1 for any Lagrangian on any matrix group, trivialised on one side."""

EXPRESSED = (
    Stage("basis", "problem group lagrangian c", "Basis", expressed.of_element, "element"),
    Stage("basis", "problem group lagrangian a c", "Basis", momentum_side.reduced, "reduced"),
    Stage("expressed", "problem group lagrangian basis c", "Expressed", expressed.expressed),
    Stage("balance", "expressed problem group lagrangian basis c_u", "Steps", expressed.balance),
    Stage("conserved", "expressed problem group lagrangian balance c",
          "Steps", expressed.kept),
    Stage("by_momenta", "expressed problem group lagrangian basis balance c c_u",
          "Steps", momentum_side.by_momenta),
    Stage("explicit", "problem group balance expressed.told c_u",
          "Steps", explicit.of_lagrangian),
)
"""One Lagrangian in a basis of 𝔤, its state with an element of the group, or reduced."""

FLUID = (
    Stage("points", "a c", "Points", fluid_forms.points),
    Stage("cartan", "points a c", "Cartan", fluid_forms.in_space),
    Stage("exterior", "cartan a c", "Exterior", fluid_forms.exterior_in_space),
    Stage("principle", "points cartan a c", "Principle", fluid_kernel.principle),
    Stage("relations", "a c", "Steps", fluid_forms.relations),
    Stage("trivial", "cartan points a c", "Cartan", fluid_forms.trivialised),
    Stage("derivative", "exterior trivial a c", "Exterior", fluid_forms.exterior_by_fields),
    Stage("kernel", "derivative principle a c", "FluidKernel", fluid_kernel.kernel),
    Stage("pressure", "kernel points a c", "Steps", fluid_kernel.pressure),
    Stage("advection", "a c", "Steps", circulation.advection),
    Stage("energy", "kernel trivial a c", "Step", circulation.energy_kept),
    Stage("circulation", "kernel points a c", "Steps", circulation.circulation),
    Stage("kelvin", "kernel points a c", "Steps", circulation.kelvin),
)
"""An incompressible fluid: the road of ANY_GROUP, affine, with composition for matrices."""
ON_THE_TORUS = (Stage("fluid", "problem lagrangian a c", "Steps", vorticity.torus_steps),)
"""The kinetic energy of a fluid on su(N), in the basis of the torus."""

DISCRETE = (
    Stage("lagrangian", "a c", "DiscreteLagrangian", discrete_road.lagrangian),
    Stage("ends", "lagrangian a c", "OneForms", discrete_road.one_forms),
    Stage("exterior", "ends a c", "Step", discrete_road.exterior),
    Stage("motion", "ends a c", "DiscreteMotion", discrete_road.motion),
    Stage("blocks", "motion a c", "BlockMotion", discrete_blocks.in_blocks, "affine"),
    Stage("forces", "problem group a plain here", "DiscreteForces", discrete_forces.forces),
    Stage("outside", "problem motion group forces driven", "Outside", discrete_forces.outside),
    Stage("own", "motion blocks? group forces outside? driven", "Steps", discrete_group.of_group),
    Stage("conserved", "ends motion a group forces here", "Steps", discrete_forces.conserved),
)
"""The discrete road: L_d → Θ⁺, Θ⁻ → dΘ⁺ = dΘ⁻ → the motion, then on one group."""
# fmt: on


@naming_steps()
def walk(problem: Problem) -> Derivation:
    """Derive the equations of motion of a problem; ``WalkError`` names the step that a rule of the
    engine breaks."""
    group, given = problem.group, problem.lagrangian
    if problem.fluid:
        a = FluidAlphabet(
            problem.name,
            advected=problem.fluid.density == "advected",
            forced=problem.fluid.forces == "potential",
        )
        values = follow(FLUID, {"a": a, "c": Chapter(problem.name, problem.group_name)}, ())
    elif problem.torus:
        values = lagrangian_road("right")
    elif given is not None:
        values = lagrangian_road(given.trivialisation)
    else:
        values = general_road(affine=problem.affine, signed=problem.signed)
    steps = values["steps"]
    if group is not None:
        c = Chapter(problem.name, group.name)
        acting = c.with_input() if acts(problem) else c
        own = {"problem": problem, "group": group, "c": c, "c_u": acting}
        road = EXPRESSED if given else VECTORS if group.turns_space else MATRICES
        kinds = {"affine" if group.affine else "linear", *group.relations}
        kinds |= {"element" if problem.advected is None else "reduced"}
        kinds |= {"rotations"} if turns_whole(group) and not group.affine else set()
        steps += by_name(problem, follow(road, values | own, kinds)["steps"])
    if problem.torus:
        own = {"problem": problem, "c": Chapter(problem.name, problem.torus.name)}
        steps += follow(ON_THE_TORUS, values | own, ())["steps"]
    steps = supposing_all(traced(steps))
    return Derivation(problem_data(problem), symbols(steps, problem), steps)


@naming_steps()
def discrete(problem: Problem) -> Derivation:
    """Derive the discrete equations of motion of a problem; ``ProblemError`` where it has
    none."""
    discrete_group.require(problem)
    group = problem.group
    affine = problem.affine
    a = DiscreteAlphabet("size" if affine else "n", affine=affine)
    start = {"a": a, "c": Chapter(a.chapter), "problem": problem}
    if group:
        own = {"group": group, "plain": alphabet.of_matrices(group)}
        here = Chapter(problem.name, group.name)
        acting = here.with_input() if acts(problem) else here
        start |= own | {"here": here, "driven": acting}
    steps = follow(DISCRETE, start, {"affine" if affine else "linear"})["steps"]
    steps = supposing_all(traced(by_name(problem, steps, discrete=True) if group else steps))
    data = problem_data(problem) | {"discrete": True}
    return Derivation(data, symbols(steps, problem, discrete=True), steps)


@cache
def general_road(*, affine: bool, signed: bool = False) -> Values:
    """The road of any group, which several problems share; ``signed``: masses may be negative."""
    a = Alphabet("n", affine=affine, signed=signed)
    start = {"a": a, "c": Chapter(a.chapter)}
    return follow(ANY_GROUP, start, {"affine" if affine else "linear"})


@cache
def lagrangian_road(side: str) -> Values:
    """The road of any Lagrangian, trivialised on the ``left`` or on the ``right``."""
    start = {"a": Alphabet("n", affine=False), "side": side, "c": Chapter(side)}
    return follow(ANY_LAGRANGIAN, start, ())


def both_trivialisations(record: Derivation) -> Derivation:
    """A record behind what holds for any Lagrangian, on the left beside the right; to be read."""
    from .schema.kind import Lagrangian
    from .views.rendering import both_sides

    sides = (Lagrangian(L=0, trivialisation=side) for side in ("left", "right"))
    left, right = (walk(Problem(x.trivialisation, None, lagrangian=x)) for x in sides)
    return both_sides(record, left, right)


def integrals(
    problem: Problem, degree: int = 4, *, at_defaults: bool = False, conditions: bool = False
) -> tuple[IntegralsFound, Derivation]:
    """The polynomial integrals of the reduced equations of a problem up to a degree, and its record
    with the steps that tell them; of points by their Lagrangian as one expression.

    Without the inputs of the problem; ``at_defaults``: with numbers for its parameters;
    ``conditions``: with those on the parameters under which there are more.
    """
    from .search.integrals.all_integrals import found
    from .search.integrals.integral_steps import told
    from .search.integrals.reduced import reduced, require_group, with_defaults
    from .search.symmetries.scalar_lagrangian import with_scalar_lagrangian

    require_group(problem)
    driven, problem = bool(problem.inputs), replace(problem, inputs=())
    if problem.lagrangian is None:
        problem = with_scalar_lagrangian(problem, walk(problem))
    problem = with_defaults(problem) if at_defaults else problem
    whole = found(reduced(problem), degree)
    if conditions:
        from .search.integrals.special_parameters import conditions as conditions_of

        whole = replace(whole, conditions=conditions_of(whole))
    assert problem.group is not None
    record = walk(problem)
    c = Chapter(problem.name, problem.group.name)
    steps = supposing_all(traced((*record.steps, *told(whole, record.steps, c, driven=driven))))
    return whole, Derivation(record.problem, symbols(steps, problem), steps)


def equilibrium_near(
    problem: Problem, values: Mapping[str, Number], degree: int = 4
) -> tuple[Enclosed, Derivation]:
    """The equilibrium of a problem near a point, enclosed, and the record of its integrals up to a
    degree with the steps that tell it; parameters have their defaults."""
    from .search.equilibria.enclosed_points import enclosed
    from .search.equilibria.equilibrium_steps import told_enclosed
    from .search.equilibria.stability import require_numbers

    whole, record = integrals(problem, degree, at_defaults=True)
    try:
        require_numbers(whole)
        found = enclosed(whole, _of_variables(problem, values), _elements(problem, whole))
    except Refused as error:
        raise ProblemError(f"{problem.name}: {error}") from None
    assert problem.group is not None
    c = Chapter(problem.name, problem.group.name)
    steps = (*record.steps, *told_enclosed(whole, found, record.steps, c))
    return found, replace(record, steps=supposing_all(traced(steps)))


def _of_variables(problem: Problem, values: Mapping[str, Number]) -> dict[str, Number]:
    """The coordinates of a point by the names of the reduced variables: A_44 is A2_11 in the
    problem, where its group is a product."""
    from .problem.fields import state_names
    from .search.equilibria.equilibrium_points import coordinate

    assert problem.group is not None
    own = state_names(problem.group)
    entries = {x for x, t in own.items() if isinstance(t, tuple) and t[1] == "A"}
    return {coordinate(own[x]) if x in entries else x: v for x, v in values.items()}


def _elements(problem: Problem, whole: IntegralsFound) -> tuple[EntryConditions, ...]:
    """What the entries of g satisfy that are among the variables of the reduced equations."""
    from .search.equilibria.entries_of_elements import conditions

    assert problem.group is not None
    left = problem.lagrangian is None or problem.lagrangian.trivialisation == "left"
    return conditions(whole.system, problem.group, left=left)


def equilibria(
    problem: Problem, values: Mapping[str, Number], degree: int = 4
) -> tuple[tuple[Equilibrium, ...], Derivation]:
    """The relative equilibrium of a problem at a point, or those among some points where no values
    are given, and the record of its integrals up to a degree with the steps that tell them;
    parameters have their defaults."""
    from .search.equilibria.equilibrium_steps import told
    from .search.equilibria.stability import equilibria_of

    whole, record = integrals(problem, degree, at_defaults=True)
    try:
        point = _of_variables(problem, values)
        found = equilibria_of(whole, point, _elements(problem, whole))
    except Refused as error:
        raise ProblemError(f"{problem.name}: {error}") from None
    assert problem.group is not None
    c = Chapter(problem.name, problem.group.name)
    steps = told(whole, found, record.steps, c, tried=not values)
    steps = supposing_all(traced((*record.steps, *steps)))
    return found, replace(record, steps=steps)


def symmetries(problem: Problem, record: Derivation) -> Symmetries:
    """All symmetries of the Lagrangian of a problem, by its record, and a record of them;
    ``ProblemError`` where there is no Lagrangian of its own."""
    from .search.symmetries.found_symmetries import symmetries_of
    from .search.symmetries.symmetry_steps import Symmetries, record_of

    found = symmetries_of(problem, record, of_integrand=True)
    general = lagrangian_road(found.lagrangian.trivialisation)
    return Symmetries(found, record_of(found, general))


def reduction(problem: Problem, record: Derivation) -> Reduction:
    """Routh's reduction of a problem by symmetries that commute, by its record, and a record of it;
    ``ProblemError`` where there is nothing to reduce by."""
    from .search.reduction.reduction_steps import record_of
    from .search.symmetries.found_symmetries import symmetries_of

    found = symmetries_of(problem, record)
    return record_of(found, lagrangian_road(found.lagrangian.trivialisation))


def conserved_quantities(problem: Problem, record: Derivation) -> dict[str, Tree]:
    """Name → what the motion keeps: by each symmetry, else by Casimirs and integrals up to degree
    4 of the reduced equations; of these what no symmetry gives stands beside symmetries, too."""
    from .search.integrals.integral_steps import first_integrals
    from .search.symmetries.found_symmetries import kept_with_damping, named, symmetries_of

    if problem.damping:
        return named(kept_with_damping(problem, record))
    if problem.advected is not None:
        return first_integrals(problem)
    found = symmetries_of(problem, record, of_integrand=True)
    if found.integrand:
        return named(found)
    return named(found) | first_integrals(found.problem, beside_symmetries=True)


def kept_without_gravity(problem: Problem) -> dict[str, Tree]:
    """Name → what the motion keeps where gravity is 0; nothing of a problem without gravity."""
    from .schema.kinds.gravity import Gravity

    left = tuple(x for x in problem.potentials if not isinstance(x, Gravity))
    if len(left) == len(problem.potentials):
        return {}
    bare = replace(problem, potentials=left)
    try:
        return conserved_quantities(bare, walk(bare))
    except Refused:  # damping leaves nothing
        return {}


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
    from .search.reduction.quadrature import leaves_one, momenta_of
    from .search.reduction.reduction_steps import record_of
    from .search.symmetries.found_symmetries import symmetries_of

    try:
        found = symmetries_of(problem, record)
        if not leaves_one(found):
            return None
        general = lagrangian_road(found.lagrangian.trivialisation)
        reduced = record_of(found, general)
    except Refused:
        return None
    left = reduced.quadrature
    if left is None or not isinstance(left.entry, tuple) or reduced.routhian.named:
        return None
    told = reduced.record[f"{problem.name}.effective"].equations
    V = next(e.rhs for e in told if e.lhs == "𝒱")
    turns = problem.group is not None and "orthogonal" in problem.group.relations
    return OneDegree((left.entry[2], left.entry[3]), V, momenta_of(found), turns)


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
        from .code.torus.torus_program import torus_program

        return torus_program(record, problem.torus, options, events)
    assert problem.group
    if options is None or options.frame == "given":
        kept = conserved_quantities(problem, record) if options and options.conserved else None
        more = kept_without_gravity(problem) if kept is not None and weightless else {}
        more = {name: t for name, t in more.items() if name not in (kept or {})}
        every = None if kept is None else kept | more
        stepped = discrete(problem) if options and "discrete" in options.step else None
        made = assemble(record, problem.group, options, kept=every, events=events, discrete=stepped)
        return replace(made, weightless=(*more,))
    return assemble(record, problem.group, options, walk(principal(problem)))


def require_program(problem: Problem, record: Derivation, options: Options | None = None) -> None:
    """Refuse options that exclude one another or the problem, before anything is made of it:
    ``LoweringError``, or ``ProblemError`` where it has no code, or no such frame."""
    from .code.options import Options
    from .code.requests import require_written
    from .code.torus.torus_program import require_on_torus
    from .code.watched_functions import watched

    chosen = options or Options()
    watched(problem.name, problem.events, chosen)
    if problem.torus:
        require_on_torus(record, chosen)
    elif problem.group is None:
        raise ProblemError(
            f"{problem.name}: {problem.without_matrices}, so it has no numeric code; "
            f"{problem.with_matrices}"
        )
    else:
        require_written(record, problem.group, chosen)
        if chosen.frame == "principal":
            principal(problem)
