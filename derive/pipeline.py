"""The whole road on one screen: from a problem to its record.

    stage       input                        output        module
    ----------  ---------------------------  ------------  -------------------------------------
    lagrangian  letters                      Lagrangian    walk.lagrangian     of one point
    pull-back   Lagrangian                   Pullback      walk.pullback
    Cartan      Pullback                     Cartan        walk.cartan         in space
    exterior    Cartan                       Exterior      walk.exterior
    principle   Lagrangian, Pullback, Cartan Principle     walk.variation
    kernel      Exterior, Principle          Ambient       walk.kernel
    trivial     the three before             the same      cartan, exterior, kernel, carried to 𝔤
    momentum    Cartan, carried to 𝔤         MomentumForm  walk.momentum       ϖ, dϖ, kernel by P, F
                                                           a Lagrangian on the group enters here
    special     General, Potentials          Special       walk.special        a group: dϖ, kernel
    translation Special                      Centred       walk.translation    H ⋉ Rⁿ
    centre      Special                      Seen          walk.centre         products, H skew
    multipliers Special or Centred           steps         walk.multipliers    codimension 0 or 1
    mass        any of the three             steps         walk.mass           the others
    isometry    Cartan, MomentumForm         Isometry      walk.isometry       SO(3), SE(3): dϖ
    hat         Isometry                     hat.Reader    walk.hat            so(3) ≅ R³
    vectors     MomentumForm, Isometry       VectorForm    walk.vector         ℓ_b, p_b; Kirchhoff
    elimination VectorForm                   Eliminated    walk.elimination    SE(3)
    motion      VectorForm or Eliminated     steps         walk.rotation       SO(3), SE(3)
    conserved   momenta in space             steps         walk.conserved      Noether

What a group's dϖ is, ``special`` and ``isometry`` have by walk.restrict: P = (Π, p_b), F = (Φ, F_b)
take their values.  Beside the road stand the steps of the body, the potentials and the inputs
(walk.body, potential, pushes, inputs), and those that tell of it: orbit, motions, brackets, axes,
coadjoint (SO(n), SE(n)), coordinates, components, separation.

The road goes on from the record, in ``derive.code``: reader → lower → assemble → factor → schedule
→ program → apart → statements → the templates.

Every stage returns its value together with the steps it took; the record is their sequence, with
what each uses (walk.lineage) and supposes (walk.supposed).
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

from .algebra.groups import Group
from .problem.data import data
from .problem.left_invariant import invariant
from .problem.principal import principal
from .problem.problem import ForceInput, Problem, ProblemError
from .record.record import Derivation, Step, Symbol, encode
from .record.sentence import Prose, Sentence, listed, phrase, say
from .record.uses import of_steps
from .record.vocabulary import CONVENTIONS, DISPLACEMENTS, PRODUCTS, ROTATIONS, VOCABULARY, Name
from .walk.alphabet import Alphabet
from .walk.body import body_step
from .walk.brackets import bracket_step
from .walk.cartan import cartan, trivialise
from .walk.centre import seen_from_centres
from .walk.chapter import Chapter
from .walk.components import tensor_steps
from .walk.conserved import conserved_steps, matrix_momenta, vector_momenta
from .walk.coordinates import coordinates_step, stated_basis_step
from .walk.elimination import eliminate
from .walk.exterior import exterior, exterior_trivialised
from .walk.failure import naming_steps
from .walk.hat import identified
from .walk.inputs import given_matrices, given_vectors
from .walk.isometry import Isometry, isometry
from .walk.isomorphism import isomorphism
from .walk.kernel import kernel, kernel_trivialised
from .walk.lagrangian import lagrangian
from .walk.lineage import traced
from .walk.mass import mass_steps
from .walk.momentum import MomentumForm, momentum_form
from .walk.motions import held, motions
from .walk.multipliers import multiplier_steps
from .walk.orbit import distances, rigid, unique
from .walk.potential import potentials
from .walk.pullback import pullback
from .walk.rotation import (
    displacement_motion,
    energy_step,
    euler_step,
    principal_step,
    spherical_motion,
    torque_step,
)
from .walk.separation import kinetic_separation, potential_separation
from .walk.special import General, Special, specialise, turns_whole
from .walk.supposed import supposing_all
from .walk.translation import eliminate_translation
from .walk.variation import principle
from .walk.vector import vector_form

if TYPE_CHECKING:
    from .code.options import Options
    from .code.program import Program

Steps = tuple[Step, ...]

MULTIPLIERS = 1
"""Through the normal space of 𝔤 where it has so many dimensions: the counted operations of the
emitted code are then fewer than through the mass matrix (tests/walk/test_roads.py)."""


@naming_steps()
def walk(problem: Problem) -> Derivation:
    """Derive the equations of motion of a problem; ``WalkError`` names the step that a rule of the
    engine breaks."""
    road = general_road(affine=problem.affine, signed=problem.signed)
    steps = road.steps
    if problem.group is not None:
        steps += road_of(problem, problem.group, road)
    steps = supposing_all(traced(steps))
    return Derivation(_data(problem), _symbols(steps, problem), steps)


def program(problem: Problem, record: Derivation, options: Options | None = None) -> Program:
    """The program of a problem; in its principal frame that is the program of another problem."""
    from .code.assemble import assemble

    if problem.group is None:
        raise ProblemError(
            f"{problem.name}: this text is about any group, so it has nothing to emit; choose a "
            "problem with a group and a body"
        )
    if options is None or options.frame == "given":
        return assemble(record, problem.group, options)
    return assemble(record, problem.group, options, walk(principal(problem)))


@cache
def general_road(*, affine: bool, signed: bool = False) -> General:
    """The road of any group, which several problems share; ``signed``: masses may be negative."""
    return road_of_any_group(Alphabet("n", affine=affine, signed=signed))


def road_of_any_group(a: Alphabet) -> General:
    """Exercise 1: L → L̃ → ϖ → dϖ → kernel for every matrix group, in space and trivialised."""
    c = Chapter(a.chapter)
    L = lagrangian(a, c)
    pulled = pullback(L, a, c)
    form = cartan(pulled, a, c)
    derivative = exterior(form, a, c)
    extremal = principle(L, pulled, form, a, c)
    ambient = kernel(derivative, extremal, a, c)
    trivial = trivialise(form, a, c)
    trivial_derivative = exterior_trivialised(derivative, trivial, a, c)
    motion = kernel_trivialised(trivial_derivative, ambient, trivial, a, c)
    momenta = momentum_form(trivial, a, c)
    lengths = distances(L, a, c)
    whole = motions(form, ambient, a, c)
    first = (*L.steps, *pulled.steps, unique(L, pulled.moments, a, c))
    second = (*form.steps, *derivative.steps, *extremal.steps, *ambient.steps, whole)
    third = (*trivial.steps, lengths.step, *trivial_derivative.steps, *motion, *momenta.steps)
    steps = (*first, *second, *third)
    if a.affine:
        steps += (kinetic_separation(pulled.kinetic, a, c),)
    return General(
        letters=a,
        points=L,
        momentum=form.momentum,
        pushed=pulled.pushed,
        cartan=trivial,
        exterior=trivial_derivative,
        momenta=momenta,
        distances=lengths,
        ambient=ambient,
        steps=steps,
    )


def road_of(problem: Problem, group: Group, road: General) -> Steps:
    """The specialisation to the group, the body and the potentials of the problem."""
    c = Chapter(problem.name, group.name)
    first = body_step(problem, road.points, road.letters, c)
    if group.turns_space:
        stage = isometry(road.cartan, road.momenta, road.letters, group.n, c)
        solid: Steps = (rigid(road.distances, stage.gram, stage.letters, c),)
        if not group.affine:
            solid += (held(road.ambient, stage.gram, group.n, c),)
        opening = (*first, *stage.steps, *solid)
        return opening + road_of_space(problem, road.momenta, stage, first, c)
    v = potentials(problem, Alphabet(group.n, affine=group.affine), c)
    own = specialise(road, group, v, c, invariant(problem))
    last: Steps = potential_separation(problem, v, own.letters, c) if group.affine else ()
    in_space = matrix_momenta(road.momentum, road.letters)
    steps, motion = road_of_matrices(problem, group, own, c)
    kept = conserved_steps(problem, v, in_space, motion, own.letters, c, vectors=False)
    if "orthogonal" in group.relations:
        last = (rigid(road.distances, own.gram, own.letters, c), *last)
    if turns_whole(group) and not group.affine:
        last = (*last, held(road.ambient, own.gram, group.n, c))
    return (*first, *bracket_step(group, c), *steps, *own.last, *last, *kept)


def road_of_matrices(
    problem: Problem, group: Group, stage: Special, c: Chapter
) -> tuple[Steps, Step]:
    """Any other group: the translation eliminated, then one multiplier or the mass matrix.

    Also: the step of the motion.
    """
    b, steps = stage.letters, stage.steps
    multiplied = len(group.normal_space_of_linear_parts) <= MULTIPLIERS
    place = coordinates_step(group, b, c, reading=multiplied or bool(group.centred))
    given = given_matrices(problem, b, stage.gram, c.with_input())
    if given is not None:
        stage = stage.pushed(given.moments, given.resultant)
        c = c.with_input()
        steps += given.steps
    inertial, force, metric = stage.inertial, stage.forces[b.Z.xi_prime], b.J
    centred = eliminate_translation(stage, c) if group.affine else None
    if centred is not None:
        inertial, force, metric = centred.inertial, centred.force, centred.metric
        steps += centred.steps
    if multiplied:
        _, motion, _ = solved = multiplier_steps(inertial, force, metric, group, b, c, centred)
        return (*steps, *solved, place), motion
    seen = seen_from_centres(inertial, force, group, b, c)
    if seen is not None:
        _, motion = solved = mass_steps(
            seen.inertial, seen.force, place, b, c, balanced=False, seen=seen
        )
        return (*steps, *seen.steps, *solved, place), motion
    told = stage.bodies is None
    _, motion = solved = mass_steps(inertial, force, place, b, c, centred, balanced=told)
    return (*steps, place, *solved), motion


def road_of_space(
    problem: Problem, momenta: MomentumForm, stage: Isometry, body: Steps, c: Chapter
) -> Steps:
    """SO(3) and SE(3) in vectors: Euler's equations and principal axes, or the translation
    eliminated; then the forces of the problem and what is given."""
    b = stage.letters
    read, named = identified(b, stage.gram, c)
    vectors = vector_form(momenta, stage, read, c)
    v = potentials(problem, b, c, stage.gram)
    given = given_vectors(problem, b, stage.gram, read, c.with_input())
    forces, torque = torque_step(v, stage, read, c)
    if b.affine:
        eliminated = eliminate(vectors, b, c)
        steps: Steps = eliminated.steps
        motion = displacement_motion(eliminated, forces, b, read, given, c)
    else:
        euler = euler_step(vectors, b, c)
        steps = (euler, principal_step(euler, c))
        motion = spherical_motion(vectors, forces, b, read, given, c)
    inertia = steps[0] if b.affine else named[1]
    in_space = vector_momenta(vectors.momenta.values(), b)
    return (
        named[0],
        isomorphism(read, c),
        named[1],
        *vectors.steps,
        *steps,
        *v.steps,
        torque,
        *(given.steps if given else ()),
        motion,
        *(tensor_steps(problem, body[-1], inertia, motion, c) if body else ()),
        energy_step(stage, v, read, c),
        *conserved_steps(problem, v, in_space, motion, b, c, vectors=True),
        *stated_basis_step(problem.group, b, c),
    )


def _data(problem: Problem) -> dict[str, object]:
    """The problem as JSON data: trees encoded."""

    def plain(x: object) -> object:
        if isinstance(x, dict):
            return {k: plain(v) for k, v in x.items()}
        if isinstance(x, list):
            return [plain(v) for v in x]
        return encode(x) if isinstance(x, (tuple, Fraction)) else x

    basis = problem.group.stated.basis if problem.group else ()
    rows = [[[str(x) for x in row] for row in e] for e in basis]
    n = problem.group.n if problem.group else "any"
    found = data(problem) | {"n": n, "basis": rows, "conventions": list(CONVENTIONS)}
    return {k: plain(v) for k, v in found.items()}


def _symbols(steps: Steps, problem: Problem) -> tuple[Symbol, ...]:
    """The names that the steps use, in the order in which they appear."""
    meant, group = _meant(problem), problem.group
    sizes = _sizes(group) if group else {}
    said = {x: say(about.meaning) for x, about in meant.items()}
    if problem.pushes:
        said["f_u"] = _inputs(problem)
    used = of_steps(steps, meant, sizes)
    return tuple(Symbol(x, said[x], meant[x].latex, uses) for x, uses in used.items())


def _sizes(group: Group) -> dict[str, int]:
    """What the letters of sizes stand for; a block is of none where the factors are of several."""
    sizes = {"n": group.n, "d": len(group.linear_basis), "dim": group.dimension}
    blocks = {factor.n for _, factor in group.places}
    return sizes | ({"block": blocks.pop()} if len(blocks) == 1 else {})


def _meant(problem: Problem) -> dict[str, Name]:
    """What the names mean in a problem."""
    group = problem.group
    blocks = PRODUCTS if group and group.factors and not group.affine else {}
    turning = group is not None and group.turns_space
    own = dict(DISPLACEMENTS if group and group.affine else ROTATIONS) if turning else {}
    return VOCABULARY | own | blocks


def _inputs(problem: Problem) -> Prose:
    """What f_u means where forces are given."""
    forces, group = [_force(x) for x in problem.pushes], problem.group
    if problem.covector and group and group.turns_space and group.affine:
        at_origin = "{name}, a force on the body's origin, in the body frame"
        forces.insert(0, phrase(at_origin, name=problem.covector.name))
    return say("input: {forces}", forces=listed("{first}; {second}", forces))


def _force(given: ForceInput) -> Sentence:
    """A force that is given at every call, in words."""
    if given.frame == "body":
        in_frame = "{name}, a force on point {point}, in the body frame"
    else:
        in_frame = "{name}, a force on point {point}, in the space frame"
    return phrase(in_frame, name=given.name, point=str(given.on))
