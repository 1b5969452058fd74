"""Step 4.  The exterior derivative dϖ: (25), (26), and in the trivialisation, the general (29).

dϖ(δy, δ′y) = ⟨δ′A − α δ′t, δα − F̃ δt⟩_J − ⟨δA − α δt, δ′α − F̃ δ′t⟩_J
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra import forms
from ..algebra.calculus import Image, gradient, reduce, substitute, terms_with, without
from ..algebra.word_trees import WordNotation, metrics, tree_of
from ..algebra.words import Expr, Letter, word
from ..language.read import read
from ..language.tree import Tree
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import Cartan
from .chapter import Chapter
from .factorisation import at_constant_time, factored_tree, solve_for
from .trivialisation import body_rule, cauchy_green, trivial_images, varied_cauchy_green
from .wording import say

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
    return forms.exterior(form, primes(a), *natural_variations(work, a))


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
        f.xi_prime: forms.structure_equation(
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
            images[y] = forms.strip_left(substitute(shift, carried), g)
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
    return c.draft("structure", "structure equation").step(
        equations,
        say("structure.crossed"),
    )


def exterior_trivialised(natural: Exterior, stage: Cartan, a: Alphabet, c: Chapter) -> Exterior:
    """dϖ in the variables (t, g, Z), for any group, with C = ĀA, and its step."""
    draft = c.draft("exterior_trivialised", "exterior derivative")
    varied = forms.exterior(stage.form, primes(a), *trivial_variations(a, stage.work))
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
