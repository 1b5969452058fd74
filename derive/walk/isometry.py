"""SO(3) and SE(3): where ĀA = 1 the metric is left-invariant, (28) and (29)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..algebra.calculus import gradient, without
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, word
from ..language.tree import Tree
from ..record.record import Equation, Step, stated
from .alphabet import Alphabet
from .cartan import Cartan, form_equation
from .chapter import Chapter, Draft
from .exterior import DOMEGA, primed, primes, shown_brackets
from .factorisation import factored_tree, solve_for
from .momentum import MomentumForm, contact, fibre
from .restriction import restrict, restricted_prose
from .wording import say


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
    relation = relating.step(
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
    exterior = _exterior(domega, images, b, c)
    domega = domega.marked(exterior.label)
    return Isometry(b, C, form, values, domega, images, (relation, cartan, exterior))


def _exterior(domega: Expr, images: Mapping[Letter, Expr], b: Alphabet, c: Chapter) -> Step:
    draft = c.draft("exterior", "relation")
    shown = bracketed(draft, domega, images, b)
    return draft.step((Equation(DOMEGA, shown),), restricted_prose(b), () if b.affine else (29,))


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
