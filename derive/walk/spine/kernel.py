"""Step 5: the kernel of dϖ, the equations of motion of any group, and their momentum form."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from ...algebra import calculus
from ...algebra.calculus import (
    Image,
    derivation,
    gradient,
    reduce,
    strip,
    substitute,
    terms_with,
    without,
)
from ...algebra.word_trees import WordNotation, metrics, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.read import read
from ...language.tree import Tree, add
from ...record import sentence
from ...record.record import Equation, Step
from ...record.sentence import Prose, listed
from ..chapter import Chapter, Draft, say, say_signed
from ..matrices.coordinates import at_constant_time, factored_tree
from .alphabet import AlgebraPart, Alphabet, Dual
from .cartan import (
    DOMEGA,
    Cartan,
    Exterior,
    body_rule,
    brackets_of,
    cauchy_green,
    primed,
    primes,
    rates,
    shown_brackets,
    trivial_images,
    varied_cauchy_green,
)
from .principle import AND, CONTRACTION, Contraction, Principle, rate, steps_of, velocities

# Step 5. The kernel of dϖ: the equations of motion of any group (Exercise 1); here for one of
# linear maps.
#
# Ȧ = α,  ⟨δ′A, α̇ − F̃⟩_J = 0
#
# For every δ′A tangent to the group: so dϖ(X, ·) vanishes, where δt(X) = 1.


@dataclass(frozen=True)
class Kernel:
    """The kernel in the variables (t, g, ν): ``velocity``: δg(X), part by part;
    ``velocity_equations``: these as equations; ``balance``: what vanishes for every displacement
    δ′g tangent to the group."""

    velocity: Mapping[Letter, Expr]
    velocity_equations: tuple[Equation, ...]
    balance: Expr
    steps: tuple[Step, ...]


def on_kernel(stage: Exterior, a: Alphabet) -> tuple[dict[Letter, Expr], Expr]:
    """X with δt(X) = 1 and dϖ(X, ·) = 0: δg(X), where every δg − ν δt vanishes; and
    dϖ(X, δ′y) for δ′t = 0 and δν(X) = ν̇, which does so for every δ′g.

    That it has no δ′ν left is tested where the steps are made (``Contraction.on_vertical``)."""
    now = {a.dt: number(1)}
    moving = {x: word(x) - stage.images.get(x, word(x)) for x in (p.d_position for p in a.parts)}
    velocity = {x: substitute(e, now) for x, e in moving.items()}
    rates = {p.d_velocity: word(p.acceleration) for p in a.parts}
    return velocity, without(substitute(stage.form, now | velocity | rates), a.dpt)


def kernel(stage: Exterior, principle: Principle, a: Alphabet, chapter: Chapter) -> Kernel:
    """The kernel in the variables (t, g, ν), with its steps: by the ``principle`` it is the
    tangents of the motions."""
    notation = metrics() if a.affine else metrics("J")
    draft = chapter.draft("kernel", "kernel")
    *others, last_one = (x.name for p in a.parts for x in (p.d_position, p.d_velocity))
    velocity, virtual = on_kernel(stage, a)
    contracted, steps = steps_of(
        [
            Contraction(
                stage.form.of(principle.across),
                at_constant_time(stage.form, a.dt, a.dpt),
                stage.images,
                velocity,
                {p.d_velocity: p.acceleration for p in a.parts},
                tuple(p.dp_velocity for p in a.parts),
                notation,
                resting={p.dp_velocity: p.dp_position for p in a.parts},
                space="T_g G",
            )
        ],
        [p.d_position for p in a.parts],
        sentence.phrase(AND, first=", ".join(others), second=last_one),
        listed(AND, [rate(p.acceleration.name, p.d_velocity.name) for p in a.parts]),
        a,
        chapter,
    )
    mark = chapter.label("second_order")
    virtual = virtual.marked(mark)
    if a.affine:
        pairs = [
            ("inner", draft.tree(gradient(virtual, p.dp_position)), p.dp_position.name)
            for p in a.parts
        ]
        balance = add(*pairs)
    else:
        kept = {a.A.acceleration: contracted.shifts[a.A.acceleration].marked(mark)}
        balance = factored_tree(draft, virtual, contracted.remaining_core, kept, notation)
    along = {x: e.marked(mark) for x, e in velocity.items()}
    first_order = tuple(Equation(p.rate, draft.tree(along[p.d_position])) for p in a.parts)
    variations = tuple(p.dp_position.name for p in a.parts)
    last = draft.step(
        (*first_order, Equation(balance, 0, variations)),
        say("kernel.displacements")
        + say("kernel.tangent")
        + say(
            "kernel.energy",
            velocity=", ".join(f"{p.dp_position.name} = {p.velocity.name}" for p in a.parts),
        )
        + say_signed("kernel.line", a.signed),
    )
    return Kernel(along, steps[-1].given, draft.mark(virtual), (*steps, last))


def kernel_trivialised(
    stage: Exterior, natural: Kernel, cartan: Cartan, a: Alphabet, chapter: Chapter
) -> tuple[Step, ...]:
    """The steps of the kernel in the variables (t, g, Z): Exercise 1 for every group that moves
    points."""
    variations = [x for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity)]
    draft = chapter.draft("second_order_trivialised", "trivialisation")
    contracted = Contraction(
        stage.form,
        terms_with(without(stage.form, a.dt, a.dpt), *variations),
        stage.images,
        velocity_of_motion(natural, a),
        {f.d_velocity: f.acceleration for f in a.algebra_parts},
        tuple(f.dp_velocity for f in a.algebra_parts),
    )
    first = draft.step(
        (
            *velocities(draft, contracted.velocity, contracted.velocity),
            Equation(CONTRACTION, contracted.remaining(draft), contracted.rates()),
        ),
        say("second_order_trivialised.carried"),
        where=natural.velocity_equations,
    )
    images, velocity = (
        {x: draft.mark(e) for x, e in found.items()}
        for found in (contracted.images, contracted.velocity)
    )
    found = replace(contracted, form=draft.mark(contracted.form), images=images, velocity=velocity)
    return first, _equations(found, cartan.work, a, chapter)


def velocity_of_motion(stage: Kernel, a: Alphabet) -> dict[Letter, Expr]:
    """The values ξ(X) = Z (and η(X) = w), by their letters, from gξ(X) = δg(X)."""
    carried, g = trivial_images(a), a.A.position
    return {
        f.xi: strip(substitute(stage.velocity[p.d_position], carried), g)
        for p, f in zip(a.parts, a.algebra_parts, strict=True)
    }


def balanced(d: Draft, c: Contraction, work: Expr, a: Alphabet) -> tuple[Expr, Tree]:
    """dϖ(X, δ′) for X with the velocity of the motion and δ′t = 0, without the ``work`` of the
    forces: on words, and as a tree by Ż + Z²."""
    inertial = without(c.second_order, a.dpt) + work
    shifts = {f.acceleration: without(c.shifts[f.acceleration], a.f) for f in a.algebra_parts}
    core = without(c.remaining_core, a.dpt)
    return inertial, factored_tree(d, inertial, core, shifts, WordNotation())


def _equations(c: Contraction, work: Expr, a: Alphabet, chapter: Chapter) -> Step:
    """The step dϖ(X, δ′) = 0, with the work of the forces carried to the right: −dŨ(gξ′)."""
    draft = chapter.draft("equations", "kernel")
    _, shown = balanced(draft, c, without(primed(work, a), a.dpt), a)
    images = trivial_images(a)
    rhs: Tree = ("mul", -1, ("call", "dŨ", *(draft.tree(images[p.dp_position]) for p in a.parts)))
    return draft.step(
        (*rates(draft, a), Equation(shown, rhs, tuple(f.xi_prime.name for f in a.algebra_parts))),
        say("equations.exercise", acceleration="(Ż, ẇ)" if a.affine else "Ż"),
    )


# The momentum form: dϖ of any group in a momentum P of 𝔤*, and its kernel (Euler–Poincaré).
#
# With L̃ the Lagrangian in (t, g, Z), P = ∂L̃/∂Z and F its derivative along the group,
#
# ϖ  = ⟨P, ξ⟩ − h̃ δt,      h̃ = ⟨P, Z⟩ − L̃,
# dϖ = ⟨δP − F δt, ξ′ − Z δ′t⟩ − ⟨δ′P − F δ′t, ξ − Z δt⟩ + ⟨P, [ξ′, ξ]⟩,
#
# whatever L̃ is: the proof has the letters P, Z, F and the bracket alone. They are Π and Φ; for
# an affine group P = (Π, p_b) and F = (Φ, F_b). Points are one source of L̃ (``fibre``, from p̃
# and h̃). That ξ(X) = Z on the kernel is for points the step ``second_order_trivialised``; for
# any other L̃ it asks for an invertible ∂²L̃/∂Z². Makes the steps ``momenta``,
# ``cartan_momentum``, ``exterior_momentum`` and ``coadjoint`` of the chapters ``linear`` and
# ``affine``.


@dataclass(frozen=True)
class MomentumForm:
    """The momentum form: ``values``: P and F on words, by their letters. In these letters, whatever
    the Lagrangian: ``form``: dϖ(δ, δ′), and ``balance``: ⟨Ṗ − F, ξ′⟩ − ⟨P, [Z, ξ′]⟩."""

    values: Mapping[Letter, Expr]
    form: Expr
    balance: Expr
    steps: tuple[Step, ...]


def momentum_form(stage: Cartan, a: Alphabet, c: Chapter) -> MomentumForm:
    """P and F of the points, then ϖ, dϖ and its kernel by them: the steps that the module names."""
    values, momenta = _values(stage, a, c)
    letters = dict(zip(brackets_of(a), (a.bracket, a.bracket_w), strict=False))
    structure = {x: word(letters[x]).of(e) for x, e in brackets_of(a).items()}
    second_order = c.label("second_order_trivialised")
    form, balance, steps = any_lagrangian_forms(a, c, structure, second_order)
    return MomentumForm(values, form, balance, (momenta, *steps))


def _values(stage: Cartan, a: Alphabet, c: Chapter) -> tuple[dict[Letter, Expr], Step]:
    """P = ∂L̃/∂Z and F, the derivative of L̃ along gξ, with L̃ = ⟨P, Z⟩ − h̃; and the step
    ``momenta``."""
    draft = c.draft("momenta", "fibre derivative")
    along_motion = {a.C: varied_cauchy_green(a, a.Z.xi), a.U: -stage.work}
    values = fibre(stage.momentum, stage.energy, along_motion, a)
    step = draft.step(
        [Equation(x.name, draft.tree(e)) for x, e in values.items() if e != word(x)],
        say(
            "momenta.derivatives",
            velocity="(Z, w)" if a.affine else "Z",
            push="(Φ, F_b)" if a.affine else "Φ",
        ),
    )
    return {x: draft.mark(e) for x, e in values.items()}, step


def fibre(
    momentum: Expr, energy: Expr, along_group: Mapping[Letter, Expr], a: Alphabet
) -> dict[Letter, Expr]:
    """P, read off p̃(ξ) = ⟨P, ξ⟩, and F, the derivative of L̃ = p̃(Z) − h̃ where ξ moves the group.

    Each by a whole matrix, of which the elements of 𝔤 determine a part.  ``along_group``: what ξ
    (and η) make of the other letters.
    """
    along = substitute(momentum, {f.xi: word(f.velocity) for f in a.algebra_parts})
    varied = reduce(derivation(along - energy, along_group.get), body_rule(a, cauchy_green(a)))
    any_xi = {f.xi: Letter(f.xi.name, f.xi.rows, f.xi.cols) for f in a.algebra_parts}
    whole = [substitute(e, {x: word(y) for x, y in any_xi.items()}) for e in (momentum, varied)]
    pairs = [*zip(a.duals, a.algebra_parts, strict=True)]
    values = {d.momentum: gradient(whole[0], any_xi[f.xi]) for d, f in pairs}
    return values | {d.force: gradient(whole[1], any_xi[f.xi]) for d, f in pairs}


def any_lagrangian_forms(
    a: Alphabet, c: Chapter, structure: Mapping[Letter, Expr], second_order: str
) -> tuple[Expr, Expr, tuple[Step, ...]]:
    """dϖ and the balance in the letters P, F, Z, ξ and the bracket; and the steps of ϖ, dϖ and the
    kernel.

    ``structure``: ξ′ ↦ δξ′ − δ′ξ by the letter [ξ′, ξ]; ``second_order``: the step with ξ(X) = Z.
    """
    writing = c.draft("cartan_momentum", "Cartan form")
    varying = c.draft("exterior_momentum", "exterior derivative")
    momentum, lagrangian = _paired(a, [f.xi for f in a.algebra_parts], c), Letter("L̃")
    energy = _paired(a, [f.velocity for f in a.algebra_parts], c) - word(lagrangian)
    notation = WordNotation(covectors=frozenset(x for d in a.duals for x in d.letters))
    written = writing.step(
        (
            Equation(
                read("ϖ(δy)"),
                add(writing.tree(momentum, notation), read("−h̃ δt")),
            ),
        ),
        say("cartan_momentum.form"),
    )
    form = writing.mark(momentum - energy * word(a.dt))
    twins = primes(a) | {d.d_momentum: d.dp_momentum for d in a.duals}
    derived = calculus.exterior(form, twins, *_variations(lagrangian, a, c, structure))
    core = at_constant_time(derived, a.dt, a.dpt)
    images = contact(zip(a.duals, a.algebra_parts, strict=True), a, {})
    display = dict(zip((a.bracket, a.bracket_w), shown_brackets(a), strict=False))
    shown = replace(notation, display=display)
    derivative = varying.step(
        (Equation(DOMEGA, factored_tree(varying, derived, core, images, shown)),),
        say(
            "exterior_momentum.derivative",
            varied="δL̃ = ⟨Π, δZ⟩ + ⟨p_b, δw⟩ + ⟨Φ, ξ⟩ + ⟨F_b, η⟩ + ∂L̃/∂t δt"
            if a.affine
            else "δL̃ = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ + ∂L̃/∂t δt",
        ),
    )
    found = varying.mark(derived)
    balance, motion = _kernel(found, notation, a, c, second_order)
    return found, balance, (written, derivative, motion)


def _paired(a: Alphabet, along: Iterable[Letter], c: Chapter) -> Expr:
    """⟨P, x⟩, for the letters x of ``along``, part by part."""
    pairs = zip(a.duals, along, strict=True)
    terms = (inner(word(d.momentum).marked(c.label("momenta")), word(x)) for d, x in pairs)
    return sum(terms, number(0))


def _variations(
    lagrangian: Letter, a: Alphabet, c: Chapter, structure: Mapping[Letter, Expr]
) -> tuple[Image, Image]:
    """The derivations δ and δ′ by their values on L̃, P, Z and ξ, with the structure equation for
    the second variations."""
    varied = word(Letter("∂ₜL̃")) * word(a.dt)
    delta: dict[Letter, Expr] = {}
    delta_prime: dict[Letter, Expr] = {}
    for d, f in zip(a.duals, a.algebra_parts, strict=True):
        force = inner(word(d.force).marked(c.label("momenta")), word(f.xi))
        varied = varied + inner(word(d.momentum), word(f.d_velocity)) + force
        delta |= {d.momentum: word(d.d_momentum), f.velocity: word(f.d_velocity)}
        delta_prime |= {d.momentum: word(d.dp_momentum), f.velocity: word(f.dp_velocity)}
        delta[f.xi_prime] = word(f.second) + structure[f.xi_prime]
        delta_prime[f.xi] = word(f.second)
    delta |= {lagrangian: varied} | {
        f.dp_velocity: word(f.second_velocity) for f in a.algebra_parts
    }
    delta_prime |= {lagrangian: primed(varied, a)}
    delta_prime |= {f.d_velocity: word(f.second_velocity) for f in a.algebra_parts}
    return delta.get, delta_prime.get


def contact(
    pairs: Iterable[tuple[Dual, AlgebraPart]], a: Alphabet, forces: Mapping[Letter, Expr]
) -> dict[Letter, Expr]:
    """The contact variations δP ↦ δP − F δt and ξ ↦ ξ − Z δt, and the same for δ′; F by
    ``forces``, else by its letter."""
    images = {}
    for d, f in pairs:
        for change, x, twin in (
            (forces.get(d.force, word(d.force)), d.d_momentum, d.dp_momentum),
            (word(f.velocity), f.xi, f.xi_prime),
        ):
            images[x] = word(x) - change * word(a.dt)
            images[twin] = word(twin) - change * word(a.dpt)
    return images


def _kernel(
    form: Expr, notation: WordNotation, a: Alphabet, c: Chapter, second_order: str
) -> tuple[Expr, Step]:
    """The balance ⟨Ṗ − F, ξ′⟩ − ⟨P, [Z, ξ′]⟩, and the step Ṗ = F + ad*_Z P, by X with the velocity
    of the motion."""
    draft = c.draft("coadjoint", "kernel")
    here = {f.xi: word(f.velocity).marked(second_order) for f in a.algebra_parts}
    here |= {d.d_momentum: word(d.rate) for d in a.duals}
    here |= {a.dt: number(1), a.dpt: number(0)}
    turned = {}
    for x, e in zip((a.bracket, a.bracket_w), brackets_of(a).values(), strict=False):
        opposite = Letter(f"−{x.name}", x.rows, x.cols)
        here[x], turned[opposite] = -word(opposite), -substitute(e, here)
    balance = substitute(form, here)
    first, *others = turned
    # the bracket is a letter to the end: a Lagrangian from elsewhere has the same equations
    commutator = word(a.Z.velocity) * word(a.Z.xi_prime) - word(a.Z.xi_prime) * word(a.Z.velocity)
    display: dict[Letter, Tree] = {x: tree_of(turned[x]) for x in others}
    if turned[first] == commutator:
        display[first] = read("[Z, ξ′]")
    shown = replace(notation, display=display)
    pairs = zip(a.duals, a.algebra_parts, strict=True)
    moving = sum((inner(word(d.rate), word(f.xi_prime)) for d, f in pairs), number(0))
    step = draft.step(
        (
            Equation(
                draft.tree(moving, shown),
                draft.tree(moving - balance, shown),
                tuple(f.xi_prime.name for f in a.algebra_parts),
            ),
        ),
        say("coadjoint.any_lagrangian", push="(Φ, F_b)" if a.affine else "Φ"),
    )
    return draft.mark(substitute(balance, turned)), step


# From any group to a problem's: the letters of 𝔤* take their values.
#
# What the general road says in P, δP, Ṗ, F, Z, ξ and the bracket is not expanded there: the
# values of P and F on a group are put in here, with their variations.


def restrict(
    e: Expr,
    values: Mapping[Letter, Expr],
    a: Alphabet,
    brackets: Mapping[Letter, Expr] | None = None,
) -> Expr:
    """An expression about any group, in the letters ``a``, with P and F by their ``values``.

    ``brackets``: what those letters stand for, where they are to be opened.  ``ValueError`` for a P
    with other letters than those of the velocity, the body and C: how they vary is not known here.
    """
    known = {a.C, a.J, a.c, a.m, *(f.velocity for f in a.algebra_parts)}
    for d in a.duals:
        for x in values[d.momentum].letters():
            if x not in known:
                raise ValueError(f"{d.momentum.name} has {x.name}, whose variation is not known")
    further = [{a.C: varied_cauchy_green(a, x)} for x in (a.Z.xi, a.Z.xi_prime, a.Z.velocity)]
    images = along_motion(values, a.duals, a.algebra_parts, further) | dict(brackets or {})
    return substitute(a.respell(e), images)


def along_motion(
    values: Mapping[Letter, Expr],
    duals: Iterable[Dual],
    parts: Sequence[AlgebraPart],
    further: Iterable[Mapping[Letter, Expr]],
) -> dict[Letter, Expr]:
    """The images of P, δP, δ′P, Ṗ and F: their values in Z and w; letters that do not vary are
    constants.

    ``further``: what else varies, under δ, under δ′ and along the motion.
    """
    letters = zip(*((f.d_velocity, f.dp_velocity, f.acceleration) for f in parts), strict=True)
    varied = [
        {f.velocity: word(x) for f, x in zip(parts, found, strict=True)} | dict(others)
        for found, others in zip(letters, further, strict=True)
    ]
    images = dict(values)
    for d in duals:
        for x, delta in zip((d.d_momentum, d.dp_momentum, d.rate), varied, strict=True):
            images[x] = derivation(values[d.momentum], delta.get)
    return images


def restricted_prose(a: Alphabet) -> Prose:
    """The sentence for a dϖ that is restricted to a group."""
    return say("exterior.by_momenta", momenta="(Π, p_b, Φ, F_b)" if a.affine else "(Π, Φ)")
