"""One problem on one group: its relations, ϖ and dϖ with its potential, its forces and energy."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from ...algebra.calculus import gradient, reduce, substitute, terms_with, without
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.read import read
from ...language.tree import Tree
from ...problem.inertia import Bodies
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say
from ..given.inputs import External
from ..given.potentials import Potentials, virtual_work
from ..spine.alphabet import Alphabet
from ..spine.cartan import (
    DOMEGA,
    Cartan,
    Exterior,
    body_rule,
    brackets_of,
    cauchy_green,
    form_equation,
    rates,
    varied_cauchy_green,
)
from ..spine.kernel import MomentumForm, balanced, fibre, restrict, restricted_prose
from ..spine.principle import Contraction
from .coordinates import factored_tree
from .isometry import (
    bracketed,
    coadjoint_steps,
    metric_equations,
    metric_prose,
    resting,
    without_cauchy_green,
)


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
    inertial, motion = _kernel(contraction, [*forces.values()], plain, c)
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
    return say(
        "relation.more",
        dimension=str(group.dimension),
    )


def _relation_sentences(group: Group, *, stays: bool = True) -> Prose:
    """The sentences for the relations; ``stays``: C does not drop out."""
    skew = "orthogonal" in group.relations
    if group.affine:
        if skew:
            return say("relation.skew_parts")
        return say("relation.traceless_parts")
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
            (a.dt, a.dpt),
            WordNotation(),
        ),
        step,
    )


def _kernel(
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
        say(
            "kernel.work",
            variation="(ξ′, η′)" if a.affine else "ξ′",
        ),
    )
    return draft.mark(inertial), step


def _forces(forces: dict[Letter, Expr], d: Draft) -> Step:
    """The step of the forces in the body, ĀN and ĀF."""
    sides = (read("ĀN"), read("ĀF"))
    return d.step(
        (Equation(x, d.tree(e)) for x, e in zip(sides, forces.values(), strict=False)),
        say("force.moments"),
    )
