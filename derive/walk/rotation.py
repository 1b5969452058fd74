"""SO(3) and SE(3), the end of the road: torque, principal axes (35), motion with input, energy."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import gradient, reduce, substitute
from ..algebra.space import hat, normal_form
from ..algebra.word_trees import metrics
from ..algebra.words import Expr, Letter, word
from ..language.tree import Tree, add, mul
from ..record.record import Equation, Step
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Chapter
from .components import components, diagonal
from .elimination import CENTRAL, Eliminated, from_centre, vector_tree
from .hat import INERTIA, MU, OMEGA_P, PHI, ZETA, ZETA_DOT, HatMap, anticommute, fold_moment
from .inputs import External
from .isometry import Isometry
from .potential import Potentials, virtual_work
from .trivialisation import body_rule, rates
from .vector import VectorForm, pairing
from .wedge import vector_sum
from .wording import say, say_signed


@dataclass(frozen=True)
class Torque:
    """The ``forces`` of a problem in the body, by their letters: μ, and F_b where the group
    translates."""

    forces: dict[Letter, Expr]
    steps: tuple[Step, ...]


def _forces(v: Potentials, b: Alphabet, C: Expr) -> dict[Letter, Expr]:
    """μ, the moment in the body of the forces of the potentials, and F_b, their resultant."""
    eta = word(b.w.xi_prime) if b.affine else None
    work = virtual_work(v, b, word(hat(OMEGA_P)), eta, word(OMEGA_P))
    for x in v.own:
        work = work if x.axial is None else fold_moment(work, x.letter, x.axial)
    work = normal_form(reduce(work, body_rule(b, C)))
    isolated = reduce(work, anticommute(OMEGA_P))
    if hat(OMEGA_P) in isolated.letters():
        raise ValueError("a moment that is no vector")
    forces = {MU: normal_form(gradient(isolated, OMEGA_P))}
    if b.affine:
        forces[b.F_body] = gradient(work, b.w.xi_prime)
    return forces


def torque(v: Potentials, stage: Isometry, hat_map: HatMap, c: Chapter) -> Torque:
    """The forces of this problem, from Ũ by varying A by A j(Ω′) (and T by A η′)."""
    draft = c.draft("torque", "variation")
    forces = _forces(v, stage.letters, stage.C)
    left = pairing(stage, hat_map).values()
    pairs = zip(left, forces.values(), strict=True)
    step = draft.step(
        (Equation(draft.tree(x), draft.tree(e)) for x, e in pairs),
        say("torque.varied"),
    )
    return Torque({x: draft.mark(e) for x, e in forces.items()}, (step,))


def spherical_motion(
    kernel: VectorForm,
    torque: Torque,
    b: Alphabet,
    hat_map: HatMap,
    external: External | None,
    c: Chapter,
) -> Step:
    """The step ``motion`` of SO(3): ζ̇ = I⁻¹(Iζ ∧ ζ + μ + u)."""
    inertial = word(INERTIA) * word(ZETA_DOT)
    # Iφ is the torque, and what acts from outside adds to it
    balance = kernel.balance[OMEGA_P] + word(INERTIA) * word(PHI) - torque.forces[MU]
    if external is not None:
        balance = balance - external.moments
    draft = c.draft("motion", "solution")
    draft.depends_on(balance)
    right = vector_sum(inertial - balance)
    turned = {b.Z.velocity: hat_map.hatted(ZETA)}
    return draft.step(
        (*rates(draft, b, turned), Equation("ζ̇", mul(("inv", "I"), right))),
        _prose(external, b),
    )


def displacement_motion(
    stage: Eliminated,
    torque: Torque,
    b: Alphabet,
    hat_map: HatMap,
    external: External | None,
    c: Chapter,
) -> Step:
    """The step ``motion`` of SE(3): ζ̇ and ẇ, with the forces of this problem and those from
    outside put in."""
    forces = dict(torque.forces)
    if external is not None:
        forces[MU] = forces[MU] + external.moments
        forces[b.F_body] = forces[b.F_body] + external.resultant
    rotation = from_centre(substitute(reduce(stage.torque, anticommute(b.F_body)), forces), b)
    translation = from_centre(substitute(stage.acceleration, forces), b)
    draft = c.draft("motion", "solution")
    draft.depends_on(rotation, translation)
    return draft.step(
        (
            *rates(draft, b, {b.Z.velocity: hat_map.hatted(ZETA)}),
            Equation("ζ̇", mul(("inv", CENTRAL.name), vector_tree(rotation, b))),
            Equation("ẇ", vector_tree(translation, b)),
        ),
        _prose(external, b),
    )


def _prose(external: External | None, b: Alphabet) -> Prose:
    if b.affine:
        prose = say_signed("motion.displacement", b.signed)
        added = say("motion.given_wrench")
    else:
        prose = say_signed("motion.rotation", b.signed)
        added = say("motion.given_torque")
    return prose if external is None or external.steps else prose + added


def energy_step(stage: Isometry, v: Potentials, hat_map: HatMap, c: Chapter) -> Step:
    """The step ``energy``: h̃ in vectors, with the potential of the problem."""
    b, draft = stage.letters, c.draft("energy", "identification")
    energy = substitute(hat_map.scalar(stage.cartan.energy), {b.U: v.energy})
    return draft.step((Equation("h̃", draft.tree(energy, metrics("I"))),), say("energy.problem"))


def principal_step(euler: Step, c: Chapter) -> Step:
    """The step ``principal`` (35): the solved equation in axes that diagonalise I, component by
    component."""
    draft = c.draft("principal", "components")
    draft.depends_on(euler)
    moments: list[Tree] = [("entry", "λ", i) for i in (1, 2, 3)]
    rows = (("row", *(x if i == j else 0 for j in range(3))) for i, x in enumerate(moments))
    found = components(euler.equations[0].rhs, {"I": diagonal(moments)}, moments)
    return draft.step(
        (Equation(("entry", "ζ̇", i), t) for i, t in enumerate(found, 1)),
        say("principal.axes"),
        (35,),
        (Equation("I", ("matrix", *rows)),),
    )


def euler_step(kernel: VectorForm, b: Alphabet, c: Chapter) -> Step:
    """The step ``euler``, (34) solved: ζ̇ = φ + I⁻¹(Iζ ∧ ζ)."""
    draft = c.draft("euler", "solution")
    inertial = word(INERTIA) * word(ZETA_DOT)
    rest = inertial - kernel.balance[OMEGA_P] - word(INERTIA) * word(PHI)
    draft.depends_on(rest)
    return draft.step(
        (Equation("ζ̇", add("φ", mul(("inv", "I"), vector_sum(rest)))),),
        say_signed("euler.solved", b.signed),
        (34,),
    )
