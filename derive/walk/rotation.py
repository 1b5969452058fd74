"""SO(3) and SE(3), the end of the road: torque, principal axes (35), motion with input, energy."""

from __future__ import annotations

from ..algebra.calculus import gradient, reduce, substitute
from ..algebra.notation import metrics, tree_of
from ..algebra.space import hat, normal_form
from ..algebra.tree import Tree, add, mul
from ..algebra.words import Expr, Letter, word
from ..mechanics.problem import Problem
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import frame_rule, rates, trivial_images
from .elimination import CENTRAL, Eliminated, simplified, vector_tree
from .exterior import primed, work
from .isometry import Isometry
from .potential import Potentials, virtual_work
from .vector import (
    INERTIA,
    MU,
    OMEGA_P,
    PHI,
    ZETA,
    ZETA_DOT,
    VectorForm,
    isolate,
    to_vectors,
)
from .wedge import vector_sum

INPUT, INPUT_FORCE = Letter("u", 3), Letter("f_u", 3)


def pairing(stage: Isometry) -> dict[Letter, Expr]:
    """The force of the walk in vectors, read off −dŨ(AΩ′, Aη′): Iφ, or μ and F_b."""
    b = stage.letters
    carried = reduce(substitute(work(b), trivial_images(b)), frame_rule(b, b.unit))
    virtual = to_vectors(primed(carried, b), stage)
    return {v: gradient(virtual, v) for v in (OMEGA_P, *((b.w.xi_prime,) if b.affine else ()))}


def torque(v: Potentials, b: Alphabet) -> dict[Letter, Expr]:
    """The moment μ of the forces in the body, and their resultant F_b, of the given potentials."""
    eta = word(b.w.xi_prime) if b.affine else None
    work = normal_form(virtual_work(v.energy, b, word(hat(OMEGA_P)), eta))
    isolated = reduce(work, isolate(OMEGA_P))
    forces = {MU: normal_form(gradient(isolated, OMEGA_P))}
    if b.affine:
        forces[b.F_body] = gradient(work, b.w.xi_prime)
    return forces


def torque_step(v: Potentials, stage: Isometry, prefix: str, general: str, scope: str) -> Step:
    """The forces of this problem, from Ũ by varying A by A j(Ω′) (and T by A η′)."""
    forces = torque(v, stage.letters).values()
    left = pairing(stage).values()
    pairs = zip(left, forces, strict=True)
    equations = tuple(Equation(tree_of(x), tree_of(e)) for x, e in pairs)
    return Step(
        f"{prefix}.torque",
        "variation",
        (f"{prefix}.potential", f"{prefix}.hat", f"{general}.force"),
        equations,
        "The forces of this problem: the potential is varied along the group.",
        (),
        scope,
    )


def spherical_motion(
    kernel: VectorForm, v: Potentials, stage: Isometry, problem: Problem, prefix: str, scope: str
) -> Step:
    """ζ̇ = I⁻¹(Iζ ∧ ζ + torque + u)."""
    b = stage.letters
    inertial = word(INERTIA) * word(ZETA_DOT)
    # Iφ is the torque, and an input adds to it
    torques = torque(v, b)[MU]
    balance = kernel.balance[OMEGA_P] + word(INERTIA) * word(PHI) - torques
    if problem.inputs:
        balance = balance - word(INPUT)
    right = vector_sum(inertial - balance)
    return Step(
        f"{prefix}.motion",
        "solution",
        (f"{prefix}.kernel", f"{prefix}.torque", f"{prefix}.hat"),
        (*rates(b, {b.Z.velocity: word(hat(ZETA))}), Equation("ζ̇", mul(("inv", "I"), right))),
        _prose(problem),
        (),
        scope,
        ("input",) if problem.inputs else (),
    )


def displacement_motion(
    stage: Eliminated, v: Potentials, b: Alphabet, problem: Problem, prefix: str, scope: str
) -> Step:
    """ζ̇ and ẇ with the forces of the problem and the input put in."""
    forces = torque(v, b)
    if problem.inputs:
        forces = {
            MU: forces[MU] + word(INPUT),
            b.F_body: forces[b.F_body] + word(INPUT_FORCE),
        }
    rotation = simplified(substitute(reduce(stage.torque, isolate(b.F_body)), forces), b)
    translation = simplified(substitute(stage.acceleration, forces), b)
    return Step(
        f"{prefix}.motion",
        "solution",
        (f"{prefix}.elimination", f"{prefix}.torque", f"{prefix}.hat"),
        (
            *rates(b, {b.Z.velocity: word(hat(ZETA))}),
            Equation("ζ̇", mul(("inv", CENTRAL.name), vector_tree(rotation, b))),
            Equation("ẇ", vector_tree(translation, b)),
        ),
        _prose(problem),
        (),
        scope,
        ("input",) if problem.inputs else (),
    )


def _prose(problem: Problem) -> str:
    text = "The equations of motion of this problem, solved for the accelerations"
    return text + ("; the input is a given covector, outside dϖ." if problem.inputs else ".")


def energy_step(stage: Isometry, v: Potentials, prefix: str, scope: str) -> Step:
    """h̃ in vectors, with the potential of the problem."""
    b = stage.letters
    energy = substitute(to_vectors(stage.cartan.energy, stage), {b.U: v.energy})
    return Step(
        f"{prefix}.energy",
        "identification",
        (f"{prefix}.cartan", f"{prefix}.hat", f"{prefix}.inertia", f"{prefix}.potential"),
        (Equation("h̃", tree_of(energy, metrics("I"))),),
        "The energy of this problem.",
        (),
        scope,
    )


def principal_step(prefix: str, scope: str, solved: Tree) -> Step:
    """(35): the solved equation in axes that diagonalise I, component by component."""
    from ..record.coordinates import components

    equations = [Equation(("entry", "ζ̇", i), t) for i, t in enumerate(components(solved), 1)]
    return Step(
        f"{prefix}.principal",
        "coordinates",
        (f"{prefix}.euler",),
        tuple(equations),
        "In principal axes of inertia, with the term of the potential.",
        (35,),
        scope,
        ("principal axes",),
    )


def euler_step(kernel: VectorForm, prefix: str, scope: str) -> Step:
    """(34) solved: ζ̇ = φ + I⁻¹(Iζ ∧ ζ)."""
    inertial = word(INERTIA) * word(ZETA_DOT)
    rest = inertial - kernel.balance[OMEGA_P] - word(INERTIA) * word(PHI)
    return Step(
        f"{prefix}.euler",
        "solution",
        (f"{prefix}.kernel",),
        (Equation("ζ̇", add("φ", mul(("inv", "I"), vector_sum(rest)))),),
        "Euler's equations, solved for the angular acceleration.",
        (34,),
        scope,
    )
