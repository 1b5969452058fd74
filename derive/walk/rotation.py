"""SO(3) and SE(3), the end of the road: torque, principal axes (35), motion with input, energy."""

from __future__ import annotations

from ..algebra.calculus import gradient, reduce, substitute
from ..algebra.notation import metrics, tree_of
from ..algebra.space import hat, normal_form
from ..algebra.tree import Tree, add, mul
from ..algebra.words import Expr, Letter, word
from ..record.record import Equation, Step
from ..record.sentence import Prose, say
from .alphabet import Alphabet
from .cartan import frame_rule, rates, trivial_images
from .chapter import Chapter
from .components import components, diagonal
from .elimination import CENTRAL, Eliminated, from_centre, vector_tree
from .exterior import primed, work
from .inputs import Given
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


def pairing(stage: Isometry) -> dict[Letter, Expr]:
    """The force of the walk in vectors, read off −dŨ(AΩ′, Aη′): Iφ, or μ and F_b."""
    b = stage.letters
    carried = reduce(substitute(work(b), trivial_images(b)), frame_rule(b, b.unit))
    virtual = to_vectors(primed(carried, b), stage)
    return {v: gradient(virtual, v) for v in (OMEGA_P, *((b.w.xi_prime,) if b.affine else ()))}


def torque(v: Potentials, b: Alphabet) -> dict[Letter, Expr]:
    """The moment μ of the forces in the body, and their resultant F_b, of the given potentials."""
    eta = word(b.w.xi_prime) if b.affine else None
    work = normal_form(virtual_work(v, b, word(hat(OMEGA_P)), eta, word(OMEGA_P)))
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
        (f"{prefix}.potential", f"{prefix}.hat", f"{general}.force")
        + (() if stage.letters.affine else (f"{general}.gradient", f"{prefix}.inertia")),
        equations,
        say("The forces of this problem: the potential is varied along the group."),
        (),
        scope,
    )


def spherical_motion(
    kernel: VectorForm, v: Potentials, stage: Isometry, given: Given | None, c: Chapter
) -> Step:
    """ζ̇ = I⁻¹(Iζ ∧ ζ + torque + u)."""
    b = stage.letters
    inertial = word(INERTIA) * word(ZETA_DOT)
    # Iφ is the torque, and what is given adds to it
    balance = kernel.balance[OMEGA_P] + word(INERTIA) * word(PHI) - torque(v, b)[MU]
    if given is not None:
        balance = balance - given.moments
    right = vector_sum(inertial - balance)
    chapter = c.with_input() if given else c
    return chapter.step(
        "motion",
        "solution",
        "kernel torque hat" + (" input" if given and given.steps else ""),
        (*rates(b, {b.Z.velocity: word(hat(ZETA))}), Equation("ζ̇", mul(("inv", "I"), right))),
        _prose(given, affine=False),
    )


def displacement_motion(
    stage: Eliminated, v: Potentials, b: Alphabet, given: Given | None, c: Chapter
) -> Step:
    """ζ̇ and ẇ, with the forces of this problem and what is given put in."""
    forces = torque(v, b)
    if given is not None:
        forces[MU] = forces[MU] + given.moments
        forces[b.F_body] = forces[b.F_body] + given.resultant
    rotation = from_centre(substitute(reduce(stage.torque, isolate(b.F_body)), forces), b)
    translation = from_centre(substitute(stage.acceleration, forces), b)
    chapter = c.with_input() if given else c
    return chapter.step(
        "motion",
        "solution",
        "elimination torque hat" + (" input" if given and given.steps else ""),
        (
            *rates(b, {b.Z.velocity: word(hat(ZETA))}),
            Equation("ζ̇", mul(("inv", CENTRAL.name), vector_tree(rotation, b))),
            Equation("ẇ", vector_tree(translation, b)),
        ),
        _prose(given, affine=True),
    )


def _prose(given: Given | None, *, affine: bool) -> Prose:
    if affine:
        prose = say(
            "The equations of motion of this problem, solved for the accelerations: the "
            "tensor I_c is invertible where the masses are not all on one line."
        )
        added = say(
            "The given moment u and force f_u, outside dϖ, add ⟨u, Ω′⟩ + ⟨f_u, η′⟩ to the work."
        )
    else:
        prose = say(
            "The equations of motion of this problem, solved for the accelerations: the "
            "tensor I is invertible where the masses are not all on one line through the "
            "fixed point."
        )
        added = say("The given torque u, outside dϖ, adds ⟨u, Ω′⟩ to the work.")
    return prose if given is None or given.steps else prose + added


def energy_step(stage: Isometry, v: Potentials, prefix: str, scope: str) -> Step:
    """h̃ in vectors, with the potential of the problem."""
    b = stage.letters
    energy = substitute(to_vectors(stage.cartan.energy, stage), {b.U: v.energy})
    return Step(
        f"{prefix}.energy",
        "identification",
        (f"{prefix}.cartan", f"{prefix}.hat", f"{prefix}.inertia", f"{prefix}.potential"),
        (Equation("h̃", tree_of(energy, metrics("I"))),),
        say("The energy of this problem."),
        (),
        scope,
    )


def principal_step(prefix: str, scope: str, solved: Tree) -> Step:
    """(35): the solved equation in axes that diagonalise I, component by component."""
    moments: list[Tree] = [("entry", "λ", i) for i in (1, 2, 3)]
    found = components(solved, {"I": diagonal(moments)}, moments)
    equations = [Equation(("entry", "ζ̇", i), t) for i, t in enumerate(found, 1)]
    return Step(
        f"{prefix}.principal",
        "coordinates",
        (f"{prefix}.euler",),
        tuple(equations),
        say(
            "In principal axes of inertia, where I is diagonal with entries λ₁, λ₂, λ₃; the term "
            "of the potential stays."
        ),
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
        say("Euler's equations, solved for the angular acceleration: the tensor I is invertible."),
        (34,),
        scope,
    )
