"""The motion of points told by momenta: the velocity from them, and their Lie–Poisson equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...algebra.calculus import coefficient_of, gradient, reduce, substitute, terms_with, without
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.read import read
from ...language.tree import Tree, add, mul, neg
from ...record.record import Equation, Step
from ..chapter import Chapter, Draft, say
from ..given.inputs import External
from ..spine.alphabet import Alphabet, cancel_scalar, cancelling, inverse_letter, inverses
from ..spine.kernel import MomentumForm
from .euler import CENTRAL, VectorForm, from_centre, pairs_of, simplified, spun, vector_tree
from .isomorphism import INERTIA, MU, OMEGA_P, PHI, SPIN, ZETA, anticommute
from .rotation import Torque
from .separation import Barycentric, central_moments
from .solution import MULTIPLIERS, basis_member, direction_of
from .specialisation import AnyGroup, KernelOnGroup, without_cauchy_green

Balance = Mapping[Letter, Expr]


# -- so(3) ≅ R³ ------------------------------------------------------------------------------


def of_rotations(
    kernel: VectorForm,
    torque: Torque,
    external: External | None,
    b: Alphabet,
    c: Chapter,
    c_u: Chapter,
) -> tuple[Step, ...]:
    """ζ = I⁻¹ℓ_b, and ℓ̇_b with the torque of the problem."""
    draft = c.draft("by_momenta", "inversion")
    tensor = coefficient_of(reduce(kernel.momenta[SPIN], anticommute(ZETA)), ZETA)
    velocity = Equation(ZETA.name, mul(("inv", draft.tree(tensor)), SPIN.name))
    # Iφ is the torque, and what acts from outside adds to it
    acting = torque.with_external(external, b)[MU]
    balance = kernel.coadjoint[OMEGA_P] + word(INERTIA) * word(PHI) - acting
    turned = _vector_rates({OMEGA_P: balance}, b, c_u)
    return draft.step([velocity], say("by_momenta.metric")), turned


def of_displacements(
    kernel: VectorForm,
    torque: Torque,
    external: External | None,
    b: Alphabet,
    c: Chapter,
    c_u: Chapter,
) -> tuple[Step, ...]:
    """ζ and w by ℓ_b and p_b, about the centre of mass; ℓ̇_b and ṗ_b with the forces of the
    problem."""
    draft, w, p_b = c.draft("by_momenta", "inversion"), b.w.velocity, b.p_b.momentum
    spin, push = kernel.momenta[SPIN] - word(SPIN), kernel.momenta[p_b] - word(p_b)
    moving = -simplified(word(inverse_letter(b.m)) * without(push, w), b)
    left = simplified(substitute(spin, {w: moving}), b)
    tensor = coefficient_of(reduce(left, anticommute(ZETA)), ZETA)
    arm = from_centre(simplified(tensor * word(ZETA) - left - word(SPIN), b), b)
    spinning = word(SPIN) + arm
    moving = from_centre(reduce(moving, anticommute(p_b)), b)
    draft.depends_on(spinning, moving)
    step = draft.step(
        (
            Equation(ZETA.name, mul(("inv", CENTRAL.name), vector_tree(spinning, b))),
            Equation(w.name, vector_tree(moving, b)),
        ),
        say("by_momenta.metric"),
    )
    forces = torque.with_external(external, b)
    balance = {x: substitute(e, forces) for x, e in kernel.coadjoint.items()}
    return step, _vector_rates(balance, b, c_u)


def _vector_rates(balance: Balance, b: Alphabet, c: Chapter) -> Step:
    """The step of ℓ̇_b (and ṗ_b), and of 𝕁, of which the columns are their coefficients of ζ (and
    w)."""
    draft, pairs = c.draft("poisson_tensor", "Poisson tensor"), pairs_of(b)
    rates = {d.rate: word(d.rate) - balance[f.xi_prime] for d, f in pairs}
    draft.depends_on(*rates.values())
    blocks = [
        [coefficient_of(reduce(e, anticommute(f.velocity)), f.velocity) for _, f in pairs]
        for e in rates.values()
    ]
    whole = tree_of(blocks[0][0]) if len(pairs) == 1 else _block_matrix(blocks)
    equations = [Equation(x.name, spun(vector_tree(e, b))) for x, e in rates.items()]
    return draft.step(
        [Equation("𝕁", whole), *equations],
        say("poisson_tensor.displacements" if b.affine else "poisson_tensor.rotations"),
    )


def _block_matrix(blocks: Sequence[Sequence[Expr]]) -> Tree:
    """A matrix of blocks ±j(x) or 0, entry by entry."""
    rows = [[x for block in line for x in _row(block, i)] for line in blocks for i in range(3)]
    return ("matrix", *(("row", *row) for row in rows))


def _row(block: Expr, i: int) -> list[Tree]:
    """Row i of a sum of j(x), with x_j and −x_k in the columns after the diagonal."""
    row: list[Tree] = [0, 0, 0]
    for (_, w), sign in block.terms.items():
        ((letter, _),) = w
        assert letter.axis is not None
        j, k = (i + 1) % 3, (i + 2) % 3
        for column, x, side in ((j, k, -1), (k, j, 1)):
            row[column] = add(row[column], mul(sign * side, ("entry", letter.axis.name, x + 1)))
    return row


# -- any group -------------------------------------------------------------------------------


def of_matrices(
    general: AnyGroup,
    driven: KernelOnGroup,
    centred: Barycentric | None,
    group: Group,
    c: Chapter,
    c_u: Chapter,
) -> tuple[Step, ...]:
    """Π_a, the velocity by them as the acceleration by the loads, and their rates; none for a group
    without linear parts."""
    if not group.linear_basis:
        return ()
    b = driven.letters
    own = {b.letters()[x.name]: b.respell(e, driven.C) for x, e in general.momenta.values.items()}
    draft = c.draft("by_momenta", "inversion")
    xi, along = b.Z.xi_prime, basis_member("a", b)
    paired = inner(own[b.Pi.momentum], word(xi))
    if driven.bodies:
        paired = without_cauchy_green(paired, driven.bodies, b)
    paired = substitute(paired, {xi: word(along)})
    momenta = Equation(("at", "Π", "a"), draft.tree(paired, _of_basis(along)))
    velocity = _velocity(draft, own, centred, group, b)
    step = draft.step([momenta, *velocity], say("by_momenta.basis"))
    return step, _matrix_rates(general.momenta, driven, own, c_u)


def _of_basis(*members: Letter) -> WordNotation:
    """The notation of letters E_a."""
    return WordNotation(display={x: read(x.name) for x in members})


def _velocity(
    draft: Draft, own: Balance, centred: Barycentric | None, group: Group, b: Alphabet
) -> list[Equation]:
    """The velocity by Π_a (and p_b), through the normal space of 𝔤 or by the mass matrix; nothing
    where each factor is seen from its centre of mass."""
    if group.barycentric_blocks:
        return []
    central, metric, moving = own[b.Pi.momentum], b.J, None
    if centred:
        central, metric, moving = _about_centre(own, b)
    notation = inverses(b.C, b.m, metric)
    rest = without(central, b.Z.velocity)
    if len(group.normal_space_of_linear_parts) <= MULTIPLIERS:
        found = _through_normal_space(draft, rest, metric, group, b, notation)
    else:
        span = range(1, len(group.linear_basis) + 1)
        rows = (("row", add(("at", "Π", a), neg(_along(rest, a, b)))) for a in span)
        found = [Equation("ζ", mul(("inv", "M"), ("matrix", *rows)))]
    if moving is not None:
        found.append(Equation(b.w.velocity.name, draft.tree(moving, notation)))
    return found


def _about_centre(own: Balance, b: Alphabet) -> tuple[Expr, Letter, Expr]:
    """Π by Z, J_c and p_b; J_c; and w by p_b and Z."""
    metric, value = central_moments(b)
    w, p_b, pushed = b.w.velocity, word(b.p_b.momentum), own[b.p_b.momentum]
    first = {b.c: word(b.m) * word(Letter("r_c", b.n))}

    def tidy(e: Expr) -> Expr:
        return cancel_scalar(reduce(substitute(e, first), cancelling(b.C)), b.m)

    left = word(inverse_letter(b.C)) if b.C in pushed.letters() else b.unit
    moving = word(inverse_letter(b.m)) * (left * (p_b - without(pushed, w)))
    by_centre = {b.J: word(metric) + word(b.J) - value}
    central = substitute(substitute(own[b.Pi.momentum], by_centre), {w: moving})
    return tidy(central), metric, tidy(moving)


def _along(e: Expr, a: int, b: Alphabet) -> Tree:
    """⟨e, E_a⟩, for a number a."""
    member = basis_member("a", b)
    return tree_of(inner(e, word(member)), WordNotation(display={member: ("at", "E", a)}))


def _through_normal_space(
    draft: Draft, rest: Expr, metric: Letter, group: Group, b: Alphabet, notation: WordNotation
) -> list[Equation]:
    """Π by the Π_a, which leave open its part normal to 𝔤: that Z is in 𝔤 gives this; and Z."""
    direction, *_ = direction_of(group, b)
    left, right = word(inverse_letter(b.C)), word(inverse_letter(metric))
    told = Letter("Π_g", b.n, b.n)

    def moving(momentum: Expr) -> Expr:
        return left * (momentum - rest) * right

    velocity = Equation("Z", draft.tree(moving(word(b.Pi.momentum)), notation))
    if direction is None:
        return [Equation("Π", _covector(group)), velocity]
    ratio: Tree = (
        "div",
        draft.tree(inner(moving(word(told)), direction), notation),
        draft.tree(inner(left * direction * right, direction), notation),
    )
    normal = mul(ratio, draft.tree(direction))
    return [
        Equation(told.name, _covector(group)),
        Equation("Π", add(told.name, neg(normal))),
        velocity,
    ]


def _covector(group: Group) -> Tree:
    """A matrix that gives Π_a on E_a, its entries where coordinates are read off."""
    entries: dict[tuple[int, int], list[Tree]] = {}
    for a in range(len(group.linear_basis)):
        for x, i, j in group.coordinate_terms(a):
            entries.setdefault((i, j), []).append(mul(x, ("at", "Π", a + 1)))
    span = range(group.n)
    rows = (("row", *(add(*entries.get((i, j), ())) for j in span)) for i in span)
    return ("matrix", *rows)


def _matrix_rates(general: MomentumForm, driven: KernelOnGroup, own: Balance, c: Chapter) -> Step:
    """The step of 𝕁_ab, Π̇_a (and ṗ_b)."""
    draft, b = c.draft("poisson_tensor", "Poisson tensor"), driven.letters
    Pi, Z, w, xi = b.Pi.momentum, word(b.Z.velocity), b.w.velocity, b.Z.xi_prime
    duals = [*zip(b.duals, b.algebra_parts, strict=True)]
    pushed = sum((inner(word(d.rate), word(f.xi_prime)) for d, f in duals), number(0))
    pushed = without(pushed - b.respell(general.balance), *(d.force for d, _ in duals))
    along = basis_member("a", b)
    invariant = b.unit == driven.C or driven.bodies is not None
    bracket = inner(word(Pi), Z * word(xi) - word(xi) * Z)
    coadjoint = without(pushed, b.w.xi_prime)
    rest = coadjoint - bracket
    if rest - without(rest, Pi):
        raise ValueError("Π stands outside its bracket with Z")
    forces = {f.xi_prime: driven.forces[f.xi_prime] for _, f in duals}
    if invariant:
        shown = _on_basis(draft, rest + inner(forces[xi], word(xi)), xi, along)
        rate = add(("inner", Pi.name, ("bracket", b.Z.velocity.name, read("E_a"))), shown)
    else:
        stretched, known = word(Pi) * Z.bar, own[Pi] * Z.bar  # Φ but for the forces
        if b.affine:
            stretched = stretched + word(b.p_b.momentum) * word(w).bar
            known = known + own[b.p_b.momentum] * word(w).bar
        if without(own[b.Pi.force] - known, b.f, b.N_body):
            raise ValueError("the metric varies by more than its momentum")
        carried = coadjoint + inner(stretched + forces[xi], word(xi))
        rate = _on_basis(draft, carried, xi, along)
    draft.depends_on(coadjoint)
    equations = [
        Equation(read("𝕁_ab"), ("inner", Pi.name, ("bracket", read("E_b"), read("E_a")))),
        Equation(("at", b.Pi.rate.name, "a"), rate),
    ]
    if b.affine:
        eta = b.w.xi_prime
        moved = gradient(terms_with(pushed, eta), eta) + forces[eta]
        equations.append(Equation(b.p_b.rate.name, draft.tree(moved)))
    return draft.step(equations, say(f"poisson_tensor.{'invariant' if invariant else 'basis'}"))


def _on_basis(draft: Draft, e: Expr, xi: Letter, along: Letter) -> Tree:
    """The tree of a scalar with E_a in place of ξ′."""
    return draft.tree(substitute(e, {xi: word(along)}), _of_basis(along)) if e else 0
