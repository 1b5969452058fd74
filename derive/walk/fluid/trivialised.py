"""Velocities and displacements told at the place where a point is: ϖ and dϖ by u and η.

    ϖ = ⟨u, η⟩ − ½‖u‖² δt,  δη′ − δ′η = ∇_η′ η − ∇_η η′

G is the composition with g; what the walk of the affine groups says of A, T and w is said of G, g
and u, with ḠG = 1, or ρ, for C = ĀA.
"""

from __future__ import annotations

from ...algebra import forms
from ...algebra.calculus import derivation, reduce, substitute, terms_with, without
from ...algebra.word_trees import WordNotation, metrics, tree_of
from ...algebra.words import Expr, word
from ...language.read import read
from ...record.record import Equation, Step, stated
from ..cartan import Cartan, cartan_form, form_equation
from ..chapter import Chapter
from ..exterior import (
    DOMEGA,
    Exterior,
    primes,
    shown_brackets,
    trivial_variations,
    trivialised_images,
)
from ..factorisation import factored_tree
from ..trivialisation import body_rule, trivial_images, varied_cauchy_green
from ..wording import say
from .fluid_letters import FluidAlphabet
from .fluid_points import Points


def relations(a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The steps ``trivialisation``, ``chain``, ``isometry``, ``skew`` and, of a density that is
    carried along, ``transport``."""
    images = trivial_images(a)
    g, xi, shown = a.A.position, word(a.Z.xi), trees(a)
    turned = derivation(word(g), {g: word(g) * xi}.get)
    moving, varying = c.draft("trivialisation", "trivialisation"), c.draft("chain", "variation")
    keeping, integrating = c.draft("isometry", "relation"), c.draft("skew", "relation")
    steps = [
        moving.step(stated("ν = Gu,  δg = Gη,  δ′g = Gη′"), say("trivialisation.fluid")),
        varying.step(
            (
                Equation(("call", "δ", "G"), varying.tree(turned)),
                *(
                    Equation(x.name, varying.tree(images[x]))
                    for x in (a.T.d_velocity, a.T.dp_velocity)
                ),
            ),
            say("chain.rule"),
        ),
        keeping.step(
            (Equation(tree_of(word(g).bar * word(g)), keeping.tree(a.volume, shown)),),
            say(f"isometry.{'advected' if a.advected else 'homogeneous'}"),
        ),
        integrating.step(
            (Equation(("T", tree_of(xi)), integrating.tree(xi.bar)),), say("skew.stokes")
        ),
    ]
    if a.advected:
        steps.append(_transport(a, c))
    return tuple(steps)


def _transport(a: FluidAlphabet, c: Chapter) -> Step:
    """δρ by ρ = ḠG: the step ``transport``."""
    draft = c.draft("transport", "variation")
    draft.depends_on(word(a.C).marked(c.label("isometry"), c.label("chain"), c.label("skew")))
    varied = varied_cauchy_green(a, a.Z.xi)
    return draft.step((Equation(("call", "δ", "ρ"), draft.tree(varied)),), say("transport.density"))


def trees(a: FluidAlphabet) -> WordNotation:
    """The notation with the density as a metric."""
    return metrics(a.metric)


def at_identity(e: Expr, a: FluidAlphabet) -> Expr:
    """A scalar by u, η and ḠG."""
    volume = a.volume.marked(a.label("isometry"))
    return reduce(substitute(e, trivial_images(a)), body_rule(a, volume))


def trivialised(natural: Cartan, stage: Points, a: FluidAlphabet, c: Chapter) -> Cartan:
    """L̃ and ϖ by u and η: the steps ``pullback`` and ``cartan_trivialised``."""
    pulling = c.draft("pullback", "pull-back")
    draft = c.draft("cartan_trivialised", "trivialisation")
    images = trivial_images(a)
    momentum, energy = (at_identity(e, a) for e in (natural.momentum, natural.energy))
    lagrangian = at_identity(stage.lagrangian, a)
    steps = (
        pulling.step(
            (
                Equation("L̃", pulling.tree(substitute(stage.lagrangian, images))),
                Equation("L̃", pulling.tree(lagrangian, trees(a))),
            ),
            say("pullback.fluid"),
        ),
        draft.step(
            (form_equation(draft, momentum, energy, trees(a)),), say("cartan_trivialised.form")
        ),
    )
    momentum, energy = draft.mark(momentum), draft.mark(energy)
    work = at_identity(natural.work, a)
    return Cartan(momentum, energy, cartan_form(momentum, energy, a), work, steps)


def exterior_by_fields(natural: Exterior, stage: Cartan, a: FluidAlphabet, c: Chapter) -> Exterior:
    """dϖ by u and η, with what crosses the variations: the steps ``structure`` and
    ``exterior_trivialised``."""
    crossing, draft = (
        c.draft("structure", "structure equation"),
        c.draft("exterior_trivialised", "exterior derivative"),
    )
    (crossed,) = shown_brackets(a)
    crossing.depends_on(word(a.A.position).marked(c.label("chain")))
    first = crossing.step((Equation(read("δ(η′) − δ′(η)"), crossed),), say("structure.fields"))
    varied = forms.exterior(stage.form, primes(a), *trivial_variations(a, stage.work))
    form = reduce(varied, body_rule(a, a.volume))
    draft.depends_on(word(a.A.position).marked(c.label("skew")))
    images = trivialised_images(natural, a)
    for x in (a.w.d_velocity, a.w.dp_velocity):
        images[x] = word(x) + (images[x] - word(x))  # first the variation itself
    core = terms_with(without(form, a.dt, a.dpt), a.w.d_velocity, a.w.dp_velocity)
    contact = {x: y for x, y in images.items() if x in (a.w.xi, a.w.xi_prime)}
    for x in (a.w.d_velocity, a.w.dp_velocity) if a.forced else ():
        contact[x] = word(x) + terms_with(images[x], a.dt, a.dpt)
    shown = [factored_tree(draft, form, core, images, trees(a))]
    if not a.advected:  # with a density that moves, the second has terms in its derivative
        shown.append(factored_tree(draft, form, core, contact, trees(a)))
    step = draft.step([Equation(DOMEGA, t) for t in shown], say("exterior_trivialised.fluid"))
    return Exterior(draft.mark(form), {x: draft.mark(y) for x, y in images.items()}, (first, step))
