"""SO(3) and SE(3), the end of the road: torque, principal axes, the motion by components."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...algebra.calculus import gradient, reduce, substitute
from ...algebra.word_trees import hat, metrics, normal_form
from ...algebra.words import Expr, Letter, word
from ...language import rational as q
from ...language.laurent import Laurent, OverlongError, grouped, polynomial, written
from ...language.tree import Tree, add, mul, names, replaced
from ...language.values import Value, value
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ...schema.potential_kinds import gravity
from ..chapter import Chapter, say, say_signed
from ..given.body_and_potentials import Potentials, virtual_work
from ..given.inputs import External
from ..spine.alphabet import Alphabet
from ..spine.cartan import body_rule, rates
from .euler import CENTRAL, Eliminated, VectorForm, from_centre, pairing, vector_tree
from .isomorphism import (
    INERTIA,
    MU,
    OMEGA_P,
    PHI,
    ZETA,
    ZETA_DOT,
    HatMap,
    anticommute,
    fold_moment,
    vector_sum,
)
from .specialisation import Isometry

# Vector equations component by component: (35), and the motion with a body's own numbers.

AXES = (1, 2, 3)
RATES = ("ζ", "w", "w_c")
"""Velocities: terms with their entries are written after those of the forces."""
UNIT = "1"
LONGEST = 8
"""A tensor with more terms than this in an entry is not written out."""

Rows = tuple[tuple[Tree, ...], ...]
Tensor = tuple[tuple[Laurent, ...], ...]


def symbols(whole: Tree, size: int = 3) -> tuple[tuple[Laurent], ...]:
    """The column of the entries of a vector, each a symbol."""
    return tuple((Laurent.symbol(("entry", whole, i)),) for i in range(1, size + 1))


def square(name: str, n: int = 3, *, symmetric: bool = False) -> tuple[tuple[Laurent, ...], ...]:
    """The n × n matrix of the entries of ``name``, each a symbol."""
    span = range(1, n + 1)
    pairs = [[(min(i, j), max(i, j)) if symmetric else (i, j) for j in span] for i in span]
    return tuple(tuple(Laurent.symbol(("entry", name, *x)) for x in row) for row in pairs)


def diagonal(entries: Sequence[Tree]) -> tuple[tuple[Laurent, ...], ...]:
    """The 3 × 3 matrix with these symbols on the diagonal, and 0 elsewhere."""
    zero = Laurent({})
    return tuple(
        tuple(Laurent.symbol(x) if i == j else zero for j in range(3))
        for i, x in enumerate(entries)
    )


def is_diagonal(m: Value) -> bool:
    """Is what is not on the diagonal 0?"""
    return not any(x for i, row in enumerate(m) for j, x in enumerate(row) if i != j)


def principal(name: str, m: Value) -> list[Tree]:
    """The moments of a diagonal tensor: equal ones are one, so that what they cancel is seen."""
    same = (next(j for j in AXES if m[j - 1][j - 1] == m[i - 1][i - 1]) for i in AXES)
    return [("entry", name, j, j) for j in same]


def components(t: Tree, known: Mapping[str, Value], moments: Sequence[Tree]) -> list[Tree]:
    """The components of a vector tree; a name that is not ``known`` is a vector.

    Terms of the same velocities stand together, over the one of the ``moments`` that divides them.
    """
    vectors = {x: symbols(x) for x in names(t) if x not in known}
    found = value(t, {**vectors, **known})
    return [grouped(x, {*moments}.__contains__, _is_rate) for (x,) in found]


def _is_rate(symbol: Tree) -> bool:
    return isinstance(symbol, tuple) and symbol[0] == "entry" and symbol[1] in RATES


def tensor_steps(
    problem: Problem, body: tuple[Step, ...], inertia: Step, motion: Step, c: Chapter
) -> tuple[Step, ...]:
    """The step of the entries of I, or I_c, from the numbers of the body, and where it is diagonal
    that of the motion by components; none where the entries are too long.

    ``inertia``: the step that says I, or I_c.
    """
    if not body:
        return ()
    name = "I_c" if problem.affine else "I"
    try:
        found = _tensor(problem, inertia)
    except OverlongError:
        return ()
    if found is None or max(len(x.terms) for row in found for x in row) > LONGEST:
        return ()
    diagonal_tensor = is_diagonal(found)
    order = [(i, j) for i in AXES for j in AXES[i - 1 :]]
    if diagonal_tensor:  # the products of inertia, which vanish, together
        order.sort(key=lambda x: x[0] != x[1])
    entries = [Equation(("entry", name, i, j), written(found[i - 1][j - 1])) for i, j in order]
    draft = c.draft("tensor", "coordinates", body[-1], inertia)
    step = draft.step(entries, say("tensor.entries"))
    if not diagonal_tensor:
        return (step,)
    return step, *_motion(problem, name, found, (body[-1], step, motion), c)


def _motion(
    problem: Problem, name: str, found: Tensor, made_from: tuple[Step, Step, Step], c: Chapter
) -> tuple[Step, ...]:
    """The step of the accelerations by components; none where letters enter that are not known.

    ``made_from``: the steps of the body, of its tensor, and of the motion.
    """
    *_, motion = made_from
    try:
        numbers = _numbers(problem)
    except OverlongError:
        return ()
    moments = principal(name, found)
    known: dict[str, Value] = {
        "A": square("A"),
        name: diagonal(moments),
        "m": Laurent.symbol("m"),
        **{x: symbols(x) for x in ("ζ", "w", "w_c", "u", "f_u", "ζ̇")},
        **numbers,
    }
    rates = [e for e in motion.equations if e.lhs in ("ζ̇", "ẇ")]
    if not all({*names(e.rhs)} <= {*known} for e in rates):
        return ()
    equations = [
        Equation(("entry", e.lhs, i), x)
        for e in rates
        for i, x in enumerate(components(e.rhs, known, moments), 1)
    ]
    driven = c.with_input() if motion.driven else c
    draft = driven.draft("components", "components", *made_from)
    return (draft.step(equations, say("components.principal")),)


def _numbers(problem: Problem) -> dict[str, Value]:
    """The values of γ, if there is gravity, of c, and of r_c: 0 where c is, else its entries."""
    found: dict[str, Value] = {}
    if (g := gravity(problem.potentials)) is not None:
        found["γ"] = _column(g)
    assert problem.body is not None
    moments = problem.body.moments()
    found["c"] = _by_mass(_column(moments.c), polynomial(moments.m))
    centred = all(not x for (x,) in found["c"])
    return found | {"r_c": found["c"] if centred else symbols("r_c")}


def _by_mass(c: Value, mass: Laurent) -> Value:
    """The first moment as m r_c where that is shorter: m a product, and r_c without its letters."""
    if len(mass.terms) != 1 or not any(len(m) > 1 for m in mass.terms):
        return c
    centre = [x / mass for (x,) in c]
    if any(e < 0 for x in centre for m in x.terms for _, e in m):
        return c
    return tuple((Laurent.symbol("m") * x,) for x in centre)


def _column(entries: Sequence[Tree]) -> tuple[tuple[Laurent], ...]:
    return tuple((polynomial(x),) for x in entries)


def _tensor(problem: Problem, inertia: Step) -> Tensor | None:
    """I, or I_c, in the numbers of the body, by the last equation for it; ``None`` without a
    body."""
    if problem.body is None:
        return None
    moments = problem.body.moments()
    known: dict[str, Value] = {
        UNIT: q.identity(3),
        "m": Laurent.symbol("m"),
        "c": _column(moments.c),
        "J": tuple(tuple(polynomial(x) for x in row) for row in moments.J),
    }
    name = "I_c" if problem.affine else "I"
    for x in ("J_c", name) if problem.affine else (name,):
        rhs = [e.rhs for e in inertia.equations if e.lhs == x][-1]
        known[x] = value(replaced(rhs, ("one",), UNIT), known, number=Laurent.of)
    return known[name]  # type: ignore[no-any-return]


# SO(3) and SE(3), the end of the road: torque, principal axes (35), motion with input, energy.


@dataclass(frozen=True)
class Torque:
    """The ``forces`` of a problem in the body, by their letters: μ, and F_b where the group
    translates."""

    forces: dict[Letter, Expr]
    steps: tuple[Step, ...]

    def with_external(self, external: External | None, b: Alphabet) -> dict[Letter, Expr]:
        """The forces, with those from outside dϖ."""
        forces = dict(self.forces)
        if external is not None:
            forces[MU] = forces[MU] + external.moments
        if external is not None and b.affine:
            forces[b.F_body] = forces[b.F_body] + external.resultant
        return forces


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
    acting = torque.with_external(external, b)[MU]
    balance = kernel.balance[OMEGA_P] + word(INERTIA) * word(PHI) - acting
    draft = c.draft("motion", "solution", balance)
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
    forces = torque.with_external(external, b)
    rotation = from_centre(substitute(reduce(stage.torque, anticommute(b.F_body)), forces), b)
    translation = from_centre(substitute(stage.acceleration, forces), b)
    draft = c.draft("motion", "solution", rotation, translation)
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
    draft = c.draft("principal", "components", euler)
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
