"""One problem on one group: its relations, ϖ and dϖ with its potential, its forces and energy.

What the metric of a group of matrices is: left-invariant, independent of C, or Manakov's.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from ...algebra.calculus import gradient, map_traces, reduce, substitute, terms_with, without
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, Word, expr_of_word, inner, number, trace, word
from ...language.read import read
from ...language.tree import Tree, add
from ...problem.inertia import EVERY, Bodies
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say
from ..given.body_and_potentials import Potentials, virtual_work
from ..given.inputs import External
from ..spine.alphabet import Alphabet
from ..spine.cartan import (
    DOMEGA,
    Cartan,
    Exterior,
    body_rule,
    brackets_of,
    cauchy_green,
    form_equation,
    primed,
    primes,
    rates,
    shown_brackets,
    varied_cauchy_green,
)
from ..spine.kernel import MomentumForm, balanced, contact, fibre, restrict, restricted_prose
from ..spine.principle import Contraction
from .coordinates import factored_tree, solve_for

# Where C is not 𝟏, and drops out of the metric nevertheless: Tr ξJZ̄C = Tr ξJZ̄ on 𝔤.
#
# For every body, where ξ̄CZ = ξ̄Z on 𝔤: products of groups with skew linear parts, on (r, 1). Or
# for some: the points of a flat body under a shear. The forces of a potential keep their C.


def without_cauchy_green(e: Expr, bodies: Bodies, a: Alphabet) -> Expr:
    """A scalar with 1 for each C that drops out of the metric: those between a barred letter of 𝔤
    and a plain one."""
    algebra = {x.name for f in a.algebra_parts for x in (f.velocity, f.xi, f.xi_prime)}
    algebra |= {
        x.name for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity, f.acceleration)
    }

    def drops(cycle: Word, k: int) -> bool:
        before, after = cycle[k - 1], cycle[(k + 1) % len(cycle)]
        between = before[0].name in algebra and before[1]
        between = between and after[0].name in algebra and not after[1]
        return between and (bodies == EVERY or {x.name for x, _ in cycle} - algebra == {"C", "J"})

    def left(cycle: Word) -> Expr:
        kept = tuple(x for k, x in enumerate(cycle) if x[0] != a.C or not drops(cycle, k))
        return trace(expr_of_word(kept))

    return map_traces(e, left)


def metric_equations(bodies: Bodies) -> list[Equation]:
    """The equation by which C drops out of the metric on 𝔤: for every body, or for this one."""
    return stated("ξ̄CZ = ξ̄Z" if bodies == EVERY else "Tr ξJZ̄C = Tr ξJZ̄")


def metric_prose(bodies: Bodies, draft: Draft) -> Prose:
    """The sentence of a step for :func:`metric_equations`."""
    every = bodies == EVERY
    return say("relation.lengths") if every else draft.claim("relation.left_invariant")


# Where the linear parts of 𝔤 are all skew matrices: Euler–Manakov's equations.
#
# On so(n) only the skew part of Π counts, the angular momentum in the body ℓ_b = Π − Π̄:
#
# ℓ̇_b = [ℓ_b, Z] + w p̄_b − p_b w̄ + moments, ṗ_b = −Z p_b + F_b.
#
# In R³ it is ``vectors.euler`` that makes the steps ``momenta`` and ``coadjoint``.


def halved(values: Mapping[Letter, Expr], b: Alphabet) -> dict[Letter, Expr]:
    """The values Π = ½ ℓ_b, δΠ = ½ δℓ_b, δ′Π = ½ δ′ℓ_b, Π̇ = ½ ℓ̇_b, and that of Φ.

    On so(n) ⟨Π, ξ⟩ = ½ Tr ξℓ̄_b, so that a skew ℓ_b says as much as any Π.
    """
    pairs = zip(b.Pi.letters[:4], b.spin.letters[:4], strict=True)
    return {x: Fraction(1, 2) * word(y) for x, y in pairs} | {b.Pi.force: values[b.Pi.force]}


def coadjoint_steps(stage: MomentumForm, b: Alphabet, C: Expr, c: Chapter) -> tuple[Step, ...]:
    """The steps ``momenta`` and ``coadjoint``: ℓ_b (and p_b) and their rates in matrices,
    Euler–Manakov's equations; ``C``: ĀA."""
    stating, moving = c.draft("momenta", "relation"), c.draft("coadjoint", "kernel")
    own = {b.letters()[x.name]: b.respell(e, C).of(C) for x, e in stage.values.items()}
    momentum = own[b.Pi.momentum]
    values = {b.spin.momentum: momentum - momentum.bar}
    if b.affine:
        values[b.p_b.momentum] = own[b.p_b.momentum]
    momenta = stating.step(
        [Equation(x.name, stating.tree(e)) for x, e in values.items()], momenta_prose(b)
    )
    balance = substitute(b.respell(stage.balance), halved(own, b)).of(stating.mark(C))
    rates = {b.spin.rate: word(b.spin.rate) - 2 * gradient(balance, b.Z.xi_prime)}
    if b.affine:
        rates[b.p_b.rate] = word(b.p_b.rate) - gradient(balance, b.w.xi_prime)
    moving.depends_on(*rates.values())
    equations = [Equation(x.name, _commuted(e, b)) for x, e in rates.items()]
    return momenta, moving.step(equations, motion_prose(b))


def _commuted(e: Expr, b: Alphabet) -> Tree:
    """The tree of an expression, with the bracket [ℓ_b, Z] for its two terms ℓ_b Z − Zℓ_b."""
    spin, Z = word(b.spin.momentum), word(b.Z.velocity)
    commutator = spin * Z - Z * spin
    if not {*commutator.terms.items()} <= {*e.terms.items()}:
        return tree_of(e)
    rest = e - commutator
    return add(("bracket", b.spin.momentum.name, b.Z.velocity.name), tree_of(rest))


def momenta_prose(b: Alphabet) -> Prose:
    """The sentence that says what ℓ_b (and p_b) are."""
    return say("momenta.affine" if b.affine else "momenta.linear")


def motion_prose(b: Alphabet) -> Prose:
    """The sentence for the rates of ℓ_b (and p_b): Euler's equations, or Kirchhoff's."""
    return say("coadjoint.kirchhoff" if b.affine else "coadjoint.euler")


# SO(3) and SE(3): where ĀA = 1 the metric is left-invariant, (28) and (29).


@dataclass(frozen=True)
class Isometry:
    """The forms where ĀA = 1: ϖ in skew letters, the ``values`` of P and F, and dϖ = ``form``;
    ``C``: 1, as a step says it.

    ``images``: the horizontal variations with which dϖ is written.
    """

    letters: Alphabet
    C: Expr
    cartan: Cartan
    values: Mapping[Letter, Expr]
    form: Expr
    images: Mapping[Letter, Expr]
    steps: tuple[Step, ...]


def isometry(general: Cartan, momenta: MomentumForm, a: Alphabet, n: int, c: Chapter) -> Isometry:
    """The forms of any group restricted to isometries, with the steps ``relation``, ``cartan`` and
    ``exterior``."""
    b = Alphabet(n, affine=a.affine, skew=True, signed=a.signed)
    relating, writing = c.draft("relation", "relation"), c.draft("cartan", "relation")
    C = relating.mark(b.unit)
    momentum, energy = (b.respell(e, C).of(C) for e in (general.momentum, general.energy))
    work = b.respell(general.work, C)
    form = Cartan(
        writing.mark(momentum),
        writing.mark(energy),
        writing.mark(momentum - energy * word(b.dt)),
        work,
        (),
    )
    kept = relating.step(
        stated("C = 𝟏,  Z̄ = −Z,  ξ̄ = −ξ"),
        say("relation.displacements") if a.affine else say("relation.isometries"),
    )
    cartan = writing.step(
        (form_equation(writing, momentum, energy, WordNotation()),),
        say("cartan.trivialised"),
        () if a.affine else (28,),
    )
    values = fibre(form.momentum, form.energy, {b.U: -work}, b)
    domega = restrict(momenta.form, values, b).of(C)
    images = _images(domega, b)
    varying = c.draft("exterior", "relation")
    shown = Equation(DOMEGA, bracketed(varying, domega, images, b))
    exterior = varying.step((shown,), restricted_prose(b), () if b.affine else (29,))
    domega = domega.marked(exterior.label)
    return Isometry(b, C, form, values, domega, images, (kept, cartan, exterior))


def bracketed(d: Draft, domega: Expr, images: Mapping[Letter, Expr], b: Alphabet) -> Tree:
    """The tree of dϖ, with [ξ′, ξ] and ξ′η − ξη′ written where their letters stand."""
    display = dict(zip((b.bracket, b.bracket_w), shown_brackets(b), strict=False))
    return factored_tree(
        d, domega, without(domega, b.dt, b.dpt), images, WordNotation(display=display)
    )


def resting(b: Alphabet) -> dict[Letter, Expr]:
    """The contact displacements: ξ ↦ ξ − Z δt and η ↦ η − w δt, and the same for δ′."""
    found = contact(zip(b.duals, b.algebra_parts, strict=True), b, {})
    return {x: found[x] for f in b.algebra_parts for x in (f.xi, f.xi_prime)}


def _images(domega: Expr, b: Alphabet) -> dict[Letter, Expr]:
    """The contact variations: displacements, and δZ ↦ δZ − f δt where the force has a letter of
    its own."""
    images = resting(b)
    if not b.affine:
        flat = without(domega, b.bracket)
        solution = solve_for(gradient(flat, b.Z.xi_prime), b.Z.d_velocity)
        if solution is not None and solution:
            shift = word(b.Z.d_velocity) - solution
            images |= {b.Z.d_velocity: shift, primes(b)[b.Z.d_velocity]: primed(shift, b)}
    return images


@dataclass(frozen=True)
class AnyGroup:
    """What is known of every group of one action; ``cartan`` and ``exterior`` are carried to 𝔤.

    ``moment_work``: −dŨ(δg) by the moments of forces.
    """

    letters: Alphabet
    moment_work: Expr
    cartan: Cartan
    exterior: Exterior
    momenta: MomentumForm


@dataclass(frozen=True)
class KernelOnGroup:
    """The kernel for one problem, unsolved: ``inertial``: dϖ(X, δ′) without the work of the
    ``forces`` on ξ′ (and η′).

    ``C``: ĀA, the letter C or 1. ``last``: steps that belong at the end of the record.
    ``bodies``: where C is not 1, and drops out of the metric.
    """

    letters: Alphabet
    C: Expr
    inertial: Expr
    forces: dict[Letter, Expr]
    steps: tuple[Step, ...]
    last: tuple[Step, ...]
    bodies: Bodies | None = None


def letters_of(group: Group, *, signed: bool) -> Alphabet:
    """The alphabet of a group: skew or traceless letters where its relations say so.

    ``signed``: masses may be negative.
    """
    skew = "orthogonal" in group.relations
    traceless = "unimodular" in group.relations and not skew
    known = {"skew": skew, "traceless": traceless, "signed": signed}
    return Alphabet(group.n, affine=group.affine, **known)


def with_external(stage: KernelOnGroup, external: External | None) -> KernelOnGroup:
    """The same kernel with the forces from outside dϖ added to those on ξ′ (and η′)."""
    b, forces = stage.letters, dict(stage.forces)
    if external:
        forces[b.Z.xi_prime] += external.moments
    if external and b.affine:
        forces[b.w.xi_prime] += external.resultant
    return replace(stage, forces=forces, steps=(), last=())


def specialise(
    road: AnyGroup, group: Group, v: Potentials, c: Chapter, bodies: Bodies | None
) -> KernelOnGroup:
    """The forms, forces and energy of a problem, with their steps; ``bodies``: those whose metric
    is left-invariant."""
    b = letters_of(group, signed=road.letters.signed)
    plain = Alphabet(group.n, affine=group.affine, signed=b.signed)
    free, turned = b.with_free_displacement(), "orthogonal" in group.relations
    whole = b.unit.marked(c.label("relation")) if turned else cauchy_green(b)
    carried = body_rule(b, whole)

    def restricted(e: Expr, letters: Alphabet = plain) -> Expr:
        """An expression about any group on this one, where C may be 1."""
        found = letters.respell(e, whole)
        if bodies:
            shorter = without_cauchy_green(found, bodies, letters)
            return shorter if shorter == found else shorter.of(b.unit.marked(c.label("relation")))
        return found.of(whole) if turned else found

    eta = word(b.w.xi_prime) if b.affine else None
    virtual = virtual_work(v, b, word(free.Z.xi_prime), eta)
    primed = [f.xi_prime for f in free.algebra_parts]
    forces = {x: reduce(gradient(virtual, x), carried) for x in primed}
    potential = {plain.U: reduce(v.energy, body_rule(plain, cauchy_green(plain)))}
    energy = substitute(plain.respell(road.cartan.energy), potential)
    momentum = plain.respell(road.cartan.momentum)
    acting, weighing = c.draft("force", "variation"), c.draft("energy", "pull-back")
    force = _forces(forces, acting)
    forces = {x: acting.mark(e).of(road.moment_work) for x, e in forces.items()}
    writing = c.draft("cartan", "relation")
    opened = dict(zip((plain.bracket, plain.bracket_w), brackets_of(plain).values(), strict=False))
    last = weighing.step((Equation("h̃", weighing.tree(restricted(energy))),), say("energy.problem"))
    written = writing.step(
        (form_equation(writing, restricted(momentum), restricted(energy), WordNotation()),),
        say("cartan.problem"),
    )
    momentum, energy = writing.mark(momentum), writing.mark(energy)
    domega = restricted(_derived(momentum, energy, road, v, plain, opened))
    varying, by_bracket = c.draft("exterior", "relation"), []
    if turned:
        skew = _derived(b.respell(momentum, whole), b.respell(energy, whole), road, v, b, {})
        by_bracket = [bracketed(varying, skew.of(whole), resting(b), b)]
    contraction, derivative = _exterior(domega, road, plain, varying, by_bracket)
    inertial, motion = _balance(contraction, [*forces.values()], plain, c)
    steps = (
        force,
        written,
        derivative,
        *(coadjoint_steps(road.momenta, b, whole, c) if turns_whole(group) else ()),
        motion,
    )
    return KernelOnGroup(free, whole, free.respell(inertial), forces, steps, (last,), bodies)


def turns_whole(group: Group) -> bool:
    """Are the linear parts of 𝔤 all the skew matrices, so that a skew coefficient of ξ′
    vanishes?"""
    n = group.n
    return "orthogonal" in group.relations and len(group.linear_basis) == n * (n - 1) // 2 > 0


def relation(group: Group, bodies: Bodies | None, c: Chapter) -> tuple[Step, ...]:
    """The step that says what the group keeps, read off the basis of 𝔤; none where it keeps
    nothing."""
    known: list[Equation] = []
    prose: Prose = ()
    if "orthogonal" in group.relations:
        known = stated("C = 𝟏,  Z̄ = −Z,  ξ̄ = −ξ")
        prose = _relation_sentences(group)
    elif "unimodular" in group.relations:
        known = stated("det(A) = 1,  Tr Z = 0,  Tr ξ = 0")
        prose = _relation_sentences(group, stays=not bodies)
    if not (known or bodies):
        return ()
    draft = c.draft("relation", "relation")
    equations = [*known, *(metric_equations(bodies) if bodies else ())]
    prose += metric_prose(bodies, draft) if bodies else ()
    if known:
        prose += _smaller(group)
    return (draft.step(equations, prose),)


def _smaller(group: Group) -> Prose:
    """The sentence that further relations hold, where a larger group has the same ones; else
    none."""
    n, skew = group.n, "orthogonal" in group.relations
    whole = n * (n - 1) // 2 if skew else n * n - 1
    if group.affine:
        whole += n
    if group.dimension == whole:
        return ()
    return say("relation.more", dimension=str(group.dimension))


def _relation_sentences(group: Group, *, stays: bool = True) -> Prose:
    """The sentences for the relations; ``stays``: C does not drop out."""
    skew = "orthogonal" in group.relations
    if group.affine:
        return say("relation.skew_parts" if skew else "relation.traceless_parts")
    if skew:
        return say("relation.skew")
    prose = say("relation.traceless") if stays else say("relation.volume")
    if group.factors:
        return prose
    return prose + say("relation.fixed_origin") + say("relation.reaction")


def _derived(
    momentum: Expr,
    energy: Expr,
    road: AnyGroup,
    v: Potentials,
    a: Alphabet,
    brackets: Mapping[Letter, Expr],
) -> Expr:
    """dϖ on words, by the values of P and F, with the potential of the problem."""
    moved = v.displaced(a, *(word(f.xi) for f in a.algebra_parts))
    moved |= {a.C: varied_cauchy_green(a, a.Z.xi)}
    values = fibre(momentum, energy, moved, a)
    return reduce(restrict(road.momenta.form, values, a, brackets), body_rule(a, cauchy_green(a)))


def _exterior(
    domega: Expr, road: AnyGroup, a: Alphabet, varying: Draft, by_bracket: Iterable[Tree]
) -> tuple[Contraction, Step]:
    """dϖ ready to be contracted, and its step, with the potential of the problem; also as it is
    written ``by_bracket``."""
    letters = a.letters()
    images = {letters[x.name]: without(a.respell(y), a.f) for x, y in road.exterior.images.items()}
    moving = [x for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity)]
    core = terms_with(without(domega, a.dt, a.dpt), *moving)
    shown = factored_tree(varying, domega, core, images, WordNotation())
    step = varying.step((Equation(DOMEGA, t) for t in (shown, *by_bracket)), restricted_prose(a))
    found = Chapter(a.chapter).label("second_order_trivialised")
    return (
        Contraction(
            varying.mark(domega),
            core,
            {x: varying.mark(y) for x, y in images.items()},
            {f.xi: word(f.velocity).marked(found) for f in a.algebra_parts},
            {f.d_velocity: f.acceleration for f in a.algebra_parts},
            tuple(f.dp_velocity for f in a.algebra_parts),
        ),
        step,
    )


def _balance(
    contraction: Contraction, forces: list[Expr], a: Alphabet, c: Chapter
) -> tuple[Expr, Step]:
    """dϖ(X, δ′) for X with the velocity of the motion, without the work of the forces; and the step
    that says that with it it is 0."""
    draft = c.draft("kernel", "kernel")
    tested = [f.xi_prime for f in a.algebra_parts]
    pairs = zip(forces, tested, strict=True)
    work = sum((inner(e, word(x)) for e, x in pairs), number(0))
    inertial, shown = balanced(draft, contraction, work, a)
    step = draft.step(
        (*rates(draft, a), Equation(shown, draft.tree(work), tuple(x.name for x in tested))),
        say("kernel.work", variation="(ξ′, η′)" if a.affine else "ξ′"),
    )
    return draft.mark(inertial), step


def _forces(forces: dict[Letter, Expr], d: Draft) -> Step:
    """The step of the forces in the body, ĀN and ĀF."""
    sides = (read("ĀN"), read("ĀF"))
    return d.step(
        (Equation(x, d.tree(e)) for x, e in zip(sides, forces.values(), strict=False)),
        say("force.moments"),
    )
