"""The whole road on one screen: the stages from a problem to its record, a table that is run.

A row: the stage, what it takes, the type of what it gives, its function (``walk.stages`` runs it);
a: the letters of any group, c: the chapter that the steps belong to, c_u: the same where an input
acts.  From the record the road goes on in ``derive.code``: assemble (which reads it, lowers,
factors and schedules) → program → emit, by the signatures and the templates; the checker, the paper
and the views read it, too.
"""

from __future__ import annotations

from functools import cache

# fmt: off
# isort: off
from .problem import inertia
from .problem.problem import (Problem)
from .record.record import Derivation
from .walk.chapter import Chapter, Stage, Values, follow, naming_steps
from .walk.discrete import discrete_blocks, discrete_forces, discrete_group, discrete_road
from .walk.discrete.discrete_road import DiscreteAlphabet
from .walk.fluid import dirichlet
from .walk.fluid import circulation, fluid_forms, fluid_kernel
from .walk.fluid.fluid_forms import FluidAlphabet
from .walk.given import (body_and_potentials, inputs, outputs)
from .walk.lie import from_outside
from .walk.given.inputs import acts, by_name
from .walk.lie import invariant_errors
from .walk.lie import (any_lagrangian, expressed, momentum_side)
from .walk.matrices import (conserved, coordinates, explicit, specialisation, separation, solution)
from .walk.matrices.specialisation import turns_whole
from .walk.spine import alphabet, cartan, kernel, lagrangian, orbit, principle
from .walk.spine.alphabet import Alphabet
from .walk.spine.head import recorded
from .walk.fluid import vorticity
from .walk.matrices import by_momenta
from .walk.matrices import euler
from .walk.matrices import isomorphism
from .walk.matrices import rotation
# isort: on

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
    Stage("body", "problem lagrangian a c", "Steps", body_and_potentials.body_step),
    Stage("brackets", "group c", "Steps", coordinates.bracket_step),
    Stage("bodies", "problem", "Bodies", inertia.invariant),
    Stage("relation", "group bodies? c", "Steps", specialisation.relation),
    Stage("plain", "group", "Alphabet", alphabet.of_matrices),
    Stage("tetrahedron", "problem group c", "Steps", orbit.tetrahedron),
    Stage("potentials", "problem plain c", "Potentials", body_and_potentials.potentials),
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
    Stage("power", "problem external? special.letters special.C trivial body pullback.steps "
          "potentials conserved? solution.motion c_u", "Steps", from_outside.of_points),
    Stage("by_momenta", "general driven centred? group c c_u",
          "Steps", by_momenta.of_matrices),
    Stage("outputs", "problem group special.letters special.C solution.steps power c_u",
          "Steps", outputs.of_matrices),
    Stage("particulars", "problem group body pullback.steps potentials external?",
          "Particulars", explicit.Particulars),
    Stage("explicit", "particulars special driven solution.motion c_u",
          "Steps", explicit.of_matrices),
)
"""Every group but those of VECTORS: its relations, dϖ and kernel, solved."""

VECTORS = (
    Stage("body", "problem lagrangian a c", "Steps", body_and_potentials.body_step),
    Stage("isometry", "trivial momenta a group.n c", "Isometry", specialisation.isometry),
    Stage("rigid", "distances isometry.C isometry.letters c", "Step", orbit.rigid),
    Stage("unaligned", "lagrangian isometry.C isometry.letters c", "Step", orbit.unaligned),
    Stage("held", "kernel isometry.C group.n c", "Step", orbit.held, "linear"),
    Stage("axial", "isometry.letters isometry.C c", "Axial", isomorphism.axial_identification),
    Stage("vectors", "momenta isometry axial.hat_map c", "VectorForm", euler.vector_form),
    Stage("centred", "vectors isometry.letters c", "Eliminated", euler.eliminate, "affine"),
    Stage("euler", "vectors isometry.letters c", "Step", rotation.euler_step, "linear"),
    Stage("principal", "euler c", "Step", rotation.principal_step),
    Stage("potentials", "problem isometry.letters c isometry.C",
          "Potentials", body_and_potentials.potentials),
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
    Stage("power", "problem external? isometry.letters isometry.C trivial body pullback.steps "
          "potentials conserved? motion c_u", "Steps", from_outside.of_points),
    Stage("by_momenta", "vectors torque external? isometry.letters c c_u",
          "Steps", by_momenta.of_rotations, "linear"),
    Stage("by_momenta", "vectors torque external? isometry.letters c c_u",
          "Steps", by_momenta.of_displacements, "affine"),
    Stage("basis", "group isometry.letters c", "Steps", coordinates.user_basis_step),
    Stage("outputs", "problem group isometry.letters isometry.C axial.hat_map motion power c_u",
          "Steps", outputs.of_vectors),
    Stage("particulars", "problem group body pullback.steps potentials external?",
          "Particulars", explicit.Particulars),
    Stage("explicit", "particulars torque axial.inertia motion tensor c_u",
          "Steps", explicit.of_vectors, "linear"),
    Stage("explicit", "particulars torque centred.inertia motion tensor c_u",
          "Steps", explicit.of_vectors, "affine"),
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
          "Steps", expressed.conserved),
    Stage("power", "problem group lagrangian balance c_u", "Steps", from_outside.of_lagrangian),
    Stage("by_momenta", "expressed problem group lagrangian basis balance c c_u",
          "Steps", momentum_side.by_momenta),
    Stage("outputs", "problem group balance power c_u", "Steps", from_outside.outputs),
    Stage("explicit", "problem group balance expressed.momenta_step c_u",
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
    Stage("forcing", "kernel a c_u", "FluidKernel", fluid_kernel.forcing),
    Stage("pressure", "forcing points a c_u", "Steps", fluid_kernel.pressure),
    Stage("advection", "a c", "Steps", circulation.advection),
    Stage("energy", "forcing trivial a c_u", "Step", circulation.energy),
    Stage("circulation", "forcing points a c_u", "Steps", circulation.circulation),
    Stage("kelvin", "forcing points a c_u", "Steps", circulation.kelvin),
)
"""An incompressible fluid: the road of ANY_GROUP, affine, with composition for matrices."""
KINEMATICS = (Stage("errors", "problem group c", "Steps", invariant_errors.kinematics_steps),)
"""A motion of first order on a group, and the errors of an estimate of it."""
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
            given=problem.fluid.forces == "given",
        )
        c = Chapter(problem.name, problem.group_name)
        acting = c.with_input() if a.given else c
        values = follow(FLUID, {"a": a, "c": c, "c_u": acting}, ())
    elif problem.torus:
        values = lagrangian_road("right")
    elif problem.kinematics:
        values = {"steps": ()}
    elif given is not None:
        values = lagrangian_road(given.trivialisation)
    else:
        values = general_road(affine=problem.affine, signed=problem.signed)
    steps = values["steps"]
    if group is not None:
        c = Chapter(problem.name, group.name)
        acting = c.with_input() if acts(problem) else c
        own = {"problem": problem, "group": group, "c": c, "c_u": acting}
        given_road = KINEMATICS if problem.kinematics else EXPRESSED if given else ()
        road: tuple[Stage, ...] = given_road or (VECTORS if group.turns_space else MATRICES)
        kinds = {"affine" if group.affine else "linear", *group.relations}
        kinds |= {"element" if problem.advected is None else "reduced"}
        if problem.flows:  # what is said of Π̇ and of momenta in space is of masses that stay
            road = tuple(x for x in road if x.name not in ("by_momenta", "conserved"))
        kinds |= {"rotations"} if turns_whole(group) and not group.affine else set()
        steps += by_name(problem, follow(road, values | own, kinds)["steps"])
    if problem.torus:
        own = {"problem": problem, "c": Chapter(problem.name, problem.torus.name)}
        steps += follow(ON_THE_TORUS, values | own, ())["steps"]
    return recorded(problem, steps)


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
    steps = by_name(problem, steps, discrete=True) if group else steps
    return recorded(problem, steps, discrete=True)


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
