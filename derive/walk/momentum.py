"""The momentum form: dϖ of any group in a momentum P of 𝔤*, and its kernel (Euler–Poincaré).

With L̃ the Lagrangian in (t, g, Z), P = ∂L̃/∂Z and F its derivative along the group,

    ϖ  = ⟨P, ξ⟩ − h̃ δt,      h̃ = ⟨P, Z⟩ − L̃,
    dϖ = ⟨δP − F δt, ξ′ − Z δ′t⟩ − ⟨δ′P − F δ′t, ξ − Z δt⟩ + ⟨P, [ξ′, ξ]⟩,

whatever L̃ is: the proof has the letters P, Z, F and the bracket alone.  They are Π and Φ; for an
affine group P = (Π, p_b) and F = (Φ, F_b).  Points are one source of L̃ (``fibre``, from p̃ and h̃).
That ξ(X) = Z on the kernel is for points the step ``second_order_trivialised``; for any other L̃ it
asks for an invertible ∂²L̃/∂Z².  Makes the steps ``momenta``, ``cartan_momentum``,
``exterior_momentum`` and ``coadjoint`` of the chapters ``linear`` and ``affine``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from ..algebra import forms
from ..algebra.calculus import Image, derivation, gradient, reduce, substitute
from ..algebra.word_trees import WordNotation, tree_of
from ..algebra.words import Expr, Letter, inner, number, word
from ..language.read import read
from ..language.tree import Tree, add
from ..record.record import Equation, Step
from .alphabet import AlgebraPart, Alphabet, Dual
from .cartan import Cartan
from .chapter import Chapter
from .exterior import DOMEGA, brackets_of, primed, primes, shown_brackets
from .factorisation import at_constant_time, factored_tree
from .trivialisation import body_rule, cauchy_green, varied_cauchy_green
from .wording import say


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
    moved = {a.C: varied_cauchy_green(a, a.Z.xi), a.U: -stage.work}
    values = fibre(stage.momentum, stage.energy, moved, a)
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
    derived = forms.exterior(form, twins, *_variations(lagrangian, a, c, structure))
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
        for rate, x, twin in (
            (forces.get(d.force, word(d.force)), d.d_momentum, d.dp_momentum),
            (word(f.velocity), f.xi, f.xi_prime),
        ):
            images[x] = word(x) - rate * word(a.dt)
            images[twin] = word(twin) - rate * word(a.dpt)
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
        say(
            "coadjoint.any_lagrangian",
            push="(Φ, F_b)" if a.affine else "Φ",
        ),
    )
    return draft.mark(substitute(balance, turned)), step
