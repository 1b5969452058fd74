"""Steps 3 and 4: the Cartan form ϖ, trivialised, and its exterior derivative dϖ."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...algebra import calculus
from ...algebra.calculus import (
    Image,
    PairRule,
    derivation,
    gradient,
    reduce,
    substitute,
    terms_with,
    without,
)
from ...algebra.word_trees import WordNotation, metrics, tree_of
from ...algebra.words import Expr, Factor, Letter, word
from ...language.read import read
from ...language.tree import Tree, add, mul
from ...record.record import Equation, Step, stated
from ..chapter import Chapter, Draft, say
from ..matrices.coordinates import at_constant_time, factored_tree, solve_for
from .alphabet import Alphabet
from .lagrangian import Pullback

# Step 3. Momentum p̃ = ∂L̃/∂ν, energy, Cartan form ϖ (15), (16), (20), (23), carried to 𝔤.
#
# h̃ = p̃(α) − L̃,  ϖ(δy) = ⟨α, δA⟩_J − h̃ δt


@dataclass(frozen=True)
class Cartan:
    """The Cartan form on words: ``momentum`` = p̃(δg), ``energy`` = h̃, ``form`` = ϖ(δ) = momentum
    − energy δt.

    ``work`` = −dŨ(δg).
    """

    momentum: Expr
    energy: Expr
    form: Expr
    work: Expr
    steps: tuple[Step, ...]


def fibre_derivative(lagrangian: Expr, a: Alphabet) -> Expr:
    """p̃ = ∂L̃/∂ν, on the displacement δg."""
    return derivation(lagrangian, {p.velocity: word(p.d_position) for p in a.parts}.get)


def legendre(momentum: Expr, lagrangian: Expr, a: Alphabet) -> Expr:
    """h̃ = p̃(ν) − L̃."""
    return substitute(momentum, {p.d_position: word(p.velocity) for p in a.parts}) - lagrangian


def cartan_form(momentum: Expr, energy: Expr, a: Alphabet) -> Expr:
    """ϖ(δy) = p̃(δg) − h̃ δt."""
    return momentum - energy * word(a.dt)


def cartan(stage: Pullback, a: Alphabet, c: Chapter) -> Cartan:
    """The Cartan form in the variables (t, g, ν), with the steps ``momentum``, ``energy``,
    ``cartan``."""
    notation = metrics() if a.affine else metrics("J")
    paper = ((16, 20), (16,), (15,)) if a.affine else ((16,), (16, 23), (15, 23))
    return in_space(stage.kinetic - word(a.U), stage.work, a, c, notation, paper)


def in_space(
    lagrangian: Expr,
    work: Expr,
    a: Alphabet,
    c: Chapter,
    notation: WordNotation,
    paper: Sequence[Sequence[int]],
) -> Cartan:
    """The same of L̃, with the numbers that the ``paper`` gives to the three steps; ``work``:
    −dŨ(δg)."""
    moving, resting, whole = (
        c.draft("momentum", "fibre derivative"),
        c.draft("energy", "Legendre transform"),
        c.draft("cartan", "Cartan form"),
    )
    momentum = fibre_derivative(lagrangian, a)
    energy = legendre(moving.mark(momentum), lagrangian, a)
    velocities = ", ".join(p.velocity.name for p in a.parts)
    shown = add(whole.tree(moving.mark(momentum), notation), read("−h̃ δt"))
    rest = (read(f"p̃({velocities}) − L̃"), resting.tree(energy, notation))
    steps = (
        moving.step(
            _momentum_equations(moving, momentum, a, notation),
            say("momentum.affine" if len(a.parts) > 1 else "momentum.linear"),
            paper[0],
        ),
        resting.step((Equation("h̃", x) for x in rest), say("energy.paired"), paper[1]),
        whole.step((Equation(read("ϖ(δy)"), shown),), say("cartan.form"), paper[2]),
    )
    momentum, energy = moving.mark(momentum), resting.mark(energy)
    form = cartan_form(whole.mark(momentum), energy, a)
    return Cartan(momentum, energy, form, work, steps)


def _momentum_equations(
    d: Draft, momentum: Expr, a: Alphabet, notation: WordNotation
) -> list[Equation]:
    variations = tuple(p.d_position.name for p in a.parts)
    equations = [Equation(("call", "p̃", *variations), d.tree(momentum, notation))]
    if len(a.parts) > 1:
        # part by part, with the coefficient of each displacement gathered: the form of (20)
        for part in a.parts:
            covector = gradient(momentum, part.d_position)
            zeros = tuple(x if x == part.d_position.name else 0 for x in variations)
            equations.append(
                Equation(
                    ("call", "p̃", *zeros),
                    ("tr", ("mul", tree_of(covector.bar), part.d_position.name))
                    if part is a.A
                    else ("inner", tree_of(covector), part.d_position.name),
                )
            )
    return equations


def trivialise(stage: Cartan, a: Alphabet, c: Chapter) -> Cartan:
    """The Cartan form in the variables (t, g, Z), with ξ = g⁻¹δg."""
    draft = c.draft("cartan_trivialised", "trivialisation")
    momentum, energy = at_identity(stage.momentum, a), at_identity(stage.energy, a)
    step = draft.step(
        (form_equation(draft, momentum, energy, metrics()),), say("cartan_trivialised.form")
    )
    form = draft.mark(cartan_form(momentum, energy, a))
    steps = (trivialisation(a, c), step)
    work = at_identity(stage.work, a)
    return Cartan(draft.mark(momentum), draft.mark(energy), form, work, steps)


def form_equation(d: Draft, momentum: Expr, energy: Expr, notation: WordNotation) -> Equation:
    """The equation ϖ(δy) = p̃ − (h̃) δt, with the energy written out."""
    return Equation(
        read("ϖ(δy)"), add(d.tree(momentum, notation), mul(-1, d.tree(energy, notation), "δt"))
    )


# Step 3, trivialised: tangent vectors are carried to the Lie algebra by g⁻¹ (27), (30).


def body_rule(a: Alphabet, C: Expr) -> PairRule:
    """The relations ``ĀA = C``, ``ĀN = N_b``, ``ĀF = F_b``: what g leaves in a word carried to
    1.

    ``C`` is the letter C for any group and the identity for isometries.
    """
    pairs = {a.A.position: C} | {x: _marked(word(y), a) for x, y in a.body_forces}

    def rule(left: Factor, right: Factor) -> Expr | None:
        if left == (a.A.position, True) and not right[1] and right[0] in pairs:
            return pairs[right[0]]
        if right == (a.A.position, False) and left[1] and left[0] in (a.N, a.F):
            return pairs[left[0]].bar
        return None

    return rule


def varied_cauchy_green(a: Alphabet, xi: Letter) -> Expr:
    """The variation δC of C = ĀA along δA = Aξ: ξ̄C + Cξ, derived."""
    g = word(a.A.position)
    return reduce(
        derivation(g.bar * g, {a.A.position: g * word(xi)}.get), body_rule(a, cauchy_green(a))
    )


def trivial_images(a: Alphabet) -> dict[Letter, Expr]:
    """The images of letters in space: ν = gZ, δg = gξ, δ′g = gξ′, F̃ = A f, and δν, δ′ν by the
    product rule."""
    g = _marked(word(a.A.position), a)
    images: dict[Letter, Expr] = {a.F_group: g * word(a.f)}
    for part, inner in zip(a.parts, a.algebra_parts, strict=True):
        images[part.velocity] = g * word(inner.velocity)
        images[part.d_position] = g * word(inner.xi)
        images[part.dp_position] = g * word(inner.xi_prime)
        delta = {a.A.position: g * word(a.Z.xi), inner.velocity: word(inner.d_velocity)}
        images[part.d_velocity] = derivation(images[part.velocity], delta.get)
        delta = {a.A.position: g * word(a.Z.xi_prime), inner.velocity: word(inner.dp_velocity)}
        images[part.dp_velocity] = derivation(images[part.velocity], delta.get)
    return images


def rates(d: Draft, a: Alphabet, turned: Mapping[Letter, Expr] | None = None) -> list[Equation]:
    """The equations Ȧ = AZ and Ṫ = Aw; ``turned``: what is written for Z."""
    images, first = trivial_images(a), Chapter(a.chapter).label("kernel")
    speeds = {p.rate: substitute(word(p.velocity).marked(first), images) for p in a.parts}
    return [Equation(x, d.tree(substitute(e, turned or {}))) for x, e in speeds.items()]


def at_identity(e: Expr, a: Alphabet) -> Expr:
    """A scalar expression carried to the identity, in Z, ξ, C and the forces in the body."""
    return reduce(substitute(e, trivial_images(a)), body_rule(a, cauchy_green(a)))


def cauchy_green(a: Alphabet) -> Expr:
    """The Cauchy–Green matrix C = ĀA as a word, marked by the step that defines it."""
    return _marked(word(a.C), a)


def _marked(e: Expr, a: Alphabet) -> Expr:
    """An expression marked as said by the step ``trivialisation``."""
    return e.marked(Chapter(a.chapter).label("trivialisation"))


def trivialisation(a: Alphabet, c: Chapter) -> Step:
    """The step that defines Z, ξ, ξ′, C, and says what they make of variations."""
    definitions = stated("Z = A⁻¹α,  ξ = A⁻¹δA,  ξ′ = A⁻¹δ′A")
    if a.affine:
        definitions += stated("w = A⁻¹τ,  η = A⁻¹δT,  η′ = A⁻¹δ′T,  N_b = ĀN,  F_b = ĀF")
    else:
        definitions += stated("f = A⁻¹F̃")
    images = trivial_images(a)
    return c.draft("trivialisation", "trivialisation").step(
        (
            *definitions,
            *stated("C = ĀA"),
            *(Equation(p.d_velocity.name, tree_of(images[p.d_velocity])) for p in a.parts),
            Equation("δC", tree_of(varied_cauchy_green(a, a.Z.xi))),
        ),
        say("trivialisation.carried"),
        (27, 30),
    )


# Step 4. The exterior derivative dϖ: (25), (26), and in the trivialisation, the general (29).
#
# dϖ(δy, δ′y) = ⟨δ′A − α δ′t, δα − F̃ δt⟩_J − ⟨δA − α δt, δ′α − F̃ δ′t⟩_J

DOMEGA = read("dϖ(δy, δ′y)")


@dataclass(frozen=True)
class Exterior:
    """The exterior derivative: ``form`` = dϖ(δ, δ′) on words; ``images``: the contact variations
    with which it is written."""

    form: Expr
    images: dict[Letter, Expr]
    steps: tuple[Step, ...]


def derivative(form: Expr, work: Expr, a: Alphabet) -> Expr:
    """dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)], where δ and δ′ commute.  ``work``: −dŨ(δg)."""
    return calculus.exterior(form, primes(a), *natural_variations(work, a))


def primes(a: Alphabet) -> dict[Letter, Letter]:
    """Each variation letter and its primed twin."""
    table = {a.dt: a.dpt}
    for part, inner in zip(a.parts, a.algebra_parts, strict=True):
        table[part.d_position] = part.dp_position
        table[part.d_velocity] = part.dp_velocity
        table[inner.xi] = inner.xi_prime
        table[inner.d_velocity] = inner.dp_velocity
    return table


def primed(e: Expr, a: Alphabet) -> Expr:
    """An expression with the letters of δ′ for those of δ."""
    return substitute(e, {x: word(y) for x, y in primes(a).items()})


def natural_variations(work: Expr, a: Alphabet) -> tuple[Image, Image]:
    """The derivations δ and δ′ by their values on the letters t, A, α, (T, τ), Ũ; second variations
    commute.

    ``work``: −dŨ(δg).
    """
    delta: dict[Letter, Expr] = {a.U: word(a.dU_dt) * word(a.dt) - work}
    delta_prime: dict[Letter, Expr] = {a.U: primed(delta[a.U], a)}
    for p in a.parts:
        delta |= {p.position: word(p.d_position), p.velocity: word(p.d_velocity)}
        delta |= {p.dp_position: word(p.second), p.dp_velocity: word(p.second_velocity)}
        delta_prime |= {p.position: word(p.dp_position), p.velocity: word(p.dp_velocity)}
        delta_prime |= {p.d_position: word(p.second), p.d_velocity: word(p.second_velocity)}
    return delta.get, delta_prime.get


def contact_images(form: Expr, a: Alphabet) -> dict[Letter, Expr]:
    """The letters δx ↦ δx − X δt, where the kernel X of the ambient form can be read off dϖ (and
    for δ′)."""
    images: dict[Letter, Expr] = {}
    for x in [p.d_position for p in a.parts]:
        for p in a.parts:
            solution = solve_for(gradient(form, p.dp_velocity), x)
            if solution is not None and solution:
                images[x] = word(x) - solution
                break
    if not a.affine:
        solution = solve_for(gradient(form, a.A.dp_position), a.A.d_velocity)
        if solution is not None and solution:
            images[a.A.d_velocity] = word(a.A.d_velocity) - solution
    table = primes(a)
    return images | {table[x]: primed(y, a) for x, y in images.items()}


def brackets_of(a: Alphabet) -> dict[Letter, Expr]:
    """The values of δξ′ − δ′ξ (and δη′ − δ′η), by ξ′ (and η′), as the structure equation says."""
    mark = Chapter(a.chapter).label("structure")
    return {
        f.xi_prime: calculus.structure_equation(
            a.A.position, a.Z.xi, a.Z.xi_prime, f.xi, f.xi_prime
        ).marked(mark)
        for f in a.algebra_parts
    }


def shown_brackets(a: Alphabet) -> list[Tree]:
    """The trees of [ξ′, ξ] and, for an affine action, of what the bracket gives η."""
    first, *others = brackets_of(a).values()
    return [
        read("[ξ′, ξ]") if first == _bracket(a) else tree_of(first),
        *map(tree_of, others),
    ]


def _bracket(a: Alphabet) -> Expr:
    return word(a.Z.xi_prime) * word(a.Z.xi) - word(a.Z.xi) * word(a.Z.xi_prime)


def trivial_variations(a: Alphabet, work: Expr) -> tuple[Image, Image]:
    """The derivations δ and δ′ by their values on Z, ξ, C, Ũ, with the structure equation for the
    second variations.

    ``work``: −dŨ(gξ).
    """
    images, brackets = trivial_images(a), brackets_of(a)
    potential = word(a.dU_dt) * word(a.dt) - work
    delta: dict[Letter, Expr] = {a.U: potential, a.C: varied_cauchy_green(a, a.Z.xi)}
    delta_prime: dict[Letter, Expr] = {
        a.U: primed(potential, a),
        a.C: varied_cauchy_green(a, a.Z.xi_prime),
    }
    for p in a.parts:
        delta[p.position], delta_prime[p.position] = images[p.d_position], images[p.dp_position]
    for f in a.algebra_parts:
        delta[f.velocity], delta_prime[f.velocity] = word(f.d_velocity), word(f.dp_velocity)
        delta[f.xi_prime] = word(f.second) + brackets[f.xi_prime]
        delta_prime[f.xi] = word(f.second)
        delta[f.dp_velocity] = delta_prime[f.d_velocity] = word(f.second_velocity)
    return delta.get, delta_prime.get


def trivialised_images(stage: Exterior, a: Alphabet) -> dict[Letter, Expr]:
    """The contact variations carried to the identity: ξ ↦ ξ − Z δt, δZ ↦ δZ + ξZ − f δt."""
    carried = trivial_images(a)
    g = a.A.position
    images: dict[Letter, Expr] = {}
    for part, inner in zip(a.parts, a.algebra_parts, strict=True):
        for x, y in (
            (part.d_position, inner.xi),
            (part.dp_position, inner.xi_prime),
            (part.d_velocity, inner.d_velocity),
            (part.dp_velocity, inner.dp_velocity),
        ):
            shift = stage.images.get(x, word(x))
            images[y] = calculus.strip(substitute(shift, carried), g)
    return images


def exterior(stage: Cartan, a: Alphabet, c: Chapter) -> Exterior:
    """dϖ in the variables (t, g, ν), with the steps ``exterior`` and, at constant time,
    ``symplectic``."""
    form = derivative(stage.form, stage.work, a)
    images = contact_images(form, a)
    static = at_constant_time(form, a.dt, a.dpt)
    notation = metrics() if a.affine else metrics("J")
    whole = c.draft("exterior", "exterior derivative")
    resting = c.draft("symplectic", "restriction")
    steps = (
        whole.step(
            (Equation(DOMEGA, factored_tree(whole, form, static, images, notation)),),
            say("exterior.derivative") + say("exterior.explicit_time"),
            (25,),
        ),
        resting.step(
            (Equation(read("ω(δx, δ′x)"), resting.tree(whole.mark(static), notation)),),
            say("symplectic.constant_time"),
            (26,),
        ),
    )
    return Exterior(whole.mark(form), {x: whole.mark(y) for x, y in images.items()}, steps)


def structure(a: Alphabet, c: Chapter) -> Step:
    """The step of the structure equation, δξ′ − δ′ξ = [ξ′, ξ]."""
    equations = (
        Equation(read(f"δ({f.xi_prime.name}) − δ′({f.xi.name})"), t)
        for f, t in zip(a.algebra_parts, shown_brackets(a), strict=True)
    )
    return c.draft("structure", "structure equation").step(equations, say("structure.crossed"))


def exterior_trivialised(natural: Exterior, stage: Cartan, a: Alphabet, c: Chapter) -> Exterior:
    """dϖ in the variables (t, g, Z), for any group, with C = ĀA, and its step."""
    draft = c.draft("exterior_trivialised", "exterior derivative")
    varied = calculus.exterior(stage.form, primes(a), *trivial_variations(a, stage.work))
    form = reduce(varied, body_rule(a, cauchy_green(a)))
    images = trivialised_images(natural, a)
    variations = [x for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity)]
    core = terms_with(without(form, a.dt, a.dpt), *variations)
    step = draft.step(
        (Equation(DOMEGA, factored_tree(draft, form, core, images, WordNotation())),),
        say("exterior_trivialised.any_group"),
    )
    images = {x: draft.mark(y) for x, y in images.items()}
    return Exterior(draft.mark(form), images, (structure(a, c), step))
