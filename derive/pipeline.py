"""The whole road on one screen: from a problem to its record.

    stage       input                 output        module
    ----------  --------------------  ------------  ----------------
    lagrangian  letters               Lagrangian    walk.lagrangian
    pull-back   Lagrangian            Pullback      walk.pullback
    Cartan      Pullback              Cartan        walk.cartan
    exterior    Cartan                Exterior      walk.exterior
    kernel      Exterior              Kernel        walk.kernel
    isometry    Cartan                Isometry      walk.isometry      SO(3), SE(3)
    vectors     Isometry              VectorForm    walk.vector        n = 3
    elimination VectorForm            Eliminated    walk.elimination   SE(3)
    special     General, Potentials   Special       walk.special       any other group
    translation Special               Centred       walk.translation   H ⋉ Rⁿ
    multipliers Special or Centred    steps         walk.multipliers   codimension 0 or 1 in gl(n)
    mass        Special or Centred    steps         walk.mass          the others, in coordinates
    motion      all of these          steps         walk.rotation

Every stage returns its value together with the steps it took; the record is their sequence.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

from .algebra.groups import Group
from .algebra.tree import names
from .mechanics.data import data
from .mechanics.frame import principal
from .mechanics.problem import ForceInput, Problem, ProblemError
from .record.record import Derivation, Step, Symbol, encode
from .record.sentence import Sentence, listed, phrase, say
from .record.vocabulary import CONVENTIONS, DISPLACEMENTS, PRODUCTS, ROTATIONS, VOCABULARY
from .walk.alphabet import Alphabet
from .walk.body import body_step
from .walk.cartan import cartan, trivialise
from .walk.chapter import Chapter
from .walk.components import tensor_steps
from .walk.conserved import conserved_steps, matrix_momenta, vector_momenta
from .walk.coordinates import coordinates_step
from .walk.elimination import eliminate
from .walk.exterior import exterior, exterior_trivialised
from .walk.inputs import given_matrices, given_vectors
from .walk.isometry import Isometry, isometry
from .walk.kernel import kernel, kernel_trivialised
from .walk.lagrangian import lagrangian
from .walk.mass import mass_steps
from .walk.multipliers import multiplier_steps
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
from .walk.special import General, Special, specialise
from .walk.translation import eliminate_translation
from .walk.vector import vector_form

if TYPE_CHECKING:
    from .code.options import Options
    from .code.program import Program

Steps = tuple[Step, ...]

MULTIPLIERS = 1
"""Through the normal space of 𝔤 where it has so many dimensions: the counted operations of the
emitted code are then fewer than through the mass matrix (tests/test_roads.py)."""


def walk(problem: Problem) -> Derivation:
    """Derive the equations of motion of a problem."""
    road = general_road(affine=problem.affine)
    steps = road.steps
    if problem.group is not None:
        steps += road_of(problem, problem.group, road)
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
def general_road(*, affine: bool) -> General:
    """The road of any group, which several problems share."""
    return road_of_any_group(Alphabet("n", affine=affine), "affine" if affine else "linear")


def road_of_any_group(a: Alphabet, name: str) -> General:
    """Exercise 1: L → L̃ → ϖ → dϖ → kernel for every matrix group, in space and trivialised."""
    L = lagrangian(a, name)
    pulled = pullback(L, a, name)
    form = cartan(pulled, a, name)
    derivative = exterior(form, a, name)
    ambient = kernel(derivative, a, name)
    trivial = trivialise(form, a, name)
    trivial_derivative = exterior_trivialised(derivative, trivial, a, name)
    motion = kernel_trivialised(trivial_derivative, a, name)
    stages = (L, pulled, form, derivative, ambient, trivial, trivial_derivative, motion)
    steps = tuple(step for stage in stages for step in stage.steps)
    if a.affine:
        steps += (kinetic_separation(pulled.kinetic, a, name),)
    return General(name, a, form.momentum, trivial, trivial_derivative, motion, steps)


def road_of(problem: Problem, group: Group, road: General) -> Steps:
    """The specialisation to the group, the body and the potentials of the problem."""
    name, scope = problem.name, group.name
    first = body_step(problem, name, scope)
    chapter = Chapter(name, road.name, scope)
    if group.turns_space:
        stage = isometry(road.cartan, road.letters, group.n, name, road.name, scope)
        return first + stage.steps + road_of_space(problem, stage, chapter)
    v = potentials(problem, Alphabet(group.n, affine=group.affine), name, road.name, scope)
    own = specialise(road, group, v, chapter)
    last = potential_separation(problem, v, own.letters, chapter) if group.affine else ()
    momenta = matrix_momenta(road.momentum, road.letters)
    kept = conserved_steps(problem, v, momenta, own.letters, chapter, vectors=False)
    return first + road_of_matrices(problem, group, own, chapter) + last + kept


def road_of_matrices(problem: Problem, group: Group, stage: Special, c: Chapter) -> Steps:
    """Any other group: the translation eliminated, then one multiplier or the mass matrix."""
    b, steps, uses = stage.letters, stage.steps, ".equations force"
    multiplied = len(group.normal_space_of_linear_parts) <= MULTIPLIERS
    place = coordinates_step(group, b, c, reading=multiplied)
    given = given_matrices(problem, b, stage.gram, c.with_input())
    if given is not None:
        stage = stage.pushed(given.moments, given.resultant)
        c, uses = c.with_input(), f"{uses} input"
        steps += given.steps
    inertial, force, metric = stage.inertial, stage.forces[b.Z.xi_prime], b.J
    centred = eliminate_translation(stage, uses, c) if group.affine else None
    if centred is not None:
        inertial, force, metric = centred.inertial, centred.force, centred.metric
        steps, uses = steps + centred.steps, "elimination"
    if multiplied:
        motion = multiplier_steps(inertial, force, metric, group, b, uses, c, centred)
        return (*steps, *motion, place, *stage.last)
    return (*steps, place, *mass_steps(inertial, force, b, uses, c, centred), *stage.last)


def road_of_space(problem: Problem, stage: Isometry, c: Chapter) -> Steps:
    """SO(3) and SE(3) in vectors: Euler's equations and principal axes, or the translation
    eliminated; then the forces of the problem and what is given."""
    name, general, scope, b = c.name, c.general, c.scope, stage.letters
    vectors = vector_form(stage, name, general, scope)
    v = potentials(problem, b, name, general, scope, vectors=True)
    given = given_vectors(problem, b, c.with_input())
    if b.affine:
        eliminated = eliminate(vectors, b, name, scope)
        steps: Steps = eliminated.steps
        motion = displacement_motion(eliminated, v, b, given, c)
    else:
        euler = euler_step(vectors, name, scope)
        steps = (euler, principal_step(name, scope, euler.equations[0].rhs))
        motion = spherical_motion(vectors, v, stage, given, c)
    return (
        *vectors.steps,
        *steps,
        *v.steps,
        torque_step(v, stage, name, general, scope),
        *(given.steps if given else ()),
        motion,
        *tensor_steps(problem, motion, c),
        energy_step(stage, v, name, scope),
        *conserved_steps(problem, v, vector_momenta(stage), b, c, vectors=True),
    )


def _data(problem: Problem) -> dict[str, object]:
    """The problem as JSON data: trees encoded."""

    def plain(x: object) -> object:
        if isinstance(x, dict):
            return {k: plain(v) for k, v in x.items()}
        if isinstance(x, list):
            return [plain(v) for v in x]
        return encode(x) if isinstance(x, (tuple, Fraction)) else x

    basis = problem.group.basis if problem.group else ()
    rows = [[[str(x) for x in row] for row in e] for e in basis]
    found = data(problem) | {"basis": rows, "conventions": list(CONVENTIONS)}
    return {k: plain(v) for k, v in found.items()}


def _symbols(steps: Steps, problem: Problem) -> tuple[Symbol, ...]:
    """The names that the steps use, in the order in which they appear."""
    group = problem.group
    used: dict[str, None] = {}
    for step in steps:
        for equation in step.equations:
            for side in (equation.lhs, equation.rhs):
                used |= dict.fromkeys(names(side))
    blocks = PRODUCTS if group and group.factors and not group.affine else {}
    turning = group is not None and group.turns_space
    own = dict(DISPLACEMENTS if group and group.affine else ROTATIONS) if turning else {}
    own |= blocks
    meanings = {x: say(own.get(x, about)) for x, (about, _) in VOCABULARY.items()}
    if problem.pushes:
        forces = [_force(x) for x in problem.pushes]
        if problem.covector and "f_u" in own:
            at_origin = "{name}, a force on the body's origin, in the body frame"
            forces.insert(0, phrase(at_origin, name=problem.covector.name))
        meanings["f_u"] = say("input: {forces}", forces=listed("{first}; {second}", forces))
    return tuple(Symbol(x, meanings[x], VOCABULARY[x][1]) for x in used if x in VOCABULARY)


def _force(given: ForceInput) -> Sentence:
    """A force that is given at every call, in words."""
    if given.frame == "body":
        in_frame = "{name}, a force on point {point}, in the body frame"
    else:
        in_frame = "{name}, a force on point {point}, in the space frame"
    return phrase(in_frame, name=given.name, point=str(given.on))
